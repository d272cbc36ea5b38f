//! Why something was not done.

use crate::{NotSeen, Role};
use behaviour::{Problem, Refusal};
use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};

/// The reason why something was not done. [`Phrased`] says it in one sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Refused {
    /// The client speaks another version; with the server's.
    Version(u32),
    /// The greeting must come first.
    Greeting,
    /// The message could not be read; with the reason.
    Unreadable(Phrase),
    /// Too many messages; this one was dropped.
    TooFast,
    /// There is no such behaviour.
    NoBehaviour,
    /// There is no such template.
    NoTemplate(String),
    /// The change breaks a rule.
    Change(Refusal),
    /// There is no such version of the behaviour.
    NoVersion,
    /// Going back there would change too much at once.
    FarBack,
    /// All that was removed there is here again, or nothing was removed.
    NothingGone,
    /// Positions are not locked, and neither are helpers.
    NoLock,
    /// Only what is there is locked; this is not.
    NothingThere,
    /// This client is editing as much as it may, or the behaviour is.
    TooManyLocks,
    /// These problems stop Start.
    Problems(Vec<Problem>),
    /// The behaviour cannot start; with the reason.
    CannotStart(Phrase),
    /// The edited behaviour was not applied, and what runs goes on; with the reason.
    NotApplied(Phrase),
    /// The order on the robot could not be kept; with the reason.
    NotKept(Phrase),
    /// There is no such robot.
    NoRobot,
    /// The robot was not added; with the reason.
    RobotNotAdded(Phrase),
    /// The robot was not removed; with the reason.
    RobotStays(Phrase),
    /// The robot cannot do that now; with the reason.
    RobotCannot(Phrase),
    /// Robots cannot be looked for in the network; with the reason.
    NotSearched(Phrase),
    /// There is no such recording.
    NoRecording,
    /// Something about a recording did not work; with the reason.
    CannotRecord(Phrase),
    /// A question about the past of a run is not answered; with the reason.
    NotSeen(NotSeen),
    /// The behaviour does not run.
    NotRunning,
    /// The robot was stopped between the press and its coming here, so it does not move.
    StoppedSince,
    /// The behaviour runs; stop it first.
    Running,
    /// There is no such sensor stream.
    NoSensor,
    /// The store does not answer; with the reason.
    Store(Phrase),
    /// Nothing is open.
    NothingOpen,
    /// Only somebody who may more may do this; at least this.
    Role(Role),
    /// The person who asks was not invited, or not any more.
    NotInvited,
    /// Nobody else can come in, as the server answers this computer only.
    NobodyComes,
    /// There is no such invitation any more, or never was.
    NoInvitation,
    /// There are as many invitations as there may be.
    TooManyInvitations,
    /// The invitations could not be kept; with the reason.
    InvitationsNotKept(Phrase),
}

impl From<NotSeen> for Refused {
    fn from(why: NotSeen) -> Self {
        Self::NotSeen(why)
    }
}

phrase::shown!(Refused);

impl Phrased for Refused {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Version(theirs) => {
                phrase!("Refused.Version", "This page is older or newer than the server (version {theirs}). Reload it.")
            }
            Self::Greeting => phrase!("Refused.Greeting", "The connection was not greeted first. Reload the page."),
            Self::Unreadable(reason) => phrase!("Refused.Unreadable", "This message could not be read ({.reason})."),
            Self::TooFast => phrase!("Refused.TooFast", "That was too much at once. Wait a moment and try again."),
            Self::NoBehaviour => {
                phrase!("Refused.NoBehaviour", "There is no such program any more. Choose another one.")
            }
            Self::NoTemplate(name) => {
                phrase!("Refused.NoTemplate", "There is no template “{name}”. Choose one from the list.")
            }
            Self::Change(refusal) => refusal.phrase(),
            Self::NoVersion => {
                phrase!("Refused.NoVersion", "There is no such version of this program. Look at its history again.")
            }
            Self::FarBack => phrase!(
                "Refused.FarBack",
                "Too much changed since then to go back in one step. Go back to a version in between first."
            ),
            Self::NothingGone => phrase!("Refused.NothingGone", "Nothing that was removed there is missing now."),
            Self::NoLock => phrase!("Refused.NoLock", "This cannot be kept for one person. Edit it as it is."),
            Self::NothingThere => {
                phrase!(
                    "Refused.NothingThere",
                    "This is not there any more, or not yet. Look again, and choose what is there."
                )
            }
            Self::TooManyLocks => {
                phrase!("Refused.TooManyLocks", "Too much is being edited at once. Close an editor first.")
            }
            Self::Problems(problems) => {
                let first = problems.first().map(Phrased::phrase).unwrap_or_default();
                phrase!("Refused.Problems", "It cannot start yet. {first}")
            }
            Self::CannotStart(reason) => phrase!("Refused.CannotStart", "It cannot start: {.reason}."),
            Self::NotApplied(reason) => not_applied(reason),
            Self::NotKept(reason) => {
                phrase!("Refused.NotKept", "The order stays as it was, as it could not be kept ({reason}).")
            }
            Self::NoRobot => phrase!("Refused.NoRobot", "There is no such robot any more. Choose another one."),
            Self::RobotNotAdded(reason) => phrase!("Refused.RobotNotAdded", "The robot was not added: {reason}."),
            Self::RobotCannot(reason) => phrase!("Refused.RobotCannot", "That was not done: {reason}."),
            Self::NotSearched(reason) => not_searched(reason),
            Self::RobotStays(reason) => phrase!("Refused.RobotStays", "The robot stays: {reason}."),
            Self::NoRecording => {
                phrase!("Refused.NoRecording", "There is no such recording any more. Look at the list again.")
            }
            Self::CannotRecord(reason) => phrase!("Refused.CannotRecord", "The recording did not do this: {reason}."),
            Self::NotSeen(why) => why.phrase(),
            Self::NotRunning => phrase!("Refused.NotRunning", "This program does not run. Press Start first."),
            Self::StoppedSince => {
                phrase!(
                    "Refused.StoppedSince",
                    "The robot was stopped before this came. Press again if you still want it."
                )
            }
            Self::Running => phrase!("Refused.Running", "This program runs on the robot. Press Stop first."),
            Self::NoSensor => phrase!("Refused.NoSensor", "There is no such sensor stream in this program."),
            Self::Store(reason) => {
                phrase!("Refused.Store", "The programs cannot be reached just now ({.reason}). Try again in a moment.")
            }
            Self::NothingOpen => phrase!("Refused.NothingOpen", "No program is open. Load one first."),
            Self::Role(role) => only(*role),
            Self::NotInvited => {
                phrase!("Refused.NotInvited", "Your invitation ended. Ask {who} for another one.", who = Role::Host)
            }
            Self::NobodyComes => phrase!(
                "Refused.NobodyComes",
                "Nobody else can reach this server. Start it with --listen and this computer’s address in the network."
            ),
            Self::NoInvitation => {
                phrase!("Refused.NoInvitation", "There is no such invitation any more. Look at the list again.")
            }
            Self::TooManyInvitations => {
                phrase!("Refused.TooManyInvitations", "There are too many invitations. Revoke one first.")
            }
            Self::InvitationsNotKept(reason) => invitations_not_kept(reason),
        }
    }
}

fn only(role: Role) -> Phrase {
    match role {
        Role::Host => phrase!("Refused.Host", "Only {who} may do this. Ask them.", who = Role::Host),
        _ => phrase!("Refused.Role", "Only {role} may do this. Ask {who} for another invitation.", who = Role::Host),
    }
}

fn not_applied(reason: &Phrase) -> Phrase {
    phrase!(
        "Refused.NotApplied",
        "The robot goes on with what it ran before, as the change cannot be applied: {.reason}."
    )
}

fn not_searched(reason: &Phrase) -> Phrase {
    phrase!(
        "Refused.NotSearched",
        "Robots cannot be looked for in this network: {reason}. Type the address of the robot."
    )
}

fn invitations_not_kept(reason: &Phrase) -> Phrase {
    phrase!(
        "Refused.InvitationsNotKept",
        "The invitations could not be kept ({reason}). What was revoked is out for now; free some space and do this again."
    )
}
