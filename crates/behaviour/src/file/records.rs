//! From a file to the records of a behaviour.

use super::{BehaviourFile, FORMAT, FileConnector, FileGroup, FileHelper, FileNote, FileStream, FileTile};
use crate::{
    BadId, Behaviour, Connector, Group, Helper, Id, Kind, Lookup, LookupSet, Note, Operation, Pad, Parameters,
    Procedure, Record, RecordId, Settings, Stream, TILE_KEYS, Tile, TileAction, Value, connectors,
};
use std::collections::{BTreeMap, BTreeSet};

/// Something in a file of which no records can be made. [`std::fmt::Display`] says it in one line: `id: reason`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// The id of the stream, connector, note or group, or `format`.
    pub at: String,
    /// The kind of flaw.
    pub kind: FlawKind,
}

/// The flaws of a part of a file. [`std::fmt::Display`] says each in a few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FlawKind {
    /// The file has this format, which is another one.
    Format(String),
    /// The id is not a valid one.
    Id(BadId),
    /// Something else in the file has this id too.
    IdTwice,
    /// The creation number is lower than the one above it in the file.
    Order {
        /// The creation number of this part.
        here: i64,
        /// The number of the one above it.
        above: i64,
    },
    /// The file gives it a creation number, but it is not there.
    OrderOfNothing,
    /// It names this stream, which is not there.
    NoStream(String),
    /// There is no connector with this word.
    NoConnector(String),
    /// A connector of this word needs a period, and has none or one of 0.
    NoPeriod(&'static str),
    /// Another group above it has this stream too.
    InTwoGroups(String),
    /// It has a body, and the name of a helper too.
    BodyAndHelper,
    /// A tile has no key of its own, or is not one of an action, a sense and a word.
    Tile,
}

impl BehaviourFile {
    /// The records of the file, with new ids from `new_id` (asked once per stream, connector, note and group) or, if it
    /// returns none, the file's own. Under a new id the creation number is the position in the file.
    ///
    /// # Errors
    /// Every flaw of the file.
    pub fn records(&self, mut new_id: impl FnMut(&str) -> Option<Id>) -> Result<Behaviour, Vec<Flaw>> {
        let mut flaws = Vec::new();
        if self.format != FORMAT {
            flaws.push(flaw("format", FlawKind::Format(self.format.clone())));
        }
        let mut ids = Lookup::new();
        for name in self.ids() {
            match new_id(name).map_or_else(|| Id::new(name), Ok) {
                Ok(id) if ids.insert(name.clone(), id.clone()).is_none() => {}
                Ok(_) => flaws.push(flaw(name, FlawKind::IdTwice)),
                Err(bad) => flaws.push(flaw(name, FlawKind::Id(bad))),
            }
        }
        self.check_order(&mut flaws);
        self.check_groups(&mut flaws);
        let mut records = self.to_records(&ids, &mut flaws);
        // What is gone keeps its own id in a place or group, or is left behind.
        let mut even_gone = |name: &String| {
            let own = || new_id(name).map_or_else(|| Id::new(name).ok(), |_| None);
            ids.get(name).cloned().or_else(own)
        };
        for (name, place) in &self.layout {
            if let Some(id) = even_gone(name) {
                records.insert(RecordId::new(Kind::Place, &id), Record::Place(*place));
            }
        }
        for (group, id) in self.groups.iter().filter_map(|group| Some((group, ids.get(&group.id)?))) {
            let streams = group.streams.iter().filter_map(&mut even_gone).collect();
            records.insert(RecordId::new(Kind::Group, id), Record::Group(group.record(streams)));
        }
        if let Some(tiles) = &self.pad {
            let tiles = pad_tiles(tiles, &mut even_gone, &mut flaws);
            records.insert(RecordId::pad(), Record::Pad(Pad { tiles }));
        }
        if flaws.is_empty() { Ok(Behaviour { records }) } else { Err(flaws) }
    }

    fn to_records(&self, ids: &Lookup<String, Id>, flaws: &mut Vec<Flaw>) -> BTreeMap<RecordId, Record> {
        let mut records = BTreeMap::new();
        let mut settings = Settings::named(&self.name);
        settings.robot = self.robot.clone().unwrap_or(settings.robot);
        settings.engine = self.engine.unwrap_or_default();
        settings.tags.clone_from(&self.tags);
        settings.exercise.clone_from(&self.exercise);
        records.insert(RecordId::settings(), Record::Settings(settings));
        for (at, (stream, id)) in (0..).zip(self.streams.iter().filter_map(|s| Some((s, ids.get(&s.id)?)))) {
            let order = self.order_under(&stream.id, ids, at);
            records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream.record(order)));
        }
        for (at, connector) in (0..).zip(&self.connectors) {
            let order = self.order_under(&connector.id, ids, at);
            match connector.record(order, ids) {
                Ok((id, record)) => {
                    drop(records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(record)))
                }
                Err(kind) => flaws.push(flaw(&connector.id, kind)),
            }
        }
        for (note, id) in self.notes.iter().filter_map(|n| Some((n, ids.get(&n.id)?))) {
            records.insert(RecordId::new(Kind::Note, id), Record::Note(note.record()));
        }
        records
    }

    fn ids(&self) -> impl Iterator<Item = &String> {
        let streams = self.streams.iter().map(|stream| &stream.id);
        let connectors = self.connectors.iter().map(|connector| &connector.id);
        let notes = self.notes.iter().map(|note| &note.id);
        streams.chain(connectors).chain(notes).chain(self.groups.iter().map(|group| &group.id))
    }

    /// The creation number of what has this id in the file, at this position.
    fn order_of(&self, name: &str, at: i64) -> i64 {
        self.order.get(name).copied().unwrap_or(at)
    }

    fn order_under(&self, name: &str, ids: &Lookup<String, Id>, at: i64) -> i64 {
        let kept = ids.get(name).is_some_and(|id| id.as_str() == name);
        if kept { self.order_of(name, at) } else { at }
    }

    /// The order of the file and the creation numbers must tell the same.
    fn check_order(&self, flaws: &mut Vec<Flaw>) {
        let streams: Vec<&str> = self.streams.iter().map(|stream| stream.id.as_str()).collect();
        let connectors: Vec<&str> = self.connectors.iter().map(|connector| connector.id.as_str()).collect();
        for names in [streams, connectors] {
            let numbered: Vec<_> = (0..).zip(names).map(|(at, name)| (self.order_of(name, at), name)).collect();
            let wrong = numbered.windows(2).filter(|pair| pair[0] > pair[1]);
            flaws.extend(wrong.map(|pair| {
                let ((above, _), (here, name)) = (pair[0], pair[1]);
                flaw(name, FlawKind::Order { here, above })
            }));
        }
        let ids: LookupSet<&str> = self.ids().map(String::as_str).collect();
        for name in self.order.keys().filter(|name| !ids.contains(name.as_str())) {
            flaws.push(flaw(name, FlawKind::OrderOfNothing));
        }
    }

    /// A stream is in one group at most.
    fn check_groups(&self, flaws: &mut Vec<Flaw>) {
        let mut seen: Lookup<&str, &str> = Lookup::new();
        for (group, stream) in self.groups.iter().flat_map(|group| group.streams.iter().map(move |id| (group, id))) {
            let other = seen.insert(stream, &group.id);
            if other.is_some_and(|other| other != group.id) {
                flaws.push(flaw(&group.id, FlawKind::InTwoGroups(stream.clone())));
            }
        }
    }

    /// The helpers as records of the library.
    #[must_use]
    pub fn library(&self) -> Vec<Helper> {
        let helper = |h: &FileHelper| Helper {
            name: h.name.clone(),
            params: h.params.clone(),
            body: h.body.clone(),
            says: h.says.clone(),
            takes: h.takes.clone(),
            gives: h.gives,
        };
        self.helpers.iter().map(helper).collect()
    }
}

/// The tiles of a pad. One whose stream is left behind is left behind too.
fn pad_tiles(
    all: &[FileTile],
    mut stream: impl FnMut(&String) -> Option<Id>,
    flaws: &mut Vec<Flaw>,
) -> BTreeMap<u8, Tile> {
    let (mut keys, mut tiles) = (BTreeSet::new(), BTreeMap::new());
    for tile in all {
        match tile.action().filter(|_| TILE_KEYS.contains(&tile.key) && keys.insert(tile.key)) {
            Some(does) => {
                let does = does.renamed(&mut stream);
                let asks = tile.asks.unwrap_or_default();
                tiles.extend(does.map(|does| (tile.key, Tile { label: tile.label.clone(), does, asks })));
            }
            None => flaws.push(flaw(&format!("tile {}", tile.key), FlawKind::Tile)),
        }
    }
    tiles
}

impl FileTile {
    /// The action of a press; none if the tile has not exactly one.
    #[must_use]
    pub fn action(&self) -> Option<TileAction<String>> {
        let Self { key: _, label: _, device, params, stream, value, word, span, asks } = self;
        let told = value.clone().unwrap_or(Value::Null);
        match (device, stream, word) {
            (Some(device), None, None) if span.is_none() => {
                let params = params.clone().unwrap_or_default();
                Some(TileAction::Hand { device: device.clone(), params, value: told })
            }
            (None, Some(stream), None) if params.is_none() && span.is_none() => {
                Some(TileAction::Pretend { stream: stream.clone(), value: told })
            }
            (None, None, Some(word)) if params.is_none() && value.is_none() && *asks != Some(true) => {
                Some(TileAction::Word { word: word.clone(), span: span.unwrap_or_default() })
            }
            _ => None,
        }
    }
}

fn flaw(at: &str, kind: FlawKind) -> Flaw {
    Flaw { at: at.to_owned(), kind }
}

impl FileNote {
    fn record(&self) -> Note {
        let by = self.by.clone().unwrap_or_default();
        Note { text: self.text.clone(), by, at_ms: self.at.unwrap_or_default() }
    }
}

impl FileGroup {
    fn record(&self, streams: BTreeSet<Id>) -> Group {
        Group { title: self.title.clone(), streams, folded: self.folded.unwrap_or_default() }
    }
}

impl FileStream {
    fn record(&self, order: i64) -> Stream {
        Stream {
            kind: self.kind,
            name: self.name.clone(),
            device: self.device.clone(),
            params: self.params.clone().unwrap_or_default(),
            order,
            resources: self.resources.clone(),
            priority: self.priority,
            hold_ms: self.hold_ms,
        }
    }
}

impl FileConnector {
    fn record(&self, order: i64, ids: &Lookup<String, Id>) -> Result<(Id, Connector), FlawKind> {
        let find = |name: &String| ids.get(name).cloned().ok_or_else(|| FlawKind::NoStream(name.clone()));
        let inputs = self.inputs.iter().map(find).collect::<Result<_, _>>()?;
        let connector = Connector { operation: self.operation()?, inputs, output: find(&self.output)?, order };
        Ok((find(&self.id)?, connector))
    }

    /// Reads the operation of the connector.
    ///
    /// # Errors
    /// Returns the flaw if it is no connector.
    pub fn operation(&self) -> Result<Operation, FlawKind> {
        let word = &self.operation;
        let spec = connectors::spec(word).ok_or_else(|| FlawKind::NoConnector(word.clone()))?;
        let procedure = if spec.takes.procedure.is_some() { self.procedure()? } else { None };
        if spec.takes.period.is_some() && self.period_ms.is_none() {
            return Err(FlawKind::NoPeriod(spec.word));
        }
        Ok(spec.with(Parameters { procedure, period_ms: self.period_ms, start: self.start.clone() }))
    }

    /// The procedure, if there is one.
    fn procedure(&self) -> Result<Option<Procedure>, FlawKind> {
        match (&self.body, &self.helper) {
            (Some(_), Some(_)) => Err(FlawKind::BodyAndHelper),
            (None, Some(helper)) => Ok(Some(Procedure::Helper(helper.clone()))),
            (Some(body), None) => Ok(Some(Procedure::Body { body: body.clone(), args: self.args.clone() })),
            (None, None) => Ok(None),
        }
    }
}
