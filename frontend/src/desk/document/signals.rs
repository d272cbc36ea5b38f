//! From the editor to signals: the one signal of every touched record, and nothing else.

use super::{ConnectorSignals, Document, DocumentEvent, DocumentState, Selected, StreamSignals};
use crate::desk::tab::set_if_new;
use crate::layout::{self, Tidy};
use behaviour::{Behaviour, Connector, Id, Kind, Place, Record, RecordId, Stream, StreamKind};
use editor::RecordNews;
use leptos::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};

impl Document {
    /// Brings the signals of the records up to what the editor says is another one now.
    pub(super) fn show_records(&self, news: RecordNews) {
        let mut touched = news.touched;
        if news.is_whole {
            let state = &mut *self.state();
            touched.extend(state.streams.keys().map(|id| RecordId::new(Kind::Stream, id)));
            touched.extend(state.connectors.keys().map(|id| RecordId::new(Kind::Connector, id)));
            touched.extend(state.notes.keys().map(|id| RecordId::new(Kind::Note, id)));
            touched.extend(state.groups.keys().map(|id| RecordId::new(Kind::Group, id)));
            state.fallback = layout::missing_places(state.editor.confirmed(), state.tidy, state.stage);
        }
        if !touched.is_empty() {
            self.refresh(&touched);
        }
    }

    /// Shows the records of another program in place of the open one, only to look at; with none the open one again.
    pub(crate) fn show_then(&self, then: Option<Behaviour>) {
        let touched = {
            let state = &mut *self.state();
            if then.is_none() && state.then.is_none() {
                return;
            }
            let before = state.then.take();
            state.then = then;
            let shown = state.then.as_ref().unwrap_or(state.editor.confirmed());
            for (id, place) in layout::missing_places(shown, state.tidy, state.stage) {
                state.fallback.entry(id).or_insert(place);
            }
            let open = state.editor.behaviour();
            let all = [before.as_ref(), Some(shown), Some(&open)];
            let mut touched: BTreeSet<RecordId> =
                all.into_iter().flatten().flat_map(|one| one.records.keys().cloned()).collect();
            let placed: Vec<RecordId> = touched.iter().map(|id| RecordId::new(Kind::Place, &id.id)).collect();
            touched.extend(placed);
            touched.into_iter().collect::<Vec<_>>()
        };
        self.refresh(&touched);
    }

    /// Does something with the open program as it is now, though one of the past may be shown.
    pub(crate) fn with_now(&self, act: impl FnOnce(&Self)) {
        let (mut at, then) = (None, self.state().then.take());
        self.tab.then.update_untracked(|shown| at = shown.take());
        act(self);
        self.tab.then.update_untracked(|shown| *shown = at);
        self.show_then(then);
    }

    /// Lays out with `tidy` what nobody placed, from now on: it may come later than the behaviour that needs it.
    pub(crate) fn lay_out_with(&self, tidy: Tidy) {
        let places: Vec<_> = {
            let mut state = self.state();
            state.tidy = Some(tidy);
            let ids: Vec<Id> = state.editor.confirmed().streams().map(|(id, _)| id.clone()).collect();
            if ids.is_empty() || ids.iter().any(|id| state.editor.confirmed().place(id).is_some()) {
                return;
            }
            state.fallback = tidy(state.editor.confirmed(), state.stage);
            ids.iter().map(|id| RecordId::new(Kind::Place, id)).collect()
        };
        self.refresh(&places);
        self.laid_out.notify();
    }

    /// Tells the width and height of the stage that are free: the next layout fits it. A stream that stands already
    /// stays.
    pub(crate) fn tell_stage(&self, free: (f64, f64)) {
        self.state().stage = free;
    }

    /// Places for the streams of a behaviour that nobody placed.
    pub(crate) fn missing_places(&self, behaviour: &Behaviour) -> BTreeMap<Id, Place> {
        let state = self.state();
        layout::missing_places(behaviour, state.tidy, state.stage)
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
        if let Some(signals) = self.stream(id) {
            let place = self.state().place_or_free(id);
            set_if_new(&signals.place, place);
        } else if let Some(signals) = self.note_signals(id) {
            set_if_new(&signals.place, self.note_place(id));
        } else if let Some(signals) = self.group(id) {
            let place = self.state().saved_place(id);
            set_if_new(&signals.place, place);
        }
    }

    fn refresh_name(&self) {
        let settings = self.state().record(&RecordId::settings());
        if let Some(Record::Settings(settings)) = settings {
            set_if_new(&self.name, settings.name);
            set_if_new(&self.exercise, settings.exercise);
        }
    }

    fn refresh_notes(&self) {
        let text = |record: &Record| if let Record::Note(note) = record { Some(note.text.clone()) } else { None };
        let notes = {
            let state = self.state();
            let shown = state.then.as_ref().unwrap_or(state.editor.confirmed());
            shown.records.values().filter_map(text).collect()
        };
        set_if_new(&self.notes, notes);
    }

    fn refresh_order(&self) {
        let (streams, connectors) = self.state().orders();
        set_if_new(&self.stream_ids, streams);
        set_if_new(&self.connector_ids, connectors);
    }

    pub(super) fn deselect_gone(&self, id: &Id) {
        if self.several.with_untracked(|several| several.iter().any(|one| one.id() == id)) {
            self.several.update(|several| several.retain(|one| one.id() != id));
        }
        if self.selected.with_untracked(|selected| selected.as_ref().map(Selected::id) == Some(id)) {
            self.selected.set(None);
        }
    }
}

impl DocumentState {
    /// A record as it is to be shown.
    pub(super) fn record(&self, key: &RecordId) -> Option<Record> {
        match &self.then {
            Some(then) => then.records.get(key).cloned(),
            None => self.editor.record(key),
        }
    }

    /// Returns the place where something was put.
    pub(super) fn saved_place(&self, id: &Id) -> Option<Place> {
        match &self.then {
            Some(then) => then.place(id),
            None => self.editor.saved_place(id),
        }
    }

    /// Returns the place of a stream; a stream that nobody placed gets a free spot for as long as this page is open.
    fn place_or_free(&mut self, id: &Id) -> Place {
        if let Some(place) = self.saved_place(id) {
            return place;
        }
        if let Some(place) = self.fallback.get(id) {
            return *place;
        }
        let place = layout::missing_places(self.editor.confirmed(), self.tidy, self.stage)
            .get(id)
            .copied()
            .unwrap_or(Place { x: 0.0, y: 0.0 });
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
