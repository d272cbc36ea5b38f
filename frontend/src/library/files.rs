//! Opening a file: the picker of the browser, and the hint while a file is dragged over the page.

use crate::commands::FILE_PICKER_ID;
use crate::desk::first_file;
use crate::library::words;
use crate::parts::hold;
use leptos::prelude::*;

/// The picker, which nobody sees, and the hint.
#[component]
pub(crate) fn Files() -> impl IntoView {
    let desk = hold();
    let chosen = move |event: web_sys::Event| {
        let input: web_sys::HtmlInputElement = event_target(&event);
        if let Some(file) = first_file(&input) {
            desk.desk().library.open_file(file);
        }
        // The same file may be chosen again.
        input.set_value("");
    };
    view! {
        <input id=FILE_PICKER_ID type="file" hidden=true accept=".json,.xml,application/json,application/xml,text/xml"
            aria-label=words::open_file() on:change=chosen />
        <Show when=move || desk.desk().library.dropping.get()>
            <div class="drop-hint" role="status"><span>{words::drop_here()}</span></div>
        </Show>
    }
}
