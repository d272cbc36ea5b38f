//! Says aloud, once, when somebody else begins to edit something.

use crate::layout::chip_words;
use crate::page::words;
use crate::parts::{DeskHold, hold};
use behaviour::{Kind, RecordId};
use leptos::prelude::*;

/// What is only heard.
#[component]
pub(crate) fn Editors() -> impl IntoView {
    let desk = hold();
    let edited = Memo::new(move |_| {
        let edited = desk.desk().document.edited_by_others().into_iter();
        edited.map(|(record, editor)| (record, editor.name)).collect::<Vec<_>>()
    });
    let text = RwSignal::new(String::new());
    Effect::new(move |before: Option<Vec<(RecordId, String)>>| {
        let now = edited.get();
        let before = before.unwrap_or_default();
        let new = now.iter().filter(|one| !before.contains(one));
        text.set(new.filter_map(|(record, name)| sentence(desk, record, name)).collect::<Vec<_>>().join(" "));
        now
    });
    view! { <p class="sr" role="status">{move || text.get()}</p> }
}

fn sentence(desk: DeskHold, record: &RecordId, name: &str) -> Option<String> {
    let document = desk.desk().document;
    let what = match record.kind {
        Kind::Stream => document.stream(&record.id)?.record.with_untracked(|stream| stream.name.clone()),
        Kind::Connector => document.connector(&record.id)?.record.with_untracked(|at| chip_words(at).whole()),
        Kind::Place | Kind::Settings | Kind::Helper | Kind::Note | Kind::Group | Kind::Pad => return None,
    };
    Some(words::is_editing_this(name, &what))
}
