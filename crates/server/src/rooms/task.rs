//! The task of one open behaviour: it holds the pure room, which decides; it saves and then tells everyone there.
//! One change is decided about after another, and small ones that wait are saved together; who only looks, comes or goes
//! never waits for saving.

mod change_log;
mod jobs;
mod locking;
mod making;
mod members;
mod naming;
mod past;
mod problems;
mod replay;
mod saving;
mod waiting;

use super::member::{Member, RoomFeed};
use super::shown::ShownBehaviour;
use super::snapshot::LibrarySnapshot;
use super::{RoomCommand, Rooms, SavedLook, Surroundings};
use crate::support::message::encode;
use crate::support::store_call::{answer_by, bounded, by, store_no};
use axum::extract::ws::Utf8Bytes;
use behaviour::{Accepted, Change, Checkpoints, Id, Room};
use change_log::ChangeLog;
use jobs::SavingStage;
use locking::LockBook;
use problems::{Finding, FoundProblems};
use protocol::{Event, Refused};
use saving::Proposal;
use std::collections::BTreeMap;
use std::sync::{Arc, Weak};
use store::StoreError;
use tokio::sync::{mpsc, oneshot, watch};
use tokio::time::Instant;
use waiting::{SavingJob, WaitingJobs};

/// True if a behaviour is there.
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
    rooms: Rooms,
    around: Arc<Surroundings>,
    id: Id,
    /// Shared with whoever looks at it or decides about it elsewhere just now.
    room: Arc<Room>,
    /// Who is editing what.
    locks: LockBook,
    /// By the number of their link.
    members: BTreeMap<u64, Member>,
    /// What waits for saving.
    waiting: WaitingJobs,
    saving: SavingStage,
    /// When what it saves just now is to be answered.
    answer_by: Option<Instant>,
    stay: Stay,
    log: ChangeLog,
    snapshot: watch::Receiver<Arc<LibrarySnapshot>>,
    found: FoundProblems,
    finding: Finding,
    /// What those who opened it last are shown.
    shown: Weak<ShownBehaviour>,
    revision: watch::Sender<u64>,
    people_text: watch::Sender<Utf8Bytes>,
    problems_text: watch::Sender<Utf8Bytes>,
    /// Its versions with a name.
    versions: Checkpoints,
    versions_text: watch::Sender<Utf8Bytes>,
}

/// Runs a room until nobody needs it.
pub(super) async fn run(rooms: Rooms, id: Id, mut inbox: mpsc::Receiver<RoomCommand>) {
    let no = match by(answer_by(), load(&rooms.around, &id)).await {
        Ok(Some((room, versions))) => {
            let mut task = RoomTask::new(rooms, id.clone(), room, versions);
            task.find_problems_at_first().await;
            return task.live(inbox).await;
        }
        Ok(None) => Refused::NoBehaviour,
        Err(error) => store_no(&error),
    };
    tracing::info!(behaviour = %id, %no, "a room did not open");
    while !rooms.let_go(&id, &inbox) {
        if let Ok(note) = inbox.try_recv() {
            note.refuse(no.clone());
        }
    }
}

/// A behaviour that is not in the bin, with its named versions.
async fn load(around: &Surroundings, id: &Id) -> Result<Option<(Room, Checkpoints)>, StoreError> {
    let loaded = bounded(around.store.load(id)).await?.filter(|loaded| loaded.removed_ms.is_none());
    let Some(loaded) = loaded else { return Ok(None) };
    let versions = naming::kept(&*around.store, id).await?;
    Ok(Some((Room::open(loaded.behaviour, loaded.revision), versions)))
}

impl RoomTask {
    fn new(rooms: Rooms, id: Id, room: Room, versions: Checkpoints) -> Self {
        let around = Arc::clone(&rooms.around);
        let snapshot = around.snapshot.subscribe();
        let versions_text = watch::Sender::new(naming::text(&id, &versions));
        let (revision, rooms_epoch) = (watch::Sender::new(room.revision()), around.epoch);
        Self {
            rooms,
            around,
            id,
            room: Arc::new(room),
            locks: LockBook::new(rooms_epoch),
            members: BTreeMap::new(),
            waiting: WaitingJobs::default(),
            saving: SavingStage::Idle,
            answer_by: None,
            stay: Stay::Here,
            log: ChangeLog::default(),
            snapshot,
            found: FoundProblems::default(),
            finding: Finding::Current,
            shown: Weak::new(),
            revision,
            people_text: watch::Sender::new(Utf8Bytes::default()),
            problems_text: watch::Sender::new(Utf8Bytes::default()),
            versions,
            versions_text,
        }
    }

    fn is_library(&self) -> bool {
        self.id == self.around.library
    }

    async fn live(mut self, mut inbox: mpsc::Receiver<RoomCommand>) {
        let stopping = self.around.tasks.stopping.clone();
        tracing::debug!(behaviour = %self.id, revision = self.room.revision(), "a room opens");
        while !self.may_go() || !self.rooms.let_go(&self.id, &inbox) {
            self.start_saving();
            self.start_finding();
            tokio::select! {
                saved = self.saving.answer() => self.saved(saved),
                found = self.finding.answer() => self.found_problems(found),
                Some(note) = inbox.recv() => self.take(note),
                Ok(()) = self.snapshot.changed(), if !self.is_library() => self.finding.mark_due(),
                () = self.locks.due() => self.tell_locks(),
                () = stopping.cancelled(), if !stopping.is_cancelled() => {}
            }
        }
        tracing::debug!(behaviour = %self.id, "a room closes");
    }

    /// Never while saving; the library stays open until the server ends.
    fn may_go(&self) -> bool {
        let busy = self.saving.is_under_way() || !self.waiting.is_empty();
        let needed = !self.members.is_empty() || self.is_library() || !self.locks.are_free();
        !busy && (!needed || self.around.tasks.ends())
    }

    fn take(&mut self, note: RoomCommand) {
        match note {
            RoomCommand::Join(member, joining) => self.join(member, joining),
            RoomCommand::Leave(session, parting) => self.leave(session, parting),
            RoomCommand::Propose(change, tokens, from) => self.wait(SavingJob::Save(Proposal { change, tokens, from })),
            RoomCommand::Past(past) => self.past(past),
            RoomCommand::Locking(session, locking) => self.lock(session, locking),
            RoomCommand::Remove(by, answer) => self.wait(SavingJob::Remove(by, answer)),
            RoomCommand::Since(revision, answer) => self.since(revision, answer),
            RoomCommand::Present(session, whereabouts) => self.present(session, whereabouts),
            RoomCommand::PresentMoment(session, at) => self.present_moment(session, at),
            RoomCommand::Rename(session, name) => self.rename(session, name),
            RoomCommand::MayChange(change, waiting) => drop(waiting.send(self.may_change(&change))),
            RoomCommand::Look(waiting) => self.look(waiting),
        }
    }

    fn may_change(&self, change: &Change) -> Result<(), Refused> {
        if self.stay != Stay::Here {
            return Err(Refused::NoBehaviour);
        }
        self.locks.check(&self.room, change).map_err(Refused::Change)
    }

    fn look(&self, waiting: oneshot::Sender<Result<SavedLook, Refused>>) {
        let look = SavedLook(Arc::clone(&self.room));
        let _ = waiting.send(if self.stay == Stay::Here { Ok(look) } else { Err(Refused::NoBehaviour) });
    }

    fn feed(&self) -> RoomFeed {
        let mut versions = self.versions_text.subscribe();
        versions.mark_changed();
        RoomFeed {
            behaviour: self.id.clone(),
            revision: self.revision.subscribe(),
            people: self.people_text.subscribe(),
            problems: self.problems_text.subscribe(),
            locks: self.locks.text(),
            versions,
        }
    }

    /// Makes a saved change the truth, the room as it is `after` it if somebody made that already, and tells everyone.
    fn commit(&mut self, accepted: &Accepted, after: Option<&Arc<Room>>) {
        match after.filter(|after| after.revision() == accepted.revision) {
            Some(after) => self.room = Arc::clone(after),
            None => Arc::make_mut(&mut self.room).commit(accepted),
        }
        self.log.push(accepted);
        self.tell_accepted(accepted);
        self.revision.send_replace(accepted.revision);
        if self.is_library() {
            let (behaviour, revision) = (self.room.behaviour().clone(), accepted.revision);
            self.around.snapshot.send_replace(Arc::new(LibrarySnapshot { behaviour, revision }));
        } else {
            self.finding.mark_due();
            self.around.news.changed(accepted);
        }
    }

    fn tell_accepted(&self, accepted: &Accepted) {
        let text = encode(Event::Accepted { behaviour: self.id.clone(), accepted: accepted.clone() });
        self.members.values().for_each(|member| member.link.send(text.clone()));
    }
}
