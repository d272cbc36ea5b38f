//! The rooms of open behaviours: which are open, and how a note reaches one. A room exists at most once, because notes
//! are put into a mailbox and rooms are let go under the same lock.

pub(crate) mod knowledge;
pub(crate) mod list_news;
pub(crate) mod member;
pub(crate) mod past;
pub(crate) mod shown;
pub(crate) mod snapshot;
mod task;

use crate::support::identity::Sender;
use crate::support::lock;
use crate::support::lookups::Lookups;
use crate::support::store_health::StoreHealth;
use crate::support::tasks::Tasks;
use crate::support::workers::Workers;
use behaviour::{Behaviour, Change, Decision, Id, Knowledge, LockToken, RecordId, Refusal, Room};
use knowledge::Knowing;
use list_news::ListNews;
use member::{AnswerTo, Member};
use past::PastRequest;
use protocol::{CanvasArea, Exercise, LIBRARY, LookedMoment, Pointer, Refused, Role, Summary, answer};
use shown::AllShown;
use snapshot::LibrarySnapshot;
use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex};
use store::Store;
use tokio::sync::{mpsc, oneshot, watch};

/// Notes that may wait for one room.
const MAILBOX_MAX_NOTES: usize = 1_024;
/// Rooms that may be open.
const ROOMS_MAX: usize = 1_024;

/// What a room is told.
pub(crate) enum RoomCommand {
    /// Somebody comes in.
    Join(Member, JoinRequest),
    /// A link leaves.
    Leave(u64, LeaveReason),
    /// A change is proposed, with the tokens of what its sender locked.
    Propose(Change, Vec<LockToken>, AnswerTo<answer::Saved>),
    /// Something about who is editing what, from a link.
    Locking(u64, LockRequest),
    /// Something of its past is wanted.
    Past(PastRequest),
    /// The behaviour shall go to the bin, unless somebody else is editing it.
    Remove(BinRequest, AnswerTo<()>),
    /// The changes after a revision are wanted.
    Since(u64, AnswerTo<answer::Newer>),
    /// Where a link's person is.
    Present(u64, Whereabouts),
    /// At which moment of a past a link's person looks, if they do.
    PresentMoment(u64, Option<LookedMoment>),
    /// A link's person is called something else from now on.
    Rename(u64, String),
    /// The server asks whether locks of others would let in a change of its own.
    MayChange(Change, oneshot::Sender<Result<(), Refused>>),
    /// The server itself wants to see it as it is.
    Look(oneshot::Sender<Result<SavedLook, Refused>>),
}

/// The place where somebody comes in, and the answer to it.
pub(crate) enum JoinRequest {
    /// Into the server, whose library everyone has open.
    Server(Entering, AnswerTo<answer::Welcome>),
    /// Into a behaviour.
    Behaviour(AnswerTo<answer::Opened>),
}

impl JoinRequest {
    /// Answers that it cannot be.
    fn refuse(self, no: Refused) {
        match self {
            Self::Server(_, answer) => answer.no(no),
            Self::Behaviour(answer) => answer.no(no),
        }
    }
}

/// What only who is welcomed hears of themselves.
pub(crate) struct Entering {
    /// What proves on a later link that it is them.
    pub(crate) secret: Id,
    /// What they may do.
    pub(crate) role: Role,
    /// The newest Stop when they came.
    pub(crate) stops: u64,
}

/// Who moves a behaviour to the bin.
#[derive(Clone, Debug)]
pub(crate) struct BinRequest {
    /// Their client, whose own locks do not matter.
    pub(crate) client: Id,
    /// What they are called.
    pub(crate) name: String,
}

/// Where somebody points, what they selected and what they see.
pub(crate) struct Whereabouts {
    pub(crate) pointer: Option<Pointer>,
    pub(crate) selected: Option<Id>,
    pub(crate) view: Option<CanvasArea>,
}

/// How a link leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LeaveReason {
    /// Somebody went elsewhere: nothing is kept for them.
    Chosen,
    /// The link ended: who it was may come back.
    LinkEnded,
}

/// What a link wants with the locks of a behaviour.
pub(crate) enum LockRequest {
    /// To lock these records.
    Take(BTreeSet<RecordId>, AnswerTo<answer::Locked>),
    /// To give a lock back.
    Release(LockToken, AnswerTo<()>),
    /// Somebody types under a lock.
    Touch(LockToken),
    /// To have what somebody else is editing.
    Ask(RecordId, AnswerTo<answer::Asked>),
    /// To take what somebody else is editing from them; who asks may.
    TakeOver(RecordId, AnswerTo<answer::Locked>),
    /// To have it no more.
    Withdraw(RecordId, AnswerTo<()>),
    /// To say yes or not yet to who asks.
    Reply(LockToken, bool, AnswerTo<()>),
}

impl LockRequest {
    /// Answers who waits that it cannot be.
    pub(crate) fn refuse(self, no: Refused) {
        match self {
            Self::Take(_, answer) | Self::TakeOver(_, answer) => answer.no(no),
            Self::Release(_, answer) | Self::Withdraw(_, answer) | Self::Reply(.., answer) => answer.no(no),
            Self::Ask(_, answer) => answer.no(no),
            Self::Touch(_) => {}
        }
    }
}

/// A behaviour as it is saved.
#[derive(Clone, Debug)]
pub(crate) struct SavedLook(Arc<Room>);

impl SavedLook {
    /// Its records.
    pub(crate) fn behaviour(&self) -> &Behaviour {
        self.0.behaviour()
    }

    /// Its revision.
    pub(crate) fn revision(&self) -> u64 {
        self.0.revision()
    }

    /// Whether the rules would let in a change.
    ///
    /// # Errors
    /// The broken rule.
    pub(crate) fn judge(&self, change: Change, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
        match self.0.propose(0, change, knowledge) {
            Decision::Save(_) | Decision::Duplicate(_) => Ok(()),
            Decision::Refuse(refusal) => Err(refusal),
        }
    }
}

impl RoomCommand {
    /// Answers who waits that it cannot be.
    fn refuse(self, no: Refused) {
        match self {
            Self::Join(_, joining) => joining.refuse(no),
            Self::Propose(.., answer) => answer.no(no),
            Self::Past(past) => past.refuse(no),
            Self::Remove(_, answer) => answer.no(no),
            Self::Since(_, answer) => answer.no(no),
            Self::Locking(_, locking) => locking.refuse(no),
            Self::MayChange(_, waiting) => drop(waiting.send(Err(no))),
            Self::Look(waiting) => drop(waiting.send(Err(no))),
            Self::Leave(..) | Self::Present(..) | Self::PresentMoment(..) | Self::Rename(..) => {}
        }
    }
}

/// What rooms work with.
pub(crate) struct Surroundings {
    /// Where behaviours are kept.
    pub(crate) store: Arc<dyn Store>,
    /// Whether the store can be reached.
    pub(crate) health: StoreHealth,
    /// Devices and procedures.
    pub(crate) knowing: Arc<Knowing>,
    /// Work on what people send.
    pub(crate) workers: Workers,
    /// Turns for what has to be looked up in the store.
    pub(crate) lookups: Lookups,
    /// Turns for finding out how a behaviour was.
    pub(crate) replays: Lookups,
    /// What is shown to those who open behaviours.
    pub(crate) shown: AllShown,
    /// What is shown to those who look at behaviours as they were.
    pub(crate) past_shown: AllShown,
    /// Where rooms run, and how they learn that the server ends.
    pub(crate) tasks: Tasks,
    /// The id of the helper library.
    pub(crate) library: Id,
    /// The helper library as it is saved; its room keeps it new.
    pub(crate) snapshot: watch::Sender<Arc<LibrarySnapshot>>,
    /// Tells when the list of behaviours changed.
    pub(crate) news: ListNews,
    /// Grows with every start of the server.
    pub(crate) epoch: u64,
    /// The templates, for who comes in.
    pub(crate) templates: Vec<Summary>,
    /// The exercises, for who comes in.
    pub(crate) exercises: Vec<Exercise>,
    /// Whether a behaviour runs on a robot, or is about to.
    pub(crate) is_running: Box<dyn Fn(&Id) -> bool + Send + Sync>,
}

/// The open rooms. A clone is the same rooms.
#[derive(Clone)]
pub(crate) struct Rooms {
    open: Arc<Mutex<HashMap<Id, mpsc::Sender<RoomCommand>>>>,
    around: Arc<Surroundings>,
}

impl Rooms {
    /// No room is open yet.
    pub(crate) fn within(around: Surroundings) -> Self {
        Self { open: Arc::default(), around: Arc::new(around) }
    }

    /// The id of the helper library.
    pub(crate) fn library(&self) -> &Id {
        &self.around.library
    }

    /// The helper library as it is saved now.
    pub(crate) fn snapshot(&self) -> Arc<LibrarySnapshot> {
        self.around.snapshot.borrow().clone()
    }

    /// Tells when the list of behaviours changed.
    pub(crate) fn news(&self) -> &ListNews {
        &self.around.news
    }

    /// Tells a room something and opens it if need be. Never waits.
    pub(crate) fn tell(&self, behaviour: &Id, note: RoomCommand) {
        let mut open = lock(&self.open);
        if !open.contains_key(behaviour) {
            if open.len() >= ROOMS_MAX || self.around.tasks.ends() {
                return note.refuse(Refused::TooFast);
            }
            let (mailbox, inbox) = mpsc::channel(MAILBOX_MAX_NOTES);
            open.insert(behaviour.clone(), mailbox);
            self.around.tasks.spawn(task::run(self.clone(), behaviour.clone(), inbox));
        }
        let Some(mailbox) = open.get(behaviour) else { return };
        let sent = mailbox.try_send(note);
        drop(open);
        if let Err(error) = sent {
            error.into_inner().refuse(Refused::TooFast);
        }
    }

    /// Tells a room something if it is open.
    pub(crate) fn tell_open(&self, behaviour: &Id, note: RoomCommand) {
        if let Some(mailbox) = lock(&self.open).get(behaviour) {
            let _ = mailbox.try_send(note);
        }
    }

    /// Lets a room go, unless somebody wrote to it just now.
    fn let_go(&self, behaviour: &Id, inbox: &mpsc::Receiver<RoomCommand>) -> bool {
        let mut open = lock(&self.open);
        let gone = inbox.is_empty();
        if gone {
            open.remove(behaviour);
        }
        gone
    }

    /// A behaviour as it is saved now.
    pub(crate) async fn look(&self, behaviour: &Id) -> Result<SavedLook, Refused> {
        let (waiting, answer) = oneshot::channel();
        self.tell(behaviour, RoomCommand::Look(waiting));
        answer.await.unwrap_or(Err(Refused::NoBehaviour))
    }

    /// A behaviour as it was after a revision, looked up for somebody.
    pub(crate) async fn look_at(&self, behaviour: &Id, revision: u64, sender: Sender) -> Result<Behaviour, Refused> {
        let (waiting, answer) = oneshot::channel();
        self.tell(behaviour, RoomCommand::Past(PastRequest::LookAt(revision, sender, waiting)));
        answer.await.unwrap_or(Err(Refused::NoBehaviour))
    }

    /// Proposes a change to the library in the server's own name.
    pub(crate) async fn propose_to_library(&self, change: Change) -> Result<(), Refused> {
        self.propose(self.library(), change).await
    }

    /// Proposes a change in the server's own name.
    pub(crate) async fn propose(&self, behaviour: &Id, change: Change) -> Result<(), Refused> {
        let (waiting, answer) = oneshot::channel();
        self.tell(behaviour, RoomCommand::Propose(change, Vec::new(), AnswerTo::Server(waiting)));
        match answer.await {
            Ok(outcome) => outcome.map(drop),
            Err(_) if behaviour == self.library() => Err(Refused::Store(format!("the {LIBRARY} is closed").into())),
            Err(_) => Err(Refused::NoBehaviour),
        }
    }
}
