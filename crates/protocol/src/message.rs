//! The messages of the server.

use crate::answer::{Runs, Stopped, Welcome};
use crate::{AnyAnswer, Event, Refused};
use behaviour::Behaviour;
use serde::{Deserialize, Serialize};

/// A message of the server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Message {
    /// The answer to a request.
    Answer {
        /// The number of the request.
        ask: u32,
        /// The answer.
        answer: AnyAnswer,
    },
    /// Something was not done.
    No {
        /// The number of the request; none if it could not be read, or something else was not done.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        ask: Option<u32>,
        /// The reason.
        no: Refused,
    },
    /// Something that is told unasked.
    Event(Event),
    /// More records of the answer before it, which is told in parts; nothing that needs the whole comes in between.
    /// [`crate::Assembly`] puts them together.
    Records {
        /// Which part, from 1: the first records came before.
        part: u32,
        /// The records.
        records: Box<Behaviour>,
        /// True if another part follows.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        more: bool,
    },
}

impl Message {
    /// Returns the number of the newest Stop, if this tells it.
    #[must_use]
    pub fn stops(&self) -> Option<u64> {
        match self {
            Self::Event(Event::Runs { stops, .. })
            | Self::Answer {
                answer:
                    AnyAnswer::Runs(Runs { stops, .. })
                    | AnyAnswer::Stopped(Stopped { stops })
                    | AnyAnswer::Welcome(Welcome { stops, .. }),
                ..
            } => Some(*stops),
            Self::Answer { .. } | Self::No { .. } | Self::Event(_) | Self::Records { .. } => None,
        }
    }

    /// Returns the answer to the request of this number, if this is it.
    #[must_use]
    pub fn answer_to(self, number: u32) -> Option<Result<AnyAnswer, Refused>> {
        match self {
            Self::Answer { ask, answer } if ask == number => Some(Ok(answer)),
            Self::No { ask: Some(ask), no } if ask == number => Some(Err(no)),
            Self::Answer { .. } | Self::No { .. } | Self::Event(_) | Self::Records { .. } => None,
        }
    }
}

impl From<Event> for Message {
    fn from(event: Event) -> Self {
        Self::Event(event)
    }
}
