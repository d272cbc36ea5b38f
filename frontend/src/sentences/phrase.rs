//! One sentence: its phrases, each of which lights and leads to its part of the graph.

use super::inline::{InlineChoice, InlineNumber};
use super::name_of;
use super::warned::{Warned, problem_of};
use crate::browser;
use crate::desk::{Desk, Lit, Selected};
use crate::focus::{self, FocusPlace};
use crate::graph::Stage;
use crate::keys::PressedKey;
use crate::parts::{DeskHold, hold};
use crate::sentences::words;
use behaviour::Problem;
use leptos::prelude::*;
use sentences::{Piece, Sentence, SentencePart};
use wasm_bindgen::JsCast;

/// An action that was fed within this time is said to happen now, in milliseconds.
const NOW_MS: f64 = 1_000.0;

/// What the pieces of a sentence are; while it stays the same, only words change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PhraseKind {
    Text,
    Number,
    Choice,
}

fn kind(piece: &Piece) -> PhraseKind {
    match piece {
        Piece::Text(_) => PhraseKind::Text,
        Piece::Number(_) => PhraseKind::Number,
        Piece::Choice(_) => PhraseKind::Choice,
    }
}

/// A sentence by its number.
#[component]
pub(super) fn SentenceLine(told: RwSignal<Vec<Sentence>>, at: usize) -> impl IntoView {
    let desk = hold();
    let sentence = Memo::new(move |_| told.read().get(at).cloned());
    let shape = Memo::new(move |_| {
        let kinds = |phrase: &SentencePart| phrase.pieces.iter().map(kind).collect::<Vec<_>>();
        sentence.read().as_ref().map(|sentence| sentence.phrases.iter().map(kinds).collect::<Vec<_>>())
    });
    let now = Memo::new(move |_| sentence.read().as_ref().is_some_and(|sentence| is_now(&desk.desk(), sentence)));
    let happens = move || if desk.desk().is_then() { words::happened_then() } else { words::happens_now() };
    let row = NodeRef::<leptos::html::Li>::new();
    let phrases = move || {
        stay(row);
        let kinds = shape.get().unwrap_or_default().into_iter().enumerate();
        kinds
            .map(|(which, kinds)| view! { <PhrasePart sentence which kinds first=at == 0 && which == 0 /> })
            .collect_view()
    };
    view! {
        <li class="sentence" class:now=move || now.get() node_ref=row>
            {phrases}
            {move || now.get().then(|| view! { <span class="now"><i aria-hidden="true"></i>{happens()}</span> })}
        </li>
    }
}

/// The sentence is made again, of other pieces: the phrase that had the keyboard has it again.
fn stay(row: NodeRef<leptos::html::Li>) {
    let Some(row) = row.get_untracked() else { return };
    let Some(active) = focus::active() else { return };
    let Some(at) = focus::all(&row, ".phrase").iter().position(|phrase| phrase.contains(Some(&active))) else { return };
    focus::place(FocusPlace::Phrase(row.into(), at));
}

/// Whether what leads to its action passed something on within the last second. Reactive.
fn is_now(desk: &Desk, sentence: &Sentence) -> bool {
    if !desk.is_then() && (desk.robots.running().is_none() || desk.unheard.get().is_some()) {
        return false;
    }
    desk.robots.clock.track();
    let connectors = sentence.phrases.last().map(|phrase| phrase.connectors.clone()).unwrap_or_default();
    connectors
        .first()
        .and_then(|id| desk.document.connector(id))
        .is_some_and(|signals| signals.live.with(|live| live.fired > 0 && browser::now_ms() - live.fired_at < NOW_MS))
}

/// A phrase: words that lead to its part, and beside them what can be changed.
#[component]
fn PhrasePart(sentence: Memo<Option<Sentence>>, which: usize, kinds: Vec<PhraseKind>, first: bool) -> impl IntoView {
    let desk = hold();
    let phrase = Memo::new(move |_| {
        sentence.read().as_ref().and_then(|sentence| sentence.phrases.get(which).cloned()).unwrap_or_default()
    });
    let means = Memo::new(move |_| !phrase.read().streams.is_empty() || !phrase.read().connectors.is_empty());
    let selected = Memo::new(move |_| is_selected(desk, &phrase.read()));
    let problem = Memo::new(move |_| problem_of(&desk.desk(), &phrase.read()));
    let (warned, root) = (expect_context::<Warned>(), NodeRef::<leptos::html::Span>::new());
    let stage = StoredValue::new_local(use_context::<Stage>());
    let light = move || untrack(|| desk.desk().document.lit.set(lit_of(&phrase.read())));
    let dark = move || {
        desk.desk().document.lit.try_set(Lit::default());
    };
    let pieces = if kinds.iter().all(|kind| *kind == PhraseKind::Text) {
        view! { <Words phrase means stop=first problem /> }.into_any()
    } else {
        let one = move |(at, kind): (usize, PhraseKind)| {
            let piece = Memo::new(move |_| phrase.read().pieces.get(at).cloned());
            match kind {
                PhraseKind::Text => {
                    let text = move || piece.read().as_ref().map(|piece| words::without_code(piece.text()));
                    let code = move || {
                        piece.read().as_ref().map(|piece| piece.text().to_owned()).filter(|text| text.contains('`'))
                    };
                    view! { <span class="words" title=code>{text}</span> }.into_any()
                }
                PhraseKind::Number => view! { <InlineNumber piece /> }.into_any(),
                PhraseKind::Choice => view! { <InlineChoice piece /> }.into_any(),
            }
        };
        kinds.into_iter().enumerate().map(one).collect_view().into_any()
    };
    // Words between what can be changed are too short to be buttons: a pointer may press them, keys go to what is beside.
    let press = move |event: web_sys::MouseEvent| {
        let target = event.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
        let on_words = target.is_some_and(|target| target.closest(".inline").ok().flatten().is_none());
        if on_words && untrack(|| means.get()) {
            select(&desk.desk(), &phrase.get_untracked());
            let wrong = problem.read_untracked().is_some();
            let inner =
                root.get_untracked().filter(|_| wrong).and_then(|root| focus::all(&root, ".inline[data-stop]").pop());
            if let Some(inner) = inner {
                focus::focus(&inner);
            }
        }
    };
    let focused = move |_| {
        light();
        if let Some(root) = root.get_untracked() {
            warned.show(phrase.get_untracked(), &root);
        }
        if let Some(Some(stage)) = stage.try_get_value() {
            glide(&stage, &phrase.get_untracked());
        }
    };
    view! {
        <span class="phrase" class:means=move || means.get() class:selected=move || selected.get()
            class:warned=move || problem.read().is_some() node_ref=root on:click=press
            on:pointerenter=move |_| light() on:pointerleave=move |_| dark()
            on:focusin=focused on:focusout=move |_| dark()>{pieces}</span>
    }
}

/// A phrase of words alone; if it means something, it leads there.
#[component]
fn Words(phrase: Memo<SentencePart>, means: Memo<bool>, stop: bool, problem: Memo<Option<Problem>>) -> impl IntoView {
    let desk = hold();
    let text = move || words::without_code(&phrase.read().text());
    let code = move || Some(phrase.read().text()).filter(|text| text.contains('`'));
    let go = move || {
        if untrack(|| means.get()) {
            select(&desk.desk(), &phrase.get_untracked());
        }
    };
    let key = move |event: web_sys::KeyboardEvent| {
        if matches!(event.pressed().as_str(), "Enter" | " ") {
            event.prevent_default();
            go();
        }
    };
    let described = move || {
        let wrong = problem.read().as_ref().map(words::told_by);
        means.get().then(|| words::listed(std::iter::once(names(desk, &phrase.read())).chain(wrong)))
    };
    move || {
        if !means.get() {
            return view! { <span class="words" title=code>{text}</span> }.into_any();
        }
        view! {
            <span class="words" title=code role="button" data-stop="" tabindex=if stop { "0" } else { "-1" } aria-description=described
                on:keydown=key>{text}</span>
        }
        .into_any()
    }
}

fn lit_of(phrase: &SentencePart) -> Lit {
    Lit { streams: phrase.streams.clone(), connectors: phrase.connectors.clone() }
}

/// The names of what a phrase means. Reactive.
fn names(desk: DeskHold, phrase: &SentencePart) -> String {
    let desk = desk.desk();
    let connectors = phrase.connectors.iter().cloned().map(Selected::Connector);
    let all = phrase.streams.iter().cloned().map(Selected::Stream).chain(connectors);
    words::listed(all.filter_map(|one| name_of(&desk, &one)))
}

/// Whether the selected connector, or the selected stream of a phrase without connectors, is of this phrase. Reactive.
fn is_selected(desk: DeskHold, phrase: &SentencePart) -> bool {
    desk.desk().document.selected.with(|selected| match selected {
        Some(Selected::Connector(id)) => phrase.connectors.contains(id),
        Some(Selected::Stream(id)) => phrase.connectors.is_empty() && phrase.streams.contains(id),
        Some(Selected::Note(_) | Selected::Group(_)) | None => false,
    })
}

/// Pans just so far that what a phrase is mostly about is seen.
fn glide(stage: &Stage, phrase: &SentencePart) {
    match (phrase.connectors.first(), phrase.streams.first()) {
        (Some(connector), _) => stage.reveal_chip(connector),
        (None, Some(stream)) => stage.reveal(stream),
        (None, None) => {}
    }
}

/// Selects what a phrase is mostly about: its first connector, else its first stream.
fn select(desk: &Desk, phrase: &SentencePart) {
    let connector = phrase.connectors.first().cloned().map(Selected::Connector);
    let chosen = connector.or_else(|| phrase.streams.first().cloned().map(Selected::Stream));
    if let Some(chosen) = chosen {
        desk.document.choose([chosen].into());
    }
}
