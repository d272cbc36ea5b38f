//! Opening a file: the picker of the browser, and the hint while a file is dragged over the page.

use super::focus;
use super::hold::hold;
use crate::desk::first_file;
use crate::words;
use leptos::prelude::*;

const PICKER_ID: &str = "file-to-open";

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
        <input id=PICKER_ID type="file" hidden=true accept=".json,.xml,application/json,application/xml,text/xml"
            aria-label=words::open_file() on:change=chosen />
        <Show when=move || desk.desk().library.dropping.get()>
            <div class="drop-hint" role="status"><span>{words::drop_here()}</span></div>
        </Show>
    }
}

/// Asks the person for a file.
pub(crate) fn choose_file() {
    if let Some(picker) = focus::by_id(PICKER_ID) {
        picker.click();
    }
}
