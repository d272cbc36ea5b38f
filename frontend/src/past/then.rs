//! The moment under the cursor, on the graph: the program that ran then with its values of then, only to look at. What is told
//! of now meanwhile is kept, and shown again afterwards.

mod view;

pub(super) use view::{Folding, Then};

use super::why::ShownAnswer;
use super::{PastShared, ReasonWanted};
use crate::browser;
use crate::desk::Lit;
use crate::live::{LAST_MAX, LiveConnector, LiveStream};
use behaviour::{Behaviour, Id, Value};
use lanes::LaneAct;
use leptos::prelude::*;
use protocol::{
    LANES_MAX, LaneName, LaneValues, OpenedPast, PastAnswer, PastLane, PastMoment, PastQuestion, StreamSample,
};
use std::collections::{BTreeMap, VecDeque};

/// A connector is lit for so long after it gave something, in milliseconds.
const PULSE_MS: u64 = 250;
/// For so long after it did something a sentence says *then*, in milliseconds.
const SAID_MS: u64 = 1_000;
/// The time that a sparkline shows, in milliseconds.
const SPARK_MS: u64 = 8_000;
/// The numbers of a sparkline.
const SPARK_NUMBERS: usize = 32;

/// Questions about moments, and the program that is shown.
#[derive(Clone, Default)]
struct AskedMoments {
    is_busy: bool,
    /// The newest moment that is wanted and not asked yet.
    wanted: Option<u64>,
    /// The question for reasons that waits for its moment to be there.
    reason: Option<(u64, ReasonWanted)>,
    /// The moment that waits for its sparklines.
    sparks: Option<u64>,
    /// The place of the program that the graph shows.
    shown: Option<usize>,
    /// The programs that were fetched, by their place.
    fetched: BTreeMap<usize, Behaviour>,
}

/// The state of looking at a moment.
#[derive(Clone, Copy)]
pub(super) struct ThenState {
    asked: StoredValue<AskedMoments>,
    /// The moment that the graph shows, in milliseconds since Start; none while it shows now.
    pub(super) at: RwSignal<Option<u64>>,
    /// True if the program on the graph is the open one as it is now.
    pub(super) is_same: RwSignal<bool>,
    /// The reasons that are told.
    pub(super) answer: RwSignal<Option<ShownAnswer>>,
    /// The number of the newest question for reasons: an answer to an older one is too late.
    questions: StoredValue<u32>,
    /// True while the lanes are folded away, so that the graph has their room.
    pub(super) is_folded: RwSignal<bool>,
}

impl ThenState {
    /// Nothing is shown yet.
    pub(super) fn new() -> Self {
        Self {
            asked: StoredValue::default(),
            at: RwSignal::new(None),
            is_same: RwSignal::new(false),
            answer: RwSignal::new(None),
            questions: StoredValue::new(0),
            is_folded: RwSignal::new(false),
        }
    }
}

impl ThenState {
    /// Begins another question for reasons, or none: no answer to an older one is shown from now on.
    pub(super) fn another_question(self) -> u32 {
        self.questions
            .try_update_value(|questions| {
                *questions = questions.wrapping_add(1);
                *questions
            })
            .unwrap_or_default()
    }

    /// True if nothing else was asked since.
    pub(super) fn is_newest(self, question: u32) -> bool {
        self.questions.try_get_value() == Some(question)
    }

    /// Forgets what was asked of a past.
    pub(super) fn forget(self) {
        self.asked.set_value(AskedMoments::default());
    }
}

impl PastShared {
    /// Shows the moment under the cursor on the graph, for as long as the panel is there and does not follow.
    pub(super) fn follow_moment(self) {
        let wanted = Memo::new(move |_| self.wanted_moment());
        Effect::new(move |_| match wanted.get() {
            Some(at) => {
                self.then.asked.update_value(|asked| asked.wanted = Some(at));
                self.ask_moment();
            }
            None => self.leave_then(),
        });
        // Another past has other programs.
        Effect::new(move |_| {
            self.opened.track();
            self.then.asked.update_value(|asked| (asked.shown, asked.fetched) = (None, BTreeMap::new()));
        });
        Effect::new(move |before: Option<Option<Id>>| {
            let open = self.desk.desk().document.open.get();
            match before.flatten() {
                // Somebody here chose another program: that is what they want to see.
                Some(before) if open.as_ref() != Some(&before) => super::close(self),
                None if open.is_some() => self.show_anew(),
                _ => {}
            }
            open
        });
        on_cleanup(move || self.leave_then());
    }

    /// Asks once more for the moment that is wanted.
    pub(super) fn show_moment_again(self) {
        let at = untrack(|| self.wanted_moment());
        self.then.asked.update_value(|asked| asked.wanted = at);
        self.ask_moment();
    }

    /// The program that was opened may be the one that ran.
    fn show_anew(self) {
        if self.then.at.get_untracked().is_some() {
            self.desk.desk().document.show_then(None);
            self.then.asked.update_value(|asked| {
                (asked.shown, asked.wanted) = (None, self.then.at.get_untracked());
            });
            self.ask_moment();
        }
    }

    /// The moment under the cursor, in milliseconds since Start; none while now is followed, and while programs are compared:
    /// then the graph is the one that is edited. Reactive.
    fn wanted_moment(self) -> Option<u64> {
        let opened = self.opened.read();
        let (from_ms, viewer) = (opened.as_ref()?.from_ms, self.viewer.read());
        (!viewer.follows() && !self.compare.is_on.get()).then(|| viewer.cursor().round() as u64 + from_ms)
    }

    /// Asks for the newest moment that is wanted, unless another one is under way; then for its sparklines.
    fn ask_moment(self) {
        let (mut moment, mut sparks) = (None, None);
        self.then.asked.update_value(|asked| {
            if !asked.is_busy {
                moment = asked.wanted.take();
                sparks = asked.sparks.take().filter(|_| moment.is_none());
                asked.is_busy = moment.is_some() || sparks.is_some();
            }
        });
        if let Some(at_ms) = moment {
            self.ask(PastQuestion::Seek { at_ms }, move |answer| match answer {
                Some(PastAnswer::Moment(moment)) => self.take_moment(at_ms, (**moment).clone()),
                _ => self.answered(),
            });
        } else if let Some(at) = sparks {
            self.ask_sparks(at);
        }
    }

    fn answered(self) {
        self.then.asked.update_value(|asked| asked.is_busy = false);
        self.ask_moment();
    }

    /// Shows the program that ran at a moment, fetched if it is another one than the graph has, then its values.
    fn take_moment(self, at: u64, moment: PastMoment) {
        let Some(opened) = self.opened.get_untracked().filter(|_| untrack(|| self.wanted_moment()).is_some()) else {
            return self.answered();
        };
        let program = moment.program;
        let shown = self.then.asked.with_value(|asked| asked.shown);
        if shown == Some(program) {
            return self.put(at, &moment);
        }
        let fetched = self.then.asked.with_value(|asked| asked.fetched.get(&program).cloned());
        let is_same = self.runs_as_now(&opened, program);
        match fetched {
            Some(behaviour) => self.put_program(at, &moment, behaviour, is_same),
            None if is_same && shown.is_none() => {
                self.put_program(at, &moment, self.desk.desk().document.behaviour(), true);
            }
            None => self.fetch_program(program, (0, Behaviour::default()), move |behaviour| match behaviour {
                Some(behaviour) => {
                    self.then.asked.update_value(|asked| drop(asked.fetched.insert(program, behaviour.clone())));
                    // Meanwhile the graph may be to show now.
                    match untrack(|| self.wanted_moment()) {
                        Some(_) => self.put_program(at, &moment, behaviour, is_same),
                        None => self.answered(),
                    }
                }
                None => self.answered(),
            }),
        }
    }

    /// True if this program would run now as it ran then.
    fn runs_as_now(self, opened: &OpenedPast, program: usize) -> bool {
        let document = self.desk.desk().document;
        let is_open =
            document.open.with_untracked(|open| open.as_ref().is_some_and(|open| open.as_str() == opened.behaviour));
        let fingerprint = opened.programs.get(program).map(|program| program.fingerprint);
        is_open && fingerprint == Some(document.fingerprint.get_untracked())
    }

    /// Asks for the parts of a program, one after the other.
    fn fetch_program(
        self,
        program: usize,
        (part, mut behaviour): (usize, Behaviour),
        then: impl FnOnce(Option<Behaviour>) + 'static,
    ) {
        let question = PastQuestion::Program { program, part, language: String::new() };
        self.ask(question, move |answer| {
            let Some(PastAnswer::Program(got)) = answer else { return then(None) };
            behaviour.records.extend(got.records.records.clone());
            if got.more { self.fetch_program(program, (part + 1, behaviour), then) } else { then(Some(behaviour)) }
        });
    }

    fn put_program(self, at: u64, moment: &PastMoment, behaviour: Behaviour, is_same: bool) {
        let desk = self.desk.desk();
        let begins = self.then.at.with_untracked(Option::is_none);
        self.then.asked.update_value(|asked| asked.shown = Some(moment.program));
        self.then.is_same.set(is_same);
        desk.robots.keep_now();
        desk.document.show_then(Some(behaviour));
        self.put(at, moment);
        if begins {
            desk.document.laid_out.notify();
        }
    }

    /// Puts the values of a moment on the graph.
    fn put(self, at: u64, moment: &PastMoment) {
        let desk = self.desk.desk();
        let document = &desk.document;
        let samples: BTreeMap<&Id, &StreamSample> =
            moment.values.streams.iter().map(|sample| (&sample.stream, sample)).collect();
        for id in document.stream_ids.get_untracked() {
            let Some(signals) = document.stream(&id) else { continue };
            let live = samples.get(&id).map(|sample| live_stream(at, sample)).unwrap_or_default();
            if signals.live.with_untracked(|shown| *shown != live) {
                signals.live.set(live);
            }
        }
        for (id, signals) in document.connectors() {
            let sample = moment.values.connectors.iter().find(|sample| sample.connector == id);
            let live = sample.map_or_else(LiveConnector::default, |sample| {
                let (acts, inputs, output) = signals.record.with_untracked(|record| {
                    (record.operation.spec().acts(), record.inputs.clone(), record.output.clone())
                });
                let came = samples.get(&output).map(|output| output.at_ms);
                // An action may get its values from several connectors: this one gave it what came to it at that time.
                let gave = |came: u64| {
                    !acts || inputs.iter().any(|input| samples.get(input).is_some_and(|input| input.at_ms == came))
                };
                let within = |ms: u64| sample.fired > 0 && came.is_some_and(|came| came + ms >= at && gave(came));
                LiveConnector {
                    fired: sample.fired,
                    faults: sample.faults,
                    error: sample.error.clone(),
                    failed_at: 0.0,
                    fired_at: if within(SAID_MS) { f64::INFINITY } else { 0.0 },
                    lit: within(PULSE_MS),
                }
            });
            if signals.live.with_untracked(|shown| *shown != live) {
                signals.live.set(live);
            }
        }
        self.then.at.set(Some(at));
        desk.then.set(Some(at));
        let wanted = untrack(|| self.wanted_moment());
        let mut reason = None;
        self.then.asked.update_value(|asked| {
            asked.sparks = Some(at);
            // A person who went on to another moment asks no more about the one before.
            asked.reason.take_if(|(of, _)| Some(*of) != wanted);
            reason = asked.reason.take_if(|(of, _)| *of == at);
        });
        self.answered();
        match reason {
            Some((_, ReasonWanted::Why)) => self.ask_why(),
            Some((_, ReasonWanted::WhyNot(action))) => self.ask_why_not(action),
            None => {}
        }
    }

    /// Shows all of the graph again, once it has the room that the panel leaves now: that is measured as the browser draws next.
    pub(super) fn show_whole_graph(self) {
        let document = self.desk.desk().document;
        browser::next_frame(move || browser::after(0, move || document.laid_out.notify()));
    }

    /// True while the graph shows another moment than the one under the cursor: that one is on its way, or plays on.
    pub(super) fn is_on_its_way(self) -> bool {
        let shown = self.then.at.get_untracked();
        shown.is_none() || shown != untrack(|| self.wanted_moment())
    }

    /// Following and playing end at the moment under the cursor, and as soon as the graph shows that the question is asked.
    pub(super) fn ask_when_there(self, reason: ReasonWanted) {
        if self.viewer.with_untracked(lanes::Viewer::plays) {
            self.act(LaneAct::Play);
        }
        self.seek(self.viewer.with_untracked(lanes::Viewer::cursor));
        // It is asked also where the cursor stands there already.
        let at = untrack(|| self.wanted_moment());
        self.then.asked.update_value(|asked| (asked.reason, asked.wanted) = (at.map(|at| (at, reason)), at));
        self.ask_moment();
    }

    /// Asks for the numbers shortly before a moment, for the sparklines.
    fn ask_sparks(self, at: u64) {
        let Some(opened) = self.opened.get_untracked() else { return self.answered() };
        let document = self.desk.desk().document;
        let is_there = |id: &str| Id::new(id).is_ok_and(|id| document.stream(&id).is_some());
        let of_numbers = opened.streams.iter().filter(|one| one.numbers && one.count > 0 && is_there(&one.stream));
        let lanes: Vec<LaneName> =
            of_numbers.take(LANES_MAX).map(|one| LaneName { stream: one.stream.clone(), field: None }).collect();
        if lanes.is_empty() || untrack(|| self.viewer.read().plays()) {
            return self.answered();
        }
        let from_ms = at.saturating_sub(SPARK_MS).max(opened.from_ms);
        let question = PastQuestion::Lanes { lanes, from_ms, to_ms: at + 1, columns: SPARK_NUMBERS };
        self.ask(question, move |answer| {
            let is_now = self.then.at.get_untracked() == Some(at);
            if let (Some(PastAnswer::Lanes(lanes)), true) = (answer, is_now) {
                lanes.iter().for_each(|lane| self.take_spark(lane));
            }
            self.answered();
        });
    }

    fn take_spark(self, lane: &PastLane) {
        let signals = Id::new(&lane.name.stream).ok().and_then(|id| self.desk.desk().document.stream(&id));
        let Some(signals) = signals.filter(|signals| signals.live.with_untracked(|live| live.value.is_some())) else {
            return;
        };
        let (recent, last) = spark(&lane.values);
        signals.live.update(|live| {
            live.recent = recent;
            if !last.is_empty() {
                live.last = last;
            }
        });
    }

    /// The graph shows now again.
    fn leave_then(self) {
        let is_shown = self.then.at.try_get_untracked().flatten().is_some();
        self.then.another_question();
        let desk = self.desk.desk();
        self.then.asked.try_update_value(|asked| {
            (asked.wanted, asked.sparks, asked.shown, asked.reason) = (None, None, None, None);
        });
        if !is_shown && desk.then.with_untracked(Option::is_none) {
            return;
        }
        self.then.at.try_set(None);
        self.then.answer.try_set(None);
        self.viewer.try_update(|viewer| viewer.set_question(None));
        desk.then.set(None);
        desk.document.show_then(None);
        desk.robots.show_now();
        desk.document.lit.set(Lit::default());
    }
}

/// A stream as it was at a moment.
fn live_stream(at: u64, sample: &StreamSample) -> LiveStream {
    LiveStream {
        value: Some(sample.value.clone()),
        rate: sample.rate,
        count: sample.count,
        at_ms: sample.at_ms,
        received: 0.0,
        recent: Vec::new(),
        last: VecDeque::from([sample.value.clone()]),
        earlier_ms: Some(at.saturating_sub(sample.at_ms) as f64),
    }
}

/// The numbers of a sparkline, and the last values where these are told one by one.
fn spark(values: &LaneValues) -> (Vec<f64>, VecDeque<Value>) {
    match values {
        LaneValues::Each(all) => {
            let numbers: Vec<f64> = all.iter().filter_map(|one| one.value.as_number()).collect();
            let last = all.iter().skip(all.len().saturating_sub(LAST_MAX)).map(|one| one.value.clone()).collect();
            (numbers[numbers.len().saturating_sub(SPARK_NUMBERS)..].to_vec(), last)
        }
        LaneValues::Columns(columns) => {
            let last = |column: &protocol::LaneColumn| column.numbers.map(|[.., last]| f64::from(last));
            (columns.iter().filter_map(last).collect(), VecDeque::new())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{SPARK_NUMBERS, live_stream, spark};
    use behaviour::{Id, Value};
    use protocol::{LaneColumn, LaneValue, LaneValues, StreamSample};

    #[test]
    fn a_value_of_then_knows_how_much_earlier_it_came() {
        let sample =
            StreamSample { stream: Id::new("face").unwrap(), count: 4, rate: 2.0, at_ms: 700, value: Value::Int(9) };
        let live = live_stream(5_700, &sample);
        assert_eq!((live.earlier_ms, live.count), (Some(5_000.0), 4));
        assert_eq!(live.quiet_for(0.0), Some(5), "the clock of the page does not count");
        assert_eq!(live_stream(800, &sample).quiet_for(1e9), None);
    }

    #[test]
    fn a_sparkline_has_the_newest_numbers_and_no_others() {
        let each = |t: u64| LaneValue { t, nth: 0, value: Value::Int(t as i64), pretended: false };
        let (numbers, last) = spark(&LaneValues::Each((0..50).map(each).collect()));
        assert_eq!((numbers.len(), numbers.last(), last.len()), (SPARK_NUMBERS, Some(&49.0), 5));
        let columns = [Some([1.0, 4.0, 2.0, 3.0]), None].map(|numbers| LaneColumn { at: 0, count: 2, numbers });
        assert_eq!(spark(&LaneValues::Columns(columns.into())).0, [3.0]);
    }
}
