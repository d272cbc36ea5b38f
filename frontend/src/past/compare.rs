//! *Compare*: what the edited program, or another revision of it, would have done with the readings of this past. While it is
//! on, every edit asks again, one's own before it is saved as well: the newest is asked, and one question is under way.

use super::PastShared;
use super::compare_counts::ChangeCounts;
use crate::desk::{DraftPreview, LinkState};
use crate::link::NoAnswer;
use crate::parts::Soon;
use crate::past::words;
use behaviour::StreamKind;
use leptos::prelude::*;
use protocol::{
    ChangedStream, EditedProgram, NotSeen, OpenedPast, PastAnswer, PastChanges, PastOf, PastQuestion, Refused, request,
};
use std::sync::Arc;

/// The last so many milliseconds of what runs are compared.
const LIVE_MS: u64 = 120_000;
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

/// The comparison: its two programs, and what came of it.
#[derive(Clone, Copy)]
pub(super) struct CompareState {
    pub(super) is_on: RwSignal<bool>,
    pub(super) form: RwSignal<CompareForm>,
    pub(super) changes: RwSignal<Option<Arc<PastChanges>>>,
    /// The reason why there is no comparison, or none of what is typed just now.
    pub(super) trouble: RwSignal<Option<String>>,
    /// True if what is shown is of before, as nothing can be made of what is typed just now.
    pub(super) is_old: RwSignal<bool>,
    /// The counts for screen readers, said now and then.
    pub(super) said: RwSignal<String>,
    wish: StoredValue<NewestWish>,
    /// True if all of it takes too long, so that only its last minutes are compared.
    is_short: StoredValue<bool>,
    /// The lanes as they stood before, by their keys.
    order: StoredValue<Vec<String>>,
    /// The changed lanes that were put first, by their keys.
    pub(super) raised: StoredValue<Vec<String>>,
    /// The streams that only one of both programs has, and the past has not.
    pub(super) strange: StoredValue<Vec<String>>,
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
            is_old: RwSignal::new(false),
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
        self.is_old.set(false);
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
        compare.is_old.set(false);
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
                untrack(|| match desk.document.unready() {
                    Some(why) => self.old_comparison(why),
                    None => self.want_comparison(),
                });
            }
        });
        self.preview_drafts();
        Effect::new(move |_| {
            let compare = self.compare;
            compare.changes.track();
            compare.trouble.track();
            if compare.is_on.get() {
                say.with_value(|say| say.within(SAY_MS));
            }
        });
    }

    /// Tells where something is typed what would come of it.
    fn preview_drafts(self) {
        let previewed = self.desk.desk().document.previewed.clone();
        let show = {
            let previewed = previewed.clone();
            move |preview: Option<DraftPreview>| {
                if previewed.with_untracked(|before| *before != preview) {
                    previewed.set(preview);
                }
            }
        };
        Effect::new(move |_| {
            let is_typed = self.desk.desk().document.drafted.read().is_some();
            let text = (is_typed && self.compare.is_on.get()).then(|| self.compared_words());
            let is_old = self.compare.trouble.read().is_some();
            show(text.filter(|text| !text.is_empty()).map(|text| DraftPreview { text, is_old }));
        });
        on_cleanup(move || previewed.set(None));
    }

    /// The sum of what changes in words, or why there is none. Reactive.
    fn compared_words(self) -> String {
        if !self.compare.is_on.get() {
            return String::new();
        }
        if let Some(why) = self.compare.trouble.get() {
            return why;
        }
        let Some((counts, _)) = self.sum_of_changes() else { return String::new() };
        if counts.changes() { counts.words() } else { words::nothing_would_change().to_owned() }
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

    pub(super) fn kind_of_stream(self, stream: &str) -> Option<StreamKind> {
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
            Err(NoAnswer::Refused(no @ Refused::NotSeen(NotSeen::CannotCompare(..)))) => {
                self.old_comparison(words::told_by(&no));
                false
            }
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
        self.compare.is_old.set(false);
        self.compare.trouble.set(Some(why));
    }

    /// Nothing can be made of what is typed just now: what was shown stays, marked as of before.
    fn old_comparison(self, why: String) {
        self.compare.is_old.set(self.compare.changes.with_untracked(Option::is_some));
        self.compare.trouble.set(Some(why));
    }

    /// The question, if there is a program to compare with.
    fn comparison(self, opened: &OpenedPast, streams: Vec<String>) -> Option<PastQuestion> {
        let document = self.desk.desk().document;
        let behaviour = document.open.get_untracked()?;
        let program = |revision| EditedProgram { behaviour: behaviour.clone(), revision, change: None, helper: None };
        let as_it_is = || {
            let (change, helper) = (document.unsaved().map(Box::new), document.unsaved_helper());
            EditedProgram { change, helper, ..program(None) }
        };
        let at = |revision| program(Some(revision));
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
}

#[cfg(test)]
mod tests {
    use super::NewestWish;

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
}
