//! The tiles of the operator's page: shown, put, moved and given up. Each is one change of the program.

use super::shown_pad as pad;
use super::{Document, build};
use behaviour::labels;
use behaviour::{Change, Pad, Record, RecordId, Tile};
use leptos::prelude::*;
use phrase::{Phrase, phrase};
use protocol::Refused;

/// The label of every change of tiles.
fn label() -> Phrase {
    labels::edit(phrase!("thing.tiles", "tiles"))
}

impl Document {
    /// The tiles of the open program, its own or the usual ones. Reactive.
    pub(crate) fn pad(&self) -> Pad {
        self.track_pad();
        pad::of(&self.behaviour())
    }

    /// True if somebody chose the tiles of the open program. Reactive.
    pub(crate) fn has_own_pad(&self) -> bool {
        self.track_pad();
        self.behaviour().pad().is_some()
    }

    fn track_pad(&self) {
        self.edited.track();
        self.open.track();
    }

    /// Puts a tile, or none, at a key where its author saw another one, or none. The other tiles stay as they are by now.
    pub(crate) fn put_tile(
        &self,
        key: u8,
        (seen, tile): (Option<Tile>, Option<Tile>),
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        let now = pad::of(&self.behaviour());
        let seen = now.with(key, seen);
        let change = self.pad_change(now.with(key, tile));
        let change = if seen == now { change } else { build::as_seen_at(change, &RecordId::pad(), Record::Pad(seen)) };
        self.propose_and(change, on_answer);
    }

    /// Puts the tiles of two keys in each other's place.
    pub(crate) fn swap_tiles(&self, one: u8, other: u8, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let change = self.pad_change(pad::of(&self.behaviour()).swapped(one, other));
        self.propose_and(change, on_answer);
    }

    /// Gives the program's own tiles up: the usual ones are shown again.
    pub(crate) fn give_up_pad(&self, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        let change = self.change(label()).take(&self.behaviour(), RecordId::pad());
        self.propose_and(change, on_answer);
    }

    fn pad_change(&self, pad: Pad) -> Change {
        self.change(label()).put(&self.behaviour(), RecordId::pad(), Record::Pad(pad))
    }
}
