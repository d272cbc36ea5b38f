//! What who came by an invitation sees when it has ended: calm, and nothing that goes on pretending.

use super::focus;
use super::hold::hold;
use crate::words;
use leptos::prelude::*;

const TITLE_ID: &str = "revoked-title";

/// Over everything but Stop.
#[component]
pub(crate) fn Revoked() -> impl IntoView {
    let desk = hold();
    let is_over = Memo::new(move |_| desk.desk().revoked.get());
    Effect::new(move |_| {
        if is_over.get() {
            desk.desk().dialog.set(None);
            let _ = request_animation_frame(|| focus::by_id(TITLE_ID).iter().for_each(focus::focus));
        }
    });
    move || {
        is_over.get().then(|| {
            view! {
                <section class="revoked" aria-labelledby=TITLE_ID>
                    <div class="revoked-says">
                        <h1 id=TITLE_ID tabindex="-1">{words::revoked_title()}</h1>
                        <p role="status">{words::revoked_says()}</p>
                    </div>
                </section>
            }
        })
    }
}
