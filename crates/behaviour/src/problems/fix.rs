//! Fixes that mend a problem with one tap: each is one change of the behaviour, and one step of undo.

mod draft;

use super::around::HintSurroundings;
use super::{Problem, ProblemKind, ways};
use crate::connectors::{to_choose, to_leave_out_the_same, to_new_value, to_slow_down, to_tell_the_time};
use crate::otherwise;
use crate::{
    AsMeant, Behaviour, Change, Connector, Edit, Fit, Helper, Id, Kind, Knowledge, Operation, Parameters, Procedure,
    SeenKinds, Unit, ValueType, as_meant, rename_identifiers, rename_unknown,
};
use draft::FixDraft;
use phrase::{Phrase, Phrased};
use serde::{Deserialize, Serialize};

/// The time between values that were too many, in milliseconds.
const SLOW_MS: u64 = 1_000;
/// The age beyond which values are left out, in milliseconds.
const OLD_MS: u64 = 1_000;
/// The most parts of an object that are offered.
const PARTS_MAX: usize = 3;
/// The most helpers that are offered.
const HELPERS_MAX: usize = 3;

/// Something that mends a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Fix {
    /// The kind of fix.
    pub kind: FixKind,
    /// The records that it changes, all in one change.
    pub edits: Vec<Edit>,
}

/// The kinds of fixes. [`std::fmt::Display`] says each in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum FixKind {
    /// Puts a conversion between.
    Convert {
        /// The unit that comes.
        from: Unit,
        /// The unit that is wanted.
        to: Unit,
    },
    /// Uses another helper where one is used.
    UseHelper(String),
    /// Puts a helper between.
    PutHelper(String),
    /// Lets an action win whenever both want the same part.
    Prefer(String),
    /// Lets only true pass.
    OnlyPressed,
    /// Passes on the newest value at a steady beat, in milliseconds.
    SlowDown(u64),
    /// Passes on only what changed.
    OnlyChanges,
    /// Leaves out what was combined with a value older than so many milliseconds.
    LeaveOutOld(u64),
    /// Writes another name.
    Rename {
        /// The name as it is written.
        from: String,
        /// The name that is meant.
        to: String,
    },
}

impl Fix {
    /// The label of its change: labels have no full stop.
    fn label(&self) -> Phrase {
        match self.kind.phrase() {
            Phrase::Keyed(mut keyed) => {
                keyed.english = keyed.english.trim_end_matches('.').to_owned().into();
                Phrase::Keyed(keyed)
            }
            other => other,
        }
    }

    /// The change that does it.
    #[must_use]
    pub fn change(&self, op: Id, author: &str) -> Change {
        Change { edits: self.edits.clone(), ..Change::of(op, author, self.label()) }
    }
}

/// Returns the fixes for a problem of a behaviour, the likeliest first; none if only people know. `helpers` is the
/// library, and `new_id` gives ids that nobody has.
pub fn fixes(
    problem: &Problem,
    behaviour: &Behaviour,
    helpers: &[&Helper],
    knowledge: &dyn Knowledge,
    new_id: &mut dyn FnMut() -> Id,
) -> Vec<Fix> {
    fixes_seeing(problem, behaviour, (helpers, &SeenKinds::new()), knowledge, new_id)
}

/// Returns the fixes with the library and what was seen last, for a problem that was found with both.
pub fn fixes_seeing(
    problem: &Problem,
    behaviour: &Behaviour,
    (helpers, seen): (&[&Helper], &SeenKinds),
    knowledge: &dyn Knowledge,
    new_id: &mut dyn FnMut() -> Id,
) -> Vec<Fix> {
    let around = HintSurroundings::of(behaviour, helpers, knowledge, seen);
    let mut fixer = Fixer { around: &around, at: &problem.at.id, new_id };
    match (&problem.kind, problem.at.kind) {
        (ProblemKind::WrongUnit { wants, gets }, Kind::Connector) => fixer.unit(*gets, *wants),
        (ProblemKind::WrongType { .. }, Kind::Connector) => fixer.kind(),
        (ProblemKind::UnknownName { name, near }, Kind::Connector) => fixer.name(name, near).into_iter().collect(),
        (ProblemKind::Body(_), Kind::Connector) => fixer.as_meant(),
        (ProblemKind::OtherwiseDiffers { .. }, Kind::Connector) => fixer.following().into_iter().collect(),
        (ProblemKind::Stores | ProblemKind::WholeDivision { .. }, Kind::Connector) => {
            fixer.without_slip().into_iter().collect()
        }
        (ProblemKind::ObjectAsNumber { .. }, Kind::Connector) => fixer.parts(),
        (ProblemKind::StaleCombine { .. }, Kind::Connector) => fixer.stale().into_iter().collect(),
        (ProblemKind::FightingActions { with, .. }, Kind::Stream) => fixer.fighting(with),
        (ProblemKind::PressAndRelease { .. }, Kind::Stream) => fixer.pressed(),
        (ProblemKind::FasterThanAction { .. }, Kind::Stream) => fixer.slower(),
        _ => Vec::new(),
    }
}

struct Fixer<'a, 'n> {
    around: &'a HintSurroundings<'a>,
    at: &'a Id,
    new_id: &'n mut dyn FnMut() -> Id,
}

impl<'a> Fixer<'a, '_> {
    fn connector(&self) -> Option<&'a Connector> {
        self.around.behaviour.connector(self.at)
    }

    fn draft(&mut self) -> FixDraft<'_> {
        FixDraft::of(self.around.behaviour, self.new_id)
    }

    fn unit(&mut self, from: Unit, to: Unit) -> Vec<Fix> {
        let found = self.connector().and_then(|connector| Some((connector, self.around.misfit(connector)?)));
        let Some((connector, (at, wants, Fit::Unit { .. }))) = found else { return Vec::new() };
        let mut fixes = Vec::new();
        let input = &connector.inputs[at];
        let (id, name, mut draft) = (self.at, self.around.name(input), self.draft());
        if let Some(body) = from.convert(to, &draft.argument(input)) {
            let made = to_new_value().with(Procedure::body(&body));
            draft.between(id, at, made, &to.of(&name));
            fixes.push(draft.fix(FixKind::Convert { from, to }));
        }
        fixes.extend(self.other_source(input, &wants));
        fixes
    }

    /// Another helper where the values come from, if nobody else takes them.
    fn other_source(&mut self, input: &Id, wants: &ValueType) -> Vec<Fix> {
        let [(id, source)] = self.around.graph.into_stream(input) else { return Vec::new() };
        if self.around.graph.out_of_stream(input).len() > 1 {
            return Vec::new();
        }
        self.other_helpers(id, source, |gives| *gives != ValueType::Any && wants.takes(gives) == Fit::Good)
    }

    /// Offers the connector with each other helper that takes what comes, and gives what fits.
    fn other_helpers(&mut self, id: &Id, connector: &Connector, fits: impl Fn(&ValueType) -> bool) -> Vec<Fix> {
        let Some(Procedure::Helper(now)) = connector.operation.procedure() else { return Vec::new() };
        let arguments = self.around.inference.arguments(self.around.behaviour, connector);
        let gets: Vec<ValueType> = arguments.into_iter().map(|(_, of)| of).collect();
        let others = self.helpers_for(&gets, fits).into_iter().filter(|name| name != now).take(HELPERS_MAX);
        let others: Vec<String> = others.collect();
        let use_helper = |name: String| {
            let mut draft = self.draft();
            draft.set_procedure(id, Procedure::Helper(name.clone()));
            draft.fix(FixKind::UseHelper(name))
        };
        others.into_iter().map(use_helper).collect()
    }

    /// The helpers that were declared to take such values and give what fits, by name.
    fn helpers_for(&self, gets: &[ValueType], fits: impl Fn(&ValueType) -> bool) -> Vec<String> {
        let is_for = |name: &&&str| {
            let Some(signature) = self.around.inference.signature(name) else { return false };
            let takes = |(wants, gets): (&ValueType, &ValueType)| wants.takes(gets) == Fit::Good;
            signature.takes.len() == gets.len() && signature.takes.iter().zip(gets).all(takes) && fits(&signature.gives)
        };
        self.around.inference.helper_names().iter().filter(is_for).map(|name| (*name).to_owned()).collect()
    }

    fn kind(&mut self) -> Vec<Fix> {
        let Some(connector) = self.connector() else { return Vec::new() };
        let Some((at, wants, Fit::Not)) = self.around.misfit(connector) else { return Vec::new() };
        let gives = match connector.operation.procedure() {
            Some(Procedure::Helper(now)) => self.around.inference.signature(now).map(|signature| signature.gives),
            Some(_) | None => None,
        };
        let mut fixes = match gives {
            Some(gives) => self.other_helpers(self.at, connector, |other| gives.takes(other) == Fit::Good),
            None => Vec::new(),
        };
        let gets = self.around.inference.of_stream(&connector.inputs[at]).clone();
        let fits = |gives: &ValueType| *gives != ValueType::Any && wants.takes(gives) == Fit::Good;
        for helper in self.helpers_for(&[gets], fits).into_iter().take(HELPERS_MAX) {
            let in_words = || helper.replace('_', " ");
            let name = self.around.knowledge.stream_of(&helper).map_or_else(in_words, str::to_owned);
            let (id, mut draft) = (self.at, self.draft());
            draft.between(id, at, to_new_value().with(Procedure::Helper(helper.clone())), &name);
            fixes.push(draft.fix(FixKind::PutHelper(helper)));
        }
        fixes
    }

    fn name(&mut self, from: &str, to: &str) -> Option<Fix> {
        let Some(Procedure::Body { body, args }) = self.connector()?.operation.procedure() else { return None };
        let renamed = rename_unknown(body, &self.around.behaviour.arguments(self.connector()?), from, to);
        let (at, args) = (self.at, args.clone());
        let mut draft = self.draft();
        draft.set_procedure(at, Procedure::Body { body: renamed, args });
        Some(draft.fix(FixKind::Rename { from: from.to_owned(), to: to.to_owned() }))
    }

    /// The other side of the test again.
    fn following(&mut self) -> Option<Fix> {
        let connector = self.connector()?;
        let (_, test) = otherwise::test_of(self.around.behaviour, connector)?;
        let body = otherwise::other_side(self.around.behaviour, test, connector)?;
        let args = match connector.operation.procedure()? {
            Procedure::Body { args, .. } => args.clone(),
            Procedure::Helper(_) => None,
        };
        let (at, to) = (self.at, body.clone());
        let mut draft = self.draft();
        draft.set_procedure(at, Procedure::Body { body, args });
        Some(draft.fix(FixKind::Rename { from: to.clone(), to }))
    }

    /// The procedure as it is meant in which `=` stands for `==`, or whole numbers lose what is left over.
    fn without_slip(&mut self) -> Option<Fix> {
        let connector = self.connector()?;
        let Some(Procedure::Body { body, args }) = connector.operation.procedure() else { return None };
        let (body, to) = match super::stores(self.around, connector) {
            Some(asks) => (asks.clone(), asks),
            None => crate::names::mistakes::divided(body).map(|divided| (divided.body, divided.meant))?,
        };
        let (at, from, args) = (self.at, to.clone(), args.clone());
        let mut draft = self.draft();
        draft.set_procedure(at, Procedure::Body { body, args });
        Some(draft.fix(FixKind::Rename { from, to }))
    }

    /// The procedure with signs in the place of those that only look right.
    fn as_meant(&mut self) -> Vec<Fix> {
        let procedure = self.connector().and_then(|connector| Some((connector, connector.operation.procedure()?)));
        let Some((connector, Procedure::Body { body, args })) = procedure else { return Vec::new() };
        let arguments = self.around.behaviour.arguments(connector);
        let write = |meant: AsMeant| {
            let (at, args) = (self.at, args.clone());
            let mut draft = self.draft();
            draft.set_procedure(at, Procedure::Body { body: meant.body.clone(), args });
            draft.fix(FixKind::Rename { from: body.clone(), to: meant.body })
        };
        as_meant(body, &arguments).into_iter().map(write).collect()
    }

    /// A part of an object in its place, or a number that a helper makes of it; nothing where it also stands for itself.
    fn parts(&mut self) -> Vec<Fix> {
        let Some(connector) = self.connector() else { return Vec::new() };
        let Some((name, times)) = super::misused(self.around, connector) else { return Vec::new() };
        let Some(Procedure::Body { body, args }) = connector.operation.procedure() else { return Vec::new() };
        let arguments = self.around.inference.arguments(self.around.behaviour, connector);
        let Some((_, of @ ValueType::Record(fields))) = arguments.iter().find(|(one, _)| *one == name) else {
            return Vec::new();
        };
        let measures = |of: &ValueType| matches!(of, ValueType::Number { .. }) && of.unit() != Some(Unit::Milliseconds);
        let parts = fields.iter().filter(|(_, of)| measures(of)).map(|(field, _)| format!("{name}.{field}"));
        let helpers = self.helpers_for(std::slice::from_ref(of), measures).into_iter();
        let helpers = helpers.map(|helper| format!("{helper}({name})"));
        let all: Vec<String> = parts.take(PARTS_MAX).chain(helpers.take(HELPERS_MAX)).collect();
        let write = |to: String| {
            let body = crate::names::replace_whole(body, &name, &to, times)?;
            let (at, args) = (self.at, args.clone());
            let mut draft = self.draft();
            draft.set_procedure(at, Procedure::Body { body, args });
            Some(draft.fix(FixKind::Rename { from: name.clone(), to }))
        };
        all.into_iter().filter_map(write).collect()
    }

    fn fighting(&mut self, with: &str) -> Vec<Fix> {
        let other = self.around.behaviour.streams().find(|(_, stream)| stream.name == with).map(|(id, _)| id);
        let Some(other) = other else { return Vec::new() };
        [(other, self.at), (self.at, other)]
            .map(|(winner, loser)| self.prefer(winner, loser))
            .into_iter()
            .flatten()
            .collect()
    }

    fn prefer(&mut self, winner: &Id, loser: &Id) -> Option<Fix> {
        let mut stream = self.around.stream(winner)?.clone();
        let above = self.around.stream(loser)?.priority.unwrap_or(0).max(stream.priority.unwrap_or(0));
        stream.priority = Some(above.checked_add(1)?);
        let name = stream.name.clone();
        let mut draft = self.draft();
        draft.set_stream(winner, stream);
        Some(draft.fix(FixKind::Prefer(name)))
    }

    /// The connectors that lead to the action of the problem and that such a problem comes through: putting something
    /// before all of them mends it.
    fn leading(&self, is_through: impl Fn(&Id) -> bool) -> Vec<(&'a Id, &'a Connector)> {
        let into = self.around.graph.into_stream(self.at).iter();
        into.copied().filter(|(_, connector)| connector.inputs.iter().any(&is_through)).collect()
    }

    fn before_action(
        &mut self,
        through: &[(&Id, &Connector)],
        kind: FixKind,
        operation: impl Fn(&str) -> Operation,
        suffix: &str,
    ) -> Fix {
        let around = self.around;
        let mut draft = self.draft();
        for (id, connector) in through {
            if let Some(input) = connector.inputs.first() {
                let (made, name) = (operation(&draft.argument(input)), around.name(input));
                draft.between(id, 0, made, &format!("{name} {suffix}"));
            }
        }
        draft.fix(kind)
    }

    fn pressed(&mut self) -> Vec<Fix> {
        let pressing = ways::pressing(self.around);
        let through = self.leading(|input| pressing.contains_key(input));
        if through.is_empty() {
            return Vec::new();
        }
        let test = |argument: &str| to_choose().with(Procedure::body(argument));
        vec![self.before_action(&through, FixKind::OnlyPressed, test, "pressed")]
    }

    fn slower(&mut self) -> Vec<Fix> {
        let fast = ways::fast(self.around);
        let through = self.leading(|input| fast.contains_key(input));
        if through.is_empty() {
            return Vec::new();
        }
        let slow = |_: &str| to_slow_down().with(Parameters::period(SLOW_MS));
        let same = |_: &str| to_leave_out_the_same().with(());
        vec![
            self.before_action(&through, FixKind::SlowDown(SLOW_MS), slow, "at times"),
            self.before_action(&through, FixKind::OnlyChanges, same, "changed"),
        ]
    }

    /// Mends it in the thesis' way (4.4.8): puts the time beside both values, says the age beside the result, and
    /// leaves out what is too old.
    fn stale(&mut self) -> Option<Fix> {
        let connector = self.connector()?;
        let (old, new) = ways::stale(self.around, connector)?;
        let Some(Procedure::Body { body, .. }) = connector.operation.procedure() else { return None };
        let arguments = self.around.behaviour.arguments(connector);
        if connector.inputs.len() != 2 || arguments.len() != 2 {
            return None;
        }
        let values: Vec<String> = arguments.iter().map(|name| format!("{name}.v")).collect();
        let valued = rename_identifiers(body, &arguments, &values);
        let body = format!("#{{v: {valued}, t: {}.t - {}.t}}", arguments[new], arguments[old]);
        let (at, around, to) = (self.at, self.around, &connector.output);
        let output = around.name(to);
        let mut draft = self.draft();
        for (place, input) in connector.inputs.iter().enumerate() {
            let name = format!("{} with time", around.name(input));
            draft.between(at, place, to_tell_the_time().with(()), &name);
        }
        draft.set_procedure(at, Procedure::Body { body, args: Some(arguments) });
        let aged = draft.after(at, &format!("{output} and age"))?;
        let test = Procedure::body(&format!("{}.t < {OLD_MS}", draft.argument(&aged)));
        let recent = draft.onward(&aged, to_choose().with(test), &format!("Recent {output}"), to);
        let value = Procedure::body(&format!("{}.v", draft.argument(&recent)));
        draft.connect(to_new_value().with(value), &recent, to);
        Some(draft.fix(FixKind::LeaveOutOld(OLD_MS)))
    }
}
