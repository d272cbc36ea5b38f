//! The helpers of a behaviour: checked, compiled once, callable from bodies and from each other.

use crate::closures::{check_closures, is_caller};
use crate::limits::Limits;
use crate::procedure::compile;
use crate::quick::Shelf;
use crate::toll::Toll;
use crate::validate::Fault;
use crate::walk;
use behaviour::{FileHelper, is_identifier};
use rhai::{AST, Engine};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// At least the steps that Rhai counts for one part of a procedure.
const STEPS_PER_PART: u64 = 2;

/// Compiled helpers.
#[derive(Default)]
pub(crate) struct Helpers {
    functions: Rc<Functions>,
    shelf: Option<Shelf>,
    /// Those with the name of a function that is handed closures.
    callers: BTreeSet<String>,
    lengths: BTreeMap<String, Length>,
    /// The limit of steps.
    operations: u64,
}

/// All helpers as functions for Rhai, read when they are first needed: where the first tier answers, they never are.
#[derive(Default)]
pub(crate) struct Functions {
    texts: Vec<String>,
    read: OnceCell<AST>,
}

/// How long a helper may run.
struct Length {
    /// The parts that one call computes at most; nothing without such a bound.
    parts: Option<u64>,
    toll: Toll,
    calls: BTreeSet<String>,
}

/// A helper that Rhai accepts.
struct Read {
    /// Its body by itself.
    body: AST,
    /// The body as a function.
    function: String,
    /// What it calls.
    calls: BTreeSet<String>,
}

impl Helpers {
    /// Checks and compiles all helpers.
    pub(crate) fn compile(engine: &Engine, helpers: &[FileHelper], limits: &Limits) -> Result<Self, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut texts = Vec::new();
        let mut all = BTreeMap::new();
        for (at, helper) in helpers.iter().enumerate() {
            let twice = helpers[..at].iter().any(|other| other.name == helper.name);
            match if twice { Err("this name is used twice".to_owned()) } else { compile_one(engine, helper) } {
                Ok(read) => {
                    texts.push(read.function.clone());
                    all.insert(helper.name.as_str(), read);
                }
                Err(reason) => faults.push(Fault { id: helper.name.clone(), reason }),
            }
        }
        faults.extend(recursion(helpers, &all));
        let callers = all.keys().filter(|name| is_caller(name)).map(|name| (*name).to_owned()).collect();
        let mut made = Self { callers, ..Self::default() };
        faults.extend(all.iter().filter_map(|(name, read)| {
            let reason = made.check_closures(&read.body).err()?;
            Some(Fault { id: (*name).to_owned(), reason })
        }));
        if !faults.is_empty() {
            return Err(faults);
        }
        made.lengths = lengths(&all);
        made.operations = limits.operations;
        made.functions = Rc::new(Functions { texts, read: OnceCell::new() });
        made.shelf = limits.compiled.then(|| shelf(helpers, &all, limits));
        Ok(made)
    }

    /// Refuses closures that a helper could keep.
    pub(crate) fn check_closures(&self, body: &AST) -> Result<(), String> {
        if self.callers.is_empty() { Ok(()) } else { check_closures(body, &self.callers) }
    }

    /// What a body pays that does not certainly end within the limit of steps.
    pub(crate) fn toll(&self, body: &AST) -> Option<Toll> {
        let parts = walk::length(body, &|helper| self.lengths.get(helper).map(|length| length.parts));
        if parts.is_some_and(|parts| parts.saturating_mul(STEPS_PER_PART) <= self.operations) {
            return None;
        }
        let mut toll = Toll::of(body, false);
        self.reached(walk::called(body)).for_each(|length| toll.add(&length.toll));
        Some(toll)
    }

    /// The helpers that may be called, also through others; all where a text may name one.
    fn reached(&self, called: BTreeSet<String>) -> impl Iterator<Item = &Length> {
        let all = called.iter().any(|name| name == "Fn" || is_caller(name));
        let (mut seen, mut open) = (BTreeSet::new(), Vec::from_iter(called));
        while let Some(name) = open.pop() {
            if let Some((name, length)) = self.lengths.get_key_value(&name).filter(|(name, _)| !seen.contains(*name)) {
                seen.insert(name);
                open.extend(length.calls.iter().cloned());
            }
        }
        self.lengths.iter().filter(move |(name, _)| all || seen.contains(*name)).map(|(_, length)| length)
    }

    /// The helpers for the first tier, if it is wanted.
    pub(crate) fn shelf(&self) -> Option<&Shelf> {
        self.shelf.as_ref()
    }

    /// All of them as functions for Rhai.
    pub(crate) fn functions(&self) -> Rc<Functions> {
        self.functions.clone()
    }
}

impl Functions {
    /// The body with all helpers within reach.
    ///
    /// # Errors
    /// Why Rhai cannot read them, in plain words.
    pub(crate) fn joined(&self, engine: &Engine, body: AST) -> Result<AST, String> {
        if self.texts.is_empty() {
            return Ok(body);
        }
        let functions = self.read(engine)?;
        Ok(if body.has_functions() {
            body.merge(functions)
        } else {
            AST::new(body.statements().iter().cloned(), functions.shared_lib().clone())
        })
    }

    fn read(&self, engine: &Engine) -> Result<&AST, String> {
        if let Some(read) = self.read.get() {
            return Ok(read);
        }
        let mut all = AST::empty();
        for text in &self.texts {
            all = all.merge(&read_function(engine, text, &[])?);
        }
        Ok(self.read.get_or_init(|| all))
    }
}

fn read_function(engine: &Engine, text: &str, params: &[String]) -> Result<AST, String> {
    engine.compile(text).map_err(|error| crate::words::refusal(&error, params))
}

fn compile_one(engine: &Engine, helper: &FileHelper) -> Result<Read, String> {
    if let Some(bad) = std::iter::once(&helper.name).chain(&helper.params).find(|name| !is_identifier(name)) {
        return Err(format!("“{bad}” cannot be a name in a procedure"));
    }
    check_distinct(&helper.params)?;
    // By itself first: only a text that is whole by itself may be put between the brackets of a function.
    let body = compile(engine, &helper.params, &helper.body)?;
    let function = format!("fn {}({}) {{\n{}\n}}", helper.name, helper.params.join(", "), helper.body);
    read_function(engine, &function, &helper.params)?;
    let calls = walk::called(&body);
    Ok(Read { body, function, calls })
}

/// Compiles the helpers for the first tier, those that are called before those that call them.
fn shelf(helpers: &[FileHelper], all: &BTreeMap<&str, Read>, limits: &Limits) -> Shelf {
    let mut shelf = Shelf::of(limits);
    let mut open: Vec<&FileHelper> = helpers.iter().collect();
    let mut waiting: BTreeSet<&str> = all.keys().copied().collect();
    while !open.is_empty() {
        open.retain(|helper| {
            let Some(read) = all.get(helper.name.as_str()) else { return false };
            if read.calls.iter().any(|called| waiting.contains(called.as_str())) {
                return true;
            }
            shelf.add(&helper.name, &helper.params, &read.body);
            waiting.remove(helper.name.as_str());
            false
        });
    }
    shelf
}

/// For every helper how long one call may run.
fn lengths(all: &BTreeMap<&str, Read>) -> BTreeMap<String, Length> {
    let mut known = BTreeMap::new();
    for name in all.keys() {
        add_length(name, all, &mut known);
    }
    known
}

/// Those that it calls first; helpers do not call themselves.
fn add_length(name: &str, all: &BTreeMap<&str, Read>, known: &mut BTreeMap<String, Length>) {
    let Some(read) = all.get(name).filter(|_| !known.contains_key(name)) else { return };
    for called in &read.calls {
        add_length(called, all, known);
    }
    let parts = walk::length(&read.body, &|helper| known.get(helper).map(|length| length.parts));
    known.insert(name.to_owned(), Length { parts, toll: Toll::of(&read.body, true), calls: read.calls.clone() });
}

/// Refuses two equal names among arguments.
pub(crate) fn check_distinct(names: &[String]) -> Result<(), String> {
    let twice = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
    twice.map_or(Ok(()), |(_, name)| Err(format!("two arguments have the name “{name}”")))
}

/// Helpers that call themselves, also through others.
fn recursion(helpers: &[FileHelper], all: &BTreeMap<&str, Read>) -> Vec<Fault> {
    let reaches = |start: &str| {
        let mut seen = BTreeSet::new();
        let called = |name: &str| all.get(name).into_iter().flat_map(|read| &read.calls).map(String::as_str);
        let mut open: Vec<&str> = called(start).collect();
        while let Some(name) = open.pop() {
            if seen.insert(name) {
                open.extend(called(name));
            }
        }
        seen.contains(start)
    };
    let looping = helpers.iter().filter(|helper| reaches(&helper.name));
    let words = |helper: &FileHelper| format!("the helper “{}” calls itself, perhaps through others", helper.name);
    looping.map(|helper| Fault { id: helper.name.clone(), reason: words(helper) }).collect()
}
