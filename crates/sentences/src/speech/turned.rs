//! Sentences whose words stand in another order than most: *greet any stranger with “hello”* as *say “hello” to any
//! stranger*, *tell me every minute: “sit up”* as *tell me “sit up” every minute*.

use super::act::is_quote;
use super::atoms::{Atom, Value};
use super::lexicon::{End, Form, Sense};
use crate::Language;

/// The most words for whom is greeted.
const WHOM_MAX: usize = 10;

/// The atoms in the usual order.
pub(super) fn turned(atoms: Vec<Atom>, language: Language) -> Vec<Atom> {
    if language == Language::Japanese {
        return atoms;
    }
    told(greeted(atoms))
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
        matches!(atom.value, Value::Sign(_) | Value::Quote(_))
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
        all.push(Atom { senses: vec![Sense { kind: "v", arg: "say", form }], ..atoms[verb].clone() });
    }
    all.push(rest[what].clone());
    let to = Sense { kind: "prep", arg: "to", form: Form::default() };
    all.push(Atom { senses: vec![to], ..rest[with].clone() });
    all.extend_from_slice(&rest[..with]);
    all.extend_from_slice(&rest[what + 1..]);
    Some(all)
}

/// *Tell me every minute:* and then the text.
fn told(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let is_order = |atom: &Atom| atom.sense("v", "say").is_some_and(|sense| sense.form.end == End::Plain);
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
