//! Reading JSON: what the server says, and what this browser keeps.
//!
//! The page reads more than a hundred kinds of objects. What is derived for each can read it from an object with names and
//! from a list without; nobody sends such lists, yet half of the code that reads would be for them. Here an object is
//! asked for wherever one is meant, so that the other half is not even compiled.

use serde::de::{DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess, VariantAccess, Visitor};

/// What a text says.
///
/// # Errors
/// Where it is no JSON, or not what is asked for.
pub(crate) fn read<'de, T: serde::Deserialize<'de>>(text: &'de str) -> serde_json::Result<T> {
    let mut json = serde_json::Deserializer::from_str(text);
    let read = T::deserialize(Named(&mut json))?;
    json.end()?;
    Ok(read)
}

/// Something of `serde` with objects that have names, all the way down.
struct Named<T>(T);

macro_rules! pass {
    ($($what:ident($($name:ident: $kind:ty),*);)*) => {
        $(fn $what<V: Visitor<'de>>(self, $($name: $kind,)* visitor: V) -> Result<V::Value, D::Error> {
            self.0.$what($($name,)* Named(visitor))
        })*
    };
}

impl<'de, D: Deserializer<'de>> Deserializer<'de> for Named<D> {
    type Error = D::Error;

    pass! {
        deserialize_any();
        deserialize_bool();
        deserialize_i8();
        deserialize_i16();
        deserialize_i32();
        deserialize_i64();
        deserialize_u8();
        deserialize_u16();
        deserialize_u32();
        deserialize_u64();
        deserialize_f32();
        deserialize_f64();
        deserialize_char();
        deserialize_str();
        deserialize_string();
        deserialize_bytes();
        deserialize_byte_buf();
        deserialize_option();
        deserialize_unit();
        deserialize_unit_struct(name: &'static str);
        deserialize_newtype_struct(name: &'static str);
        deserialize_seq();
        deserialize_tuple(len: usize);
        deserialize_tuple_struct(name: &'static str, len: usize);
        deserialize_map();
        deserialize_enum(name: &'static str, variants: &'static [&'static str]);
        deserialize_identifier();
        deserialize_ignored_any();
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, D::Error> {
        self.0.deserialize_map(Named(visitor))
    }
}

macro_rules! hand_on {
    ($($what:ident: $kind:ty;)*) => {
        $(fn $what<E: serde::de::Error>(self, value: $kind) -> Result<V::Value, E> {
            self.0.$what(value)
        })*
    };
}

impl<'de, V: Visitor<'de>> Visitor<'de> for Named<V> {
    type Value = V::Value;

    fn expecting(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.0.expecting(to)
    }

    hand_on! {
        visit_bool: bool;
        visit_i64: i64;
        visit_u64: u64;
        visit_f64: f64;
        visit_str: &str;
        visit_borrowed_str: &'de str;
        visit_string: String;
    }

    fn visit_none<E: serde::de::Error>(self) -> Result<V::Value, E> {
        self.0.visit_none()
    }

    fn visit_unit<E: serde::de::Error>(self) -> Result<V::Value, E> {
        self.0.visit_unit()
    }

    fn visit_some<D: Deserializer<'de>>(self, some: D) -> Result<V::Value, D::Error> {
        self.0.visit_some(Named(some))
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, inner: D) -> Result<V::Value, D::Error> {
        self.0.visit_newtype_struct(Named(inner))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<V::Value, A::Error> {
        self.0.visit_seq(Named(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, object: A) -> Result<V::Value, A::Error> {
        self.0.visit_map(Named(object))
    }

    fn visit_enum<A: EnumAccess<'de>>(self, one: A) -> Result<V::Value, A::Error> {
        self.0.visit_enum(Named(one))
    }
}

impl<'de, S: DeserializeSeed<'de>> DeserializeSeed<'de> for Named<S> {
    type Value = S::Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<S::Value, D::Error> {
        self.0.deserialize(Named(from))
    }
}

impl<'de, A: SeqAccess<'de>> SeqAccess<'de> for Named<A> {
    type Error = A::Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, A::Error> {
        self.0.next_element_seed(Named(seed))
    }
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for Named<A> {
    type Error = A::Error;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, A::Error> {
        self.0.next_key_seed(Named(seed))
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, A::Error> {
        self.0.next_value_seed(Named(seed))
    }
}

impl<'de, A: EnumAccess<'de>> EnumAccess<'de> for Named<A> {
    type Error = A::Error;
    type Variant = Named<A::Variant>;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self::Variant), A::Error> {
        self.0.variant_seed(Named(seed)).map(|(value, variant)| (value, Named(variant)))
    }
}

impl<'de, A: VariantAccess<'de>> VariantAccess<'de> for Named<A> {
    type Error = A::Error;

    fn unit_variant(self) -> Result<(), A::Error> {
        self.0.unit_variant()
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, A::Error> {
        self.0.newtype_variant_seed(Named(seed))
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, A::Error> {
        self.0.tuple_variant(len, Named(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(self, _: &'static [&'static str], visitor: V) -> Result<V::Value, A::Error> {
        self.0.newtype_variant_seed(NamedFields(visitor))
    }
}

/// What a variant with named fields holds.
struct NamedFields<V>(V);

impl<'de, V: Visitor<'de>> DeserializeSeed<'de> for NamedFields<V> {
    type Value = V::Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<V::Value, D::Error> {
        from.deserialize_map(Named(self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::read;
    use behaviour::{Id, Value};
    use protocol::{Event, Message, Refused, RobotFindings, RunPhase, Summary, answer};
    use serde::Deserialize;

    #[derive(Debug, PartialEq, Deserialize)]
    enum Kinds {
        Unit,
        New(Option<Id>),
        Two(u8, f32),
        Named { a: Vec<Pair>, b: Option<char> },
    }

    #[derive(Debug, PartialEq, Deserialize)]
    struct Pair(i16, bool);

    #[test]
    fn every_kind_of_value_is_read_as_serde_json_reads_it() {
        let texts = [
            r#""Unit""#,
            r#"{"New":null}"#,
            r#"{"New":"abc"}"#,
            r#"{"Two":[7,2.5]}"#,
            r#"{"Named":{"a":[[-3,true],[4,false]],"b":"x"}}"#,
            r#"{"Named":{"a":[],"b":null}}"#,
        ];
        for text in texts {
            assert_eq!(read::<Kinds>(text).unwrap(), serde_json::from_str(text).unwrap(), "{text}");
        }
        for wrong in ["", "{", r#""Other""#, r#"{"New":1}"#, r#""Unit" 1"#, r#"{"Named":[[],null]}"#] {
            assert!(read::<Kinds>(wrong).is_err(), "{wrong}");
        }
        let values = [r#"{"a":6,"b":6.0,"c":[null,true,"x\n"]}"#, "-1", "1.5e3", r#""é""#];
        for text in values {
            assert_eq!(read::<Value>(text).unwrap(), serde_json::from_str::<Value>(text).unwrap(), "{text}");
        }
    }

    #[test]
    fn what_the_server_says_comes_as_it_was_said() {
        let checked = Box::new(RobotFindings { name: "NAO".into(), ..RobotFindings::default() });
        let said = [
            Message::Answer { ask: 3, answer: ().into() },
            Message::Answer { ask: 3, answer: answer::RobotChecked { checked }.into() },
            Message::No { ask: Some(3), no: Refused::CannotStart("no".into()) },
            Message::No { ask: None, no: Refused::TooFast },
            Event::ProgramsChanged.into(),
        ];
        for message in said {
            let text = serde_json::to_string(&message).unwrap();
            assert_eq!(read::<Message>(&text).unwrap(), message, "{text}");
        }
        assert_eq!(read::<RunPhase>(r#"{"stopped":"Aiko"}"#).unwrap(), RunPhase::Stopped("Aiko".into()));
        assert!(read::<Summary>("[]").is_err());
    }
}
