//! The text of a note, and the field in which it is written.

use crate::browser;
use crate::desk::{Desk, EditSession, use_desk};
use crate::escape;
use crate::focus;
use crate::keys::PressedKey;
use crate::words;
use behaviour::{Id, Kind, Note, RecordId};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlTextAreaElement, KeyboardEvent};

/// The longest note, in characters; the rules of programs say so too.
const TEXT_MAX_CHARS: u32 = 4_000;
/// The fewest lines the field has.
const LINES_MIN: usize = 2;

/// The field for the text of a note: Enter begins a line, Control and Enter or leaving saves, Escape takes back. `done` is
/// told once, with the text or nothing.
#[component]
pub(crate) fn NoteField(
    text: String,
    /// The note that is written in; none for a new one.
    #[prop(optional)]
    id: Option<Id>,
    done: Callback<Option<String>>,
) -> impl IntoView {
    let desk = use_desk();
    let session = id.map(|id| desk.document.session(RecordId::new(Kind::Note, &id)));
    session.iter().for_each(EditSession::begin);
    let field = NodeRef::<leptos::html::Textarea>::new();
    Effect::new(move |_| {
        if let Some(field) = field.get() {
            // The text is put into the field after this. A person who came there faster keeps what they chose in it.
            let _ = request_animation_frame(move || {
                if focus::is_at(&field) {
                    return;
                }
                let _ = field.focus();
                let end = field.value().encode_utf16().count() as u32;
                let _ = field.set_selection_range(end, end);
            });
        }
    });
    let is_done = StoredValue::new(false);
    let (own, here) = (session.clone(), session);
    // Leaving follows saving and taking back: only the first of them counts.
    let end = move |text: Option<String>| {
        if is_done.try_get_value() == Some(false) {
            is_done.set_value(true);
            done.try_run(text);
            own.iter().for_each(EditSession::end);
        }
    };
    let (last, was) = (StoredValue::new(text.clone()), text.clone());
    let late = end.clone();
    on_cleanup(move || {
        // Somebody removed the note under who writes in it: what is written is kept.
        let is_here = here.as_ref().is_none_or(EditSession::is_here);
        late(last.try_get_value().filter(|text| is_here && *text != was));
    });
    let (keyed, left) = (end.clone(), end);
    let key = move |event: KeyboardEvent| {
        let control = event.ctrl_key() || event.meta_key();
        if event.pressed() == "Enter" && control {
            keyed(typed(&event));
        }
        escape::ends(&event, || keyed(None));
    };
    let lines = RwSignal::new(lines_of(&text));
    let grow = move |event: web_sys::Event| {
        let text = typed(&event).unwrap_or_default();
        lines.set(lines_of(&text));
        last.set_value(text);
        desk.document.typing();
    };
    view! {
        <textarea class="note-field" node_ref=field maxlength=TEXT_MAX_CHARS.to_string() aria-label=words::note_text()
            title=words::note_keys() placeholder=words::note_text() rows=move || lines.get().to_string() prop:value=text on:keydown=key on:input=grow
            on:blur=move |event| left(typed(&event))></textarea>
    }
}

fn lines_of(text: &str) -> usize {
    let wrapped = |line: &str| 1 + line.chars().count() / 30;
    text.split('\n').map(wrapped).sum::<usize>().max(LINES_MIN)
}

fn typed(event: &web_sys::Event) -> Option<String> {
    Some(event.target()?.dyn_into::<HtmlTextAreaElement>().ok()?.value())
}

/// Says who wrote a note and on which day, as far as that is known.
pub(crate) fn written_by(note: &Note) -> String {
    let day = (note.at_ms > 0).then(|| browser::date_words(note.at_ms as f64));
    let parts = [Some(note.by.clone()).filter(|by| !by.is_empty()), day];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

/// The colour of who wrote a note, as a value of a style: the one they have here, else one made from their name. Reactive.
pub(crate) fn author_color(desk: &Desk, by: &str) -> String {
    let here = desk.document.signs().into_iter().find(|sign| sign.name == by).map(|sign| sign.color);
    let color = here.unwrap_or_else(|| by.bytes().fold(0_u8, u8::wrapping_add) % 8);
    format!("var(--people-{color})")
}

/// The name of a note for screen readers: `Note by Aiko: Ask Yuki`.
pub(crate) fn note_name(note: &Note) -> String {
    words::note_by(&note.by, note.text.trim())
}
