//! Why something came, and why something else did not: asked about the moment on the graph, told in steps, and lit on the graph.

mod fix;
mod view;

pub(super) use view::{Asking, Numbers};

use fix::AnswerFix;

use super::media::page_element;
use super::{PastShared, ReasonWanted, clock, filling};
use crate::desk::{Lit, Selected};
use crate::focus::{self, FocusPlace};
use crate::parts::language;
use crate::past::words;
use behaviour::{Id, StreamKind};
use lanes::LaneAct;
use leptos::prelude::*;
use protocol::{
    LaneName, LaneValues, NumberFix, OpenedPast, PastAnswer, PastQuestion, ToldWhy, Why, WhyNot, WhySentence, WhyWith,
};

/// The longest time before the cursor that *Why not* asks about, in milliseconds; else since the action came last.
const MISSED_MS: u64 = 60_000;

/// A value that a step used besides.
#[derive(Clone, Debug, PartialEq)]
struct AnswerBranch {
    name: String,
    t: u64,
}

/// A line of an answer.
#[derive(Clone, Debug, PartialEq)]
struct AnswerLine {
    text: String,
    /// The time that it is about, in milliseconds since Start.
    t: Option<u64>,
    branches: Vec<AnswerBranch>,
    /// With which number it would have come, where that is known and the open program is the one that ran.
    fix: Option<AnswerFix>,
}

/// A question: a stream and a moment since Start.
#[derive(Clone, Debug, PartialEq)]
struct AskedReason {
    stream: Id,
    at: u64,
    /// True if it was asked why nothing came.
    is_not: bool,
}

/// An answer as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ShownAnswer {
    asked: AskedReason,
    title: String,
    lines: Vec<AnswerLine>,
    /// The streams on the graph that have a number, or a plus for what was used besides.
    numbers: Vec<(Id, String)>,
    way: Lit,
    /// Said beside it: that lines are missing, or why there is no answer.
    note: Option<String>,
}

impl PastShared {
    /// The stream that is asked about: the one that is selected on the graph, else that of the chosen lane. Reactive.
    fn subject(self) -> Option<Id> {
        let document = self.desk.desk().document;
        let chosen = match document.selected.get() {
            Some(Selected::Stream(id)) => Some(id),
            Some(Selected::Connector(id)) => document.connector(&id).map(|it| it.record.with(|it| it.output.clone())),
            Some(Selected::Note(_) | Selected::Group(_)) | None => None,
        };
        chosen.or_else(|| {
            let viewer = self.viewer.read();
            Id::new(&filling::name(&viewer.chosen()?.key).stream).ok()
        })
    }

    /// Of a lane and something on the graph, the one that was chosen last counts.
    pub(super) fn follow_subject(self) {
        let lane = Memo::new(move |_| self.viewer.read().chosen().map(|lane| filling::name(&lane.key).stream));
        Effect::new(move |before: Option<Option<String>>| {
            let now = lane.get();
            untrack(|| self.reveal_chosen());
            let document = self.desk.desk().document;
            let is_other = untrack(|| self.subject()).map(|id| id.to_string()) != now;
            if before.is_some_and(|before| before != now) && is_other {
                document.select(None);
            }
            now
        });
        Effect::new(move |_| {
            let document = self.desk.desk().document;
            document.selected.track();
            if let Some(id) = untrack(|| self.subject()) {
                let at = self.viewer.with_untracked(|viewer| {
                    viewer.lanes().iter().position(|lane| filling::name(&lane.key).stream == id.as_str())
                });
                let is_other = lane.get_untracked().as_deref() != Some(id.as_str());
                if let Some(at) = at.filter(|_| is_other) {
                    self.act(LaneAct::Choose(at));
                }
            }
        });
    }

    /// Scrolls the chosen lane into view.
    fn reveal_chosen(self) {
        let (rows, chosen) = self.viewer.with(|viewer| (viewer.rows().0, viewer.chosen_index()));
        let (Some(row), Some(list)) = (rows.get(chosen), page_element(".past-rows")) else { return };
        let (top, high) = (f64::from(list.scroll_top()), f64::from(list.client_height()));
        if row.y < top {
            list.set_scroll_top(row.y as i32);
        } else if row.y + row.height > top + high {
            list.set_scroll_top((row.y + row.height - high).ceil() as i32);
        }
    }

    /// The actions of the program on the graph, by id and name. Reactive.
    fn actions(self) -> Vec<(Id, String)> {
        let document = self.desk.desk().document;
        let ids = document.stream_ids.get();
        let named = ids.into_iter().filter_map(|id| {
            let signals = document.stream(&id)?;
            let record = signals.record.read();
            (record.kind == StreamKind::Actuator).then(|| (id.clone(), record.name.clone()))
        });
        named.collect()
    }

    fn name_of(self, stream: &str) -> String {
        let opened = self.opened.get_untracked();
        let plain = LaneName { stream: stream.to_owned(), field: None };
        opened.map_or_else(|| stream.to_owned(), |opened| filling::label(&opened, &plain))
    }

    /// Asks why the newest value until the moment under the cursor came on the subject's stream. While now is followed, that
    /// rests first; while the graph does not show that moment yet, the question waits for it.
    pub(super) fn ask_why(self) {
        let Some(stream) = untrack(|| self.subject()) else { return };
        // A comparison shows the program that is edited, not the one that ran.
        if self.compare.is_on.get_untracked() {
            self.toggle_compare();
        }
        if self.is_on_its_way() {
            return self.ask_when_there(ReasonWanted::Why);
        }
        let signals = self.desk.desk().document.stream(&stream);
        let live = signals.map(|signals| signals.live.get_untracked());
        let Some(at) = live.filter(|live| live.value.is_some()).map(|live| live.at_ms) else {
            let at = self.then.at.get_untracked().unwrap_or_default();
            let asked = AskedReason { stream, at, is_not: false };
            return self.refuse(asked, words::nothing_came_until_then().to_owned());
        };
        let mine = self.then.another_question();
        // Of several values at this very time the newest is meant.
        let lanes = vec![LaneName { stream: stream.to_string(), field: None }];
        self.ask(PastQuestion::Lanes { lanes, from_ms: at, to_ms: at + 1, columns: 1 }, move |answer| {
            let Some(PastAnswer::Lanes(lanes)) = answer.filter(|_| self.then.is_newest(mine)) else { return };
            let count = match lanes.first().map(|lane| &lane.values) {
                Some(LaneValues::Each(values)) => values.len(),
                Some(LaneValues::Columns(columns)) => columns.first().map_or(0, |column| column.count as usize),
                None => 0,
            };
            let question = PastQuestion::Why {
                stream: stream.to_string(),
                at_ms: at,
                nth: count.saturating_sub(1),
                language: language().code().to_owned(),
            };
            self.ask(question, move |answer| {
                if let Some(PastAnswer::Why(told)) = answer.filter(|_| self.then.is_newest(mine)) {
                    self.show_why(AskedReason { stream, at, is_not: false }, told);
                }
            });
        });
    }

    /// Asks why nothing came on a stream between its last value and the moment under the cursor, for which the question waits
    /// as that of [`Self::ask_why`] does.
    pub(super) fn ask_why_not(self, stream: Id) {
        if self.is_on_its_way() {
            return self.ask_when_there(ReasonWanted::WhyNot(stream));
        }
        let Some(at) = self.then.at.get_untracked() else { return };
        let from = self.opened.get_untracked().map_or(0, |opened| opened.from_ms);
        let signals = self.desk.desk().document.stream(&stream);
        let live = signals.map(|signals| signals.live.get_untracked()).filter(|live| live.value.is_some());
        let asked = AskedReason { stream: stream.clone(), at, is_not: true };
        if live.as_ref().is_some_and(|live| live.at_ms == at) {
            return self.refuse(asked, words::it_came_then().to_owned());
        }
        let after = live.map_or(0, |live| live.at_ms + 1);
        let from_ms = at.saturating_sub(MISSED_MS).max(after).max(from);
        let question = PastQuestion::WhyNot {
            stream: stream.to_string(),
            from_ms,
            until_ms: at,
            language: language().code().to_owned(),
        };
        let mine = self.then.another_question();
        self.ask(question, move |answer| {
            if let Some(PastAnswer::WhyNot(told)) = answer.filter(|_| self.then.is_newest(mine)) {
                self.show_why_not(asked, from_ms, told);
            }
        });
    }

    fn refuse(self, asked: AskedReason, why: String) {
        let title = self.title_of(&asked);
        self.show_answer(ShownAnswer {
            asked,
            title,
            lines: Vec::new(),
            numbers: Vec::new(),
            way: Lit::default(),
            note: Some(why),
        });
    }

    fn title_of(self, asked: &AskedReason) -> String {
        let name = self.name_of(asked.stream.as_str());
        if asked.is_not { words::why_no(&name, &self.time_words(asked.at, false)) } else { words::why_this(&name) }
    }

    fn show_why(self, asked: AskedReason, told: &ToldWhy<Why>) {
        let Some(opened) = self.opened.get_untracked() else { return };
        let (mut way, mut numbers) = (Lit::default(), Vec::new());
        let mut add = |id: &str, sign: String| {
            if let Ok(id) = Id::new(id)
                && !way.streams.contains(&id)
            {
                way.streams.push(id.clone());
                numbers.push((id, sign));
            }
        };
        let mut lines = Vec::new();
        let sentences = told.sentences.iter().map(Some).chain(std::iter::repeat(None));
        for (at, (step, sentence)) in told.why.steps.iter().zip(sentences).enumerate() {
            add(&step.stream, (at + 1).to_string());
            let branch = |with: &WhyWith| match with {
                WhyWith::Value { stream, t, .. } => Some((stream.clone(), *t)),
                WhyWith::Memory { .. } => None,
            };
            let with: Vec<(String, u64)> = step.with.iter().filter_map(branch).collect();
            let text = sentence.map_or_else(|| self.name_of(&step.stream), |said| in_times_of_day(&opened, &said.text));
            let branches = with.iter().map(|(stream, t)| AnswerBranch { name: self.name_of(stream), t: *t }).collect();
            lines.push(AnswerLine { text, t: Some(step.t), branches, fix: None });
        }
        let others = told.why.steps.iter().flat_map(|step| &step.with);
        for with in others {
            if let WhyWith::Value { stream, .. } = with {
                add(stream, "+".to_owned());
            }
        }
        let connectors = told.why.steps.iter().filter_map(|step| Id::new(step.connector.as_ref()?).ok());
        way.connectors = connectors.collect();
        let title = self.title_of(&asked);
        self.show_answer(ShownAnswer { asked, title, lines, numbers, way, note: lost(told.lost) });
    }

    fn show_why_not(self, asked: AskedReason, from_ms: u64, told: &ToldWhy<WhyNot>) {
        let Some(opened) = self.opened.get_untracked() else { return };
        let is_same = self.then.is_same.get_untracked();
        let document = self.desk.desk().document;
        let fix = |number: &NumberFix| {
            let signals = document.connector(&Id::new(&number.connector).ok()?)?;
            let ran = signals.record.with_untracked(|record| record.operation.clone());
            Some(AnswerFix::of(number, ran))
        };
        let line = |sentence: &WhySentence| AnswerLine {
            text: in_times_of_day(&opened, &sentence.text),
            t: sentence.t,
            branches: Vec::new(),
            fix: sentence.fix.as_ref().filter(|_| is_same).and_then(fix),
        };
        let lines = told.sentences.iter().map(line).collect();
        let mut way = Lit { streams: vec![asked.stream.clone()], ..Lit::default() };
        let mut numbers = vec![(asked.stream.clone(), "?".to_owned())];
        for (at, blocked) in told.why.blocked.iter().enumerate() {
            way.connectors.extend(Id::new(&blocked.connector).ok());
            if let Ok(id) = Id::new(&blocked.stream)
                && !way.streams.contains(&id)
            {
                way.streams.push(id.clone());
                numbers.push((id, (at + 1).to_string()));
            }
        }
        let title = self.title_of(&asked);
        let looked = words::looked_from(&self.time_words(from_ms, false));
        let note = Some(lost(told.lost).map_or_else(|| looked.clone(), |lost| format!("{looked} {lost}")));
        self.show_answer(ShownAnswer { asked, title, lines, numbers, way, note });
    }

    fn show_answer(self, answer: ShownAnswer) {
        self.desk.desk().document.lit.set(answer.way.clone());
        let question = answer.asked.is_not.then(|| {
            let from = self.opened.get_untracked().map_or(0, |opened| opened.from_ms);
            (answer.asked.stream.to_string(), answer.asked.at.saturating_sub(from) as f64)
        });
        self.viewer.update(|viewer| viewer.set_question(question));
        self.then.answer.set(Some(answer));
        focus::place(FocusPlace::Answer);
    }

    /// Closes the answer; the keyboard goes back to the panel.
    fn close_answer(self) {
        self.then.another_question();
        self.then.answer.set(None);
        self.viewer.update(|viewer| viewer.set_question(None));
        self.desk.desk().document.lit.set(Lit::default());
    }

    /// The time of day so many milliseconds since Start.
    pub(super) fn time_words(self, at: u64, has_tenths: bool) -> String {
        let opened = self.opened.get_untracked();
        opened.map(|opened| clock::time(&opened, at as f64 - opened.from_ms as f64, has_tenths)).unwrap_or_default()
    }
}

/// That an answer may be wrong, as lines of the recording are missing.
fn lost(lines: u64) -> Option<String> {
    (lines > 0).then(|| words::lines_missing(lines))
}

/// A sentence whose times since Start, as `0:04.200`, are told as times of day.
fn in_times_of_day(opened: &OpenedPast, text: &str) -> String {
    with_times(text, |ms| clock::time(opened, ms as f64 - opened.from_ms as f64, true))
}

/// Replaces each time since Start by how it is told.
fn with_times(text: &str, told: impl Fn(u64) -> String) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        out.push_str(&rest[..at]);
        rest = &rest[at..];
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let time = (rest.len() >= digits + 7).then(|| rest.split_at_checked(digits + 7)).flatten();
        let ms = time.and_then(|(time, _)| since_start(time, digits));
        let length = if ms.is_some() { digits + 7 } else { digits };
        match ms {
            Some(ms) => out.push_str(&told(ms)),
            None => out.push_str(&rest[..length]),
        }
        rest = &rest[length..];
    }
    out.push_str(rest);
    out
}

/// The milliseconds of a time since Start, `4:05.250`, whose minutes have so many digits.
fn since_start(time: &str, digits: usize) -> Option<u64> {
    let (minutes, rest) = time.split_at(digits);
    let (seconds, ms) = rest.strip_prefix(':')?.split_once('.')?;
    let all = |text: &str, length| text.len() == length && text.bytes().all(|byte| byte.is_ascii_digit());
    if !all(seconds, 2) || !all(ms, 3) {
        return None;
    }
    let number = |text: &str| text.parse::<u64>().ok();
    number(minutes)?.checked_mul(60_000)?.checked_add(number(seconds)? * 1_000 + number(ms)?)
}

#[cfg(test)]
mod tests {
    use super::with_times;

    #[test]
    fn times_since_start_become_times_of_day_and_other_numbers_stay() {
        let told = |text: &str| with_times(text, |ms| format!("<{ms}>"));
        assert_eq!(
            told("It said it at 0:04.200: 68 cm is less than 75 cm."),
            "It said it at <4200>: 68 cm is less than 75 cm."
        );
        assert_eq!(told("71:00.005、64.5 cm"), "<4260005>、64.5 cm");
        assert_eq!(told("1:30 and 12:3.100 and 0.5"), "1:30 and 12:3.100 and 0.5");
        assert_eq!(told("7分0:01.000に"), "7分<1000>に", "letters of several bytes are no numbers");
        assert_eq!(told(""), "");
    }
}
