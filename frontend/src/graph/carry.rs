//! Something of the left list is carried to the graph: a sense to free ground, an action or a helper to a stream.

use super::{Stage, wire};
use crate::browser::{self, ListenerHandle};
use crate::desk::{CarriedItem, CarryStage, ListItem, Moved, NewSpot, use_desk};
use crate::escape;
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::STREAM_HEIGHT;
use crate::steps::{lead_to_action, lead_to_helper, takes_one};
use behaviour::{Id, Place, StreamKind};
use leptos::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;
use wasm_bindgen::JsCast;
use web_sys::{Event, KeyboardEvent, PointerEvent};

/// A finger that rests so long on something of the list takes it out, in milliseconds.
const REST_MS: i32 = 300;
/// A moment for the click that belongs to a drop, in milliseconds.
const CLICK_MS: i32 = 50;
/// The distance from the pointer to what is carried, in pixels.
const BESIDE: (f64, f64) = (12.0, 10.0);

/// Shows what is carried, as a view.
pub(crate) fn carry() -> AnyView {
    view! { <Carrying /> }.into_any()
}

/// Shows what is carried beside the pointer. As long as it is there it hears the pointer, wherever that is.
#[component]
fn Carrying() -> impl IntoView {
    let stage = expect_context::<Stage>();
    StoredValue::new_local(hear(&stage));
    if use_desk().carried.with_untracked(|carried| carried.as_ref().is_some_and(CarriedItem::is_by_finger)) {
        let stage = stage.clone();
        let pressed = stage.pressed_at();
        browser::after(REST_MS, move || stage.rest(pressed));
    }
    let carried = use_desk().carried.clone();
    let shown = ArcMemo::new(move |_| carried.get().filter(CarriedItem::is_held));
    move || {
        shown.get().map(|carried| {
            let at = format!("translate({:.0}px,{:.0}px)", carried.at.0 + BESIDE.0, carried.at.1 + BESIDE.1);
            let (class, icon, name) = looks(&carried.item);
            let fits = carried.fits || carried.over.is_some();
            let said = stage.says(&carried);
            view! {
                <div class="carried" class:fits=fits style:transform=at aria-hidden="true">
                    <span class=class><Icon name=icon /></span>
                    <span class="carried-words"><b class="cut">{name}</b><span class="faint">{said}</span></span>
                </div>
            }
        })
    }
}

/// The sign and the name of an item, as in the list.
fn looks(item: &ListItem) -> (&'static str, &'static str, String) {
    match item {
        ListItem::Sense(device) => ("kind sensor", device.icon, words::device(device).to_owned()),
        ListItem::Action(device) => ("kind actuator", device.icon, words::device(device).to_owned()),
        ListItem::Helper(helper) => ("kind plain", "fx", words::helper_name_of(helper)),
    }
}

/// Everything that is heard while something hangs on a pointer.
fn hear(stage: &Stage) -> Vec<ListenerHandle> {
    let on = |event: &str, act: fn(&Stage, &Event)| {
        let stage = stage.clone();
        browser::hear_first(event, move |event| act(&stage, &event))
    };
    vec![
        on("pointermove", |stage, event| with_pointer(event, |event| stage.carry_on(event))),
        on("pointerup", |stage, event| with_pointer(event, |event| stage.let_go(event, true))),
        on("pointercancel", |stage, event| with_pointer(event, |event| stage.let_go(event, false))),
        on("keydown", |stage, event| {
            let put_down = || {
                let carries = stage.carries();
                if carries {
                    stage.put_down();
                }
                carries
            };
            if event.dyn_ref::<KeyboardEvent>().is_some_and(|event| escape::may_end(event, put_down)) {
                swallow(event);
            }
        }),
        on("contextmenu", |stage, event| {
            if stage.carries() {
                swallow(event)
            }
        }),
        on("click", |stage, event| {
            if stage.phase().is_some_and(|phase| phase != CarryStage::Pressed) {
                swallow(event)
            }
        }),
    ]
}

fn with_pointer(event: &Event, act: impl FnOnce(&PointerEvent)) {
    if let Some(event) = event.dyn_ref::<PointerEvent>() {
        act(event);
    }
}

fn swallow(event: &Event) {
    event.prevent_default();
    event.stop_propagation();
}

fn point(event: &PointerEvent) -> (f64, f64) {
    (f64::from(event.client_x()), f64::from(event.client_y()))
}

impl Stage {
    fn phase(&self) -> Option<CarryStage> {
        self.desk.carried.with_untracked(|carried| carried.as_ref().map(|carried| carried.phase))
    }

    fn carries(&self) -> bool {
        self.phase() == Some(CarryStage::Carried)
    }

    /// Returns the press as it is, to know it again.
    fn pressed_at(&self) -> Option<CarriedItem> {
        self.desk.carried.get_untracked()
    }

    /// A finger rested on what it pressed.
    fn rest(&self, pressed: Option<CarriedItem>) {
        if self.desk.carried.get_untracked() != pressed {
            return;
        }
        let targets = self.carry_targets();
        self.desk.carried.update(|carried| {
            if let Some(carried) = carried.as_mut().filter(|carried| carried.phase == CarryStage::Pressed)
                && carried.rested()
            {
                carried.targets = targets;
            }
        });
    }

    fn carry_on(&self, event: &PointerEvent) {
        let Some(mut carried) = self.desk.carried.get_untracked() else { return };
        if carried.pointer != event.pointer_id() || carried.phase == CarryStage::Ended {
            return;
        }
        if event.buttons() == 0 {
            // It was let go where nobody heard of it.
            self.desk.carried.set(None);
            return;
        }
        match carried.moved(point(event)) {
            Moved::Nothing => return,
            Moved::Scrolls => {
                self.desk.carried.set(None);
                return;
            }
            Moved::Begins => carried.targets = self.carry_targets(),
            Moved::Follows => {}
        }
        self.look_below(&mut carried);
        self.desk.carried.set(Some(carried));
    }

    /// The pointer went up, or the browser took it away.
    fn let_go(&self, event: &PointerEvent, drops: bool) {
        let Some(mut carried) = self.desk.carried.get_untracked() else { return };
        if carried.pointer != event.pointer_id() {
            return;
        }
        if carried.phase == CarryStage::Pressed {
            self.desk.carried.set(None);
            return;
        }
        if drops && carried.is_held() {
            carried.moved(point(event));
            self.look_below(&mut carried);
            self.put_there(&carried);
        }
        self.put_down();
        let held = self.desk.carried.clone();
        browser::after(CLICK_MS, move || {
            if held.with_untracked(|held| held.as_ref().is_some_and(|held| held.phase == CarryStage::Ended)) {
                held.set(None);
            }
        });
    }

    /// It goes back; what follows of this press counts for nothing.
    fn put_down(&self) {
        self.desk.carried.update(|carried| {
            if let Some(carried) = carried {
                (carried.phase, carried.targets, carried.over) = (CarryStage::Ended, None, None);
            }
        });
    }

    /// Finds what would become of it where the pointer is.
    fn look_below(&self, carried: &mut CarriedItem) {
        let (below, is_paper) = wire::under(carried.at.0 as f32, carried.at.1 as f32);
        carried.over = below.filter(|id| carried.targets.as_ref().is_some_and(|targets| targets.contains(id)));
        carried.fits = is_paper && !carried.item.is_led();
    }

    /// The streams that what is carried can be led from.
    fn carry_targets(&self) -> Option<Arc<BTreeSet<Id>>> {
        let item = self.desk.carried.with_untracked(|carried| carried.as_ref().map(|carried| carried.item.clone()))?;
        let takes = match &item {
            ListItem::Sense(_) => return None,
            ListItem::Action(_) => true,
            ListItem::Helper(helper) => takes_one(helper),
        };
        let behaviour = self.desk.document.behaviour();
        let gives = behaviour.streams().filter(|(_, stream)| takes && stream.kind != StreamKind::Actuator);
        Some(Arc::new(gives.map(|(id, _)| id.clone()).collect()))
    }

    fn put_there(&self, carried: &CarriedItem) {
        let desk = &self.desk;
        match (&carried.item, &carried.over) {
            (ListItem::Sense(device), _) if carried.fits => {
                let Some(at) = self.place_at(carried.at) else { return };
                desk.document.add_sensor_at(device, at);
            }
            (ListItem::Action(device), Some(stream)) => lead_to_action(desk, stream.clone(), device),
            (ListItem::Helper(helper), Some(stream)) => lead_to_helper(desk, stream, &helper.name, NewSpot::Below),
            (ListItem::Sense(_) | ListItem::Action(_) | ListItem::Helper(_), _) => {}
        }
    }

    /// The place of a stream whose middle is at a point of the window.
    fn place_at(&self, at: (f64, f64)) -> Option<Place> {
        let stage = document().get_element_by_id("stage")?.get_bounding_client_rect();
        let place = self.view.get_untracked().to_canvas((at.0 - stage.left(), at.1 - stage.top()));
        Some(Place { x: place.x, y: place.y - STREAM_HEIGHT / 2.0 })
    }

    /// Says what would come of a drop.
    fn says(&self, carried: &CarriedItem) -> String {
        if let Some(id) = &carried.over {
            let record = self.desk.document.stream(id).map(|signals| signals.record);
            return record.map(|record| words::carried_after(&record.read_untracked().name)).unwrap_or_default();
        }
        match &carried.item {
            ListItem::Sense(_) if carried.fits => words::carried_here().to_owned(),
            ListItem::Sense(_) => words::carried_to_ground().to_owned(),
            ListItem::Helper(helper) if !takes_one(helper) => words::carried_takes_more(helper.params.len()),
            ListItem::Action(_) | ListItem::Helper(_) => {
                let none = carried.targets.as_ref().is_none_or(|targets| targets.is_empty());
                if none { words::carried_no_stream().to_owned() } else { words::carried_to_stream().to_owned() }
            }
        }
    }
}
