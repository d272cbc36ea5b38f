//! Lanes while two programs are compared: those that changed first, each with what is not the same, and numbers of conditions.

use super::PastShared;
use super::compare_counts::{ChangeCounts, dot_change, moved_short};
use super::filling::{self, key, lane};
use behaviour::{Id, Params, StreamKind};
use lanes::{ComparedDot, ComparedLane, ComparedLanes, ComparedLimit, DotChange, LaneFilling, LaneKind, ShownLane};
use leptos::prelude::*;
use protocol::{ChangedLimit, ChangedMoment, ChangedStream, LANES_MAX, LaneName, LaneValue, PastChanges, PastStream};
use std::collections::BTreeMap;
use std::sync::Arc;

/// At most so many changed lanes are put first.
const RAISED_MAX: usize = 8;

impl PastShared {
    /// The streams whose moments are asked for: those that changed, then those that are shown.
    pub(super) fn streams_to_compare(self) -> Vec<String> {
        let raised = self.compare.raised.get_value();
        let is_sense = |stream: &String| self.kind_of_stream(stream) == Some(StreamKind::Sensor);
        let mut streams: Vec<String> = Vec::new();
        for stream in raised.iter().map(|key| filling::name(key).stream).filter(|stream| !is_sense(stream)) {
            if !streams.contains(&stream) {
                streams.push(stream);
            }
        }
        self.viewer.with_untracked(|viewer| {
            for lane in viewer.lanes().iter().filter(|lane| lane.kind != LaneKind::Sense) {
                let stream = filling::name(&lane.key).stream;
                if !streams.contains(&stream) {
                    streams.push(stream);
                }
            }
        });
        streams.truncate(LANES_MAX);
        streams
    }

    /// Takes a comparison. True if lanes were added of which nothing was asked.
    pub(super) fn take_comparison(self, changes: PastChanges, asked: &[String]) -> bool {
        self.know_strange_streams(&changes);
        let raises = self.raise(&changes);
        let Some(opened) = self.opened.get_untracked() else { return false };
        let offset = opened.from_ms as f64;
        self.viewer.update(|viewer| {
            let lanes = viewer.lanes().iter().filter(|lane| lane.kind != LaneKind::Sense);
            let compared = lanes.filter_map(|lane| {
                let stream = filling::name(&lane.key).stream;
                let changed = changes.streams.iter().find(|one| one.stream == stream);
                let compared = changed.map_or_else(
                    || ComparedLane { is_complete: true, ..ComparedLane::default() },
                    |changed| self.compared_lane(lane, changed, offset),
                );
                asked.contains(&stream).then(|| (lane.key.clone(), compared))
            });
            let (from, lanes) = (changes.from_ms as f64 - offset, compared.collect());
            viewer.set_compared(Some(ComparedLanes { from, lanes, limits: limits(&changes.limits) }));
        });
        // What is typed meanwhile may be nothing that can be tried.
        let unready = untrack(|| self.desk.desk().document.unready());
        self.compare.is_old.set(unready.is_some());
        self.compare.trouble.set(unready);
        self.compare.changes.set(Some(Arc::new(changes)));
        raises && self.streams_to_compare() != asked
    }

    /// Lanes of streams that the past has not are lanes too.
    fn know_strange_streams(self, changes: &PastChanges) {
        let Some(opened) = self.opened.get_untracked() else { return };
        let document = self.desk.desk().document;
        let is_new = |one: &&ChangedStream| opened.streams.iter().all(|known| known.stream != one.stream);
        let strange: Vec<PastStream> = changes
            .streams
            .iter()
            .filter(is_new)
            .map(|one| {
                let stream = Id::new(&one.stream).ok().and_then(|id| document.stream(&id));
                let stream = stream.map(|stream| stream.record.get_untracked());
                PastStream {
                    stream: one.stream.clone(),
                    name: one.name.clone(),
                    kind: stream.as_ref().map_or(StreamKind::Ordinary, |stream| stream.kind),
                    device: stream.as_ref().and_then(|stream| stream.device.clone()),
                    params: stream.map_or_else(Params::default, |stream| stream.params),
                    count: 0,
                    numbers: false,
                    fields: Vec::new(),
                }
            })
            .collect();
        if strange.is_empty() {
            return;
        }
        self.compare.strange.update_value(|known| known.extend(strange.iter().map(|one| one.stream.clone())));
        let mut opened = (*opened).clone();
        opened.streams.extend(strange);
        self.opened.set(Some(Arc::new(opened)));
    }

    /// Puts the lanes of what changed first, each once. True if there are more than before.
    fn raise(self, changes: &PastChanges) -> bool {
        let Some(opened) = self.opened.get_untracked() else { return false };
        let raised = self.compare.raised.get_value();
        let mut all = raised.clone();
        let limits = changes.limits.iter().map(|limit| key(&limit.of));
        let changed = changes.streams.iter().filter(|one| ChangeCounts::of(one).changes());
        for key in limits.chain(changed.map(|one| one.stream.clone())) {
            if !all.contains(&key) && all.len() < RAISED_MAX {
                all.push(key);
            }
        }
        if all == raised {
            return false;
        }
        self.viewer.update(|viewer| {
            let mut lanes: Vec<ShownLane> = viewer.lanes().to_vec();
            for key in &all {
                let name = filling::name(key);
                let is_there = lanes.iter().any(|lane| lane.key == *key);
                lanes.extend(lane(&opened, &name).filter(|_| !is_there && viewer.lanes().len() < lanes::LANES_MAX));
            }
            viewer.set_lanes(lanes);
            viewer.put_first(&all);
        });
        self.compare.raised.set_value(all);
        true
    }

    fn compared_lane(self, lane: &ShownLane, changed: &ChangedStream, offset: f64) -> ComparedLane {
        let name = filling::name(&lane.key);
        let kind = filling::kind_of(self, &LaneName { field: None, ..name });
        let known: &[lanes::Dot] = match &lane.filling {
            LaneFilling::Values(dots) => dots,
            LaneFilling::Spans(_) => &[],
        };
        let text_at = |t: f64| {
            let at = known.partition_point(|dot| dot.t < t - 0.5);
            known.get(at).filter(|dot| (dot.t - t).abs() < 0.5).map_or_else(|| "".into(), |dot| dot.text.clone())
        };
        // The same bars go on as long as a stretch does that begins with them.
        let until_of = |t: u64| {
            let at = changed.came_before.partition_point(|(from, _)| *from < t);
            changed.came_before.get(at).filter(|(from, _)| *from == t).map_or(t, |(_, until)| *until)
        };
        let same = |t: &u64| {
            let until = until_of(*t) as f64 - offset;
            let t = *t as f64 - offset;
            ComparedDot { t, until, text: text_at(t), change: DotChange::Same }
        };
        let moment = |one: &ChangedMoment| {
            let value = LaneValue { t: one.t, nth: 0, value: one.value.clone(), pretended: false };
            let dot = filling::dot(&value, offset, kind.as_ref());
            let change = dot_change(one, offset);
            let moved = moved_short(dot.t, change);
            let text = if moved.is_empty() { dot.text } else { moved.into() };
            let until = one.until.into_iter().chain(one.until_now).max().unwrap_or(one.t);
            ComparedDot { t: dot.t, until: until as f64 - offset, text, change }
        };
        let mut dots: Vec<ComparedDot> =
            changed.same_ms.iter().map(same).chain(changed.moments.iter().map(moment)).collect();
        dots.sort_by(|one, other| one.t.total_cmp(&other.t));
        // A bar with other numbers is among the same ones too.
        dots.dedup_by(|one, other| {
            let is_twice = one.t == other.t && [one.change, other.change].contains(&DotChange::OtherNumbers);
            if is_twice {
                other.change = DotChange::OtherNumbers;
            }
            is_twice
        });
        let stretches = |all: &[(u64, u64)]| {
            all.iter().map(|(from, until)| (*from as f64 - offset, *until as f64 - offset)).collect()
        };
        ComparedLane {
            dots,
            is_complete: !changed.more && changed.same_ms.len() as u64 == changed.same,
            has_bars: lane.kind == LaneKind::Action
                && changed.came_before.iter().chain(&changed.comes_now).any(|(from, until)| from < until),
            before: stretches(&changed.came_before),
            now: stretches(&changed.comes_now),
        }
    }
}

/// The numbers of conditions by the keys of their lanes.
fn limits(all: &[ChangedLimit]) -> BTreeMap<String, Vec<ComparedLimit>> {
    let mut limits: BTreeMap<String, Vec<ComparedLimit>> = BTreeMap::new();
    for ChangedLimit { of, before, now, .. } in all {
        let limit = ComparedLimit { before: *before, now: *now };
        let of = limits.entry(key(of)).or_default();
        // Each side of a condition has the same number.
        if !of.contains(&limit) {
            of.push(limit);
        }
    }
    limits
}
