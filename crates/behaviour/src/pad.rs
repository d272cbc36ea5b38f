//! The pad of a behaviour: up to nine tiles that a person presses beside a session.

use crate::{Id, Knowledge, Params, RecordId, Refusal, StreamKind, Value};
use phrase::{Phrased, Word, phrase, word};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// The keys that a tile may have.
pub const TILE_KEYS: RangeInclusive<u8> = 1..=9;
/// The longest label of a tile, and the longest word that it marks, in characters.
pub const TILE_MAX_CHARS: usize = 40;
/// The most that the value and the parameters of a tile take as text, in bytes: as much as is done by hand at once.
pub const TILE_MAX_BYTES: usize = 4_096;

/// The tiles of a pad by their keys, 1 to 9. A behaviour has one pad at most; without one, people are shown
/// `robot::usual_pad`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Pad {
    /// The tiles; one without tiles shows none.
    #[serde(with = "by_key")]
    pub tiles: BTreeMap<u8, Tile>,
}

/// A map with its keys as texts, however it is carried: a message that is looked into before it is read has no others.
mod by_key {
    use super::{BTreeMap, Tile};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(tiles: &BTreeMap<u8, Tile>, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(tiles.iter().map(|(key, tile)| (key.to_string(), tile)))
    }

    pub(super) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<BTreeMap<u8, Tile>, D::Error> {
        let tiles: BTreeMap<String, Tile> = BTreeMap::deserialize(from)?;
        let mut keyed = BTreeMap::new();
        for (key, tile) in tiles {
            keyed.insert(key.parse().map_err(D::Error::custom)?, tile);
        }
        Ok(keyed)
    }
}

/// A tile of a pad. In a file streams are named by texts, as they may be anything there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tile<S = Id> {
    /// The words on the tile.
    pub label: String,
    /// The action of a press.
    pub does: TileAction<S>,
    /// True if a press asks first, and a second one within two seconds does it. A word never asks.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub asks: bool,
}

/// The action of a press on a tile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub enum TileAction<S = Id> {
    /// The robot does something by hand.
    Hand {
        /// The name of an action of the catalogue.
        device: String,
        /// The parameters of the action.
        #[serde(default, skip_serializing_if = "Params::is_empty")]
        params: Params,
        /// The value that it is told.
        #[serde(default, skip_serializing_if = "is_null")]
        value: Value,
    },
    /// A sense of the behaviour tells a value, as if the robot had sensed it.
    Pretend {
        /// The stream of the sense. While it is gone the tile rests.
        stream: S,
        /// The value.
        value: Value,
    },
    /// The moment is marked with a word.
    Word {
        /// The word.
        word: String,
        /// True if a press begins a span, which the next one ends.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        span: bool,
    },
}

fn is_null(value: &Value) -> bool {
    *value == Value::Null
}

impl<S> TileAction<S> {
    /// Returns this action with another name for its stream; none if the stream has none.
    pub fn renamed<T>(&self, name: impl FnOnce(&S) -> Option<T>) -> Option<TileAction<T>> {
        Some(match self {
            Self::Hand { device, params, value } => {
                TileAction::Hand { device: device.clone(), params: params.clone(), value: value.clone() }
            }
            Self::Pretend { stream, value } => TileAction::Pretend { stream: name(stream)?, value: value.clone() },
            Self::Word { word, span } => TileAction::Word { word: word.clone(), span: *span },
        })
    }

    /// The values in it, each parameter with its name.
    pub(crate) fn values(&self) -> impl Iterator<Item = (&str, &Value)> {
        let (params, value) = match self {
            Self::Hand { params, value, .. } => (Some(params), Some(value)),
            Self::Pretend { value, .. } => (None, Some(value)),
            Self::Word { .. } => (None, None),
        };
        let params = params.into_iter().flatten().map(|(name, value)| (name.as_str(), value));
        params.chain(value.map(|value| ("", value)))
    }
}

impl Pad {
    /// Returns this pad with another tile at a key, or none there.
    #[must_use]
    pub fn with(&self, key: u8, tile: Option<Tile>) -> Self {
        let mut tiles = self.tiles.clone();
        match tile {
            Some(tile) => tiles.insert(key, tile),
            None => tiles.remove(&key),
        };
        Self { tiles }
    }

    /// Returns this pad with the tiles of two keys in each other's place.
    #[must_use]
    pub fn swapped(&self, one: u8, other: u8) -> Self {
        let of = |key| self.tiles.get(&key).cloned();
        self.with(one, of(other)).with(other, of(one))
    }

    /// Returns the pad that two people made of the one that both saw, each at other keys; none if both made something else of
    /// one key.
    #[must_use]
    pub fn merged(seen: &Self, mine: &Self, theirs: &Self) -> Option<Self> {
        let is_free = |key: u8| {
            let [seen, mine, theirs] = [seen, mine, theirs].map(|pad| pad.tiles.get(&key));
            mine == theirs || seen == mine || seen == theirs
        };
        TILE_KEYS.into_iter().all(is_free).then(|| Self::on_top(seen, mine, theirs))
    }

    /// Returns the pad as others have it with what one person changed of the one that they saw on top.
    #[must_use]
    pub fn on_top(seen: &Self, mine: &Self, theirs: &Self) -> Self {
        let changed = TILE_KEYS.filter(|key| seen.tiles.get(key) != mine.tiles.get(key));
        changed.fold(theirs.clone(), |pad, key| pad.with(key, mine.tiles.get(&key).cloned()))
    }

    /// Every name that people read in it.
    pub(crate) fn names(&self) -> Vec<&str> {
        fn of(tile: &Tile) -> Vec<&str> {
            let mut names = vec![tile.label.as_str()];
            match &tile.does {
                TileAction::Hand { device, params, .. } => {
                    names.push(device);
                    names.extend(params.keys().map(String::as_str));
                }
                TileAction::Word { word, .. } => names.push(word),
                TileAction::Pretend { .. } => {}
            }
            names
        }
        self.tiles.values().flat_map(of).collect()
    }
}

/// Checks a pad that somebody changed.
pub(crate) fn check(id: &RecordId, pad: &Pad, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
    if *id != RecordId::pad() {
        return Err(Refusal::Malformed(phrase!("malformed.second_pad", "a second pad")));
    }
    pad.tiles.iter().try_for_each(|(key, tile)| {
        if !TILE_KEYS.contains(key) {
            return Err(Refusal::Malformed(phrase!("malformed.tile", "a tile")));
        }
        named(word!("limited.tile_label", "this label"), &tile.label)?;
        if tile.asks && matches!(tile.does, TileAction::Word { .. }) {
            return Err(Refusal::Malformed(phrase!("malformed.asking_word", "a word that asks first")));
        }
        if tile.does.values().any(|(_, value)| !value.is_finite()) {
            return Err(Refusal::Infinite);
        }
        let bytes: usize = tile.does.values().map(|(name, value)| name.len() + value.to_string().len()).sum();
        if bytes > TILE_MAX_BYTES {
            return Err(Refusal::TooLarge(phrase!("this.tile", "this tile")));
        }
        match &tile.does {
            TileAction::Hand { device, params, .. } => {
                knowledge.device(StreamKind::Actuator, device, params).map_err(Refusal::Device)
            }
            // A stream that is gone, or no sense any more, can be one again; until then the tile rests.
            TileAction::Pretend { .. } => Ok(()),
            TileAction::Word { word, .. } => named(word!("limited.tile_word", "this word"), word),
        }
    })
}

fn named(what: Word, text: &str) -> Result<(), Refusal> {
    if text.trim().is_empty() || text.chars().any(char::is_control) {
        return Err(Refusal::Name(crate::without_unseen(text).chars().take(TILE_MAX_CHARS).collect()));
    }
    let fits = text.chars().count() <= TILE_MAX_CHARS;
    if fits { Ok(()) } else { Err(Refusal::TooLong(what.phrase(), TILE_MAX_CHARS)) }
}

#[cfg(test)]
mod tests {
    use super::{Pad, Tile, TileAction};

    /// A pad whose tiles mark these words, written with their keys: `1 laughs 3 hides`.
    fn pad(written: &str) -> Pad {
        let words: Vec<&str> = written.split(' ').filter(|word| !word.is_empty()).collect();
        let tile = |word: &str| Tile {
            label: word.to_owned(),
            does: TileAction::Word { word: word.to_owned(), span: false },
            asks: false,
        };
        words.chunks(2).fold(Pad::default(), |pad, one| pad.with(one[0].parse().unwrap(), Some(tile(one[1]))))
    }

    #[test]
    fn tiles_change_places_also_with_an_empty_one() {
        assert_eq!(pad("1 laughs 2 hides").swapped(1, 2), pad("1 hides 2 laughs"));
        assert_eq!(pad("1 laughs").swapped(1, 2), pad("2 laughs"));
        assert_eq!(pad("1 laughs").with(1, None), pad(""));
    }

    #[test]
    fn what_two_people_made_of_other_keys_stands_beside_each_other() {
        let merged = |seen, mine, theirs| Pad::merged(&pad(seen), &pad(mine), &pad(theirs));
        assert_eq!(merged("1 a 2 b", "1 x 2 b", "1 a 2 y"), Some(pad("1 x 2 y")));
        assert_eq!(merged("1 a", "1 a 5 x", ""), Some(pad("5 x")), "one was taken away, another one added");
        assert_eq!(merged("1 a", "1 x", "1 x 2 b"), Some(pad("1 x 2 b")), "both did the same");
        assert_eq!(merged("1 a 2 b 3 c", "1 b 2 a 3 c", "1 a 2 b"), Some(pad("1 b 2 a")), "two changed places");
        assert_eq!(merged("1 a", "1 x", "1 y"), None);
        assert_eq!(merged("1 a", "", "1 y"), None, "taken away, and changed");
        assert_eq!(merged("", "3 x", "3 y"), None, "both added one there");
        assert_eq!(Pad::on_top(&pad("1 a 2 b"), &pad("1 x 2 b"), &pad("1 y 2 z")), pad("1 x 2 z"));
    }
}
