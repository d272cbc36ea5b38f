//! What a library of behaviours is asked and tells: where to look, in which order, and what behaviours have to do with
//! each other. Stores answer with it and the page asks with it, so there is one shape of each.

use crate::{Id, RecordId};
use serde::{Deserialize, Serialize};

/// Where to look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Place {
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
    /// By name in lower case, then by id.
    Name,
}

/// A line of a page: the next page begins after it. Given back as it came.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Cursor {
    /// When it was changed (in the bin: removed), in milliseconds since 1970.
    pub changed_ms: u64,
    /// Its name as names are ordered.
    pub name_key: String,
    /// Its id.
    pub id: Id,
}

/// One use of a helper.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Used {
    /// The behaviour with the connector, or the library of helpers.
    pub behaviour: Id,
    /// What to call the user: the behaviour's name, or in the library the other helper's name.
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
pub struct Driver {
    /// Which.
    pub behaviour: Id,
    /// Its name.
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
    /// How many there are altogether.
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
    /// How many behaviours outside the bin.
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
    /// Which.
    pub behaviour: Id,
    /// Its name.
    pub name: String,
    /// How many different senses and actions both use.
    pub shared: u32,
}
