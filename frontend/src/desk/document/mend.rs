//! The server's knowledge of the open program beyond its records: what mends a problem, and what streams carry.
//! Of a helper's value, what its record says comes first, then what its procedure makes, then what this page saw last.

use super::Document;
use crate::desk::tab::{new_id, set_if_new};
use crate::live;
use behaviour::{Fix, Id, Problem, ProblemKind, SeenKinds, Unit, Value, ValueType};
use leptos::prelude::*;
use protocol::{answer, request};

/// Of so many streams the server is told what was seen on them.
const SEEN_MAX: usize = 300;

impl Document {
    /// Asks what mends a problem, if anything could; nothing is told if nothing does.
    pub(crate) fn fixes(&self, problem: &Problem, then: impl FnOnce(Vec<Fix>) + 'static) {
        let may_be_mended = matches!(
            problem.kind,
            ProblemKind::WrongUnit { .. }
                | ProblemKind::WrongType { .. }
                | ProblemKind::FightingActions { .. }
                | ProblemKind::PressAndRelease { .. }
                | ProblemKind::FasterThanAction { .. }
                | ProblemKind::StaleCombine { .. }
                | ProblemKind::UnknownName { .. }
                | ProblemKind::ObjectAsNumber { .. }
                | ProblemKind::Body(_)
                | ProblemKind::Stores
                | ProblemKind::OtherwiseDiffers { .. }
                | ProblemKind::WholeDivision { .. }
        );
        let Some(behaviour) = self.open.get_untracked().filter(|_| may_be_mended) else { return };
        self.tab.look_up(request::Fixes { behaviour, problem: problem.clone(), seen: self.seen() }, |answer| {
            if let Ok(answer::Fixes { fixes }) = answer
                && !fixes.is_empty()
            {
                then(fixes);
            }
        });
    }

    /// Does what mends a problem, as one change; then what is left to do once that is so.
    pub(crate) fn mend(&self, fix: &Fix, then: impl FnOnce() + 'static) {
        let tab = self.tab.clone();
        let change = fix.change(new_id(), &self.tab.my_name());
        let change = self.state().editor.with_room(change);
        self.propose_and(change, move |answer| {
            if answer.is_ok() {
                then();
            }
            tab.say_refusal(answer);
        });
    }

    /// Asks what the streams of the open program carry.
    pub(crate) fn ask_types(&self) {
        let Some(behaviour) = self.open.get_untracked() else { return };
        let (document, asked, at) = (self.clone(), behaviour.clone(), self.revision.get_untracked());
        self.tab.look_up(request::Types { behaviour, seen: self.seen() }, move |answer| {
            if let Ok(answer::Types { types, hints }) = answer
                && document.is_open(&asked)
            {
                set_if_new(&document.types, types);
                // What was wrong before a change may be mended by it.
                if document.revision.get_untracked() == at {
                    document.hear_hints(&hints);
                }
            }
        });
    }

    /// Hears what only the values of a run tell, beside what is known without them.
    fn hear_hints(&self, hints: &[Problem]) {
        let known = self.problems.get_untracked();
        let new: Vec<_> = hints.iter().filter(|hint| !known.contains(hint)).cloned().collect();
        if !new.is_empty() {
            self.problems.set(known.into_iter().chain(new).collect());
        }
    }

    /// The kinds of the newest values.
    fn seen(&self) -> SeenKinds {
        let kind = |id: &Id| {
            let live = self.stream(id)?.live;
            live.with_untracked(|live| live.value.as_ref().map(|value| (id.clone(), ValueType::of(value))))
        };
        self.stream_ids.with_untracked(|ids| ids.iter().filter_map(kind).take(SEEN_MAX).collect())
    }

    /// In what the numbers of a stream are measured; empty if they are not, or if that is not known. Reactive.
    pub(crate) fn unit(&self, id: &Id) -> &'static str {
        self.measure(id, &[]).0
    }

    /// True if the lengths of the open program are in centimetres, all that are known. Reactive.
    pub(crate) fn in_centimetres(&self) -> bool {
        self.types.with(|types| {
            let has = |unit: Unit| types.values().any(|kind| measures(kind, unit));
            has(Unit::Centimetres) && !has(Unit::Metres)
        })
    }

    /// A value of a stream with its unit. Reactive.
    pub(crate) fn measured(&self, id: &Id, value: &Value) -> String {
        self.types.with(|types| live::measured(value, types.get(id)))
    }

    /// In what a number in the values of a stream is measured, and between which numbers it lies; `path` are the fields
    /// that lead to it. Reactive.
    pub(crate) fn measure(&self, id: &Id, path: &[&str]) -> (&'static str, Option<(f64, f64)>) {
        self.types.with(|types| {
            let whole = types.get(id).cloned().unwrap_or_default();
            let kind = path.iter().fold(whole, |of, name| of.field(name).unwrap_or_default());
            let range = if let ValueType::Number { range, .. } = &kind { *range } else { None };
            (live::unit(&kind), range)
        })
    }
}

/// True if some number in values of a kind is in that unit.
fn measures(kind: &ValueType, unit: Unit) -> bool {
    match kind {
        ValueType::Record(fields) => fields.values().any(|kind| measures(kind, unit)),
        ValueType::List(kind) => measures(kind, unit),
        number => number.unit() == Some(unit),
    }
}
