//! The changes stream by stream, as a table, and what nobody can know.

use super::compare::ChangeCounts;
use super::{PastShared, clock, filling};
use crate::words;
use behaviour::StreamKind;
use lanes::{DotChange, LaneAct};
use leptos::prelude::*;
use protocol::{ChangedMoment, ChangedStream, LaneName, MomentChange, PastChanges};
use robot::Resource;

/// So many streams have a row.
const ROWS_MAX: usize = 12;
/// So many moved moments are told one by one.
const MOVED_MAX: usize = 3;

/// The table beside the lanes, once something is compared.
#[component]
pub(super) fn Changes(past: PastShared) -> impl IntoView {
    let compare = past.compare;
    let is_there = move || compare.is_on.get() && compare.changes.read().is_some();
    let rows = move || {
        let changes = compare.changes.get()?;
        let changed = changes.streams.iter().filter(|one| ChangeCounts::of(one).changes()).take(ROWS_MAX);
        Some(changed.cloned().map(|one| view! { <ChangedRow past one /> }).collect_view())
    };
    let nothing = move || {
        let changes = compare.changes.read();
        changes.as_ref().is_some_and(|all| !all.streams.iter().any(|one| ChangeCounts::of(one).changes()))
    };
    view! {
        <Show when=is_there>
            <div class="past-changes" role="group" tabindex="0" aria-label=words::what_would_change()>
                <table hidden=nothing>
                    <caption>{words::what_would_change()}</caption>
                    <thead><tr>
                        <th scope="col">{words::what_differs()}</th><th scope="col">{words::before_name()}</th>
                        <th scope="col">{words::now_version()}</th>
                    </tr></thead>
                    <tbody>{rows}</tbody>
                </table>
                {move || compare.changes.get().map(|changes| remarks(past, &changes).into_iter().map(|text| view! { <p class="second">{text}</p> }).collect_view())}
            </div>
        </Show>
    }
}

/// One stream, and below it how it changes.
#[component]
fn ChangedRow(past: PastShared, one: ChangedStream) -> impl IntoView {
    let counts = ChangeCounts::of(&one);
    let words = words::counted_changes(counts.same, counts.only_now, counts.only_before, counts.moved);
    let moved = one.moments.iter().filter_map(moved_words).take(MOVED_MAX);
    let told = words::listed(std::iter::once(words).chain(moved));
    let stream = one.stream.clone();
    let choose = move |_| past.show_lane(&stream);
    view! {
        <tr>
            <th scope="row"><button class="link" type="button" on:click=choose>{one.name.clone()}</button></th>
            <td>{one.before.to_string()}</td><td><b>{one.now.to_string()}</b></td>
        </tr>
        <tr class="past-how"><td colspan="3">{told}</td></tr>
    }
}

/// Says by how much a moment moved, if it did.
fn moved_words(one: &ChangedMoment) -> Option<String> {
    let MomentChange::MovedTo(to) = one.what else { return None };
    Some(change_words(one.t as f64, DotChange::MovedTo(to as f64)))
}

/// A change of a moment in words.
pub(super) fn change_words(t: f64, change: DotChange) -> String {
    match change {
        DotChange::Same => words::is_same().to_owned(),
        DotChange::OnlyNow => words::is_only_now().to_owned(),
        DotChange::OnlyBefore => words::is_only_before().to_owned(),
        DotChange::MovedTo(to) => {
            let by = words::moved_by((to - t).abs() as u64);
            if to < t { words::moved_earlier(&by) } else { words::moved_later(&by) }
        }
    }
}

/// The remarks to a comparison: of which time it is, from when on it is not sure, and what nobody knows.
fn remarks(past: PastShared, changes: &PastChanges) -> Vec<String> {
    let Some(opened) = past.opened.get_untracked() else { return Vec::new() };
    let mut all = vec![words::the_same_readings().to_owned()];
    if changes.from_ms > opened.from_ms {
        all.push(words::in_last_minutes().to_owned());
    }
    let parts = changes.open_loop.iter().flat_map(|stream| {
        let stream = opened.streams.iter().find(|one| one.stream == *stream);
        let device = stream.and_then(|one| Some((one, one.device.as_deref()?)));
        let parts = |(one, device): (&protocol::PastStream, &str)| {
            robot::device(StreamKind::Actuator, device).ok().map(|device| device.parts(&one.params))
        };
        device.and_then(parts).unwrap_or_default()
    });
    for said in parts.filter_map(elsewhere) {
        if !all.iter().any(|one| one == said) {
            all.push(said.to_owned());
        }
    }
    if !changes.open_loop.is_empty() {
        all.push(words::participant_unknown().to_owned());
    }
    let differs = changes.differs_ms.map(|ms| ms.saturating_sub(opened.from_ms) as f64);
    all.extend(differs.map(|ms| words::differs_from(&clock::time(&opened, ms, false))));
    all
}

/// Says what the senses would have noticed of a part of the robot that does something else.
fn elsewhere(part: Resource) -> Option<&'static str> {
    match part {
        Resource::Head => Some(words::head_elsewhere()),
        Resource::LeftArm | Resource::RightArm => Some(words::arms_elsewhere()),
        Resource::Legs => Some(words::stood_elsewhere()),
        Resource::Voice => Some(words::spoken_otherwise()),
        Resource::Eyes | Resource::Memory => None,
    }
}

/// The counts of a lane while it is compared: short for the eye, and in words. Reactive.
pub(super) fn lane_counts(past: PastShared, key: &str) -> Option<(String, String)> {
    if !past.compare.is_on.get() {
        return None;
    }
    let one = past.compare.of(&filling::name(key).stream)?;
    let counts = ChangeCounts::of(&one);
    let words = words::counted_changes(counts.same, counts.only_now, counts.only_before, counts.moved);
    Some((format!("{} → {}", one.before, one.now), words))
}

impl PastShared {
    /// Chooses the lane of a stream, and adds it if it is not there.
    fn show_lane(self, stream: &str) {
        let name = LaneName { stream: stream.to_owned(), field: None };
        let at =
            self.viewer.with_untracked(|viewer| viewer.lanes().iter().position(|lane| lane.key == filling::key(&name)));
        match at {
            Some(at) => self.act(LaneAct::Choose(at)),
            None => self.add_lane(&name),
        }
    }
}
