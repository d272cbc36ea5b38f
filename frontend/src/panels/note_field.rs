//! The text of a note, and the field in which it is written.

use crate::browser;
use crate::desk::Desk;
use crate::escape;
use crate::words;
use behaviour::Note;
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
pub(crate) fn NoteField(text: String, done: Callback<Option<String>>) -> impl IntoView {
    let field = NodeRef::<leptos::html::Textarea>::new();
    Effect::new(move |_| {
        if let Some(field) = field.get() {
            // Its text is put into it after this.
            let _ = request_animation_frame(move || {
                let _ = field.focus();
                let end = field.value().encode_utf16().count() as u32;
                let _ = field.set_selection_range(end, end);
            });
        }
    });
    let is_done = StoredValue::new(false);
    // Leaving follows saving and taking back: only the first of them counts.
    let end = move |text: Option<String>| {
        if is_done.try_get_value() == Some(false) {
            is_done.set_value(true);
            done.run(text);
        }
    };
    let key = move |event: KeyboardEvent| {
        let control = event.ctrl_key() || event.meta_key();
        if event.key() == "Enter" && control && !event.is_composing() {
            end(typed(&event));
        }
        escape::ends(&event, || end(None));
    };
    let lines = RwSignal::new(lines_of(&text));
    let grow = move |event: web_sys::Event| lines.set(typed(&event).as_deref().map_or(LINES_MIN, lines_of));
    view! {
        <textarea class="note-field" node_ref=field maxlength=TEXT_MAX_CHARS.to_string() aria-label=words::note_text()
            title=words::note_keys() placeholder=words::note_text() rows=move || lines.get().to_string() prop:value=text on:keydown=key on:input=grow
            on:blur=move |event| end(typed(&event))></textarea>
    }
}

fn lines_of(text: &str) -> usize {
    let wrapped = |line: &str| 1 + line.chars().count() / 30;
    text.split('\n').map(wrapped).sum::<usize>().max(LINES_MIN)
}

fn typed(event: &web_sys::Event) -> Option<String> {
    Some(event.target()?.dyn_into::<HtmlTextAreaElement>().ok()?.value())
}

/// Who wrote a note and on which day, as far as that is known.
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
