//! Large behaviours in parts: how the records of a welcome, or of a behaviour as it is or was, are cut, and put together again.

use crate::{AnyAnswer, Message, answer};
use behaviour::{Behaviour, RecordId, record_bytes};
use phrase::{Phrase, Phrased, phrase};
use std::ops::Bound;

/// The records of one part, in bytes as [`behaviour::record_bytes`] counts them; a larger record is a part of its own.
pub const PART_MAX_BYTES: usize = 128 << 10;

/// The place up to which the records of a behaviour were given, part after part; each is copied only when it is its
/// turn.
#[derive(Clone, Debug, Default)]
pub struct PartsCursor {
    /// The last record that was given.
    last: Option<RecordId>,
    ended: bool,
}

/// Some records, and whether more follow.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordsPart {
    /// In order of id.
    pub records: Behaviour,
    /// True if another part follows.
    pub more: bool,
}

impl PartsCursor {
    /// The next part of this behaviour, always the same one; there is at least one.
    pub fn next(&mut self, whole: &Behaviour) -> Option<RecordsPart> {
        if self.ended {
            return None;
        }
        let from = self.last.as_ref().map_or(Bound::Unbounded, Bound::Excluded);
        let mut left = whole.records.range((from, Bound::Unbounded)).peekable();
        let (mut part, mut bytes) = (Behaviour::default(), 0);
        while let Some((id, record)) = left.peek() {
            bytes += record_bytes(id, record);
            if bytes > PART_MAX_BYTES && !part.records.is_empty() {
                break;
            }
            part.records.insert((*id).clone(), (*record).clone());
            left.next();
        }
        let more = left.peek().is_some();
        self.last = part.records.last_key_value().map(|(id, _)| id.clone());
        self.ended = !more;
        Some(RecordsPart { records: part, more })
    }
}

impl AnyAnswer {
    /// A welcome, or a behaviour as it is or was, with its first part.
    #[must_use]
    pub fn with(mut self, part: RecordsPart) -> Self {
        if let Some((records, more)) = self.records() {
            (*records, *more) = (part.records, part.more);
        }
        self
    }

    /// The records of an answer that comes in parts, and whether more follow.
    fn records(&mut self) -> Option<(&mut Behaviour, &mut bool)> {
        match self {
            Self::Welcome(answer::Welcome { library: records, more, .. })
            | Self::Opened(answer::Opened { records, more, .. })
            | Self::At(answer::At { records, more, .. }) => Some((records, more)),
            _ => None,
        }
    }
}

/// Puts an answer together whose records come in parts. Everything that is told goes through it.
#[derive(Debug, Default)]
pub struct Assembly {
    begun: Option<(u32, AnyAnswer)>,
    parts: u32,
}

impl Assembly {
    /// Returns what is to be heard now: the message itself, the whole of what came in parts with its last one, or
    /// nothing yet.
    ///
    /// # Errors
    /// If a part is missing: then everything has to be fetched anew.
    pub fn take(&mut self, message: Message) -> Result<Option<Message>, PartMissing> {
        match message {
            Message::Records { part, records, more } => self.add(part, *records, more),
            Message::Answer { ask, mut answer } => {
                if answer.records().is_none_or(|(_, more)| !*more) {
                    return Ok(Some(Message::Answer { ask, answer }));
                }
                (self.begun, self.parts) = (Some((ask, answer)), 0);
                Ok(None)
            }
            other @ (Message::No { .. } | Message::Event(_)) => Ok(Some(other)),
        }
    }

    fn add(&mut self, part: u32, mut records: Behaviour, more: bool) -> Result<Option<Message>, PartMissing> {
        self.parts += 1;
        let whole = self.begun.as_mut().and_then(|(_, answer)| answer.records());
        let (all, follows) = whole.filter(|_| part == self.parts).ok_or(PartMissing)?;
        all.records.append(&mut records.records);
        *follows = more;
        Ok(if more { None } else { self.begun.take().map(|(ask, answer)| Message::Answer { ask, answer }) })
    }
}

/// A part of an answer did not come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartMissing;

phrase::shown!(PartMissing);

impl Phrased for PartMissing {
    fn phrase(&self) -> Phrase {
        phrase!("PartMissing", "a part of the program did not come")
    }
}

impl std::error::Error for PartMissing {}

#[cfg(test)]
mod tests {
    use super::{Assembly, PART_MAX_BYTES, PartMissing, PartsCursor};
    use crate::{AnyAnswer, Event, Message, answer};
    use behaviour::{Behaviour, Id, Kind, Note, Record, RecordId};

    /// Notes of this many characters.
    fn behaviour(lengths: &[usize]) -> Behaviour {
        let record = |(at, length): (usize, &usize)| {
            let id = RecordId::new(Kind::Note, &Id::new(&format!("n{at:04}")).unwrap());
            (id, Record::Note(Note::new("n".repeat(*length))))
        };
        Behaviour { records: lengths.iter().enumerate().map(record).collect() }
    }

    fn opened() -> AnyAnswer {
        let (behaviour, records) = (Id::new("b").unwrap(), Box::default());
        let (problems, people) = (Vec::new(), Vec::new());
        answer::Opened { behaviour, revision: 3, records, more: false, problems, fingerprint: 0, people }.into()
    }

    /// The messages as they are sent.
    fn messages(whole: &Behaviour) -> Vec<Message> {
        let mut first = Some(opened());
        let mut parts = PartsCursor::default();
        let parts = (0..).zip(std::iter::from_fn(|| parts.next(whole)));
        let messages = parts.map(|(at, part)| match first.take() {
            Some(first) => Message::Answer { ask: 7, answer: first.with(part) },
            None => Message::Records { part: at, records: Box::new(part.records), more: part.more },
        });
        messages.collect()
    }

    #[test]
    fn parts_are_put_together_to_the_whole() {
        let large = [PART_MAX_BYTES * 2, 1, PART_MAX_BYTES, 5, 5];
        for (lengths, many) in [(&[][..], 1), (&[10, 10], 1), (&[60_000; 9], 5), (&large, 4)] {
            let whole = behaviour(lengths);
            let sent = messages(&whole);
            assert_eq!(sent.len(), many, "{} records", lengths.len());
            let mut assembly = Assembly::default();
            let mut heard: Vec<Message> = Vec::new();
            for message in sent {
                assert!(heard.is_empty(), "nothing before the last part");
                heard.extend(assembly.take(message).unwrap());
                let ping = Message::Event(Event::ProgramsChanged);
                assert_eq!(assembly.take(ping.clone()), Ok(Some(ping)), "the rest passes");
            }
            let wanted = opened().with(super::RecordsPart { records: whole, more: false });
            assert_eq!(heard, [Message::Answer { ask: 7, answer: wanted }]);
        }
    }

    #[test]
    fn a_part_that_is_missing_is_noticed() {
        let mut sent = messages(&behaviour(&[60_000; 9]));
        sent.remove(2);
        let mut assembly = Assembly::default();
        let heard: Vec<_> = sent.into_iter().map(|message| assembly.take(message)).collect();
        assert_eq!(heard[..3], [Ok(None), Ok(None), Err(PartMissing)]);
        let stray = Message::Records { part: 1, records: Box::default(), more: false };
        assert_eq!(Assembly::default().take(stray), Err(PartMissing));
    }
}
