//! The sentences of a behaviour, as pages show them that do not make them.

use behaviour::Id;
use serde::{Deserialize, Serialize};

/// The most sentences that are told of one behaviour.
pub const TOLD_MAX: usize = 40;

/// One sentence of a behaviour: when an action is done, and what. Code stands between backticks.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProgramSentence {
    /// The words before what is done: when it is done. May be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub lead: String,
    /// The words from there on: what is done.
    pub does: String,
    /// The connector that leads to the action: the sentence happens whenever it passes something on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub connector: Option<Id>,
}
