//! The strip under what is selected: likely next steps, then thunderbolt, pencil and trash.

use super::menu::BoltMenu;
use super::room::Side;
use super::strip_spot::{Area, Around, EDGE, Own, covers_chip, strip_spot};
use super::suggest::{Step, suggest};
use super::view::{Bounds, View};
use super::{Stage, pointers};
use crate::desk::{ConnectPlan, Desk, Dialog, Output, Selected, use_desk};
use crate::icons::Icon;
use crate::layout::{CHIP_HEIGHT, STREAM_HEIGHT, VALUE_ROOM, chip_width, chip_words, stream_width, text_width};
use crate::words;
use behaviour::{Helper, Id, Operation, Params, Place, Procedure, StreamKind, connectors};
use leptos::prelude::*;
use protocol::Role;

/// At most so many suggestions; fewer where the stage is narrow.
const SUGGESTIONS_MAX: usize = 4;

/// How much of the stage's lower left corner a message may take, in pixels.
const MESSAGE: (f64, f64) = (570.0, 96.0);

/// The widest label, in pixels; longer ones are cut with an ellipsis.
const LABEL_MAX: f64 = 170.0;

/// One button for a likely next step.
#[derive(Clone, Debug, PartialEq)]
struct Offer {
    step: Step,
    icon: &'static str,
    label: String,
}

/// The strip, while something is selected.
#[component]
pub(super) fn Strip() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let hidden = stage.dragged.clone();
    move || {
        if hidden.with(Option::is_some) {
            return ().into_any();
        }
        match desk.document.selected.get() {
            Some(Selected::Stream(id)) => view! { <StreamStrip id=id /> }.into_any(),
            Some(Selected::Connector(id)) => view! { <ConnectorStrip id=id /> }.into_any(),
            None => ().into_any(),
        }
    }
}

#[component]
fn StreamStrip(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.document.stream(&id) else { return ().into_any() };
    let offers = offers_memo(&desk, &id);
    let glides = stage.glides.clone();
    let [size, shown_size, tall] = [(); 3].map(|()| stage.size.clone());
    let action = signals.record.with_untracked(|stream| stream.kind == StreamKind::Actuator);
    let leads_on = !action && untrack(|| desk.may(Role::Editor));
    let buttons = if leads_on { 3.0 } else { 2.0 };
    let fitting = ArcMemo::new(move |_| as_many_as_fit(offers.get(), shown_size.get().0 - 2.0 * EDGE, buttons));
    let others = others_memo(&stage, &desk, &id);
    let fitted = {
        let (place, record) = (signals.place.clone(), signals.record.clone());
        ArcMemo::new(move |_| {
            let (view, size) = (stage.view.get(), size.get());
            let area = on_stage(view, place.get(), record.with(stream_width), STREAM_HEIGHT);
            let own = Own { area, value: VALUE_ROOM * view.zoom, beside: false };
            let around = others.with(|others| others.seen(view, size));
            fitted(own, &around, fitting.get(), buttons, size)
        })
    };
    let spot = {
        let fitted = fitted.clone();
        ArcMemo::new(move |_| fitted.with(|(_, spot)| *spot))
    };
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
            {leads_on.then(|| view! { <BoltMenu input=id.clone() /> })}
            <EditAndRemove what=what />
        </div>
    }
    .into_any()
}

#[component]
fn ConnectorStrip(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.document.connector(&id) else { return ().into_any() };
    let word = signals.record.with_untracked(|connector| connector.operation.word());
    let glides = stage.glides.clone();
    let others = others_memo(&stage, &desk, &id);
    let (bubble, mine) = (stage.side_of_chip(&id), id.clone());
    let spot = {
        let (desk, record) = (desk.clone(), signals.record.clone());
        move || {
            let fails = desk.robots.failing.with(|failing| failing.iter().any(|failing| failing.connector == mine));
            // What it says at its right is not covered.
            let said = match bubble.get() {
                Some((Side::Right, width)) if fails => width + 20.0,
                _ => 0.0,
            };
            let (place, width) =
                record.with(|connector| (super::chip::chip_of(&desk, connector), chip_width(&chip_words(connector))));
            let view = stage.view.get();
            let area = |place| on_stage(view, place, width, CHIP_HEIGHT);
            let own = |place| Own { area: area(place), value: said * view.zoom, beside: true };
            let spot = |place| {
                let own = own(place);
                let size = stage.size.get();
                others.with(|others| strip_spot(own, &others.seen(view, size), strip_width(&[], 2.0), size))
            };
            place.map(spot).map(translated)
        }
    };
    view! {
        <div class="strip" role="toolbar" class:gliding=move || glides.get() aria-label=words::next_steps(word)
            style:transform=spot>
            <EditAndRemove what=Selected::Connector(id) />
        </div>
    }
    .into_any()
}

#[component]
fn EditAndRemove(what: Selected) -> impl IntoView {
    let desk = use_desk();
    let (remove_desk, removed) = (desk.clone(), what.clone());
    let no_edit = untrack(|| desk.may_not(Role::Editor));
    let (look, icon) = if no_edit.is_some() { (words::look_at_it(), "eye") } else { (words::edit(), "pencil") };
    view! {
        <button type="button" class="tool-button" aria-label=look title=look
            on:click=move |_| pointers::edit(&desk, &what)>
            <Icon name=icon />
        </button>
        <button type="button" class="tool-button" aria-label=words::remove() title=no_edit.unwrap_or(words::remove())
            disabled=no_edit.is_some() on:click=move |_| remove_desk.document.remove(&removed)>
            <Icon name="trash" />
        </button>
    }
}

#[component]
fn OfferButton(desk: Desk, id: Id, offer: Offer, first: bool) -> impl IntoView {
    let (icon, label, step) = (offer.icon, offer.label, offer.step);
    view! {
        <button type="button" class="next" class:likely=first title=title(&step) on:click=move |_| take(&desk, &id, &step)>
            <Icon name=icon />
            <span>{label}</span>
        </button>
    }
}

fn title(step: &Step) -> String {
    match step {
        Step::Helper(name) => format!("{} ({name})", connectors::to_new_value().name),
        Step::Connector(spec) => spec.says.to_owned(),
        Step::Otherwise(spec, body) => format!("{} ({body})", spec.name),
        Step::Action(device, _) => device.says.to_owned(),
    }
}

fn offers_memo(desk: &Desk, id: &Id) -> ArcMemo<Vec<Offer>> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| {
        desk.document.revision.track();
        if !desk.may(Role::Editor) {
            return Vec::new();
        }
        let helpers: Vec<Helper> = desk.library.helpers.get().into_iter().map(|(_, helper)| helper).collect();
        let value =
            desk.document.stream(&id).and_then(|signals| signals.live.with_untracked(|live| live.value.clone()));
        let steps = suggest(&desk.document.behaviour(), &id, &helpers, value.as_ref());
        steps.into_iter().take(SUGGESTIONS_MAX).map(offer).collect()
    })
}

fn offer(step: Step) -> Offer {
    let (icon, label) = match &step {
        Step::Helper(name) => ("fx", name.clone()),
        Step::Connector(spec) => (spec.icon.name, spec.name.to_owned()),
        Step::Otherwise(spec, _) => (spec.icon.name, words::otherwise().to_owned()),
        Step::Action(device, _) => (device.icon, device.next_step.label.unwrap_or(device.name).to_owned()),
    };
    Offer { step, icon, label }
}

/// Does what was suggested.
fn take(desk: &Desk, input: &Id, step: &Step) {
    match step {
        Step::Helper(name) => {
            let output = new_output(desk, &spoken(name), None, Params::new());
            let operation = connectors::to_new_value().with(Procedure::Helper(name.clone()));
            connect(desk, input, operation, output, false);
        }
        Step::Connector(kind) => {
            desk.dialog.set(Some(Dialog::Operation { input: input.clone(), connector: None, kind }));
        }
        Step::Otherwise(spec, body) => {
            let output = new_output(desk, "Otherwise", None, Params::new());
            connect(desk, input, spec.with(Procedure::body(body)), output, false);
        }
        Step::Action(device, params) => {
            let base = device.next_step.stream.unwrap_or(device.name);
            let output = new_output(desk, base, Some(device.name), params.clone());
            connect(desk, input, connectors::to_action().with(()), output, device.next_step.asks);
        }
    }
}

/// `ball_to_distance` becomes "Ball to distance".
fn spoken(name: &str) -> String {
    let words = name.replace('_', " ");
    let mut rest = words.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

fn new_output(desk: &Desk, base: &str, device: Option<&str>, params: Params) -> Output {
    Output::New { name: desk.document.name_for(base), device: device.map(str::to_owned), params }
}

fn connect(desk: &Desk, input: &Id, operation: Operation, output: Output, then_edit: bool) {
    let plan = ConnectPlan { operation, inputs: vec![input.clone()], output };
    let after = desk.clone();
    desk.document.connect(plan, move |answer| {
        let made = if answer.is_ok() && then_edit { after.document.selected.get_untracked() } else { None };
        if let Some(Selected::Stream(made)) = made {
            after.dialog.set(Some(Dialog::EditStream(made)));
        }
        after.say_refusal(answer);
    });
}

fn offer_width(offer: &Offer) -> f64 {
    text_width(&offer.label, 15).min(LABEL_MAX) + 52.0
}

fn strip_width(offers: &[Offer], buttons: f64) -> f64 {
    offers.iter().map(offer_width).sum::<f64>() + buttons * 46.0 + 14.0
}

fn as_many_as_fit(mut offers: Vec<Offer>, width: f64, buttons: f64) -> Vec<Offer> {
    while strip_width(&offers, buttons) > width && offers.pop().is_some() {}
    offers
}

/// As many of the offers as a strip has that covers no chip of its stream, and where it stands then; all of them where even
/// one would.
fn fitted(own: Own, around: &Around, offers: Vec<Offer>, buttons: f64, size: (f64, f64)) -> (Vec<Offer>, (f64, f64)) {
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

fn on_stage(view: View, place: Place, width: f64, height: f64) -> Area {
    let (middle, top) = view.to_stage(place);
    let half = width / 2.0 * view.zoom;
    Area { left: middle - half, top, right: middle + half, bottom: top + height * view.zoom }
}

/// What the strip of something keeps clear of, in canvas units.
#[derive(Clone, Debug, PartialEq)]
struct Others {
    streams: Vec<Bounds>,
    chips: Vec<Bounds>,
    /// Whether a message stands at the bottom left of the stage.
    message: bool,
}

impl Others {
    /// Where that is on a stage of this size.
    fn seen(&self, view: View, size: (f64, f64)) -> Around {
        let area = |bounds: &Bounds| {
            let (left, top) = view.to_stage(Place { x: bounds.left, y: bounds.top });
            let (right, bottom) = view.to_stage(Place { x: bounds.right, y: bounds.bottom });
            Area { left, top, right, bottom }
        };
        let message = Area { left: 0.0, top: size.1 - MESSAGE.1, right: MESSAGE.0, bottom: size.1 };
        Around {
            streams: self.streams.iter().map(area).collect(),
            chips: self.chips.iter().map(area).collect(),
            over: self.message.then_some(message).into_iter().collect(),
        }
    }
}

/// Where the streams are that are not the one with this id, and the chips at that one.
fn others_memo(stage: &Stage, desk: &Desk, id: &Id) -> ArcMemo<Others> {
    let (stage, desk, id) = (stage.clone(), desk.clone(), id.clone());
    ArcMemo::new(move |_| {
        let others = |shapes: &Vec<(Id, Bounds)>| {
            shapes.iter().filter(|(other, _)| *other != id).map(|(_, bounds)| *bounds).collect()
        };
        desk.document.revision.track();
        let streams = stage.shapes.with(others);
        let message = desk.notice.with(Option::is_some) || desk.asks_for_name();
        Others { streams, chips: stage.chips_at(&id, false), message }
    })
}

#[cfg(test)]
mod tests {
    use super::spoken;

    #[test]
    fn helpers_become_names_of_streams() {
        assert_eq!(spoken("ball_to_distance"), "Ball to distance");
    }
}
