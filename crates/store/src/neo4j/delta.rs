//! The effect of a change in the graph, as lists that one statement works through.

use super::link::StatementParams;
use super::nodes::{
    device_kind, label, of_connector, of_group, of_helper, of_note, of_pad, of_settings, of_stream, relationship, whole,
};
use crate::json::unwritable;
use crate::query::name_key;
use crate::usage::{uses, words};
use crate::{LIBRARY, StoreError, Unkept, search_text};
use behaviour::{Behaviour, Committed, Connector, Helper, Id, Kind, Record, RecordId, Stream};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// The lists of one change, by the names they have in the statement. A list that is not there is empty.
pub(super) struct Delta {
    program: Id,
    /// Lists by name.
    pub(super) lists: BTreeMap<&'static str, Vec<Value>>,
    devices: BTreeSet<(&'static str, String)>,
    inputs: usize,
    /// The properties for the behaviour's own node; null takes away.
    summary: StatementParams,
}

impl Delta {
    /// Collects the effect of this change in a behaviour, which then is `after`.
    pub(super) fn of(program: &Id, committed: &Committed, after: &Behaviour) -> Result<Self, StoreError> {
        let lists = BTreeMap::new();
        let program = program.clone();
        let mut delta = Self { program, lists, devices: BTreeSet::new(), inputs: 0, summary: StatementParams::new() };
        // A record named twice is what it is last.
        let edits: BTreeMap<&RecordId, Option<&Record>> =
            committed.change.edits.iter().map(|edit| (&edit.id, edit.after.as_ref())).collect();
        for (key, record) in &edits {
            delta.edit(key, *record, committed.revision > 1)?;
        }
        delta.summarise(committed, after).map_err(unwritable)?;
        let helpers: BTreeSet<&Id> = edits.keys().filter(|key| key.kind == Kind::Helper).map(|key| &key.id).collect();
        if delta.program.as_str() == LIBRARY && !helpers.is_empty() {
            delta.link_helpers(&helpers, after);
        }
        Ok(delta)
    }

    /// The parameters of the statement.
    pub(super) fn params(self) -> StatementParams {
        let devices: Vec<_> =
            self.devices.into_iter().map(|(kind, name)| json!({ "kind": kind, "name": name })).collect();
        let mut params: StatementParams =
            self.lists.into_iter().map(|(name, list)| (name.to_owned(), list.into())).collect();
        params.insert("devices".to_owned(), devices.into());
        params.insert("inputs".to_owned(), self.inputs.into());
        params.insert("summary".to_owned(), self.summary.into());
        params
    }

    /// True if the statement needs this list.
    pub(super) fn has(&self, list: &str) -> bool {
        if list == "devices" { !self.devices.is_empty() } else { self.lists.contains_key(list) }
    }

    fn put(&mut self, list: &'static str, what: Value) {
        self.lists.entry(list).or_default().push(what);
    }

    fn edit(&mut self, key: &RecordId, record: Option<&Record>, is_old: bool) -> Result<(), StoreError> {
        let is_other = match key.kind {
            Kind::Settings => *key != RecordId::settings(),
            Kind::Pad => *key != RecordId::pad(),
            _ => false,
        };
        if is_other {
            return Err(StoreError::Refused(Unkept::OtherName(key.clone())));
        }
        if key.kind == Kind::Connector && is_old {
            self.put("connectors", json!(key.id));
        }
        match record {
            None => self.take(key),
            Some(Record::Stream(stream)) => self.put_stream(&key.id, stream).map_err(unwritable)?,
            Some(record @ Record::Connector(connector)) => {
                self.put_connector(&key.id, record, connector).map_err(unwritable)?;
            }
            Some(record @ Record::Helper(helper)) => {
                let properties = of_helper(&self.program, &key.id, record, helper);
                self.put("helpers", json!({ "id": key.id, "properties": properties }));
            }
            Some(Record::Place(place)) => self.put("places", json!({ "id": key.id, "x": place.x, "y": place.y })),
            Some(Record::Note(note)) => self.put("notes", of_note(&key.id, note)),
            Some(Record::Group(group)) => self.put("groups", of_group(&key.id, group)),
            Some(Record::Settings(_) | Record::Pad(_)) => {}
        }
        Ok(())
    }

    fn take(&mut self, key: &RecordId) {
        match key.kind {
            Kind::Stream => self.put("gone_streams", json!(key.id)),
            Kind::Helper => self.put("gone_helpers", json!(key.id)),
            Kind::Place => self.put("gone_places", json!(key.id)),
            Kind::Note => self.put("gone_notes", json!(key.id)),
            Kind::Group => self.put("gone_groups", json!(key.id)),
            Kind::Connector | Kind::Settings | Kind::Pad => {}
        }
    }

    fn put_stream(&mut self, id: &Id, stream: &Stream) -> serde_json::Result<()> {
        let properties = of_stream(&self.program, id, stream)?;
        let kind = device_kind(stream.kind);
        let device = stream.device.as_ref().map(|name| json!({ "kind": kind, "name": name }));
        self.devices.extend(stream.device.as_ref().map(|name| (kind, name.clone())));
        let label = label(stream.kind);
        self.put("streams", json!({ "id": id, "label": label, "properties": properties, "device": device }));
        Ok(())
    }

    fn put_connector(&mut self, id: &Id, record: &Record, connector: &Connector) -> serde_json::Result<()> {
        let properties = of_connector(&self.program, id, record, connector)?;
        let (label, output) = (connector.operation.spec().graph.label, &connector.output);
        if let Some(kind) = relationship(connector) {
            let input = &connector.inputs[0];
            self.put("simple", json!({ "type": kind, "input": input, "output": output, "properties": properties }));
            return Ok(());
        }
        if let Some(helper) = properties.get("helper").filter(|helper| !helper.is_null()) {
            self.put("named", json!({ "id": id, "helper": helper }));
            self.lock_helpers();
        }
        self.inputs += connector.inputs.len();
        let inputs = &connector.inputs;
        self.put("nodes", json!({ "label": label, "inputs": inputs, "output": output, "properties": properties }));
        Ok(())
    }

    fn lock_helpers(&mut self) {
        self.lists.insert("doors", vec![json!("helpers")]);
    }

    /// The touched helpers are linked anew: from the connectors that name them, and with the helpers that they call
    /// or that call them.
    fn link_helpers(&mut self, touched: &BTreeSet<&Id>, after: &Behaviour) {
        self.lock_helpers();
        let named: Vec<(&Id, &Helper)> = after.helpers().collect();
        for (id, helper) in &named {
            if touched.contains(*id) {
                self.put("linked", json!(id));
            }
            let record = Record::Helper((*helper).clone());
            let words = words(&record);
            for (other, called) in named.iter().filter(|(_, called)| words.contains(&called.name)) {
                if (touched.contains(*id) || touched.contains(*other)) && uses(&record, &called.name) {
                    self.put("calls", json!({ "from": id, "to": other }));
                }
            }
        }
    }

    /// Collects what lists and searches show; a move changes nothing there but the time.
    fn summarise(&mut self, committed: &Committed, after: &Behaviour) -> serde_json::Result<()> {
        let change = &committed.change;
        let mut put = |name: &str, value: Value| self.summary.insert(name.to_owned(), value);
        put("changed_ms", whole(change.at_ms));
        put("by", change.author.clone().into());
        if committed.revision == 1 {
            put("owner", change.author.clone().into());
        }
        if committed.revision > 1 && change.edits.iter().all(|edit| edit.id.kind == Kind::Place) {
            return Ok(());
        }
        let settings = after.settings();
        put("pad_json", of_pad(after.pad())?);
        put("streams", after.streams().count().into());
        put("search", search_text(after).into());
        put("name_key", settings.map(|settings| name_key(&settings.name)).into());
        if let Value::Object(own) = of_settings(settings)? {
            self.summary.extend(own);
        }
        Ok(())
    }
}
