//! What becomes of the value now, what the robot uses of what was changed, and the ways to the dialog and to the bin.

use super::now::{measured, shown};
use super::{Turned, now};
use crate::desk::Selected;
use crate::live::short_value;
use crate::panels::inspector::edit_dialog;
use crate::parts::{DeskHold, RemoveButton, may_edit};
use crate::words;
use behaviour::{Connector, Id, Operation, Procedure, Value};
use editor::numbers::{NumberTest, number_tests};
use leptos::prelude::*;

/// Whether the values now pass as it would be saved; nothing where that cannot be told, or nothing is left out. Reactive.
pub(super) fn passes(turned: Turned, record: Memo<Connector>) -> Option<bool> {
    let tests = number_tests(&turned.body(record)).filter(|_| record.read().operation.spec().is_test())?;
    let now = |test| measured(turned.desk, &record.read(), test, 0.0).now;
    tests.passes(&tests.all.iter().map(now).collect::<Option<Vec<f64>>>()?)
}

/// What becomes of the values now, in words. Reactive.
pub(super) fn becomes(turned: Turned, record: Memo<Connector>) -> Option<String> {
    let tests = number_tests(&turned.body(record))?;
    let all: Vec<now::ComparedNow> =
        tests.all.iter().map(|test| measured(turned.desk, &record.read(), test, 0.0)).collect();
    let values = all.iter().map(|of| of.now).collect::<Option<Vec<f64>>>()?;
    let passes = tests.passes(&values)?;
    let mut given: Vec<String> =
        all.iter().zip(&values).map(|(of, value)| words::with_unit(shown(*value), of.unit)).collect();
    let subject = |test: Option<&NumberTest>| test.map(|test| test.subject.clone());
    if given.len() > 1 && subject(tests.all.first()) == subject(tests.all.last()) {
        given.truncate(1);
    }
    let given = words::listed(given);
    Some(match (record.read().operation.spec().is_test(), passes) {
        (true, true) => words::value_passes(&given),
        (true, false) => words::value_left_out(&given),
        (false, passes) => words::trial(&given, &short_value(&Value::Bool(passes))),
    })
}

/// What the robot still uses in the place of what is here now. Reactive.
pub(super) fn still_used(desk: DeskHold, id: &Id, record: Memo<Connector>) -> Option<String> {
    let desk = desk.desk();
    desk.robots.unused.track();
    let (ran, record) = (desk.robots.ran(id)?, record.read());
    let unit = desk.document.measure(record.inputs.first()?, &[]).0;
    instead_of(&ran.operation, &record.operation, unit)
}

/// What the robot still uses in the place of what is here now, in few words: the number where only that differs.
pub(in crate::panels) fn instead_of(ran: &Operation, now: &Operation, unit: &str) -> Option<String> {
    if ran.spec() != now.spec() {
        return Some(words::connector_word(ran.spec()).to_owned());
    }
    match (ran.procedure(), now.procedure()) {
        (Some(Procedure::Body { body: before, .. }), Some(Procedure::Body { body: after, .. })) if before != after => {
            let (was, is) = (number_tests(before), number_tests(after));
            Some(match (was.as_ref().map(|it| &it.all[..]), is.as_ref().map(|it| &it.all[..])) {
                (Some([was]), Some([is])) if (&was.subject, was.sign) == (&is.subject, is.sign) => {
                    words::with_unit(was.written(was.number), if was.subject.contains('.') { "" } else { unit })
                }
                _ => before.trim().to_owned(),
            })
        }
        (Some(Procedure::Helper(before)), Some(after)) if *after != Procedure::Helper(before.clone()) => {
            Some(before.clone())
        }
        _ => {
            let before = ran.period_ms().filter(|before| Some(*before) != now.period_ms())?;
            Some(words::with_unit((before as f64 / 1_000.0).to_string(), words::seconds_unit()))
        }
    }
}

/// What becomes of the value now, the dialog, and the bin.
#[component]
pub(super) fn Foot(id: Id, record: Memo<Connector>, turned: Turned, said: Memo<Option<String>>) -> impl IntoView {
    let desk = turned.desk;
    let removed = Selected::Connector(id.clone());
    let word = record.with_untracked(|connector| words::connector_word(connector.operation.spec()));
    let look = if untrack(|| may_edit(desk)) { words::more_of_it() } else { words::look_at_it() };
    let open = move |_| {
        turned.save();
        desk.desk().dialog.set(Some(edit_dialog(&id, &record.get_untracked())));
    };
    view! {
        <div class="control-foot" role="toolbar" aria-label=words::next_steps(word)>
            <span class="second">{said}</span>
            <button type="button" class="link" on:click=open>{look}</button>
            <RemoveButton what=removed class="tool-button" />
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::instead_of;
    use behaviour::{Operation, Parameters, Procedure, connectors};

    #[test]
    fn what_the_robot_still_uses_is_said_shortly() {
        let filter = |body: &str| connectors::filter::SPEC.with(Procedure::body(body));
        let said = |was: &Operation, is: &Operation| instead_of(was, is, "cm");
        assert_eq!(said(&filter("d < 40"), &filter("d < 45")).as_deref(), Some("40\u{a0}cm"));
        assert_eq!(said(&filter("d < 40"), &filter("d > 40")).as_deref(), Some("d < 40"));
        assert_eq!(said(&filter("d.x < 0.5"), &filter("d.x < 0.6")).as_deref(), Some("0.5"));
        let helper = |name: &str| connectors::map::SPEC.with(Procedure::Helper(name.to_owned()));
        assert_eq!(said(&helper("near"), &helper("far")).as_deref(), Some("near"));
        assert_eq!(said(&helper("near"), &helper("near")), None, "the helper itself works otherwise");
        let sample = |ms| connectors::sample::SPEC.with(Parameters::period(ms));
        assert_eq!(said(&sample(1_000), &sample(500)).as_deref(), Some("1\u{a0}s"));
    }
}
