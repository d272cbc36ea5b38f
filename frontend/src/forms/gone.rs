//! What a dialog says when somebody removed what it is about: who it was, and that nothing of what was written is lost.

use crate::browser;
use crate::forms::words;
use crate::parts::{DeskHold, hold};
use behaviour::{Id, RecordId, Refusal};
use leptos::prelude::*;
use protocol::Refused;

/// Who removed something that is not there any more, in a sentence; none while it is there. Reactive.
pub(super) fn gone(
    desk: DeskHold,
    id: Id,
    is_there: impl Fn() -> bool + Send + Sync + 'static,
) -> Memo<Option<String>> {
    let looked_up = StoredValue::new(false);
    Memo::new(move |_| {
        let desk = desk.desk();
        if is_there() {
            looked_up.set_value(false);
            return None;
        }
        let me = desk.me.read().as_ref().map(|me| me.client.clone());
        let by = desk.document.removed_by.read().get(&id).cloned();
        if by.is_none() && !looked_up.get_value() {
            looked_up.set_value(true);
            desk.document.find_remover(id.clone());
        }
        Some(match by {
            Some(by) if by.client.is_some() && by.client == me => words::you_removed().to_owned(),
            Some(by) => words::removed_by(&by.name),
            None => words::somebody_removed().to_owned(),
        })
    })
}

/// Whether the open behaviour has this stream. Reactive.
pub(super) fn has_stream(desk: DeskHold, id: &Id) -> bool {
    desk.desk().document.stream_ids.read().contains(id)
}

/// Whether the open behaviour has this connector. Reactive.
pub(super) fn has_connector(desk: DeskHold, id: &Id) -> bool {
    desk.desk().document.connector_ids.read().contains(id)
}

/// Bringing back what a dialog is about, and then saving what was written on top of it. A copy is the same one.
#[derive(Clone, Copy)]
pub(super) struct Back {
    record: StoredValue<RecordId>,
    save: Callback<()>,
    /// Why it cannot be brought back.
    refusal: RwSignal<Option<String>>,
}

impl Back {
    pub(super) fn new(record: RecordId, save: Callback<()>) -> Self {
        Self { record: StoredValue::new(record), save, refusal: RwSignal::new(None) }
    }

    fn bring(self, desk: DeskHold) {
        self.refusal.set(None);
        desk.desk().document.bring_back(self.record.get_value(), move |answer| match answer {
            // Once the dialog has noticed that it is there again.
            Ok(()) => browser::rendered(move || {
                self.save.try_run(());
            }),
            Err(Refused::Change(Refusal::Gone)) => self.say(words::cannot_bring_back()),
            Err(no) => self.say(&words::told_by(&no)),
        });
    }

    fn say(self, why: &str) {
        let _ = self.refusal.try_set(Some(why.to_owned()));
    }
}

/// The sentence, a button that brings it back, and one that copies what was written.
#[component]
pub(super) fn Gone(
    who: Memo<Option<String>>,
    #[prop(into)] written: Signal<String>,
    #[prop(optional)] back: Option<Back>,
) -> impl IntoView {
    let desk = hold();
    let copied = RwSignal::new(false);
    let bring = move |_| back.into_iter().for_each(|back| back.bring(desk));
    let why = move || back.and_then(|back| back.refusal.get());
    let copy = move |_| copied.set(browser::copy(&written.get_untracked()));
    view! {
        <div role="alert">
            <Show when=move || who.read().is_some()>
                <p class="refusal">{move || who.get()} " " {words::gone_close()}</p>
                {move || why().map(|why| view! { <p class="refusal">{why}</p> })}
            </Show>
        </div>
        <Show when=move || who.read().is_some() && (back.is_some() || !written.read().is_empty())>
            <p class="row">
                {back.map(|_| view! { <button class="button small" type="button" on:click=bring>{words::bring_back()}</button> })}
                <button class="button small" type="button" on:click=copy>{words::copy_mine()}</button>
                <span class="second" role="status">{move || copied.get().then(words::copied)}</span>
            </p>
        </Show>
    }
}
