//! One stream: its shape, its name, what happens on it now.

use super::Stage;
use super::differs::{Differs, differs_memo};
use super::mark::{self, MarkBadge, mark_memo};
use super::stage::Edited;
use crate::desk::{Desk, OpenPast, Selected, StreamSignals, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{stream_width, what_it_is};
use crate::live::{LiveStream, measured, rate_words, sparkline};
use crate::parts::kind_class;
use behaviour::{Id, Kind, Place, Problem, ProblemKind, RecordId, Stream, StreamKind, ValueType};
use leptos::prelude::*;

/// The box of a sparkline, in pixels.
const SPARK: (f64, f64) = (60.0, 16.0);
/// With less room than this there is no value, in pixels.
const ROOM_MIN: f64 = 24.0;

/// A stream at its place.
#[component]
pub(super) fn StreamNode(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(signals) = desk.document.stream(&id) else { return ().into_any() };
    let StreamSignals { record, place, .. } = signals.clone();
    let chosen = {
        let (desk, id) = (desk.clone(), id.clone());
        ArcMemo::new(move |_| desk.document.is_chosen(&Selected::Stream(id.clone())))
    };
    let is_stop = {
        let (stop, id) = (stage.stop_now.clone(), id.clone());
        move || stop.with(|stop| stop.as_ref() == Some(&id))
    };
    let is_dragged = {
        let (stage, id) = (stage.clone(), id.clone());
        move || stage.dragged.with(|dragged| dragged.as_ref() == Some(&id))
    };
    let [at_kind, by_kind, by_width, by_label, by_title, by_name, by_second, by_icon, by_place] =
        [(); 9].map(|()| record.clone());
    let (lit, pressed) = (chosen.clone(), chosen);
    let [moved, left, top] = at_place(&stage, &id, place, by_place);
    let problem = problem_memo(&stage, RecordId::new(Kind::Stream, &id));
    let troubles = problem.clone();
    let mark = mark_memo(&desk, RecordId::new(Kind::Stream, &id));
    let marked = mark.clone();
    let unused = unused_memo(&desk, &id);
    let ring = unused.clone();
    let describes = move || {
        let marked = marked.get().map(|mark| mark::said(mark).to_owned());
        let waits = unused.get().then(|| words::not_used_yet().to_owned());
        let trouble = troubles.get().map(|(sentence, _)| sentence);
        let all: Vec<_> = trouble.into_iter().chain(waits).chain(marked).collect();
        (!all.is_empty()).then(|| all.join(" "))
    };
    let editor = editor_memo(&stage, &id);
    let target = stage.wire_target(&id);
    let over = target.clone();
    let source = stage.wire_source(&id);
    let differs = differs_memo(&desk, &RecordId::new(Kind::Stream, &id));
    let differing = differs.clone();
    view! {
        <div
            class=move || format!("at {}", kind_class(at_kind.with(|stream| stream.kind)))
            class:dragged=is_dragged
            style:transform=moved style:left=left style:top=top
        >
        <div
            class=move || format!("stream {}", kind_class(by_kind.with(|stream| stream.kind)))
            class:selected=move || lit.get()
            class:target=move || target.get().is_some()
            class:over=move || over.get() == Some(true)
            class:source=move || source.get()
            data-node=id.to_string()
            role="button"
            tabindex=move || if is_stop() { "0" } else { "-1" }
            aria-label=move || {
                let editor = editor.get();
                let name = by_label.with(|stream| words::stream_name(&stream.name, &what_it_is(stream), stream.kind));
                let name = words::with_editor(name, editor.as_deref());
                words::with_mark(name, differing.get().map(|it| it.text).as_deref())
            }
            aria-pressed=move || pressed.get().to_string()
            title=move || by_title.with(whole_title)
            aria-description=describes
            style:min-width=move || format!("{:.0}px", by_width.with(stream_width))
        >
            {move || by_icon.with(device_icon).map(|icon| view! { <span class="icon"><Icon name=icon /></span> })}
            <span class="texts">
                <span class="name">{move || by_name.with(|stream| stream.name.clone())}</span>
                " "
                <span class="second" aria-hidden="true">{move || by_second.with(what_it_is)}</span>
            </span>
            {move || ring.get().then(|| view! { <span class="unused" title=words::not_used_yet()></span> })}
        </div>
            <ProblemBadge problem=problem at=Selected::Stream(id.clone()) />
            <Differs differs=differs />
            <MarkBadge mark=mark />
            <OthersRing id=id.clone() />
            <LiveValue id=id.clone() signals=signals />
        </div>
    }
    .into_any()
}

/// The `transform`, `left` and `top` of a stream: its middle stands at its place. From far away, where thousands are in view
/// and each is as wide as it says, those that rest have no transform: ordering thousands of them is most of the work of a drag.
fn at_place(
    stage: &Stage,
    id: &Id,
    place: ArcRwSignal<Place>,
    record: ArcRwSignal<Stream>,
) -> [impl Fn() -> Option<String> + Clone + Send + Sync + use<>; 3] {
    let (is_tiny, moving, id) = (stage.is_tiny.clone(), stage.moving.clone(), id.clone());
    let width = move || {
        let rests = is_tiny.get() && moving.with(|moving| !moving.contains(&id));
        rests.then(|| record.with(stream_width))
    };
    let one = move |of: fn(Place, Option<f64>) -> Option<String>| {
        let (place, width) = (place.clone(), width.clone());
        move || of(place.get(), width())
    };
    [
        one(|at, wide| wide.is_none().then(|| format!("translate({:.1}px,{:.1}px) translateX(-50%)", at.x, at.y))),
        one(|at, wide| wide.map(|wide| format!("{:.1}px", at.x - wide / 2.0))),
        one(|at, wide| wide.map(|_| format!("{:.1}px", at.y))),
    ]
}

fn device_icon(stream: &Stream) -> Option<&'static str> {
    let device = robot::device(stream.kind, stream.device.as_deref()?).ok();
    Some(device.map_or("warn", |device| device.icon))
}

fn whole_title(stream: &Stream) -> String {
    let second = what_it_is(stream);
    if second.is_empty() { stream.name.clone() } else { format!("{} – {second}", stream.name) }
}

/// The last value, the rate and a sparkline, or for how long it has been quiet; after Stop and while the server is silent
/// only what it was last, and faint. Where there is little room the sparkline goes first, then the rate, then the end of the value.
#[component]
fn LiveValue(id: Id, signals: StreamSignals) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let (live, quiet) = (signals.live.clone(), signals.live.clone());
    let known = {
        let live = signals.live.clone();
        ArcMemo::new(move |_| live.with(|live| live.value.is_some()))
    };
    let running = stage.running.clone();
    let kind = {
        let (desk, id, record) = (desk.clone(), id.clone(), signals.record.clone());
        ArcMemo::new(move |_| {
            let of = |id: &Id| desk.document.types.with(|types| types.get(id).cloned());
            let acts = || record.with(|stream| stream.kind == StreamKind::Actuator);
            of(&id).or_else(|| of(&told_by(&desk, &id).filter(|_| acts())?))
        })
    };
    let own = kind.clone();
    let cold = ArcMemo::new(move |_| {
        let value = || {
            quiet
                .with(|live| live.value.as_ref().map(|value| own.with(|kind| measured(value, kind.as_ref()))))
                .unwrap_or_default()
        };
        if let Some(earlier) = quiet.with(LiveStream::earlier) {
            return earlier.map(|seconds| words::value_earlier(&value(), seconds));
        }
        match (running.get(), desk.unheard.get()) {
            (false, _) => Some(words::last_was(&value())),
            (true, Some(seconds)) => Some(words::value_ago(&value(), seconds)),
            (true, None) => {
                let now = desk.robots.clock.get();
                quiet.with(|live| live.quiet_for(now)).map(|seconds| words::quiet_for(u64::from(seconds)))
            }
        }
    });
    let room = stage.room(&id);
    move || {
        if !known.get() || room.get() < ROOM_MIN {
            return ().into_any();
        }
        let width = format!("{:.0}px", room.get());
        match cold.get() {
            Some(words) => {
                view! { <span class="value quiet" aria-hidden="true" style:max-width=width><b title=words.clone()>{words.clone()}</b></span> }
                    .into_any()
            }
            None => view! { <NewestValue id=id.clone() live=live.clone() kind=kind.clone() width=width /> }.into_any(),
        }
    }
}

/// The stream whose values an action gets as they are, if it is one alone. Reactive.
fn told_by(desk: &Desk, action: &Id) -> Option<Id> {
    desk.document.revision.track();
    let ids = desk.document.connector_ids.get();
    let mut into = ids.iter().filter_map(|id| {
        let record = desk.document.connector(id)?.record;
        record.with_untracked(|one| (one.output == *action).then(|| (one.operation.spec().acts(), one.inputs.clone())))
    });
    match (into.next(), into.next()) {
        (Some((true, inputs)), None) => inputs.first().cloned(),
        _ => None,
    }
}

#[component]
fn NewestValue(
    id: Id,
    live: ArcRwSignal<LiveStream>,
    kind: ArcMemo<Option<ValueType>>,
    width: String,
) -> impl IntoView {
    let (value, rate, points) = (live.clone(), live.clone(), live);
    let past = use_desk().past.clone();
    let has_line = {
        let points = points.clone();
        ArcMemo::new(move |_| points.with(|live| live.recent.len() > 2))
    };
    view! {
        <span class="value" aria-hidden="true" style:max-width=width>
            <b>{move || value.with(|live| live.value.as_ref().map(|value| kind.with(|kind| measured(value, kind.as_ref()))).unwrap_or_default())}</b>
            <i>{move || rate.with(|live| rate_words(live.rate))}</i>
            {move || {
                let (points, past, id) = (points.clone(), past.clone(), id.clone());
                has_line.get().then(|| view! {
                    <svg class="spark" width=SPARK.0 height=SPARK.1 aria-hidden="true" focusable="false"
                        on:click=move |_| past.set(Some(OpenPast::Running(Some(id.clone()))))>
                        <polyline points=move || points.with(|live| sparkline(&live.recent, SPARK.0, SPARK.1)) />
                    </svg>
                })
            }}
        </span>
    }
}

/// Returns true while the robot does not use something yet as it is now.
pub(super) fn unused_memo(desk: &Desk, id: &Id) -> ArcMemo<bool> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| desk.robots.unused.with(|unused| unused.contains(&id)) && !desk.is_then())
}

/// The first problem of something as a sentence, and whether it keeps the behaviour from running. What leads nowhere
/// yet is only in the list while something is built: it would blame everything.
pub(super) fn problem_memo(stage: &Stage, at: RecordId) -> ArcMemo<Option<(String, bool)>> {
    let (desk, finished, running) = (stage.desk.clone(), stage.finished.clone(), stage.running.clone());
    ArcMemo::new(move |_| {
        let is_shown = |problem: &Problem| {
            problem.kind != ProblemKind::Unused
                || (finished.get() && (running.get() || is_left_over(&desk, &problem.at.id)))
        };
        if desk.is_then() {
            return None;
        }
        desk.document.problems.with(|problems| {
            let first = problems.iter().find(|problem| problem.at == at && is_shown(problem))?;
            Some((words::told_by(first), first.blocks))
        })
    })
}

/// True if a way ends at this stream and nobody is working on it. Reactive.
fn is_left_over(desk: &Desk, id: &Id) -> bool {
    let goes_on = |connector: &Id| {
        let signals = desk.document.connector(connector);
        signals.is_some_and(|signals| signals.record.with(|connector| connector.inputs.contains(id)))
    };
    let is_selected = desk.document.selected.with(|selected| selected.as_ref().map(Selected::id) == Some(id));
    !is_selected && !desk.document.connector_ids.with(|ids| ids.iter().any(goes_on))
}

/// A sign on what has a problem, with the problem as its title; what has it says it too.
#[component]
pub(super) fn ProblemBadge(
    problem: ArcMemo<Option<(String, bool)>>,
    #[prop(optional, into)]
    /// The thing that a press on it tells about; none for the badge of a folded group.
    at: Option<Selected>,
) -> impl IntoView {
    let stage = expect_context::<Stage>();
    move || {
        let (stage, at, is_pressed) = (stage.clone(), at.clone(), at.is_some());
        // A press is no press on the ground below, which would choose nothing.
        let press = move |event: web_sys::MouseEvent| {
            let Some(at) = &at else { return };
            event.stop_propagation();
            stage.asked_about.set(Some(at.id().clone()));
            stage.desk.document.choose([at.clone()].into());
        };
        problem.get().map(|(sentence, blocks)| {
            view! {
                <span class="badge" class:blocks=blocks class:pressed=is_pressed title=sentence aria-hidden="true"
                    on:pointerdown=move |event| if is_pressed { event.stop_propagation() } on:click=press.clone()>
                    <Icon name="warn" />
                </span>
            }
        })
    }
}

/// The name of who else is editing this. Reactive.
pub(super) fn editor_memo(stage: &Stage, id: &Id) -> ArcMemo<Option<String>> {
    let (edited, id) = (stage.edited.clone(), id.clone());
    ArcMemo::new(move |_| edited.with(|edited| edited.get(&id).filter(|at| at.is_it).map(|at| at.editor.name.clone())))
}

/// The colour of a ring, and what its tag says, with a padlock if somebody is editing.
pub(super) type Ringed = Option<(u8, Option<(bool, String)>)>;

/// Returns who else is editing one of these, what leads to it, or has selected it. Reactive.
pub(super) fn ringed(stage: &Stage, these: &[Id]) -> Ringed {
    let edited = stage.edited.with(|edited| {
        let of = || these.iter().filter_map(|id| edited.get(id));
        of().find(|edited| edited.is_it).or_else(|| of().next()).cloned()
    });
    if let Some(Edited { editor, is_it }) = edited {
        return Some((editor.color, is_it.then(|| (true, words::is_editing(&editor.name)))));
    }
    stage.others.with(|others| {
        let here = || others.iter().filter(|(selected, ..)| these.contains(selected));
        let color = here().map(|(_, color, _)| *color).next()?;
        let names: Vec<&str> = here().map(|(.., name)| name.as_str()).collect();
        Some((color, Some((false, words::listed(names)))))
    })
}

/// A ring in the colour of somebody else who is editing this, what leads to it, or has selected it.
#[component]
pub(super) fn OthersRing(id: Id) -> impl IntoView {
    let stage = expect_context::<Stage>();
    let ring = ArcMemo::new(move |_| ringed(&stage, std::slice::from_ref(&id)));
    view! { <Ring ring /> }
}

/// The ring itself.
#[component]
pub(super) fn Ring(ring: ArcMemo<Ringed>) -> impl IntoView {
    let tag = |(locked, text): (bool, String)| {
        view! { <span class="tag">{locked.then(|| view! { <Icon name="lock" /> })}<span class="cut">{text}</span></span> }
    };
    move || {
        ring.get().map(|(color, text)| {
            view! {
                <span class="ring" aria-hidden="true" style=("--person", format!("var(--people-{})", color % 8))>
                    {text.map(tag)}
                </span>
            }
        })
    }
}
