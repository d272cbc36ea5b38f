//! A sentence that is typed where things are found: what it would add is shown beside the graph, and Enter adds it. What is
//! not understood is underlined, with what would be.

mod drafted;
mod lexicon;

use crate::fields::SentenceField;
use crate::parts::kind_class;
use crate::parts::{DeskHold, hold, may_edit};
use crate::sentences::words;
use behaviour::Helper;
use leptos::prelude::*;
use lexicon::LexiconState;
use sentences::{Doubt, TextReading, explain, language_of, looks_like_sentence, read, read_speech};
use std::ops::Range;
use wasm_bindgen::JsCast;

/// What is made of a typed sentence, as a view.
pub(crate) fn typed(typing: SentenceField) -> AnyView {
    view! { <Typed typing /> }.into_any()
}

/// What is made of a typed sentence: doubts, what it would add, and adding it.
#[component]
pub(crate) fn Typed(typing: SentenceField, #[prop(optional)] done: Option<Callback<()>>) -> impl IntoView {
    let desk = hold();
    let reading = Memo::new(move |_| reading(desk, &typing.text.read()));
    let is_open = Memo::new(move |_| reading.read().is_some());
    let doubt = Memo::new(move |_| reading.read().as_ref().and_then(|reading| reading.doubts.first().cloned()));
    let ready = Memo::new(move |_| reading.read().as_ref().is_some_and(TextReading::is_whole));
    let understood = Memo::new(move |_| {
        reading.read().as_ref().map_or_else(String::new, |reading| told(desk, &typing.text.read(), reading))
    });
    Effect::new(move |_| {
        typing.open.set(is_open.get());
        let desk = desk.desk();
        let shown = reading.read().as_ref().map(|reading| {
            let (behaviour, places) = (desk.document.behaviour(), desk.document.places());
            drafted::ghost(&reading.draft, &behaviour, &places, desk.document.in_view())
        });
        desk.document.ghost.set(shown);
    });
    Effect::new(move |_| {
        if !is_open.get() {
            lexicon::retry();
        }
    });
    on_cleanup(move || {
        desk.desk().document.ghost.set(None);
        typing.open.try_set(false);
    });
    let take = move |suggestion: &str| {
        if let Some(doubt) = doubt.get_untracked() {
            typing.text.update(|text| replace(text, &doubt.range, suggestion));
        }
    };
    let add = move || {
        let desk = desk.desk();
        let Some(ghost) = desk.document.ghost.get_untracked().filter(|_| ready.get_untracked()) else { return };
        typing.text.set(String::new());
        if let Some(done) = done {
            done.run(());
        }
        let after = desk.clone();
        desk.document.put_ghost(ghost, move |answer| after.say_refusal(answer));
    };
    let enter = move || match untrack(|| doubt.get()).map(|doubt| doubt.suggestions.into_iter().next()) {
        Some(Some(best)) => take(&best),
        Some(None) => {}
        None => add(),
    };
    // A text that was entered before the words were here is entered once they are, if it is the same still.
    let early = RwSignal::new(None::<String>);
    Effect::new(move |before: Option<u32>| {
        let entered = typing.entered.get();
        if before.is_some_and(|before| before != entered) {
            let text = typing.text.get_untracked();
            if words_come(&text) { early.set(Some(text)) } else { enter() }
        }
        entered
    });
    Effect::new(move |_| {
        reading.track();
        let text = typing.text.get_untracked();
        if early.read_untracked().as_ref() == Some(&text) && !words_come(&text) {
            early.set(None);
            enter();
        }
    });
    view! {
        <Show when=move || is_open.get()>
            <Mirror typing reading />
            <div class="typed">
                <div role="status">{move || doubt.get().map(|doubt| view! { <p class="doubt">{in_doubt(&typing.text.read(), &doubt)}</p> })}</div>
                {move || doubt.get().map(|doubt| suggestions(doubt, take))}
                <div class="would-add">
                    {move || (!understood.read().is_empty()).then(|| view! { <p class="understood">{understood.get()}</p> })}
                    {move || vague(typing, &reading.read())}
                    <p role="status"><WouldAdd reading /></p>
                    <span class="keys"><kbd>"Esc"</kbd>{words::esc_clears()}</span>
                    <button type="button" class="button primary" disabled=move || !ready.get() on:click=move |_| add()>{words::add_to_graph()}</button>
                </div>
            </div>
        </Show>
    }
}

/// Words that got a number because nobody said one, each with that number, which can be changed: then the text says it.
fn vague(typing: SentenceField, reading: &Option<TextReading>) -> Vec<AnyView> {
    let whole = reading.iter().filter(|reading| reading.is_whole());
    let one = |word: sentences::VagueNumber| {
        let said = typing.text.read_untracked().get(word.range.clone()).unwrap_or_default().to_owned();
        let (label, value, unit) = (said.clone(), word.value.to_string(), word.unit);
        let change = move |event: web_sys::Event| {
            let typed = event.target().and_then(|field| field.dyn_into::<web_sys::HtmlInputElement>().ok());
            if let Some(value) = typed.map(|field| field.value_as_number()).filter(|value| *value > 0.0 && *value < 1e4)
            {
                typing.text.update(|text| replace(text, &word.range, &word.said(value)));
            }
        };
        view! { <label class="vague">{said}<input class="input" type="number" min="0" step="any" aria-label=label prop:value=value on:change=change />{unit}</label> }.into_any()
    };
    whole.flat_map(|reading| reading.vague.clone()).map(one).collect()
}

/// What could stand in the place of what is not understood; Enter takes the first.
fn suggestions(doubt: Doubt, take: impl Fn(&str) + Copy + 'static) -> impl IntoView {
    let button = move |(at, suggestion): (usize, String)| {
        let words = suggestion.clone();
        let key = (at == 0).then(|| view! { <kbd aria-hidden="true">"Enter"</kbd> });
        view! { <button type="button" class="button" class:best=at == 0 on:click=move |_| take(&suggestion)>{words}{key}</button> }
    };
    let some = !doubt.suggestions.is_empty();
    let buttons = doubt.suggestions.into_iter().enumerate().map(button).collect_view();
    some.then(|| view! { <div class="suggestions" role="group" aria-label=words::did_you_mean()>{buttons}</div> })
}

/// The typed words once more, under the field: what is not understood has a wave below it.
#[component]
fn Mirror(typing: SentenceField, reading: Memo<Option<TextReading>>) -> impl IntoView {
    let pieces = move || {
        let text = typing.text.get();
        let doubts = reading.read().as_ref().map(|reading| reading.doubts.clone()).unwrap_or_default();
        let mut end = 0;
        let mut pieces = Vec::new();
        for Doubt { range, .. } in doubts {
            let (start, stop) = (range.start.max(end).min(text.len()), range.end.max(end).min(text.len()));
            pieces.push(view! { <span>{text.get(end..start).unwrap_or_default().to_owned()}</span> }.into_any());
            pieces.push(view! { <mark>{text.get(start..stop).unwrap_or_default().to_owned()}</mark> }.into_any());
            end = stop;
        }
        pieces.push(view! { <span>{text.get(end..).unwrap_or_default().to_owned()}</span> }.into_any());
        pieces
    };
    let moved = move || format!("translateX({}px)", -typing.scrolled.get());
    view! { <div class="mirror" aria-hidden="true"><span style:transform=moved>{pieces}</span></div> }
}

/// The names of what would be new, each with its shape.
#[component]
fn WouldAdd(reading: Memo<Option<TextReading>>) -> impl IntoView {
    move || {
        let streams = reading.get().map(|reading| reading.draft.streams).unwrap_or_default();
        let new: Vec<_> = streams.into_iter().filter(|stream| stream.existing.is_none()).collect();
        if new.is_empty() {
            return view! { <span>{words::sentence_example()}</span> }.into_any();
        }
        let part = |stream: sentences::DraftStream| {
            view! { <span class="part"><i class=format!("kind {}", kind_class(stream.kind)) aria-hidden="true"></i>{stream.name}" "</span> }
        };
        view! { <span>{words::would_add()}" "</span> {new.into_iter().map(part).collect_view()} }.into_any()
    }
}

/// True while the words are fetched by which a text is understood.
fn words_come(text: &str) -> bool {
    matches!(untrack(|| lexicon::words(language_of(text))), LexiconState::Come)
}

/// Reads what is typed as a sentence, if it is one and somebody here may edit. Reactive, but for the program itself.
fn reading(desk: DeskHold, text: &str) -> Option<TextReading> {
    let is_open = desk.desk().document.open.read().is_some();
    if !is_open || !may_edit(desk) || !looks_like_sentence(text) {
        return None;
    }
    let desk = desk.desk();
    let behaviour = desk.document.behaviour();
    desk.library.helpers.with(|helpers| {
        let helpers: Vec<&Helper> = helpers.iter().map(|(_, helper)| helper).collect();
        let language = language_of(text);
        Some(match lexicon::words(language) {
            LexiconState::Here(lexicon) => read_speech(text, language, lexicon, &helpers, Some(&behaviour)),
            LexiconState::Come => TextReading::default(),
            LexiconState::Lost => read(text, language, &helpers, Some(&behaviour)),
        })
    })
}

/// What was understood, as it is told; nothing while something is in doubt.
fn told(desk: DeskHold, text: &str, reading: &TextReading) -> String {
    if !reading.is_whole() {
        return String::new();
    }
    desk.desk().library.helpers.with_untracked(|helpers| {
        let helpers: Vec<&Helper> = helpers.iter().map(|(_, helper)| helper).collect();
        let told = explain(&reading.draft.behaviour(), &helpers, &|_| None, language_of(text));
        told.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    })
}

/// What is said of words in doubt: why they cannot be done, else what could be meant.
fn in_doubt(text: &str, doubt: &Doubt) -> String {
    doubt.why.clone().unwrap_or_else(|| words::in_doubt(words_of(text, &doubt.range), doubt.suggestions.is_empty()))
}

fn words_of(text: &str, range: &Range<usize>) -> String {
    text.get(range.clone()).unwrap_or_default().trim().to_owned()
}

/// Puts other words at a place, with a space to the words around where letters would touch.
fn replace(text: &mut String, range: &Range<usize>, with: &str) {
    let end = range.end.min(text.len());
    let start = range.start.min(end);
    if !text.is_char_boundary(start) || !text.is_char_boundary(end) {
        return;
    }
    let is_letter = |c: char| c.is_ascii_alphanumeric();
    let before = text[..start].ends_with(is_letter) && with.starts_with(is_letter);
    let after = text[end..].starts_with(is_letter) && with.ends_with(is_letter);
    let spaced = format!("{}{with}{}", if before { " " } else { "" }, if after { " " } else { "" });
    text.replace_range(start..end, &spaced);
}

#[cfg(test)]
mod tests {
    use super::replace;

    #[test]
    fn words_are_replaced_where_they_stand() {
        let mut text = "When the head is patted, the eyes".to_owned();
        replace(&mut text, &(17..23), "touched for 1 second");
        assert_eq!(text, "When the head is touched for 1 second, the eyes");
        let mut missing = "When the head".to_owned();
        replace(&mut missing, &(13..13), "is touched");
        assert_eq!(missing, "When the head is touched");
        let mut other = "頭が".to_owned();
        replace(&mut other, &(1..2), "x");
        assert_eq!(other, "頭が");
    }
}
