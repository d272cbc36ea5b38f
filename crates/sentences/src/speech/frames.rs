//! Words around what is said, by rule: *could the robot please …*, *make it …*, *let my hand go*, *every other time*,
//! *react to a pat with a nod*.

use super::atoms::{Atom, AtomValue};
use super::clause::cond;
use super::lexicon::{FormEnd, WordForm, WritingSense};

/// The most words between *let* and *go*.
const LET_MAX: usize = 4;

/// The atoms of English with what only frames them as politeness.
pub(super) fn framed(atoms: Vec<Atom>) -> Vec<Atom> {
    said_after_sign(reacting(each_touch(every_other(let_go(waiting(asked(misheard(done_to(atoms)))))))))
}

fn word(kind: &'static str, arg: &'static str) -> WritingSense {
    WritingSense { kind, arg, form: WordForm::default() }
}

/// True for fillers and politeness.
fn is_filler(atom: &Atom) -> bool {
    atom.is("void", "") || atom.is("polite", "")
}

/// True if an order to the robot begins here: a plain verb.
fn orders(atom: &Atom) -> bool {
    let plain = |sense: &WritingSense| {
        matches!(sense.kind, "v" | "do" | "pose") && sense.form.end == FormEnd::Plain && sense.arg != "go"
    };
    atom.senses.iter().any(plain)
}

/// True if a clause may begin after this atom.
fn parts(atom: &Atom) -> bool {
    matches!(atom.value, AtomValue::Sign(_))
        || ["and", "then", "but", "otherwise", "polite"].iter().any(|kind| atom.is(kind, ""))
}

/// *Could the robot please wave*, *the robot ought to wave*, *make it wave*, *we would like it to wave* as *please wave*.
fn asked(atoms: Vec<Atom>) -> Vec<Atom> {
    let mut all: Vec<Atom> = Vec::with_capacity(atoms.len());
    let mut at = 0;
    while at < atoms.len() {
        let begins = all.last().is_none_or(|before| parts(before) || is_filler(before));
        match frame_end(&atoms, at).filter(|_| begins) {
            Some(end) => {
                let span = atoms[at].span.start..atoms[end - 1].span.end;
                all.push(Atom { span, senses: vec![word("polite", "")], value: AtomValue::Nothing });
                at = end;
            }
            None => {
                all.push(atoms[at].clone());
                at += 1;
            }
        }
    }
    all
}

/// The place at which the words end that only ask for what follows.
fn frame_end(atoms: &[Atom], start: usize) -> Option<usize> {
    let skip =
        |at: usize, fits: &dyn Fn(&Atom) -> bool| (at..).find(|at| !atoms.get(*at).is_some_and(fits)).unwrap_or(at);
    let is_robot = |atom: &Atom| atom.is("robot", "");
    let modal = |atom: &Atom| atom.is("aux", "modal") && !atom.is("lead", "");
    let to = |atom: &Atom| atom.is("prep", "to") || is_filler(atom);
    let first = atoms.get(start)?;
    let end = if modal(first) && atoms.get(start + 1).is_some_and(is_robot) {
        skip(start + 2, &is_filler)
    } else if is_robot(first) && atoms.get(start + 1).is_some_and(modal) {
        skip(skip(start + 1, &modal), &to)
    } else if first.is("cause", "") && atoms.get(start + 1).is_some_and(is_robot) {
        skip(start + 2, &to)
    } else if first.is("who", "") && skip(start + 1, &modal) < atoms.len() {
        let want = skip(start + 1, &|atom| atom.is("aux", ""));
        atoms.get(want).filter(|verb| verb.is("want", ""))?;
        skip(skip(want + 1, &is_robot), &to)
    } else {
        return None;
    };
    atoms.get(end).filter(|next| orders(next)).map(|_| end)
}

/// *Wait for the child to say “ready” and then …* as *when the child says “ready” …*, where nothing comes before; *wait
/// for a face before saying …* as *when there is a face, say …*.
fn waiting(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let first = atoms.iter().position(|atom| !is_filler(atom));
    let Some(first) = first.filter(|first| atoms[*first].is("waitfor", "")) else { return atoms };
    if atoms.get(first + 1).is_some_and(|next| matches!(next.value, AtomValue::Measure(_))) {
        return atoms;
    }
    atoms[first].senses = vec![word("lead", "when")];
    let ends = |atom: &Atom| parts(atom) || atom.is("before", "");
    let Some(end) = (first + 1..atoms.len()).find(|at| ends(&atoms[*at])) else { return atoms };
    let ing =
        |sense: &WritingSense| matches!(sense.kind, "v" | "do" | "pose" | "gap") && sense.form.end == FormEnd::Ing;
    if atoms[end].is("before", "") && atoms.get(end + 1).is_some_and(|next| next.senses.iter().any(ing)) {
        atoms[end].senses = Vec::new();
        atoms[end].value = AtomValue::Sign(',');
        atoms[end + 1].senses.retain(ing);
        atoms[end + 1].senses.iter_mut().for_each(|sense| sense.form.end = FormEnd::Plain);
    }
    // *A face*, without a word for what it does: it is there.
    let told = &atoms[first + 1..end];
    let names = |atom: &Atom| ["noun", "who", "whom"].iter().any(|kind| atom.is(kind, ""));
    let tells = |atom: &Atom| ["v", "aux", "pose", "part"].iter().any(|kind| atom.is(kind, ""));
    if told.iter().any(names) && !told.iter().any(tells) {
        let verb = if told.iter().any(|atom| atom.is("noun", "button")) { "press" } else { "exist" };
        let there = Atom { senses: vec![word("v", verb)], value: AtomValue::Nothing, ..atoms[end - 1].clone() };
        atoms.insert(end, there);
    }
    atoms
}

/// *Wave at mum*: whom it is done to does not count.
fn done_to(mut atoms: Vec<Atom>) -> Vec<Atom> {
    for at in 1..atoms.len() {
        let before = atoms[..at].iter().rposition(|atom| !atom.is("void", "") && !atom.is("poss", ""));
        let is_to = |atom: &Atom| atom.is("prep", "to") || atom.is("prep", "for") || atom.is("at", "");
        let does = |atom: &Atom| ["do", "v"].iter().any(|kind| atom.is(kind, "")) || super::act::is_quote(atom);
        let to = before.filter(|before| is_to(&atoms[*before])).and_then(|before| before.checked_sub(1));
        let is_done = to.is_some_and(|verb| does(&atoms[verb]) || atoms[verb].is("hi", ""))
            || before.is_some_and(|before| atoms[before].is("do", ""));
        if atoms[at].is("gap", "who") && is_done {
            atoms[at].senses = vec![word("who", "")];
        }
    }
    atoms
}

/// *The heard is touched*: no verb stands there, so it is a slip.
fn misheard(mut atoms: Vec<Atom>) -> Vec<Atom> {
    for at in 1..atoms.len().saturating_sub(1) {
        let heard = atoms[at].sense("v", "hear").is_some_and(|sense| sense.form.end != FormEnd::Ing);
        if heard && atoms[at - 1].is("void", "det") && atoms[at + 1].is("aux", "be") {
            atoms[at].senses.clear();
        }
    }
    atoms
}

/// *Let my hand go* as *let go of my hand*.
fn let_go(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let goes = |at: usize| {
        let rest = atoms.get(at + 1..)?;
        let go = rest.iter().take(LET_MAX).position(|atom| atom.is("v", "go"))?;
        let held = rest[..go].iter().any(|atom| atom.is("part", "") || atom.is("it", ""));
        held.then_some(at + 1 + go)
    };
    let found = (0..atoms.len()).find_map(|at| Some((at, goes(at).filter(|_| atoms[at].is("let", ""))?)));
    if let Some((at, go)) = found {
        let form = atoms[at].of("let").map(|sense| sense.form).unwrap_or_default();
        atoms[at].senses = vec![WritingSense { kind: "v", arg: "release", form }];
        atoms[at].span.end = atoms[at].span.end.max(atoms[at].span.start + 1);
        atoms.remove(go);
    }
    atoms
}

/// *Every other time* as *every second time*.
fn every_other(mut atoms: Vec<Atom>) -> Vec<Atom> {
    for at in 1..atoms.len() {
        if atoms[at - 1].is("every", "") && atoms[at].is("other", "") {
            atoms[at].senses = vec![word("ord", "2")];
        }
    }
    atoms
}

/// *Each tap of the hand gives a beep* as *when the hand is tapped, give a beep*.
fn each_touch(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let felt = |atom: &Atom| ["touch", "hold", "press", "clap", "bump"].iter().any(|verb| atom.is("v", verb));
    let begins = atoms.len() > 3 && atoms[0].is("every", "") && felt(&atoms[1]);
    let ends = |at: &usize| {
        let third = |sense: &WritingSense| {
            matches!(sense.kind, "v" | "do" | "pose") && sense.form.end == FormEnd::Third && sense.arg != "touch"
        };
        atoms[*at].is("result", "") || atoms[*at].senses.iter().any(third)
    };
    let Some(end) = (2..atoms.len()).find(ends).filter(|_| begins) else { return atoms };
    if atoms[..end].iter().any(|atom| matches!(atom.value, AtomValue::Sign(_)) || atom.is("lead", "")) {
        return atoms;
    }
    atoms[0].senses = vec![word("lead", "when")];
    let gives = atoms[end].is("v", "give");
    let mut rest = atoms.split_off(end);
    for sense in &mut rest[0].senses {
        sense.form.end = FormEnd::Plain;
    }
    // *Gives red eyes*
    let lights = gives && rest.iter().any(|atom| atom.is("part", "eyes"));
    if rest[0].is("result", "") && !gives || lights {
        rest.remove(0);
    } else {
        rest[0].senses.retain(|sense| sense.kind != "result");
    }
    let comma = Atom {
        span: rest.first().map_or(0..0, |atom| atom.span.clone()),
        senses: Vec::new(),
        value: AtomValue::Sign(','),
    };
    atoms.push(comma);
    atoms.extend(rest);
    atoms
}

/// *Any face: “hello”*: it is said.
fn said_after_sign(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let speaks = |atom: &Atom| atom.is("v", "say") || atom.is("v", "hear") || super::act::is_quote(atom);
    let found = (1..atoms.len().saturating_sub(1)).find(|at| atoms[*at].is_sign(':'));
    if let Some(sign) = found
        && super::act::is_quote(&atoms[sign + 1])
        && !atoms[..sign].iter().any(|atom| speaks(atom) || orders(atom) || atom.is("polite", ""))
    {
        let says = Atom { senses: vec![word("v", "say")], value: AtomValue::Nothing, ..atoms[sign].clone() };
        atoms.insert(sign + 1, says);
    }
    atoms
}

/// *React to a pat on the head with a nod* as *when there is a pat on the head, nod*.
fn reacting(atoms: Vec<Atom>) -> Vec<Atom> {
    reaction(&atoms).unwrap_or(atoms)
}

fn reaction(atoms: &[Atom]) -> Option<Vec<Atom>> {
    let verb = atoms.iter().position(|atom| !is_filler(atom))?;
    atoms[verb].of("react").filter(|sense| sense.form.end == FormEnd::Plain)?;
    let from = if atoms.get(verb + 1)?.is("prep", "to") { verb + 2 } else { verb + 1 };
    let with = (from + 1..atoms.len()).find(|at| atoms[*at].is("prep", "with") || atoms[*at].is("by", ""))?;
    let told = &atoms[from..with];
    let quotes = told.iter().any(super::act::is_quote);
    cond(told).filter(|meant| meant.left.is_empty() && !quotes)?;
    let what = (with + 1..atoms.len()).find(|at| !atoms[*at].is("void", "det"))?;
    let does = &atoms[what];
    let acts = |sense: &WritingSense| matches!(sense.kind, "v" | "do" | "pose");
    if !super::act::is_quote(does) && !does.senses.iter().any(acts) {
        return None;
    }
    let mut all = vec![Atom { senses: vec![word("lead", "when")], ..atoms[verb].clone() }];
    all.extend_from_slice(told);
    all.push(Atom { senses: Vec::new(), value: AtomValue::Sign(','), ..atoms[with].clone() });
    if super::act::is_quote(does) {
        all.push(Atom { senses: vec![word("v", "say")], value: AtomValue::Nothing, ..atoms[with].clone() });
    }
    all.extend_from_slice(&atoms[what..]);
    Some(all)
}
