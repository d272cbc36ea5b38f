//! A tile as it is being written: what it does, its words, and whether it asks first.

use crate::desk::shown_pad as pad;
use crate::fields::ParamForm;
use crate::parts::DeskHold;
use crate::reasons::Unfilled;
use crate::robots::SentValue;
use behaviour::{Behaviour, Id, Params, Stream, StreamKind, Tile, TileAction, Value};
use leptos::prelude::*;
use robot::Device;

/// The kinds of what a press does.
pub(super) const HAND: &str = "hand";
pub(super) const PRETEND: &str = "pretend";
pub(super) const WORD: &str = "word";
/// The kinds of a mark.
pub(super) const MOMENT: &str = "moment";
pub(super) const SPAN: &str = "span";

/// The fields of a tile. A copy is the same fields.
#[derive(Clone, Copy)]
pub(super) struct TileDraft {
    desk: DeskHold,
    pub(super) kind: RwSignal<String>,
    pub(super) device: RwSignal<String>,
    pub(super) params: RwSignal<Option<ParamForm>>,
    /// The value that the action is told.
    pub(super) told: SentValue,
    pub(super) stream: RwSignal<String>,
    /// The value that the sense pretends.
    pub(super) pretended: SentValue,
    pub(super) word: RwSignal<String>,
    pub(super) lasts: RwSignal<String>,
    pub(super) label: RwSignal<String>,
    /// True once somebody wrote the words; until then they follow what the tile does.
    pub(super) is_worded: RwSignal<bool>,
    pub(super) asks: RwSignal<bool>,
}

impl TileDraft {
    pub(super) fn new(desk: DeskHold, tile: Option<&Tile>) -> Self {
        let draft = Self {
            desk,
            kind: RwSignal::default(),
            device: RwSignal::default(),
            params: RwSignal::new(None),
            told: SentValue::new("null"),
            stream: RwSignal::default(),
            pretended: SentValue::new("null"),
            word: RwSignal::default(),
            lasts: RwSignal::default(),
            label: RwSignal::default(),
            is_worded: RwSignal::new(false),
            asks: RwSignal::new(false),
        };
        draft.fill(tile);
        draft
    }

    /// Shows a tile, or what a new one begins with.
    pub(super) fn fill(self, tile: Option<&Tile>) {
        let behaviour = self.behaviour();
        self.kind.set(HAND.to_owned());
        self.word.set(String::new());
        self.lasts.set(MOMENT.to_owned());
        self.choose_action(robot::first_by_hand().name);
        self.choose_sense(senses(&behaviour).first().map(|(id, _)| id.as_str()).unwrap_or_default());
        match tile.map(|tile| &tile.does) {
            Some(TileAction::Hand { device, params, value }) => {
                self.choose_action(device);
                self.params.set(action(device).map(|device| ParamForm::new(device, params)));
                self.told.set(value.clone());
            }
            Some(TileAction::Pretend { stream, value }) => {
                self.kind.set(PRETEND.to_owned());
                self.choose_sense(stream.as_str());
                self.pretended.set(value.clone());
            }
            Some(TileAction::Word { word, span }) => {
                self.kind.set(WORD.to_owned());
                self.word.set(word.clone());
                self.lasts.set(if *span { SPAN } else { MOMENT }.to_owned());
            }
            None => {}
        }
        let proposed = tile.map(|tile| pad::proposed_words(&behaviour, &tile.does));
        self.label.set(tile.map(|tile| tile.label.clone()).unwrap_or_default());
        self.is_worded.set(tile.is_some_and(|tile| proposed.as_ref() != Some(&tile.label)));
        self.asks.set(tile.is_some_and(|tile| tile.asks));
    }

    /// Another action, as nobody has chosen anything of it.
    pub(super) fn choose_action(self, name: &str) {
        let device = action(name);
        self.device.set(name.to_owned());
        self.params.set(device.map(|device| ParamForm::new(device, &Params::new())));
        self.told.set(device.and_then(|device| crate::json::read(device.example).ok()).unwrap_or(Value::Null));
    }

    /// Another sense, with the first of what it can pretend.
    pub(super) fn choose_sense(self, id: &str) {
        let stream = Id::new(id).ok().and_then(|id| self.behaviour().stream(&id).cloned());
        let sense = stream.as_ref().and_then(sense);
        let first = sense.map(|sense| sense.pretend.first().map_or(sense.example, |pretend| pretend.value));
        self.stream.set(id.to_owned());
        self.pretended.set(first.and_then(|value| crate::json::read(value).ok()).unwrap_or(Value::Null));
    }

    /// The chosen sense and its parameters. Reactive.
    pub(super) fn chosen_sense(self) -> Option<(&'static Device, Params)> {
        let stream = self.behaviour().stream(&Id::new(&self.stream.read()).ok()?).cloned()?;
        Some((sense(&stream)?, stream.params))
    }

    /// The chosen parameters of the action, as far as they fit. Reactive.
    pub(super) fn chosen_params(self) -> Result<Params, Unfilled> {
        let form = self.params.get().ok_or(Unfilled::Gone)?;
        form.track();
        form.read()
    }

    /// The action of a press. Reactive.
    ///
    /// # Errors
    /// If something is missing or does not fit.
    pub(super) fn does(self) -> Result<TileAction, Unfilled> {
        match self.kind.read().as_str() {
            PRETEND => {
                self.pretended.track();
                let stream = Id::new(&self.stream.read()).map_err(|_| Unfilled::Sense)?;
                Ok(TileAction::Pretend { stream, value: self.pretended.read().ok_or(Unfilled::Value)? })
            }
            WORD => {
                let word = self.word.read().trim().to_owned();
                let span = *self.lasts.read() == SPAN;
                if word.is_empty() { Err(Unfilled::Word) } else { Ok(TileAction::Word { word, span }) }
            }
            _ => {
                self.told.track();
                let value = self.told.read().ok_or(Unfilled::Value)?;
                Ok(TileAction::Hand { device: self.device.get(), params: self.chosen_params()?, value })
            }
        }
    }

    /// The tile as it would be saved. Reactive.
    ///
    /// # Errors
    /// If something is missing or does not fit.
    pub(super) fn tile(self) -> Result<Tile, Unfilled> {
        let does = self.does()?;
        let label = self.label.read().trim().to_owned();
        if label.is_empty() {
            return Err(Unfilled::Label);
        }
        let asks = self.asks.get() && !matches!(does, TileAction::Word { .. });
        Ok(Tile { label, does, asks })
    }

    /// Lets the words follow what the tile does, until somebody writes others.
    pub(super) fn word_itself(self) {
        Effect::new(move |_| {
            let does = self.does();
            if let (Ok(does), false) = (does, self.is_worded.get()) {
                let proposed = pad::proposed_words(&self.behaviour(), &does);
                self.label.maybe_update(|label| {
                    let differs = *label != proposed;
                    *label = proposed;
                    differs
                });
            }
        });
    }

    pub(super) fn behaviour(self) -> Behaviour {
        self.desk.desk().document.behaviour()
    }
}

fn action(name: &str) -> Option<&'static Device> {
    robot::device(StreamKind::Actuator, name).ok()
}

fn sense(stream: &Stream) -> Option<&'static Device> {
    robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()
}

/// The senses of a program, each with its name.
pub(super) fn senses(behaviour: &Behaviour) -> Vec<(Id, String)> {
    let all = behaviour.streams_in_order().into_iter();
    let senses = all.filter(|(_, stream)| stream.kind == StreamKind::Sensor && sense(stream).is_some());
    senses.map(|(id, stream)| (id.clone(), stream.name.clone())).collect()
}
