//! Sentences whose words stand in another order than most: *greet any stranger with “hello”* as *say “hello” to any
//! stranger*, *tell me every minute: “sit up”* as *tell me “sit up” every minute*.

use super::act::is_quote;
use super::atoms::{Atom, AtomValue, CountedNumber};
use super::frames::framed;
use super::lexicon::{FormEnd, WordForm, WritingSense};
use crate::Language;

/// The most words for whom is greeted.
const WHOM_MAX: usize = 10;

/// The atoms in the usual order.
pub(super) fn turned(atoms: Vec<Atom>, language: Language) -> Vec<Atom> {
    if language == Language::Japanese {
        return said_alone(clocked(cleft(led_in(asked_first(whichever(ranged(placed(marks(atoms)))))))));
    }
    caused(answered(told(greeted(marked(denied(framed(placed(atoms))))))))
}

/// 後頭部, *forehead*: a place of the head as the place and the head.
fn placed(atoms: Vec<Atom>) -> Vec<Atom> {
    let both = |atom: &Atom| atom.is("part", "head") && atom.is("place", "");
    let split = |atom: Atom| {
        if !both(&atom) {
            return vec![atom];
        }
        let (place, part) = atom.senses.iter().copied().partition(|sense| sense.kind == "place");
        vec![Atom { senses: place, ..atom.clone() }, Atom { senses: part, ..atom }]
    };
    atoms.into_iter().flat_map(split).collect()
}

/// Particles by what stands before them: 触れていても, 3人までなら, 1人も.
fn marks(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let ends = |atom: &Atom, wanted: FormEnd| {
        let verb = |sense: &WritingSense| matches!(sense.kind, "v" | "do" | "pose" | "gap") && sense.form.end == wanted;
        atom.senses.iter().any(verb)
    };
    let word = |kind: &'static str, arg: &'static str| WritingSense { kind, arg, form: WordForm::default() };
    for at in 1..atoms.len() {
        let goes_on = |kind: &str| atoms.get(at + 1).is_some_and(|next| next.is(kind, ""));
        let counted = |value: &AtomValue| match value {
            AtomValue::Measure(CountedNumber::People(count) | CountedNumber::Number(count)) => Some(*count),
            _ => None,
        };
        if atoms[at].is("void", "too") && ends(&atoms[at - 1], FormEnd::Te) && !goes_on("void") {
            atoms[at].senses = vec![word("gap", "even")];
        } else if atoms[at].is("void", "too") && counted(&atoms[at - 1].value) == Some(1.0) {
            atoms[at - 1].senses = vec![word("none", "who")];
            atoms[at - 1].value = AtomValue::Nothing;
        } else if atoms[at].is("only", "")
            && atoms[at].is("lead", "until")
            && goes_on("lead")
            && counted(&atoms[at - 1].value).is_some()
        {
            atoms[at].senses = vec![word("cmp", "atmost")];
        }
    }
    atoms
}

/// 20%以上、かつ50%以下 as 20%以上50%以下.
fn ranged(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let bounds = |atom: &Atom| ["atleast", "atmost", "less", "more"].iter().any(|word| atom.is("cmp", word));
    let is_measure = |atom: &Atom| matches!(atom.value, AtomValue::Measure(_));
    let found = (1..atoms.len().saturating_sub(1)).find_map(|at| {
        let and = if atoms[at].is_sign(',') { at + 1 } else { at };
        let joins = atoms.get(and)?.is("and", "") && bounds(&atoms[at - 1]) && is_measure(atoms.get(and + 1)?);
        joins.then_some(at..and + 1)
    });
    if let Some(joint) = found {
        atoms.drain(joint);
    }
    atoms
}

/// どちらの手でも、触られたら without its comma.
fn whichever(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let found = (1..atoms.len()).find(|at| atoms[*at].is_sign(',') && atoms[at - 1].is("whichever", ""));
    if let Some(comma) = found {
        atoms.remove(comma);
    }
    atoms
}

/// 電池が何パーセントか、頭を触ったときに教えて as 頭を触ったときに電池が何パーセントか教えて.
fn asked_first(atoms: Vec<Atom>) -> Vec<Atom> {
    let names = |atom: &Atom| ["noun", "p", "prep", "void"].iter().any(|kind| atom.is(kind, ""));
    let leads = |atom: &Atom| {
        let ends = |sense: &WritingSense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba);
        atom.is("lead", "when") || atom.senses.iter().any(ends)
    };
    let turned = || {
        let comma = atoms.iter().position(|atom| atom.is_sign(','))?;
        let asked = &atoms[..comma];
        let is_asked = asked.last()?.is("noun", "level") && asked.first()?.is("noun", "battery");
        let end = comma + 1 + atoms[comma + 1..].iter().position(leads)? + 1;
        let end = if atoms.get(end)?.is("prep", "") || atoms[end].is_sign(',') { end + 1 } else { end };
        let tells = atoms.get(end)?.is("v", "say");
        let all = || [&atoms[comma + 1..end], asked, &atoms[end..]].concat();
        (is_asked && tells && asked.iter().all(names)).then(all)
    };
    turned().unwrap_or(atoms)
}

/// 頭タッチで, 「開いて」で and ボタンを押す→ lead in what is done then.
fn led_in(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let felt = |atom: &Atom| {
        let plain = |sense: &WritingSense| {
            sense.kind == "v"
                && ["touch", "press", "bump", "clap"].contains(&sense.arg)
                && sense.form.end == FormEnd::Plain
        };
        atom.senses.iter().any(plain)
    };
    let told = |atom: &Atom| {
        let ends = |sense: &WritingSense| matches!(sense.form.end, FormEnd::Dict | FormEnd::Did) && sense.kind == "v";
        atom.senses.iter().any(ends)
    };
    for at in 1..atoms.len().saturating_sub(1) {
        let by = atoms[at].is("by", "")
            && (felt(&atoms[at - 1])
                || atoms[at - 1].is("cmp", "")
                || is_quote(&atoms[at - 1]) && !says(&atoms[at + 1..]));
        let sign = atoms[at].is_sign(':') && told(&atoms[at - 1]);
        if by || sign {
            atoms[at].senses = vec![WritingSense { kind: "lead", arg: "when", form: WordForm::default() }];
            atoms[at].value = AtomValue::Nothing;
            break;
        }
    }
    atoms
}

/// True if something is said before the next clause.
fn says(atoms: &[Atom]) -> bool {
    let clause = atoms.iter().take_while(|atom| !atom.is_sign(','));
    clause.into_iter().any(|atom| atom.is("v", "say") || is_quote(atom))
}

/// 人がいたら「こんにちは」、いなければ座る: the text is said, though no verb says so.
fn said_alone(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let leads = |atom: &Atom| {
        let ends = |sense: &WritingSense| matches!(sense.form.end, FormEnd::Tara | FormEnd::Ba);
        atom.is("lead", "") || atom.senses.iter().any(ends)
    };
    let found = (1..atoms.len()).find(|at| {
        let over = atoms.get(at + 1).is_none_or(|next| next.is_sign(','));
        is_quote(&atoms[*at])
            && leads(&atoms[at - 1])
            && over
            && !atoms[at + 1..].iter().any(|atom| atom.is("v", "say"))
    });
    if let Some(at) = found {
        let form = WordForm { end: FormEnd::Te, ..WordForm::default() };
        let senses = vec![WritingSense { kind: "v", arg: "say", form }];
        atoms.insert(at + 1, Atom { senses, value: AtomValue::Nothing, ..atoms[at].clone() });
    }
    atoms
}

/// 目を青くするのは、静かなとき without its comma.
fn cleft(mut atoms: Vec<Atom>) -> Vec<Atom> {
    let ends = |atom: &Atom| {
        let tells = |sense: &WritingSense| matches!(sense.kind, "v" | "do" | "pose") && sense.form.end == FormEnd::Dict;
        atom.senses.iter().any(tells)
    };
    let is_prep = |atom: &Atom| atom.is("prep", "") || atom.is("void", "");
    let found = (3..atoms.len()).find(|at| {
        atoms[*at].is_sign(',') && is_prep(&atoms[at - 1]) && is_prep(&atoms[at - 2]) && ends(&atoms[at - 3])
    });
    if let Some(comma) = found {
        atoms.remove(comma);
    }
    atoms
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
    let is_filler = |atom: &Atom| {
        let somebody = atom.is("who", "") && !atom.is("robot", "");
        atom.is("void", "") || atom.is("polite", "") || somebody
    };
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
    let what = what.filter(|_| rest[with].is("prep", "with"))?;
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
