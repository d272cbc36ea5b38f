//! The words by which typed sentences are understood: those of one language, fetched when the first sentence in it is typed.

use crate::browser;
use leptos::prelude::*;
use sentences::{Language, Lexicon};
use std::cell::Cell;
use std::rc::Rc;

/// How it goes with the words of a language.
#[derive(Clone, Copy)]
pub(super) enum LexiconState {
    /// They are on their way.
    Come,
    Here(&'static Lexicon),
    /// They could not be fetched; the next sentence asks again.
    Lost,
}

#[derive(Clone, Default)]
struct LexiconShelf {
    words: ArcRwSignal<Option<LexiconState>>,
    asked: Rc<Cell<bool>>,
}

thread_local! {
    static SHELVES: [LexiconShelf; 2] = Default::default();
}

fn address(language: Language) -> &'static str {
    match language {
        Language::English => "/speech-en.txt",
        Language::Japanese => "/speech-ja.txt",
    }
}

/// The words of a language. Reactive: they come when they are here.
pub(super) fn words(language: Language) -> LexiconState {
    let shelf = SHELVES.with(|shelves| shelves[usize::from(language == Language::Japanese)].clone());
    if let Some(words) = shelf.words.get() {
        return words;
    }
    if browser::window().is_none() {
        return LexiconState::Lost;
    }
    if shelf.asked.replace(true) {
        return LexiconState::Come;
    }
    leptos::task::spawn_local(async move {
        let text = browser::text_at(address(language)).await;
        let words = text.map_or(LexiconState::Lost, |text| {
            LexiconState::Here(Box::leak(Box::new(Lexicon::read(text.leak(), language))))
        });
        shelf.asked.set(false);
        shelf.words.set(Some(words));
    });
    LexiconState::Come
}

/// Asks again for words that could not be fetched.
pub(super) fn retry() {
    SHELVES.with(|shelves| {
        for shelf in shelves {
            if matches!(shelf.words.get_untracked(), Some(LexiconState::Lost)) {
                shelf.words.set(None);
            }
        }
    });
}
