//! From a file to the records of a behaviour.

use super::{BehaviourFile, FORMAT, FileConnector, FileHelper, FileStream};
use crate::{
    Behaviour, Connector, Helper, Id, Kind, Note, Operation, Parameters, Procedure, Record, RecordId, Settings, Stream,
    connectors,
};
use std::collections::{BTreeMap, BTreeSet};

impl BehaviourFile {
    /// The records of the file, with new ids from `new_id` (asked once per stream, connector and note) or, if it
    /// returns none, the file's own. Under a new id the creation number is the position in the file.
    ///
    /// # Errors
    /// One line per fault: `id: reason`.
    pub fn records(&self, mut new_id: impl FnMut(&str) -> Option<Id>) -> Result<Behaviour, Vec<String>> {
        let mut faults = Vec::new();
        if self.format != FORMAT {
            faults.push(format!("format: {:?} is not {FORMAT}", self.format));
        }
        let mut ids = BTreeMap::new();
        for name in self.ids() {
            match new_id(name).map_or_else(|| Id::new(name), Ok) {
                Ok(id) if ids.insert(name.clone(), id.clone()).is_none() => {}
                Ok(_) => faults.push(format!("{name}: this id is used twice")),
                Err(reason) => faults.push(format!("{name}: {reason}")),
            }
        }
        self.check_order(&mut faults);
        let mut records = self.to_records(&ids, &mut faults);
        for (name, place) in &self.layout {
            // A place of something that is gone keeps its own id, or is left behind.
            let own = || new_id(name).map_or_else(|| Id::new(name).ok(), |_| None);
            if let Some(id) = ids.get(name).cloned().or_else(own) {
                records.insert(RecordId::new(Kind::Place, &id), Record::Place(*place));
            }
        }
        if faults.is_empty() { Ok(Behaviour { records }) } else { Err(faults) }
    }

    fn to_records(&self, ids: &BTreeMap<String, Id>, faults: &mut Vec<String>) -> BTreeMap<RecordId, Record> {
        let mut records = BTreeMap::new();
        let mut settings = Settings::named(&self.name);
        settings.robot = self.robot.clone().unwrap_or(settings.robot);
        settings.engine = self.engine.unwrap_or_default();
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
                Err(reason) => faults.push(format!("{}: {reason}", connector.id)),
            }
        }
        for (note, id) in self.notes.iter().filter_map(|n| Some((n, ids.get(&n.id)?))) {
            records.insert(RecordId::new(Kind::Note, id), Record::Note(Note { text: note.text.clone() }));
        }
        records
    }

    fn ids(&self) -> impl Iterator<Item = &String> {
        let streams = self.streams.iter().map(|stream| &stream.id);
        let connectors = self.connectors.iter().map(|connector| &connector.id);
        streams.chain(connectors).chain(self.notes.iter().map(|note| &note.id))
    }

    /// The creation number of what has this id in the file, at this position.
    fn order_of(&self, name: &str, at: i64) -> i64 {
        self.order.get(name).copied().unwrap_or(at)
    }

    fn order_under(&self, name: &str, ids: &BTreeMap<String, Id>, at: i64) -> i64 {
        let kept = ids.get(name).is_some_and(|id| id.as_str() == name);
        if kept { self.order_of(name, at) } else { at }
    }

    /// The order of the file and the creation numbers must tell the same.
    fn check_order(&self, faults: &mut Vec<String>) {
        let streams: Vec<&str> = self.streams.iter().map(|stream| stream.id.as_str()).collect();
        let connectors: Vec<&str> = self.connectors.iter().map(|connector| connector.id.as_str()).collect();
        for names in [streams, connectors] {
            let numbered: Vec<_> = (0..).zip(names).map(|(at, name)| (self.order_of(name, at), name)).collect();
            let wrong = numbered.windows(2).filter(|pair| pair[0] > pair[1]);
            faults.extend(wrong.map(|pair| {
                let ((above, _), (here, name)) = (pair[0], pair[1]);
                format!("{name}: its order {here} comes before {above}, the one above it; leave order out of the file")
            }));
        }
        let ids: BTreeSet<_> = self.ids().collect();
        for name in self.order.keys().filter(|name| !ids.contains(name)) {
            faults.push(format!("{name}: order names it, but there is no such stream or connector"));
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
        };
        self.helpers.iter().map(helper).collect()
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
    fn record(&self, order: i64, ids: &BTreeMap<String, Id>) -> Result<(Id, Connector), String> {
        let find = |name: &String| ids.get(name).cloned().ok_or_else(|| format!("there is no stream {name:?}"));
        let inputs = self.inputs.iter().map(find).collect::<Result<_, _>>()?;
        let connector = Connector { operation: self.operation()?, inputs, output: find(&self.output)?, order };
        Ok((find(&self.id)?, connector))
    }

    /// What it does.
    ///
    /// # Errors
    /// Why it is no connector, in plain words.
    pub fn operation(&self) -> Result<Operation, String> {
        let word = &self.operation;
        let spec = connectors::spec(word).ok_or_else(|| format!("there is no connector {word:?}"))?;
        let procedure = if spec.takes.procedure.is_some() { self.procedure()? } else { None };
        if spec.takes.period.is_some() && self.period_ms.is_none() {
            return Err(format!("{word} needs a periodMs of 1 or more"));
        }
        Ok(spec.with(Parameters { procedure, period_ms: self.period_ms, start: self.start.clone() }))
    }

    /// The procedure, if there is one.
    fn procedure(&self) -> Result<Option<Procedure>, String> {
        match (&self.body, &self.helper) {
            (Some(_), Some(_)) => Err("it has both a body and a helper".to_owned()),
            (None, Some(helper)) => Ok(Some(Procedure::Helper(helper.clone()))),
            (Some(body), None) => Ok(Some(Procedure::Body { body: body.clone(), args: self.args.clone() })),
            (None, None) => Ok(None),
        }
    }
}
