//! One connector: its chip, and its edges behind everything.

use super::Stage;
use super::curve::{asides, chip_place, curves, straight, straight_ways, ways};
use super::differs::{Differs, differs_memo};
use super::fold::{ConnectorEnd, end_of, inputs_outside};
use super::mark::{self, MarkBadge, mark_memo};
use super::node::{OthersRing, ProblemBadge, editor_memo, problem_memo, unused_memo};
use super::room::ChipSide;
use crate::desk::{ConnectorSignals, Desk, Selected, use_desk};
use crate::fields::pieces;
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{ChipWords, chip_width, chip_words, with_units};
use behaviour::{Connector, Id, Kind, Place, ProblemKind, RecordId};
use leptos::prelude::*;

/// The way of a connector on the canvas.
#[derive(Clone, Debug, PartialEq)]
struct ChipWay {
    inputs: Vec<Place>,
    /// None where it leads into a folded group: its chip is in there.
    chip: Option<Place>,
    output: Place,
}

impl ChipWay {
    /// Returns it as a path, with a small head at its end or without.
    fn path(&self, head: bool) -> String {
        match (self.chip, head) {
            (Some(chip), true) => curves(&self.inputs, chip, self.output),
            (Some(chip), false) => ways(&self.inputs, chip, self.output),
            (None, true) => straight(&self.inputs, self.output),
            (None, false) => straight_ways(&self.inputs, self.output),
        }
    }
}

/// Returns the way of a connector now, as a path without a head.
pub(super) fn way_of(desk: &Desk, id: &Id) -> Option<String> {
    let record = desk.document.connector(id)?.record.get_untracked();
    untrack(|| way(desk, &record)).map(|way| way.path(false))
}

/// Reactive: follows the connector and the places of its streams.
fn way(desk: &Desk, connector: &Connector) -> Option<ChipWay> {
    let kind = desk.document.stream(&connector.output)?.record.with(|stream| stream.kind);
    let outside = inputs_outside(desk, connector);
    let inputs: Vec<Place> = outside.into_iter().filter_map(|id| end_of(desk, id, ConnectorEnd::Input)).collect();
    let output = end_of(desk, &connector.output, ConnectorEnd::Output)?;
    let is_seen = desk.document.hidden_in(&connector.output).is_none();
    let chip = is_seen.then(|| chip_place(&inputs, output, kind, aside(desk, connector)));
    Some(ChipWay { chip, inputs, output })
}

/// Returns how far the chip stands aside of the action that it leads to with others. Reactive.
fn aside(desk: &Desk, connector: &Connector) -> Option<f64> {
    let others = desk.document.shared.with(|shared| shared.get(&connector.output).cloned())?;
    let all = others.iter().filter_map(|id| Some(desk.document.connector(id)?.record.get()));
    let all: Vec<Connector> = all.collect();
    let x = |id: &Id| Some(end_of(desk, id, ConnectorEnd::Input)?.x);
    let from = |one: &Connector| one.inputs.iter().filter_map(x).sum::<f64>() / f64::max(one.inputs.len() as f64, 1.0);
    let chips: Vec<(f64, f64)> = all.iter().map(|one| (from(one), chip_width(&chip_words(one)))).collect();
    let mine = all.iter().position(|one| one == connector)?;
    asides(&chips).get(mine).copied()
}

fn way_memo(desk: &Desk, signals: &ConnectorSignals) -> ArcMemo<Option<ChipWay>> {
    let (desk, record) = (desk.clone(), signals.record.clone());
    ArcMemo::new(move |_| record.with(|connector| way(&desk, connector)))
}

fn chosen_memo(desk: &Desk, id: &Id) -> ArcMemo<bool> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| desk.document.is_chosen(&Selected::Connector(id.clone())))
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
    let path = move || way.with(|way| way.as_ref().map(|way| way.path(true)));
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
    let shown = shown_memo(&desk, &signals, &text);
    let at = move || way.with(|way| way.as_ref().and_then(|way| way.chip).map_or_else(String::new, placed));
    let problem = problem_memo(&stage, RecordId::new(Kind::Connector, &id));
    let troubles = problem.clone();
    let unknown = unknown_memo(&desk, &id);
    let ends = ends_memo(&desk, &signals);
    let reached = near_selection(&desk, &signals);
    let unused = unused_memo(&desk, &id);
    let ring = unused.clone();
    let editor = editor_memo(&stage, &id);
    let target = stage.wire_target(&id);
    let over = target.clone();
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
    let [wide, label, title, word, plain] = [(); 5].map(|()| text.clone());
    let (pressed, picked, record) = (chosen.clone(), chosen, signals.record.clone());
    let tests = record.clone();
    view! {
        <div class="at of-chip" style:transform=at>
        <div
            class="chip connector"
            class:fired=move || lit.get()
            class:selected=move || picked.get()
            class:target=move || target.get().is_some()
            class:over=move || over.get() == Some(true)
            data-chip=id.to_string()
            data-tests=move || tests.with(|connector| connector.operation.spec().is_test()).then_some("")
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
            <span class="detail" class:plain=move || plain.with(|words| words.plain) aria-hidden="true">{move || underlined(&shown.get(), unknown.get().as_deref())}</span>
            {move || ring.get().then(|| view! { <span class="unused" title=words::not_used_yet()></span> })}
        </div>
            <ProblemBadge problem=problem at=Selected::Connector(id.clone()) />
            <Differs differs=differs />
            <MarkBadge mark=mark />
            <OthersRing id=id.clone() />
            <Bubble id=id said=said />
        </div>
    }
    .into_any()
}

/// Returns a chip's words about its procedure, with the units of the numbers that something is compared with.
fn shown_memo(desk: &Desk, signals: &ConnectorSignals, text: &ArcMemo<ChipWords>) -> ArcMemo<String> {
    let (desk, record, text) = (desk.clone(), signals.record.clone(), text.clone());
    ArcMemo::new(move |_| {
        let (detail, compares) = text.with(|words| (words.detail.clone(), words.compares));
        let input = record.with(|connector| match connector.inputs.as_slice() {
            [one] if compares => Some(one.clone()),
            _ => None,
        });
        let Some(input) = input else { return detail };
        let unit = |subject: &str| {
            let path: Vec<&str> = subject.split('.').skip(1).collect();
            desk.document.measure(&input, &path).0
        };
        with_units(&detail, unit)
    })
}

/// A name in its procedure that means nothing.
fn unknown_memo(desk: &Desk, id: &Id) -> ArcMemo<Option<String>> {
    let (problems, at) = (desk.document.problems.clone(), RecordId::new(Kind::Connector, id));
    ArcMemo::new(move |_| {
        problems.with(|problems| {
            problems.iter().filter(|problem| problem.at == at).find_map(|problem| match &problem.kind {
                ProblemKind::UnknownName { name, .. } => Some(name.clone()),
                _ => None,
            })
        })
    })
}

/// The words of a chip, a name that means nothing underlined.
fn underlined(detail: &str, unknown: Option<&str>) -> AnyView {
    if unknown.is_none() {
        return detail.to_owned().into_any();
    }
    let piece = |(class, text): (&'static str, String)| view! { <span class=class>{text}</span> };
    pieces(detail, &[], unknown).into_iter().map(piece).collect_view().into_any()
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
            Selected::Connector(_) | Selected::Note(_) | Selected::Group(_) => false,
        }) || matches!(&selected, Selected::Connector(_))
    }
}

/// The words of a chip about the run.
#[derive(Clone, Debug, PartialEq)]
struct RunWords {
    text: String,
    /// The number of times that its procedure failed; none if it only says who holds the robot's part.
    faults: Option<u64>,
}

/// Returns how often its procedure failed and why, or who keeps the robot's part from the action that it leads to. A
/// chip that is not used yet says nothing: the robot runs another version of it.
fn said_memo(desk: &Desk, id: &Id, signals: &ConnectorSignals, unused: &ArcMemo<bool>) -> ArcMemo<Option<RunWords>> {
    let (desk, id, record, unused) = (desk.clone(), id.clone(), signals.record.clone(), unused.clone());
    let live = signals.live.clone();
    ArcMemo::new(move |_| {
        if desk.is_then() {
            let (faults, why) = live.with(|live| (live.faults, live.error.clone()));
            return why.map(|why| RunWords { text: words::failed(faults, &why), faults: Some(faults) });
        }
        if unused.get() || desk.robots.running().is_none() {
            return None;
        }
        let failed = desk.robots.failing.with(|failing| {
            let failing = failing.iter().find(|failing| failing.connector == id)?;
            Some(RunWords { text: words::failed(failing.count, &failing.why), faults: Some(failing.count) })
        });
        failed.or_else(|| {
            let output = record.with(|connector| connector.operation.spec().acts().then(|| connector.output.clone()));
            Some(RunWords { text: desk.robots.held(&output?)?, faults: None })
        })
    })
}

/// A badge with the count, and beside it the sentence where there is room: of the newest that fails, and of what is selected.
#[component]
fn Bubble(id: Id, said: ArcMemo<Option<RunWords>>) -> impl IntoView {
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
    let sentence = move |said: RunWords| {
        let is_open = said.faults.is_none() || chosen.get() || newest.get();
        let (side, width) = room.get().filter(|_| is_open)?;
        let held = said.faults.is_none();
        Some(view! {
            <span class="fault" class:held=held class:left=side == ChipSide::Left aria-hidden="true" title=said.text.clone()
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

/// The edges of a connector as a path, without the head at their end. Reactive.
pub(super) fn path_of(desk: &Desk, connector: &Connector) -> Option<String> {
    way(desk, connector).map(|way| way.path(false))
}

/// Returns the place of a connector's chip, if it is seen. Reactive.
pub(super) fn chip_of(desk: &Desk, connector: &Connector) -> Option<Place> {
    way(desk, connector).and_then(|way| way.chip)
}
