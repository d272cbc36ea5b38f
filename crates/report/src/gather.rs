//! Gathers from a recording, an entry at a time, what its report says: however long it is, that stays small.

use crate::bars::ReportBars;
use crate::troubles::{Trouble, Troubles};
use crate::words::Words;
use behaviour::{BehaviourFile, Helper, Id, Knowledge, Params, StreamKind, Unit, Value, ValueType, infer};
use phrase::Catalogue;
use protocol::{RECORDING_MARKS_MAX, RecordingMark};
use recording::{Entry, Hand, Header, Private, PrivateParts, mark, marks};
use std::collections::BTreeMap;

/// The most streams, and the most presses of different kinds, that have a row each.
const ROWS_MAX: usize = 200;
/// The most moments of presses that are drawn.
const PRESSES_MAX: usize = 2_000;
/// The most streams and connectors whose names are known.
const NAMES_MAX: usize = 20_000;
/// The most programs that are told: that of Start, and what was applied.
const PROGRAMS_MAX: usize = 50;
/// The most sentences of a program that are told, and the most signs of one.
const SENTENCES_MAX: usize = 60;
const SENTENCE_MAX_CHARS: usize = 600;
/// The most signs of a name or a text that are kept.
const TEXT_MAX_CHARS: usize = 200;

/// Everything that a report says of one recording.
#[derive(Debug)]
pub struct Gathered {
    pub(crate) header: Header,
    pub(crate) private: Private,
    /// The words of the report.
    pub(crate) words: Words,
    /// The streams with a row, in the order of the program.
    pub(crate) rows: Vec<StreamRow>,
    /// The number of streams without one, for want of room.
    pub(crate) more_rows: u64,
    /// The programs that ran.
    pub(crate) programs: Vec<RanProgram>,
    /// Presses by what they had the robot do.
    pub(crate) hands: Vec<HandAction>,
    /// The moments of presses.
    pub(crate) presses: Vec<u64>,
    pub(crate) troubles: Troubles,
    /// The battery at first and at last, in percent.
    pub(crate) battery: Option<(u8, u8)>,
    /// All marks that are there by now.
    pub(crate) marks: Vec<RecordingMark>,
    pub(crate) last_ms: u64,
    pub(crate) ended: Ended,
    of_run: Vec<RecordingMark>,
    names: BTreeMap<String, String>,
}

/// One stream of the program.
#[derive(Debug)]
pub(crate) struct StreamRow {
    id: String,
    pub(crate) name: String,
    /// None in a recording that does not say.
    pub(crate) kind: Option<StreamKind>,
    /// The bars of what it sensed, or what it was told.
    pub(crate) bars: ReportBars,
    /// By person what they pretended.
    pub(crate) pretended: BTreeMap<String, ReportBars>,
}

/// A program that ran from then on.
#[derive(Debug)]
pub(crate) struct RanProgram {
    pub(crate) at_ms: u64,
    pub(crate) revision: u64,
    /// None if this rrp cannot read it.
    pub(crate) sentences: Option<Vec<String>>,
    /// The number of sentences that are not among them.
    pub(crate) more: usize,
}

/// An action that somebody had the robot do.
#[derive(Debug)]
pub(crate) struct HandAction {
    /// The device, and the text that it was told; that may be empty.
    pub(crate) what: (String, String),
    /// By person how often.
    pub(crate) by: BTreeMap<String, u64>,
}

impl HandAction {
    pub(crate) fn count(&self) -> u64 {
        self.by.values().sum()
    }
}

/// The way in which a recording ends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Ended {
    /// Without a last line.
    #[default]
    CutOff,
    /// It is still being written.
    GoesOn,
    /// It has its largest size.
    Full,
    /// For this reason.
    Whole(String),
    /// It was not read to its end, as that took too long.
    Unread,
}

impl Gathered {
    /// Begins with the first line of a recording, for a report in the language of this catalogue.
    #[must_use]
    pub fn of(header: Header, keep: PrivateParts, language: &'static Catalogue) -> Self {
        let mut private = Private::keeping(keep);
        private.person(&header.by);
        Self {
            header,
            private,
            words: Words(language),
            rows: Vec::new(),
            more_rows: 0,
            programs: Vec::new(),
            hands: Vec::new(),
            presses: Vec::new(),
            troubles: Troubles::default(),
            battery: None,
            marks: Vec::new(),
            last_ms: 0,
            ended: Ended::default(),
            of_run: Vec::new(),
            names: BTreeMap::new(),
        }
    }

    /// Takes the next entry.
    pub fn take(&mut self, entry: &Entry, knowledge: &dyn Knowledge) {
        self.private.hear(entry);
        match entry {
            Entry::Value { at_ms, stream, value, by } => self.value(*at_ms, stream, value, by.as_deref()),
            Entry::Fault { at_ms, connector, error } => {
                self.reach(*at_ms);
                let subject = self.name(connector);
                self.troubles.failed(*at_ms, &subject, &short(error));
            }
            Entry::Refused(refusal) => {
                let subject = self.name(refusal.refused.as_str());
                self.troubles.refused(&subject, refusal);
            }
            Entry::Hand(hand) => self.hand(hand),
            Entry::Applied { at_ms, .. } => self.reach(*at_ms),
            Entry::File { at_ms, revision, file } => self.program(*at_ms, *revision, file.as_deref(), knowledge),
            Entry::Robot(line) => {
                self.troubles.robot(line);
                let battery = line.condition.battery;
                let first = |now| self.battery.map_or(now, |(first, _)| first);
                self.battery = battery.map(|now| (first(now), now)).or(self.battery);
            }
            // A span is two lines, and a mark may be changed: as many are read as the list reads.
            Entry::Note(note) if self.of_run.len() < 4 * RECORDING_MARKS_MAX => {
                self.of_run.extend(mark(self.of_run.len() + 1, note.clone()));
            }
            Entry::Gap { lost } => self.troubles.add(self.last_ms, Trouble::Missing(*lost)),
            Entry::Full => self.ended = Ended::Full,
            Entry::End(end) => {
                self.reach(end.at_ms);
                self.ended = Ended::Whole(short(&end.why));
                if end.late > 0 {
                    self.troubles.add(end.at_ms, Trouble::Late(end.late));
                }
            }
            Entry::Note(_) | Entry::Memory { .. } | Entry::Room { .. } | Entry::Unknown => {}
        }
    }

    /// The recording is still being written.
    pub fn goes_on(&mut self) {
        self.ended = Ended::GoesOn;
    }

    /// The rest of the recording was not read, as that took too long.
    pub fn was_not_read_to_its_end(&mut self) {
        self.ended = Ended::Unread;
    }

    /// Adds the marks that were made later, of the file beside the recording.
    pub fn finish(&mut self, later_marks: &str) {
        self.marks = marks(std::mem::take(&mut self.of_run), later_marks);
        self.marks.iter().for_each(|mark| self.private.person(&mark.by));
        let last_of_marks = self.marks.iter().map(|mark| mark.until.unwrap_or(mark.t)).max();
        // A mark may have been set after the last value.
        self.last_ms = self.last_ms.max(last_of_marks.unwrap_or(0).min(self.last_ms.saturating_mul(2)));
        // A span that nobody ended lasts until the end.
        for mark in self.marks.iter_mut().filter(|mark| mark.open && mark.until.is_none()) {
            mark.until = Some(self.last_ms).filter(|last_ms| *last_ms > mark.t);
        }
        match self.ended {
            Ended::CutOff => self.troubles.add(self.last_ms, Trouble::CutOff),
            Ended::Full => self.troubles.add(self.last_ms, Trouble::Full),
            Ended::GoesOn | Ended::Whole(_) | Ended::Unread => {}
        }
        self.troubles.told.sort_by_key(|(at_ms, _)| *at_ms);
    }

    /// The later marks that are there, as a list; with those of the run.
    #[must_use]
    pub fn marks(&self) -> &[RecordingMark] {
        &self.marks
    }

    fn reach(&mut self, at_ms: u64) {
        self.last_ms = self.last_ms.max(at_ms);
    }

    fn name(&self, id: &str) -> String {
        self.names.get(id).cloned().unwrap_or_else(|| short(id))
    }

    fn value(&mut self, at_ms: u64, stream: &str, value: &Value, by: Option<&str>) {
        self.reach(at_ms);
        let at = self.row(stream, None);
        let Some(row) = at.and_then(|at| self.rows.get_mut(at)) else { return };
        // A text is a thing of its own; a number is told again and again.
        let says = value.as_text().filter(|_| row.kind == Some(StreamKind::Actuator));
        match by {
            None => row.bars.come(at_ms, says),
            Some(by) if row.pretended.len() < ROWS_MAX || row.pretended.contains_key(by) => {
                row.pretended.entry(by.to_owned()).or_default().come(at_ms, None);
            }
            Some(_) => {}
        }
    }

    fn row(&mut self, id: &str, about: Option<(&str, StreamKind)>) -> Option<usize> {
        if let Some(at) = self.rows.iter().position(|row| row.id == id) {
            return Some(at);
        }
        if self.rows.len() >= ROWS_MAX {
            self.more_rows += u64::from(about.is_some());
            return None;
        }
        let (name, kind) = about.map_or((short(id), None), |(name, kind)| (short(name), Some(kind)));
        let (bars, pretended) = (ReportBars::default(), BTreeMap::new());
        self.rows.push(StreamRow { id: id.to_owned(), name, kind, bars, pretended });
        Some(self.rows.len() - 1)
    }

    fn hand(&mut self, hand: &Hand) {
        let what = (hand.hand.clone(), short(text_of(&hand.value, &hand.params)));
        if let Some(why) = &hand.why {
            return self.troubles.not_by_hand(what, why, hand);
        }
        if self.presses.len() < PRESSES_MAX {
            self.presses.push(hand.at_ms);
        }
        let known = self.hands.iter().position(|pressed| pressed.what == what);
        let at = known.unwrap_or_else(|| {
            // The last row is that of all others.
            if self.hands.len() < ROWS_MAX {
                self.hands.push(HandAction { what, by: BTreeMap::new() });
            }
            self.hands.len() - 1
        });
        *self.hands[at].by.entry(hand.by.clone()).or_default() += 1;
    }

    fn program(&mut self, at_ms: u64, revision: u64, file: Option<&BehaviourFile>, knowledge: &dyn Knowledge) {
        self.reach(at_ms);
        // A file has a few thousand names at most.
        if let Some(file) = file.filter(|_| self.names.len() < NAMES_MAX) {
            for stream in &file.streams {
                self.names.insert(stream.id.clone(), short(&stream.name));
                if stream.kind != StreamKind::Ordinary {
                    self.row(&stream.id, Some((&stream.name, stream.kind)));
                }
            }
            for connector in &file.connectors {
                let name = self.name(&connector.output);
                self.names.insert(connector.id.clone(), name);
            }
        }
        if self.programs.len() < PROGRAMS_MAX {
            let (sentences, more) = match file.and_then(|file| told(file, self.words, knowledge)) {
                Some((sentences, more)) => (Some(sentences), more),
                None => (None, 0),
            };
            self.programs.push(RanProgram { at_ms, revision, sentences, more });
        }
    }
}

/// The sentences of a program, and the number of those that are too many; none if it is no program.
fn told(file: &BehaviourFile, words: Words, knowledge: &dyn Knowledge) -> Option<(Vec<String>, usize)> {
    let behaviour = file.records(|_| None).ok()?;
    let library = file.library();
    let helpers: Vec<&Helper> = library.iter().collect();
    let types = infer(&behaviour, &helpers, knowledge);
    // That it is a share says nothing beside a number.
    let unit = |id: &Id| match types.get(id) {
        Some(ValueType::Number { unit: Some(unit), .. }) if *unit != Unit::Fraction => Some(unit.symbol().to_owned()),
        _ => None,
    };
    let all = sentences::explain(&behaviour, &helpers, &unit, words.of_sentences());
    let told = all.iter().take(SENTENCES_MAX).map(|sentence| cut(&sentence.to_string(), SENTENCE_MAX_CHARS));
    Some((told.collect(), all.len().saturating_sub(SENTENCES_MAX)))
}

/// The text that a press told the robot: its value, or else the first text among its parameters.
fn text_of<'t>(value: &'t Value, params: &'t Params) -> &'t str {
    let texts = std::iter::once(value).chain(params.values()).filter_map(Value::as_text);
    texts.into_iter().find(|text| !text.is_empty()).unwrap_or_default()
}

fn short(text: &str) -> String {
    cut(text, TEXT_MAX_CHARS)
}

/// A text of at most so many signs.
fn cut(text: &str, chars: usize) -> String {
    match text.char_indices().nth(chars) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
