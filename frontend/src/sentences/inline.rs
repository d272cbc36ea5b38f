//! What can be changed in a sentence: a number becomes a field with keys in place, a choice is a menu.

use super::OpenFields;
use super::change::{New, drafted, put, record_of};
use crate::desk::{EditSession, OtherEditor};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::parts::{DeskHold, hold, may_edit};
use crate::sentences::words;
use leptos::prelude::*;
use sentences::{LiteralPlace, Number, Piece, SentenceChoice};
use wasm_bindgen::JsCast;
use web_sys::{Element, Event, FocusEvent, HtmlElement, HtmlInputElement, KeyboardEvent};

/// Who else is editing what a literal stands in. Reactive.
fn editor_of(desk: DeskHold, at: &LiteralPlace) -> Option<OtherEditor> {
    let key = record_of(at);
    desk.desk().document.editor_of(&key)
}

/// The name of what can be changed, or of what somebody else is editing.
fn label(text: &str, editor: Option<OtherEditor>) -> String {
    match editor {
        Some(editor) => words::with_editor(text.to_owned(), Some(&editor.name)),
        None => words::change_it(text),
    }
}

/// The padlock of what somebody else is editing.
fn padlock(editor: Memo<Option<OtherEditor>>) -> impl IntoView {
    move || editor.read().is_some().then(|| view! { <Icon name="lock" /> })
}

fn person(editor: Memo<Option<OtherEditor>>) -> Option<String> {
    editor.read().as_ref().map(|editor| format!("var(--people-{})", editor.color))
}

/// A number; Enter or leaving its field saves it, Escape takes it back.
#[component]
pub(super) fn InlineNumber(piece: Memo<Option<Piece>>) -> impl IntoView {
    let desk = hold();
    let number = Memo::new(move |_| match piece.get() {
        Some(Piece::Number(number)) => Some(number),
        _ => None,
    });
    let typed = RwSignal::new(None::<String>);
    let opened = StoredValue::new(None::<OpenedNumber>);
    let editor = Memo::new(move |_| editor_of(desk, &number.read().as_ref()?.at));
    let reads = move || !may_edit(desk) || editor.read().is_some();
    let open = move |steps: f64| {
        if let Some(number) = number.get_untracked().filter(|_| !untrack(reads)) {
            let first = shown(stepped(&number, number.value, steps));
            let session = desk.desk().document.session(record_of(&number.at));
            session.begin();
            opened.set_value(Some(OpenedNumber { number, session }));
            typed.set(Some(first));
        }
    };
    let text = move || number.read().as_ref().map(|number| number.text.clone()).unwrap_or_default();
    let key = move |event: KeyboardEvent| {
        let steps = if event.shift_key() { 10.0 } else { 1.0 };
        match event.pressed().as_str() {
            "Enter" | " " => open(0.0),
            "ArrowUp" => open(steps),
            "ArrowDown" => open(-steps),
            _ => return,
        }
        event.prevent_default();
        event.stop_propagation();
    };
    let is_open = Memo::new(move |_| typed.read().is_some());
    move || {
        if is_open.get() {
            return opened.get_value().map(|opened| view! { <NumberField opened typed /> }).into_any();
        }
        view! {
            <span class="inline" class:locked=move || editor.read().is_some() style=("--person", move || person(editor))
                role="button" data-stop="" tabindex="-1" aria-label=move || label(&text(), editor.get())
                aria-disabled=move || reads().to_string() on:click=move |_| open(0.0) on:keydown=key>{padlock(editor)}{text}</span>
        }
        .into_any()
    }
}

/// A number as it was when its field was opened, and the place where it is typed.
#[derive(Clone)]
struct OpenedNumber {
    number: Number,
    session: EditSession,
}

/// The field in the place of a number.
#[component]
fn NumberField(opened: OpenedNumber, typed: RwSignal<Option<String>>) -> impl IntoView {
    let desk = hold();
    let OpenedNumber { number, session } = opened;
    let (unit, number) = (number.unit.clone(), StoredValue::new(number));
    let session = StoredValue::new(session);
    let typing = expect_context::<OpenFields>();
    typing.begins();
    let by = move |steps: f64| {
        let now = typed.get_untracked().as_deref().and_then(parsed);
        number.with_value(|number| typed.set(Some(shown(stepped(number, now.unwrap_or(number.value), steps)))));
        session.with_value(EditSession::typing);
    };
    // Said once: leaving the field follows Enter.
    let save = move || {
        let Some(text) = typed.try_get_untracked().flatten() else { return };
        typed.set(None);
        let (number, session) = (number.get_value(), session.get_value());
        if let Some(asks) = words::two_ways(&text) {
            session.end();
            return desk.desk().say(&asks, true);
        }
        match parsed(&text).map(|value| value.clamp(number.min, number.max)) {
            Some(value) if value != number.value && session.is_here() => {
                put(&desk.desk(), &number.at, session.seen(), New::Number(value * number.scale));
            }
            _ => {}
        }
        session.end();
    };
    let forget = move || number.with_value(|number| desk.desk().document.forget_draft(&record_of(&number.at)));
    draft_number(desk, typed, number, session);
    on_cleanup(move || {
        save();
        forget();
        session.with_value(EditSession::end);
        typing.ends();
    });
    let key = move |event: KeyboardEvent| {
        let steps = if event.shift_key() { 10.0 } else { 1.0 };
        if escape::ends(&event, || back_to_number(&event, move || typed.set(None))) {
            return event.stop_propagation();
        }
        match event.pressed().as_str() {
            "Enter" => back_to_number(&event, save),
            "ArrowUp" => by(steps),
            "ArrowDown" => by(-steps),
            _ => {
                event.stop_propagation();
                return;
            }
        }
        event.prevent_default();
        event.stop_propagation();
    };
    let left = move |event: FocusEvent| {
        let within = event.current_target().and_then(|own| own.dyn_into::<HtmlElement>().ok());
        let to = event.related_target().and_then(|to| to.dyn_into::<web_sys::Node>().ok());
        if !within.is_some_and(|own| own.contains(to.as_ref())) {
            save();
        }
    };
    let field = NodeRef::<leptos::html::Input>::new();
    Effect::new(move |_| {
        if let Some(field) = field.get() {
            focus::type_over(&field, &typed.get_untracked().unwrap_or_default());
        }
    });
    view! {
        <span class="inline open" on:keydown=key on:focusout=left>
            <button type="button" tabindex="-1" aria-label=words::less() on:click=move |_| by(-1.0)><Icon name="minus" /></button>
            <input type="text" inputmode="decimal" data-stop="" aria-label=words::number() node_ref=field prop:value=move || typed.get()
                on:input=move |event: Event| {
                    if let Some(field) = event.target().and_then(|field| field.dyn_into::<HtmlInputElement>().ok()) {
                        session.with_value(EditSession::typing);
                        typed.set(Some(field.value()));
                    }
                } />
            <button type="button" tabindex="-1" aria-label=words::more() on:click=move |_| by(1.0)><Icon name="plus" /></button>
            {(!unit.is_empty()).then(|| view! { <span class="unit">{unit}</span> })}
        </span>
    }
}

/// Drafts the record with the number that is typed, for as long as it is another one than before.
fn draft_number(
    desk: DeskHold,
    typed: RwSignal<Option<String>>,
    number: StoredValue<Number>,
    session: StoredValue<EditSession>,
) {
    Effect::new(move |_| {
        let value = typed.get().as_deref().and_then(parsed);
        let record = number.with_value(|number| {
            let value =
                value.map(|value| value.clamp(number.min, number.max)).filter(|value| *value != number.value)?;
            let seen = session.with_value(EditSession::seen);
            let record = drafted(&number.at, seen, New::Number(value * number.scale))?;
            Some((record_of(&number.at), record))
        });
        match record {
            Some((id, record)) => desk.desk().document.draft(id, record),
            None => number.with_value(|number| desk.desk().document.forget_draft(&record_of(&number.at))),
        }
    });
}

/// Closes the field by `act`, and gives the keyboard to the number that takes its place.
fn back_to_number(event: &KeyboardEvent, act: impl FnOnce()) {
    let field = event.current_target().and_then(|own| own.dyn_into::<Element>().ok());
    let number = field.and_then(|field| FocusPlace::instead_of(&field));
    act();
    number.into_iter().for_each(focus::place);
}

/// One of several words.
#[component]
pub(super) fn InlineChoice(piece: Memo<Option<Piece>>) -> impl IntoView {
    let desk = hold();
    let choice = Memo::new(move |_| match piece.get() {
        Some(Piece::Choice(choice)) => Some(choice),
        _ => None,
    });
    let options = Memo::new(move |_| choice.get().map(|choice| choice.options).unwrap_or_default());
    let chosen = Memo::new(move |_| choice.get().map(|choice| choice.chosen).unwrap_or_default());
    let text = move || choice.read().as_ref().map(|choice| choice.text.clone()).unwrap_or_default();
    let editor = Memo::new(move |_| editor_of(desk, &choice.read().as_ref()?.at));
    let reads = move || !may_edit(desk) || editor.read().is_some();
    let session = StoredValue::new(None::<EditSession>);
    let begun = move |at: &LiteralPlace| {
        let new = || desk.desk().document.session(record_of(at));
        session.get_value().unwrap_or_else(new)
    };
    let choose = move |value: String| {
        if let Some(SentenceChoice { at, chosen, .. }) = choice.get_untracked().filter(|_| !untrack(reads))
            && chosen != value
        {
            put(&desk.desk(), &at, begun(&at).seen(), New::Text(value));
        }
    };
    let came = move |_| {
        if let Some(choice) = choice.get_untracked().filter(|_| !untrack(reads)) {
            let new = begun(&choice.at);
            new.begin();
            session.set_value(Some(new));
        }
    };
    let left = move || {
        let ended = session.try_update_value(Option::take).flatten();
        ended.iter().for_each(EditSession::end);
    };
    on_cleanup(left);
    view! {
        <span class="inline choice" class:locked=move || editor.read().is_some() style=("--person", move || person(editor))>
            <span aria-hidden="true">{padlock(editor)}{text}<Icon name="chevron" /></span>
            <select data-stop="" tabindex="-1" aria-label=move || label(&text(), editor.get()) disabled=reads
                prop:value=chosen on:focus=came on:blur=move |_| left() on:change:target=move |event| choose(event.target().value())>
                {move || options.get().into_iter().map(|option| {
                    let mine = option.value.clone();
                    view! { <option value=option.value prop:selected=move || chosen.get() == mine>{option.words}</option> }
                }).collect_view()}
            </select>
        </span>
    }
}

/// So many steps from a value, on a step and within what makes sense.
fn stepped(number: &Number, value: f64, steps: f64) -> f64 {
    let next = if steps == 0.0 { value } else { ((value / number.step).round() + steps) * number.step };
    ((next * 1e6).round() / 1e6).clamp(number.min, number.max)
}

fn parsed(text: &str) -> Option<f64> {
    behaviour::typed_number(text)?.one()
}

fn shown(value: f64) -> String {
    value.to_string()
}

#[cfg(test)]
mod tests {
    use super::{parsed, shown, stepped};
    use behaviour::Id;
    use sentences::{LiteralPlace, Number};

    #[test]
    fn a_press_goes_to_the_next_step_and_not_past_the_end() {
        let at = LiteralPlace::Period { connector: Id::new("c").unwrap() };
        let (text, unit) = ("0.5 m".to_owned(), "m".to_owned());
        let number = Number { text, value: 0.5, unit, min: 0.0, max: 2.0, step: 0.05, at, scale: 1.0 };
        assert_eq!((stepped(&number, 0.5, 1.0), stepped(&number, 0.5, -10.0)), (0.55, 0.0));
        assert_eq!((stepped(&number, 1.98, 10.0), stepped(&number, 0.513, 0.0)), (2.0, 0.513));
        assert_eq!((parsed(" 0,5 "), parsed("x"), parsed("inf")), (Some(0.5), None, None));
        assert_eq!((shown(40.0), shown(0.55)), ("40".to_owned(), "0.55".to_owned()));
    }
}
