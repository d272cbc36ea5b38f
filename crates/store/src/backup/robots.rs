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
    /// How it is reached; none for a simulated one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub real: Option<Reached>,
    /// The behaviours whose place is remembered, from the top.
    pub order: Vec<Id>,
}

/// How a real robot is reached. Its password is in no backup: a backup goes from hand to hand.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Reached {
    /// Its address.
    pub address: String,
    /// Its user, if it asks for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub user: Option<String>,
    /// The certificate that it must show, if it shows one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<String>,
}
