//! The plus on an edge: a connector can be put in there. It stands above the chip: that half is never the shorter one.

use super::Stage;
use super::chip::chip_of;
use super::curve::distance_to_curve;
use super::fold::{ConnectorEnd, end_of};
use super::hand::StagePoint;
use super::offer::Offering;
use crate::desk::{Desk, Gap, Selected, use_desk};
use crate::focus;
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{CHIP_HEIGHT, STREAM_HEIGHT, chip_words};
use behaviour::{Id, Place};
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

/// The distance from an edge at which its plus appears, in pixels.
const NEAR: f64 = 12.0;
/// Half of its height, in canvas units.
const HALF: f64 = 12.0;

impl Stage {
    /// The edge that leads to a connector and passes near a point of the stage.
    pub(super) fn edge_at(&self, at: StagePoint) -> Option<Gap> {
        let view = self.view.get_untracked();
        // From afar nobody could hit it.
        if view.zoom < super::FAR {
            return None;
        }
        let place = view.to_canvas(at);
        let near = NEAR / view.zoom;
        let place_of = |id: &Id| untrack(|| end_of(&self.desk, id, ConnectorEnd::Input));
        let passes = |from: Place, chip: Place| {
            let start = (from.x, from.y + STREAM_HEIGHT);
            let inside = place.y >= start.1
                && place.y <= chip.y
                && place.x >= from.x.min(chip.x) - near
                && place.x <= from.x.max(chip.x) + near;
            inside && distance_to_curve((place.x, place.y), start, (chip.x, chip.y)) <= near
        };
        let passes_below = |chip: Place, output: Place| {
            let start = (chip.x, chip.y + CHIP_HEIGHT);
            place.y >= start.1 && distance_to_curve((place.x, place.y), start, (output.x, output.y)) <= near
        };
        let gap = |id: &Id| {
            self.desk.document.connector(id)?.record.with_untracked(|record| {
                // What ends above the pointer is passed over before anything is worked out.
                let output = place_of(&record.output)?;
                if output.y < place.y {
                    return None;
                }
                let chip = untrack(|| chip_of(&self.desk, record))?;
                let near = |input: &&Id| place_of(input).is_some_and(|from| passes(from, chip));
                let below = || record.inputs.first().filter(|_| passes_below(chip, output));
                let input = record.inputs.iter().find(near).or_else(below)?.clone();
                Some(Gap { connector: id.clone(), input })
            })
        };
        untrack(|| self.connectors()).iter().find_map(gap)
    }
}

/// The plus of the first edge out of a stream, while there is one.
pub(super) fn plus_below(id: &Id) -> Option<HtmlElement> {
    let found = document().query_selector(&format!(".plus[data-from='{id}']")).ok().flatten();
    found.and_then(|found| found.dyn_into().ok())
}

impl Stage {
    /// Gives a plus the keyboard; its chip comes into view.
    pub(super) fn focus_plus(&self, plus: &HtmlElement) {
        focus::focus_in_place(plus);
        if let Some(chip) = id_of(plus, "data-into") {
            self.reveal_chip(&chip);
        }
    }

    /// True if the edge of a plus ends at a folded group, to which the arrow keys go at once.
    pub(super) fn leads_into_fold(&self, plus: &HtmlElement) -> bool {
        let into = id_of(plus, "data-into").and_then(|into| self.desk.document.connector(&into));
        into.is_some_and(|signals| {
            let output = signals.record.with_untracked(|connector| connector.output.clone());
            untrack(|| self.desk.document.hidden_in(&output)).is_some()
        })
    }

    /// An arrow key on a plus: up to its stream, down to what its edge leads to, aside to the other edges of its stream.
    pub(super) fn plus_key(&self, plus: &Element, key: &str) -> bool {
        let (Some(from), Some(into)) = (id_of(plus, "data-from"), id_of(plus, "data-into")) else { return false };
        let next = match key {
            "ArrowUp" => Some(from),
            "ArrowDown" => self
                .desk
                .document
                .connector(&into)
                .map(|signals| signals.record.with_untracked(|connector| connector.output.clone())),
            "ArrowLeft" => return self.turn_plus(plus, &from, |at, count| (at + count - 1) % count),
            "ArrowRight" => return self.turn_plus(plus, &from, |at, count| (at + 1) % count),
            _ => return false,
        };
        if let Some(next) = next {
            self.desk.document.select(Some(Selected::Stream(next.clone())));
            self.focus(&next);
        }
        true
    }

    fn turn_plus(&self, plus: &Element, from: &Id, next: impl Fn(usize, usize) -> usize) -> bool {
        let Ok(all) = document().query_selector_all(&format!(".plus[data-from='{from}']")) else { return false };
        let all: Vec<HtmlElement> = (0..all.length()).filter_map(|at| all.item(at)?.dyn_into().ok()).collect();
        let at = all.iter().position(|one| one.unchecked_ref::<Element>() == plus);
        if let Some(plus) = at.and_then(|at| all.get(next(at, all.len()))) {
            self.focus_plus(plus);
        }
        true
    }
}

impl Stage {
    /// Offers what can stand before a connector, or before the first one that leads to a stream.
    pub(super) fn insert_before(&self, what: &Selected) -> bool {
        let document = &self.desk.document;
        let leads_to = |id: &Id, to: &Id| {
            document.connector(id).is_some_and(|signals| signals.record.with_untracked(|at| at.output == *to))
        };
        let connector = match what {
            Selected::Connector(id) => Some(id.clone()),
            Selected::Stream(to) => {
                document.connector_ids.with_untracked(|ids| ids.iter().find(|id| leads_to(id, to)).cloned())
            }
            Selected::Note(_) | Selected::Group(_) => None,
        };
        let gap = connector.and_then(|connector| {
            let input = document.connector(&connector)?.record.with_untracked(|at| at.inputs.first().cloned())?;
            Some(Gap { connector, input })
        });
        let may = untrack(|| self.desk.may(Role::Editor));
        let Some(gap) = gap.filter(|_| may) else { return false };
        if let Some(place) = untrack(|| plus_place(&self.desk, &gap)) {
            self.offer(Offering::into_gap(gap, place));
        }
        true
    }
}

fn id_of(plus: &Element, mark: &str) -> Option<Id> {
    Id::new(&plus.get_attribute(mark)?).ok()
}

/// The pluses on the edges that lead to a connector: while one is pointed at, and at what is selected or has the keyboard.
#[component]
pub(super) fn Pluses() -> impl IntoView {
    let stage = expect_context::<Stage>();
    let desk = use_desk();
    let (hovered, focused) = (stage.hovered_edge.clone(), stage.focused.clone());
    let shown = ArcMemo::new(move |_| {
        if !desk.may(Role::Editor) {
            return Vec::new();
        }
        desk.document.revision.track();
        let selected = desk.document.selected.get();
        let (hovered, focused) = (hovered.get(), focused.get());
        let near = |id: &Id| {
            let Some(signals) = desk.document.connector(id) else { return Vec::new() };
            let is_chosen = selected.as_ref() == Some(&Selected::Connector(id.clone()));
            let is_near = |input: &Id| {
                is_chosen
                    || focused.as_ref() == Some(input)
                    || selected.as_ref() == Some(&Selected::Stream(input.clone()))
            };
            let inputs = signals.record.with(|connector| connector.inputs.clone());
            let gap = |input| Gap { connector: id.clone(), input };
            inputs.into_iter().filter(is_near).map(gap).collect::<Vec<_>>()
        };
        let mut gaps: Vec<Gap> = desk.document.connector_ids.get().iter().flat_map(near).collect();
        if let Some(gap) = hovered.filter(|gap| !gaps.contains(gap)) {
            gaps.push(gap);
        }
        gaps
    });
    view! {
        <For each=move || shown.get() key=|gap| (gap.connector.clone(), gap.input.clone()) let:gap>
            <Plus gap />
        </For>
    }
}

/// Half way from a stream to a chip. Reactive.
fn plus_place(desk: &Desk, gap: &Gap) -> Option<Place> {
    let from = end_of(desk, &gap.input, ConnectorEnd::Input)?;
    let chip = desk.document.connector(&gap.connector)?.record.with(|connector| chip_of(desk, connector))?;
    Some(Place { x: (from.x + chip.x) / 2.0, y: (from.y + STREAM_HEIGHT + chip.y) / 2.0 })
}

#[component]
fn Plus(gap: Gap) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let (Some(connector), Some(input)) = (desk.document.connector(&gap.connector), desk.document.stream(&gap.input))
    else {
        return ().into_any();
    };
    let place = {
        let gap = gap.clone();
        ArcMemo::new(move |_| plus_place(&desk, &gap))
    };
    let label = {
        let (record, input) = (connector.record, input.record);
        move || words::insert_between(&input.with(|stream| stream.name.clone()), &record.with(chip_words).whole())
    };
    let at = place.clone();
    let style = move || {
        let place = at.get().unwrap_or(Place { x: 0.0, y: 0.0 });
        format!("translate({:.1}px,{:.1}px)", place.x - HALF, place.y - HALF)
    };
    let (hovered, mine) = (stage.hovered_edge.clone(), gap.clone());
    let is_hovered = move || hovered.with(|hovered| hovered.as_ref() == Some(&mine));
    let (from, into) = (gap.input.to_string(), gap.connector.to_string());
    let open = move |_| {
        if let Some(place) = place.get_untracked() {
            stage.offer(Offering::into_gap(gap.clone(), place));
        }
    };
    view! {
        <button type="button" class="plus" data-from=from data-into=into class:hovered=is_hovered style:transform=style aria-label=label.clone() title=words::insert_here()
            on:click=open>
            <Icon name="plus" />
        </button>
    }
    .into_any()
}
