//! The offer: what can come after a stream, as a menu where a wire was dropped or where an edge has its plus.

use super::Stage;
use crate::browser;
use crate::desk::{Desk, Dialog, Gap, GraphChoice, NewSpot, Selected, use_desk};
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::graph::words;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::layout::STREAM_HEIGHT;
use crate::parts::Finder;
use crate::steps::{Offer, Step, actions, after, everything, take};
use behaviour::{Id, Place};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, FocusEvent, HtmlElement, KeyboardEvent, Node};

/// The greatest size of the menu, in pixels.
const SIZE: (f64, f64) = (290.0, 400.0);
/// Room kept from the edges of the stage, in pixels.
const EDGE: f64 = 8.0;

/// The steps that are offered, and where.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Offering {
    input: Id,
    /// The place where the menu opens, in canvas units.
    at: Place,
    spot: NewSpot,
    /// Only actions are asked for.
    acts: bool,
}

impl Offering {
    /// Offers what can come after a stream, its new stream standing there.
    pub(super) fn at(input: Id, at: Place) -> Self {
        Self { input, at, spot: NewSpot::At(at), acts: false }
    }

    /// The actions that a stream can lead to.
    fn actions(input: Id, at: Place) -> Self {
        Self { input, at, spot: NewSpot::default(), acts: true }
    }

    /// Offers what can be put into an edge.
    pub(super) fn into_gap(gap: Gap, at: Place) -> Self {
        Self { input: gap.input.clone(), at, spot: NewSpot::Into(gap), acts: false }
    }
}

impl Stage {
    /// Opens an offer; the keyboard goes into it.
    pub(super) fn offer(&self, offering: Offering) {
        self.offering.set(Some(offering));
        focus::place(FocusPlace::Offer);
    }

    /// Offers what is asked for elsewhere in the page: actions beside their stream, the rest in its dialog.
    pub(super) fn follow_asked(&self, desk: &Desk) {
        let (stage, desk) = (self.clone(), desk.clone());
        Effect::new(move |_| {
            let Some(choice) = desk.asked.get() else { return };
            desk.asked.set(None);
            match choice {
                GraphChoice::Action(id) => stage.offer_actions(&id),
                other => desk.dialog.set(Some(Dialog::Choose(other))),
            }
        });
    }

    fn offer_actions(&self, id: &Id) {
        let Some(place) = self.desk.document.stream(id).map(|signals| signals.place.get_untracked()) else { return };
        self.desk.document.choose([Selected::Stream(id.clone())].into());
        if self.desk.dialog.with_untracked(Option::is_some) {
            self.desk.dialog.set(None);
        }
        let below = Place { x: place.x, y: place.y + STREAM_HEIGHT };
        let (stage, offering) = (self.clone(), Offering::actions(id.clone(), below));
        browser::rendered(move || stage.offer(offering));
    }
}

/// The open offer, as a view.
pub(crate) fn offer() -> AnyView {
    view! { <OfferMenu /> }.into_any()
}

/// The open offer.
#[component]
pub(super) fn OfferMenu() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let offering = stage.offering.clone();
    move || offering.get().map(|offering| view! { <Open offering /> })
}

#[component]
fn Open(offering: Offering) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let name = desk.document.stream(&offering.input).map(|signals| signals.record);
    let name = name.map(|record| record.with_untracked(|stream| stream.name.clone())).unwrap_or_default();
    let value = {
        let (desk, id) = (desk.clone(), offering.input.clone());
        let live = desk.document.stream(&id).map(|signals| signals.live);
        let measured = move |value: &behaviour::Value| desk.document.measured(&id, value);
        move || live.as_ref().and_then(|live| live.with(|live| live.value.as_ref().map(&measured)))
    };
    let finds = RwSignal::new(false);
    let (placed, at) = (stage.clone(), offering.at);
    let style = move || {
        let (view, size) = (placed.view.get(), placed.size.get());
        let (x, y) = view.to_stage(at);
        let fit = |at: f64, own: f64, whole: f64| at.min(whole - own - EDGE).max(EDGE);
        format!("translate({:.0}px,{:.0}px)", fit(x + 12.0, SIZE.0, size.0), fit(y + 4.0, SIZE.1, size.1))
    };
    let (keys, left, input) = (stage.clone(), stage.clone(), offering.input.clone());
    let leaves = move |event: FocusEvent| {
        if leaves_menu(&event) && !left.may_end_wire(&event) {
            left.forget_wire();
        }
    };
    let inside = move || {
        let (desk, stage, offering) = (desk.clone(), stage.clone(), offering.clone());
        if finds.get() {
            view! { <Found desk stage offering /> }.into_any()
        } else {
            view! { <Items desk stage offering finds /> }.into_any()
        }
    };
    view! {
        <div class="offer" role=move || if finds.get() { "dialog" } else { "menu" } aria-label=words::after_stream(&name) style:transform=style
            on:keydown=move |event| key(&event, &keys, &input, finds.get_untracked())
            on:focusout=leaves
        >
            <p class="offer-head"><span class="cut">{words::after_stream(&name)}</span><span class="faint">{value}</span></p>
            {inside}
        </div>
    }
}

/// Shows what is likely, and the way to everything else.
#[component]
fn Items(desk: Desk, stage: Stage, offering: Offering, finds: RwSignal<bool>) -> impl IntoView {
    let in_gap = matches!(offering.spot, NewSpot::Into(_));
    let offers =
        untrack(|| if offering.acts { actions(&desk, &offering.input) } else { after(&desk, &offering.input, in_gap) });
    let find = move |_| {
        finds.set(true);
        focus::place(FocusPlace::OfferField);
    };
    view! {
        {offers.into_iter().enumerate().map(|(at, offer)| {
            view! { <Item desk=desk.clone() stage=stage.clone() offering=offering.clone() offer=offer first={at == 0} /> }
        }).collect_view()}
        <div class="menu-rule" role="separator"></div>
        <button type="button" role="menuitem" tabindex="-1" class="menu-item" on:click=find>
            <Icon name="search" /><span class="cut">{words::find_another()}</span>
        </button>
    }
}

/// Everything, by its name; what is chosen goes where the offer is.
#[component]
fn Found(desk: Desk, stage: Stage, offering: Offering) -> impl IntoView {
    let in_gap = matches!(offering.spot, NewSpot::Into(_));
    let offers = untrack(|| everything(&desk, &offering.input, in_gap));
    let held = StoredValue::new_local((desk, stage, offering));
    let choose = Callback::new(move |step: Step| {
        let (desk, stage, offering) = held.get_value();
        stage.forget_wire();
        take(&desk, &offering.input, &step, offering.spot);
    });
    view! { <Finder offers choose /> }
}

#[component]
fn Item(desk: Desk, stage: Stage, offering: Offering, offer: Offer, first: bool) -> impl IntoView {
    let (says, brief) = (offer.says(), offer.brief());
    let Offer { step, icon, label } = offer;
    let choose = move |_| {
        stage.forget_wire();
        take(&desk, &offering.input, &step, offering.spot.clone());
    };
    view! {
        <button type="button" role="menuitem" tabindex="-1" class="menu-item" class:likely=first title=says on:click=choose>
            <Icon name=icon /><span class="cut">{label}</span><span class="faint brief">{brief}</span>
        </button>
    }
}

fn key(event: &KeyboardEvent, stage: &Stage, input: &Id, finds: bool) {
    let forget = || {
        stage.forget_wire();
        stage.focus(input);
    };
    if escape::ends(event, forget) {
        return event.stop_propagation();
    }
    match event.pressed().as_str() {
        "ArrowDown" | "ArrowUp" | "Home" | "End" if finds => return,
        "ArrowDown" => step(event, |at, count| (at + 1) % count),
        "ArrowUp" => step(event, |at, count| (at + count - 1) % count),
        "Home" => step(event, |_, _| 0),
        "End" => step(event, |_, count| count - 1),
        letter if !finds && is_letter(event, letter) => to_letter(event, letter),
        _ => return,
    }
    event.prevent_default();
    event.stop_propagation();
}

fn is_letter(event: &KeyboardEvent, key: &str) -> bool {
    let plain = !(event.ctrl_key() || event.meta_key() || event.alt_key());
    plain && key.chars().count() == 1 && key.chars().all(char::is_alphanumeric)
}

/// The next item that begins with a letter gets the keyboard.
fn to_letter(event: &KeyboardEvent, letter: &str) {
    let Some(menu) = event.current_target().and_then(|menu| menu.dyn_into::<Element>().ok()) else { return };
    let items = focus::all(&menu, "[role=menuitem]");
    let now = focus::active();
    let at = items.iter().position(|item| Some(item) == now.as_ref()).unwrap_or(0);
    let begins = |item: &&HtmlElement| {
        let text = item.text_content().unwrap_or_default();
        text.trim_start().to_lowercase().starts_with(&letter.to_lowercase())
    };
    if let Some(item) = items.iter().skip(at + 1).chain(items.iter().take(at + 1)).find(begins) {
        focus::focus(item);
    }
}

/// The next item of the menu around the event gets the keyboard.
pub(super) fn step(event: &KeyboardEvent, next: impl Fn(usize, usize) -> usize) {
    let menu = event.current_target().and_then(|menu| menu.dyn_into::<Element>().ok());
    let Some(Ok(items)) = menu.map(|menu| menu.query_selector_all("[role=menuitem]")) else { return };
    let items: Vec<HtmlElement> = (0..items.length()).filter_map(|at| items.item(at)?.dyn_into().ok()).collect();
    let now = document().active_element();
    let at = items.iter().position(|item| Some(item.unchecked_ref::<Element>()) == now.as_ref());
    if let Some(item) = items.get(at.map_or(0, |at| next(at, items.len()))) {
        let _ = item.focus();
    }
}

/// True if the keyboard goes from inside a menu to elsewhere.
pub(super) fn leaves_menu(event: &FocusEvent) -> bool {
    let menu = event.current_target().and_then(|menu| menu.dyn_into::<Node>().ok());
    let next = event.related_target().and_then(|next| next.dyn_into::<Node>().ok());
    next.is_some() && !menu.is_some_and(|menu| menu.contains(next.as_ref()))
}
