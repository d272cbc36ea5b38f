//! What people do in the room, told to the stand-in and to the simulation.

use robot::{SceneEdit, Touchable};
use serde_json::{Value as Json, json};

/// A change of the room.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change {
    /// A ball by its colour goes there.
    Ball(&'static str, [f32; 3]),
    /// Somebody comes or goes.
    Person(&'static str, bool),
    /// A hand on the front of the head, for a moment.
    Tap,
    /// The head of the stand-in is turned ahead: it alone had moved it.
    HeadAhead,
}

impl Change {
    /// For the stand-in.
    pub(crate) fn told(self) -> Vec<Json> {
        match self {
            Self::Ball(color, at) => vec![json!({"balls": {color: {"at": at}}})],
            Self::Person(name, present) => vec![json!({"people": {name: {"present": present}}})],
            Self::Tap => [true, false]
                .map(|down| json!({"touch": {"part": "FrontTactilTouched", "down": down}}))
                .to_vec(),
            Self::HeadAhead => vec![json!({"joints": {"HeadYaw": 0.0, "HeadPitch": 0.0}})],
        }
    }

    /// For the simulation.
    pub(crate) fn edits(self) -> Vec<SceneEdit> {
        match self {
            Self::Ball(color, at) => vec![SceneEdit::MoveBall { id: color.into(), at }],
            Self::Person(name, present) => vec![SceneEdit::SetPresent { id: name.into(), present }],
            Self::Tap => [true, false].map(|down| SceneEdit::Touch { part: Touchable::HeadFront, down }).to_vec(),
            Self::HeadAhead => Vec::new(),
        }
    }
}
