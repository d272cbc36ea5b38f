//! Notes beside the graph, and the one that is written.

use super::Stage;
use super::bounds::bounds;
use super::cull::drawn;
use super::differs::{Differs, differs_memo};
use super::node::OthersRing;
use super::noting::NoteWriting;
use crate::desk::{Desk, NoteSignals, Selected, use_desk};
use crate::graph::words;
use crate::layout::note_size;
use crate::parts::{NoteField, author_color, note_name, written_by};
use behaviour::{Id, Kind, Place, RecordId};
use leptos::prelude::*;

/// The notes, as a view.
pub(crate) fn notes() -> AnyView {
    view! { <Notes /> }.into_any()
}

/// Returns those of these in or near the view; while the view moves nothing vanishes.
pub(super) fn drawn_memo(stage: &Stage, ids: ArcRwSignal<Vec<Id>>) -> ArcMemo<Vec<Id>> {
    let (desk, cells, rests) = (stage.desk.clone(), stage.cells.clone(), stage.rests.clone());
    ArcMemo::new(move |before: Option<&Vec<Id>>| {
        desk.document.revision.track();
        desk.document.hidden.track();
        let (cells, prints, none) = (cells.get(), desk.printing.get(), Vec::new());
        let seen = |id: &Id| bounds(&desk, id).is_some_and(|bounds| prints || cells.touch(&bounds));
        ids.with(|ids| drawn(ids, seen, before.unwrap_or(&none), rests.get()))
    })
}

#[component]
fn Notes() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let ids = drawn_memo(&stage, desk.document.note_ids.clone());
    let (noting, new) = (stage.noting.clone(), stage.noting.clone());
    let is_new = ArcMemo::new(move |_| new.with(|noting| noting.as_ref().is_some_and(|noting| noting.id.is_none())));
    view! {
        <For each=move || ids.get() key=Clone::clone let:id><NoteNode id /></For>
        {move || {
            let noting = noting.get_untracked().filter(|_| is_new.get())?;
            Some(view! { <NewNote noting /> })
        }}
    }
}

/// A note that is not saved yet.
#[component]
fn NewNote(noting: NoteWriting) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let at = placed(noting.at);
    let me = desk.me.get_untracked().map(|me| me.name).unwrap_or_default();
    let color = author_color(&desk, &me);
    let done = Callback::new(move |text: Option<String>| {
        stage.noting.set(None);
        if let Some(text) = text.filter(|text| !text.trim().is_empty()) {
            let id = desk.document.add_note(text.trim_end(), noting.at);
            stage.wanted.set(Some(id));
        }
    });
    view! {
        <div class="at of-note" style:transform=at>
            <div class="note written" style=("--person", color)><NoteField text=String::new() done /></div>
        </div>
    }
}

#[component]
fn NoteNode(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(NoteSignals { record, place }) = desk.document.note_signals(&id) else { return ().into_any() };
    stage.drawn_now(&id);
    let differs = differs_memo(&desk, &RecordId::new(Kind::Note, &id));
    let is_written = {
        let (noting, id) = (stage.noting.clone(), id.clone());
        ArcMemo::new(move |_| {
            noting.with(|noting| noting.as_ref().is_some_and(|noting| noting.id.as_ref() == Some(&id)))
        })
    };
    let is_dragged = {
        let (dragged, id) = (stage.dragged.clone(), id.clone());
        move || dragged.with(|dragged| dragged.as_ref() == Some(&id))
    };
    let color = {
        let (desk, record) = (desk.clone(), record.clone());
        ArcMemo::new(move |_| record.with(|note| author_color(&desk, &note.by)))
    };
    let shown = id.clone();
    let inside = move || {
        let (desk, stage, id) = (desk.clone(), stage.clone(), shown.clone());
        if !is_written.get() {
            return view! { <Written id color=color.clone() /> }.into_any();
        }
        let Some(signals) = desk.document.note_signals(&id) else { return ().into_any() };
        let seen = signals.record.get_untracked();
        let text = seen.text.clone();
        let of = id.clone();
        let done = Callback::new(move |text: Option<String>| {
            stage.noting.set(None);
            save(&desk, &of, &seen, text);
            stage.focus(&of);
        });
        view! { <div class="note written" style=("--person", color.get_untracked())><NoteField text id=id.clone() done /></div> }
            .into_any()
    };
    view! {
        <div class="at of-note" class:dragged=is_dragged style:transform=move || placed(place.get())>
            {inside}
            <Differs differs />
            <OthersRing id />
        </div>
    }
    .into_any()
}

/// A note that nothing is left of goes.
fn save(desk: &Desk, id: &Id, seen: &behaviour::Note, text: Option<String>) {
    match text.as_deref().map(str::trim_end) {
        Some(text) if text == seen.text => {}
        Some("") => desk.document.remove_note(id, seen.clone()),
        Some(text) => desk.document.edit_note(id, seen.clone(), text),
        None => {}
    }
}

#[component]
fn Written(id: Id, color: ArcMemo<String>) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(NoteSignals { record, .. }) = desk.document.note_signals(&id) else { return ().into_any() };
    let chosen = {
        let (desk, id) = (desk.clone(), id.clone());
        ArcMemo::new(move |_| desk.document.is_chosen(&Selected::Note(id.clone())))
    };
    let stop = stage.is_aside_stop(&id);
    let [label, text, foot, width] = [(); 4].map(|()| record.clone());
    let pressed = chosen.clone();
    let differs = differs_memo(&desk, &RecordId::new(Kind::Note, &id));
    view! {
        <div class="note" data-note=id.to_string() role="button" class:selected=move || chosen.get()
            style=("--person", move || color.get())
            style:width=move || format!("{:.0}px", width.with(|note| note_size(&note.text).0))
            tabindex=move || if stop.get() { "0" } else { "-1" }
            aria-pressed=move || pressed.get().to_string()
            aria-label=move || {
                let name = label.with(note_name);
                words::with_mark(name, differs.get().map(|it| it.text).as_deref())
            }>
            <span class="note-text">{move || text.with(|note| note.text.clone())}</span>
            <span class="note-foot" data-says=move || foot.with(written_by)></span>
        </div>
    }
    .into_any()
}

pub(super) fn placed(place: Place) -> String {
    format!("translate({:.1}px,{:.1}px) translateX(-50%)", place.x, place.y)
}
