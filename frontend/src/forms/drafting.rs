//! Drafts of dialogs count while somebody compares, before they are saved: each is handed on once a hand rests, and what
//! would come of it stands in the dialog.

use crate::browser;
use crate::desk::DraftedWhat;
use crate::parts::{DeskHold, hold};
use behaviour::RecordId;
use leptos::prelude::*;

/// The time for which a hand has to rest, in milliseconds.
const RESTS_MS: i32 = 250;

/// Hands on what `made` makes of the fields, once these rest; what it reads is followed. Nothing is drafted any more once the
/// dialog is gone.
pub(super) fn keep(desk: DeskHold, about: RecordId, made: impl Fn() -> Option<DraftedWhat> + 'static) {
    let (about, newest) = (StoredValue::new(about), StoredValue::new((0_u32, None::<DraftedWhat>)));
    let hand_on = move || {
        let document = desk.desk().document;
        about.with_value(|about| match newest.with_value(|newest| newest.1.clone()) {
            Some(what) => document.draft_as(about.clone(), what),
            None => document.forget_draft(about),
        });
    };
    Effect::new(move |_| {
        let what = made();
        let mine = newest.with_value(|newest| newest.0.wrapping_add(1));
        newest.set_value((mine, what));
        browser::after(RESTS_MS, move || {
            if newest.try_with_value(|newest| newest.0) == Some(mine) {
                hand_on();
            }
        });
    });
    on_cleanup(move || about.with_value(|about| desk.desk().document.forget_draft(about)));
}

/// What would come of what is typed, while somebody compares.
#[component]
pub(super) fn Preview() -> impl IntoView {
    let previewed = hold().desk().document.previewed.clone();
    move || {
        let preview = previewed.get()?;
        Some(view! { <p class="dialog-preview" class:old=preview.is_old>{preview.text}</p> })
    }
}
