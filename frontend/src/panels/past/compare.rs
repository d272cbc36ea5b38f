//! *Compare*: what the edited program, or another revision of it, would have done with the readings of this past. While it is
//! on, every edit asks again, one's own before it is saved as well: the newest is asked, and one question is under way.

use super::PastShared;
use super::filling::{self, key, lane};
use crate::desk::LinkState;
use crate::link::NoAnswer;
use crate::panels::hold::Soon;
use crate::words;
use behaviour::{Id, Params, StreamKind};
use lanes::{ComparedDot, ComparedLane, ComparedLanes, DotChange, LaneFilling, LaneKind, ShownLane};
use leptos::prelude::*;
use protocol::{
    ChangedMoment, ChangedStream, EditedProgram, LANES_MAX, LaneName, LaneValue, MomentChange, NotSeen, OpenedPast,
    PastAnswer, PastChanges, PastOf, PastQuestion, PastStream, Refused, request,
};
use std::sync::Arc;

/// The last so many milliseconds of what runs are compared.
const LIVE_MS: u64 = 120_000;
/// At most so many changed lanes are put first.
const RAISED_MAX: usize = 8;
/// The counts are said at most once in so many milliseconds.
const SAY_MS: i32 = 1_000;

/// The two programs that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CompareForm {
    /// The program that ran, with the open program as it is now.
    Edits,
    /// Two revisions of the open program; no second one means as it is now.
    Revisions { before: u64, now: Option<u64> },
}

/// A wish of which only the newest counts: one question is under way, and the next is asked once that is answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct NewestWish {
    is_busy: bool,
    is_wanted: bool,
}

impl NewestWish {
    /// Something else is wanted. True if it is asked now.
    pub(super) fn want(&mut self) -> bool {
        self.is_wanted = self.is_busy;
        !std::mem::replace(&mut self.is_busy, true)
    }

    /// The question under way is answered. True if the next is asked now.
    pub(super) fn answered(&mut self) -> bool {
        self.is_busy = std::mem::take(&mut self.is_wanted);
        self.is_busy
    }
}

/// The numbers of moments of streams that are the same, and that are not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ChangeCounts {
    pub(super) same: u64,
    pub(super) only_now: u64,
    pub(super) only_before: u64,
    pub(super) moved: u64,
}

impl ChangeCounts {
    pub(super) fn of(stream: &ChangedStream) -> Self {
        let both = stream.same + stream.moved;
        Self {
            same: stream.same,
            only_now: stream.now.saturating_sub(both),
            only_before: stream.before.saturating_sub(both),
            moved: stream.moved,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            same: self.same + other.same,
            only_now: self.only_now + other.only_now,
            only_before: self.only_before + other.only_before,
            moved: self.moved + other.moved,
        }
    }

    /// True if anything is not the same.
    pub(super) fn changes(self) -> bool {
        self.only_now + self.only_before + self.moved > 0
    }
}

/// The comparison: its two programs, and what came of it.
#[derive(Clone, Copy)]
pub(super) struct CompareState {
    pub(super) is_on: RwSignal<bool>,
    pub(super) form: RwSignal<CompareForm>,
    pub(super) changes: RwSignal<Option<Arc<PastChanges>>>,
    /// Why there is no comparison.
    pub(super) trouble: RwSignal<Option<String>>,
    /// The counts for screen readers, said now and then.
    pub(super) said: RwSignal<String>,
    wish: StoredValue<NewestWish>,
    /// True if all of it takes too long, so that only its last minutes are compared.
    is_short: StoredValue<bool>,
    /// The lanes as they stood before, by their keys.
    order: StoredValue<Vec<String>>,
    /// The changed lanes that were put first.
    raised: StoredValue<Vec<String>>,
    /// The streams that only one of both programs has, and the past has not.
    strange: StoredValue<Vec<String>>,
    /// Moves while the past goes on.
    later: RwSignal<u32>,
}

impl CompareState {
    pub(super) fn new() -> Self {
        Self {
            is_on: RwSignal::new(false),
            form: RwSignal::new(CompareForm::Edits),
            changes: RwSignal::new(None),
            trouble: RwSignal::new(None),
            said: RwSignal::new(String::new()),
            wish: StoredValue::default(),
            is_short: StoredValue::new(false),
            order: StoredValue::default(),
            raised: StoredValue::default(),
            strange: StoredValue::default(),
            later: RwSignal::new(0),
        }
    }

    /// Forgets what was asked of a past.
    pub(super) fn forget(self) {
        self.wish.set_value(NewestWish::default());
        self.changes.set(None);
        self.trouble.set(None);
    }

    /// The past is longer than before.
    pub(super) fn goes_on(self) {
        if self.is_on.get_untracked() {
            self.later.update(|later| *later = later.wrapping_add(1));
        }
    }

    /// True if the past has no such stream, so that nothing can be asked of it.
    pub(super) fn is_strange(self, stream: &str) -> bool {
        self.strange.with_value(|strange| strange.iter().any(|one| one == stream))
    }

    /// The changes of a stream, once they are known. Reactive.
    pub(super) fn of(self, stream: &str) -> Option<ChangedStream> {
        let changes = self.changes.read();
        changes.as_ref()?.streams.iter().find(|one| one.stream == stream).cloned()
    }
}

impl PastShared {
    /// Begins to compare, or ends it.
    pub(super) fn toggle_compare(self) {
        let compare = self.compare;
        if compare.is_on.get_untracked() {
            compare.is_on.set(false);
            return self.end_compare();
        }
        let order = self.viewer.with_untracked(|viewer| viewer.lanes().iter().map(|lane| lane.key.clone()).collect());
        compare.order.set_value(order);
        compare.raised.set_value(Vec::new());
        compare.is_short.set_value(false);
        compare.trouble.set(None);
        compare.is_on.set(true);
        self.show_whole_graph();
    }

    /// Shows the lanes as they were.
    fn end_compare(self) {
        let (compare, strange) = (self.compare, self.compare.strange.get_value());
        let order = compare.order.get_value();
        // The past itself has no such streams, and nothing can be asked about them.
        if !strange.is_empty() {
            self.opened.update(|opened| {
                if let Some(opened) = opened {
                    Arc::make_mut(opened).streams.retain(|one| !strange.contains(&one.stream));
                }
            });
        }
        self.viewer.update(|viewer| {
            viewer.set_compared(None);
            for stream in &strange {
                if let Some(at) = viewer.lanes().iter().position(|lane| lane.key == *stream) {
                    viewer.remove_lane(at);
                }
            }
            viewer.put_first(&order);
        });
        compare.strange.set_value(Vec::new());
        compare.changes.set(None);
        compare.trouble.set(None);
    }

    /// Another form of comparison.
    pub(super) fn compare_form(self, form: CompareForm) {
        self.compare.is_short.set_value(false);
        self.compare.form.set(form);
    }

    /// The two revisions that are offered first: the one that ran, if it is known, and how it is now.
    pub(super) fn first_revisions(self) -> CompareForm {
        let document = self.desk.desk().document;
        let (newest, open) = (document.revision.get_untracked(), document.open.get_untracked());
        let opened = self.opened.get_untracked();
        let opened = opened.filter(|opened| open.is_some_and(|open| open.as_str() == opened.behaviour));
        let ran = opened.and_then(|opened| opened.programs.last().map(|program| program.revision));
        let before = ran.filter(|ran| (1..newest).contains(ran)).unwrap_or(newest.saturating_sub(1).max(1));
        CompareForm::Revisions { before, now: None }
    }

    /// Asks whenever something else would come of it, while it is on.
    pub(super) fn compare_when_changed(self) {
        let is_there = Memo::new(move |_| self.opened.read().is_some());
        let say = StoredValue::new_local(Soon::new(move || {
            if !self.is_gone() {
                self.compare.said.set(untrack(|| self.compared_words()));
            }
        }));
        Effect::new(move |_| {
            let (desk, compare) = (self.desk.desk(), self.compare);
            let is_online = desk.online.get() == LinkState::Online;
            desk.document.open.track();
            desk.document.edited.track();
            desk.document.fingerprint.track();
            desk.document.drafted.track();
            compare.form.track();
            compare.later.track();
            if compare.is_on.get() && is_there.get() && is_online {
                untrack(|| self.want_comparison());
            }
        });
        Effect::new(move |_| {
            let compare = self.compare;
            compare.changes.track();
            compare.trouble.track();
            if compare.is_on.get() {
                say.with_value(|say| say.within(SAY_MS));
            }
        });
    }

    /// The sum of what changes in words, for who does not see it. Reactive.
    fn compared_words(self) -> String {
        if !self.compare.is_on.get() {
            return String::new();
        }
        let Some((counts, _)) = self.sum_of_changes() else { return String::new() };
        words::counted_changes(counts.same, counts.only_now, counts.only_before, counts.moved)
    }

    /// The counts of all actions together, or of all streams where no action did anything; and these actions. Reactive.
    pub(super) fn sum_of_changes(self) -> Option<(ChangeCounts, Vec<ChangedStream>)> {
        let changes = self.compare.changes.get()?;
        let is_action = |one: &&ChangedStream| self.kind_of_stream(&one.stream) == Some(StreamKind::Actuator);
        let actions: Vec<ChangedStream> = changes.streams.iter().filter(is_action).cloned().collect();
        let counted = if actions.is_empty() { &changes.streams } else { &actions };
        let sum = counted.iter().map(ChangeCounts::of).fold(ChangeCounts::default(), ChangeCounts::and);
        Some((sum, actions))
    }

    /// The streams that change. Reactive.
    pub(super) fn changed_streams(self) -> Vec<String> {
        let changes = self.compare.changes.read();
        let streams = changes.as_ref().map_or(&[][..], |changes| &changes.streams);
        streams.iter().filter(|one| ChangeCounts::of(one).changes()).map(|one| one.stream.clone()).collect()
    }

    fn kind_of_stream(self, stream: &str) -> Option<StreamKind> {
        let opened = self.opened.get_untracked()?;
        opened.streams.iter().find(|one| one.stream == stream).map(|one| one.kind)
    }

    fn want_comparison(self) {
        if self.compare.wish.try_update_value(NewestWish::want) == Some(true) {
            self.ask_comparison();
        }
    }

    fn ask_comparison(self) {
        let (compare, asked) = (self.compare, self.streams_to_compare());
        let question = self.opened.get_untracked().and_then(|opened| self.comparison(&opened, asked.clone()));
        let (Some(question), Some(past)) = (question, self.of.get_value()) else {
            compare.wish.update_value(|wish| *wish = NewestWish::default());
            return self.no_comparison(words::open_to_compare().to_owned());
        };
        let form = compare.form.get_untracked();
        let request = request::LookBack { past: past.clone(), question: Box::new(question) };
        self.desk.desk().look_up(request, move |answer| {
            if self.is_gone() || self.of.with_value(|of| of.as_ref() != Some(&past)) {
                return;
            }
            let mut again = compare.wish.try_update_value(NewestWish::answered) == Some(true);
            if !compare.is_on.get_untracked() {
                return compare.wish.set_value(NewestWish::default());
            }
            if form == compare.form.get_untracked() {
                again |= self.hear_comparison(answer.map(|answer| answer.answer), &asked);
            }
            if again {
                compare.wish.update_value(|wish| wish.is_busy = true);
                self.ask_comparison();
            }
        });
    }

    /// Shows what was answered. True if something more has to be asked at once.
    fn hear_comparison(self, answer: Result<String, NoAnswer>, asked: &[String]) -> bool {
        match answer {
            Ok(answer) => match crate::json::read::<PastAnswer>(&answer) {
                Ok(PastAnswer::Changes(changes)) => self.take_comparison(*changes, asked),
                Ok(_) | Err(_) => false,
            },
            Err(NoAnswer::Refused(Refused::NotSeen(NotSeen::TooLong))) if !self.compare.is_short.get_value() => {
                self.compare.is_short.set_value(true);
                true
            }
            Err(NoAnswer::Refused(Refused::NotSeen(NotSeen::Newer))) => true,
            Err(NoAnswer::Refused(no)) => {
                self.no_comparison(words::told_by(&no));
                false
            }
            Err(NoAnswer::Unreachable) => {
                self.no_comparison(words::unreachable().to_owned());
                false
            }
        }
    }

    /// Nothing that is not so any more stays drawn.
    fn no_comparison(self, why: String) {
        self.viewer.update(|viewer| viewer.set_compared(None));
        self.compare.changes.set(None);
        self.compare.trouble.set(Some(why));
    }

    /// The question, if there is a program to compare with.
    fn comparison(self, opened: &OpenedPast, streams: Vec<String>) -> Option<PastQuestion> {
        let document = self.desk.desk().document;
        let behaviour = document.open.get_untracked()?;
        let as_it_is =
            || EditedProgram { behaviour: behaviour.clone(), revision: None, change: document.unsaved().map(Box::new) };
        let at = |revision| EditedProgram { behaviour: behaviour.clone(), revision: Some(revision), change: None };
        let (before, now) = match self.compare.form.get_untracked() {
            CompareForm::Edits => (None, as_it_is()),
            CompareForm::Revisions { before, now } => (Some(at(before)), now.map_or_else(as_it_is, at)),
        };
        let is_live = matches!(self.of.get_value(), Some(PastOf::Run(_)));
        let is_short = is_live || self.compare.is_short.get_value();
        let length = self.viewer.with_untracked(|viewer| viewer.axis().length()) as u64;
        let from_ms = is_short.then(|| opened.from_ms + length.saturating_sub(LIVE_MS));
        Some(PastQuestion::Compare { before, now, from_ms, streams })
    }

    /// The streams whose moments are asked for: those that changed, then those that are shown.
    fn streams_to_compare(self) -> Vec<String> {
        let mut streams: Vec<String> = self.compare.raised.get_value();
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
    fn take_comparison(self, changes: PastChanges, asked: &[String]) -> bool {
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
            viewer.set_compared(Some(ComparedLanes { from, lanes }));
        });
        self.compare.trouble.set(None);
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
        for one in changes.streams.iter().filter(|one| ChangeCounts::of(one).changes()) {
            if !all.contains(&one.stream) && all.len() < RAISED_MAX {
                all.push(one.stream.clone());
            }
        }
        if all == raised {
            return false;
        }
        self.viewer.update(|viewer| {
            let mut lanes: Vec<ShownLane> = viewer.lanes().to_vec();
            for stream in &all {
                let name = LaneName { stream: stream.clone(), field: None };
                let is_there = lanes.iter().any(|lane| lane.key == key(&name));
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
        let same = |t: &u64| {
            let t = *t as f64 - offset;
            ComparedDot { t, text: text_at(t), change: DotChange::Same }
        };
        let moment = |one: &ChangedMoment| {
            let value = LaneValue { t: one.t, nth: 0, value: one.value.clone(), pretended: false };
            let dot = filling::dot(&value, offset, kind.as_ref());
            let (change, text) = match one.what {
                MomentChange::OnlyNow => (DotChange::OnlyNow, dot.text),
                MomentChange::OnlyBefore => (DotChange::OnlyBefore, dot.text),
                MomentChange::MovedTo(to) => {
                    (DotChange::MovedTo(to as f64 - offset), words::moved_by(one.t.abs_diff(to)).into())
                }
            };
            ComparedDot { t: dot.t, text, change }
        };
        let mut dots: Vec<ComparedDot> =
            changed.same_ms.iter().map(same).chain(changed.moments.iter().map(moment)).collect();
        dots.sort_by(|one, other| one.t.total_cmp(&other.t));
        let stretches = |all: &[(u64, u64)]| {
            all.iter().map(|(from, until)| (*from as f64 - offset, *until as f64 - offset)).collect()
        };
        ComparedLane {
            dots,
            is_complete: !changed.more && changed.same_ms.len() as u64 == changed.same,
            before: stretches(&changed.came_before),
            now: stretches(&changed.comes_now),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ChangeCounts, NewestWish};
    use protocol::ChangedStream;

    #[test]
    fn one_is_asked_at_a_time_and_only_the_newest_after_it() {
        let mut wish = NewestWish::default();
        assert!(wish.want(), "nothing is under way");
        let asked = (0..50).filter(|_| wish.want()).count();
        assert_eq!(asked, 0, "one is under way");
        assert!(wish.answered(), "all fifty are one question");
        assert!(!wish.answered(), "and that was the newest");
        assert!(wish.want() && !wish.answered(), "what comes later is asked again");
    }

    #[test]
    fn every_moment_is_counted_once() {
        let stream = ChangedStream { before: 19, now: 20, same: 15, moved: 2, ..ChangedStream::default() };
        let counts = ChangeCounts::of(&stream);
        assert_eq!(counts, ChangeCounts { same: 15, only_now: 3, only_before: 2, moved: 2 });
        assert!(counts.changes() && counts.and(counts).moved == 4);
        let same = ChangedStream { before: 19, now: 19, same: 19, ..ChangedStream::default() };
        assert!(!ChangeCounts::of(&same).changes());
    }
}
