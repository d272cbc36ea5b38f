//! The robots in a backup.

use behaviour::Id;
use serde::{Deserialize, Serialize};

/// A robot that is kept beside a store, with the order of the behaviours on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Robot {
    /// Its id.
    pub id: Id,
    /// What people call it.
    pub name: String,
    /// The seed of its noise.
    pub seed: u64,
    /// The behaviours whose place is remembered, from the top.
    pub order: Vec<Id>,
}
