//! From the editor to signals: the one signal of every touched record, and nothing else.

use super::{ConnectorSignals, Document, DocumentEvent, DocumentState, StreamSignals};
use crate::desk::tab::set_if_new;
use crate::layout::Tidy;
use behaviour::{Behaviour, Connector, Id, Kind, Place, Record, RecordId, Stream, StreamKind};
use editor::RecordNews;
use leptos::prelude::*;
use std::collections::{BTreeMap, HashMap};

impl Document {
    /// Brings the signals of the records up to what the editor says is another one now.
    pub(super) fn show_records(&self, news: RecordNews) {
        let mut touched = news.touched;
        if news.is_whole {
            let state = &*self.state();
            touched.extend(state.streams.keys().map(|id| RecordId::new(Kind::Stream, id)));
            touched.extend(state.connectors.keys().map(|id| RecordId::new(Kind::Connector, id)));
            touched.extend(state.notes.keys().map(|id| RecordId::new(Kind::Note, id)));
            touched.extend(state.groups.keys().map(|id| RecordId::new(Kind::Group, id)));
        }
        if !touched.is_empty() {
            self.refresh(&touched);
        }
    }

    /// Shows the records of another program in place of the open one, only to look at; with none the open one again.
    pub(crate) fn show_then(&self, then: Option<Behaviour>) {
        self.input(|editor| editor.show_past(then));
    }

    /// Does something with the open program as it is now, though one of the past may be shown.
    pub(crate) fn with_now(&self, act: impl FnOnce(&Self)) {
        let (mut at, then) = (None, self.state().editor.swap_past(None));
        self.tab.then.update_untracked(|shown| at = shown.take());
        act(self);
        self.tab.then.update_untracked(|shown| *shown = at);
        self.show_then(then);
    }

    /// Lays out with `tidy` what nobody placed, from now on: it may come later than the behaviour that needs it.
    pub(crate) fn lay_out_with(&self, tidy: Tidy) {
        if self.input(|editor| editor.lay_out_with(tidy)) {
            self.laid_out.notify();
        }
    }

    /// Tells the width and height of the stage that are free: the next layout fits it.
    pub(crate) fn tell_stage(&self, free: (f64, f64)) {
        self.state().editor.tell_stage(free);
    }

    /// Places for the streams of a behaviour that nobody placed.
    pub(crate) fn missing_places(&self, behaviour: &Behaviour) -> BTreeMap<Id, Place> {
        self.state().editor.missing_places(behaviour)
    }

    /// Brings the signals of these records up to what they are now.
    pub(super) fn refresh(&self, touched: &[RecordId]) {
        let mut order = false;
        for id in touched {
            match id.kind {
                Kind::Stream => order |= self.refresh_stream(id),
                Kind::Connector => order |= self.refresh_connector(id),
                Kind::Place => self.refresh_place(&id.id),
                Kind::Settings => self.refresh_name(),
                Kind::Note => self.refresh_note(id),
                Kind::Group => self.refresh_group(id),
                Kind::Helper | Kind::Pad => {}
            }
        }
        if order {
            self.refresh_order();
        }
        if touched.iter().any(|id| id.kind == Kind::Note) {
            self.refresh_notes();
            self.refresh_note_order();
        }
        if touched.iter().any(|id| id.kind == Kind::Group) {
            self.refresh_groups();
        }
        if touched.iter().any(|id| matches!(id.kind, Kind::Stream | Kind::Connector | Kind::Pad)) {
            self.refresh_shared();
            self.edited.notify();
        }
    }

    fn refresh_shared(&self) {
        let (streams, connectors) = {
            let state = self.state();
            (state.streams.clone(), state.connectors.clone())
        };
        let mut shared: HashMap<Id, Vec<Id>> = HashMap::new();
        for (id, signals) in connectors {
            let output = signals.record.with_untracked(|connector| connector.output.clone());
            let acts = |output: &StreamSignals| output.record.with_untracked(|at| at.kind == StreamKind::Actuator);
            if streams.get(&output).is_some_and(acts) {
                shared.entry(output).or_default().push(id);
            }
        }
        shared.retain(|_, connectors| connectors.len() > 1);
        set_if_new(&self.shared, shared);
    }

    fn refresh_stream(&self, key: &RecordId) -> bool {
        let now = self.state().editor.shown(key);
        let known = self.state().streams.get(&key.id).cloned();
        match (now, known) {
            (Some(Record::Stream(stream)), Some(signals)) => {
                let moved = signals.record.with_untracked(|old| old.order != stream.order);
                set_if_new(&signals.record, stream);
                moved
            }
            (Some(Record::Stream(stream)), None) => {
                let mut state = self.state();
                let place = ArcRwSignal::new(state.editor.stream_place(&key.id));
                let signals = StreamSignals { record: ArcRwSignal::new(stream), place, live: ArcRwSignal::default() };
                state.streams.insert(key.id.clone(), signals);
                true
            }
            (_, Some(_)) => {
                self.state().streams.remove(&key.id);
                true
            }
            (_, None) => false,
        }
    }

    fn refresh_connector(&self, key: &RecordId) -> bool {
        let now = self.state().editor.shown(key);
        let known = self.state().connectors.get(&key.id).cloned();
        match (now, known) {
            (Some(Record::Connector(connector)), Some(signals)) => {
                let (moved, other) = signals
                    .record
                    .with_untracked(|old| (old.order != connector.order, old.operation != connector.operation));
                if other {
                    self.happened(DocumentEvent::Rewritten(signals.clone()));
                }
                set_if_new(&signals.record, connector);
                moved
            }
            (Some(Record::Connector(connector)), None) => {
                let signals = ConnectorSignals { record: ArcRwSignal::new(connector), live: ArcRwSignal::default() };
                self.state().connectors.insert(key.id.clone(), signals);
                true
            }
            (_, Some(_)) => {
                self.state().connectors.remove(&key.id);
                true
            }
            (_, None) => false,
        }
    }

    fn refresh_place(&self, id: &Id) {
        if let Some(signals) = self.stream(id) {
            let place = self.state().editor.stream_place(id);
            set_if_new(&signals.place, place);
        } else if let Some(signals) = self.note_signals(id) {
            let place = self.state().editor.note_place(id);
            set_if_new(&signals.place, place);
        } else if let Some(signals) = self.group(id) {
            let place = self.state().editor.put_at(id);
            set_if_new(&signals.place, place);
        }
    }

    fn refresh_name(&self) {
        let settings = self.state().editor.shown(&RecordId::settings());
        if let Some(Record::Settings(settings)) = settings {
            set_if_new(&self.name, settings.name);
            set_if_new(&self.exercise, settings.exercise);
        }
    }

    fn refresh_notes(&self) {
        let text = |record: &Record| if let Record::Note(note) = record { Some(note.text.clone()) } else { None };
        let notes = {
            let state = self.state();
            state.editor.shown_saved().records.values().filter_map(text).collect()
        };
        set_if_new(&self.notes, notes);
    }

    fn refresh_order(&self) {
        let (streams, connectors) = self.state().orders();
        set_if_new(&self.stream_ids, streams);
        set_if_new(&self.connector_ids, connectors);
    }
}

impl DocumentState {
    fn orders(&self) -> (Vec<Id>, Vec<Id>) {
        let stream_order = |signals: &StreamSignals| signals.record.with_untracked(|stream: &Stream| stream.order);
        let connector_order =
            |signals: &ConnectorSignals| signals.record.with_untracked(|connector: &Connector| connector.order);
        let mut streams: Vec<_> =
            self.streams.iter().map(|(id, signals)| (stream_order(signals), id.clone())).collect();
        let mut connectors: Vec<_> =
            self.connectors.iter().map(|(id, signals)| (connector_order(signals), id.clone())).collect();
        streams.sort_unstable();
        connectors.sort_unstable();
        (streams.into_iter().map(|(_, id)| id).collect(), connectors.into_iter().map(|(_, id)| id).collect())
    }
}
