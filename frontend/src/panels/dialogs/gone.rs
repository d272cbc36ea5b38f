//! What a dialog says when somebody removed what it is about: who it was, and that nothing of what was written is lost.

use crate::browser;
use crate::panels::hold::Hold;
use crate::words;
use behaviour::Id;
use leptos::prelude::*;

/// Who removed something that is not there any more, in a sentence; none while it is there. Reactive.
pub(super) fn gone(desk: Hold, id: Id, is_there: impl Fn() -> bool + Send + Sync + 'static) -> Memo<Option<String>> {
    Memo::new(move |_| {
        let desk = desk.desk();
        if is_there() {
            return None;
        }
        let me = desk.me.read().as_ref().map(|me| me.name.clone());
        let by = desk.document.removed_by.read().get(&id).cloned();
        Some(match by {
            Some(by) if Some(&by) == me.as_ref() => words::you_removed().to_owned(),
            Some(by) => words::removed_by(&by),
            None => words::somebody_removed().to_owned(),
        })
    })
}

/// Whether the open behaviour has this stream. Reactive.
pub(super) fn has_stream(desk: Hold, id: &Id) -> bool {
    desk.desk().document.stream_ids.read().contains(id)
}

/// Whether the open behaviour has this connector. Reactive.
pub(super) fn has_connector(desk: Hold, id: &Id) -> bool {
    desk.desk().document.connector_ids.read().contains(id)
}

/// The sentence, and a button that copies what was written.
#[component]
pub(super) fn Gone(who: Memo<Option<String>>, #[prop(into)] written: Signal<String>) -> impl IntoView {
    let copied = RwSignal::new(false);
    let copy = move |_| copied.set(browser::copy(&written.get_untracked()));
    view! {
        <div role="alert">
            <Show when=move || who.read().is_some()>
                <p class="refusal">{move || who.get()} " " {words::gone_close()}</p>
            </Show>
        </div>
        <Show when=move || who.read().is_some() && !written.read().is_empty()>
            <p class="row">
                <button class="button small" type="button" on:click=copy>{words::copy_mine()}</button>
                <span class="second" role="status">{move || copied.get().then(words::copied)}</span>
            </p>
        </Show>
    }
}
