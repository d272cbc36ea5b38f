//! One connector: its chip, and its edges behind everything.

use super::Stage;
use super::curve::{chip_place, curves};
use super::node::{OthersRing, ProblemBadge, problem_memo};
use crate::desk::{ConnectorSignals, Desk, Selected, use_desk};
use crate::icons::{Icon, connector_icon};
use crate::layout::{ChipWords, chip_width, chip_words};
use crate::words;
use behaviour::{Connector, Id, Kind, Place, RecordId};
use leptos::prelude::*;

/// Where a connector runs.
#[derive(Clone, Debug, PartialEq)]
struct Way {
    inputs: Vec<Place>,
    chip: Place,
    output: Place,
}

/// Reactive: follows the connector and the places of its streams.
fn way(desk: &Desk, connector: &Connector) -> Option<Way> {
    let output = desk.stream(&connector.output)?;
    let kind = output.record.with(|stream| stream.kind);
    let inputs: Vec<Place> = connector.inputs.iter().filter_map(|id| Some(desk.stream(id)?.place.get())).collect();
    let output = output.place.get();
    Some(Way { chip: chip_place(&inputs, output, kind), inputs, output })
}

fn way_memo(desk: &Desk, signals: &ConnectorSignals) -> ArcMemo<Option<Way>> {
    let (desk, record) = (desk.clone(), signals.record.clone());
    ArcMemo::new(move |_| record.with(|connector| way(&desk, connector)))
}

fn chosen_memo(desk: &Desk, id: &Id) -> ArcMemo<bool> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| {
        desk.selected.with(|selected| matches!(selected, Some(Selected::Connector(chosen)) if *chosen == id))
    })
}

fn lit_memo(stage: &Stage, signals: &ConnectorSignals) -> ArcMemo<bool> {
    let (running, live) = (stage.running.clone(), signals.live.clone());
    ArcMemo::new(move |_| live.with(|live| live.lit) && running.get())
}

/// The edges of a connector.
#[component]
pub(super) fn Edge(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.connector(&id) else { return ().into_any() };
    let way = way_memo(&desk, &signals);
    let lit = lit_memo(&stage, &signals);
    let chosen = chosen_memo(&desk, &id);
    let path = move || way.with(|way| way.as_ref().map(|way| curves(&way.inputs, way.chip, way.output)));
    view! {
        <path class="edge" class:fired=move || lit.get() class:selected=move || chosen.get() d=path />
    }
    .into_any()
}

/// The chip of a connector.
#[component]
pub(super) fn Chip(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.connector(&id) else { return ().into_any() };
    let way = way_memo(&desk, &signals);
    let lit = lit_memo(&stage, &signals);
    let chosen = chosen_memo(&desk, &id);
    let text = {
        let record = signals.record.clone();
        ArcMemo::new(move |_| record.with(chip_words))
    };
    let at = move || way.with(|way| way.as_ref().map_or_else(String::new, |way| placed(way.chip)));
    let problem = problem_memo(&desk, RecordId::new(Kind::Connector, &id));
    let troubles = problem.clone();
    let ends = ends_memo(&desk, &signals);
    let reached = near_selection(&desk, &signals);
    let [wide, label, title, word, detail] = [(); 5].map(|()| text.clone());
    let (pressed, picked, record) = (chosen.clone(), chosen, signals.record.clone());
    view! {
        <div class="at of-chip" style:transform=at>
        <div
            class="chip connector"
            class:fired=move || lit.get()
            class:selected=move || picked.get()
            data-chip=id.to_string()
            role="button"
            tabindex=move || if reached() { "0" } else { "-1" }
            aria-label=move || label.with(|words| ends.with(|(from, to)| words::connector_name(&words.whole(), from, to)))
            aria-pressed=move || pressed.get().to_string()
            title=move || title.with(ChipWords::whole)
            aria-description=move || troubles.get().map(|(sentence, _)| sentence)
            style:min-width=move || format!("{:.0}px", wide.with(chip_width))
        >
            {move || {
                let icon = connector_icon(record.with(|connector| connector.operation.word()));
                view! { <span class="icon"><Icon name=icon /></span> }
            }}
            <span class="word">{move || word.with(|words| words.word.clone())}</span>
            <span class="detail" aria-hidden="true">{move || detail.with(|words| words.detail.clone())}</span>
        </div>
            <ProblemBadge problem=problem />
            <OthersRing id=id.clone() />
            <Held signals=signals.clone() />
            <Fault signals=signals />
        </div>
    }
    .into_any()
}

fn placed(chip: Place) -> String {
    format!("translate({:.1}px,{:.1}px) translateX(-50%)", chip.x, chip.y)
}

/// The names of what it takes from and of what it leads to.
fn ends_memo(desk: &Desk, signals: &ConnectorSignals) -> ArcMemo<(Vec<String>, String)> {
    let (desk, record) = (desk.clone(), signals.record.clone());
    ArcMemo::new(move |_| {
        let name = |id: &Id| desk.stream(id).map(|stream| stream.record.with(|stream| stream.name.clone()));
        record.with(|connector| {
            (connector.inputs.iter().filter_map(name).collect(), name(&connector.output).unwrap_or_default())
        })
    })
}

/// Tab reaches the chips at the selected stream, and the selected chip itself.
fn near_selection(desk: &Desk, signals: &ConnectorSignals) -> impl Fn() -> bool + Send + Sync + use<> {
    let (selected, record) = (desk.selected.clone(), signals.record.clone());
    move || {
        let Some(selected) = selected.get() else { return false };
        record.with(|connector| match &selected {
            Selected::Stream(id) => connector.output == *id || connector.inputs.contains(id),
            Selected::Connector(_) => false,
        }) || matches!(&selected, Selected::Connector(_))
    }
}

/// Why its procedure failed last.
#[component]
fn Fault(signals: ConnectorSignals) -> impl IntoView {
    let stage = expect_context::<Stage>();
    let error = {
        let (live, running) = (signals.live.clone(), stage.running.clone());
        ArcMemo::new(move |_| live.with(|live| live.error.clone()).filter(|_| running.get()))
    };
    move || {
        error.get().map(|why| view! { <span class="fault" aria-hidden="true" title=why.clone()>{why.clone()}</span> })
    }
}

/// Who keeps the robot's part from the action that it leads to.
#[component]
fn Held(signals: ConnectorSignals) -> impl IntoView {
    let desk = use_desk();
    let leads = signals.record.with_untracked(|connector| connector.operation.word() == "subscribe");
    leads.then(|| {
        let held = ArcMemo::new(move |_| signals.record.with(|connector| desk.held(&connector.output)));
        move || {
            held.get()
                .map(|who| view! { <span class="fault held" aria-hidden="true" title=who.clone()>{who.clone()}</span> })
        }
    })
}

/// Where the chip of a connector is. Reactive.
pub(super) fn chip_of(desk: &Desk, connector: &Connector) -> Option<Place> {
    way(desk, connector).map(|way| way.chip)
}
