//! The connector of the dialog as it would be saved, for who compares.

use super::form::OperationForm;
use super::{about, draft, saving};
use crate::desk::{DraftedWhat, new_id};
use crate::dialogs::DialogLock;
use crate::forms::drafting;
use crate::forms::words;
use crate::reasons::Unfilled;
use leptos::prelude::*;

/// Drafts what is chosen and typed, for as long as it is another connector than the saved one, or a new one.
pub(super) fn keep(form: OperationForm, held: DialogLock) {
    // What is new keeps its ids while it is typed.
    let ids = (new_id(), new_id());
    drafting::keep(form.desk, about(form), move || {
        let is_touched = form.untouched.with_value(|first| first.as_ref() != Some(&draft::read(form)));
        if held.reads.get() || form.busy.get() {
            return None;
        }
        match saving::drafted(form, &ids) {
            Ok(records) => Some(DraftedWhat::Records(records)).filter(|_| is_touched || form.is_edit()),
            Err(Unfilled::BodyBegun | Unfilled::Gone) => None,
            Err(why) => is_touched.then(|| DraftedWhat::Unready(words::unfilled(&why))),
        }
        .filter(|what| !matches!(what, DraftedWhat::Records(records) if records.is_empty()))
    });
}
