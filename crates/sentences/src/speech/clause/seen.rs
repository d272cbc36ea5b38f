//! What is seen and heard.

use super::{Bag, agent};
use crate::speech::atoms::{Atom, CountedNumber, form};
use crate::speech::lexicon::FormEnd;
use crate::speech::meaning::{SensedEvent, WhichFace};

/// What is heard: words, a sound, or none.
pub(super) fn heard(bag: &mut Bag, not: &mut bool) -> Option<SensedEvent> {
    let speaks = bag.find("v", "say").or_else(|| bag.find("v", "hear").filter(|_| !bag.has("noun", "sound")));
    // *On the word “start”*
    let acts = |atom: &Atom| ["v", "do", "pose", "who"].iter().any(|kind| atom.is(kind, ""));
    if speaks.is_none() && bag.has("noun", "word") && !bag.atoms.iter().any(acts) {
        let words: Vec<String> = std::iter::from_fn(|| bag.quote()).collect();
        if words.is_empty() {
            return None;
        }
        bag.take_all("noun", "word");
        bag.take_all("or", "");
        return Some(SensedEvent::Words(words));
    }
    if let Some(at) = speaks
        && let Some(words) = words(bag, at)
    {
        // *It hears …*: the robot.
        let hears = bag.atoms[at].is("v", "hear") && form(&bag.atoms[at], "v").end == FormEnd::Third;
        if let Some(it) = bag.find("it", "").filter(|it| hears && *it < at) {
            bag.use_up(it);
        }
        agent(bag);
        bag.take_all("robot", "");
        bag.take_all("noun", "toyou");
        for verb in ["hear", "say", "make"] {
            bag.take("v", verb);
        }
        return Some(SensedEvent::Words(words));
    }
    // *You have not heard anything*
    let hears = bag.has("v", "hear") && *not && bag.has("noun", "thing");
    if hears && bag.take("v", "hear").is_some() {
        bag.take_all("noun", "thing");
        bag.take_all("robot", "");
        return Some(SensedEvent::Noise);
    }
    if bag.take("noun", "quiet").is_some() {
        *not = true;
        for verb in ["turn", "come", "exist", "shine", "go"] {
            bag.take_all("v", verb);
        }
        for word in ["it", "who"] {
            bag.take_all(word, "");
        }
        bag.take_all("noun", "room");
        bag.take_all("noun", "view");
        return Some(SensedEvent::Noise);
    }
    // *The hand is clapped*: which sound is that?
    let claps = bag.find("v", "clap").filter(|at| {
        let is_passive =
            form(&bag.atoms[*at], "v").end == FormEnd::Past && bag.atoms[..*at].iter().any(|atom| atom.is("aux", "be"));
        !(is_passive && bag.has("part", "hand"))
    });
    if let Some(at) = bag.find("noun", "sound").or(claps) {
        bag.use_up(at);
        bag.take_all("noun", "sound");
        bag.take_all("v", "clap");
        bag.take_all("noun", "hand.with");
        if bag.atoms[at].is("v", "clap") {
            bag.take("part", "hand");
        }
        bag.take_all("adj", "loud");
        bag.take_all("poss", "own");
        // *It hears …*: the robot.
        let hears = bag.find("v", "hear").filter(|at| form(&bag.atoms[*at], "v").end == FormEnd::Third);
        if let Some(it) = bag.find("it", "").filter(|it| hears.is_some_and(|at| *it < at)) {
            bag.use_up(it);
        }
        agent(bag);
        bag.take_all("robot", "");
        for verb in ["hear", "exist", "make", "come"] {
            bag.take("v", verb);
        }
        return Some(SensedEvent::Noise);
    }
    None
}

/// The words that are heard.
fn words(bag: &mut Bag, verb: usize) -> Option<Vec<String>> {
    // Nobody but the robot hears: *the child hears you* is none of its senses.
    let hears = bag.atoms[verb].is("v", "hear") && form(&bag.atoms[verb], "v").end != FormEnd::Plain;
    let others = bag.atoms[..verb].iter().any(|atom| atom.is("who", "") && !atom.is("robot", ""));
    let english = matches!(form(&bag.atoms[verb], "v").end, FormEnd::Third | FormEnd::Past | FormEnd::Ing);
    if hears && english && others && !bag.atoms[..verb].iter().any(|atom| atom.is("aux", "be")) {
        return None;
    }
    // *Say “two”* is an order and tells of nobody who says it.
    // The robot hears others, not itself.
    let says = bag.atoms[verb].is("v", "say") && !bag.atoms[verb].is("v", "hear");
    if says
        && bag.has("robot", "")
        && !bag.has("who", "") | bag.atoms.iter().any(|atom| atom.is("who", "you") && atom.is("robot", ""))
    {
        return None;
    }
    let orders = bag.atoms[verb].of("v").is_some_and(|sense| sense.form.end == FormEnd::Plain && sense.arg == "say");
    if orders && !bag.atoms[..verb].iter().any(|atom| atom.is("who", "") || atom.is("none", "who")) {
        return None;
    }
    // 「元気？」と聞いて、「うん」と言ったら: two who speak.
    let speaks = |atom: &Atom| atom.is("v", "say") || atom.is("v", "hear");
    let quotes = bag.atoms.iter().filter(|atom| super::super::act::is_quote(atom)).count();
    if quotes > 1 && bag.atoms.iter().filter(|atom| speaks(atom)).count() > 1 && bag.has("p", "") {
        return None;
    }
    let mut all = Vec::new();
    while let Some(quote) = bag.quote() {
        all.push(quote);
    }
    if !all.is_empty() {
        if bag.take_all("or", "") || all.len() > 1 {
            bag.take_signs(',');
        }
        bag.take_all("noun", "word");
        bag.use_up(verb);
        return Some(all);
    }
    None
}

/// What is seen.
pub(super) fn seen(bag: &mut Bag, not: &mut bool, nobody: bool, nothing: bool) -> Option<SensedEvent> {
    const VERBS: [&str; 9] = ["see", "exist", "come", "appear", "enter", "find", "leave", "know", "show"];
    let mut found: Vec<(&str, usize)> = VERBS.iter().filter_map(|verb| Some((*verb, bag.find("v", verb)?))).collect();
    let is_be = bag.atoms.iter().any(|atom| atom.is("aux", "be"));
    // *Moves left*: a side, and nobody leaves.
    let moves = found.len() > 1 || bag.atoms.iter().any(|atom| atom.is("aux", "be") && !atom.is("aux", "s"));
    found.retain(|(verb, at)| !(*verb == "leave" && moves && bag.atoms[*at].is("side", "")));
    // Somebody who stands comes only where the place is said: *stands in front of you*, 目の前に立つ.
    let has_place = bag.has("noun", "view") || bag.has("noun", "ahead");
    found.retain(|(_, at)| has_place || !bag.atoms[*at].is("pose", ""));
    let somebody = bag.has("who", "") || bag.has("noun", "face");
    let of_kind = bag.has("adj", "known") || bag.has("adj", "new") && somebody || bag.has("whom", "");
    if found.is_empty() && !is_be && !nobody && !of_kind {
        return None;
    }
    // Somebody who sees something is not the robot: 子どもがボールを見たら.
    let sees = (0..bag.atoms.len()).find(|at| bag.is_free(*at) && bag.atoms[*at].is("tv", ""));
    if let Some(at) = sees
        && !form(&bag.atoms[at], "tv").passive
        && bag.atoms.windows(2).any(|pair| pair[0].is("who", "") && pair[1].is("p", "ga"))
    {
        return None;
    }
    // Somebody who sees something is not the robot.
    if let (Some(at), Some(who)) = (bag.find("v", "see").or_else(|| bag.find("v", "find")), bag.find("who", "")) {
        let active = !form(&bag.atoms[at], "v").passive;
        let end = form(&bag.atoms[at], "v").end;
        let english = matches!(end, FormEnd::Plain | FormEnd::Third | FormEnd::Ing | FormEnd::Past);
        let robot_before = bag.find("robot", "").is_some_and(|robot| robot < at);
        let is_passive = bag.atoms[..at].iter().any(|atom| atom.is("aux", "be")) && end == FormEnd::Past;
        if english && active && who < at && !robot_before && !is_passive {
            return None;
        }
    }
    // *It sees …*: the robot.
    if let Some(at) = bag.find("v", "see")
        && let Some(it) = bag.find("it", "").filter(|it| *it < at && bag.atoms[*it].is("robot", ""))
        && form(&bag.atoms[at], "v").end == FormEnd::Third
    {
        bag.use_up(it);
    }
    let has = |verb: &str| found.iter().any(|(known, _)| *known == verb);
    if has("leave") {
        let said = (0..bag.atoms.len()).any(|at| bag.atoms[at].sense("v", "leave").is_some_and(|sense| sense.form.not));
        *not = nobody || (!*not || !said && nothing);
    }
    if found.is_empty() && !(has_place || of_kind || nobody) && says_nothing_of(bag) {
        return None;
    }
    for (_, at) in &found {
        bag.use_up(*at);
    }
    if has("show") {
        shown(bag);
    }
    bag.take_all("noun", "view");
    bag.take_all("noun", "ahead");
    if !bag.has("who", "") || !found.is_empty() || is_be {
        bag.take_all("robot", "");
    }
    if bag.take("noun", "ball").is_some() {
        // *The ball is not red*: which one is?
        let place = |kind: &str| bag.atoms.iter().rposition(|atom| atom.is(kind, ""));
        let said_of = bag.atoms.iter().position(|atom| atom.is("noun", "ball")) < place("color");
        if *not && said_of && place("color").is_some() {
            return None;
        }
        return ball(bag);
    }
    if bag.take("noun", "mark").is_some() {
        return mark(bag);
    }
    if bag.has("color", "") && !bag.has("part", "") {
        bag.take_all("noun", "thing");
        bag.take_all("noun", "colored");
        return Some(SensedEvent::Thing(color(bag)));
    }
    // *It is somebody new*
    let of_somebody = bag.has("whom", "") || bag.has("who", "") && (bag.has("adj", "new") || bag.has("adj", "known"));
    if bag.take("it", "").is_some() && !(of_somebody && is_be) {
        return Some(SensedEvent::ItSeen);
    }
    if let Some(person) = person(bag, nobody, has("know")) {
        return person;
    }
    // Japanese leaves out what was said before.
    let says_nothing = !bag.atoms.iter().any(|atom| atom.is("noun", "") || atom.is("part", "") || atom.is("color", ""));
    (says_nothing && (has("see") || has("leave"))).then_some(SensedEvent::ItSeen)
}

/// True if somebody is named and nothing is said of them: *the child is*.
fn says_nothing_of(bag: &Bag) -> bool {
    let other = ["noun", "color", "none", "adj", "it"].iter().any(|kind| bag.has(kind, ""));
    bag.has("who", "") && !other
}

/// *The child shows you the ball*: the ball is what is seen.
fn shown(bag: &mut Bag) {
    let shows = |atom: &Atom| ["ball", "mark"].iter().any(|noun| atom.is("noun", noun)) || atom.is("color", "");
    if bag.atoms.iter().any(shows) {
        agent(bag);
        bag.take_all("robot", "");
        bag.take_all("poss", "own");
    }
}

/// A ball, or one of several.
fn ball(bag: &mut Bag) -> Option<SensedEvent> {
    // *A ball of any colour*: the robot looks for one.
    if bag.take("noun", "colored").is_some() && !bag.has("color", "") {
        return None;
    }
    // *It is the ball that …*
    bag.take("it", "");
    let mut all = vec![SensedEvent::Ball(color(bag))];
    while bag.has("or", "") && bag.has("color", "") {
        if !bag.has_sign(',') {
            bag.take("or", "");
        }
        bag.take_sign(',');
        bag.take("noun", "ball");
        let at = bag.find("color", "")?;
        let next = color(bag);
        if bag.is_free(at) {
            break;
        }
        all.push(SensedEvent::Ball(next));
    }
    if all.len() > 1 { Some(SensedEvent::Any(all)) } else { all.pop() }
}

/// A printed mark, or one of several.
fn mark(bag: &mut Bag) -> Option<SensedEvent> {
    let number = bag.measure(|measure| match measure {
        CountedNumber::Number(value) | CountedNumber::Mark(value)
            if (1.0..=1_000.0).contains(&value) && value.fract() == 0.0 =>
        {
            Some(value as u32)
        }
        _ => None,
    });
    bag.take("noun", "count");
    let mut all = vec![SensedEvent::Mark(number.map(|(number, _)| number))];
    while bag.has("or", "") {
        let more = bag.measure(|measure| match measure {
            CountedNumber::Number(value) | CountedNumber::Mark(value)
                if (1.0..=1_000.0).contains(&value) && value.fract() == 0.0 =>
            {
                Some(value as u32)
            }
            _ => None,
        });
        let Some((more, _)) = more else { break };
        if !bag.has_sign(',') {
            bag.take("or", "");
        }
        bag.take_sign(',');
        bag.take("noun", "mark");
        all.push(SensedEvent::Mark(Some(more)));
    }
    if all.len() > 1 { Some(SensedEvent::Any(all)) } else { all.pop() }
}

/// Somebody: a face.
fn person(bag: &mut Bag, nobody: bool, knows: bool) -> Option<Option<SensedEvent>> {
    let new = bag.take_all("adj", "new");
    let known = bag.take_all("adj", "known") || (knows && !new);
    let another = bag.take_all("adj", "another") | bag.has("who", "else");
    let somebody = ["who", "whom"].iter().any(|kind| bag.has(kind, ""));
    let is_person = bag.has("noun", "face") || somebody || nobody || new || known;
    if is_person {
        bag.take_all("whom", "");
        bag.take_all("noun", "face");
        bag.take_all("robot", "");
        agent(bag);
        let who = match (new, known, another) {
            (true, false, false) => WhichFace::New,
            (false, true, false) => WhichFace::Known,
            (false, false, true) => WhichFace::Another,
            (false, false, false) => WhichFace::Anybody,
            _ => return Some(None),
        };
        return Some(Some(SensedEvent::Face(who)));
    }
    None
}

/// The colour of what is seen, red if none is said; a colour that no sense has stays in doubt.
pub(super) fn color(bag: &mut Bag) -> &'static str {
    ["red", "green", "blue"].into_iter().find(|color| bag.take("color", color).is_some()).unwrap_or("red")
}
