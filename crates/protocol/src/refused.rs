//! Why something was not done.

use crate::{NotSeen, Role};
use behaviour::{Problem, Refusal};
use serde::{Deserialize, Serialize};

/// Why something was not done. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Refused {
    /// The client speaks another version; with the server's.
    Version(u32),
    /// The greeting must come first.
    Greeting,
    /// The message could not be read; with the reason.
    Unreadable(String),
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
    CannotStart(String),
    /// The edited behaviour was not applied, and what runs goes on; with the reason.
    NotApplied(String),
    /// The order on the robot could not be kept; with the reason.
    NotKept(String),
    /// There is no such robot.
    NoRobot,
    /// The robot was not added; with the reason.
    RobotNotAdded(String),
    /// The robot was not removed; with the reason.
    RobotStays(String),
    /// The robot cannot do that now; with the reason.
    RobotCannot(String),
    /// Robots cannot be looked for in the network; with the reason.
    NotSearched(String),
    /// There is no such recording.
    NoRecording,
    /// Something about a recording did not work; with the reason.
    CannotRecord(String),
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
    Store(String),
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
    InvitationsNotKept(String),
}

impl From<NotSeen> for Refused {
    fn from(why: NotSeen) -> Self {
        Self::NotSeen(why)
    }
}

impl std::fmt::Display for Refused {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Version(theirs) => {
                write!(to, "This page is older or newer than the server (version {theirs}). Reload it.")
            }
            Self::Greeting => to.write_str("The connection was not greeted first. Reload the page."),
            Self::Unreadable(reason) => write!(to, "This message could not be read ({reason})."),
            Self::TooFast => to.write_str("That was too much at once. Wait a moment and try again."),
            Self::NoBehaviour => to.write_str("There is no such program any more. Choose another one."),
            Self::NoTemplate(name) => write!(to, "There is no template “{name}”. Choose one from the list."),
            Self::Change(refusal) => write!(to, "{refusal}"),
            Self::NoVersion => to.write_str("There is no such version of this program. Look at its history again."),
            Self::FarBack => to.write_str(
                "Too much changed since then to go back in one step. Go back to a version in between first.",
            ),
            Self::NothingGone => to.write_str("Nothing that was removed there is missing now."),
            Self::NoLock => to.write_str("This cannot be kept for one person. Edit it as it is."),
            Self::NothingThere => {
                to.write_str("This is not there any more, or not yet. Look again, and choose what is there.")
            }
            Self::TooManyLocks => to.write_str("Too much is being edited at once. Close an editor first."),
            Self::Problems(problems) => {
                let first = problems.first().map(ToString::to_string).unwrap_or_default();
                write!(to, "It cannot start yet. {first}")
            }
            Self::CannotStart(reason) => write!(to, "It cannot start: {reason}."),
            Self::NotApplied(reason) => {
                write!(to, "The robot goes on with what it ran before, as the change cannot be applied: {reason}.")
            }
            Self::NotKept(reason) => write!(to, "The order stays as it was, as it could not be kept ({reason})."),
            Self::NoRobot => to.write_str("There is no such robot any more. Choose another one."),
            Self::RobotNotAdded(reason) => write!(to, "The robot was not added: {reason}."),
            Self::RobotCannot(reason) => write!(to, "That was not done: {reason}."),
            Self::NotSearched(reason) => {
                write!(to, "Robots cannot be looked for in this network: {reason}. Type the address of the robot.")
            }
            Self::RobotStays(reason) => write!(to, "The robot stays: {reason}."),
            Self::NoRecording => to.write_str("There is no such recording any more. Look at the list again."),
            Self::CannotRecord(reason) => write!(to, "The recording did not do this: {reason}."),
            Self::NotSeen(why) => write!(to, "{why}"),
            Self::NotRunning => to.write_str("This program does not run. Press Start first."),
            Self::StoppedSince => {
                to.write_str("The robot was stopped before this came. Press again if you still want it.")
            }
            Self::Running => to.write_str("This program runs on the robot. Press Stop first."),
            Self::NoSensor => to.write_str("There is no such sensor stream in this program."),
            Self::Store(reason) => {
                write!(to, "The programs cannot be reached just now ({reason}). Try again in a moment.")
            }
            Self::NothingOpen => to.write_str("No program is open. Load one first."),
            Self::Role(Role::Host) => write!(to, "Only {} may do this. Ask them.", Role::Host),
            Self::Role(role) => write!(to, "Only {role} may do this. Ask {} for another invitation.", Role::Host),
            Self::NotInvited => write!(to, "Your invitation ended. Ask {} for another one.", Role::Host),
            Self::NobodyComes => to.write_str(
                "Nobody else can reach this server. Start it with --listen and this computer’s address in the network.",
            ),
            Self::NoInvitation => to.write_str("There is no such invitation any more. Look at the list again."),
            Self::TooManyInvitations => to.write_str("There are too many invitations. Revoke one first."),
            Self::InvitationsNotKept(reason) => {
                write!(
                    to,
                    "The invitations could not be kept ({reason}). What was revoked is out for now; free some space and \
                     do this again."
                )
            }
        }
    }
}
