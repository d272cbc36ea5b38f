//! Sentences whose words stand in another order than most: *greet any stranger with “hello”* as *say “hello” to any
//! stranger*, *tell me every minute: “sit up”* as *tell me “sit up” every minute*.

use super::act::is_quote;
use super::atoms::{Atom, AtomValue, CountedNumber};
use super::lexicon::{FormEnd, WordForm, WritingSense};
use crate::Language;

/// The most words for whom is greeted.
const WHOM_MAX: usize = 10;

/// The atoms in the usual order.
pub(super) fn turned(atoms: Vec<Atom>, language: Language) -> Vec<Atom> {
    if language == Language::Japanese {
        return clocked(atoms);
    }
    caused(answered(told(greeted(marked(denied(atoms))))))
}

/// 人数を10秒ごとに言う as 10秒ごとに人数を言う.
fn clocked(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_time = |atom: &Atom| matches!(atom.value, AtomValue::Measure(CountedNumber::Time(_)));
    let Some(at) = (1..atoms.len().saturating_sub(1)).find(|at| is_time(&atoms[*at])) else { return atoms };
    let leads_on = |atom: &Atom| {
        let ends =
            |sense: &WritingSense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba | FormEnd::Te | FormEnd::Stem);
        atom.is_sign(',') || is_quote(atom) || atom.is("lead", "") || atom.senses.iter().any(ends)
    };
    let start = atoms[..at].iter().rposition(leads_on).map_or(0, |before| before + 1);
    if start < at && atoms[at + 1].is("every.after", "") {
        atoms[start..=at + 1].rotate_right(2);
    }
    atoms
}

/// *If I'm not, …* as *otherwise …*
fn denied(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_pronoun = |atom: &Atom| ["who", "it", "robot", "whom"].iter().any(|kind| atom.is(kind, ""));
    let orders = |atom: &Atom| {
        atom.is_sign(',')
            || atom.is("then", "")
            || atom
                .senses
                .iter()
                .any(|sense| matches!(sense.kind, "v" | "do" | "pose") && sense.form.end == FormEnd::Plain)
    };
    for at in 1..atoms.len() {
        let Some(not) = (at + 1..atoms.len()).find(|end| !atoms[*end].is("aux", "") && !atoms[*end].is("void", ""))
        else {
            break;
        };
        let has_aux = |arg: &str| atoms[at + 1..not].iter().any(|atom| atom.is("aux", arg));
        // *If she does not say …* goes on.
        let ends = atoms.get(not + 1).is_some_and(|next| next.is_sign(','));
        let denies = (has_aux("be") || ends && has_aux(""))
            && (atoms[not].is("not", "") || atoms[not].is("nolonger", ""))
            && is_pronoun(&atoms[at]);
        let lead = (0..at).rev().find(|before| !atoms[*before].is("void", ""));
        let Some(lead) = lead.filter(|lead| denies && atoms[*lead].is("lead", "when")) else { continue };
        if atoms.get(not + 1).is_some_and(orders) {
            let span = atoms[lead].span.start..atoms[not].span.end;
            let otherwise = WritingSense { kind: "otherwise", arg: "", form: WordForm::default() };
            atoms.splice(lead..=not, [Atom { span, senses: vec![otherwise], value: AtomValue::Nothing }]);
            break;
        }
    }
    atoms
}

/// *Remind the child: “sit up”* without its colon.
fn marked(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let ends_saying = |atoms: &[Atom]| {
        let said = atoms.iter().rposition(|atom| !atom.is("who", "") && !atom.is("void", "") && !atom.is("it", ""));
        said.is_some_and(|at| atoms[at].is("v", "say") && !atoms[at].is("lead", ""))
    };
    let marks = |at: usize| atoms[at].is_sign(':') && ends_saying(&atoms[..at]);
    let found = (1..atoms.len().saturating_sub(1)).find(|at| marks(*at) && is_quote(&atoms[at + 1]));
    if let Some(at) = found {
        atoms.remove(at);
    }
    atoms
}

/// *Respond to “hello” with “hi”* as *when you hear “hello”, say “hi”*.
fn answered(atoms: Vec<Atom>) -> Vec<Atom> {
    answering(&atoms).unwrap_or(atoms)
}

fn answering(atoms: &[Atom]) -> Option<Vec<Atom>> {
    let verb = atoms.iter().position(|atom| !atom.is("void", "") && !atom.is("polite", ""))?;
    atoms[verb].sense("v", "say").filter(|sense| sense.form.end == FormEnd::Plain)?;
    let heard = if atoms.get(verb + 1)?.is("prep", "to") { verb + 2 } else { verb + 1 };
    let with = heard + 1;
    // *By saying* has its verb.
    let by = atoms.get(with)?.is("prep", "") && atoms.get(with + 1)?.is("v", "say");
    if !is_quote(atoms.get(heard)?) || !by && !atoms[with].is("prep", "with") {
        return None;
    }
    let with = if by { with + 1 } else { with };
    let what = (with + 1..atoms.len()).find(|at| !atoms[*at].is("void", "det"))?;
    let says = is_quote(&atoms[what]);
    if !says && !["do", "pose"].iter().any(|kind| atoms[what].is(kind, "")) {
        return None;
    }
    let word = |at: usize, kind: &'static str, arg: &'static str| Atom {
        senses: vec![WritingSense { kind, arg, form: WordForm::default() }],
        ..atoms[at].clone()
    };
    let mut all = vec![word(verb, "lead", "when"), word(verb, "v", "hear"), atoms[heard].clone()];
    all.push(Atom { senses: Vec::new(), value: AtomValue::Sign(','), ..atoms[with].clone() });
    all.extend(says.then(|| word(with, "v", "say")));
    all.extend_from_slice(&atoms[what..]);
    Some(all)
}

/// *Touch the head and the robot waves*, *three claps and you wave* as *touch the head to make it wave*.
fn caused(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_measure = |atom: &Atom| matches!(atom.value, AtomValue::Measure(_));
    let is_filler = |atom: &Atom| atom.is("void", "") || atom.is("polite", "");
    let first = atoms.iter().position(|atom| !is_filler(atom) && !is_measure(atom));
    let felt = ["touch", "hold", "press", "clap", "bump"];
    let plain = |atom: &Atom| felt.iter().any(|verb| atom.is("v", verb));
    let Some(first) = first.filter(|at| plain(&atoms[*at])) else { return atoms };
    let and = atoms[first..].iter().position(|atom| atom.is("and", "")).map(|at| at + first);
    let leads = |and: &usize| {
        let next = atoms[and + 1..].iter().find(|atom| !atom.is("void", ""));
        next.is_some_and(|next| next.is("robot", "") || next.is("part", "eyes"))
            && !atoms[first..*and].iter().any(|atom| is_quote(atom) || atom.is("lead", "") || atom.is("or", ""))
    };
    // *Touching the head turns the eyes red*
    let turns = |at: &usize| {
        let third = |sense: &WritingSense| sense.kind == "v" && sense.arg == "turn" && sense.form.end == FormEnd::Third;
        let eyes = atoms[at + 1..].iter().find(|atom| !atom.is("void", "") && !atom.is("poss", ""));
        atoms[*at].senses.iter().any(third) && eyes.is_some_and(|eyes| eyes.is("part", "eyes"))
    };
    let no_lead = |at: &usize| !atoms[..*at].iter().any(|atom| atom.is("lead", "") || is_quote(atom));
    let turned = (first + 1..atoms.len()).find(turns).filter(no_lead);
    if let Some(and) = and.filter(leads).or(turned) {
        atoms[and].senses = vec![WritingSense { kind: "result", arg: "", form: WordForm::default() }];
    }
    atoms
}

/// *Greet* somebody *with* a text or a gesture.
fn greeted(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let Some(verb) = atoms.iter().position(|atom| atom.is("v", "greet")) else { return atoms };
    if let Some(turned) = with(&atoms, verb) {
        return turned;
    }
    // With which words?
    for atom in &mut atoms {
        atom.senses.retain(|sense| (sense.kind, sense.arg) != ("v", "greet"));
    }
    atoms
}

/// The text or gesture of a greeting before whom it is for.
fn with(atoms: &[Atom], verb: usize) -> Option<Vec<Atom>> {
    let ends = |atom: &Atom| {
        matches!(atom.value, AtomValue::Sign(_) | AtomValue::Quote(_))
            || ["lead", "and", "or", "then", "but", "every"].iter().any(|kind| atom.is(kind, ""))
    };
    let rest = &atoms[verb + 1..];
    let with = rest.iter().take(WHOM_MAX).position(|atom| atom.is("prep", "with") || ends(atom))?;
    let what = rest[with + 1..].iter().position(|atom| !atom.is("void", "det")).map(|at| with + 1 + at);
    let what = what.filter(|_| with > 0 && rest[with].is("prep", "with"))?;
    let form = atoms[verb].sense("v", "greet").map(|sense| sense.form).unwrap_or_default();
    let gesture = ["do", "pose"].iter().any(|kind| rest[what].is(kind, ""));
    if !is_quote(&rest[what]) && !gesture {
        return None;
    }
    let mut all = atoms[..verb].to_vec();
    if !gesture {
        all.push(Atom { senses: vec![WritingSense { kind: "v", arg: "say", form }], ..atoms[verb].clone() });
    }
    all.push(rest[what].clone());
    let to = WritingSense { kind: "prep", arg: "to", form: WordForm::default() };
    all.push(Atom { senses: vec![to], ..rest[with].clone() });
    // *Greet the child with “hello”*, at no other time: when it is seen.
    let tells_when = |atom: &Atom| ["lead", "every", "start", "later"].iter().any(|kind| atom.is(kind, ""));
    let alone = !atoms.iter().any(tells_when) && form.end == FormEnd::Plain;
    for atom in &rest[..with] {
        let mut atom = atom.clone();
        if alone && atom.is("who", "") && !atom.is("it", "") {
            atom.senses = vec![WritingSense { kind: "whom", arg: "", form: WordForm::default() }];
        }
        all.push(atom);
    }
    all.extend_from_slice(&rest[what + 1..]);
    Some(all)
}

/// *Tell me every minute:* and then the text.
fn told(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_order = |atom: &Atom| atom.sense("v", "say").is_some_and(|sense| sense.form.end == FormEnd::Plain);
    let Some(verb) = atoms.iter().position(is_order) else { return atoms };
    let breaks = |atom: &Atom| is_quote(atom) || ["v", "do", "pose"].iter().any(|kind| atom.is(kind, ""));
    let Some(colon) = atoms.iter().position(|atom| atom.is_sign(':')).filter(|colon| *colon > verb + 1) else {
        return atoms;
    };
    let plain = atoms[verb + 1..colon].iter().all(|atom| !is_quote(atom) && !is_order(atom) && !atom.is("v", "say"));
    let is_last = colon + 2 == atoms.len();
    // Only when is said between them.
    let says_when = atoms.get(verb + 1).is_some_and(|next| next.is("every", "") || next.is("lead", ""));
    if !plain || !is_last || !says_when || !is_quote(&atoms[colon + 1]) || atoms[..verb].iter().any(breaks) {
        return atoms;
    }
    let text = atoms.remove(colon + 1);
    atoms.remove(colon);
    atoms.insert(verb + 1, text);
    atoms
}
