//! A wire: drawn from a stream to where its values shall go too, by hand or by keys.

use super::Stage;
use super::chip::chip_of;
use super::curve::curve_between;
use super::hand::StagePoint;
use super::offer::Offering;
use crate::desk::{CarriedItem, Desk, Joining, Selected, WireEnd, use_desk, wire_ends};
use crate::escape;
use crate::graph::words;
use crate::keys::PressedKey;
use crate::layout::{CHIP_HEIGHT, STREAM_HEIGHT, chip_words};
use behaviour::{FillFrom, Id, Place, StreamKind, sort_few};
use leptos::prelude::*;
use protocol::Role;
use std::collections::BTreeSet;
use std::sync::Arc;
use wasm_bindgen::JsCast;
use web_sys::{Element, FocusEvent, KeyboardEvent};

/// A wire that is being drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wire {
    pub(super) from: Id,
    /// The ends at which it may arrive, from top to bottom, and what comes of each.
    ends: Arc<[(WireEnd, Joining)]>,
    /// The ids of those.
    ids: Arc<BTreeSet<Id>>,
    /// The loose end of the wire, in canvas units.
    to: Place,
    /// The end at which it would arrive now.
    over: Option<WireEnd>,
    /// True if it hangs on a pointer that is down.
    pub(super) is_held: bool,
}

/// The part of a wire that streams and chips look at: while its loose end only moves, it stays the same.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WireTargets {
    /// The stream that the wire comes from; what is carried comes from no stream.
    from: Option<Id>,
    ids: Arc<BTreeSet<Id>>,
    over: Option<Id>,
}

/// Returns what streams and chips look at of the wire that is drawn, or of what is carried from the list.
pub(super) fn targets_memo(
    wire: ArcRwSignal<Option<Wire>>,
    carried: ArcRwSignal<Option<CarriedItem>>,
) -> ArcMemo<Option<WireTargets>> {
    ArcMemo::new(move |_| {
        let of_wire = wire.with(|wire| {
            let wire = wire.as_ref()?;
            let over = wire.over.as_ref().map(|end| end.id().clone());
            Some(WireTargets { from: Some(wire.from.clone()), ids: Arc::clone(&wire.ids), over })
        });
        of_wire.or_else(|| {
            carried.with(|carried| {
                let carried = carried.as_ref()?;
                let ids = Arc::clone(carried.targets.as_ref()?);
                Some(WireTargets { from: None, ids, over: carried.over.clone() })
            })
        })
    })
}

impl Stage {
    /// Begins a wire out of a stream.
    pub(super) fn begin_wire(&self, from: &Id, is_held: bool) {
        let desk = &self.desk;
        let Some(place) = desk.document.stream(from).map(|signals| signals.place.get_untracked()) else { return };
        if untrack(|| !desk.may(Role::Editor)) {
            return;
        }
        let mut ends = wire_ends(&desk.document.behaviour(), from);
        ends.retain(|(end, _)| untrack(|| desk.document.folded_away(&end.selected())).is_none());
        let at = |end: &WireEnd| end_place(desk, end).map_or((0.0, 0.0), |place| (place.y, place.x));
        // A place is looked up once an end, as there may be hundreds.
        let mut placed: Vec<_> = ends.into_iter().map(|end| (at(&end.0), end)).collect();
        sort_few(&mut placed, |(one, _), (other, _)| one < other);
        let ends: Vec<_> = placed.into_iter().map(|(_, end)| end).collect();
        let to = Place { x: place.x, y: place.y + STREAM_HEIGHT + 24.0 };
        self.offering.set(None);
        let ids = Arc::new(ends.iter().map(|(end, _)| end.id().clone()).filled());
        let (from, ends) = (from.clone(), ends.into());
        self.wire.set(Some(Wire { from, ends, ids, to, over: None, is_held }));
        if !is_held {
            self.say_wire(true);
        }
    }

    /// Moves the loose end of the wire after a pointer.
    pub(super) fn move_wire(&self, at: StagePoint, over: Option<&Id>) {
        if self.offering.with_untracked(Option::is_some) || self.wire.with_untracked(Option::is_none) {
            return;
        }
        let to = self.view.get_untracked().to_canvas(at);
        self.wire.update(|wire| {
            let Some(wire) = wire else { return };
            let end = wire.ends.iter().find(|(end, _)| Some(end.id()) == over).map(|(end, _)| end.clone());
            (wire.to, wire.over) = (to, end);
        });
    }

    /// It is let go: it ends where it hangs, offers what fits on free ground, and else goes back.
    pub(super) fn drop_wire(&self, on_paper: bool) {
        let Some(wire) = self.wire.get_untracked() else { return };
        match wire.over {
            Some(end) => self.end_wire(&wire.from, &end),
            None if on_paper => {
                self.wire.update(|wire| {
                    if let Some(wire) = wire {
                        wire.is_held = false;
                    }
                });
                self.offer(Offering::at(wire.from, wire.to));
            }
            None => self.forget_wire(),
        }
    }

    fn end_wire(&self, from: &Id, end: &WireEnd) {
        self.forget_wire();
        self.desk.document.wire(from, end);
    }

    /// There is no wire any more.
    pub(super) fn forget_wire(&self) {
        if self.wire.with_untracked(Option::is_some) {
            self.wire.set(None);
            self.said.set(String::new());
        }
        if self.offering.with_untracked(Option::is_some) {
            self.offering.set(None);
        }
    }

    /// Takes a tap while a wire is drawn: on an end it ends there, elsewhere it goes back. Returns true if there was a
    /// wire.
    pub(super) fn tap_wire(&self, on: Option<&Id>) -> bool {
        let Some(wire) = self.wire.get_untracked() else { return false };
        match wire.ends.iter().find(|(end, _)| Some(end.id()) == on) {
            Some((end, _)) => self.end_wire(&wire.from, end),
            None => self.forget_wire(),
        }
        true
    }

    /// True if the keyboard goes from the offer to the graph because a pointer is about to end the wire there.
    pub(super) fn may_end_wire(&self, event: &FocusEvent) -> bool {
        let next = event.related_target().and_then(|next| next.dyn_into::<Element>().ok());
        let on_graph = next.is_some_and(|next| next.closest("#stage").ok().flatten().is_some());
        on_graph && self.wire.with_untracked(Option::is_some)
    }

    /// A key while there is a wire: arrows go through its ends, Enter ends it, Escape takes it back, Tab offers more.
    pub(super) fn wire_key(&self, event: &KeyboardEvent) -> bool {
        let Some(wire) = self.wire.get_untracked() else { return false };
        let forget = || {
            self.forget_wire();
            self.focus(&wire.from);
        };
        if escape::ends(event, forget) {
            return true;
        }
        match event.pressed().as_str() {
            "ArrowDown" | "ArrowRight" => self.turn_wire(1),
            "ArrowUp" | "ArrowLeft" => self.turn_wire(wire.ends.len().saturating_sub(1)),
            "Enter" | " " => match wire.over {
                Some(end) => self.end_wire(&wire.from, &end),
                None => self.offer(Offering::at(wire.from, wire.to)),
            },
            "Tab" => self.offer(Offering::at(wire.from, wire.to)),
            _ => return false,
        }
        true
    }

    fn turn_wire(&self, by: usize) {
        let is_first = self.wire.with_untracked(|wire| wire.as_ref().is_none_or(|wire| wire.over.is_none()));
        self.wire.update(|wire| {
            let Some(wire) = wire else { return };
            if wire.ends.is_empty() {
                return;
            }
            let now = wire.ends.iter().position(|(end, _)| Some(end) == wire.over.as_ref());
            let next = now.map_or(if by == 1 { 0 } else { wire.ends.len() - 1 }, |now| (now + by) % wire.ends.len());
            let end = wire.ends[next].0.clone();
            if let Some(place) = end_place(&self.desk, &end) {
                wire.to = place;
            }
            wire.over = Some(end);
        });
        self.say_wire(is_first);
        let over = self.wire.with_untracked(|wire| wire.as_ref().and_then(|wire| wire.over.clone()));
        match over {
            Some(WireEnd::Stream(id)) => self.reveal(&id),
            Some(WireEnd::Connector(id)) => self.reveal_chip(&id),
            None => {}
        }
    }

    /// Says where the wire would end now and, at first, in how many places it may.
    fn say_wire(&self, is_first: bool) {
        let Some(wire) = self.wire.get_untracked() else { return };
        let name = stream_name(&self.desk, &wire.from);
        let at = wire.ends.iter().position(|(end, _)| Some(end) == wire.over.as_ref());
        let said = match at {
            Some(at) => {
                let (how, count) = (tip(&self.desk, &wire.ends[at]), wire.ends.len());
                if is_first { words::wire_first_at(&name, at, count, &how) } else { words::wire_at(at, count, &how) }
            }
            None if wire.ends.is_empty() => words::wire_nowhere(&name),
            None => words::wire_begins(&name, wire.ends.len()),
        };
        self.said.set(said);
    }

    /// Returns true while the wire comes out of a stream. Reactive.
    pub(super) fn wire_source(&self, id: &Id) -> ArcMemo<bool> {
        let (targets, id) = (self.targets.clone(), id.clone());
        ArcMemo::new(move |_| {
            targets.with(|targets| targets.as_ref().is_some_and(|targets| targets.from.as_ref() == Some(&id)))
        })
    }

    /// Tells if something may be the end of the wire, and if it would be now. Reactive.
    pub(super) fn wire_target(&self, id: &Id) -> ArcMemo<Option<bool>> {
        let (targets, id) = (self.targets.clone(), id.clone());
        ArcMemo::new(move |_| {
            targets.with(|targets| {
                let targets = targets.as_ref()?;
                targets.ids.contains(&id).then(|| targets.over.as_ref() == Some(&id))
            })
        })
    }
}

/// Returns the place where a wire arrives: the middle of the top edge.
fn end_place(desk: &Desk, end: &WireEnd) -> Option<Place> {
    match end {
        WireEnd::Stream(id) => Some(desk.document.stream(id)?.place.get_untracked()),
        WireEnd::Connector(id) => {
            let record = desk.document.connector(id)?.record.get_untracked();
            untrack(|| chip_of(desk, &record))
        }
    }
}

fn stream_name(desk: &Desk, id: &Id) -> String {
    desk.document
        .stream(id)
        .map(|signals| signals.record.with_untracked(|stream| stream.name.clone()))
        .unwrap_or_default()
}

/// Says what comes of it.
fn tip(desk: &Desk, (end, how): &(WireEnd, Joining)) -> String {
    let target = match end {
        WireEnd::Stream(id) => stream_name(desk, id),
        WireEnd::Connector(id) => {
            let words = desk.document.connector(id).map(|signals| signals.record.with_untracked(chip_words));
            words.map(|words| words.whole()).unwrap_or_default()
        }
    };
    words::joining(*how, &target)
}

/// The wire itself, over everything, and what would come of it.
#[component]
pub(super) fn WireLine() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let desk = use_desk();
    let wire = stage.wire.clone();
    let drawn = {
        let (wire, desk) = (wire.clone(), desk.clone());
        ArcMemo::new(move |_| {
            let wire = wire.get()?;
            let from = desk.document.stream(&wire.from)?.place.get();
            let over = wire.over.as_ref().and_then(|end| end_place(&desk, end));
            let to = over.unwrap_or(wire.to);
            let said = wire.ends.iter().find(|(end, _)| Some(end) == wire.over.as_ref()).map(|end| tip(&desk, end));
            Some((curve_between((from.x, from.y + STREAM_HEIGHT), (to.x, to.y)), to, said))
        })
    };
    move || {
        drawn.get().map(|(path, to, said)| {
            let at = format!("translate({:.1}px,{:.1}px)", to.x, to.y);
            let tip_at = format!("translate({:.1}px,{:.1}px)", to.x + 16.0, to.y + CHIP_HEIGHT + 14.0);
            view! {
                <svg class="edges wire" width="1" height="1" aria-hidden="true" focusable="false"><path d=path /></svg>
                <span class="wire-end" style:transform=at aria-hidden="true"></span>
                {said.map(|said| view! { <span class="wire-tip" style:transform=tip_at aria-hidden="true">{said}</span> })}
            }
        })
    }
}

/// Shows where wires begin: at the lower edge of the stream that is selected, pointed at, or has the keyboard.
#[component]
pub(super) fn Handles() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let desk = use_desk();
    // From afar a handle would lie over all of its stream.
    let view = stage.view.clone();
    let is_far = ArcMemo::new(move |_| view.with(|view| view.zoom < super::FAR));
    let handles = ArcMemo::new(move |_| {
        if !desk.may(Role::Editor) || is_far.get() || stage.dragged.with(Option::is_some) {
            return Vec::new();
        }
        desk.document.revision.track();
        let selected = match desk.document.selected.get() {
            Some(Selected::Stream(id)) => Some(id),
            Some(Selected::Connector(_) | Selected::Note(_) | Selected::Group(_)) | None => None,
        };
        let mut ids: Vec<Id> = Vec::new();
        for id in [selected, stage.hovered.get(), stage.focused.get()].into_iter().flatten() {
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
        let place = |id: Id| {
            let signals = desk.document.stream(&id)?;
            let gives = signals.record.with(|stream| stream.kind != StreamKind::Actuator);
            gives.then(|| (id, signals.place.get()))
        };
        ids.into_iter().filter_map(place).collect::<Vec<_>>()
    });
    move || {
        let handle = |(id, place): (Id, Place)| {
            let at = format!("translate({:.1}px,{:.1}px)", place.x, place.y + STREAM_HEIGHT);
            view! { <span class="handle" data-handle=id.to_string() title=words::connect_hint() aria-hidden="true" style:transform=at></span> }
        };
        handles.get().into_iter().map(handle).collect_view()
    }
}

/// Says to screen readers what there is to hear of a wire.
#[component]
pub(super) fn WireWords() -> impl IntoView {
    let said = expect_context::<Stage>().said;
    view! { <p class="sr" role="status">{move || said.get()}</p> }
}

/// Returns what lies under a point of the window that a wire could end at, and whether that is free ground.
pub(super) fn under(x: f32, y: f32) -> (Option<Id>, bool) {
    let Some(found) = document().element_from_point(x, y) else { return (None, false) };
    let marked = ["data-node", "data-chip"].into_iter().find_map(|mark| {
        let at = found.closest(&format!("[{mark}]")).ok().flatten()?;
        Id::new(&at.get_attribute(mark)?).ok()
    });
    let is_paper = marked.is_none()
        && found.closest("#stage").ok().flatten().is_some()
        && found.closest("button, .strip, .zoom, .menu, [data-note], [data-group]").ok().flatten().is_none();
    (marked, is_paper)
}
