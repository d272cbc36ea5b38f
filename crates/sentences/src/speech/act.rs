//! What a clause means that tells what to do.

use super::atoms::{Atom, AtomValue as Said, CountedNumber, form};
use super::clause::{Bag, Meant, cond, gaps};
use super::lexicon::FormEnd;
use super::meaning::{Act, FollowedTarget, MeantValue, Of, SensedEvent};
use crate::does::CHANCES_MAX;

/// How far a raised and a lowered arm stands, in radians, and an open and a closed hand.
const RAISED: f64 = -1.0;
const LOWERED: f64 = 1.4;

/// The head turns so far to a side, and up or down, where nobody says it: about 30 and 20 degrees.
const TURNED: f64 = 0.52;
const NODDED: f64 = 0.35;

/// What a clause says to do; several where one verb has several objects.
pub(super) fn act(atoms: &[Atom]) -> Option<Meant<Vec<Act>>> {
    if atoms.is_empty() || atoms.len() > 60 {
        return None;
    }
    let gaps = gaps(atoms);
    if !gaps.is_empty() {
        return Some(Meant { what: Vec::new(), left: gaps });
    }
    let mut bag = Bag::new(atoms);
    let bag = &mut bag;
    bag.take_all("adv", "eachtime");
    bag.take_all("adv", "again");
    bag.take_all("robot", "");
    subject(bag);
    bag.take_all("adv", "first");
    let denies = bag.take("not", "").is_some()
        || atoms
            .iter()
            .any(|atom| atom.senses.iter().any(|sense| sense.form.not && matches!(sense.kind, "v" | "do" | "pose")));
    if denies {
        // Only what was said to be done: its verb, perhaps with *it*.
        let verb = bag.take("v", "").or_else(|| bag.take("do", "")).or_else(|| bag.take("pose", ""))?;
        let words = bag.atoms[verb].is("v", "say");
        bag.take_all("it", "");
        bag.take_all("part", "hand");
        let period = bag.measure(|measure| if let CountedNumber::Time(ms) = measure { Some(ms) } else { None });
        if period.is_some() {
            bag.take("cmp", "atleast");
        }
        let what = period.map_or(Act::Not, |(ms, _)| Act::NotFor(ms, words));
        return Some(Meant { what: vec![what], left: bag.left() });
    }
    // *Keep saying …*
    let keeps = bag.find("v", "keep").filter(|_| {
        let goes_on =
            |sense: &super::lexicon::WritingSense| matches!(sense.kind, "v" | "do") && sense.form.end == FormEnd::Ing;
        atoms.iter().any(|atom| atom.senses.iter().any(goes_on) && !atom.is("v", "keep"))
    });
    keeps.into_iter().for_each(|at| bag.use_up(at));
    let instead = bag.take("adv", "instead").is_some();
    let mut acts = done(bag)?;
    // *Wave twice*
    if let [Act::Gesture(_) | Act::Say(_) | Act::Play(_) | Act::PlayFile(_)] = acts[..]
        && let Some(times) = repeated(bag)
    {
        acts.push(Act::Repeats(times));
    }
    if instead {
        acts.push(Act::Instead);
    }
    // *Turn the eyes green for 3 seconds*
    if let [Act::Eyes(color)] = acts[..]
        && color != "off"
        && !bag.has("cmp", "")
        && let Some((ms, _)) =
            bag.measure(|measure| if let CountedNumber::Time(ms) = measure { Some(ms) } else { None })
    {
        bag.take("adj", "during");
        acts.push(Act::GoesOut(ms));
    }
    if matches!(acts[..], [Act::Follow(..), ..] | [Act::Eyes(_), ..]) {
        bag.take_all("adv", "ongoing");
    } else if keeps.is_some() {
        acts.push(Act::Keeps);
    }
    // *Nod for me*, *bow to the child*: nobody else is meant.
    if acts.iter().all(|act| matches!(act, Act::Gesture(_) | Act::Pose(_) | Act::Play(_) | Act::Eyes(_))) {
        for at in 1..atoms.len() {
            let whom = atoms[at].is("who", "") && !atoms[at].is("poss", "");
            let before = atoms[..at].iter().rposition(|atom| !atom.is("void", ""));
            if whom && before.is_some_and(|before| atoms[before].is("prep", "for") || atoms[before].is("prep", "to")) {
                bag.use_up(at);
            }
        }
    }
    Some(Meant { what: acts, left: bag.left() })
}

/// The most times that something is done at one go.
const REPEATS_MAX: f64 = 10.0;

/// Uses how often something is done, if that is more than once.
fn repeated(bag: &mut Bag) -> Option<u32> {
    let often = |times: f64| ((2.0..=REPEATS_MAX).contains(&times) && times.fract() == 0.0).then_some(times as u32);
    if bag.take("times", "2").is_some() {
        return Some(2);
    }
    let times = |measure| if let CountedNumber::Times(times) = measure { often(times) } else { None };
    bag.measure(times).map(|(times, _)| times)
}

/// Uses *it* where the robot is what does something: *it makes a beep*.
fn subject(bag: &mut Bag) {
    let Some(it) = bag.atoms.iter().position(|atom| !atom.is("void", "")) else { return };
    let does = |atom: &Atom| {
        atom.senses.iter().any(|sense| {
            matches!(sense.kind, "v" | "do" | "pose") && matches!(sense.form.end, FormEnd::Plain | FormEnd::Third)
        })
    };
    let is_robot = bag.atoms[it].is("it", "") && bag.atoms[it].is("robot", "");
    if is_robot && bag.atoms.get(it + 1).is_some_and(does) {
        bag.use_up(it);
    }
}

/// Whether a clause begins as what to do does: with a plain verb, in English.
pub(super) fn is_order(atoms: &[Atom]) -> bool {
    let mut robot = false;
    for atom in atoms {
        if atom.is("robot", "") {
            robot = true;
            continue;
        }
        let verbs = atom.senses.iter().filter(|sense| matches!(sense.kind, "v" | "do" | "pose" | "gap"));
        let mut any = false;
        for sense in verbs {
            any = true;
            let keeps = sense.form.end == FormEnd::Ing;
            if sense.form.end == FormEnd::Plain || (robot && sense.form.end == FormEnd::Third) || keeps {
                return true;
            }
        }
        if any {
            return false;
        }
        let filler = ["void", "prep", "aux", "adv", "not", "chance", "poss"].iter().any(|kind| atom.is(kind, ""));
        // *A high beep*
        let qualifies = atom.is("adj", "high") || atom.is("adj", "low");
        if !filler && !qualifies {
            return atom.is("adj", "brighter")
                || atom.is("adj", "darker")
                || atom.is("adj", "far")
                || atom.is("cmp", "more")
                || atom.is("adj", "near")
                || atom.is("cmp", "less")
                || atom.is("noun", "eyes")
                || atom.is("part", "eyes")
                || atom.is("color", "");
        }
    }
    false
}

/// True if the eyes follow something: *follow me with your eyes*.
fn follows_with_eyes(bag: &Bag) -> bool {
    ["follow", "look"].iter().any(|verb| bag.has("v", verb))
        && ["who", "noun", "it"].iter().any(|kind| bag.has(kind, ""))
        && bag.find("color", "").is_none()
}

fn done(bag: &mut Bag) -> Option<Vec<Act>> {
    if bag.has("adj", "brighter") || bag.has("adj", "darker") {
        return nearer(bag).map(|act| vec![act]);
    }
    if let Some(at) = bag.find("v", "count") {
        bag.use_up(at);
        return count(bag, at).map(|act| vec![act]);
    }
    if let Some(at) = bag.find("v", "remember") {
        return remember(bag, at).map(|act| vec![act]);
    }
    if bag.take("v", "unfollow").is_some() {
        return unfollow(bag).map(|act| vec![act]);
    }
    // *Let me know with a beep*, 音で知らせる
    let with_sound = bag.atoms.iter().any(|atom| atom.is("v", "say") && atom.is("v", "play")) && plays_sound(bag);
    if with_sound && !bag.atoms.iter().any(is_quote) {
        return sound(bag).map(|act| vec![act]);
    }
    if let Some(at) = bag.find("v", "say") {
        bag.use_up(at);
        if let Some(acts) = said_count(bag, at) {
            return Some(acts);
        }
        return say(bag).map(|act| vec![act]);
    }
    if let Some(at) = bag.find("v", "display") {
        bag.use_up(at);
        if form(&bag.atoms[at], "v").end != FormEnd::Plain && bag.left().is_empty() {
            return Some(vec![Act::Show(MeantValue::It)]);
        }
        return value(bag).map(|value| vec![Act::Show(value)]);
    }
    if bag.has("part", "eyes") && !follows_with_eyes(bag) || bag.has("noun", "brightness") {
        return eyes(bag);
    }
    if let Some(act) = follow(bag) {
        return Some(vec![act]);
    }
    if let Some(act) = joint(bag) {
        return Some(act);
    }
    if let Some((gesture, at)) = bag.arg("do") {
        return gesture_of(bag, gesture, at).map(|act| vec![act]);
    }
    if let Some((pose, _)) = bag.arg("pose") {
        bag.take_all("v", "turn");
        return Some(vec![Act::Pose(pose)]);
    }
    if bag.take("v", "walk").is_some() {
        bag.take_all("noun", "ahead");
        bag.take_all("noun", "view");
        return Some(vec![Act::Walk]);
    }
    if let Some(act) = sound(bag) {
        return Some(vec![act]);
    }
    // *make them red*, *red*: of eyes before.
    let turns = bag.take("v", "turn").is_some() || bag.take("v", "shine").is_some();
    // *Turn them off*
    if bag.has("v", "off") && bag.find("part", "").is_none() && !bag.has("noun", "") {
        bag.take_all("v", "off");
        bag.take_all("it", "");
        return Some(vec![Act::Color("off")]);
    }
    if let Some((color, _)) = bag.arg("color") {
        bag.take_all("it", "");
        bag.take_all("noun", "colored");
        return Some(vec![Act::Color(color)]);
    }
    if turns && bag.has("adj", "bright") {
        bag.take_all("it", "");
        return bright(bag).map(|act| vec![act]);
    }
    if bag.take("v", "again").is_some() {
        return Some(vec![Act::Again]);
    }
    if bag.take("nothing.do", "").is_some() {
        return Some(vec![Act::Nothing]);
    }
    None
}

/// Returns the act of remembering somebody; none if nothing is named: *save*.
fn remember(bag: &mut Bag, at: usize) -> Option<Act> {
    bag.use_up(at);
    let has_object = bag.has("noun", "") || ["it", "who", "whom"].iter().any(|kind| bag.has(kind, ""));
    if !has_object && form(&bag.atoms[at], "v").end == FormEnd::Plain {
        return None;
    }
    for word in ["face", "name"] {
        bag.take("noun", word);
    }
    for kind in ["it", "who", "poss"] {
        bag.take_all(kind, "");
    }
    bag.take_all("adj", "new");
    Some(Act::Remember)
}

/// True if a sound is spoken of that can be played: a voice cannot.
fn plays_sound(bag: &Bag) -> bool {
    bag.has("noun", "sound") && !bag.has("noun", "voice")
}

/// Returns the act of not following any more: it, or what is named.
fn unfollow(bag: &mut Bag) -> Option<Act> {
    bag.take_all("it", "");
    bag.take_all("poss", "own");
    if bag.take("noun", "ball").is_some() {
        bag.take("color", "red");
        return Some(Act::Unfollow(Some(FollowedTarget::Ball)));
    }
    if bag.take_all("noun", "face") | bag.take_all("who", "") {
        bag.take_all("who", "");
        return Some(Act::Unfollow(Some(FollowedTarget::Face)));
    }
    Some(Act::Unfollow(None))
}

fn sound(bag: &mut Bag) -> Option<Act> {
    let beeps = bag.take("v", "beep").is_some();
    let gives = bag.has("v", "give");
    let plays = ["play", "turn", "make", "give"].iter().any(|verb| bag.has("v", verb));
    let plays = plays && plays_sound(bag);
    if !beeps && !plays {
        return None;
    }
    for verb in ["play", "turn", "make", "give"] {
        bag.take_all("v", verb);
    }
    if gives {
        bag.take_all("who", "");
    }
    bag.take_all("noun", "sound");
    bag.take_all("noun", "file");
    if let Some(file) = bag.quote() {
        return Some(Act::PlayFile(file));
    }
    if bag.take("adj", "high").is_some() {
        return Some(Act::Play("high"));
    }
    if bag.take("adj", "low").is_some() {
        return Some(Act::Play("low"));
    }
    Some(Act::Play("beep"))
}

fn nearer(bag: &mut Bag) -> Option<Act> {
    let darker = bag.take_all("adj", "darker");
    bag.take_all("adj", "brighter");
    bag.take_all("v", "dim");
    let near = bag.take_all("adj", "near") | bag.take_all("cmp", "less") | bag.take_all("v", "approach");
    let far = bag.take_all("adj", "far") | bag.take_all("cmp", "more");
    if near == far || darker != far {
        return None;
    }
    bag.take_all("cmp", "than");
    bag.take("part", "eyes")?;
    for verb in ["shine", "turn", "exist", "come", "go"] {
        bag.take_all("v", verb);
    }
    bag.take_all("noun", "brightness");
    bag.take_signs(',');
    bag.take_all("adj", "bright");
    if bag.take("noun", "ball").is_some() {
        let color = bag.arg("color").map_or("red", |(color, _)| color);
        return ["red", "green", "blue"].contains(&color).then_some(Act::Nearer(Of::Ball(color)));
    }
    if bag.take_all("who", "") | bag.take_all("noun", "face") {
        return Some(Act::Nearer(Of::Person));
    }
    if bag.take("noun", "thing").is_some() {
        bag.take_all("noun", "ahead");
        return Some(Act::Nearer(Of::Ahead("nearest")));
    }
    bag.take_all("it", "");
    Some(Act::Nearer(Of::It))
}

fn count(bag: &mut Bag, at: usize) -> Option<Act> {
    bag.take_all("noun", "count");
    bag.take_all("time", "");
    // What is counted is said before or after the verb.
    let rest: Vec<Atom> = (0..bag.atoms.len())
        .filter(|other| *other != at && bag.is_free(*other))
        .map(|other| bag.atoms[other].clone())
        .collect();
    let counted = cond(&rest)?;
    if counted.left.is_empty() {
        (0..bag.atoms.len()).for_each(|at| bag.use_up(at));
    } else {
        for (at, atom) in bag.atoms.iter().enumerate() {
            if !counted.left.contains(&atom.span) {
                bag.use_up(at);
            }
        }
    }
    Some(Act::Count(Box::new(counted.what)))
}

/// *Tell me how many times the hand was touched*: what is counted, and said each time.
fn said_count(bag: &mut Bag, at: usize) -> Option<Vec<Act>> {
    let counts = bag.find("noun", "count")?;
    if bag.atoms.iter().any(is_quote) || !bag.atoms.iter().any(|atom| atom.is("v", "") && !atom.is("v", "say")) {
        return None;
    }
    let mut rest: Vec<Atom> = bag.atoms.to_vec();
    rest.retain(|atom| atom.span != bag.atoms[at].span && atom.span != bag.atoms[counts].span);
    let counted = cond(&rest).filter(|counted| {
        let moment = matches!(
            counted.what.what,
            SensedEvent::Touch(..) | SensedEvent::Button(_) | SensedEvent::Noise | SensedEvent::Words(_)
        );
        counted.left.is_empty() && counted.what.times.is_none() && !counted.what.not && moment
    })?;
    (0..bag.atoms.len()).for_each(|at| bag.use_up(at));
    Some(vec![Act::Count(Box::new(counted.what)), Act::SayValue(MeantValue::Count)])
}

/// One of several texts, by chance: *say “a” or “b” at random*.
fn any_of(bag: &mut Bag) -> Option<Act> {
    let quotes = bag.atoms.iter().filter(|atom| is_quote(atom)).count();
    if !(2..=CHANCES_MAX).contains(&quotes) || !bag.has("chance", "") || bag.has("and", "") {
        return None;
    }
    let texts: Vec<String> = std::iter::from_fn(|| bag.quote()).collect();
    if texts.iter().any(String::is_empty) {
        return None;
    }
    bag.take_all("chance", "");
    bag.take_all("or", "");
    bag.take_signs(',');
    bag.take_all("who", "");
    bag.take_all("noun", "word");
    Some(Act::SayAny(texts))
}

fn say(bag: &mut Bag) -> Option<Act> {
    if let Some(any) = any_of(bag) {
        return Some(any);
    }
    if let Some(text) = bag.quote() {
        // To whom does not count: the robot says it aloud.
        bag.take_all("who", "");
        bag.take_all("noun", "word");
        if text.is_empty() {
            return None;
        }
        return Some(Act::Say(text));
    }
    bag.take_all("v", "exist");
    // 数えて言う: what was counted.
    let is_left_out = bag
        .atoms
        .iter()
        .any(|atom| atom.of("v").is_some_and(|sense| sense.arg == "say" && sense.form.end != FormEnd::Plain));
    if is_left_out && bag.left().is_empty() {
        return Some(Act::SayValue(MeantValue::It));
    }
    // *Count the presses and tell me*
    let tells = bag.atoms.iter().any(|atom| atom.is("v", "say") && atom.span.len() > 1);
    if tells && bag.left().is_empty() {
        return Some(Act::SayValue(MeantValue::Counted));
    }
    value(bag).map(Act::SayValue)
}

/// A value that a sense tells.
fn value(bag: &mut Bag) -> Option<MeantValue> {
    if bag.take("noun", "battery").is_some() {
        bag.take_all("noun", "level");
        bag.take_all("v", "exist");
        bag.take_all("adj", "full");
        return Some(MeantValue::Charge);
    }
    // *My name is Nao* is what is said, and no name that is known.
    let name = bag.find("noun", "name");
    if name.is_some_and(|at| bag.atoms.get(at + 1).is_some_and(|is| is.is("aux", "be")) && at + 2 < bag.atoms.len()) {
        return None;
    }
    if bag.take("noun", "name").is_some() {
        bag.take_all("it", "");
        bag.take_all("who", "");
        bag.take_all("poss", "");
        return Some(MeantValue::Name);
    }
    let far = bag.take_all("noun", "distance");
    if far {
        // 人と人の距離: only that to the robot is known.
        if bag.atoms.iter().any(|atom| atom.is("p", "to")) && !bag.has("robot", "") {
            return None;
        }
        bag.take_all("adj", "far");
        for verb in ["exist", "see"] {
            bag.take_all("v", verb);
        }
        bag.take_all("adj", "away");
        bag.take_all("robot", "");
        bag.take_all("lead", "until");
        if bag.take("noun", "ball").is_some() {
            let color = bag.arg("color").map_or("red", |(color, _)| color);
            return ["red", "green", "blue"].contains(&color).then_some(MeantValue::Distance(Of::Ball(color)));
        }
        if bag.take_all("who", "") | bag.take_all("noun", "face") {
            return Some(MeantValue::Distance(Of::Person));
        }
        if bag.take_all("noun", "thing") | bag.take_all("noun", "ahead") {
            bag.take_all("noun", "ahead");
            return Some(MeantValue::Distance(Of::Ahead("nearest")));
        }
        bag.take_all("it", "");
        return Some(MeantValue::Distance(Of::It));
    }
    if bag.take_all("noun", "clock") {
        bag.take_all("it", "");
        return Some(MeantValue::Clock);
    }
    if bag.take_all("noun", "posture") {
        return Some(MeantValue::Pose);
    }
    if bag.take_all("noun", "people") {
        bag.take_all("noun", "view");
        bag.take_all("who", "");
        bag.take_all("v", "exist");
        return Some(MeantValue::People);
    }
    let counts = bag.take_all("noun", "count");
    if counts && bag.take_all("noun", "mark") {
        // *Of any mark you see*
        bag.take_all("robot", "");
        bag.take_all("v", "see");
        bag.take_all("v", "exist");
        return Some(MeantValue::Mark);
    }
    if counts && bag.take_all("who", "") | bag.take_all("noun", "face") {
        bag.take_all("who", "");
        for verb in ["exist", "see", "come"] {
            bag.take_all("v", verb);
        }
        bag.take_all("robot", "");
        bag.take_all("noun", "view");
        return Some(MeantValue::People);
    }
    if counts {
        bag.take_all("it", "");
        return Some(MeantValue::Count);
    }
    if bag.take_all("noun", "word") {
        for verb in ["hear", "say"] {
            bag.take_all("v", verb);
        }
        bag.take_all("who", "");
        bag.take_all("robot", "");
        return Some(MeantValue::Word);
    }
    bag.take("it", "that").map(|_| MeantValue::It)
}

fn eyes(bag: &mut Bag) -> Option<Vec<Act>> {
    bag.take_all("part", "eyes");
    let bright = bag.take_all("noun", "brightness");
    for verb in ["turn", "shine", "make", "come", "play", "set", "keep"] {
        bag.take_all("v", verb);
    }
    bag.take_all("noun", "colored");
    bag.take_all("noun", "light");
    let dims = bag.take_all("v", "dim");
    if bright || dims || bag.has("adj", "bright") {
        return self::bright(bag).map(|act| vec![act]);
    }
    if bag.take_all("v", "off") {
        return Some(vec![Act::Eyes("off")]);
    }
    let (color, _) = bag.arg("color")?;
    Some(vec![Act::Eyes(color)])
}

fn bright(bag: &mut Bag) -> Option<Act> {
    let part = bag.measure(|measure| match measure {
        CountedNumber::Share(value) if (0.0..=100.0).contains(&value) => Some(value / 100.0),
        CountedNumber::Number(value) if (0.0..=1.0).contains(&value) => Some(value),
        _ => None,
    });
    if let Some((part, _)) = part {
        bag.take_all("adj", "bright");
        return Some(Act::Shine(part));
    }
    if bag.take_all("adj", "half") {
        bag.take_all("adj", "bright");
        return Some(Act::Shine(0.5));
    }
    let fully = bag.take_all("adj", "full");
    bag.take_all("adj", "bright");
    fully.then_some(Act::Shine(1.0))
}

fn follow(bag: &mut Bag) -> Option<Act> {
    let points = bag.find("v", "point");
    let walks = bag.find("v", "walk").or_else(|| bag.find("v", "approach")).or_else(|| bag.find("v", "go"));
    let looks = bag.find("v", "follow").or_else(|| bag.find("v", "look"));
    let at = points.or(looks).or(walks)?;
    // The robot itself is pointed to by a gesture.
    if points.is_some() && bag.has("noun", "self") {
        bag.use_up(at);
        bag.take("noun", "self");
        return Some(Act::Gesture("Me"));
    }
    let has_target = bag.has("noun", "ball") || bag.has("noun", "face") || bag.has("who", "") || bag.has("it", "");
    let lacks = |at: usize| bag.atoms[at].is("v", "follow") || bag.atoms[at].is("v", "approach");
    // 右腕で指さす: what was seen.
    let has_arm = ["arm", "arm.left", "arm.right"].iter().any(|part| bag.has("part", part));
    let may_lack = if points.is_some() { has_arm } else { looks.is_some_and(lacks) || walks.is_some_and(lacks) };
    if !has_target && !may_lack {
        return None;
    }
    bag.use_up(at);
    for verb in ["follow", "look", "keep", "walk", "go", "point", "approach"] {
        bag.take_all("v", verb);
    }
    // *The person in front of you*
    bag.take_all("noun", "ahead");
    let target = if bag.take("noun", "ball").is_some() {
        bag.take("color", "red");
        bag.take("noun", "colored");
        FollowedTarget::Ball
    } else if bag.take_all("noun", "face") | bag.take_all("who", "") {
        bag.take_all("who", "");
        bag.take_all("poss", "");
        FollowedTarget::Face
    } else {
        bag.take_all("it", "");
        FollowedTarget::It
    };
    // *Anyone you see*
    if bag.has("v", "see") && bag.atoms.iter().any(|atom| atom.is("robot", "")) {
        bag.take("robot", "");
        bag.take("v", "see");
    }
    let nearest = bag.take_all("adj", "nearest") | bag.take_all("adj", "near");
    let side = bag.arg("side").map(|(side, _)| side);
    let arm = bag.arg_is("part", "arm") || (points.is_some() && bag.arg_is("part", "hand"));
    let own_arm =
        ["arm.left", "arm.right", "hand.left", "hand.right"].iter().find(|part| bag.take("part", part).is_some());
    let side = side.or_else(|| own_arm.map(|part| if part.ends_with("left") { "left" } else { "right" }));
    let arm = arm || own_arm.is_some();
    let head = bag.take_all("part", "head") | bag.take_all("part", "eyes");
    let body = bag.take_all("part", "body");
    let effector = match (arm, side, nearest) {
        (true, Some("left"), _) => "LArm",
        (true, Some("right"), _) => "RArm",
        (true, None, true) => "Nearest",
        (true, None, false) => "Nearest",
        (false, None, false) => {
            if points.is_some() {
                "Nearest"
            } else {
                "None"
            }
        }
        _ => return None,
    };
    let moves = walks.is_some_and(|at| looks.is_none() || bag.atoms[at].is("v", "walk")) && points.is_none();
    let mode = match (moves, body, head, effector) {
        (true, false, _, _) => "Move",
        (false, true, _, _) => "WholeBody",
        (false, false, true, _) | (false, false, false, "None") => "Head",
        (false, false, false, _) => "Arm",
        (true, true, ..) => return None,
    };
    Some(Act::Follow(target, mode, effector))
}

/// Arms, hands and the head moved by themselves.
fn joint(bag: &mut Bag) -> Option<Vec<Act>> {
    let verb =
        ["open", "close", "raise", "lower", "put", "turn", "look"].into_iter().find(|verb| bag.has("v", verb))?;
    let at = bag.find("v", verb)?;
    // *… and lower them again*
    if !bag.has("part", "") && matches!(verb, "open" | "close" | "raise" | "lower") && bag.has("it", "") {
        bag.use_up(at);
        bag.take_all("it", "");
        return Some(vec![Act::MoveThem(verb)]);
    }
    // *Put it down again*, 3秒後に下ろす
    let puts = (bag.has("dir", "up") || bag.has("dir", "down")) && verb == "put" && bag.has("it", "");
    let left_out = matches!(verb, "open" | "close" | "raise" | "lower")
        && bag.left().len() == 1
        && form(&bag.atoms[at], "v").end != FormEnd::Plain;
    if !bag.has("part", "") && (puts || left_out) {
        bag.use_up(at);
        bag.take_all("it", "");
        let up = bag.take("dir", "up").is_some();
        let down = bag.take("dir", "down").is_some();
        return Some(vec![Act::MoveThem(if up {
            "raise"
        } else if down {
            "lower"
        } else {
            verb
        })]);
    }
    if !bag.has("part", "") && verb != "look" {
        return None;
    }
    let (part, part_at) = if verb == "look" && !bag.has("part", "head") {
        ("head", None)
    } else {
        bag.arg("part").map(|(part, at)| (part, Some(at)))?
    };
    let (part, own) = part.split_once('.').map_or((part, None), |(part, side)| (part, Some(side)));
    bag.use_up(at);
    let puts = part != "head" && matches!(verb, "put" | "turn");
    let verb = match verb {
        _ if puts && bag.take("dir", "up").is_some() => "raise",
        _ if puts && bag.take("dir", "down").is_some() => "lower",
        verb => verb,
    };
    let both = bag.take("adj", "both").is_some() || part_at.is_some_and(|at| bag.atoms[at].is("plural", ""));
    let side = own.or_else(|| bag.arg("side").map(|(side, _)| side));
    let sides: Vec<&str> = match (part, side, both) {
        ("hand" | "arm", Some("both"), _) | ("hand" | "arm", None, true) => vec!["left", "right"],
        ("hand" | "arm", Some(side), _) => vec![side],
        ("head", _, false) => vec![side.unwrap_or("")],
        _ => return None,
    };
    let one = |side: &str| -> Option<Act> {
        let (hand, arm) = if side == "left" { ("LHand", "LShoulderPitch") } else { ("RHand", "RShoulderPitch") };
        let joint = match (part, verb) {
            ("hand", "open" | "close") => hand,
            ("arm" | "hand", "raise" | "lower") => arm,
            _ => return None,
        };
        moved_by(joint, verb)
    };
    if part != "head" {
        return sides.into_iter().map(one).collect();
    }
    let angle = bag.measure(|measure| if let CountedNumber::Angle(value) = measure { Some(value.abs()) } else { None });
    let up = bag.take("dir", "up").is_some();
    let down = !up && bag.take("dir", "down").is_some();
    let ahead = bag.take_all("noun", "ahead");
    // How far is left to the robot unless somebody says it.
    let angle = angle.or_else(|| (!ahead).then_some((if up || down { NODDED } else { TURNED }, 0)));
    let act = match (side, up, down, ahead, angle) {
        (Some("left"), false, false, false, Some((angle, _))) => Act::Move("HeadYaw", angle),
        (Some("right"), false, false, false, Some((angle, _))) => Act::Move("HeadYaw", -angle),
        (None, true, false, false, Some((angle, _))) => Act::Move("HeadPitch", -angle),
        (None, false, true, false, Some((angle, _))) => Act::Move("HeadPitch", angle),
        (None, false, false, true, None) => Act::Move("HeadYaw", 0.0),
        _ => return None,
    };
    Some(vec![act])
}

/// Returns the act of a verb with a joint.
pub(super) fn moved_by(joint: &'static str, verb: &str) -> Option<Act> {
    match (joint, verb) {
        ("LHand" | "RHand", "open") => Some(Act::Move(joint, 1.0)),
        ("LHand" | "RHand", "close") => Some(Act::Move(joint, 0.0)),
        ("LShoulderPitch" | "RShoulderPitch", "raise") => Some(Act::Move(joint, RAISED)),
        ("LShoulderPitch" | "RShoulderPitch", "lower") => Some(Act::Move(joint, LOWERED)),
        _ => None,
    }
}

fn gesture_of(bag: &mut Bag, gesture: &'static str, at: usize) -> Option<Act> {
    bag.take_all("do", gesture);
    match gesture {
        "Hey" => {
            // It waves with its right arm if nobody says otherwise.
            let own_left = bag.take("part", "hand.left").is_some() | bag.take("part", "arm.left").is_some();
            let side = bag.arg("side").map(|(side, _)| side);
            for part in ["hand", "arm", "hand.right", "arm.right"] {
                bag.take("part", part);
            }
            if own_left || side == Some("left") {
                bag.take_all("who", "");
                bag.take_all("it", "");
                return Some(Act::Gesture("HeyLeft"));
            }
            bag.take_all("who", "");
            bag.take_all("it", "");
            bag.take_all("noun", "hello");
        }
        "Yes" | "No" => {
            bag.take("part", "head");
        }
        "Bow" => {
            bag.take("part", "head");
            bag.take_all("who", "");
        }
        "HighFive" => {
            bag.take_all("who", "");
        }
        "Clap" => {
            bag.take("part", "hand");
        }
        _ => {}
    }
    let _ = at;
    Some(Act::Gesture(gesture))
}

impl Bag<'_> {
    /// Uses an atom that means this; whether there was one.
    fn arg_is(&mut self, kind: &str, arg: &str) -> bool {
        self.take(kind, arg).is_some()
    }
}

/// The form in which a Japanese clause ends that tells what to do.
pub(super) fn ends(atoms: &[Atom]) -> Option<FormEnd> {
    let last = atoms.iter().rev().find(|atom| !atom.is("void", ""))?;
    let kinds = ["v", "do", "pose", "gap"];
    kinds.iter().find(|kind| last.is(kind, "")).map(|kind| form(last, kind).end)
}

/// Whether a text in an atom is quoted.
pub(super) fn is_quote(atom: &Atom) -> bool {
    matches!(atom.value, Said::Quote(_))
}
