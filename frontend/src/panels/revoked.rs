//! What who came by an invitation sees when it has ended: calm, and nothing that goes on pretending.

use super::focus;
use crate::words;
use leptos::prelude::*;

const TITLE_ID: &str = "revoked-title";

/// In place of the whole page; only Stop stays, which is none of the program's.
#[component]
pub(crate) fn Revoked() -> impl IntoView {
    let _ = request_animation_frame(|| focus::by_id(TITLE_ID).iter().for_each(focus::focus));
    view! {
        <main class="revoked">
            <div class="revoked-says">
                <h1 id=TITLE_ID tabindex="-1">{words::revoked_title()}</h1>
                <p role="status">{words::revoked_says()}</p>
            </div>
        </main>
    }
}
