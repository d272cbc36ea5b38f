//! The things that an editor wants to be done: data for whoever holds the link, the clock, the drawers and the words.

use crate::conflict::Conflict;
use crate::kinds::FocusTarget;
use crate::request::EditorRequest;
use behaviour::{Accepted, Change, Id, Problem, RecordId};
use phrase::Phrase;
use protocol::Refused;

/// One thing to do. The order counts.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Send the server something over a [`crate::Link`]. The answer, or its lack, goes to [`crate::Editor::hear_answer`] with
    /// this note; without one nothing is answered.
    Send(EditorRequest, Option<Purpose>),
    /// Give the keyboard to a part of the graph once it is drawn, unless it is somewhere by then.
    Focus(FocusTarget),
    /// Call [`crate::Editor::wake`] after so many milliseconds.
    After(i32, AlarmPurpose),
    /// Keep what [`crate::queue::Queue::to_keep`] gives over a reload of the page.
    KeepQueue,
    /// Keep [`crate::Editor::conflicts`] over a reload of the page.
    KeepConflicts,
    /// Forget the text that was kept about this.
    ForgetDraft(Id),
    /// Tell the person.
    Say(Announcement),
    /// Tell whoever made this change what became of it.
    Answered(Id, Result<(), Refused>),
    /// The change goes on under another name: whoever made it hears of that one.
    Renamed {
        /// The name until now.
        was: Id,
        /// The name from now on.
        now: Id,
    },
    /// Nobody is told what became of this change: it waits for its author's decision.
    Unanswered(Id),
    /// Tell whoever looked for it under this number who changed a record last, and when, in milliseconds since 1970; none if
    /// that is too long ago.
    LastChange(u32, Option<(Saver, u64)>),
    /// Remember which program is to be open.
    Address(Option<Id>),
    /// Show a refused change in place of the dialog in which it was made.
    Decide(Box<Conflict>),
    /// Hand on what happened.
    Happened(EditorEvent),
    /// Show what else is known of the program that was opened just now.
    Opened {
        /// The problems of the program.
        problems: Vec<Problem>,
        /// Tells whether what runs would run differently if it were started now.
        fingerprint: u32,
    },
    /// Hand on that the next change was made, by whomever.
    Made(Box<Accepted>),
}

/// An event that others beside the editor follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EditorEvent {
    /// Somebody here chose what is to be open.
    Chosen,
    /// The program that was open is not shown any more.
    Left,
    /// A program was chosen and is being opened.
    Opening,
    /// Nothing waits to be saved.
    Saved,
    /// Something could not be saved, or not now.
    NotSaved,
    /// The server is silent: good news of a link that was there are not true any more.
    Silent,
}

/// The purpose of a request: it comes back with the answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// To open a program; `says` is true if a refusal that may pass is told too.
    Open {
        /// The program.
        behaviour: Id,
        /// See above.
        says: bool,
    },
    /// To make the change of this name.
    Change(Id),
    /// To lock what the editor of this number edits.
    Lock(u32),
    /// To let this person edit, in the editor of this number.
    LetMeEdit(u32),
    /// To take the lock of what is edited from whoever has it.
    TakeOver,
    /// Something of which only a refusal is told.
    Deed,
    /// Something of which nothing is told.
    Nothing,
    /// For what was saved after the newest that is known.
    Newer,
    /// For the history before a revision.
    History {
        /// The program.
        behaviour: Id,
        /// The newest page if none.
        before: Option<u64>,
    },
    /// For the log after a revision.
    Log(Box<LogReader>),
}

/// Reading the log, page after page, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct LogReader {
    pub(crate) behaviour: Id,
    pub(crate) found: Vec<Accepted>,
    /// The number of pages that may be read yet.
    pub(crate) pages: u32,
    pub(crate) look: Look,
}

/// Why the log is read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Look {
    /// The change of this name came too late: who was first?
    WasFirst(Id),
    /// Somebody changed meanwhile what is typed into here: who?
    WhileAway(RecordId),
    /// Something was removed and is to be brought back by this change, which is empty still.
    BringBack(RecordId, Box<Change>),
    /// Somebody wants to know who changed this last, told under this number.
    LastChange(RecordId, u32),
    /// Somebody removed this: who?
    Remover(Id),
}

/// Why the editor wants to be woken.
#[derive(Clone, Debug, PartialEq)]
pub enum AlarmPurpose {
    /// After a change that could not be saved.
    Stalled,
    /// After a change that came too fast.
    Rested,
    /// To propose changes once more that a lock kept out which nobody here knows of.
    Free,
    /// To tell others where this person is.
    Presence,
    /// To open a program once more.
    Open(Id),
    /// To read the history of a program before a revision once more.
    History(Id, Option<u64>),
}

/// A sentence for the person; the words are the page's.
#[derive(Clone, Debug, PartialEq)]
pub enum Announcement {
    /// The server refuses.
    Refused(Refused),
    /// The server is not reached.
    Unreachable,
    /// The server speaks again, and so many changes that waited were sent.
    Connected(usize),
    /// A refused change waits until its program is opened.
    WaitsElsewhere,
    /// A change waits until this person edits no more what it touches.
    WaitsUntilFree(String),
    /// The choice has nothing that a group could be made of.
    NothingToGroup,
    /// Nothing of the choice is in a group.
    InNoGroup,
    /// All that was dragged is in the group of this title now.
    MovedInto(String),
    /// The person whose view was looked at has left.
    NoLongerHere(String),
    /// Somebody else saved a change of this first.
    WasFirst(Saver, Phrase),
    /// Somebody changed what is typed into here.
    ChangedWhileTyping(Saver),
    /// Somebody removed what is typed into here.
    RemovedWhileTyping(Saver),
}

/// The person who saved a change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Saver {
    /// This person, in another window.
    Me,
    /// Somebody of this name.
    Other(String),
}
