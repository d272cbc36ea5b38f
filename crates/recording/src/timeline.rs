//! A recording as what happened one after the other, for other programs and for reports.

use crate::header::Header;
use crate::lines::{Hand, RefusedLine};
use crate::marks::{marks, run_marks};
use crate::private::{Private, PrivateParts, said};
use crate::read::{Entry, NoRecording, open};
use behaviour::{BehaviourFile, FileStream, StreamKind, Value};
use protocol::RecordingMark;
use std::collections::BTreeMap;

/// The events of a recording, with its marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Timeline {
    /// The header of the recording; who started it is told as far as that may be.
    pub header: Header,
    /// The time of the last line.
    pub until_ms: u64,
    /// True if its last line is missing.
    pub cut_off: bool,
    /// By time.
    pub events: Vec<TimelineEvent>,
    /// By time.
    pub marks: Vec<RecordingMark>,
}

/// One thing that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct TimelineEvent {
    /// The time at which it happened, in milliseconds since Start.
    pub at_ms: u64,
    /// The kind of thing that happened.
    pub what: Happening,
    /// Of which stream, action or connector, as people call it.
    pub subject: String,
    /// The value, where there is one.
    pub value: Option<Value>,
    /// The value or the reason, in words.
    pub says: String,
    /// The name of the one who did it, or who kept it from being done.
    pub by: String,
}

/// The kinds of things that happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Happening {
    /// The robot sensed something.
    Sensed,
    /// Somebody pretended that it did.
    Pretended,
    /// The program told an action something.
    Action,
    /// A value of a recording that does not say which.
    Value,
    /// Somebody had the robot do something by hand.
    ByHand,
    /// The robot did not do what it was told.
    NotDone,
    /// A procedure failed.
    Failed,
    /// The program was changed while it ran.
    Changed,
    /// The robot was another way.
    Robot,
    /// Lines are missing.
    Missing,
}

impl Happening {
    /// A word for it, the same in every export.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Sensed => "sensed",
            Self::Pretended => "pretended",
            Self::Action => "action",
            Self::Value => "value",
            Self::ByHand => "by hand",
            Self::NotDone => "not done",
            Self::Failed => "failed",
            Self::Changed => "program changed",
            Self::Robot => "robot",
            Self::Missing => "lines missing",
        }
    }
}

/// Returns what happened in a recording, with its later marks. Everything about people is left out unless it is kept.
///
/// # Errors
/// If the text is no recording.
pub fn timeline(text: &str, later_marks: &str, keep: PrivateParts) -> Result<Timeline, NoRecording> {
    let (header, lines) = open(text)?;
    let all_marks = marks(run_marks(lines.lines().map(|(_, line)| line)), later_marks);
    let people = std::iter::once(header.by.clone()).chain(all_marks.iter().map(|mark| mark.by.clone()));
    let private = Private::of(keep, people, lines.entries());
    let mut teller =
        TimelineTeller { private, names: BTreeMap::new(), events: Vec::new(), last_ms: 0, is_whole: false };
    lines.entries().for_each(|entry| teller.tell(entry));
    let TimelineTeller { private, mut events, last_ms, is_whole, .. } = teller;
    events.sort_by_key(|event| event.at_ms);
    let told = |mark: RecordingMark| RecordingMark {
        // The end of a span that goes on is that of what there is.
        until: mark.until.or(Some(last_ms).filter(|last_ms| mark.open && *last_ms > mark.t)),
        word: private.text(&mark.word),
        note: private.text(&mark.note),
        by: private.name(&mark.by),
        ..mark
    };
    let marks: Vec<_> = all_marks.into_iter().map(told).collect();
    let header = Header { by: private.name(&header.by), name: private.text(&header.name), ..header };
    Ok(Timeline { header, until_ms: last_ms, cut_off: !is_whole, events, marks })
}

struct TimelineTeller {
    private: Private,
    /// By id what streams and connectors are.
    names: BTreeMap<String, (String, Option<StreamKind>)>,
    events: Vec<TimelineEvent>,
    last_ms: u64,
    is_whole: bool,
}

impl TimelineTeller {
    fn tell(&mut self, entry: Entry) {
        match entry {
            Entry::Value { at_ms, stream, value, by } => self.value(at_ms, &stream, &value, by.as_deref()),
            Entry::Fault { at_ms, connector, error } => {
                let (subject, says) = (self.name(&connector), self.private.text(&error));
                self.add(at_ms, Happening::Failed, subject, (None, says), String::new());
            }
            Entry::Refused(refusal) => self.refused(&refusal),
            Entry::Hand(hand) => self.hand(&hand),
            Entry::Applied { at_ms, revision } => {
                self.add(
                    at_ms,
                    Happening::Changed,
                    String::new(),
                    (None, format!("revision {revision}")),
                    String::new(),
                );
            }
            Entry::File { file, .. } => file.into_iter().for_each(|file| self.file(&file)),
            Entry::Robot(line) => {
                let battery = line.condition.battery.map(|percent| format!("battery {percent} %"));
                let says: Vec<String> = [Some(line.link), line.why, battery, line.halt].into_iter().flatten().collect();
                let says = self.private.text(&says.join(", "));
                self.add(line.at_ms, Happening::Robot, String::new(), (None, says), String::new());
            }
            Entry::Gap { lost } => {
                self.add(self.last_ms, Happening::Missing, String::new(), (None, lost.to_string()), String::new());
            }
            Entry::Full => self.is_whole = true,
            Entry::End(end) => {
                (self.is_whole, self.last_ms) = (true, self.last_ms.max(end.at_ms));
            }
            Entry::Memory { .. } | Entry::Room { .. } | Entry::Note(_) | Entry::Unknown => {}
        }
    }

    fn file(&mut self, file: &BehaviourFile) {
        let streams = file.streams.iter();
        self.names.extend(streams.map(|FileStream { id, name, kind, .. }| (id.clone(), (name.clone(), Some(*kind)))));
        for connector in &file.connectors {
            let name = self.name(&connector.output);
            self.names.insert(connector.id.clone(), (name, None));
        }
    }

    fn name(&self, id: &str) -> String {
        let name = self.names.get(id).map_or(id, |(name, _)| name);
        self.private.text(name)
    }

    fn value(&mut self, at_ms: u64, stream: &str, value: &Value, by: Option<&str>) {
        let what = match (self.names.get(stream).and_then(|(_, kind)| *kind), by) {
            (Some(StreamKind::Sensor), None) => Happening::Sensed,
            (_, Some(_)) => Happening::Pretended,
            (Some(StreamKind::Actuator), None) => Happening::Action,
            (Some(StreamKind::Ordinary) | None, None) => Happening::Value,
        };
        let (told, by) = (self.private.value(stream, value), by.map(|by| self.private.name(by)));
        let says = said(&told);
        self.add(at_ms, what, self.name(stream), (Some(told), says), by.unwrap_or_default());
    }

    fn refused(&mut self, refusal: &RefusedLine) {
        let often = refusal.count.map(|count| format!(" ({count} times)")).unwrap_or_default();
        let says = format!("{}{often}", self.private.text(&refusal.why));
        let by = refusal.with.as_deref().map(|with| self.private.name(with)).unwrap_or_default();
        self.add(refusal.at_ms, Happening::NotDone, self.name(refusal.refused.as_str()), (None, says), by);
    }

    fn hand(&mut self, hand: &Hand) {
        let told = self.private.told(&hand.value, false);
        let (says, by) = (said(&told), self.private.name(&hand.by));
        match &hand.why {
            None => self.add(hand.at_ms, Happening::ByHand, hand.hand.clone(), (Some(told), says), by),
            Some(why) => {
                let says = self.private.text(why);
                self.add(hand.at_ms, Happening::NotDone, hand.hand.clone(), (Some(told), says), by);
            }
        }
    }

    fn add(
        &mut self,
        at_ms: u64,
        what: Happening,
        subject: String,
        (value, says): (Option<Value>, String),
        by: String,
    ) {
        self.last_ms = self.last_ms.max(at_ms);
        self.events.push(TimelineEvent { at_ms, what, subject, value, says, by });
    }
}
