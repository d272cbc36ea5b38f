//! Words that were understood, and yet say more than what would be made of them: a negation of the opposite, a question,
//! a clause inside a text that nobody quoted. They are asked about, each with the reason.

use super::atoms::{Atom, AtomValue, CountedNumber};
use super::lexicon::{FormEnd, WritingSense};
use super::meaning::SpeechSpan;
use crate::Language;

/// Words that are asked about, and why: the name of a gap of the lexicon.
pub(super) type UnsureWords = Vec<(SpeechSpan, &'static str)>;

/// Returns the words of a sentence that say more than its clauses can mean. `asks` is true if it ends with a question
/// mark.
pub(super) fn unsure(atoms: &[Atom], language: Language, asks: bool) -> UnsureWords {
    let mut all = UnsureWords::new();
    all.extend(negated_end(atoms, language));
    all.extend(nth_person(atoms));
    all.extend(either_time(atoms, language));
    all.extend(endless(atoms));
    all.extend(touched_again(atoms));
    match language {
        Language::English => {
            all.extend(question(atoms, asks));
            all.extend(perhaps(atoms));
            all.extend(but_first(atoms));
            all.extend(which_hands(atoms));
            all.extend(another_way(atoms));
            all.extend(denied_twice(atoms));
            all.extend(only_first(atoms));
        }
        Language::Japanese => {
            all.extend(asked_in_japanese(atoms, asks));
            all.extend(not_even(atoms));
        }
    }
    all
}

/// Returns the words in and after texts that nobody quoted that may be no part of them: *see you in the morning*.
pub(super) fn unquoted(atoms: &[Atom], texts: &[SpeechSpan]) -> UnsureWords {
    let inside = texts.iter().filter_map(|text| swallowed(atoms, text));
    let ends_text = |atom: &&Atom| texts.iter().any(|text| text.end == atom.span.start);
    let after = atoms.iter().filter(|atom| atom.is("daypart", "")).filter(ends_text).map(|atom| atom.span.clone());
    inside.chain(after).map(|words| (words, "unquoted")).collect()
}

/// Returns the words of a text that nobody quoted from where they look like a clause of the sentence: *hello without
/// waving*, *hello in the morning*.
fn swallowed(atoms: &[Atom], text: &SpeechSpan) -> Option<SpeechSpan> {
    let inside: Vec<&Atom> =
        atoms.iter().filter(|atom| text.start <= atom.span.start && atom.span.end <= text.end).collect();
    let adds = |at: &usize| {
        let atom = inside[*at];
        let time = atom.is("daypart", "") && !atom.is("aux", "");
        // *Tell mom that …*: these are not the words that the robot says.
        let tells = *at == 1 && atom.is("it", "that") && (inside[0].is_unknown() || inside[0].is("gap", "who"));
        let ends = atom.is("before", "") && *at > 0
            || atom.is("aside", "")
            || time
            || tells
            || *at > 0 && (atom.is("not", "") && !atom.is("v", "") || atom.is("only", ""));
        ends || *at > 0 && is_turn(&inside[*at..])
    };
    let from = (0..inside.len()).find(adds)?;
    Some(inside[from].span.start..text.end)
}

/// True if a word that joins stands here and what comes after it is no word that is said: *with red eyes*, *at nine*.
fn is_turn(atoms: &[&Atom]) -> bool {
    let joins = |atom: &Atom| atom.is("prep", "") && !atom.is("prep", "to") || atom.is("cmp", "between");
    if !joins(atoms[0]) {
        return false;
    }
    let Some(next) = atoms[1..].iter().find(|atom| !atom.is("void", "") && !atom.is("poss", "")) else {
        return true;
    };
    let acts = |sense: &WritingSense| {
        matches!(sense.kind, "do" | "pose") && matches!(sense.form.end, FormEnd::Plain | FormEnd::Ing)
    };
    let names = ["part", "color", "daypart", "num", "side", "clock"].iter().any(|kind| next.is(kind, ""));
    names || matches!(next.value, AtomValue::Measure(_)) || next.senses.iter().any(acts)
}

/// True if a clause may begin or end here.
fn parts(atom: &Atom) -> bool {
    matches!(atom.value, AtomValue::Sign(_))
        || ["lead", "then", "but", "otherwise"].iter().any(|kind| atom.is(kind, ""))
        || atom.senses.iter().any(|sense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba))
}

/// The clause that an atom stands in.
fn clause(atoms: &[Atom], at: usize) -> &[Atom] {
    let start = atoms[..at].iter().rposition(parts).map_or(0, |before| before + 1);
    let end = atoms[at..].iter().position(parts).map_or(atoms.len(), |length| at + length);
    &atoms[start..(end + 1).min(atoms.len())]
}

/// True if a word denies what is told.
fn denies(atom: &Atom) -> bool {
    ["not", "none", "nolonger"].iter().any(|kind| atom.is(kind, "")) || atom.senses.iter().any(|sense| sense.form.not)
}

/// *It is not quiet for ten seconds*, *the child does not leave*: the opposite of an end is no event of its own.
fn negated_end(atoms: &[Atom], language: Language) -> Option<(SpeechSpan, &'static str)> {
    let is_length = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Length(..)));
    (0..atoms.len()).find_map(|at| {
        let around = clause(atoms, at);
        let key = if atoms[at].is("noun", "quiet") {
            "loudness"
        } else if atoms[at].is("v", "leave") && !around.iter().any(is_length) {
            "stays"
        } else {
            return None;
        };
        // 誰もいなくなったら: all are gone.
        let denied = |atom: &Atom| match (language, key) {
            (Language::Japanese, "stays") => atom.senses.iter().any(|sense| sense.form.not),
            _ => denies(atom),
        };
        around.iter().any(denied).then(|| (atoms[at].span.clone(), key))
    })
}

/// *The third person*: the robot counts how often it sees somebody, and not whom.
fn nth_person(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let names = |atom: &Atom| {
        ["who", "whom"].iter().any(|kind| atom.is(kind, "")) && !atom.is("num", "")
            || ["face", "people", "ball", "thing"].iter().any(|noun| atom.is("noun", noun))
    };
    let found = (1..atoms.len()).find(|at| names(&atoms[*at]) && atoms[*at - 1].is("ord", ""))?;
    Some((atoms[found - 1].span.start..atoms[found].span.end, "nth"))
}

/// *When … and when …*, …ときと…とき: at either time, or at both?
fn either_time(atoms: &[Atom], language: Language) -> Option<(SpeechSpan, &'static str)> {
    if language == Language::English {
        return None;
    }
    let leads = |at: usize| atoms.get(at).is_some_and(|atom| atom.is("lead", "when"));
    let joins = |at: &usize| {
        let joined = atoms[*at].is("p", "to") || atoms[*at].is("void", "too") || atoms[*at].is("adv", "again");
        let before = if atoms[*at - 1].is_sign(',') { at.checked_sub(2) } else { Some(*at - 1) };
        joined && before.is_some_and(leads)
    };
    let at = (1..atoms.len()).find(joins)?;
    let goes_on = atoms[at + 1..].iter().any(|atom| atom.is("lead", "when"));
    let acts = |sense: &WritingSense| matches!(sense.kind, "do" | "pose") && sense.form.end == FormEnd::Te;
    let is_done = atoms[..at].iter().any(|atom| atom.senses.iter().any(acts));
    (goes_on && !is_done).then(|| (atoms[at].span.clone(), "either"))
}

/// 頭をずっと触られたら: for how long?
fn endless(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let is_time = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Time(_)));
    let at = (0..atoms.len()).find(|at| {
        let around = clause(atoms, *at);
        let ends = around.last().is_some_and(|last| {
            last.is("lead", "when")
                || last.senses.iter().any(|sense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba))
        });
        let felt = ["touch", "hold", "press"].iter().any(|verb| around.iter().any(|atom| atom.is("v", verb)));
        let goes_on = atoms[*at].is("adv", "ongoing") || atoms[*at].senses.iter().any(|sense| sense.form.keeps);
        goes_on && felt && ends && !around.iter().any(is_time)
    })?;
    Some((atoms[at].span.clone(), "howlong"))
}

/// *The head is touched again*: the second time, or each time?
fn touched_again(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let touches = |atom: &Atom| ["touch", "press", "hold"].iter().any(|verb| atom.is("v", verb));
    let at = (0..atoms.len()).find(|at| {
        let start = atoms[..*at].iter().rposition(parts).map_or(0, |before| before + 1);
        let english = start > 0 && atoms[start - 1].is("lead", "when") && atoms[start..*at].iter().any(touches);
        let end = atoms[*at..].iter().position(parts).map(|length| at + length);
        let japanese = end.is_some_and(|end| {
            let tells = |sense: &WritingSense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba);
            atoms[*at..=end]
                .iter()
                .any(|atom| touches(atom) && (atom.senses.iter().any(tells) || atoms[end].is("lead", "when")))
                && atoms[end].senses.iter().any(|sense| tells(sense) || sense.kind == "lead")
                && !atoms[*at].is_sign(',')
        });
        let again = atoms[*at].is("adv", "again") && !atoms[*at].is("v", "");
        again && (english || japanese && !atoms[start..*at].iter().any(|atom| atom.is("lead", "")))
    })?;
    Some((atoms[at].span.clone(), "again"))
}

/// *If no face is not seen*: who denies what?
fn denied_twice(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let ends = |atom: &Atom| parts(atom) || ["and", "or"].iter().any(|kind| atom.is(kind, ""));
    let clauses = atoms.split(ends);
    let twice = clauses
        .map(|clause| clause.iter().filter(|atom| denies(atom)).collect::<Vec<_>>())
        .find(|all| all.len() > 1)?;
    Some((twice[1].span.clone(), "denials"))
}

/// *Only when a face is seen, wave when the head is touched*: which of both is the moment?
fn only_first(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let first = atoms.iter().position(|atom| !atom.is("void", "") && !atom.is("polite", ""))?;
    let follows = atoms[first + 1..].iter().any(|atom| atom.is("lead", "when"));
    (atoms[first].is("onlywhen", "") && follows).then(|| (atoms[first].span.clone(), "either"))
}

/// *Did the robot wave when …?*: asks for nothing.
fn question(atoms: &[Atom], asks: bool) -> Option<(SpeechSpan, &'static str)> {
    let first = atoms.iter().position(|atom| !atom.is("void", ""))?;
    let next = atoms[first + 1..].iter().find(|atom| !atom.is("void", ""))?;
    let is_question = atoms[first].is("asks", "") && next.is("robot", "");
    // *Should you see a face, …*
    let leads = atoms[first].is("lead", "") && !asks;
    (is_question && !leads && !atoms[first].is("polite", "")).then(|| (atoms[first].span.clone(), "notorder"))
}

/// *The robot may wave*: does it, or not?
fn perhaps(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let at = (1..atoms.len()).find(|at| atoms[*at].is("maybe", "") && atoms[*at - 1].is("robot", ""))?;
    Some((atoms[at].span.clone(), "notorder"))
}

/// *Sit down, but first wave*: the order in which it is said is another.
fn but_first(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let at = (1..atoms.len()).find(|at| atoms[*at].is("adv", "first") && atoms[*at - 1].is("but", ""))?;
    Some((atoms[at].span.clone(), "sequence"))
}

/// *Exactly one hand*, *hands are touched*: a sense tells a touch of either hand, not how many are touched.
fn which_hands(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let touched = |atom: &Atom| ["touch", "hold", "press"].iter().any(|verb| atom.is("v", verb));
    (0..atoms.len()).find_map(|at| {
        let hands = &atoms[at];
        let is_felt = hands.is("part", "hand") || hands.is("part", "foot");
        let after = &atoms[at + 1..(at + 4).min(atoms.len())];
        if !is_felt || hands.is("v", "") || !after.iter().any(touched) {
            return None;
        }
        let before = &atoms[at.saturating_sub(3)..at];
        let counts = before.iter().any(|atom| {
            ["vague", "only", "exact"].iter().any(|kind| atom.is(kind, ""))
                || ["atleast", "atmost"].iter().any(|cmp| atom.is("cmp", cmp))
        }) && before.iter().any(|atom| matches!(atom.value, AtomValue::Measure(_)));
        let chosen = |atom: &Atom| ["side", "or", "whichever", "none"].iter().any(|kind| atom.is(kind, ""));
        let several = hands.is("plural", "") && !before.iter().any(chosen);
        (counts || several).then(|| (hands.span.clone(), "hands"))
    })
}

/// *Sit out*, *stand by*: a word at the end makes another verb of it.
fn another_way(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let moves = |atom: &Atom| {
        atom.senses.iter().any(|sense| matches!(sense.kind, "do" | "pose") && sense.form.end == FormEnd::Plain)
    };
    let ends = |next: Option<&Atom>| next.is_none_or(|next| parts(next) || next.is("and", ""));
    let at = (1..atoms.len()).find(|at| {
        let is_way = atoms[*at].senses.iter().all(|sense| matches!(sense.kind, "prep" | "by" | "dir" | "at"));
        is_way && atoms[*at].is("prep", "") && moves(&atoms[*at - 1]) && ends(atoms.get(*at + 1))
    })?;
    Some((atoms[at - 1].span.start..atoms[at].span.end, "notorder"))
}

/// 手を振るか, 手を振る？: asks whether it does so.
fn asked_in_japanese(atoms: &[Atom], asks: bool) -> Option<(SpeechSpan, &'static str)> {
    let means = |atom: &&Atom| !matches!(atom.value, AtomValue::Sign(_)) && (!atom.is("void", "") || atom.is("or", ""));
    let last = atoms.iter().rposition(|atom| means(&atom))?;
    let plain = |atom: &Atom| {
        let does = |sense: &WritingSense| {
            matches!(sense.kind, "v" | "do" | "pose") && matches!(sense.form.end, FormEnd::Dict | FormEnd::Did)
        };
        atom.senses.iter().any(does)
    };
    let ends_with_or = atoms[last].is("or", "") && last > 0 && plain(&atoms[last - 1]);
    let is_asked = asks && last + 1 == atoms.len() && plain(&atoms[last]);
    (ends_with_or || is_asked).then(|| (atoms[last].span.clone(), "notorder"))
}

/// 3人もいたら: more than one thought, or so many at least?
fn not_even(atoms: &[Atom]) -> Option<(SpeechSpan, &'static str)> {
    let counts = |atom: &Atom| {
        matches!(
            atom.value,
            AtomValue::Measure(CountedNumber::People(_) | CountedNumber::Times(_) | CountedNumber::Number(_))
        )
    };
    let one = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::People(count) | CountedNumber::Number(count)) if count == 1.0);
    let at = (1..atoms.len()).find(|at| {
        atoms[*at].is("void", "too") && counts(&atoms[*at - 1]) && !(one(&atoms[*at - 1]) && atoms.iter().any(denies))
    })?;
    Some((atoms[at - 1].span.start..atoms[at].span.end, "count"))
}
