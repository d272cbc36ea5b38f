//! The form in messages and files: words that stay are a text, so that what older versions wrote is still read.

use crate::{KeyedPhrase, Phrase};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

struct WireHoles<'a>(&'a [(Cow<'static, str>, Phrase)]);

impl Serialize for Phrase {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) => to.serialize_str(text),
            Self::Number(number) => to.serialize_f64(*number),
            Self::List(list) => list.serialize(to),
            Self::Keyed(keyed) => {
                let mut map = to.serialize_map(None)?;
                map.serialize_entry("key", &keyed.key)?;
                map.serialize_entry("english", &keyed.english)?;
                if !keyed.with.is_empty() {
                    map.serialize_entry("with", &WireHoles(&keyed.with))?;
                }
                map.end()
            }
        }
    }
}

impl Serialize for WireHoles<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(name, phrase)| (name, phrase)))
    }
}

impl<'de> Deserialize<'de> for Phrase {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(PhraseVisitor)
    }
}

struct PhraseVisitor;

impl<'de> Visitor<'de> for PhraseVisitor {
    type Value = Phrase;

    fn expecting(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str("words")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Phrase, E> {
        Ok(Phrase::Text(text.to_owned()))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Phrase, E> {
        Ok(Phrase::Number(number))
    }

    #[allow(clippy::cast_precision_loss, reason = "numbers that are said are small")]
    fn visit_u64<E: Error>(self, number: u64) -> Result<Phrase, E> {
        Ok(Phrase::Number(number as f64))
    }

    #[allow(clippy::cast_precision_loss, reason = "numbers that are said are small")]
    fn visit_i64<E: Error>(self, number: i64) -> Result<Phrase, E> {
        Ok(Phrase::Number(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<Phrase, A::Error> {
        let mut list = Vec::new();
        while let Some(one) = from.next_element()? {
            list.push(one);
        }
        Ok(Phrase::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<Phrase, A::Error> {
        let mut keyed = KeyedPhrase { key: "".into(), english: "".into(), with: Vec::new() };
        while let Some(name) = from.next_key::<String>()? {
            match name.as_str() {
                "key" => keyed.key = from.next_value::<String>()?.into(),
                "english" => keyed.english = from.next_value::<String>()?.into(),
                // What stands in the holes is read as pairs by the same visitor: see `KeyedPairs`.
                "with" => keyed.with = from.next_value::<KeyedPairs>()?.0,
                _ => drop(from.next_value::<Phrase>()?),
            }
        }
        Ok(Phrase::Keyed(Box::new(keyed)))
    }
}

/// The phrases in the holes.
struct KeyedPairs(Vec<(Cow<'static, str>, Phrase)>);

impl<'de> Deserialize<'de> for KeyedPairs {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(PairsVisitor)
    }
}

struct PairsVisitor;

impl<'de> Visitor<'de> for PairsVisitor {
    type Value = KeyedPairs;

    fn expecting(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str("what stands in the holes")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<KeyedPairs, A::Error> {
        let mut pairs = Vec::new();
        while let Some((name, phrase)) = from.next_entry::<String, Phrase>()? {
            pairs.push((Cow::Owned(name), phrase));
        }
        Ok(KeyedPairs(pairs))
    }
}
