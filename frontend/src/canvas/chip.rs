//! One connector: its chip, and its edges behind everything.

use super::Stage;
use super::curve::{chip_place, curves};
use super::differs::{Differs, differs_memo};
use super::mark::{self, MarkBadge, mark_memo};
use super::node::{OthersRing, ProblemBadge, editor_memo, problem_memo};
use super::room::Side;
use crate::desk::{ConnectorSignals, Desk, Selected, use_desk};
use crate::icons::Icon;
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
    let output = desk.document.stream(&connector.output)?;
    let kind = output.record.with(|stream| stream.kind);
    let inputs: Vec<Place> =
        connector.inputs.iter().filter_map(|id| Some(desk.document.stream(id)?.place.get())).collect();
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
        desk.document.selected.with(|selected| matches!(selected, Some(Selected::Connector(chosen)) if *chosen == id))
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
    let Some(signals) = desk.document.connector(&id) else { return ().into_any() };
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
    let Some(signals) = desk.document.connector(&id) else { return ().into_any() };
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
    let unused = {
        let (desk, id) = (desk.clone(), id.clone());
        ArcMemo::new(move |_| desk.robots.unused.with(|unused| unused.contains(&id)))
    };
    let ring = unused.clone();
    let editor = editor_memo(&stage, &id);
    let differs = differs_memo(&desk, &RecordId::new(Kind::Connector, &id));
    let differing = differs.clone();
    let locked = editor.clone();
    let mark = mark_memo(&desk, RecordId::new(Kind::Connector, &id));
    let marked = mark.clone();
    let said = said_memo(&desk, &id, &signals, &unused);
    let tells = said.clone();
    let describes = move || {
        // Read first: `tells` follows it too, and a change that it finds on the way would go unnoticed here.
        let waits = unused.get();
        let mut all: Vec<String> = troubles.get().map(|(sentence, _)| sentence).into_iter().collect();
        all.extend(tells.get().map(|said| said.text));
        all.extend(waits.then(|| words::not_used_yet().to_owned()));
        all.extend(marked.get().map(|mark| mark::said(mark).to_owned()));
        (!all.is_empty()).then(|| all.join(" "))
    };
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
            aria-label=move || {
                let editor = editor.get();
                let name = label.with(|words| ends.with(|(from, to)| words::connector_name(&words.whole(), from, to)));
                let name = words::with_editor(name, editor.as_deref());
                words::with_mark(name, differing.get().map(|it| it.text).as_deref())
            }
            aria-pressed=move || pressed.get().to_string()
            title=move || title.with(ChipWords::whole)
            aria-description=describes
            style:min-width=move || format!("{:.0}px", wide.with(chip_width))
        >
            {move || {
                let is_locked = locked.get().is_some();
                let icon = if is_locked { "lock" } else { record.with(|connector| connector.operation.spec().icon.name) };
                view! { <span class="icon"><Icon name=icon /></span> }
            }}
            <span class="word">{move || word.with(|words| words.word.clone())}</span>
            <span class="detail" aria-hidden="true">{move || detail.with(|words| words.detail.clone())}</span>
            {move || ring.get().then(|| view! { <span class="unused" title=words::not_used_yet()></span> })}
        </div>
            <ProblemBadge problem=problem />
            <Differs differs=differs />
            <MarkBadge mark=mark />
            <OthersRing id=id.clone() />
            <Bubble id=id said=said />
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
        let name = |id: &Id| desk.document.stream(id).map(|stream| stream.record.with(|stream| stream.name.clone()));
        record.with(|connector| {
            (connector.inputs.iter().filter_map(name).collect(), name(&connector.output).unwrap_or_default())
        })
    })
}

/// Tab reaches the chips at the selected stream, and the selected chip itself.
fn near_selection(desk: &Desk, signals: &ConnectorSignals) -> impl Fn() -> bool + Send + Sync + use<> {
    let (selected, record) = (desk.document.selected.clone(), signals.record.clone());
    move || {
        let Some(selected) = selected.get() else { return false };
        record.with(|connector| match &selected {
            Selected::Stream(id) => connector.output == *id || connector.inputs.contains(id),
            Selected::Connector(_) => false,
        }) || matches!(&selected, Selected::Connector(_))
    }
}

/// What a chip says about the run.
#[derive(Clone, Debug, PartialEq)]
struct Said {
    text: String,
    /// How often its procedure failed; none if it only says who holds the robot's part.
    faults: Option<u64>,
}

/// How often its procedure failed and why, or who keeps the robot's part from the action that it leads to. What is not
/// used yet says nothing: the robot runs another version of it.
fn said_memo(desk: &Desk, id: &Id, signals: &ConnectorSignals, unused: &ArcMemo<bool>) -> ArcMemo<Option<Said>> {
    let (desk, id, record, unused) = (desk.clone(), id.clone(), signals.record.clone(), unused.clone());
    ArcMemo::new(move |_| {
        if unused.get() || desk.robots.running().is_none() {
            return None;
        }
        let failed = desk.robots.failing.with(|failing| {
            let failing = failing.iter().find(|failing| failing.connector == id)?;
            Some(Said { text: words::failed(failing.count, &failing.why), faults: Some(failing.count) })
        });
        failed.or_else(|| {
            let output = record.with(|connector| connector.operation.spec().acts().then(|| connector.output.clone()));
            Some(Said { text: desk.robots.held(&output?)?, faults: None })
        })
    })
}

/// A badge with the count, and beside it the sentence where there is room: of the newest that fails, and of what is selected.
#[component]
fn Bubble(id: Id, said: ArcMemo<Option<Said>>) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let chosen = chosen_memo(&desk, &id);
    let newest = {
        let id = id.clone();
        ArcMemo::new(move |_| {
            desk.robots.failing.with(|failing| failing.first().is_some_and(|first| first.connector == id))
        })
    };
    let room = stage.side_of_chip(&id);
    let badge = said.clone();
    let sentence = move |said: Said| {
        let is_open = said.faults.is_none() || chosen.get() || newest.get();
        let (side, width) = room.get().filter(|_| is_open)?;
        let held = said.faults.is_none();
        Some(view! {
            <span class="fault" class:held=held class:left=side == Side::Left aria-hidden="true" title=said.text.clone()
                style:max-width=format!("{width:.0}px")>
                <span>{said.text.clone()}</span>
            </span>
        })
    };
    view! {
        {move || {
            let said = badge.get()?;
            let faults = said.faults?;
            Some(view! {
                <span class="badge fails" title=said.text aria-hidden="true"><Icon name="warn" />{words::count(faults)}</span>
            })
        }}
        {move || said.get().and_then(&sentence)}
    }
}

/// Where the chip of a connector is. Reactive.
pub(super) fn chip_of(desk: &Desk, connector: &Connector) -> Option<Place> {
    way(desk, connector).map(|way| way.chip)
}
