//! The last two minutes: when senses told something, when actions were fed, what was pressed by hand, and the marks.

use super::OperateShared;
use super::clock::time_of_day;
use super::seen::KEPT_MS;
use crate::browser;
use crate::operate::words;
use behaviour::{Id, StreamKind};
use leptos::prelude::*;
use std::collections::{BTreeMap, VecDeque};

/// The period after which it is looked what told something, in milliseconds.
const LOOK_MS: i32 = 250;
/// Two values nearer than this are one bar, in milliseconds.
const JOINED_MS: f64 = 1_000.0;
/// Bars of one stream, at most.
const BARS_MAX: usize = 120;
/// Senses and actions that have a row.
const SENSES_MAX: usize = 2;
const ACTIONS_MAX: usize = 2;
/// The width and the height of a row's picture, in its own units.
const WIDTH: f64 = 1_000.0;
/// Times along the top, in milliseconds.
const TIMES_MS: f64 = 30_000.0;
/// The stretch before the end in which no time of day stands, as the word for the end does: on a phone, with the longer word too.
const CLEAR_MS: f64 = 14_000.0;
const QUIET_CLEAR_MS: f64 = 55_000.0;

/// When a stream told something: from and until, by this computer's clock.
type LaneBars = VecDeque<(f64, f64)>;

/// A value that came then. Pure.
fn join(bars: &mut LaneBars, from: f64, at: f64) {
    match bars.back_mut() {
        Some((_, until)) if from - *until <= JOINED_MS => *until = at.max(*until),
        _ => bars.push_back((from, at)),
    }
    while bars.len() > BARS_MAX || bars.front().is_some_and(|(_, until)| at - until > KEPT_MS) {
        bars.pop_front();
    }
}

/// Returns the place of a moment in the picture of the last two minutes. Pure.
fn place(at: f64, now: f64) -> f64 {
    (WIDTH * (1.0 - (now - at) / KEPT_MS)).clamp(0.0, WIDTH)
}

/// A row: its stream, what it is called, and whether it is an action.
type LaneRow = (Id, String, bool);

#[component]
pub(super) fn Lanes(op: OperateShared) -> impl IntoView {
    let bars = RwSignal::new(BTreeMap::<Id, (u64, LaneBars)>::new());
    let busy = Memo::new(move |_| {
        let all = bars.read();
        all.iter().filter(|(_, (_, bars))| !bars.is_empty()).map(|(id, _)| id.clone()).collect::<Vec<_>>()
    });
    let rows = Memo::new(move |_| rows(op, &|id| busy.read().contains(id)));
    look(op, bars);
    let some = Memo::new(move |_| {
        bars.read().values().any(|(_, bars)| !bars.is_empty())
            || !op.seen.read().is_empty()
            || !op.marks.all.read().is_empty()
    });
    let opened = Memo::new(move |_| op.desk.desk().document.open.read().is_some());
    // The picture moves once a second for who wants little motion.
    let now =
        Memo::new(move |_| if browser::is_calm() { (op.now.get() / 1_000.0).floor() * 1_000.0 } else { op.now.get() });
    let times = move || {
        let now = now.get();
        let first = (now / TIMES_MS).floor() * TIMES_MS;
        let clear_ms = if op.is_quiet() { QUIET_CLEAR_MS } else { CLEAR_MS };
        let all = (0..3)
            .map(|back| first - f64::from(back) * TIMES_MS)
            .filter(|at| (now - KEPT_MS * 0.97..now - clear_ms).contains(at));
        let time =
            |at: f64| view! { <span style=("--at", format!("{:.1}%", place(at, now) / 10.0))>{time_of_day(at)}</span> };
        all.map(time).collect_view()
    };
    let end = move || if op.is_quiet() { words::no_connection_now() } else { words::happens_now() };
    let lane = move |(id, name, acts): LaneRow| {
        let title = name.clone();
        let shapes = move || {
            let now = now.get();
            let all = bars.read();
            let bars = all.get(&id).map(|(_, bars)| bars.iter().copied().collect::<Vec<_>>()).unwrap_or_default();
            let bar = |(from, until): (f64, f64)| {
                let (left, right) = (place(from, now), place(until, now));
                view! { <rect x=left y="6" height="10" rx="3" width=(right - left).max(4.0) /> }
            };
            bars.into_iter().filter(|(_, until)| now - until < KEPT_MS).map(bar).collect_view()
        };
        view! {
            <li class:acts=acts><span class="cut" title=title>{name}</span>
                <svg viewBox="0 0 1000 22" preserveAspectRatio="none" aria-hidden="true"><line x1="0" x2="1000" y1="11" y2="11" />{shapes}</svg>
            </li>
        }
    };
    let dots = move || {
        let now = now.get();
        let seen: Vec<_> = op.seen.get().into_iter().filter(|seen| now - seen.at < KEPT_MS).collect();
        let dot = move |seen: super::seen::SeenPress| {
            let left = format!("{:.2}%", place(seen.at, now) / 10.0);
            view! { <i class:not=!seen.done title=seen.by style=("--at", left) style=("--person", op.color_of(&seen.client))></i> }
        };
        seen.into_iter().map(dot).collect_view()
    };
    let flags = move || {
        let now = now.get();
        let marks: Vec<_> = op
            .marks
            .all
            .read()
            .iter()
            .filter(|mark| now - mark.until.unwrap_or(if mark.open { now } else { mark.at }) < KEPT_MS)
            .cloned()
            .collect();
        let flag = move |mark: super::marks::Mark| {
            let left = place(mark.at, now) / 10.0;
            let width = (mark.until.or(mark.open.then_some(now))).map(|until| place(until, now) / 10.0 - left);
            let span = width.map(|width| view! { <i class="op-span" style=("--at", format!("{left:.2}%")) style=("--wide", format!("{width:.2}%"))></i> });
            view! { {span}<b class="op-flag" style=("--at", format!("{left:.2}%"))><crate::icons::Icon name="flag" /></b> }
        };
        marks.into_iter().map(flag).collect_view()
    };
    view! {
        <Show when=move || opened.get()>
            <section class="op-lanes" aria-label=words::last_two_minutes()>
                <div class="op-times"><h2>{words::last_two_minutes()}</h2><p aria-hidden="true">{times}<span class="op-end">{end}</span></p></div>
                <Show when=move || some.get() fallback=|| view! { <p class="op-none">{words::nothing_yet()}</p> }>
                    <ul>
                        {move || rows.get().into_iter().map(lane).collect_view()}
                        <li class="dots"><span>{words::row_by_hand()}</span><p aria-hidden="true">{dots}</p></li>
                        <li class="flags"><span>{words::marks_name()}</span><p aria-hidden="true">{flags}</p></li>
                    </ul>
                </Show>
            </section>
        </Show>
    }
}

/// The senses and the actions that a connector leads to which have a row: those that told something first. Reactive.
fn rows(op: OperateShared, is_busy: &dyn Fn(&Id) -> bool) -> Vec<LaneRow> {
    let document = &op.desk.desk().document;
    document.edited.track();
    let ends: Vec<Id> = document
        .connectors()
        .iter()
        .map(|(_, signals)| signals.record.with_untracked(|one| one.output.clone()))
        .collect();
    let all: Vec<LaneRow> = document
        .stream_ids
        .get()
        .into_iter()
        .filter_map(|id| {
            let (name, kind) = document.stream(&id)?.record.with(|stream| (stream.name.clone(), stream.kind));
            let acts = kind == StreamKind::Actuator;
            (kind == StreamKind::Sensor || (acts && ends.contains(&id))).then_some((id, name, acts))
        })
        .collect();
    let chosen = |acts: bool, most: usize| {
        let of = || all.iter().filter(move |row| row.2 == acts);
        let busy = of().filter(|row| is_busy(&row.0)).chain(of().filter(|row| !is_busy(&row.0)));
        busy.take(most).map(|row| row.0.clone()).collect::<Vec<_>>()
    };
    let chosen = [chosen(false, SENSES_MAX), chosen(true, ACTIONS_MAX)].concat();
    // They stand in the order of the program, whichever came first.
    let (senses, actions): (Vec<LaneRow>, Vec<LaneRow>) =
        all.into_iter().filter(|row| chosen.contains(&row.0)).partition(|row| !row.2);
    senses.into_iter().chain(actions).collect()
}

/// Looks again and again what told something since.
fn look(op: OperateShared, bars: RwSignal<BTreeMap<Id, (u64, LaneBars)>>) {
    browser::every(LOOK_MS, move || {
        if untrack(|| op.run()).is_none() || untrack(|| op.is_quiet()) {
            return;
        }
        let now = browser::today_ms();
        let document = &op.desk.desk().document;
        let told: Vec<(Id, u64)> = document
            .stream_ids
            .get_untracked()
            .into_iter()
            .filter_map(|id| {
                let acts_or_senses = |kind| matches!(kind, StreamKind::Sensor | StreamKind::Actuator);
                document.stream(&id).filter(|stream| stream.record.with_untracked(|one| acts_or_senses(one.kind)))?;
                let count = document.stream(&id)?.live.with_untracked(|live| live.count);
                Some((id, count))
            })
            .collect();
        let is_new = bars.try_with_untracked(|bars| {
            told.iter().any(|(id, count)| bars.get(id).map(|(known, _)| known) != Some(count))
        });
        if is_new != Some(true) {
            return;
        }
        bars.try_update(|bars| {
            bars.retain(|id, _| told.iter().any(|(known, _)| known == id));
            for (id, count) in told {
                let (known, bars) = bars.entry(id).or_insert_with(|| (count, LaneBars::new()));
                if count > *known {
                    join(bars, now - f64::from(LOOK_MS), now);
                }
                *known = count;
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use super::{BARS_MAX, LaneBars, WIDTH, join, place};

    #[test]
    fn values_near_each_other_are_one_bar_and_gaps_stay() {
        let mut bars = LaneBars::new();
        for at in [1_000.0, 1_250.0, 2_200.0, 5_000.0] {
            join(&mut bars, at - 250.0, at);
        }
        assert_eq!(bars, [(750.0, 2_200.0), (4_750.0, 5_000.0)]);
        join(&mut bars, 122_350.0, 122_600.0);
        assert_eq!(bars, [(4_750.0, 5_000.0), (122_350.0, 122_600.0)], "what is older than two minutes is gone");
        (0..1_000).for_each(|at| join(&mut bars, 130_000.0 + f64::from(at) * 10.0, 130_000.0 + f64::from(at) * 10.0));
        assert!(bars.len() <= BARS_MAX);
    }

    #[test]
    fn now_is_at_the_right_end() {
        assert_eq!(
            [place(120_000.0, 120_000.0), place(60_000.0, 120_000.0), place(-5.0, 120_000.0)],
            [WIDTH, WIDTH / 2.0, 0.0]
        );
    }
}
