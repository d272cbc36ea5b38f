//! What the open program does, as sentences over the graph: its phrases light their parts, its numbers and choices can be
//! changed where they stand.

pub(crate) mod change;
mod inline;
mod phrase;
mod typed;
mod warned;
mod which;
mod words;

use crate::browser::{self, Drawer};
use crate::desk::{Desk, Lit, Selected};
use crate::focus;
use crate::graph::Stage;
use crate::icons::Icon;
use crate::layout::chip_words;
use crate::parts::language;
use crate::parts::{DeskHold, Soon, hold};
use behaviour::{Helper, Id};
use leptos::prelude::*;
use phrase::SentenceLine;
use sentences::{Language, Sentence};
pub(crate) use typed::{Typed, typed};
use warned::{Trouble, Warned};
use wasm_bindgen::JsCast;
use which::{Which, which};

/// So soon after a change the sentences are made again, in milliseconds.
const SOON_MS: i32 = 60;
/// And what streams carry is asked again, in milliseconds.
const TYPES_MS: i32 = 300;
/// How long after Start what was seen is asked about, in milliseconds.
const SEEN_MS: i32 = 2_500;
/// Where it is kept that somebody wants to see no sentences.
const FOLDED: &str = "rrp.sentences.folded";
/// How high the bar is tells the rest of the page by this name.
const HEIGHT: &str = "--told";

/// How many fields of the bar are open. Until none is, the sentences stay as they are: what somebody else does moves no
/// field away from who types in it.
#[derive(Clone, Copy)]
struct OpenFields(RwSignal<u32>);

impl OpenFields {
    fn begins(self) {
        self.0.update(|open| *open += 1);
    }

    fn ends(self) {
        self.0.try_update(|open| *open = open.saturating_sub(1));
    }

    fn is_now(self) -> bool {
        self.0.try_get_untracked().is_some_and(|open| open > 0)
    }
}

/// The sentences, as a view.
pub(crate) fn sentences_panel() -> AnyView {
    view! { <Told /> }.into_any()
}

/// The sentences of the open program, made again soon after each change.
#[component]
fn Told() -> impl IntoView {
    let desk = hold();
    let language = language();
    let typing = OpenFields(RwSignal::new(0));
    provide_context(typing);
    let told = told_signal(desk, language, typing);
    let folded = RwSignal::new(Drawer::Browser.get(FOLDED).is_some());
    let whole = RwSignal::new(false);
    let printing = Memo::new(move |_| desk.desk().printing.get());
    let shown = Memo::new(move |_| {
        let selected = desk.desk().document.selected.get();
        which(&told.read(), selected.as_ref(), whole.get() || printing.get())
    });
    let some = Memo::new(move |_| !told.read().is_empty());
    let root = NodeRef::<leptos::html::Section>::new();
    follow_height(root);
    Effect::new(move |_| {
        told.track();
        shown.track();
        browser::rendered(move || tab_stop(root));
    });
    let fold = move |_| {
        let fold = !folded.get_untracked();
        folded.set(fold);
        if fold { Drawer::Browser.put(FOLDED, "1") } else { Drawer::Browser.drop(FOLDED) }
    };
    on_cleanup(move || desk.desk().document.lit.set(Lit::default()));
    let warned = Warned::new();
    provide_context(warned);
    let focused = move |event: web_sys::FocusEvent| {
        focus::remember(&event);
        if !warned::stays(&event) {
            warned.hide();
        }
    };
    let has = move |element: Option<web_sys::Node>| {
        let root = root.try_get_untracked().flatten();
        root.is_some_and(|root| element.is_some_and(|element| root.contains(Some(&element))))
    };
    let left = move |event: web_sys::FocusEvent| {
        let to = event.related_target().and_then(|to| to.dyn_into::<web_sys::Node>().ok());
        // To nowhere: what had the keyboard may have been made again, and has it again in a moment.
        let moment = to.is_none();
        let end = move || {
            if !has(to.or_else(|| focus::active().map(Into::into))) {
                warned.hide();
            }
        };
        if moment { browser::rendered(end) } else { end() }
    };
    let rows = move || shown.get().rows;
    view! {
        <section class="told" aria-label=words::what_it_does() hidden=move || !some.get() node_ref=root
            on:keydown=walk on:focusin=focused on:focusout=left>
            <Show when=move || !folded.get() || printing.get()>
                <div class="told-lines" class:whole=move || whole.get()>
                    <Summary desk shown whole />
                    <ul lang=language.code()>
                        <For each=rows key=|at| *at children=move |at| view! { <SentenceLine told at /> } />
                    </ul>
                </div>
            </Show>
            <Show when=move || folded.get() && !printing.get()><p class="told-lines folded">{words::what_it_does()}</p></Show>
            <Trouble warned />
            <div class="told-tools">
                <button type="button" class="tool icon fold" class:folded=move || folded.get() aria-expanded=move || (!folded.get()).to_string()
                    aria-label=words::what_it_does() title=move || if folded.get() { words::show_sentences() } else { words::hide_sentences() }
                    on:click=fold><Icon name="chevron" /></button>
            </div>
        </section>
    }
}

/// Tab comes to the first thing of the bar, until another one had the keyboard.
fn tab_stop(root: NodeRef<leptos::html::Section>) {
    let Some(root) = root.try_get_untracked().flatten() else { return };
    let stops = focus::all(&root, "[data-stop]");
    if !stops.iter().any(|stop| stop.tab_index() == 0)
        && let Some(first) = stops.first()
    {
        first.set_tab_index(0);
    }
}

/// What a stream is called, or a connector. Reactive.
fn name_of(desk: &Desk, one: &Selected) -> Option<String> {
    match one {
        Selected::Stream(id) => Some(desk.document.stream(id)?.record.with(|stream| stream.name.clone())),
        Selected::Connector(id) => {
            Some(desk.document.connector(id)?.record.with(|connector| chip_words(connector).whole()))
        }
        Selected::Note(_) | Selected::Group(_) => None,
    }
}

/// Left and right go by phrase, also from a list, which up and down change; a field that is typed in has its keys for itself.
fn walk(event: web_sys::KeyboardEvent) {
    if focus::active().is_none_or(|active| active.tag_name() != "INPUT") {
        focus::walk(&event, "ArrowRight", "ArrowLeft");
    }
}

/// How many sentences there are, where not all of them are shown.
#[component]
fn Summary(desk: DeskHold, shown: Memo<Which>, whole: RwSignal<bool>) -> impl IntoView {
    let line = move || {
        let shown = shown.get();
        let name = desk.desk().document.selected.with(|selected| name_of(&desk.desk(), selected.as_ref()?));
        match (shown.all, shown.rows.len(), name) {
            (all, some, _) if some == all => None,
            (all, 0, None) => Some(words::sentences_folded(all)),
            (all, some, Some(name)) => Some(words::in_sentences(&name, some, all)),
            (all, some, None) => Some(words::first_sentences(some, all)),
        }
    };
    let toggle = move || {
        let shown = shown.get();
        (shown.all > crate::graph::SENTENCES_MAX).then(|| {
            let label = move || if whole.get() { words::show_fewer() } else { words::show_all_sentences() };
            view! { <button type="button" class="link" on:click=move |_| whole.update(|whole| *whole = !*whole)>{label}</button> }
        })
    };
    let there = Memo::new(move |_| shown.read().all > crate::graph::SENTENCES_MAX);
    view! {
        <Show when=move || there.get()><p class="told-summary"><span>{line}</span> {toggle}</p></Show>
    }
}

/// What is told, made again soon after each change of the program or of a helper.
fn told_signal(desk: DeskHold, language: Language, typing: OpenFields) -> RwSignal<Vec<Sentence>> {
    let told = RwSignal::new(Vec::new());
    let of = StoredValue::new(None::<Id>);
    let make = move || {
        let Some(desk) = desk.if_there() else { return };
        let open = desk.document.open.get_untracked();
        if typing.is_now() && of.try_get_value().flatten() == open {
            return;
        }
        of.try_set_value(open);
        let behaviour = desk.document.behaviour();
        let made = desk.library.helpers.with_untracked(|helpers| {
            let helpers: Vec<&Helper> = helpers.iter().map(|(_, helper)| helper).collect();
            let unit = |id: &Id| Some(untrack(|| desk.document.unit(id))).filter(|unit| !unit.is_empty());
            sentences::explain(&behaviour, &helpers, &|id| unit(id).map(str::to_owned), language)
        });
        if told.try_with_untracked(|old| *old != made) == Some(true) {
            told.set(made);
        }
    };
    make();
    let soon = Soon::new(make);
    let shown = StoredValue::new_local(soon);
    Effect::new(move |_| {
        let desk = desk.desk();
        desk.document.edited.track();
        desk.document.open.track();
        desk.library.helpers.track();
        desk.document.types.track();
        typing.0.track();
        shown.with_value(|soon| soon.within(SOON_MS));
    });
    ask_types(desk);
    told
}

/// What streams carry is asked again soon after what is saved has changed.
fn ask_types(desk: DeskHold) {
    let soon = Soon::new(move || {
        if let Some(desk) = desk.if_there() {
            desk.document.ask_types();
        }
    });
    let soon = StoredValue::new_local(soon);
    Effect::new(move |_| {
        let desk = desk.desk();
        desk.document.revision.track();
        desk.document.open.track();
        desk.library.helpers.track();
        soon.with_value(|soon| soon.within(TYPES_MS));
    });
    // A while after Start there are values, which tell what nobody could before.
    let seen = StoredValue::new_local(Soon::new(move || {
        if let Some(desk) = desk.if_there() {
            desk.document.ask_types();
        }
    }));
    let runs = Memo::new(move |_| desk.desk().robots.running().is_some());
    Effect::new(move |_| {
        if runs.get() {
            seen.with_value(|soon| soon.within(SEEN_MS));
        }
    });
}

/// Tells the stage and the style sheets how high the bar is.
fn follow_height(root: NodeRef<leptos::html::Section>) {
    let stage = StoredValue::new_local(use_context::<Stage>());
    let tell = move |height: f64| {
        if let Some(Some(stage)) = stage.try_get_value() {
            stage.tell_above(height);
            let _ = height_of_all(height);
        }
    };
    Effect::new(move |_| {
        let Some(root) = root.get() else { return };
        let measured = root.clone();
        let measure = move || tell(f64::from(measured.offset_height()));
        measure();
        if let Some(observer) = browser::watch_size(&root, measure) {
            let observer = StoredValue::new_local(observer);
            on_cleanup(move || {
                let _ = observer.try_with_value(web_sys::ResizeObserver::disconnect);
                let _ = height_of_all(0.0);
            });
        }
    });
}

fn height_of_all(height: f64) -> Option<()> {
    let root = browser::window()?.document()?.document_element()?.dyn_into::<web_sys::HtmlElement>().ok()?;
    root.style().set_property(HEIGHT, &format!("{height:.0}px")).ok()
}
