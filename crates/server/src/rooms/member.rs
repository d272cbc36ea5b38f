//! Who is in a room and who waits for its answers, as far as a room has to know.

use super::shown::{GaveWay, ShownBehaviour};
use crate::support::identity::{PersonIdentity, Sender, ShareGroup};
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::Id;
use protocol::{AnyAnswer, Message, PartsCursor, Person, Refused, RequestAnswer};
use std::sync::Arc;
use tokio::sync::{oneshot, watch};

/// The way to one client. What is put in arrives in order; nothing here waits.
pub(crate) trait Recipient: Send + Sync {
    /// The number of the link, never used twice.
    fn session(&self) -> u64;
    /// Whose link it is.
    fn person(&self) -> &PersonIdentity;
    /// True if the link ended, so that nobody hears what is sent.
    fn is_gone(&self) -> bool;
    /// Sends a message.
    fn send(&self, text: Utf8Bytes);
    /// Sends all of a behaviour, as the answer to `ask`.
    fn send_whole(&self, ask: u32, whole: WholeBehaviour);
    /// From now on tells what goes on in a room, if that is still the one that is wanted: a room that opens late may come
    /// after another that was wanted meanwhile.
    fn follow(&self, feed: Box<RoomFeed>);
    /// Tells no longer what goes on in this room, which is gone.
    fn unfollow(&self, gone: Id);
}

/// Somebody in a room.
pub(crate) struct Member {
    /// Who.
    pub(crate) person: Person,
    /// The way to them.
    pub(crate) link: Arc<dyn Recipient>,
}

/// A welcome, or a behaviour as it is or was, with all its records, shared by all who get it until they are written.
#[derive(Debug)]
pub(crate) struct WholeBehaviour {
    /// The answer without records.
    pub(crate) answer: AnyAnswer,
    /// The records.
    pub(crate) shown: Arc<ShownBehaviour>,
}

impl WholeBehaviour {
    /// The messages, each made when it is its turn.
    pub(crate) fn texts(self, ask: u32) -> impl Iterator<Item = Result<Utf8Bytes, GaveWay>> + Send {
        let (mut first, shown, mut parts) = (Some(self.answer), self.shown, PartsCursor::default());
        let next = move || shown.room().map(|room| parts.next(room.behaviour())).transpose();
        let parts = (0..).zip(std::iter::from_fn(next));
        parts.map(move |(number, part)| {
            let part = part?;
            Ok(match first.take() {
                Some(answer) => encode(Message::Answer { ask, answer: answer.with(part) }),
                None => {
                    let (records, more) = (Box::new(part.records), part.more);
                    encode(Message::Records { part: number, records, more })
                }
            })
        })
    }
}

/// What a room shows besides its changes; only the newest counts.
#[derive(Clone, Debug)]
pub(crate) struct RoomFeed {
    /// Which room.
    pub(crate) behaviour: Id,
    /// Its revision.
    pub(crate) revision: watch::Receiver<u64>,
    /// Who is there.
    pub(crate) people: watch::Receiver<Utf8Bytes>,
    /// Its problems.
    pub(crate) problems: watch::Receiver<Utf8Bytes>,
    /// Who is editing what.
    pub(crate) locks: watch::Receiver<Utf8Bytes>,
    /// Its versions with a name.
    pub(crate) versions: watch::Receiver<Utf8Bytes>,
}

/// The one who waits for an answer of this type: a client, or this server itself.
pub(crate) enum AnswerTo<A> {
    /// A client that asked.
    Client {
        /// The way to it.
        to: Arc<dyn Recipient>,
        /// The number of its request.
        ask: u32,
        /// The memory that its message takes until it is answered.
        held: Option<Box<dyn Send + Sync>>,
    },
    /// The server.
    Server(oneshot::Sender<Result<A, Refused>>),
}

impl<A: RequestAnswer> AnswerTo<A> {
    /// Gives the answer.
    pub(crate) fn give(self, answer: A) {
        self.end(Ok(answer));
    }

    /// Says what came of it.
    pub(crate) fn end(self, outcome: Result<A, Refused>) {
        match self {
            Self::Client { to, ask, held } => {
                to.send(encode(match outcome {
                    Ok(answer) => Message::Answer { ask, answer: answer.into() },
                    Err(no) => Message::No { ask: Some(ask), no },
                }));
                drop(held);
            }
            Self::Server(waiting) => drop(waiting.send(outcome)),
        }
    }

    /// Shows all of a behaviour.
    pub(crate) fn show(self, answer: A, shown: Arc<ShownBehaviour>) {
        match self {
            Self::Client { to, ask, held } => {
                to.send_whole(ask, WholeBehaviour { answer: answer.into(), shown });
                drop(held);
            }
            Self::Server(waiting) => drop(waiting.send(Ok(answer))),
        }
    }

    /// True if whoever asked is gone.
    pub(crate) fn is_unwanted(&self) -> bool {
        match self {
            Self::Client { to, .. } => to.is_gone(),
            Self::Server(waiting) => waiting.is_closed(),
        }
    }

    /// Says why not.
    pub(crate) fn no(self, no: Refused) {
        self.end(Err(no));
    }

    /// For whom what was asked is done.
    pub(crate) fn sender(&self) -> Sender {
        match self {
            Self::Client { to, .. } => to.person().asks(to.session()),
            Self::Server(_) => Sender::Server,
        }
    }

    /// The group of who asked.
    pub(crate) fn group(&self) -> ShareGroup {
        self.sender().group()
    }

    /// The link that asked.
    pub(crate) fn session(&self) -> Option<u64> {
        if let Self::Client { to, .. } = self { Some(to.session()) } else { None }
    }
}
