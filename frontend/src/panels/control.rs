//! A connector as a control: its number, its helper or its duration can be changed where it is shown.

mod foot;
mod lock;
mod now;
mod rows;
mod slider;
mod test;

use crate::browser;
use crate::desk::Desk;
use crate::panels::hold::{Hold, hold};
use crate::panels::may::{MayNot, may_edit};
use crate::panels::uses::Uses;
use crate::words;
use behaviour::{Connector, Id, Kind, Operation, Procedure, RecordId};
use foot::{Foot, becomes, still_used};
use leptos::prelude::*;
use lock::Lock;
use rows::{HelperRow, PeriodRow, TestRow};
use test::tests;
pub(crate) use test::{replaced, written_like};

/// After so long without another press, what was turned is saved, in milliseconds.
const SAVE_AFTER_MS: i32 = 500;

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
    let turned = Turned::new(desk, id.clone(), move || !may_edit(desk) || editor.read().is_some() || waits.get());
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
        <div class="control" class:reads=move || turned.reads.get() class:held-by=move || editor.read().is_some() style=("--person", person)>
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
        Some(Procedure::Body { body, .. }) => tests(body).map_or(Simple::Other, |tests| Simple::Tests(tests.all.len())),
        Some(Procedure::Helper(_)) => Simple::Helper,
        None if connector.operation.period_ms().is_some() => Simple::Period,
        None => Simple::Other,
    }
}

/// What was turned and is not saved yet.
#[derive(Clone, Copy)]
struct Turned {
    desk: Hold,
    id: StoredValue<Id>,
    operation: RwSignal<Option<Operation>>,
    presses: StoredValue<u32>,
    /// Whether one only reads: for who may not edit, and while somebody else is editing it.
    reads: Memo<bool>,
}

impl Turned {
    fn new(desk: Hold, id: Id, reads: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        let turned = Self {
            desk,
            id: StoredValue::new(id),
            operation: RwSignal::new(None),
            presses: StoredValue::new(0),
            reads: Memo::new(move |_| reads()),
        };
        // What waits when the control goes away is saved too.
        let (late, id, operation) = (desk.desk(), turned.id.get_value(), turned.operation);
        on_cleanup(move || {
            if let Some(operation) = operation.try_get_untracked().flatten() {
                save(&late, &id, operation);
            }
        });
        turned
    }

    /// As it would be saved: what was turned last, else what is there. Reactive.
    fn now(self, record: Memo<Connector>) -> Operation {
        self.operation.get().unwrap_or_else(|| record.read().operation.clone())
    }

    fn body(self, record: Memo<Connector>) -> String {
        match self.now(record).procedure() {
            Some(Procedure::Body { body, .. }) => body.clone(),
            Some(Procedure::Helper(_)) | None => String::new(),
        }
    }

    /// Another operation, saved at once or a moment after the last press.
    fn turn(self, operation: Operation, at_once: bool) {
        if self.reads.get_untracked() {
            return;
        }
        self.desk.desk().document.typing();
        self.operation.set(Some(operation));
        let mine = self.presses.get_value() + 1;
        self.presses.set_value(mine);
        let rests = move || self.presses.try_get_value() == Some(mine);
        let save = move || {
            if rests() {
                self.save();
            }
        };
        if at_once { save() } else { browser::after(SAVE_AFTER_MS, save) }
    }

    fn turn_body(self, record: Memo<Connector>, body: String, at_once: bool) {
        let mut operation = untrack(|| self.now(record));
        if let Some(procedure) = operation.procedure_mut() {
            match procedure {
                Procedure::Body { body: old, .. } => *old = body,
                Procedure::Helper(_) => return,
            }
        }
        self.turn(operation, at_once);
    }

    fn save(self) {
        if let Some(operation) = self.operation.get_untracked() {
            self.operation.set(None);
            save(&self.desk.desk(), &self.id.get_value(), operation);
        }
    }
}

fn save(desk: &Desk, id: &Id, operation: Operation) {
    let Some(signals) = desk.document.connector(id) else { return };
    let seen = signals.record.get_untracked();
    if seen.operation == operation {
        return;
    }
    let (inputs, after) = (seen.inputs.clone(), desk.clone());
    desk.document.edit_connector((id, seen), operation, inputs, None, move |answer| after.say_refusal(answer));
}
