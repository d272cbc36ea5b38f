//! The reliable queue to one client: in order, bounded; who cannot keep up is cut off and fetches everything anew.

use crate::cut::{Cut, Why};
use axum::extract::ws::Utf8Bytes;
use protocol::{Message, Reply, SaidNo};
use tokio::sync::{mpsc, watch};

/// Messages that may wait for one client.
pub(crate) const QUEUE_MAX_MESSAGES: usize = 256;

/// What the writing task of a client is told.
#[derive(Debug)]
pub(crate) enum Out {
    /// Send this.
    Text(Utf8Bytes),
    /// From now on tell what goes on in this room.
    Follow(Box<Feed>),
    /// No longer.
    Unfollow,
    /// Which pictures are wanted.
    Watch {
        /// Of which robot; none means the first one.
        robot: Option<behaviour::Id>,
        /// Pictures of the scene.
        scene: bool,
        /// Live values.
        values: bool,
    },
}

/// What a room shows besides its changes; only the newest counts.
#[derive(Clone, Debug)]
pub(crate) struct Feed {
    /// Which room.
    pub(crate) behaviour: behaviour::Id,
    /// Its revision.
    pub(crate) revision: watch::Receiver<u64>,
    /// Who is there.
    pub(crate) people: watch::Receiver<Utf8Bytes>,
    /// Its problems.
    pub(crate) problems: watch::Receiver<Utf8Bytes>,
}

/// The way to one client.
#[derive(Clone, Debug)]
pub(crate) struct Outbox {
    /// The number of the link, never used twice.
    pub(crate) session: u64,
    /// Ends the link.
    pub(crate) cut: Cut,
    queue: mpsc::Sender<Out>,
}

impl Outbox {
    /// A way, and its other end.
    pub(crate) fn new(session: u64) -> (Self, mpsc::Receiver<Out>) {
        let (queue, inbox) = mpsc::channel(QUEUE_MAX_MESSAGES);
        (Self { session, cut: Cut::new(), queue }, inbox)
    }

    /// Says something, as the answer to `ask` if there is one.
    pub(crate) fn say(&self, ask: Option<u32>, reply: Reply) {
        self.put(Out::Text(encode(ask, reply)));
    }

    /// Says why not.
    pub(crate) fn no(&self, ask: u32, no: SaidNo) {
        self.say(Some(ask), Reply::No { no });
    }

    /// Never waits.
    pub(crate) fn put(&self, out: Out) {
        if let Err(mpsc::error::TrySendError::Full(_)) = self.queue.try_send(out) {
            self.cut.with(Why::Resync);
        }
    }
}

/// Who waits for an answer: a client, or this server itself.
#[derive(Debug)]
pub(crate) enum Answer {
    /// A client that asked.
    Client(Outbox, u32),
    /// The server.
    Server(tokio::sync::oneshot::Sender<Reply>),
}

impl Answer {
    /// Gives the answer.
    pub(crate) fn give(self, reply: Reply) {
        match self {
            Self::Client(outbox, ask) => outbox.say(Some(ask), reply),
            Self::Server(waiting) => drop(waiting.send(reply)),
        }
    }

    /// Says why not.
    pub(crate) fn no(self, no: SaidNo) {
        self.give(Reply::No { no });
    }

    /// The link that asked.
    pub(crate) fn session(&self) -> Option<u64> {
        if let Self::Client(outbox, _) = self { Some(outbox.session) } else { None }
    }
}

/// One message as text.
pub(crate) fn encode(ask: Option<u32>, reply: Reply) -> Utf8Bytes {
    let text = serde_json::to_string(&Message { ask, reply });
    text.unwrap_or_else(|error| {
        format!("{{\"reply\":{{\"is\":\"no\",\"no\":{{\"why\":\"unreadable\",\"what\":\"{error}\"}}}}}}")
    })
    .into()
}
