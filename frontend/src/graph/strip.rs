//! The strip under what is selected: likely next steps, then thunderbolt, pencil and trash.

use super::flyout::Flyout;
use super::menu::BoltMenu;
use super::strip_spot::{EDGE, HEIGHT, SelectedThing, StageArea, StripObstacles, covers_chip, strip_spot};
use super::view::{CanvasBounds, View};
use super::{Stage, pointers};
use crate::desk::{Desk, LinkState, NewSpot, Saving, Selected, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{STREAM_HEIGHT, VALUE_ROOM, stream_width, text_width};
use crate::parts::RemoveButton;
use crate::steps::{Offer, offers_memo, take};
use behaviour::{Id, Place, StreamKind};
use leptos::prelude::*;
use protocol::Role;

/// At most so many suggestions; fewer where the stage is narrow.
const SUGGESTIONS_MAX: usize = 4;

/// The room at the top of the stage, in its middle, that the banner of a lost connection may take, in pixels.
const BANNER: (f64, f64) = (664.0, 76.0);
/// The room in the stage's lower left corner that a message may take, in pixels.
const MESSAGE: (f64, f64) = (570.0, 96.0);

/// A button with its room, in pixels.
const BUTTON: f64 = 46.0;

/// The widest label, in pixels; longer ones are cut with an ellipsis.
const LABEL_MAX: f64 = 170.0;

/// The strip, as a view.
pub(crate) fn strip() -> AnyView {
    view! { <Strip /> }.into_any()
}

/// The strip, while something is selected.
#[component]
fn Strip() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let hidden = ArcMemo::new(move |_| {
        stage.dragged.with(Option::is_some)
            || stage.wire.with(Option::is_some)
            || stage.offering.with(Option::is_some)
            || stage.context.with(Option::is_some)
    });
    move || {
        if hidden.get() {
            return ().into_any();
        }
        match desk.document.selected.get() {
            Some(Selected::Stream(id)) => view! { <StreamStrip id=id /> }.into_any(),
            Some(Selected::Connector(id)) => view! { <Flyout id=id /> }.into_any(),
            // Their tools are those of several.
            Some(Selected::Note(_) | Selected::Group(_)) | None => ().into_any(),
        }
    }
}

#[component]
fn StreamStrip(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.document.stream(&id) else { return ().into_any() };
    let offers = offers_memo(&desk, &id, SUGGESTIONS_MAX);
    let glides = stage.glides.clone();
    let [size, shown_size, tall] = [(); 3].map(|()| stage.size.clone());
    let action = signals.record.with_untracked(|stream| stream.kind == StreamKind::Actuator);
    let leads_on = !action && untrack(|| desk.may(Role::Editor));
    let buttons = match untrack(|| desk.may_not(Role::Editor)) {
        Some(why) => 1.0 + (text_width(why, 13) + 12.0) / BUTTON,
        None if leads_on => 4.0,
        None => 2.0,
    };
    let fitting = ArcMemo::new(move |_| as_many_as_fit(offers.get(), shown_size.get().0 - 2.0 * EDGE, buttons));
    let others = others_memo(&stage, &desk, &id);
    let told = stage.strip.clone();
    let fitted = {
        let (place, record) = (signals.place.clone(), signals.record.clone());
        ArcMemo::new(move |_| {
            let (view, size) = (stage.view.get(), size.get());
            let area = on_stage(view, place.get(), record.with(stream_width), STREAM_HEIGHT);
            let own = SelectedThing { area, value: VALUE_ROOM * view.zoom, beside: false };
            let around = others.with(|others| others.seen(view, size));
            fitted(own, &around, fitting.get(), buttons, size)
        })
    };
    let spot = {
        let fitted = fitted.clone();
        ArcMemo::new(move |_| fitted.with(|(_, spot)| *spot))
    };
    tell_where(told, fitted.clone(), buttons);
    let shown = ArcMemo::new(move |_| fitted.with(|(offers, _)| offers.clone()));
    let is_high = {
        let (spot, size) = (spot.clone(), tall.clone());
        move || spot.get().1 < size.get().1 / 2.0
    };
    let name = signals.record.with_untracked(|stream| stream.name.clone());
    let what = Selected::Stream(id.clone());
    let (offer_desk, offer_id) = (desk.clone(), id.clone());
    view! {
        <div class="strip" role="toolbar" class:high=is_high class:gliding=move || glides.get()
            aria-label=words::next_steps(&name)
            style:transform=move || translated(spot.get())>
            <For each=move || shown.get().into_iter().enumerate() key=|(at, offer)| (*at, offer.label.clone()) let((at, offer))>
                <OfferButton desk=offer_desk.clone() id=offer_id.clone() offer=offer first={at == 0} />
            </For>
            {leads_on.then(|| view! { <Connect id=id.clone() /> <BoltMenu input=id.clone() /> })}
            <EditAndRemove what=what />
        </div>
    }
    .into_any()
}

/// Tells what else floats where the strip stands, as long as it does.
fn tell_where(told: ArcRwSignal<Option<StageArea>>, fitted: ArcMemo<(Vec<Offer>, (f64, f64))>, buttons: f64) {
    let is = told.clone();
    Effect::new(move |_| {
        let area = fitted.with(|(offers, (left, top))| StageArea {
            left: *left,
            top: *top,
            right: left + strip_width(offers, buttons),
            bottom: top + HEIGHT,
        });
        is.set(Some(area));
    });
    on_cleanup(move || told.set(None));
}

#[component]
fn EditAndRemove(what: Selected) -> impl IntoView {
    let desk = use_desk();
    let removed = what.clone();
    let no_edit = untrack(|| desk.may_not(Role::Editor));
    let (look, icon) = if no_edit.is_some() { (words::look_at_it(), "eye") } else { (words::edit(), "pencil") };
    view! {
        <button type="button" class="tool-button" aria-label=look title=look
            on:click=move |_| pointers::edit(&desk, &what)>
            <Icon name=icon />
        </button>
        {match no_edit {
            Some(why) => view! { <span class="may-not">{why}</span> }.into_any(),
            None => view! { <RemoveButton what=removed class="tool-button" /> }.into_any(),
        }}
    }
}

/// Begins a wire out of a stream.
#[component]
fn Connect(id: Id) -> impl IntoView {
    let stage = expect_context::<Stage>();
    view! {
        <button type="button" class="tool-button" aria-label=words::connect() title=words::connect_hint()
            on:click=move |_| {
                stage.begin_wire(&id, false);
                stage.focus(&id);
            }>
            <Icon name="connect" />
        </button>
    }
}

#[component]
fn OfferButton(desk: Desk, id: Id, offer: Offer, first: bool) -> impl IntoView {
    let hint = offer.says();
    let (icon, label, step) = (offer.icon, offer.label, offer.step);
    view! {
        <button type="button" class="next" class:likely=first title=hint on:click=move |_| take(&desk, &id, &step, NewSpot::default())>
            <Icon name=icon />
            <span>{label}</span>
        </button>
    }
}

fn offer_width(offer: &Offer) -> f64 {
    text_width(&offer.label, 15).min(LABEL_MAX) + 52.0
}

fn strip_width(offers: &[Offer], buttons: f64) -> f64 {
    offers.iter().map(offer_width).sum::<f64>() + buttons * BUTTON + 14.0
}

fn as_many_as_fit(mut offers: Vec<Offer>, width: f64, buttons: f64) -> Vec<Offer> {
    while strip_width(&offers, buttons) > width && offers.pop().is_some() {}
    offers
}

/// Returns as many of the offers as a strip has that covers no chip of its stream and lies under nothing, and where it
/// stands then; all of them where even one would.
fn fitted(
    own: SelectedThing,
    around: &StripObstacles,
    offers: Vec<Offer>,
    buttons: f64,
    size: (f64, f64),
) -> (Vec<Offer>, (f64, f64)) {
    let spot = |offers: &[Offer]| strip_spot(own, around, strip_width(offers, buttons), size);
    let some = (1..=offers.len()).rev().map(|count| &offers[..count]);
    let clear = |offers: &&[Offer]| !covers_chip(spot(offers), around, strip_width(offers, buttons));
    let shown = some.clone().find(clear).unwrap_or(&offers).to_vec();
    let at = spot(&shown);
    (shown, at)
}

fn translated((x, y): (f64, f64)) -> String {
    format!("translate({x:.0}px,{y:.0}px)")
}

fn on_stage(view: View, place: Place, width: f64, height: f64) -> StageArea {
    let (middle, top) = view.to_stage(place);
    let half = width / 2.0 * view.zoom;
    StageArea { left: middle - half, top, right: middle + half, bottom: top + height * view.zoom }
}

/// The things that the strip of something keeps clear of, in canvas units.
#[derive(Clone, Debug, PartialEq)]
struct OtherThings {
    streams: Vec<CanvasBounds>,
    chips: Vec<CanvasBounds>,
    /// True if a message stands at the bottom left of the stage.
    message: bool,
    /// The height of the sentences at the top.
    above: f64,
    /// True if the banner of a lost connection stands at the top.
    banner: bool,
}

impl OtherThings {
    /// Returns where they are on a stage of this size.
    fn seen(&self, view: View, size: (f64, f64)) -> StripObstacles {
        let area = |bounds: &CanvasBounds| {
            let (left, top) = view.to_stage(Place { x: bounds.left, y: bounds.top });
            let (right, bottom) = view.to_stage(Place { x: bounds.right, y: bounds.bottom });
            StageArea { left, top, right, bottom }
        };
        let left = (size.0 - BANNER.0) / 2.0;
        let banner = StageArea { left, top: 0.0, right: left + BANNER.0, bottom: self.above + BANNER.1 };
        let told = (self.above > 0.0).then_some(StageArea { left: 0.0, top: 0.0, right: size.0, bottom: self.above });
        let message = StageArea { left: 0.0, top: size.1 - MESSAGE.1, right: MESSAGE.0, bottom: size.1 };
        StripObstacles {
            streams: self.streams.iter().map(area).collect(),
            chips: self.chips.iter().map(area).collect(),
            over: self
                .message
                .then_some(message)
                .into_iter()
                .chain(told)
                .chain(self.banner.then_some(banner))
                .collect(),
        }
    }
}

/// Returns the bounds of the streams that are not the one with this id, and of the chips at that one.
fn others_memo(stage: &Stage, desk: &Desk, id: &Id) -> ArcMemo<OtherThings> {
    let (stage, desk, id) = (stage.clone(), desk.clone(), id.clone());
    ArcMemo::new(move |_| {
        let others = |shapes: &Vec<(Id, CanvasBounds)>| {
            shapes.iter().filter(|(other, _)| *other != id).map(|(_, bounds)| *bounds).collect()
        };
        desk.document.revision.track();
        let streams = stage.shapes.with(others);
        let message = desk.notice.with(Option::is_some) || desk.asks_for_name();
        let saves = matches!(desk.document.saving.get(), Saving::Saved | Saving::Saving);
        let banner = !saves || desk.online.get() == LinkState::Offline;
        stage.above.track();
        OtherThings { above: stage.above(), streams, chips: stage.chips_at(&id, false), message, banner }
    })
}
