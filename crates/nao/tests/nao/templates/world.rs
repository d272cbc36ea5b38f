//! The things that people do in the room, told to the stand-in and to the simulation.

use robot::{SceneEdit, Touchable};
use serde_json::{Value as Json, json};

/// A change of the room.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change {
    /// A ball by its colour goes there.
    Ball(&'static str, [f32; 3]),
    /// Somebody comes or goes.
    Person(&'static str, bool),
    /// A hand comes to the front of the head, or leaves it.
    Hand(bool),
    /// The head of the stand-in is turned ahead: it alone had moved it.
    HeadAhead,
}

impl Change {
    /// For the stand-in.
    pub(crate) fn told(self) -> Json {
        match self {
            Self::Ball(color, at) => json!({"balls": {color: {"at": at}}}),
            Self::Person(name, present) => json!({"people": {name: {"present": present}}}),
            Self::Hand(down) => json!({"touch": {"part": "FrontTactilTouched", "down": down}}),
            Self::HeadAhead => json!({"joints": {"HeadYaw": 0.0, "HeadPitch": 0.0}}),
        }
    }

    /// For the simulation.
    pub(crate) fn edit(self) -> Option<SceneEdit> {
        match self {
            Self::Ball(color, at) => Some(SceneEdit::MoveBall { id: color.into(), at }),
            Self::Person(name, present) => Some(SceneEdit::SetPresent { id: name.into(), present }),
            Self::Hand(down) => Some(SceneEdit::Touch { part: Touchable::HeadFront, down }),
            Self::HeadAhead => None,
        }
    }
}
