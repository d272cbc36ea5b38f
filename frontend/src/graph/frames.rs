//! Groups on the canvas: the frame of an open one behind its streams, the box of a folded one in their place.

use super::Stage;
use super::bounds::{around, framed};
use super::differs::{Differs, differs_memo};
use super::node::{ProblemBadge, Ring, Ringed, ringed};
use super::notes::{drawn_memo, placed};
use super::view::CanvasBounds;
use crate::desk::{Desk, GroupSignals, Selected, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::stream_width;
use crate::live::rate_words;
use crate::parts::kind_class;
use behaviour::{FillFrom, Id, Kind, Place, Problem, ProblemKind, RecordId, StreamKind};
use leptos::prelude::*;
use std::collections::BTreeSet;

/// The frames of open groups, as a view.
pub(crate) fn frames() -> AnyView {
    view! { <Groups folded=false /> }.into_any()
}

/// The boxes of folded groups, as a view.
pub(crate) fn boxes() -> AnyView {
    view! { <Groups folded=true /> }.into_any()
}

#[component]
fn Groups(folded: bool) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let drawn = drawn_memo(&stage, desk.document.group_ids.clone());
    let ids = ArcMemo::new(move |_| {
        desk.document.hidden.track();
        drawn.get().into_iter().filter(|id| desk.document.is_folded(id) == folded).collect::<Vec<_>>()
    });
    view! {
        <For each=move || ids.get() key=Clone::clone let:id>
            {if folded { view! { <FoldedBox id /> }.into_any() } else { view! { <Frame id /> }.into_any() }}
        </For>
    }
}

/// The streams of a group that are there.
fn members_memo(desk: &Desk, id: &Id) -> ArcMemo<Vec<Id>> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| desk.document.members(&id))
}

/// Returns the frame of a group. The width of its streams is looked up only when that changes, so that a drag adds
/// little.
fn frame_memo(desk: &Desk, members: &ArcMemo<Vec<Id>>) -> ArcMemo<Option<CanvasBounds>> {
    let (desk, members) = (desk.clone(), members.clone());
    let sizes = ArcMemo::new(move |_| {
        let size = |id: Id| {
            let signals = desk.document.stream(&id)?;
            Some((signals.place, signals.record.with(stream_width)))
        };
        members.get().into_iter().filter_map(size).collect::<Vec<(ArcRwSignal<Place>, f64)>>()
    });
    ArcMemo::new(move |_| sizes.with(|sizes| framed(sizes.iter().map(|(place, width)| around(place.get(), *width)))))
}

fn chosen_memo(desk: &Desk, id: &Id) -> ArcMemo<bool> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| desk.document.is_chosen(&Selected::Group(id.clone())))
}

/// The frame of an open group with its title on the upper edge.
#[component]
fn Frame(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(GroupSignals { record, .. }) = desk.document.group(&id) else { return ().into_any() };
    stage.drawn_now(&id);
    let members = members_memo(&desk, &id);
    let frame = frame_memo(&desk, &members);
    let chosen = chosen_memo(&desk, &id);
    let stop = stage.is_aside_stop(&id);
    let differs = differs_memo(&desk, &RecordId::new(Kind::Group, &id));
    let differing = differs.clone();
    let counts = counts_memo(&desk, &members);
    let [label, title, button] = [(); 3].map(|()| record.clone());
    let (lit, pressed, width, height) = (chosen.clone(), chosen.clone(), frame.clone(), frame.clone());
    let side = |of: fn(CanvasBounds) -> f64, frame: ArcMemo<Option<CanvasBounds>>| {
        move || frame.get().map(|at| format!("{:.0}px", of(at)))
    };
    let folded = id.clone();
    let joined = {
        let (joining, id) = (stage.joining.clone(), id.clone());
        ArcMemo::new(move |_| joining.with(|joining| joining.as_ref() == Some(&id)))
    };
    view! {
        <div class="group-frame" class:selected=move || lit.get() class:joined=move || joined.get()
            style:transform=move || frame.get().map(|at| format!("translate({:.1}px,{:.1}px)", at.left, at.top))
            style:width=side(|at| at.right - at.left, width) style:height=side(|at| at.bottom - at.top, height)>
            <div class="frame-bar">
                <div class="frame-title" data-group=id.to_string() role="button"
                    tabindex=move || if stop.get() { "0" } else { "-1" }
                    aria-pressed=move || pressed.get().to_string()
                    title=words::group_hint()
                    aria-label=move || {
                        let name = label.with(|group| words::group_name(&group.title, &counts.with(|counts| counted(counts))));
                        words::with_mark(name, differing.get().map(|it| it.text).as_deref())
                    }>
                    <span class="cut">{move || title.with(|group| group.title.clone())}</span>
                </div>
                <button type="button" class="turn-group" title=words::fold() aria-expanded="true"
                    aria-label=move || button.with(|group| words::fold_of(&group.title))
                    on:click=move |_| stage.fold(&folded, true)><Icon name="fold" /></button>
            </div>
            <Differs differs />
            <span class="frame-ring"><GroupRing ids=vec![id] /></span>
        </div>
    }
    .into_any()
}

#[component]
fn GroupRing(ids: Vec<Id>) -> impl IntoView {
    let stage = expect_context::<Stage>();
    let ring = ArcMemo::new(move |_| ringed(&stage, &ids));
    view! { <Ring ring /> }
}

/// A folded group: its name, what is in it, and how that is now.
#[component]
fn FoldedBox(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(GroupSignals { record, at, .. }) = desk.document.group(&id) else { return ().into_any() };
    stage.drawn_now(&id);
    let members = members_memo(&desk, &id);
    let inside = inside_memo(&desk, &members);
    let chosen = chosen_memo(&desk, &id);
    let stop = stage.is_aside_stop(&id);
    let differs = differs_memo(&desk, &RecordId::new(Kind::Group, &id));
    let differing = differs.clone();
    let counts = counts_memo(&desk, &members);
    let shapes = counts.clone();
    let problem = trouble_memo(&desk, &inside);
    let trouble = problem.clone();
    let ring = ring_memo(&stage, &id, &inside);
    let now = now_memo(&desk, &stage, &members);
    let fires = fires_memo(&desk, &stage, &inside);
    let is_dragged = {
        let (dragged, id) = (stage.dragged.clone(), id.clone());
        move || dragged.with(|dragged| dragged.as_ref() == Some(&id))
    };
    let [label, title, button] = [(); 3].map(|()| record.clone());
    let (lit, pressed, opened) = (chosen.clone(), chosen, id.clone());
    view! {
        <div class="at of-box" class:dragged=is_dragged style:transform=move || at.get().map(placed)>
            <div class="group-box" data-group=id.to_string() role="button"
                class:selected=move || lit.get() class:fired=move || fires.get()
                tabindex=move || if stop.get() { "0" } else { "-1" }
                aria-pressed=move || pressed.get().to_string()
                title=move || title.with(|group| group.title.clone())
                aria-label=move || {
                    let name = label.with(|group| words::folded_name(&group.title, &counts.with(|counts| counted(counts))));
                    words::with_mark(name, differing.get().map(|it| it.text).as_deref())
                }
                aria-description=move || trouble.get().map(|(sentence, _)| sentence)>
                <span class="box-name cut">{move || record.with(|group| group.title.clone())}</span>
                <span class="box-line" aria-hidden="true">
                    {move || shapes.get().into_iter().map(shape).collect_view()}
                    <span class="box-now cut" data-says=move || now.get()></span>
                </span>
            </div>
            <button type="button" class="turn-group" title=words::unfold() aria-expanded="false"
                aria-label=move || button.with(|group| words::unfold_of(&group.title))
                on:click=move |_| stage.fold(&opened, false)><Icon name="unfold" /></button>
            <ProblemBadge problem />
            <Differs differs />
            <Ring ring />
        </div>
    }
    .into_any()
}

/// The number of streams of one kind.
type KindCount = (StreamKind, usize);

fn counts_memo(desk: &Desk, members: &ArcMemo<Vec<Id>>) -> ArcMemo<Vec<KindCount>> {
    let (desk, members) = (desk.clone(), members.clone());
    ArcMemo::new(move |_| {
        let kind = |id: &Id| Some(desk.document.stream(id)?.record.with(|stream| stream.kind));
        let kinds: Vec<StreamKind> = members.with(|members| members.iter().filter_map(kind).collect());
        let all = [StreamKind::Sensor, StreamKind::Ordinary, StreamKind::Actuator];
        let count = |of| kinds.iter().filter(|kind| **kind == of).count();
        all.into_iter().map(|kind| (kind, count(kind))).filter(|(_, count)| *count > 0).collect()
    })
}

/// The counts in words: `1 sense, 2 streams`.
pub(super) fn counted(counts: &[KindCount]) -> String {
    let counted = counts.iter().map(|(kind, count)| words::count_of_kind(*kind, *count));
    words::listed(counted.collect::<Vec<_>>().iter().map(String::as_str))
}

fn shape((kind, count): KindCount) -> impl IntoView {
    view! { <span class="box-count"><i class=format!("kind-shape {}", kind_class(kind))></i><span data-says=count.to_string()></span></span> }
}

/// Streams of a group and the connectors that lead to them.
#[derive(Clone, Debug, Default, PartialEq)]
struct GroupMembers {
    streams: BTreeSet<Id>,
    connectors: BTreeSet<Id>,
}

fn inside_memo(desk: &Desk, members: &ArcMemo<Vec<Id>>) -> ArcMemo<GroupMembers> {
    let (desk, members) = (desk.clone(), members.clone());
    ArcMemo::new(move |_| {
        let streams: BTreeSet<Id> = members.get().into_iter().filled();
        desk.document.edited.track();
        let leads_in = |id: &Id| {
            let signals = desk.document.connector(id);
            signals
                .is_some_and(|signals| signals.record.with_untracked(|connector| streams.contains(&connector.output)))
        };
        let connectors = desk.document.connector_ids.get().into_iter().filter(leads_in).collect();
        GroupMembers { streams, connectors }
    })
}

/// The first problem of something inside, one that keeps the behaviour from running first.
fn trouble_memo(desk: &Desk, inside: &ArcMemo<GroupMembers>) -> ArcMemo<Option<(String, bool)>> {
    let (desk, inside) = (desk.clone(), inside.clone());
    ArcMemo::new(move |_| {
        inside.with(|inside| {
            let is_inside = |problem: &&Problem| match problem.at.kind {
                Kind::Stream => problem.kind != ProblemKind::Unused && inside.streams.contains(&problem.at.id),
                Kind::Connector => inside.connectors.contains(&problem.at.id),
                _ => false,
            };
            desk.document.problems.with(|problems| {
                let first = problems.iter().filter(is_inside).max_by_key(|problem| problem.blocks)?;
                Some((words::told_by(first), first.blocks))
            })
        })
    })
}

fn ring_memo(stage: &Stage, id: &Id, inside: &ArcMemo<GroupMembers>) -> ArcMemo<Ringed> {
    let (stage, id, inside) = (stage.clone(), id.clone(), inside.clone());
    ArcMemo::new(move |_| {
        let all = inside.with(|inside| {
            inside.streams.iter().chain(&inside.connectors).cloned().chain([id.clone()]).collect::<Vec<_>>()
        });
        ringed(&stage, &all)
    })
}

/// Returns true while a connector inside has just fired.
fn fires_memo(desk: &Desk, stage: &Stage, inside: &ArcMemo<GroupMembers>) -> ArcMemo<bool> {
    let (desk, running, inside) = (desk.clone(), stage.running.clone(), inside.clone());
    ArcMemo::new(move |_| {
        running.get()
            && inside.with(|inside| {
                let fires =
                    |id: &Id| desk.document.connector(id).is_some_and(|signals| signals.live.with(|live| live.lit));
                inside.connectors.iter().filter(|id| fires(id)).count() > 0
            })
    })
}

/// Returns how often its liveliest stream carries values now, else for how long all of them are quiet; nothing without
/// a run.
fn now_memo(desk: &Desk, stage: &Stage, members: &ArcMemo<Vec<Id>>) -> ArcMemo<String> {
    let (desk, running, members) = (desk.clone(), stage.running.clone(), members.clone());
    ArcMemo::new(move |_| {
        if !running.get() {
            return String::new();
        }
        let now = desk.robots.clock.get();
        let of = |id: &Id| {
            let live = desk.document.stream(id)?.live;
            live.with(|live| live.value.is_some().then(|| (live.rate, live.quiet_for(now), live.earlier_ms.is_some())))
        };
        let all: Vec<_> = members.with(|members| members.iter().filter_map(of).collect());
        let awake = all.iter().filter(|(_, quiet, _)| quiet.is_none()).map(|(rate, ..)| *rate);
        let is_then = all.iter().any(|(.., is_then)| *is_then);
        match (awake.reduce(f32::max), all.iter().filter_map(|(_, quiet, _)| *quiet).min()) {
            (Some(rate), _) => rate_words(rate),
            (None, Some(seconds)) if is_then => words::seconds_earlier(u64::from(seconds)),
            (None, Some(seconds)) => words::quiet_for(u64::from(seconds)),
            (None, None) => String::new(),
        }
    })
}
