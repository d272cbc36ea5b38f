//! The task of one open behaviour: it holds the pure room, which decides; it saves and then tells everyone there.
//! One change is saved at a time; who only looks, comes or goes never waits for saving.

use change_log::ChangeLog;
use jobs::{Job, Waiting};
use problems::Found;
use saving::Saved;
mod change_log;
mod jobs;
mod members;
mod problems;
mod saving;

use crate::connection::outbox::Feed;
use crate::rooms::{Look, Member, Note};
use crate::state::{Hub, Shelf};
use crate::support::message::encode;
use crate::support::store_call::{bounded, store_no};
use crate::support::workers::NotDone;
use axum::extract::ws::Utf8Bytes;
use behaviour::{Accepted, Id, Room};
use futures_util::future::BoxFuture;
use protocol::SaidNo;
use std::collections::BTreeMap;
use std::sync::Arc;
use tokio::sync::{mpsc, oneshot, watch};

/// Whether a behaviour is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stay {
    /// It is.
    Here,
    /// It is about to go to the bin: it cannot be started any more.
    Leaving,
    /// It went to the bin.
    Gone,
}

/// One open behaviour, or the library.
struct RoomTask {
    hub: Arc<Hub>,
    id: Id,
    /// Shared with whoever looks at it or decides about it elsewhere just now.
    room: Arc<Room>,
    /// By the number of their link.
    members: BTreeMap<u64, Member>,
    /// What waits for saving.
    waiting: Waiting,
    /// What is being saved.
    saving: Option<BoxFuture<'static, Saved>>,
    /// True when the store may have more than this room knows.
    uncertain: bool,
    stay: Stay,
    log: ChangeLog,
    shelf: watch::Receiver<Arc<Shelf>>,
    found: Found,
    problems_due: bool,
    finding: Option<BoxFuture<'static, Result<Found, NotDone>>>,
    revision: watch::Sender<u64>,
    people_text: watch::Sender<Utf8Bytes>,
    problems_text: watch::Sender<Utf8Bytes>,
}

/// Runs a room until nobody needs it.
pub(crate) async fn run(hub: Arc<Hub>, id: Id, mut inbox: mpsc::Receiver<Note>) {
    let loaded = bounded(hub.store.load(&id)).await;
    let no = match loaded {
        Ok(Some(loaded)) if loaded.removed_ms.is_none() => {
            let mut task = RoomTask::new(hub.clone(), id.clone(), Room::open(loaded.behaviour, loaded.revision));
            task.find_problems_at_first().await;
            return task.live(inbox).await;
        }
        Ok(_) => SaidNo::NoBehaviour,
        Err(error) => store_no(&error),
    };
    tracing::info!(behaviour = %id, %no, "a room did not open");
    while !hub.let_go(&id, &inbox) {
        if let Ok(note) = inbox.try_recv() {
            note.refuse(no.clone());
        }
    }
}

impl RoomTask {
    fn new(hub: Arc<Hub>, id: Id, room: Room) -> Self {
        let shelf = hub.shelf.subscribe();
        let revision = watch::Sender::new(room.revision());
        Self {
            hub,
            id,
            room: Arc::new(room),
            members: BTreeMap::new(),
            waiting: Waiting::default(),
            saving: None,
            uncertain: false,
            stay: Stay::Here,
            log: ChangeLog::default(),
            shelf,
            found: Found::default(),
            problems_due: false,
            finding: None,
            revision,
            people_text: watch::Sender::new(Utf8Bytes::default()),
            problems_text: watch::Sender::new(Utf8Bytes::default()),
        }
    }

    fn is_library(&self) -> bool {
        self.id == self.hub.library
    }

    async fn live(mut self, mut inbox: mpsc::Receiver<Note>) {
        let stopping = self.hub.stopping.clone();
        tracing::debug!(behaviour = %self.id, revision = self.room.revision(), "a room opens");
        while !self.may_go() || !self.hub.let_go(&self.id, &inbox) {
            self.start_saving();
            self.start_finding();
            tokio::select! {
                saved = due(&mut self.saving) => self.saved(saved),
                found = due(&mut self.finding) => self.found_problems(found),
                Some(note) = inbox.recv() => self.take(note),
                Ok(()) = self.shelf.changed(), if !self.is_library() => self.problems_due = true,
                () = stopping.cancelled(), if !stopping.is_cancelled() => {}
            }
        }
        tracing::debug!(behaviour = %self.id, "a room closes");
    }

    /// Never while saving; the library stays open until the server ends.
    fn may_go(&self) -> bool {
        let busy = self.saving.is_some() || !self.waiting.is_empty();
        let needed = !self.members.is_empty() || self.is_library();
        !busy && (!needed || self.hub.ends())
    }

    fn take(&mut self, note: Note) {
        match note {
            Note::Join(member, ask, secret) => self.join(member, ask, secret),
            Note::Leave(session) => self.leave(session),
            Note::Propose(change, answer) => self.wait(Job::Save(change, answer)),
            Note::Remove(by, answer) => self.wait(Job::Remove(by, answer)),
            Note::Since(revision, answer) => self.since(revision, answer),
            Note::Present(session, pointer, selected) => self.present(session, pointer, selected),
            Note::Look(waiting) => self.look(waiting),
        }
    }

    fn look(&self, waiting: oneshot::Sender<Result<Look, SaidNo>>) {
        let look = Look(Arc::clone(&self.room));
        let _ = waiting.send(if self.stay == Stay::Here { Ok(look) } else { Err(SaidNo::NoBehaviour) });
    }

    fn feed(&self) -> Feed {
        Feed {
            behaviour: self.id.clone(),
            revision: self.revision.subscribe(),
            people: self.people_text.subscribe(),
            problems: self.problems_text.subscribe(),
        }
    }

    /// Makes a saved change the truth and tells everyone; the copy of who asked carries the ask.
    fn commit(&mut self, accepted: &Accepted, asked: Option<(u64, u32)>) {
        Arc::make_mut(&mut self.room).commit(accepted);
        self.log.push(accepted);
        self.tell_accepted(accepted, asked);
        self.revision.send_replace(accepted.revision);
        if self.is_library() {
            let shelf = Shelf { behaviour: self.room.behaviour().clone(), revision: accepted.revision };
            self.hub.shelf.send_replace(Arc::new(shelf));
        } else {
            self.problems_due = true;
            self.hub.programs.changed(accepted);
        }
    }

    fn tell_accepted(&self, accepted: &Accepted, asked: Option<(u64, u32)>) {
        let reply = || protocol::Reply::Accepted { behaviour: self.id.clone(), accepted: accepted.clone() };
        let text = encode(None, reply());
        for (session, member) in &self.members {
            match asked {
                Some((asking, ask)) if asking == *session => member.outbox.say(Some(ask), reply()),
                _ => member.outbox.put(crate::connection::outbox::Out::Text(text.clone())),
            }
        }
    }
}

/// Waits for something that may be under way, else for ever.
async fn due<F: Future + Unpin>(under_way: &mut Option<F>) -> F::Output {
    match under_way {
        Some(future) => {
            let output = future.await;
            *under_way = None;
            output
        }
        None => std::future::pending().await,
    }
}
