//! The mark on a stream or chip of which this tab has something that nobody else has yet.

use crate::desk::{Desk, UnsavedMark};
use crate::graph::words;
use crate::icons::Icon;
use behaviour::RecordId;
use leptos::prelude::*;

/// Returns the mark of a record.
pub(super) fn mark_memo(desk: &Desk, record: RecordId) -> ArcMemo<Option<UnsavedMark>> {
    let document = desk.document.clone();
    ArcMemo::new(move |_| document.mark_of(&record))
}

/// Returns the words for a mark.
pub(super) fn said(mark: UnsavedMark) -> &'static str {
    match mark {
        UnsavedMark::Waits => words::waits_here(),
        UnsavedMark::Undecided => words::yours_waits(),
    }
}

/// The mark; what bears it says it too.
#[component]
pub(super) fn MarkBadge(mark: ArcMemo<Option<UnsavedMark>>) -> impl IntoView {
    move || {
        mark.get().map(|mark| match mark {
            UnsavedMark::Waits => view! { <span class="waits-ring on-part" title=said(mark) aria-hidden="true"></span> }.into_any(),
            UnsavedMark::Undecided => {
                view! { <span class="badge undecided" title=said(mark) aria-hidden="true"><Icon name="pencil" /></span> }
                    .into_any()
            }
        })
    }
}
