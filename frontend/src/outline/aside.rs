//! The rows of the outline that are no part of the graph: the heading of a group, which folds, and notes.

use crate::desk::{EditSession, GroupSignals, NoteSignals, Selected};
use crate::escape;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::outline::words;
use crate::parts::{NoteField, author_color, hold, may_edit, written_by};
use behaviour::{Id, Kind, NAME_MAX_CHARS, Record, RecordId};
use leptos::prelude::*;

/// The heading of a group.
#[component]
pub(super) fn GroupRow(id: Id) -> impl IntoView {
    let desk = hold();
    let Some(GroupSignals { record, .. }) = desk.desk().document.group(&id) else { return ().into_any() };
    let renames = RwSignal::new(false);
    let id = StoredValue::new(id);
    let title = Memo::new(move |_| record.with(|group| group.title.clone()));
    let is_folded = Memo::new(move |_| id.with_value(|id| desk.desk().document.is_folded(id)));
    let count = Memo::new(move |_| id.with_value(|id| desk.desk().document.members(id).len()));
    let fold = move |_| id.with_value(|id| desk.desk().document.fold(id, !is_folded.get_untracked()));
    let ungroup = move |_| desk.desk().document.ungroup(&[Selected::Group(id.get_value())].into());
    let session = id.with_value(|id| desk.desk().document.session(RecordId::new(Kind::Group, id)));
    let session = StoredValue::new(session);
    let end = move |name: Option<String>| {
        if renames.try_get_untracked() == Some(true) {
            renames.set(false);
            let session = session.get_value();
            if let (Some(name), Some(Record::Group(seen))) = (name, session.seen()) {
                id.with_value(|id| desk.desk().document.retitle(id, seen, &name));
            }
            session.end();
        }
    };
    let field = move || {
        session.with_value(EditSession::begin);
        let key = move |event: web_sys::KeyboardEvent| {
            if event.pressed() == "Enter" {
                end(Some(event_target_value(&event)));
            }
            escape::ends(&event, || end(None));
        };
        view! {
            <input class="input" type="text" maxlength=NAME_MAX_CHARS.to_string() aria-label=words::new_name(&title.get_untracked())
                autofocus="" prop:value=title.get_untracked() on:keydown=key on:blur=move |event| end(Some(event_target_value(&event))) />
        }
    };
    view! {
        <div class="group-row">
            <button class="twig" type="button" aria-expanded=move || (!is_folded.get()).to_string() on:click=fold>
                <span class="plain-icon">{move || view! { <Icon name=if is_folded.get() { "unfold" } else { "fold" } /> }}</span>
                <b class="cut" title=title>{title}</b>
                <span class="faint">{move || words::streams(count.get() as u32)}</span>
            </button>
            <Show when=move || may_edit(desk)>
                <button class="tool icon" type="button" aria-label=words::rename() title=words::rename()
                    on:click=move |_| renames.set(true)><Icon name="pencil" /></button>
                <button class="tool icon" type="button" aria-label=words::ungroup() title=words::ungroup() on:click=ungroup>
                    <Icon name="ungroup" />
                </button>
            </Show>
        </div>
        {move || renames.get().then(field)}
    }
    .into_any()
}

/// A note; its pencil opens it to write in it.
#[component]
pub(super) fn NoteRow(id: Id) -> impl IntoView {
    let desk = hold();
    let Some(NoteSignals { record, .. }) = desk.desk().document.note_signals(&id) else { return ().into_any() };
    let writes = RwSignal::new(false);
    let (text, foot, by) = (record.clone(), record.clone(), record.clone());
    let color = move || by.with(|note| author_color(&desk.desk(), &note.by));
    let gone = Selected::Note(id.clone());
    let remove = move |_| desk.desk().document.remove(&gone);
    let id = StoredValue::new(id);
    let field = move || {
        let seen = record.get_untracked();
        let was = seen.text.clone();
        let done = Callback::new(move |text: Option<String>| {
            writes.try_set(false);
            let text =
                text.map(|text| text.trim_end().to_owned()).filter(|text| *text != seen.text && !text.is_empty());
            if let (Some(text), Some(id)) = (text, id.try_get_value()) {
                desk.desk().document.edit_note(&id, seen.clone(), &text);
            }
        });
        view! { <NoteField text=was id=id.get_value() done /> }
    };
    view! {
        <div class="note-row" style=("--person", color)>
            <span class="two">
                <span class="note-text">{move || text.with(|note| note.text.clone())}</span>
                <span class="faint">{move || foot.with(written_by)}</span>
            </span>
            <Show when=move || may_edit(desk)>
                <button class="tool icon" type="button" aria-label=words::edit_note() title=words::edit_note()
                    on:click=move |_| writes.set(true)><Icon name="pencil" /></button>
            </Show>
            <button class="tool icon" type="button" aria-label=words::remove_note() title=words::remove_note()
                disabled=move || !may_edit(desk) on:click=remove><Icon name="trash" /></button>
        </div>
        {move || writes.get().then(&field)}
    }
    .into_any()
}

/// Begins a note at the end of the list.
#[component]
pub(super) fn AddNote() -> impl IntoView {
    let desk = hold();
    let writes = RwSignal::new(false);
    let done = Callback::new(move |text: Option<String>| {
        writes.set(false);
        if let Some(text) = text.filter(|text| !text.trim().is_empty()) {
            let document = desk.desk().document;
            document.add_note(text.trim_end(), document.place_for_note());
        }
    });
    let button = move || {
        view! {
            <button class="tool" type="button" on:click=move |_| writes.set(true)>
                <Icon name="note" /><span>{words::add_note()}</span>
            </button>
        }
    };
    move || {
        if writes.get() { view! { <NoteField text=String::new() done /> }.into_any() } else { button().into_any() }
    }
}
