//! Letting others in: what people may do, and the invitations by which they come.

use behaviour::Id;
use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};

/// The most invitations that are kept; of those that ended the oldest give way.
pub const INVITATIONS_MAX: usize = 100;
/// The longest note on an invitation, in characters.
pub const LABEL_MAX_CHARS: usize = 60;
/// The most people who came by an invitation that are listed.
pub const CAME_MAX: usize = 32;
/// The time that an invitation for a day lasts, and that one for one person waits for them, in milliseconds.
pub const DAY_MS: u64 = 24 * 60 * 60 * 1_000;

/// The rights of a person; each role may do what those before it may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Role {
    /// Looks on, and may press Stop.
    Viewer,
    /// Runs behaviours on the robots and plays with the room, but edits nothing.
    Operator,
    /// Edits behaviours.
    Editor,
    /// The person at the server's computer: invites others, and takes what somebody else is editing.
    Host,
}

impl Role {
    /// All of them, who may least first.
    pub const ALL: [Self; 4] = [Self::Viewer, Self::Operator, Self::Editor, Self::Host];
}

phrase::shown!(Role);

/// Says the role in a sentence: "an editor".
impl Phrased for Role {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Viewer => phrase!("Role.Viewer", "a viewer"),
            Self::Operator => phrase!("Role.Operator", "an operator"),
            Self::Editor => phrase!("Role.Editor", "an editor"),
            Self::Host => phrase!("Role.Host", "the person at the server’s computer"),
        }
    }
}

/// The time that an invitation lasts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Lasts {
    /// The link of the invitation works once, within a day; who came by it may come again until it is revoked.
    Once,
    /// The link of the invitation works for a day; then it is over for all who came by it.
    Day,
    /// Until it is revoked.
    UntilRevoked,
}

/// An invitation, without what would let somebody in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Invitation {
    /// Which.
    pub id: Id,
    /// The role of who comes by it; never [`Role::Host`].
    pub role: Role,
    /// The time that it lasts.
    pub lasts: Lasts,
    /// For whom it is, in the words of who made it; may be empty.
    pub label: String,
    /// The name of who made it.
    pub made_by: String,
    /// When it was made, in milliseconds since 1970.
    pub made_ms: u64,
    /// When it ends by itself, in milliseconds since 1970; of [`Lasts::Once`], until somebody came by it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends_ms: Option<u64>,
    /// The people who came by it, newest first; at most [`CAME_MAX`].
    #[serde(default)]
    pub came: Vec<InvitedGuest>,
    /// True if it was revoked.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub revoked: bool,
    /// True if it stands nowhere on the server's disk yet that it was revoked: it is tried again, and a restart before
    /// that would undo it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub unwritten: bool,
}

/// Somebody who came by an invitation, on one of their devices.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct InvitedGuest {
    /// The name that they gave themselves; empty until they did.
    pub name: String,
    /// When they came last, in milliseconds since 1970.
    pub at_ms: u64,
    /// True if they are here now.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub here: bool,
}
