//! A connector as a control: its number, its helper or its duration can be changed where it is shown.

mod foot;
mod lock;
mod now;
mod rows;
mod slider;
mod turned;

use crate::forms::uses::Uses;
use crate::forms::words;
use crate::parts::{MayNot, hold, may_edit};
use behaviour::{Connector, Id, Kind, Procedure, RecordId};
use editor::numbers::number_tests;
use foot::{Foot, becomes, still_used};
use leptos::prelude::*;
use lock::Lock;
use rows::{HelperRow, PeriodRow, TestRow};
use turned::Turned;

/// A connector as a control; `whole` with the ways to its dialog and to the bin.
pub(crate) fn control(id: Id, whole: bool) -> AnyView {
    view! { <ConnectorControl id whole asks=true /> }.into_any()
}

/// What is changed most, and below it what becomes of the value now, what the robot uses, the dialog and the bin.
#[component]
pub(crate) fn ConnectorControl(
    id: Id,
    /// With the way to the dialog and to the bin below.
    #[prop(optional)]
    whole: bool,
    /// With the way to ask whoever else is editing it.
    #[prop(optional)]
    asks: bool,
) -> impl IntoView {
    let desk = hold();
    let Some(signals) = desk.desk().document.connector(&id) else { return ().into_any() };
    let key = RecordId::new(Kind::Connector, &id);
    let editor = Memo::new({
        let key = key.clone();
        move |_| desk.desk().document.editor_of(&key)
    });
    let waits = RwSignal::new(false);
    let root = NodeRef::<leptos::html::Div>::new();
    let turned =
        Turned::new(desk, (id.clone(), root), move || !may_edit(desk) || editor.read().is_some() || waits.get());
    let record = Memo::new(move |_| signals.record.get());
    let simple = Memo::new(move |_| simple(&record.read()));
    let control = move || match simple.get() {
        Simple::Tests(count) => (0..count).map(|at| view! { <TestRow record turned at /> }).collect_view().into_any(),
        Simple::Period => view! { <PeriodRow record turned /> }.into_any(),
        Simple::Helper => view! { <HelperRow record turned /> }.into_any(),
        Simple::Other => {
            view! { <p class="second">{move || words::connector_says(record.read().operation.spec())}</p> }.into_any()
        }
    };
    let used = StoredValue::new(id.clone());
    let said = Memo::new(move |_| becomes(turned, record));
    let person = move || editor.get().map(|editor| format!("var(--people-{})", editor.color));
    view! {
        <div class="control" class:reads=move || turned.reads.get() class:held-by=move || editor.read().is_some() style=("--person", person)
            node_ref=root on:focusin=move |event| turned.came(&event) on:focusout=move |event| turned.left(&event)>
            {control}
            {(!whole).then(|| view! { <p class="second" hidden=move || said.read().is_none()>{said}</p> })}
            <Uses id=id.clone() instead=move || used.with_value(|id| still_used(desk, id, record)) />
            <Lock key editor waits record asks />
            {whole.then(|| view! { <Foot id record turned said /> <MayNot /> })}
        </div>
    }
    .into_any()
}

/// What of a connector is changed by hand.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Simple {
    /// So many comparisons with a number.
    Tests(usize),
    Period,
    Helper,
    /// Only in the dialog.
    Other,
}

fn simple(connector: &Connector) -> Simple {
    match connector.operation.procedure() {
        Some(Procedure::Body { body, .. }) => {
            number_tests(body).map_or(Simple::Other, |tests| Simple::Tests(tests.all.len()))
        }
        Some(Procedure::Helper(_)) => Simple::Helper,
        None if connector.operation.period_ms().is_some() => Simple::Period,
        None => Simple::Other,
    }
}
