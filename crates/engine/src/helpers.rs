//! The helpers of a behaviour: checked, compiled once, callable from bodies and from each other.

use crate::procedure::compile;
use crate::validate::Fault;
use crate::walk;
use behaviour::{FileHelper, is_identifier};
use rhai::{AST, Engine};
use std::collections::{BTreeMap, BTreeSet};

/// Compiled helpers.
#[derive(Default)]
pub(crate) struct Helpers {
    functions: Option<AST>,
}

impl Helpers {
    /// Checks and compiles all helpers.
    pub(crate) fn compile(engine: &Engine, helpers: &[FileHelper]) -> Result<Self, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut functions: Option<AST> = None;
        let mut calls = BTreeMap::new();
        for (at, helper) in helpers.iter().enumerate() {
            let twice = helpers[..at].iter().any(|other| other.name == helper.name);
            match if twice { Err("this name is used twice".to_owned()) } else { compile_one(engine, helper) } {
                Ok((ast, called)) => {
                    calls.insert(helper.name.as_str(), called);
                    functions = Some(functions.take().map_or_else(|| ast.clone(), |all| all.merge(&ast)));
                }
                Err(reason) => faults.push(Fault { id: helper.name.clone(), reason }),
            }
        }
        faults.extend(recursion(helpers, &calls));
        if faults.is_empty() { Ok(Self { functions }) } else { Err(faults) }
    }

    /// The body with all helpers within reach.
    pub(crate) fn joined(&self, body: AST) -> AST {
        match &self.functions {
            None => body,
            Some(functions) if body.has_functions() => body.merge(functions),
            Some(functions) => AST::new(body.statements().iter().cloned(), functions.shared_lib().clone()),
        }
    }
}

fn compile_one(engine: &Engine, helper: &FileHelper) -> Result<(AST, BTreeSet<String>), String> {
    if let Some(bad) = std::iter::once(&helper.name).chain(&helper.params).find(|name| !is_identifier(name)) {
        return Err(format!("“{bad}” cannot be a name in a procedure"));
    }
    check_distinct(&helper.params)?;
    // By itself first: only a text that is whole by itself may be put between the brackets of a function.
    let called = walk::called(&compile(engine, &helper.params, &helper.body)?);
    let function = format!("fn {}({}) {{\n{}\n}}", helper.name, helper.params.join(", "), helper.body);
    let ast = engine.compile(function).map_err(|error| crate::words::refusal(&error, &helper.params))?;
    Ok((ast, called))
}

/// Refuses two equal names among arguments.
pub(crate) fn check_distinct(names: &[String]) -> Result<(), String> {
    let twice = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
    twice.map_or(Ok(()), |(_, name)| Err(format!("two arguments have the name “{name}”")))
}

/// Helpers that call themselves, also through others.
fn recursion(helpers: &[FileHelper], calls: &BTreeMap<&str, BTreeSet<String>>) -> Vec<Fault> {
    let reaches = |start: &str| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&str> = calls.get(start).into_iter().flatten().map(String::as_str).collect();
        while let Some(name) = open.pop() {
            if seen.insert(name) {
                open.extend(calls.get(name).into_iter().flatten().map(String::as_str));
            }
        }
        seen.contains(start)
    };
    let looping = helpers.iter().filter(|helper| reaches(&helper.name));
    let words = |helper: &FileHelper| format!("the helper “{}” calls itself, perhaps through others", helper.name);
    looping.map(|helper| Fault { id: helper.name.clone(), reason: words(helper) }).collect()
}
