//! That somebody else is editing a connector, what one sees of it meanwhile, and the way to ask for it.

use crate::browser;
use crate::desk::OtherEditor;
use crate::dialogs::{DialogLock, Holding};
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::{DeskHold, hold};
use behaviour::{Connector, Procedure, RecordId};
use editor::numbers::number_tests;
use leptos::prelude::*;

/// Nothing while nobody else is editing it.
#[component]
pub(super) fn Lock(
    key: RecordId,
    editor: Memo<Option<OtherEditor>>,
    /// Set while one waits to be let in.
    waits: RwSignal<bool>,
    record: Memo<Connector>,
    /// With the way to ask.
    asks: bool,
) -> impl IntoView {
    let desk = hold();
    let asked = RwSignal::new(false);
    // A dialog has a lock of its own.
    let busy = Memo::new(move |_| desk.desk().dialog.read().is_some());
    Effect::new(move |_| {
        if busy.get() {
            asked.set(false);
        }
    });
    let written = Signal::derive(move || written(&record.read()));
    let shown = Memo::new(move |_| (asked.get(), editor.get().filter(|_| !asked.get())));
    move || match shown.get() {
        (true, _) => view! { <Asked key=key.clone() waits written /> }.into_any(),
        (false, Some(editor)) => {
            view! { <Meanwhile editor record written ask=asks.then_some(asked) busy /> }.into_any()
        }
        (false, None) => ().into_any(),
    }
}

/// Who is editing, and what holds until they save.
#[component]
fn Meanwhile(
    editor: OtherEditor,
    record: Memo<Connector>,
    written: Signal<String>,
    ask: Option<RwSignal<bool>>,
    /// Whether a dialog is open, which says it too.
    busy: Memo<bool>,
) -> impl IntoView {
    let desk = hold();
    let copied = RwSignal::new(false);
    let copy = move |_| copied.set(browser::copy(&written.get_untracked()));
    let name = editor.name.clone();
    let sentence = move || words::it_is_until(number(desk, &record.read()).as_deref(), &name);
    let name = editor.name.clone();
    view! {
        <div class="held">
            <p>
                <span class="who-tag"><Icon name="lock" />{words::is_editing(&editor.name)}</span>
                <span>{sentence}</span>
            </p>
            {ask.map(|ask| view! {
                <div class="row" hidden=move || busy.get()>
                    <button class="button primary" type="button" on:click=move |_| ask.set(true)>{words::ask_person(&name)}</button>
                    <button class="button" type="button" on:click=copy>
                        {move || if copied.get() { words::copied() } else { words::copy() }}
                    </button>
                </div>
            })}
        </div>
    }
}

/// One asked for it: counts down, and then it is one's own until this is closed.
#[component]
fn Asked(key: RecordId, waits: RwSignal<bool>, written: Signal<String>) -> impl IntoView {
    let desk = hold();
    let held = DialogLock::of(desk, Some(key));
    Effect::new(move |_| {
        waits.set(held.reads.get());
    });
    on_cleanup(move || {
        waits.try_set(false);
    });
    desk.desk().document.ask_for();
    view! { <Holding held written /> }
}

/// What is copied: its procedure, or its duration.
fn written(connector: &Connector) -> String {
    match connector.operation.procedure() {
        Some(Procedure::Body { body, .. }) => body.clone(),
        Some(Procedure::Helper(name)) => name.clone(),
        None => connector.operation.period_ms().map(|ms| ms.to_string()).unwrap_or_default(),
    }
}

/// Its number with its unit, if it has one only.
fn number(desk: DeskHold, connector: &Connector) -> Option<String> {
    let tests = number_tests(&written(connector));
    let [test] = tests.as_ref().map(|tests| &tests.all[..])? else { return None };
    let unit = super::now::measured(desk, connector, test, test.number).unit;
    Some(words::with_unit(test.written(test.number), unit))
}
