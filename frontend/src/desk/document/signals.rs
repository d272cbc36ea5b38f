//! From accepted changes to signals: the one signal of every touched record, and nothing else.

use super::{ConnectorSignals, Document, DocumentEvent, Selected, State, StreamSignals};
use crate::desk::tab::set_if_new;
use crate::layout;
use behaviour::{Behaviour, Connector, Id, Kind, Place, Record, RecordId, Stream};
use leptos::prelude::*;

impl Document {
    /// Shows a whole behaviour in place of what was shown.
    pub(super) fn show_whole(&self, records: Behaviour) {
        let touched = {
            let mut state = self.state();
            let mut touched: Vec<_> = state.confirmed.records.keys().cloned().collect();
            touched.extend(records.records.keys().cloned());
            touched.extend(state.streams.keys().map(|id| RecordId::new(Kind::Stream, id)));
            touched.extend(state.connectors.keys().map(|id| RecordId::new(Kind::Connector, id)));
            state.confirmed = records;
            if let Some(open) = state.wanted.clone() {
                touched.extend(state.queue.touched(&open));
            }
            state.fallback = layout::missing_places(&state.confirmed);
            let places: Vec<_> = state.confirmed.streams().map(|(id, _)| RecordId::new(Kind::Place, id)).collect();
            touched.extend(places);
            touched
        };
        self.refresh(&touched);
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
                Kind::Helper | Kind::Note => {}
            }
        }
        if order {
            self.refresh_order();
        }
    }

    fn refresh_stream(&self, key: &RecordId) -> bool {
        let now = self.state().record(key);
        let known = self.state().streams.get(&key.id).cloned();
        match (now, known) {
            (Some(Record::Stream(stream)), Some(signals)) => {
                let moved = signals.record.with_untracked(|old| old.order != stream.order);
                set_if_new(&signals.record, stream);
                moved
            }
            (Some(Record::Stream(stream)), None) => {
                let mut state = self.state();
                let place = ArcRwSignal::new(state.place_or_free(&key.id));
                let signals = StreamSignals { record: ArcRwSignal::new(stream), place, live: ArcRwSignal::default() };
                state.streams.insert(key.id.clone(), signals);
                true
            }
            (_, Some(_)) => {
                self.state().streams.remove(&key.id);
                self.deselect_gone(&key.id);
                true
            }
            (_, None) => false,
        }
    }

    fn refresh_connector(&self, key: &RecordId) -> bool {
        let now = self.state().record(key);
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
                self.deselect_gone(&key.id);
                true
            }
            (_, None) => false,
        }
    }

    fn refresh_place(&self, id: &Id) {
        let known = self.state().streams.get(id).cloned();
        if let Some(signals) = known {
            let place = self.state().place_or_free(id);
            set_if_new(&signals.place, place);
        }
    }

    fn refresh_name(&self) {
        let settings = self.state().record(&RecordId::settings());
        if let Some(Record::Settings(settings)) = settings {
            set_if_new(&self.name, settings.name);
        }
    }

    fn refresh_order(&self) {
        let (streams, connectors) = self.state().orders();
        set_if_new(&self.stream_ids, streams);
        set_if_new(&self.connector_ids, connectors);
    }

    fn deselect_gone(&self, id: &Id) {
        if self.selected.with_untracked(|selected| selected.as_ref().map(Selected::id) == Some(id)) {
            self.selected.set(None);
        }
    }
}

impl State {
    /// A record as it is to be shown.
    fn record(&self, key: &RecordId) -> Option<Record> {
        let waiting = match &self.wanted {
            Some(open) if self.saves.shows_waiting() => self.queue.record(open, key),
            _ => None,
        };
        waiting.unwrap_or_else(|| self.confirmed.records.get(key).cloned())
    }

    /// Where a stream stands; a stream that nobody placed gets a free spot for as long as this page is open.
    fn place_or_free(&mut self, id: &Id) -> Place {
        if let Some(Record::Place(place)) = self.record(&RecordId::new(Kind::Place, id)) {
            return place;
        }
        if let Some(place) = self.fallback.get(id) {
            return *place;
        }
        let place = layout::missing_places(&self.confirmed).get(id).copied().unwrap_or(Place { x: 0.0, y: 0.0 });
        self.fallback.insert(id.clone(), place);
        place
    }

    fn orders(&self) -> (Vec<Id>, Vec<Id>) {
        let stream_order = |signals: &StreamSignals| signals.record.with_untracked(|stream: &Stream| stream.order);
        let connector_order =
            |signals: &ConnectorSignals| signals.record.with_untracked(|connector: &Connector| connector.order);
        let mut streams: Vec<_> =
            self.streams.iter().map(|(id, signals)| (stream_order(signals), id.clone())).collect();
        let mut connectors: Vec<_> =
            self.connectors.iter().map(|(id, signals)| (connector_order(signals), id.clone())).collect();
        streams.sort();
        connectors.sort();
        (streams.into_iter().map(|(_, id)| id).collect(), connectors.into_iter().map(|(_, id)| id).collect())
    }
}
