//! Questions to a library of behaviours and its answers: where to look, in which order, and how behaviours relate to
//! each other. Stores answer with these types and the page asks with them, so there is one shape of each.

use crate::{Id, RecordId};
use serde::{Deserialize, Serialize};

/// The places to look in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum SearchPlace {
    /// Everything that is not in the bin.
    #[default]
    Here,
    /// The bin.
    Bin,
}

/// The order of the lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Sort {
    /// Last changed (in the bin: removed) first, then by id from the end.
    #[default]
    Changed,
    /// Name in lower case first, then id.
    Name,
}

/// A line of a page: the next page begins after it. Given back as it came.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Cursor {
    /// The time when it was changed (in the bin: removed), in milliseconds since 1970.
    pub changed_ms: u64,
    /// The last line's name, in the form in which names are ordered.
    pub name_key: String,
    /// The last line's id.
    pub id: Id,
}

/// One use of a helper.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct HelperUse {
    /// The behaviour with the connector, or the library of helpers.
    pub behaviour: Id,
    /// The name to show for the user: the behaviour's name, or in the library the other helper's name.
    pub name: String,
    /// The connector, or the other helper.
    pub record: RecordId,
    /// Through which other helper, the one that the user itself uses; none if it uses the helper itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub through: Option<String>,
}

/// A behaviour that drives an action of the robot.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ActionDriver {
    /// The id of the behaviour.
    pub behaviour: Id,
    /// The name of the behaviour.
    pub name: String,
    /// The names of the sensor streams that lead to the action, in order of name.
    pub sensors: Vec<String>,
}

/// An action that several behaviours drive.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Contested {
    /// The action, by its name in the catalogue.
    pub actuator: String,
    /// Some of the behaviours, id and name; at most [`Contested::SHOWN_MAX`].
    pub behaviours: Vec<(Id, String)>,
    /// The number of all such behaviours, also those that are not named.
    pub count: u64,
}

impl Contested {
    /// The most behaviours that are named.
    pub const SHOWN_MAX: usize = 50;
}

/// A tag, and how many behaviours have it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Tagged {
    /// The tag.
    pub tag: String,
    /// The number of behaviours outside the bin that have it.
    pub count: u64,
}

impl Tagged {
    /// The most tags that are told of a library.
    pub const SHOWN_MAX: usize = 200;
}

/// A behaviour that uses the same senses and actions as another.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Similar {
    /// The id of the behaviour.
    pub behaviour: Id,
    /// The name of the behaviour.
    pub name: String,
    /// The number of different senses and actions that both use.
    pub shared: u32,
}
