//! The size of records, so that the whole stays within what messages, files and backups carry.
//!
//! A size is never smaller than what the record takes in any of its written forms (messages, JSON, XML), so what keeps
//! the bounds can be sent, exported and imported again. It depends on nothing but the record, and the size of a whole is
//! kept up to date edit by edit.

use crate::{
    Behaviour, Change, Connector, Edit, Group, Helper, Id, Kind, Note, Pad, Procedure, Record, RecordId, Refusal,
    Settings, Stream, TileAction, Value,
};
use phrase::{Phrase, Phrased, phrase, word};

/// The streams, connectors, places, notes, groups, pad and settings of one behaviour together, in bytes.
pub const BEHAVIOUR_MAX_BYTES: usize = 6 << 20;
/// All helpers of the library together, in bytes.
pub const LIBRARY_MAX_BYTES: usize = 2 << 20;
/// One record, in bytes: what it was and what it becomes fit together into one message.
pub(crate) const RECORD_MAX_BYTES: usize = 96 << 10;
/// Helpers in the library.
pub const HELPERS_MAX: usize = 1_000;
/// Notes in one behaviour.
pub const NOTES_MAX: usize = 2_000;
/// Groups in one behaviour.
pub const GROUPS_MAX: usize = 200;
/// Entries of all lists in one behaviour: inputs and arguments of connectors, parameters and resources of streams.
pub const ENTRIES_MAX: usize = 40_000;
/// Places in one behaviour: one for each stream, connector, note and group.
pub const PLACES_MAX: usize = crate::STREAMS_MAX + crate::CONNECTORS_MAX + NOTES_MAX + GROUPS_MAX;

/// The most bytes of a character that JSON or XML escape.
const ESCAPED_BYTES: usize = 8;
/// A file's own words and its sections.
const SETTINGS_BYTES: usize = 1_024;
const HELPER_BYTES: usize = 96;
const STREAM_BYTES: usize = 256;
const CONNECTOR_BYTES: usize = 224;
const PLACE_BYTES: usize = 96;
const NOTE_BYTES: usize = 128;
const GROUP_BYTES: usize = 128;
const PAD_BYTES: usize = 64;
const TILE_BYTES: usize = 192;
/// The marks around one stream of a group, of which many are in one line of a file.
const MEMBER_BYTES: usize = 12;
/// The words around one name, input or argument of a list.
const ITEM_BYTES: usize = 32;
/// The words around one phrase in another one.
const PHRASE_BYTES: usize = 64;
/// The words around one parameter of a device.
const PARAM_BYTES: usize = 48;
const NUMBER_BYTES: usize = 25;
/// Quotes, a comma and a blank.
const MARKS_BYTES: usize = 20;
/// The ids that a copy gets: an import must not fail because they are longer than those in the file.
const NEW_ID_BYTES: usize = 32;
/// The number of times that an id stands in a file: at its thing, its order and its place.
const ID_TIMES: usize = 3;

/// The size of a behaviour or library, in counts and bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Size {
    helpers: Amount,
    streams: Amount,
    connectors: Amount,
    places: Amount,
    notes: Amount,
    groups: Amount,
    pads: Amount,
    settings: Amount,
}

/// Records of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Amount {
    count: usize,
    bytes: usize,
    entries: usize,
}

impl Size {
    /// Returns the size of all records.
    pub(crate) fn of(behaviour: &Behaviour) -> Self {
        let mut size = Self::default();
        behaviour.records.iter().for_each(|(id, record)| size.add(id, record));
        size
    }

    /// After a change that was made to what has this size.
    pub(crate) fn after(mut self, change: &Change) -> Self {
        for Edit { id, before, after } in &change.edits {
            if let Some(record) = before {
                self.take(id, record);
            }
            if let Some(record) = after {
                self.add(id, record);
            }
        }
        self
    }

    fn add(&mut self, id: &RecordId, record: &Record) {
        let amount = self.of_kind(id.kind);
        amount.count += 1;
        amount.bytes += record_bytes(id, record);
        amount.entries += entries(record);
    }

    fn take(&mut self, id: &RecordId, record: &Record) {
        let amount = self.of_kind(id.kind);
        amount.count = amount.count.saturating_sub(1);
        amount.bytes = amount.bytes.saturating_sub(record_bytes(id, record));
        amount.entries = amount.entries.saturating_sub(entries(record));
    }

    fn of_kind(&mut self, kind: Kind) -> &mut Amount {
        match kind {
            Kind::Settings => &mut self.settings,
            Kind::Helper => &mut self.helpers,
            Kind::Stream => &mut self.streams,
            Kind::Connector => &mut self.connectors,
            Kind::Place => &mut self.places,
            Kind::Note => &mut self.notes,
            Kind::Group => &mut self.groups,
            Kind::Pad => &mut self.pads,
        }
    }

    /// Returns the bytes of everything.
    pub(crate) fn bytes(&self) -> usize {
        self.helpers.bytes + self.behaviour_bytes()
    }

    /// Returns the bytes of everything but helpers, which live in the library.
    fn behaviour_bytes(&self) -> usize {
        let all = [self.settings, self.streams, self.connectors, self.places, self.notes, self.groups, self.pads];
        all.iter().map(|amount| amount.bytes).sum()
    }

    fn behaviour_entries(&self) -> usize {
        self.streams.entries + self.connectors.entries + self.pads.entries
    }

    /// Checks that this size fits. A whole that is too large already, made by an older version, may become smaller or
    /// stay.
    ///
    /// # Errors
    /// The first bound that is passed.
    pub(crate) fn check(&self, before: &Self) -> Result<(), Refusal> {
        let counts = [
            (word!("many.helpers", "helpers"), self.helpers.count, before.helpers.count, HELPERS_MAX),
            (word!("many.streams", "streams"), self.streams.count, before.streams.count, crate::STREAMS_MAX),
            (
                word!("many.connectors", "connectors"),
                self.connectors.count,
                before.connectors.count,
                crate::CONNECTORS_MAX,
            ),
            (word!("many.notes", "notes"), self.notes.count, before.notes.count, NOTES_MAX),
            (word!("many.groups", "groups"), self.groups.count, before.groups.count, GROUPS_MAX),
            (word!("many.places", "places"), self.places.count, before.places.count, PLACES_MAX),
            (
                word!("many.entries", "inputs, arguments and parameters"),
                self.behaviour_entries(),
                before.behaviour_entries(),
                ENTRIES_MAX,
            ),
        ];
        if let Some((what, .., most)) = counts.into_iter().find(|(_, now, before, most)| now > most && now > before) {
            return Err(Refusal::TooMany(what.phrase(), most));
        }
        let (helpers, behaviour) = (self.helpers.bytes, self.behaviour_bytes());
        if helpers > LIBRARY_MAX_BYTES && helpers > before.helpers.bytes {
            return Err(Refusal::Full(phrase!("full.library", "library"), LIBRARY_MAX_BYTES));
        }
        if behaviour > BEHAVIOUR_MAX_BYTES && behaviour > before.behaviour_bytes() {
            return Err(Refusal::Full(phrase!("full.program", "program"), BEHAVIOUR_MAX_BYTES));
        }
        Ok(())
    }
}

/// Returns the most bytes that one record takes in a message or a file.
#[must_use]
pub fn record_bytes(id: &RecordId, record: &Record) -> usize {
    let own = match record {
        Record::Settings(settings) => settings_bytes(settings),
        Record::Helper(helper) => helper_bytes(helper),
        Record::Stream(stream) => stream_bytes(stream),
        Record::Connector(connector) => connector_bytes(connector),
        Record::Place(_) => PLACE_BYTES,
        Record::Note(Note { text, by, at_ms: _ }) => NOTE_BYTES + text_bytes(text) + text_bytes(by),
        Record::Group(group) => group_bytes(group),
        Record::Pad(pad) => pad_bytes(pad),
    };
    own + ID_TIMES * id_bytes(&id.id)
}

/// Counts the entries in the lists of a stream or connector, and in the tiles of a pad.
fn entries(record: &Record) -> usize {
    match record {
        Record::Stream(stream) => {
            stream.params.values().map(value_entries).sum::<usize>() + stream.resources.as_deref().map_or(0, <[_]>::len)
        }
        Record::Connector(connector) => {
            let args = match connector.operation.procedure() {
                Some(Procedure::Body { args: Some(args), .. }) => args.len(),
                _ => 0,
            };
            connector.inputs.len() + args + connector.operation.start().map_or(0, value_entries)
        }
        Record::Pad(pad) => {
            let values = pad.tiles.values().flat_map(|tile| tile.does.values());
            values.map(|(_, value)| value_entries(value)).sum()
        }
        Record::Settings(_) | Record::Helper(_) | Record::Place(_) | Record::Note(_) | Record::Group(_) => 0,
    }
}

/// A value, and all values in it.
fn value_entries(value: &Value) -> usize {
    match value {
        Value::List(items) => 1 + items.iter().map(value_entries).sum::<usize>(),
        Value::Map(fields) => 1 + fields.values().iter().map(value_entries).sum::<usize>(),
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) | Value::Text(_) => 1,
    }
}

impl Edit {
    /// Returns the most bytes that the edit takes in a message.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let records = [&self.before, &self.after].into_iter().flatten();
        ITEM_BYTES + records.map(|record| record_bytes(&self.id, record)).sum::<usize>()
    }
}

impl Change {
    /// Returns the most bytes that the change takes in a message.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let names = [Some(&self.op), self.by.as_ref(), self.undoes.as_ref()].into_iter().flatten();
        let names = names.map(|name| ITEM_BYTES + name.as_str().len()).sum::<usize>();
        let texts = text_bytes(&self.author) + phrase_bytes(&self.label) + names;
        STREAM_BYTES + texts + self.edits.iter().map(Edit::bytes).sum::<usize>()
    }
}

/// The most bytes of a phrase: its words, and the names around them.
fn phrase_bytes(phrase: &Phrase) -> usize {
    let words = match phrase {
        Phrase::Text(text) => text_bytes(text),
        Phrase::Number(_) => 0,
        Phrase::List(list) => list.iter().map(phrase_bytes).sum(),
        Phrase::Keyed(keyed) => {
            let with = keyed.with.iter().map(|(name, phrase)| ITEM_BYTES + text_bytes(name) + phrase_bytes(phrase));
            text_bytes(&keyed.key) + text_bytes(&keyed.english) + with.sum::<usize>()
        }
    };
    PHRASE_BYTES + words
}

fn settings_bytes(settings: &Settings) -> usize {
    let texts = [&settings.name, &settings.robot].into_iter().chain(&settings.exercise);
    SETTINGS_BYTES + texts.map(|text| text_bytes(text)).sum::<usize>() + names_bytes(&settings.tags)
}

fn group_bytes(group: &Group) -> usize {
    let members = group.streams.iter().map(|id| MEMBER_BYTES + id_bytes(id));
    GROUP_BYTES + text_bytes(&group.title) + members.sum::<usize>()
}

fn pad_bytes(pad: &Pad) -> usize {
    let tiles = pad.tiles.values().map(|tile| {
        let own = match &tile.does {
            TileAction::Hand { device, .. } => text_bytes(device),
            TileAction::Pretend { stream, .. } => id_bytes(stream),
            TileAction::Word { word, .. } => text_bytes(word),
        };
        let values = tile.does.values().map(|(name, value)| PARAM_BYTES + text_bytes(name) + value_bytes(value));
        TILE_BYTES + text_bytes(&tile.label) + own + values.sum::<usize>()
    });
    PAD_BYTES + tiles.sum::<usize>()
}

fn helper_bytes(helper: &Helper) -> usize {
    let texts = [&helper.name, &helper.body, &helper.says].into_iter().map(|text| text_bytes(text));
    let gives = if helper.gives.is_auto() { 0 } else { ITEM_BYTES };
    HELPER_BYTES + texts.sum::<usize>() + names_bytes(&helper.params) + ITEM_BYTES * helper.takes.len() + gives
}

fn stream_bytes(stream: &Stream) -> usize {
    let params = stream.params.iter().map(|(name, value)| PARAM_BYTES + text_bytes(name) + value_bytes(value));
    let texts = text_bytes(&stream.name) + stream.device.as_deref().map_or(0, text_bytes);
    STREAM_BYTES + texts + params.sum::<usize>() + stream.resources.as_deref().map_or(0, names_bytes)
}

fn connector_bytes(connector: &Connector) -> usize {
    let inputs = connector.inputs.iter().map(|id| ITEM_BYTES + id_bytes(id));
    let procedure = match connector.operation.procedure() {
        Some(Procedure::Body { body, args }) => text_bytes(body) + args.as_deref().map_or(0, names_bytes),
        Some(Procedure::Helper(name)) => text_bytes(name),
        None => 0,
    };
    let start = connector.operation.start().map_or(0, |start| PARAM_BYTES + value_bytes(start));
    CONNECTOR_BYTES + id_bytes(&connector.output) + inputs.sum::<usize>() + procedure + start
}

fn names_bytes(names: &[String]) -> usize {
    names.iter().map(|name| ITEM_BYTES + text_bytes(name)).sum()
}

fn value_bytes(value: &Value) -> usize {
    match value {
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => NUMBER_BYTES,
        Value::Text(text) => MARKS_BYTES + text_bytes(text),
        Value::List(items) => MARKS_BYTES + items.iter().map(|item| 2 + value_bytes(item)).sum::<usize>(),
        Value::Map(fields) => {
            let field =
                |(name, value): (&std::sync::Arc<str>, &Value)| MARKS_BYTES + text_bytes(name) + value_bytes(value);
            MARKS_BYTES + fields.iter().map(field).sum::<usize>()
        }
    }
}

fn id_bytes(id: &Id) -> usize {
    id.as_str().len().max(NEW_ID_BYTES)
}

fn text_bytes(text: &str) -> usize {
    let takes = |byte| if matches!(byte, b'"' | b'&' | b'<' | b'>' | b'\\' | 0..=31) { ESCAPED_BYTES } else { 1 };
    text.bytes().map(takes).sum()
}

#[cfg(test)]
mod tests {
    use super::{Size, record_bytes};
    use crate::{Behaviour, Change, Id, Kind, Note, Place, Record, RecordId};
    use phrase::Phrase;

    fn note(text: &str) -> Record {
        Record::Note(Note::new(text.into()))
    }

    #[test]
    fn the_size_of_a_whole_is_kept_edit_by_edit() {
        let id = |name: &str| RecordId::new(Kind::Note, &Id::new(name).unwrap());
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(id("a"), note("one"));
        behaviour.records.insert(id("b"), note("two"));
        let place = RecordId::new(Kind::Place, &Id::new("a").unwrap());
        let change = Change::of(Id::new("op").unwrap(), "Aiko", "Tidy").take(&behaviour, id("a"));
        let change = change.put(&behaviour, id("b"), note("longer")).put(&behaviour, id("c"), note("new"));
        let change = change.put(&behaviour, place, Record::Place(Place { x: 1.0, y: 2.0 }));
        let size = Size::of(&behaviour).after(&change);
        behaviour.apply(&change);
        assert_eq!(size, Size::of(&behaviour));
    }

    #[test]
    fn a_label_is_never_larger_in_a_message_than_it_counts() {
        let named = |with| Phrase::of("label.\u{1}", "{of}\u{2}\\", vec![("\u{3}", with)]);
        let all =
            [Phrase::from("\u{1}\"".repeat(300)), Phrase::Number(f64::MIN_POSITIVE), named(Phrase::List(Vec::new()))];
        for label in all.into_iter().chain([named(named(Phrase::List(vec![Phrase::default(); 40])))]) {
            let change = Change::of(Id::new("op").unwrap(), "Aiko", label);
            let sent = serde_json::to_string(&change).unwrap();
            assert!(change.bytes() >= sent.len(), "{} of {sent}", change.bytes());
        }
    }

    #[test]
    fn a_copy_under_new_ids_is_as_large() {
        let size = |id: &str| record_bytes(&RecordId::new(Kind::Note, &Id::new(id).unwrap()), &note("n"));
        assert_eq!(size("n1"), size("0123456789abcdef0123456789abcdef"));
        assert!(size(&"n".repeat(64)) > size("n1"));
    }

    #[test]
    fn all_streams_fit_into_one_group_and_count_in_full() {
        let id = |at: usize| Id::new(&format!("{at:032}")).unwrap();
        let streams = (0..crate::STREAMS_MAX).map(id).collect();
        let group = Record::Group(crate::Group { title: "All \"of\" them".into(), streams, folded: true });
        let key = RecordId::new(Kind::Group, &id(0));
        let bytes = record_bytes(&key, &group);
        assert!(bytes <= super::RECORD_MAX_BYTES, "{bytes}");
        assert!(bytes >= serde_json::to_string(&(&key, &group)).unwrap().len());
    }

    #[test]
    fn what_is_written_in_a_longer_way_counts_so() {
        let id = RecordId::new(Kind::Note, &Id::new("a").unwrap());
        for text in ["plain", "a < b && \"c\"", "\u{1}\u{1f}\n\t", "赤いボール"] {
            let written = serde_json::to_string(&(&id, note(text))).unwrap();
            assert!(record_bytes(&id, &note(text)) >= written.len(), "{text:?}");
            let signed = Record::Note(Note { text: text.into(), by: text.into(), at_ms: u64::MAX });
            let written = serde_json::to_string(&(&id, &signed)).unwrap();
            assert!(record_bytes(&id, &signed) >= written.len(), "{text:?}");
        }
    }
}
