//! The rooms of open behaviours: which are open, and how a note reaches one. A room exists at most once, because notes are put into a mailbox
//! and rooms are let go under the same lock.

pub(crate) mod knowledge;
mod task;

use crate::connection::outbox::{Answer, Outbox};
use crate::state::Hub;
use crate::support::lock;
use behaviour::{Behaviour, Change, Id, Room};
use protocol::{LIBRARY, Person, Pointer, SaidNo};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use tokio::sync::{mpsc, oneshot};

/// Notes that may wait for one room.
const MAILBOX_MAX_NOTES: usize = 1_024;
/// Rooms that may be open.
const ROOMS_MAX: usize = 1_024;

/// What a room is told.
#[derive(Debug)]
pub(crate) enum Note {
    /// Somebody comes in, asking with this number; who enters the library hears their secret.
    Join(Member, u32, Option<Id>),
    /// A link leaves.
    Leave(u64),
    /// A change is proposed.
    Propose(Change, Answer),
    /// The behaviour shall go to the bin; with the name of who says so.
    Remove(String, Answer),
    /// The changes after a revision are wanted.
    Since(u64, Answer),
    /// A link's pointer and selection.
    Present(u64, Option<Pointer>, Option<Id>),
    /// The server itself wants to see it as it is.
    Look(oneshot::Sender<Result<Look, SaidNo>>),
}

/// Somebody in a room.
#[derive(Debug)]
pub(crate) struct Member {
    /// Who.
    pub(crate) person: Person,
    /// The way to them.
    pub(crate) outbox: Outbox,
}

/// A behaviour as it is saved.
#[derive(Clone, Debug)]
pub(crate) struct Look(pub(crate) Arc<Room>);

impl Look {
    /// Its records.
    pub(crate) fn behaviour(&self) -> &Behaviour {
        self.0.behaviour()
    }

    /// Its revision.
    pub(crate) fn revision(&self) -> u64 {
        self.0.revision()
    }
}

impl Note {
    /// Answers who waits that it cannot be.
    pub(crate) fn refuse(self, no: SaidNo) {
        match self {
            Self::Join(member, ask, _) => member.outbox.no(ask, no),
            Self::Propose(_, answer) | Self::Remove(_, answer) | Self::Since(_, answer) => answer.no(no),
            Self::Look(waiting) => drop(waiting.send(Err(no))),
            Self::Leave(_) | Self::Present(..) => {}
        }
    }
}

/// The open rooms.
#[derive(Debug, Default)]
pub(crate) struct Rooms(Mutex<BTreeMap<Id, mpsc::Sender<Note>>>);

impl Hub {
    /// Tells a room something and opens it if need be. Never waits.
    pub(crate) fn tell(self: &Arc<Self>, behaviour: &Id, note: Note) {
        let mut open = lock(&self.rooms.0);
        if !open.contains_key(behaviour) {
            if open.len() >= ROOMS_MAX || self.ends() {
                return note.refuse(SaidNo::TooFast);
            }
            let (mailbox, inbox) = mpsc::channel(MAILBOX_MAX_NOTES);
            open.insert(behaviour.clone(), mailbox);
            self.spawn(task::run(Arc::clone(self), behaviour.clone(), inbox));
        }
        let Some(mailbox) = open.get(behaviour) else { return };
        let sent = mailbox.try_send(note);
        drop(open);
        if let Err(error) = sent {
            error.into_inner().refuse(SaidNo::TooFast);
        }
    }

    /// Tells a room something if it is open.
    pub(crate) fn tell_open(&self, behaviour: &Id, note: Note) {
        if let Some(mailbox) = lock(&self.rooms.0).get(behaviour) {
            let _ = mailbox.try_send(note);
        }
    }

    /// Lets a room go, unless somebody wrote to it just now.
    pub(crate) fn let_go(&self, behaviour: &Id, inbox: &mpsc::Receiver<Note>) -> bool {
        let mut open = lock(&self.rooms.0);
        let gone = inbox.is_empty();
        if gone {
            open.remove(behaviour);
        }
        gone
    }

    /// A behaviour as it is saved now.
    pub(crate) async fn look(self: &Arc<Self>, behaviour: &Id) -> Result<Look, SaidNo> {
        let (waiting, answer) = oneshot::channel();
        self.tell(behaviour, Note::Look(waiting));
        answer.await.unwrap_or(Err(SaidNo::NoBehaviour))
    }

    /// Proposes a change to the library in the server's own name.
    pub(crate) async fn propose_to_library(self: &Arc<Self>, change: Change) -> Result<(), SaidNo> {
        let (waiting, answer) = oneshot::channel();
        self.tell(&self.library, Note::Propose(change, Answer::Server(waiting)));
        match answer.await {
            Ok(protocol::Reply::No { no }) => Err(no),
            Ok(_) => Ok(()),
            Err(_) => Err(SaidNo::Store(format!("the {LIBRARY} is closed"))),
        }
    }
}
