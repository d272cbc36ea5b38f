//! The number with which an action would have come: put into the program of today, and taken back.

use super::super::PastShared;
use crate::desk::{Document, Saving};
use crate::live::short_value;
use crate::past::words;
use crate::sentences::change::{New, put_and, with};
use behaviour::{Id, Kind, Operation, Procedure, Record, RecordId, Value};
use leptos::prelude::*;
use protocol::NumberFix;
use sentences::LiteralPlace;

/// A number with which it would have come.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AnswerFix {
    number: NumberFix,
    /// The operation that ran, in whose body the number stands.
    ran: Operation,
}

impl AnswerFix {
    pub(super) fn of(number: &NumberFix, ran: Operation) -> Self {
        Self { number: number.clone(), ran }
    }

    /// The number with its unit.
    pub(super) fn words(&self) -> String {
        words::with_unit(short_value(&Value::Float(self.number.to)), &self.number.unit)
    }

    /// The place of the number.
    fn place(&self) -> Option<LiteralPlace> {
        let NumberFix { connector, start, end, .. } = &self.number;
        Some(LiteralPlace::Body { connector: Id::new(connector).ok()?, start: *start, end: *end })
    }

    fn written(&self) -> New {
        New::Text(self.number.written.clone())
    }

    /// True if an operation is the one that ran, and the number stands in it.
    fn stands_in(&self, operation: &Operation) -> bool {
        let Some(Procedure::Body { body, .. }) = operation.procedure().filter(|_| *operation == self.ran) else {
            return false;
        };
        let NumberFix { start, end, from, .. } = self.number;
        let stands = body.get(start..end).and_then(|number| number.trim().parse::<f64>().ok());
        stands.is_some_and(|stands| (stands - from).abs() <= 1e-9 * from.abs().max(1.0))
    }

    /// The operation with the number of the fix.
    fn made(&self) -> Option<Operation> {
        with(&self.ran, &self.place()?, &self.written())
    }
}

impl PastShared {
    /// Puts the number with which it would have come into the program of today, as a change that can be taken back; `done` hears
    /// that it is saved.
    pub(super) fn take_fix(self, fix: &AnswerFix, done: impl FnOnce() + 'static) {
        let desk = self.desk.desk();
        let Some(at) = fix.place() else { return };
        let (LiteralPlace::Body { connector: id, .. } | LiteralPlace::Period { connector: id }) = &at else { return };
        let after = desk.clone();
        desk.document.with_now(|document| {
            let seen = document.behaviour().connector(id).filter(|seen| fix.stands_in(&seen.operation)).cloned();
            let Some(seen) = seen else { return after.say(words::fix_is_late(), true) };
            let said = after.clone();
            put_and(&desk, &at, Some(Record::Connector(seen)), fix.written(), move |answer| {
                if answer.is_ok() {
                    done();
                }
                said.say_refusal(answer);
            });
        });
    }

    /// Takes back a fix, and nothing else.
    pub(super) fn take_back(self, fix: &AnswerFix) {
        if untrack(|| self.can_take_back(fix)) {
            self.desk.desk().document.with_now(Document::undo);
        }
    }

    /// True while a fix is the last that this person did: undo takes back that. Reactive.
    pub(super) fn can_take_back(self, fix: &AnswerFix) -> bool {
        let desk = self.desk.desk();
        let me = desk.me.read().as_ref().map(|me| me.client.clone());
        let record = Id::new(&fix.number.connector).ok().map(|id| RecordId::new(Kind::Connector, &id));
        let (Some(me), Some(record), Some(made)) = (me, record, fix.made()) else { return false };
        let is_it = |after: &Option<Record>| matches!(after, Some(Record::Connector(now)) if now.operation == made);
        let nothing_waits = *desk.document.saving.read() == Saving::Saved;
        nothing_waits
            && desk.document.history.with(|history| {
                let mine = history.newest_first().find(|line| line.by.as_ref() == Some(&me));
                mine.is_some_and(|line| {
                    line.undoes.is_none() && line.edits.iter().any(|edit| edit.id == record && is_it(&edit.after))
                })
            })
    }
}

#[cfg(test)]
mod tests {
    use super::AnswerFix;
    use behaviour::Procedure;
    use protocol::NumberFix;

    #[test]
    fn a_fix_goes_where_its_number_stands_and_nowhere_else() {
        let test = |body: &str| behaviour::connectors::filter::SPEC.with(Procedure::body(body));
        let fix = |ran: &str| {
            let (connector, written, unit) = ("c".into(), "0.95".into(), "cm".into());
            let number = NumberFix { connector, start: 11, end: 15, from: 0.75, to: 95.0, written, unit };
            AnswerFix::of(&number, test(ran))
        };
        let ran = fix("distance < 0.75");
        assert_eq!((ran.stands_in(&ran.ran), ran.made()), (true, Some(test("distance < 0.95"))));
        assert!(!ran.stands_in(&test("distance < 0.80")), "somebody changed it since");
        assert!(!ran.stands_in(&test("distance < 0.755")), "it only begins with the number");
        assert!(!ran.stands_in(&test("d < 1")));
        assert!(!fix("d < 1").stands_in(&test("d < 1")));
    }
}
