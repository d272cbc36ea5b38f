//! What people want of the past of a behaviour: to read it, to take things back, to give versions names.

use super::member::AnswerTo;
use crate::support::identity::Sender;
use crate::support::lookups::LookupTurn;
use behaviour::{Behaviour, Id, LockToken};
use phrase::Phrase;
use protocol::{Person, Refused, answer};
use tokio::sync::oneshot;

/// A question about the past of a behaviour, and where its answer goes.
pub(crate) enum PastRequest {
    /// A page of its history, before a revision if one is said.
    History(Option<u64>, AnswerTo<answer::History>),
    /// The behaviour as it was after a revision.
    At(u64, AnswerTo<answer::At>),
    /// Looks it up for this server itself, on somebody's behalf.
    LookAt(u64, Sender, oneshot::Sender<Result<Behaviour, Refused>>),
    /// A change that comes of the past.
    Wish(RevertRequest, AnswerTo<answer::Saved>),
    /// A name for a version, or none any more.
    Name(VersionNaming, AnswerTo<()>),
}

impl PastRequest {
    /// Answers that it cannot be.
    pub(super) fn refuse(self, no: Refused) {
        match self {
            Self::History(_, answer) => answer.no(no),
            Self::At(_, answer) => answer.no(no),
            Self::LookAt(_, _, answer) => drop(answer.send(Err(no))),
            Self::Wish(_, answer) => answer.no(no),
            Self::Name(_, answer) => answer.no(no),
        }
    }
}

/// A change that the server makes for somebody out of what was.
pub(crate) struct RevertRequest {
    /// The name of the change.
    pub(crate) op: Id,
    /// Who wants it.
    pub(crate) who: Person,
    /// Of the locks that they hold.
    pub(crate) tokens: Vec<LockToken>,
    /// What shall come of it.
    pub(crate) what: WantedChange,
}

/// What shall come of a wish.
pub(crate) enum WantedChange {
    /// Their last change is taken back.
    Undo,
    /// What they took back last is done again.
    Redo,
    /// The behaviour is again what it was after this revision, which they call so.
    GoBack(u64, String),
    /// The behaviour is again what it was.
    Again(Box<Was>),
    /// What the change of this revision removed is there again.
    BringBack(u64),
}

/// A behaviour as it was.
pub(crate) struct Was {
    /// Its records then.
    pub(crate) behaviour: Behaviour,
    /// What going back there is called.
    pub(crate) label: Phrase,
    /// The turn in which it was found: few are kept at once.
    pub(crate) _turn: Option<LookupTurn>,
}

/// What becomes of a name.
pub(crate) enum VersionNaming {
    /// A revision gets it.
    Name {
        /// Which revision.
        revision: u64,
        /// Its name.
        name: String,
        /// The name of who says so.
        by: String,
    },
    /// It goes.
    Unname(String),
}
