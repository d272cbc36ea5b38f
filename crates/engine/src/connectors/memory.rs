//! The memory of a connector from one instant to the next, in a form that both modes give and take.

use crate::values::CarriedValue;
use behaviour::Value;
use robot::Millis;
use serde::{Deserialize, Serialize};

/// The memory of a connector. Each kind of connector chooses the fields that it uses, and for what.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct ConnectorMemory {
    /// Values that it knows, each in its place.
    #[serde(with = "known", skip_serializing_if = "Vec::is_empty")]
    pub(crate) known: Vec<Option<Value>>,
    /// Values that it will give by itself, the first one first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) waiting: Vec<WaitingValue>,
}

/// A value that will be given by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WaitingValue {
    pub(crate) carried: CarriedValue,
    pub(crate) due: Millis,
}

/// Values that are known or not, each as a list of one or none: a known nothing is told from what is not known.
mod known {
    use behaviour::Value;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(known: &[Option<Value>], to: S) -> Result<S::Ok, S::Error> {
        let lists: Vec<&[Value]> = known.iter().map(|known| known.as_slice()).collect();
        lists.serialize(to)
    }

    pub(super) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<Vec<Option<Value>>, D::Error> {
        let lists: Vec<Vec<Value>> = Vec::deserialize(from)?;
        Ok(lists.into_iter().map(|list| list.into_iter().next()).collect())
    }
}
