//! What waits here until there is a connection, oldest first.

use crate::conflicts::words;
use crate::dialogs::{Frame, close};
use crate::parts::hold;
use leptos::prelude::*;

/// The list.
#[component]
pub(crate) fn WaitingList() -> impl IntoView {
    let desk = hold();
    let all = Memo::new(move |_| {
        // How many wait is part of how saving goes, so that the list follows it.
        desk.desk().document.saving.track();
        desk.desk().document.waiting()
    });
    let saving = desk.desk().document.saving.clone();
    let line = |(label, here): (phrase::Phrase, bool)| {
        view! { <li><span class="waits-ring" aria-hidden="true"></span><span>{words::label_said(&label)}</span>{(!here).then(|| view! { <span class="faint">{words::in_another_program()}</span> })}</li> }
    };
    let shown = move || {
        let _ = saving.get();
        all.get().into_iter().map(line).collect_view()
    };
    view! {
        <Frame title=words::waiting_title() narrow=true save=Callback::new(move |()| close(desk))>
            <div class="dialog-body" tabindex="0">
                <p class="second">{move || if all.read().is_empty() { words::nothing_waits() } else { words::waiting_says() }}</p>
                <ol class="waiting-list">{shown}</ol>
            </div>
        </Frame>
    }
}
