//! The events that the server tells unasked.

use crate::{Invitation, Person, Press, RecordingMark, RobotState, RunState, Values};
use behaviour::{Accepted, Checkpoint, Grant, Id, LockEvent, Problem, RecordId};
use phrase::Phrase;
use robot::Scene;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

macro_rules! events {
    ($(
        $(#[doc = $doc:literal])*
        $name:ident $({$(
            $(#[$of_field:meta])*
            $field:ident: $type:ty,
        )*})?,
    )*) => {
        /// Something that happened, told unasked. It is named from outside, as [`crate::AnyAnswer`] is.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "camelCase")]
        pub enum Event {$(
            $(#[doc = $doc])*
            $name $({$(
                $(#[$of_field])*
                $field: $type,
            )*})?,
        )*}

        impl Event {
            /// The names of the events and what they say.
            pub const TABLE: &[(&str, &str)] = &[$((stringify!($name), concat!($($doc),*))),*];
        }
    };
}

events! {
    /// The list of behaviours or the bin changed; who shows some of it asks again.
    ProgramsChanged,
    /// A change was made and is saved. Told to everyone there, in revision order without gaps.
    Accepted {
        /// Of which behaviour, or [`crate::LIBRARY`].
        behaviour: Id,
        /// The change and its revision.
        accepted: Accepted,
    },
    /// The versions of a behaviour that have a name; told to who opens it and whenever they change, newest wins.
    Versions {
        /// Of which behaviour.
        behaviour: Id,
        /// All of them, in order of their revisions.
        versions: Vec<Checkpoint>,
    },
    /// The problems of a behaviour after a change to it or to the library.
    Problems {
        /// Of which behaviour.
        behaviour: Id,
        /// At which revision.
        revision: u64,
        /// All of them.
        problems: Vec<Problem>,
        /// The [`RunState::fingerprint`] that a run would have if it were started now.
        fingerprint: u32,
    },
    /// A behaviour went to the bin or is gone; who has it open has to choose another.
    Removed {
        /// Which.
        behaviour: Id,
        /// The name of the person who removed it.
        by: String,
    },
    /// A lock that this client had on an earlier link is its own again.
    LockReturned {
        /// The grant of the lock.
        grant: Grant,
    },
    /// The people in a behaviour, with pointers and selections.
    People {
        /// In which behaviour.
        behaviour: Id,
        /// Everyone.
        people: Vec<Person>,
    },
    /// The locks in a behaviour: who is editing what; told when that changes, newest wins.
    Locks {
        /// In which behaviour.
        behaviour: Id,
        /// All locks, oldest first.
        locks: Vec<LockShown>,
    },
    /// Something happened to a lock that this client holds or wants.
    LockNews {
        /// In which behaviour.
        behaviour: Id,
        /// The time at which this was said, on the clock of the event.
        now_ms: u64,
        /// The event.
        event: Box<LockEvent>,
    },
    /// The state of the store: if behaviours can be saved; told at first and when that changes.
    Store {
        /// Why they cannot be saved now, if so. Everything can go on; a change refused with [`crate::Refused::Store`] may be sent
        /// again once this is none.
        away: Option<Phrase>,
    },
    /// The robots, told at first and whenever one comes, goes or changes its state.
    Robots {
        /// All of them, oldest first; there is always one.
        robots: Vec<RobotState>,
    },
    /// The runs on the robots, told when they change.
    Runs {
        /// All running behaviours and those that ended lately, on all robots.
        runs: Vec<RunState>,
        /// The number of the newest Stop on any robot when this was said. It grows with every Stop, also over starts of the
        /// server; a client sends the newest one back in [`crate::Ask::stops`].
        stops: u64,
    },
    /// The marks of the newest run of the open behaviour on the watched robot that are new or changed. All of them come to who
    /// begins to watch, in several such messages if there are many; of each id the newest counts.
    LiveMarks {
        /// Which run. With another one than before all begins anew.
        run: u64,
        /// The time when this was said, in milliseconds since Start, also of a run that has ended: by it who hears the marks
        /// knows how long ago they were made.
        at_ms: u64,
        /// At most [`crate::LIVE_MARKS_MAX`], in the order of their last change; those that are gone say so.
        marks: Vec<RecordingMark>,
    },
    /// The invitations that are kept; also told to whoever may invite when they change.
    Invitations {
        /// Newest first.
        invitations: Vec<Invitation>,
    },
    /// Somebody had a robot do something by hand, or pretended that it sensed something; told to everyone, who did it too.
    Pressed {
        /// The press, and what became of it.
        press: Box<Press>,
    },
    /// Live values of the open behaviour on the watched robot.
    Values {
        /// The changes since the last such message.
        values: Box<Values>,
    },
    /// The watched robot in its room.
    Scene {
        /// Which robot.
        robot: Id,
        /// The picture.
        scene: Box<Scene>,
    },
    /// Still there, every [`crate::PING_MS`]; a client that knows an older revision asks `Since`.
    Ping {
        /// The open behaviour and its revision.
        behaviour: Option<(Id, u64)>,
        /// The revision of the library.
        library_revision: u64,
    },
}

/// One lock as everybody may see it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LockShown {
    /// The id of who is editing, as in the list of people.
    pub client: Id,
    /// Their name.
    pub name: String,
    /// The records that they are editing.
    pub records: BTreeSet<RecordId>,
    /// True if their link ended, and the lock is kept for them for a moment.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub away: bool,
}
