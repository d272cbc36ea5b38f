//! What is seen where there will be no link again: calm, and nothing that goes on pretending.

use crate::browser;
use crate::focus::{self, FocusPlace};
use crate::link::LinkEnd;
use crate::page::words;
use leptos::prelude::*;

/// Loads the page anew, which keeps what is not saved yet.
fn again() {
    if let Some(window) = browser::window() {
        let _ = window.location().reload();
    }
}

/// In place of the whole page; only Stop stays, which is none of the program's.
#[component]
pub(crate) fn Ended(end: LinkEnd) -> impl IntoView {
    focus::place(FocusPlace::EndedTitle);
    let [title, says] = match end {
        LinkEnd::Revoked => [words::revoked_title(), words::revoked_says()],
        LinkEnd::GaveWay => [words::gave_way_title(), words::gave_way_says()],
    };
    let go_on = (end == LinkEnd::GaveWay).then(|| {
        view! {
            <button class="button" type="button" on:click=|_| again()>{words::go_on_here()}</button>
        }
    });
    view! {
        <main class="revoked">
            <div class="revoked-says">
                <h1 id="ended-title" tabindex="-1">{title}</h1>
                <p role="status">{says}</p>
                {go_on}
            </div>
        </main>
    }
}
