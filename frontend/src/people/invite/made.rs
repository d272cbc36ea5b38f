//! A link that was just made: to copy, and as a picture for a camera.

use super::warning::Warning;
use crate::browser;
use crate::desk::NewInvitation;
use crate::focus::{self, FocusPlace};
use crate::people::words;
use leptos::prelude::*;

/// What is left free around a QR code, in its dots.
const QUIET: usize = 4;

/// The link, shown this once.
#[component]
pub(super) fn Made(invited: NewInvitation, made: RwSignal<Option<NewInvitation>>) -> impl IntoView {
    let NewInvitation { invitation, link, qr, fingerprint } = invited;
    let copied = RwSignal::new(false);
    let said = words::invitation_made(&invitation.label, invitation.role, invitation.lasts);
    let copy = {
        let link = link.clone();
        move |_| copied.set(browser::copy(&link))
    };
    focus::place(FocusPlace::InvitationLink);
    view! {
        <p role="status">{said}</p>
        <div class="copy-line">
            <input class="input mono" id="invitation-link" type="text" readonly=true aria-label=words::link() value=link.clone()
                on:focus=select_all />
            <button class="button primary" type="button" on:click=copy>
                {move || if copied.get() { words::link_copied() } else { words::copy_link() }}
            </button>
        </div>
        <p class="second">{words::shown_once()}</p>
        <div class="made-beside">
            <Qr rows=qr />
            {fingerprint.map(|fingerprint| view! { <Warning link=link fingerprint /> })}
        </div>
        <div class="row">
            <button class="button" type="button" on:click=move |_| made.set(None)>{words::another_link()}</button>
        </div>
    }
}

fn select_all(event: web_sys::FocusEvent) {
    let field: web_sys::HtmlInputElement = event_target(&event);
    field.select();
}

/// Dark on light in both themes: cameras want it so.
#[component]
fn Qr(rows: Vec<String>) -> impl IntoView {
    let side = rows.len() + 2 * QUIET;
    view! {
        <svg class="qr" role="img" aria-label=words::qr_name() viewBox=format!("0 0 {side} {side}") shape-rendering="crispEdges">
            <rect class="qr-paper" width=side height=side />
            <path class="qr-ink" d=path(&rows) />
        </svg>
    }
}

/// A bar for each run of dark dots.
fn path(rows: &[String]) -> String {
    let mut path = String::new();
    for (y, row) in rows.iter().enumerate() {
        let mut x = 0;
        for run in row.as_bytes().chunk_by(|one, other| one == other) {
            if run.first() == Some(&b'1') {
                path.push_str(&format!("M{} {}h{}v1h-{}z", x + QUIET, y + QUIET, run.len(), run.len()));
            }
            x += run.len();
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::path;

    #[test]
    fn dark_dots_in_a_row_are_one_bar() {
        let rows = ["1101".to_owned(), "0000".to_owned(), "0010".to_owned()];
        assert_eq!(path(&rows), "M4 4h2v1h-2zM7 4h1v1h-1zM6 6h1v1h-1z");
    }
}
