//! The helpers of a behaviour: checked, compiled once, callable from bodies and from each other.

mod reach;

use crate::cost::Limits;
use crate::cost::callers::is_caller;
use crate::cost::variable_cost::VariableCost;
use crate::faults::{BodyFault, GraphFault, Reason, Syntax};
use crate::procedure::calls::{called_first, circular};
use crate::procedure::closures::check_closures;
use crate::procedure::compiled::CompiledHelpers;
use crate::procedure::parse::compile;
use crate::procedure::walk;
use behaviour::LookupSet;
use behaviour::{FileHelper, is_identifier};
use reach::HelperReach;
use rhai::{AST, Engine};
use std::cell::OnceCell;
use std::rc::Rc;

/// At least the steps that Rhai counts for one part of a procedure.
const STEPS_PER_PART: u64 = 2;

/// Compiled helpers.
#[derive(Default)]
pub(crate) struct HelperPrograms {
    functions: Rc<Functions>,
    compiled: Option<CompiledHelpers>,
    /// Those with the name of a function that is handed closures.
    callers: LookupSet<String>,
    reach: HelperReach,
    /// The limit of steps.
    operations: u64,
}

/// All helpers as functions for Rhai, read when they are first needed: where the first tier answers, they never are.
#[derive(Default)]
pub(crate) struct Functions {
    texts: Vec<String>,
    read: OnceCell<AST>,
}

/// A helper that Rhai accepts.
struct ReadHelper<'f> {
    /// The parameters of the helper.
    params: &'f [String],
    /// The body by itself.
    body: AST,
    /// The body as a function.
    function: String,
    /// The functions that the body calls.
    calls: Vec<String>,
}

impl HelperPrograms {
    /// Checks and compiles all helpers.
    pub(crate) fn compile(engine: &Engine, helpers: &[FileHelper], limits: &Limits) -> Result<Self, Vec<GraphFault>> {
        let mut faults = Vec::new();
        let mut texts = Vec::new();
        let (mut all, mut names) = (Vec::new(), LookupSet::new());
        for helper in helpers {
            let twice = !names.insert(helper.name.as_str());
            match if twice { Err(Reason::NameTwice) } else { compile_one(engine, helper).map_err(Reason::Body) } {
                Ok(read) => {
                    texts.push(read.function.clone());
                    all.push((helper.name.as_str(), read));
                }
                Err(reason) => faults.push(GraphFault { id: helper.name.clone(), reason }),
            }
        }
        all.sort_unstable_by_key(|(name, _)| *name);
        let calls = calls(&all);
        faults.extend(recursion(helpers, &all, &calls));
        let callers = all.iter().filter(|(name, _)| is_caller(name)).map(|(name, _)| (*name).to_owned()).collect();
        let all = in_order(all, &called_first(&calls));
        let mut made = Self { callers, reach: reach(&all), ..Self::default() };
        faults.extend(all.iter().filter_map(|(name, read)| {
            let fault = made.check(&read.body).err()?;
            Some(GraphFault { id: (*name).to_owned(), reason: fault.into() })
        }));
        if !faults.is_empty() {
            return Err(faults);
        }
        made.operations = limits.operations;
        made.functions = Rc::new(Functions { texts, read: OnceCell::new() });
        made.compiled = limits.compiled.then(|| compiled(&all, limits));
        Ok(made)
    }

    /// Refuses closures that a helper could keep, and calls with so many values that only a helper could take them, where
    /// there is no such helper.
    pub(crate) fn check(&self, body: &AST) -> Result<(), BodyFault> {
        walk::check_widths(body, &|name, values| self.takes(name, values))?;
        if self.callers.is_empty() { Ok(()) } else { check_closures(body, &self.callers) }
    }

    /// True if there is a helper for so many values.
    fn takes(&self, name: &str, values: usize) -> bool {
        self.reach.get(name).is_some_and(|helper| helper.params == values)
    }

    /// Returns the cost of a body's variables, unless it certainly ends within the limit of steps.
    pub(crate) fn cost(&self, body: &AST) -> Option<VariableCost> {
        let parts = walk::length(body, &|helper| self.reach.get(helper).map(|length| length.parts));
        let called = walk::called(body);
        let mut search = walk::search(body);
        self.reach.reached(&called).for_each(|length| search.add(length.search));
        let is_short = parts.is_some_and(|parts| parts.saturating_mul(STEPS_PER_PART) <= self.operations);
        if is_short && !search.is_wide() {
            return None;
        }
        let mut cost = VariableCost::of(body, false);
        self.reach.reached(&called).for_each(|length| cost.add(&length.cost));
        cost.lengthen(search.more_steps());
        Some(cost)
    }

    /// The helpers for the first tier, if it is wanted.
    pub(crate) fn compiled(&self) -> Option<&CompiledHelpers> {
        self.compiled.as_ref()
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
    /// Returns the reason why Rhai cannot read them.
    pub(crate) fn joined(&self, engine: &Engine, body: AST) -> Result<AST, BodyFault> {
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

    fn read(&self, engine: &Engine) -> Result<&AST, BodyFault> {
        if let Some(read) = self.read.get() {
            return Ok(read);
        }
        let mut all = AST::empty();
        for text in &self.texts {
            all.combine(read_function(engine, text, &[])?);
        }
        Ok(self.read.get_or_init(|| all))
    }
}

fn read_function(engine: &Engine, text: &str, params: &[String]) -> Result<AST, BodyFault> {
    engine.compile(text).map_err(|error| BodyFault::Syntax(Syntax::of(error, params)))
}

fn compile_one<'f>(engine: &Engine, helper: &'f FileHelper) -> Result<ReadHelper<'f>, BodyFault> {
    if let Some(bad) = std::iter::once(&helper.name).chain(&helper.params).find(|name| !is_identifier(name)) {
        return Err(BodyFault::Name(bad.clone()));
    }
    check_distinct(&helper.params)?;
    // By itself first: only a text that is whole by itself may be put between the brackets of a function.
    let body = compile(engine, &helper.params, &helper.body)?;
    let function = format!("fn {}({}) {{\n{}\n}}", helper.name, helper.params.join(", "), helper.body);
    read_function(engine, &function, &helper.params)?;
    let calls = walk::called(&body);
    Ok(ReadHelper { params: &helper.params, body, function, calls })
}

/// Returns the helpers that each helper calls, by their place in `all`, which has them in the order of their names.
fn calls(all: &[(&str, ReadHelper)]) -> Vec<Vec<usize>> {
    let place = |name: &String| all.binary_search_by_key(&name.as_str(), |(known, _)| known).ok();
    all.iter().map(|(_, read)| read.calls.iter().filter_map(place).collect()).collect()
}

/// Those that are called before those that call them.
fn in_order<'f>(all: Vec<(&'f str, ReadHelper<'f>)>, order: &[usize]) -> Vec<(&'f str, ReadHelper<'f>)> {
    let mut all: Vec<_> = all.into_iter().map(Some).collect();
    order.iter().filter_map(|at| all[*at].take()).collect()
}

/// Compiles the helpers for the first tier.
fn compiled(all: &[(&str, ReadHelper)], limits: &Limits) -> CompiledHelpers {
    let mut compiled = CompiledHelpers::of(limits);
    for (name, read) in all {
        compiled.add(name, read.params, &read.body);
    }
    compiled
}

/// Returns the bounds of one call of each helper.
fn reach(all: &[(&str, ReadHelper)]) -> HelperReach {
    let mut reach = HelperReach::default();
    for (name, read) in all {
        reach.add(name, read.params.len(), &read.body, &read.calls, walk::search(&read.body));
    }
    reach
}

/// Refuses two equal names among arguments.
pub(crate) fn check_distinct(names: &[String]) -> Result<(), BodyFault> {
    let twice = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name));
    twice.map_or(Ok(()), |(_, name)| Err(BodyFault::NameTwice(name.clone())))
}

/// Helpers that call themselves, also through others, in the order of the file.
fn recursion(helpers: &[FileHelper], all: &[(&str, ReadHelper)], calls: &[Vec<usize>]) -> Vec<GraphFault> {
    let looping: LookupSet<&str> =
        all.iter().zip(circular(calls)).filter(|(_, is)| *is).map(|((name, _), _)| *name).collect();
    let faulty = helpers.iter().filter(|helper| looping.contains(helper.name.as_str()));
    faulty
        .map(|helper| GraphFault { id: helper.name.clone(), reason: Reason::CallsItself(helper.name.clone()) })
        .collect()
}
