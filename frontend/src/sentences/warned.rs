//! What is wrong with what a phrase means: a wave below its words, and while it has the keyboard, what mends it beside it.

use crate::desk::Desk;
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::parts::ProblemLine;
use crate::parts::hold;
use crate::sentences::words;
use behaviour::{Kind, Problem};
use leptos::prelude::*;
use sentences::SentencePart;
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

/// How wide what is said is at most, and its distance to the phrase, in pixels.
const WIDTH: f64 = 320.0;
const NEAR: f64 = 8.0;

/// The phrase that has the keyboard, with where its problem is said. What is wrong with it may change meanwhile.
#[derive(Clone, Copy)]
pub(super) struct Warned {
    shown: RwSignal<Option<(SentencePart, (f64, f64))>>,
    phrase: StoredValue<Option<HtmlElement>, LocalStorage>,
}

impl Warned {
    pub(super) fn new() -> Self {
        Self { shown: RwSignal::new(None), phrase: StoredValue::new_local(None) }
    }

    /// A phrase got the keyboard.
    pub(super) fn show(self, phrase: SentencePart, element: &HtmlElement) {
        self.phrase.set_value(Some(element.clone()));
        self.shown.set(beside(element).map(|at| (phrase, at)));
    }

    /// The keyboard left the phrases and what is said of them.
    pub(super) fn hide(self) {
        if self.shown.try_with_untracked(Option::is_some) == Some(true) {
            self.shown.set(None);
        }
    }

    /// The keyboard goes back there: the phrase.
    fn back(self) -> Option<FocusPlace> {
        self.phrase.get_value().map(|phrase| FocusPlace::FirstStop(phrase.into()))
    }
}

/// Below the phrase, within the bar of sentences.
fn beside(phrase: &HtmlElement) -> Option<(f64, f64)> {
    let bar = phrase.closest(".told").ok().flatten()?;
    let (own, all) = (phrase.get_bounding_client_rect(), bar.get_bounding_client_rect());
    let left = (own.left() - all.left()).min(all.width() - WIDTH - NEAR).max(NEAR);
    Some((left, own.bottom() - all.top() + NEAR))
}

/// What is wrong with what a phrase means. Reactive.
pub(super) fn problem_of(desk: &Desk, phrase: &SentencePart) -> Option<Problem> {
    desk.document.problems.with(|all| all.iter().find(|problem| is_of(problem, phrase)).cloned())
}

fn is_of(problem: &Problem, phrase: &SentencePart) -> bool {
    match problem.at.kind {
        Kind::Connector => phrase.connectors.contains(&problem.at.id),
        Kind::Stream => phrase.streams.contains(&problem.at.id),
        Kind::Settings | Kind::Helper | Kind::Place | Kind::Note | Kind::Group | Kind::Pad => false,
    }
}

/// Whether the keyboard stays with a phrase, or with what is said of one.
pub(super) fn stays(event: &web_sys::FocusEvent) -> bool {
    let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    target.is_some_and(|target| target.closest(".phrase, .told-trouble").ok().flatten().is_some())
}

/// What is said is made again: the keyboard stays in it.
fn stay<T>(root: NodeRef<leptos::html::Div>, shown: Option<T>) -> Option<T> {
    let here = |root: &HtmlElement| focus::active().is_some_and(|active| root.contains(Some(&active)));
    if let Some(root) = root.get_untracked().filter(|root| shown.is_some() && here(root)) {
        focus::place(FocusPlace::First(root.into()));
    }
    shown
}

/// The problem in words, with what mends it.
#[component]
pub(super) fn Trouble(warned: Warned) -> impl IntoView {
    let desk = hold();
    // Mended, by whomever: there is nothing to say any more. The server may also know more of it by now.
    let shown = Memo::new(move |_| {
        let (phrase, at) = warned.shown.get()?;
        Some((problem_of(&desk.desk(), &phrase)?, at))
    });
    let root = NodeRef::<leptos::html::Div>::new();
    let keys = move |event: web_sys::KeyboardEvent| {
        let hide = || {
            warned.back().iter().for_each(|phrase| drop(phrase.take()));
            warned.hide();
        };
        if escape::ends(&event, hide) {
            event.stop_propagation();
        }
    };
    let press = move |event: web_sys::MouseEvent| {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        if target.is_some_and(|target| target.closest("button").ok().flatten().is_some()) {
            warned.back().into_iter().for_each(focus::place);
        }
    };
    view! {
        <div role="status" node_ref=root>
            {move || stay(root, shown.get()).map(|(problem, (left, top))| view! {
                <div class="trouble told-trouble" role="group" aria-label=words::problems() style:left=format!("{left:.0}px")
                    style:top=format!("{top:.0}px") on:keydown=keys on:click=press>
                    <ul class="big-list"><ProblemLine problem alone=true /></ul>
                </div>
            })}
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::is_of;
    use behaviour::{Id, Problem, ProblemKind};
    use sentences::SentencePart;

    #[test]
    fn a_problem_is_of_the_phrase_that_means_what_has_it() {
        let id = |text: &str| Id::new(text).unwrap();
        let named = || "Near".to_owned();
        let problem =
            |at: &str| Problem { at: at.parse().unwrap(), name: named(), kind: ProblemKind::EmptyBody, blocks: true };
        let phrase =
            SentencePart { streams: vec![id("near")], connectors: vec![id("test")], ..SentencePart::default() };
        assert!(is_of(&problem("connector/test"), &phrase) && is_of(&problem("stream/near"), &phrase));
        assert!(!is_of(&problem("connector/near"), &phrase) && !is_of(&problem("stream/other"), &phrase));
    }
}
