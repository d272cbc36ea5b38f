//! The people of a server, and where they are on the canvas.

use crate::PastOf;
use behaviour::Id;
use serde::{Deserialize, Serialize};

/// A person who is here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Person {
    /// This connection.
    pub client: Id,
    /// Name.
    pub name: String,
    /// Which of the eight colours for people, 0 to 7.
    pub color: u8,
    /// Pointer on the canvas.
    #[serde(default)]
    pub pointer: Option<Pointer>,
    /// Selected stream or connector.
    #[serde(default)]
    pub selected: Option<Id>,
    /// The part of the canvas that they see.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<CanvasArea>,
    /// The moment of a past at which they look; none while they look at now.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub looks_at: Option<LookedMoment>,
}

/// A moment of a past at which somebody looks.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LookedMoment {
    /// The past. Whoever follows opens it themselves, and is refused what they may not see.
    pub past: PastOf,
    /// The moment, in milliseconds since Start.
    pub at_ms: u64,
    /// The same moment in milliseconds since 1970, for who shows its time of day without the past.
    pub clock_ms: u64,
    /// The client with whom they look, if they follow somebody.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<Id>,
}

/// Proves that a client is the one that it was on an earlier link.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Credential {
    /// The id that the server gave it.
    pub client: Id,
    /// The secret that only it was told, in [`crate::answer::Welcome`].
    pub secret: Id,
}

/// A pointer on the canvas, in canvas units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pointer {
    /// To the right.
    pub x: f64,
    /// Downwards.
    pub y: f64,
}

/// A part of the canvas, in canvas units; no side of it is larger than [`crate::CANVAS_MAX`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CanvasArea {
    /// The left end of the area.
    pub x: f64,
    /// The upper end of the area.
    pub y: f64,
    /// To the right of that.
    pub width: f64,
    /// Downwards.
    pub height: f64,
}
