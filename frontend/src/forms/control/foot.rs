//! What becomes of the value now, what the robot uses of what was changed, and the ways to the dialog and to the bin.

use super::now::{measured, shown};
use super::{Turned, now};
use crate::desk::Selected;
use crate::forms::instead::instead_of;
use crate::forms::operation::edit_dialog;
use crate::forms::words;
use crate::live::short_value;
use crate::parts::{DeskHold, RemoveButton, may_edit};
use behaviour::{Connector, Id, Value};
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
