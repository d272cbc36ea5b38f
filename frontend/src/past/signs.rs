//! The signs of this panel that nothing else has; they come with its piece of the code.

use leptos::prelude::*;

/// A sign by its strokes on a field of 24.
#[component]
pub(super) fn Sign(strokes: &'static [&'static str]) -> impl IntoView {
    view! {
        <svg viewBox="0 0 24 24" width="18" height="18" fill="none" stroke="currentColor" stroke-width="1.75" stroke-linecap="round"
            stroke-linejoin="round" aria-hidden="true" focusable="false">
            {strokes.iter().map(|stroke| view! { <path d=*stroke /> }).collect_view()}
        </svg>
    }
}

/// To the mark before.
pub(super) const BACK: &[&str] = &["M7 5.5v13", "M17.5 5.5v13l-8-6.5z"];
/// To the next mark.
pub(super) const FORWARD: &[&str] = &["M17 5.5v13", "M6.5 5.5v13l8-6.5z"];
/// Playing rests.
pub(super) const PAUSE: &[&str] = &["M8.5 6v12", "M15.5 6v12"];
/// Marbles, bars and a line.
pub(super) const FORM: &[&str] = &["M4 18c3 0 4-11 8-11s5 6 8 6", "M4 21h16", "M6 4h.01", "M10 4h.01"];
