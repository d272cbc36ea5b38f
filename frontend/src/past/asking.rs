//! Asking the server for a past: what there is, all of it coarsely, what is seen finely, and each value around the cursor. One
//! question is under way at a time; what is wanted by then is asked next.

use super::filling::{dot, filling, first_lanes, key, kind_of, lane, marks, name, stream};
use super::{PastShared, clock};
use crate::browser;
use crate::desk::OpenPast;
use crate::link::NoAnswer;
use crate::past::words;
use behaviour::Id;
use lanes::{LaneAct, LaneFilling, Viewer};
use leptos::prelude::*;
use protocol::{
    LANE_COLUMNS_MAX, LANES_MAX, LaneName, LaneValues, OpenedPast, PastAnswer, PastOf, PastQuestion, request,
};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

/// The columns of a lane of which all is asked.
const WHOLE_COLUMNS: usize = LANE_COLUMNS_MAX / LANES_MAX;
/// The most columns of a lane of which a stretch is asked: a little more than a screen has.
const SEEN_COLUMNS: usize = LANE_COLUMNS_MAX / 3;
/// The part of what is seen that is asked for besides, on each side.
const BESIDE: f64 = 0.25;
/// The number of values that are asked for around the cursor.
const NEAR_VALUES: f64 = 60.0;
/// The least of it that is asked for; where so many values came at once, none is told one by one.
const NEAR_SHARE_LEAST: f64 = 1e-5;
/// The time between two looks at a run that goes on.
const LIVE_EVERY: Duration = Duration::from_millis(1_000);
/// All of a run that goes on is asked for again after so many looks.
const WHOLE_AGAIN: u32 = 10;

/// The questions that a past was asked, and the answers.
#[derive(Default)]
pub(super) struct AskedLanes {
    is_busy: bool,
    /// All of each lane, by its key.
    whole: BTreeMap<String, LaneFilling>,
    /// The lanes whose stretch is known finely, and the stretch.
    seen: Option<(Vec<String>, (f64, f64))>,
    /// The part of a run that goes on which has to be asked again.
    is_stale: bool,
    /// The share of the usual time around the cursor that is asked for: less where many values came at once.
    near_share: f64,
    /// The time of the page at which it was opened.
    opened_ms: f64,
    looks: u32,
}

/// A next question, and what becomes of its answer.
enum NextQuestion {
    Whole(Vec<LaneName>),
    Seen(Vec<LaneName>, (f64, f64)),
    Near(LaneName, (f64, f64)),
}

impl PastShared {
    /// Opens a past.
    pub(super) fn open(self, of: Option<PastOf>) {
        let Some(of) = of else { return self.trouble.set(Some(words::no_past_yet().to_owned())) };
        if self.of.with_value(|before| before.as_ref() != Some(&of)) {
            self.leave_past();
        }
        self.of.set_value(Some(of));
        self.ask(PastQuestion::Open, move |answer| {
            if let Some(PastAnswer::Opened(opened)) = answer {
                self.show(*opened.clone());
            }
        });
    }

    /// Forgets all of the past that was looked at: nothing of it gets into the next one.
    fn leave_past(self) {
        if self.compare.is_on.get_untracked() {
            self.toggle_compare();
        }
        self.compare.forget();
        self.then.forget();
        self.asked.set_value(AskedLanes::default());
        self.opened.set(None);
    }

    /// The link is back: lanes that were not answered meanwhile are asked for again, and so is the moment.
    pub(super) fn ask_again(self) {
        self.asked.update_value(|asked| {
            asked.whole.clear();
            asked.seen = None;
        });
        self.fetch();
        self.show_moment_again();
    }

    /// Shows what was opened.
    fn show(self, opened: OpenedPast) {
        let (length, began) = ((opened.until_ms - opened.from_ms) as f64, clock::began_of_day(&opened));
        let is_live = opened.goes_on && matches!(self.of.get_value(), Some(PastOf::Run(_)));
        let lanes = first_lanes(&opened).iter().filter_map(|name| lane(&opened, name)).collect();
        let shown = marks(&opened);
        self.asked.update_value(|asked| {
            *asked = AskedLanes { near_share: 1.0, opened_ms: browser::now_ms(), ..AskedLanes::default() };
        });
        let density = self.viewer.with_untracked(Viewer::density);
        self.viewer.update(|viewer| {
            *viewer = if is_live { Viewer::live(length, began) } else { Viewer::recorded(length, began) };
            viewer.set_density(density);
            viewer.set_lanes(lanes);
            viewer.set_marks(shown);
        });
        let id = Id::new(&opened.behaviour).ok();
        self.opened.set(Some(Arc::new(opened)));
        // Whoever comes by an address with nothing open sees the program of which it is, as it is today.
        let desk = self.desk.desk();
        let is_kept = |id: &Id| desk.library.programs.with_untracked(|all| all.iter().any(|one| one.id == id.as_str()));
        if let Some(id) = id.filter(|id| desk.document.open.with_untracked(Option::is_none) && is_kept(id)) {
            desk.document.open_program(&id);
        }
        self.add_wanted();
        if is_live {
            self.go_on();
        }
    }

    /// Adds the lane of the stream that somebody pressed, and chooses it.
    pub(super) fn add_wanted(self) {
        let wanted = self.desk.desk().past.get_untracked();
        let (Some(OpenPast::Running(Some(id))), Some(opened)) = (wanted, self.opened.get_untracked()) else { return };
        let plain = LaneName { stream: id.to_string(), field: None };
        let Some(of) = stream(&opened, &plain) else { return };
        let field = super::filling::telling(of).filter(|_| !of.numbers);
        self.add_lane(&LaneName { field, ..plain });
    }

    /// Adds a lane and chooses it.
    pub(super) fn add_lane(self, name: &LaneName) {
        let Some(lane) = self.opened.get_untracked().and_then(|opened| lane(&opened, name)) else { return };
        let mut has_room = true;
        self.viewer.update(|viewer| has_room = viewer.add_lane(lane));
        if !has_room {
            self.trouble.set(Some(words::too_many_lanes().to_owned()));
        }
    }

    /// Asks for what is seen whenever something else is.
    pub(super) fn fetch_what_is_seen(self) {
        Effect::new(move |_| {
            self.viewer.track();
            self.width.track();
            untrack(|| self.fetch());
        });
    }

    /// A run that goes on is longer every second.
    fn go_on(self) {
        if let Some(before) = self.looking.get_value() {
            before.clear();
        }
        let look = move || {
            if self.is_gone() {
                return;
            }
            let is_running = self.running() == self.of.get_value();
            let Some(opened) = self.opened.get_untracked().filter(|_| is_running) else { return };
            let mut since = 0.0;
            self.asked.update_value(|asked| {
                since = browser::now_ms() - asked.opened_ms;
                asked.is_stale = true;
                asked.looks += 1;
                if asked.looks.is_multiple_of(WHOLE_AGAIN) {
                    asked.whole.clear();
                }
            });
            self.viewer.update(|viewer| viewer.grow((opened.until_ms - opened.from_ms) as f64 + since));
            self.compare.goes_on();
        };
        if let Ok(handle) = set_interval(look, LIVE_EVERY) {
            self.looking.set_value(Some(handle));
        }
    }

    /// Asks the next question, if there is one and none is under way.
    fn fetch(self) {
        let Some(opened) = self.opened.get_untracked() else { return };
        if self.asked.with_value(|asked| asked.is_busy) {
            return;
        }
        self.show_whole_where_unseen();
        let Some(next) = self.next(&opened) else { return };
        let (names, (from, to), columns) = match &next {
            NextQuestion::Whole(names) => {
                (names.clone(), (0.0, self.viewer.with_untracked(|viewer| viewer.axis().length())), WHOLE_COLUMNS)
            }
            NextQuestion::Seen(names, range) => {
                let wanted = (self.width.get_untracked() * (1.0 + 2.0 * BESIDE)) as usize;
                (names.clone(), *range, wanted.clamp(64, SEEN_COLUMNS))
            }
            NextQuestion::Near(name, range) => (vec![name.clone()], *range, 1),
        };
        self.asked.update_value(|asked| asked.is_busy = true);
        let range = (from.floor().max(0.0), to.ceil() + 1.0);
        let offset = opened.from_ms;
        let question = PastQuestion::Lanes {
            lanes: names,
            from_ms: range.0 as u64 + offset,
            to_ms: range.1 as u64 + offset,
            columns,
        };
        self.ask(question, move |answer| {
            self.asked.update_value(|asked| asked.is_busy = false);
            let lanes = match answer {
                Some(PastAnswer::Lanes(lanes)) => lanes.as_slice(),
                _ => &[],
            };
            self.take(&next, lanes, range, (columns, offset as f64));
            self.fetch();
        });
    }

    /// Shows all of it coarsely where most of what is seen is not known finely.
    fn show_whole_where_unseen(self) {
        let axis = self.viewer.with_untracked(|viewer| *viewer.axis());
        let is_unseen = |(_, (from, to)): &(Vec<String>, (f64, f64))| {
            to.min(axis.end()) - from.max(axis.begin()) < axis.span() / 2.0 || to - from > 4.0 * axis.span()
        };
        let mut shows = false;
        self.asked.update_value(|asked| {
            shows = asked.seen.as_ref().is_some_and(is_unseen);
            asked.seen = asked.seen.take().filter(|_| !shows);
        });
        if shows {
            self.fill_whole();
        }
    }

    fn fill_whole(self) {
        self.viewer.update(|viewer| {
            self.asked.with_value(|asked| {
                asked.whole.iter().for_each(|(key, filling)| viewer.fill(key, filling.clone()));
            });
        });
    }

    /// The next question.
    fn next(self, opened: &OpenedPast) -> Option<NextQuestion> {
        let (keys, axis, chosen) = self.viewer.with_untracked(|viewer| {
            let is_known = |key: &String| !self.compare.is_strange(&name(key).stream);
            let keys: Vec<String> = viewer.lanes().iter().map(|lane| lane.key.clone()).filter(is_known).collect();
            (keys, *viewer.axis(), viewer.chosen().map(|lane| lane.key.clone()))
        });
        self.asked.with_value(|asked| {
            let unknown = keys.iter().filter(|key| !asked.whole.contains_key(*key));
            let unknown: Vec<LaneName> = unknown.take(LANES_MAX).map(|key| name(key)).collect();
            if !unknown.is_empty() {
                return Some(NextQuestion::Whole(unknown));
            }
            let coarse = |key: &&String| asked.is_stale || matches!(asked.whole.get(*key), Some(LaneFilling::Spans(_)));
            let seen = |key: &&String| {
                let known = asked.seen.as_ref().filter(|(keys, _)| keys.contains(key) && !asked.is_stale);
                known.is_some_and(|(_, (from, to))| *from <= axis.begin() && axis.end() <= *to)
            };
            let per_question = (LANE_COLUMNS_MAX / SEEN_COLUMNS).min(LANES_MAX);
            let unseen = keys.iter().filter(coarse).filter(|key| !seen(key));
            let unseen: Vec<LaneName> = unseen.take(per_question).map(|key| name(key)).collect();
            if !unseen.is_empty() && self.width.get_untracked() > 0.0 {
                let beside = axis.span() * BESIDE;
                return Some(NextQuestion::Seen(
                    unseen,
                    (axis.begin() - beside, (axis.end() + beside).min(axis.length())),
                ));
            }
            let chosen = chosen.filter(|key| matches!(asked.whole.get(key), Some(LaneFilling::Spans(_))))?;
            self.near(opened, &name(&chosen), asked.near_share)
        })
    }

    /// The values around the cursor that are not known one by one.
    fn near(self, opened: &OpenedPast, chosen: &LaneName, share: f64) -> Option<NextQuestion> {
        let count = stream(opened, chosen)?.count.max(1) as f64;
        let (cursor, length, known) =
            self.viewer.with_untracked(|viewer| (viewer.cursor(), viewer.axis().length(), viewer.near()));
        let half = (length / count * NEAR_VALUES / 2.0 * share).max(1.0);
        let (from, until) = ((cursor - half).max(0.0), (cursor + half).min(length));
        let is_known = known.is_some_and(|(begin, end)| {
            let inner = half / 2.0;
            begin <= (cursor - inner).max(0.0).floor() && (cursor + inner).min(length).ceil() <= end
        });
        (!is_known).then(|| NextQuestion::Near(chosen.clone(), (from, until)))
    }

    /// Takes what was answered; what was not answered is not asked again until something else is wanted.
    fn take(
        self,
        asked: &NextQuestion,
        lanes: &[protocol::PastLane],
        range: (f64, f64),
        (columns, offset): (usize, f64),
    ) {
        let filled = |lane: &protocol::PastLane| {
            let kind = kind_of(self, &lane.name);
            (key(&lane.name), filling(&lane.values, range, (columns, offset), kind.as_ref()))
        };
        match asked {
            NextQuestion::Whole(names) => self.take_whole(names, lanes.iter().map(filled).collect()),
            NextQuestion::Seen(names, range) => {
                let keys: Vec<String> = names.iter().map(key).collect();
                self.asked.update_value(|asked| {
                    let same = asked.seen.as_ref().filter(|(_, known)| known == range && !asked.is_stale);
                    let before = same.map(|(keys, _)| keys.clone()).unwrap_or_default();
                    asked.seen = Some(([before, keys].concat(), *range));
                    asked.is_stale = false;
                });
                self.viewer.update(|viewer| {
                    lanes.iter().map(filled).for_each(|(key, filling)| viewer.fill(&key, filling));
                });
            }
            NextQuestion::Near(name, (from, until)) => {
                let kind = kind_of(self, name);
                let dots = lanes.first().map(|lane| match &lane.values {
                    LaneValues::Each(values) => values.iter().map(|value| dot(value, offset, kind.as_ref())).collect(),
                    LaneValues::Columns(_) => Vec::new(),
                });
                let too_many = matches!(lanes.first().map(|lane| &lane.values), Some(LaneValues::Columns(_)));
                let share = self.asked.with_value(|asked| asked.near_share);
                if too_many && share > NEAR_SHARE_LEAST {
                    self.asked.update_value(|asked| asked.near_share = share / 8.0);
                } else {
                    self.viewer.update(|viewer| {
                        viewer.set_near(&key(name), (from.floor(), until.ceil()), dots.unwrap_or_default());
                    });
                }
            }
        }
    }

    /// Takes all of some lanes, and the overview from them.
    fn take_whole(self, names: &[LaneName], lanes: Vec<(String, LaneFilling)>) {
        self.asked.update_value(|asked| {
            let empty = names.iter().map(|name| (key(name), LaneFilling::Values(Vec::new())));
            asked.whole.extend(empty.collect::<Vec<_>>());
            asked.whole.extend(lanes);
            asked.seen = None;
        });
        self.fill_whole();
        self.viewer.update(Viewer::keep_overview);
    }

    /// Asks; the answer is none if it is a no, which is told, or if the link is down.
    pub(super) fn ask(self, question: PastQuestion, then: impl FnOnce(Option<&PastAnswer>) + 'static) {
        let Some(past) = self.of.get_value() else { return };
        let request = request::LookBack { past: past.clone(), question: Box::new(question) };
        self.desk.desk().look_up(request, move |answer| {
            if self.is_gone() || self.of.with_value(|of| of.as_ref() != Some(&past)) {
                return;
            }
            match answer {
                Ok(answer) => {
                    self.trouble.set(None);
                    then(crate::json::read(&answer.answer).ok().as_ref());
                }
                Err(why) => {
                    self.trouble.set(Some(match why {
                        NoAnswer::Refused(no) => words::told_by(&no),
                        NoAnswer::Unreachable => words::unreachable().to_owned(),
                    }));
                    then(None);
                }
            }
        });
    }

    /// Goes to a moment since Start.
    pub(super) fn seek(self, ms: f64) {
        self.act(LaneAct::Seek(ms));
    }
}
