//! The changes stream by stream, as a table, and what nobody can know.

use super::compare_counts::{ChangeCounts, change_words, dot_change};
use super::media::page_element;
use super::{PastShared, clock, filling};
use crate::past::words;
use behaviour::StreamKind;
use lanes::{Density, LaneAct};
use leptos::portal::Portal;
use leptos::prelude::*;
use protocol::{ChangedMoment, ChangedStream, LaneName, MomentChange, PastChanges};
use robot::Resource;

/// So many streams have a row.
const ROWS_MAX: usize = 12;
/// So many moved moments are told one by one.
const MOVED_MAX: usize = 3;

/// The changes in a table, once something is compared: beside the graph, in a narrow window below the lanes.
#[component]
pub(super) fn Changes(past: PastShared) -> impl IntoView {
    let compare = past.compare;
    let is_there = Memo::new(move |_| compare.is_on.get() && compare.changes.read().is_some());
    let is_narrow = Memo::new(move |_| past.viewer.read().density() == Density::Narrow);
    move || match (is_there.get(), is_narrow.get()) {
        (true, true) => view! { <ChangesTable past /> }.into_any(),
        (true, false) => {
            page_element(".right").map(|mount| view! { <Portal mount><ChangesTable past /></Portal> }).into_any()
        }
        (false, _) => ().into_any(),
    }
}

#[component]
fn ChangesTable(past: PastShared) -> impl IntoView {
    let compare = past.compare;
    let rows = move || {
        let changes = compare.changes.get()?;
        let changed = changes.streams.iter().filter(|one| ChangeCounts::of(one).changes()).take(ROWS_MAX);
        Some(changed.cloned().map(|one| view! { <ChangedRow past one /> }).collect_view())
    };
    let nothing = move || {
        let changes = compare.changes.read();
        changes.as_ref().is_some_and(|all| !all.streams.iter().any(|one| ChangeCounts::of(one).changes()))
    };
    let heading = move || compare.changes.read().as_ref().map(|changes| heading(past, changes));
    let of_when = move || compare.changes.read().as_ref().map(|changes| of_when(past, changes));
    let remarks = move || {
        let changes = compare.changes.get()?;
        let remark = |text| view! { <p class="second">{text}</p> };
        Some(remarks(past, &changes).into_iter().map(remark).collect_view())
    };
    view! {
        <section class="past-changes" class:old=move || compare.is_old.get() aria-label=words::what_would_change()>
            <h2>{heading}</h2>
            <p class="second">{move || if compare.is_old.get() { Some(words::is_of_before().to_owned()) } else { of_when() }}</p>
            <p class="second" hidden=move || !nothing()>{words::nothing_would_change()}</p>
            <table hidden=nothing>
                <caption class="sr">{words::what_would_change()}</caption>
                <thead><tr>
                    <th scope="col">{words::what_differs()}</th><th scope="col">{words::before_name()}</th>
                    <th scope="col">{words::now_version()}</th>
                </tr></thead>
                <tbody>{rows}</tbody>
            </table>
            {remarks}
        </section>
    }
}

/// One stream, and below it how it changes.
#[component]
fn ChangedRow(past: PastShared, one: ChangedStream) -> impl IntoView {
    let mut moved: Vec<String> = Vec::new();
    for told in one.moments.iter().filter_map(moved_words) {
        if !moved.contains(&told) {
            moved.push(told);
        }
    }
    if moved.len() > MOVED_MAX {
        moved.truncate(MOVED_MAX);
        moved.push("…".to_owned());
    }
    let told = words::listed(std::iter::once(ChangeCounts::of(&one).words()).chain(moved));
    let (stream, first_ms) = (one.stream.clone(), one.first_ms);
    let choose = move |_| past.show_change(&stream, first_ms);
    view! {
        <tr>
            <th scope="row"><button class="link" type="button" on:click=choose>{one.name.clone()}</button></th>
            <td>{one.before.to_string()}</td><td><b>{one.now.to_string()}</b></td>
        </tr>
        <tr class="past-how"><td colspan="3">{told}</td></tr>
    }
}

/// Says what happened to a moment that is elsewhere, if it is.
fn moved_words(one: &ChangedMoment) -> Option<String> {
    let MomentChange::MovedTo(_) = one.what else { return None };
    Some(change_words(one.t as f64, dot_change(one, 0.0)))
}

/// The heading: the number that is another one, if it is only one.
fn heading(past: PastShared, changes: &PastChanges) -> String {
    let mut limits = changes.limits.iter().map(|one| (&one.of, one.before, one.now)).collect::<Vec<_>>();
    // Both sides of a condition have the same number.
    limits.dedup();
    let [(of, Some(before), Some(now))] = limits[..] else { return words::what_would_change().to_owned() };
    let kind = filling::kind_of(past, of);
    let plain = crate::live::short_value(&behaviour::Value::Float(now));
    words::now_instead_of(&plain, &filling::number_words(before, kind.as_ref()))
}

/// Says of which time a comparison is.
fn of_when(past: PastShared, changes: &PastChanges) -> String {
    let from_ms = past.opened.read().as_ref().map_or(0, |opened| opened.from_ms);
    if changes.from_ms > from_ms { words::in_last_minutes() } else { words::in_all_of_it() }.to_owned()
}

/// The remarks to a comparison: from when on it is not sure, and what nobody knows.
fn remarks(past: PastShared, changes: &PastChanges) -> Vec<String> {
    let Some(opened) = past.opened.get_untracked() else { return Vec::new() };
    let mut all = vec![words::the_same_readings().to_owned()];
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
    Some((format!("{} → {}", one.before, one.now), ChangeCounts::of(&one).words()))
}

impl PastShared {
    /// Chooses the lane of a stream, and adds it if it is not there; the cursor goes to its first difference.
    fn show_change(self, stream: &str, first_ms: Option<u64>) {
        let name = LaneName { stream: stream.to_owned(), field: None };
        let at =
            self.viewer.with_untracked(|viewer| viewer.lanes().iter().position(|lane| lane.key == filling::key(&name)));
        match at {
            Some(at) => self.act(LaneAct::Choose(at)),
            None => self.add_lane(&name),
        }
        let from_ms = self.opened.with_untracked(|opened| opened.as_ref().map_or(0, |opened| opened.from_ms));
        if let Some(first_ms) = first_ms {
            self.seek(first_ms.saturating_sub(from_ms) as f64);
        }
    }
}
