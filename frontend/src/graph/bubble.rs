//! The problem of what is selected, or one that has just come about, said beside it with its fixes. Problems that
//! everything has while it is being built (nothing leads to it yet) stay in the list.

use super::Stage;
use super::chip::chip_of;
use super::strip_spot::{EDGE, HEIGHT as STRIP, StageArea, ZOOM_BOX};
use super::view::CanvasBounds;
use crate::browser;
use crate::desk::{Desk, Selected, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::parts::ProblemLine;
use behaviour::{Id, Problem, ProblemKind};
use leptos::prelude::*;

/// The bubble's size, about so high until it is known, and its distance from what it is about, in pixels.
const SIZE: (f64, f64) = (268.0, 96.0);
const NEAR: f64 = 14.0;

/// The bubble, as a view.
pub(crate) fn bubble() -> AnyView {
    view! { <Bubble /> }.into_any()
}

#[component]
fn Bubble() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let newest = newest(&desk);
    let shown = {
        let (desk, newest, asked) = (desk.clone(), newest, stage.asked_about.clone());
        ArcMemo::new(move |_| asked_about(&desk, asked.get()).or_else(|| shown(&desk, newest.get())))
    };
    let (root, high) = (NodeRef::<leptos::html::Div>::new(), ArcRwSignal::new(SIZE.1));
    follow_height(root, high.clone());
    let (spot, moves) = (spot_memo(&desk, &stage, &shown, high), stage.dragged.clone());
    let wire = stage.wire.clone();
    let asked = stage.asked_about.clone();
    let at = move || spot.get().map(|(x, y)| format!("translate({x:.0}px,{y:.0}px)"));
    move || {
        let problem = shown.get().filter(|_| moves.with(Option::is_none) && wire.with(Option::is_none))?;
        let asked = asked.clone();
        let is_asked = asked.with(|asked| asked.as_ref() == Some(&problem.at.id));
        let close = move |_| {
            newest.set(None);
            asked.set(None);
        };
        let is_newest = is_asked || newest.with(|newest| newest.as_ref() == Some(&problem));
        Some(view! {
            <div class="trouble" node_ref=root role="note" aria-label=words::problems() style:transform=at.clone()>
                <ul class="big-list"><ProblemLine problem=problem alone=true /></ul>
                {is_newest.then(|| view! {
                    <button type="button" class="tool icon" aria-label=words::dismiss() title=words::dismiss() on:click=close>
                        <Icon name="close" />
                    </button>
                })}
            </div>
        })
    }
}

/// Tells how high it is: as many lines as its problem and what mends that need.
fn follow_height(root: NodeRef<leptos::html::Div>, high: ArcRwSignal<f64>) {
    Effect::new(move |_| {
        let Some(root) = root.get() else { return };
        let (measured, high) = (root.clone(), high.clone());
        let measure = move || {
            let now = f64::from(measured.offset_height());
            if now > 0.0 && high.get_untracked() != now {
                high.set(now);
            }
        };
        measure();
        if let Some(observer) = browser::watch_size(&root, measure) {
            let observer = StoredValue::new_local(observer);
            on_cleanup(move || {
                let _ = observer.try_with_value(web_sys::ResizeObserver::disconnect);
            });
        }
    });
}

/// True if somebody who is building wants to be told at once.
fn is_told_at_once(problem: &Problem) -> bool {
    use ProblemKind::{EmptyBody, FewInputs, NoInputs, NoSource, Unused};
    !matches!(problem.kind, Unused | NoSource | NoInputs | FewInputs(_) | EmptyBody)
}

/// The one that came last while this program was open, until it is gone or put away.
fn newest(desk: &Desk) -> RwSignal<Option<Problem>> {
    let newest = RwSignal::new(None);
    let opened = StoredValue::new(0);
    let revision = desk.document.revision.clone();
    let (problems, open) = (desk.document.problems.clone(), desk.document.open.clone());
    let of = move || open.with(|open| open.as_ref().map(ToString::to_string));
    Effect::new(move |before: Option<(Option<String>, Vec<Problem>)>| {
        let now = problems.get();
        let program = of();
        let revision = revision.get_untracked();
        if before.as_ref().is_none_or(|(known, _)| *known != program) || opened.get_value() == 0 {
            opened.set_value(revision);
        }
        // What a program has when it is opened comes a moment later, and is not new.
        let before = before.filter(|_| opened.with_value(|opened| *opened < revision));
        let is_new = |old: &[Problem], problem: &Problem| is_told_at_once(problem) && !old.contains(problem);
        let new = before.and_then(|(_, old)| now.iter().find(|problem| is_new(&old, problem)).cloned());
        if new.is_some() {
            newest.set(new);
        }
        if newest.with_untracked(|newest| newest.as_ref().is_some_and(|newest| !now.contains(newest))) {
            newest.set(None);
        }
        (program, now)
    });
    newest
}

/// The problem of what is selected, if its badge was pressed: whatever it is, who presses it wants to know. Reactive.
fn asked_about(desk: &Desk, asked: Option<Id>) -> Option<Problem> {
    let asked = asked?;
    let is_selected = desk.document.selected.with(|selected| selected.as_ref().map(Selected::id) == Some(&asked));
    let its = |all: &Vec<Problem>| all.iter().find(|problem| problem.at.id == asked).cloned();
    desk.document.problems.with(its).filter(|_| is_selected)
}

/// A connector that is selected says it in its control. Reactive.
fn shown(desk: &Desk, newest: Option<Problem>) -> Option<Problem> {
    let selected = desk.document.selected.get();
    let own = selected.as_ref().and_then(|selected| match selected {
        Selected::Stream(id) => desk
            .document
            .problems
            .with(|all| all.iter().find(|problem| problem.at.id == *id && is_told_at_once(problem)).cloned()),
        Selected::Connector(_) | Selected::Note(_) | Selected::Group(_) => None,
    });
    own.or_else(|| newest.filter(|newest| selected.is_none_or(|selected| *selected.id() != newest.at.id)))
}

/// The name of the stream that a problem is about too.
fn rival(problem: &Problem) -> Option<String> {
    match &problem.kind {
        ProblemKind::FightingActions { with, .. } => Some(with.clone()),
        ProblemKind::StaleCombine { old, .. } => Some(old.clone()),
        _ => None,
    }
}

/// Returns the bounds of the stream of that name.
fn rival_bounds(desk: &Desk, stage: &Stage, name: &str) -> Option<CanvasBounds> {
    let is_it = |id: &Id| {
        desk.document.stream(id).is_some_and(|stream| stream.record.with_untracked(|stream| stream.name == name))
    };
    stage.shapes.with(|shapes| shapes.iter().find(|(id, _)| is_it(id)).map(|(_, bounds)| *bounds))
}

/// The left top corner, near what it is about, where it covers least: what it is about and the tools never, if that can be.
fn spot_memo(
    desk: &Desk,
    stage: &Stage,
    shown: &ArcMemo<Option<Problem>>,
    high: ArcRwSignal<f64>,
) -> ArcMemo<Option<(f64, f64)>> {
    let (desk, stage, shown) = (desk.clone(), stage.clone(), shown.clone());
    ArcMemo::new(move |_| {
        let (id, with) =
            shown.with(|problem| problem.as_ref().map(|problem| (problem.at.id.clone(), rival(problem))))?;
        let (view, size, high) = (stage.view.get(), stage.size.get(), high.get());
        let own = stage.shapes.with(|shapes| shapes.iter().find(|(shape, _)| *shape == id).map(|(_, bounds)| *bounds));
        if let Some(chip) = desk.document.connector(&id) {
            // It goes where its chip goes.
            let _ = chip.record.with(|connector| chip_of(&desk, connector));
        }
        let own = own.or_else(|| stage.chip_bounds(&id))?;
        let rival = with.and_then(|with| rival_bounds(&desk, &stage, &with));
        let corner = |x, y| view.to_stage(behaviour::Place { x, y });
        let ((left, top), (right, bottom)) = (corner(own.left, own.top), corner(own.right, own.bottom));
        let covered = |(x, y): (f64, f64)| {
            let (from, to) = (view.to_canvas((x, y)), view.to_canvas((x + SIZE.0, y + high)));
            let area = CanvasBounds { left: from.x, top: from.y, right: to.x, bottom: to.y };
            let streams = stage.shapes.with(|shapes| shapes.iter().filter(|(_, other)| area.meets(*other)).count());
            let chips = desk.document.connector_ids.with(|ids| {
                ids.iter().filter_map(|id| stage.chip_bounds(id)).filter(|other| area.meets(*other)).count()
            });
            let (own_left, own_right) = (left.min(right), left.max(right));
            let own = x < own_right && x + SIZE.0 > own_left && y < bottom && y + high > top;
            let tools = x + SIZE.0 > size.0 - ZOOM_BOX.0 && y + high > size.1 - ZOOM_BOX.1;
            let bubble = StageArea { left: x, top: y, right: x + SIZE.0, bottom: y + high };
            let strip = stage.strip.with(|strip| strip.is_some_and(|strip| strip.shared(&bubble) > 0.0));
            let rival = rival.is_some_and(|rival| area.meets(rival));
            streams * 2 + chips * 2 + [own, tools, strip, rival].map(usize::from).iter().sum::<usize>() * 20
        };
        let above = stage.above.get().unwrap_or_default();
        let inside = |(x, y): (f64, f64)| {
            let x = x.clamp(EDGE, (size.0 - SIZE.0 - EDGE).max(EDGE));
            (x, y.clamp(above + EDGE, (size.1 - high - EDGE).max(above + EDGE)))
        };
        let beside = [right + NEAR, left - NEAR - SIZE.0];
        let levels = [top, top - high / 2.0, bottom - high, top - high - NEAR, bottom + NEAR];
        let over = [(left + right - SIZE.0) / 2.0, left, right - SIZE.0];
        let sides = beside.into_iter().flat_map(|x| levels.map(|y| (x, y)));
        let others = over.into_iter().flat_map(|x| [(x, top - high - NEAR), (x, bottom + STRIP + NEAR)]);
        sides.chain(others).map(inside).min_by_key(|spot| covered(*spot))
    })
}
