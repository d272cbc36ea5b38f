//! Why the robots and what runs on them stay as they are, and why a run ended by itself.

use super::stops::StoppedSince;
use crate::recordings::NotRecorded;
use engine::GraphFault;
use phrase::{Phrase, Phrased};
use protocol::Refused;
use robot::RobotFault;
use std::io;
use std::path::PathBuf;

/// Why a behaviour did not begin on a robot, or why an edited one was not applied.
#[derive(Debug)]
pub(crate) enum StartError {
    /// As many run as may run.
    TooMany,
    /// There is no thread for it.
    NoThread(io::Error),
    /// Its thread ended before it answered.
    Unprepared,
    /// Preparing it took longer than it may.
    Late,
    /// The engine cannot run it.
    Faults(Vec<GraphFault>),
    /// The robot does not answer in time.
    Silent,
    /// The robot cannot open a device, of the stream that people call so; with the robot's reason.
    Unopened {
        /// The name of the stream.
        stream: String,
        /// What the robot says.
        reason: Phrase,
    },
    /// The robot is the same body as another one, of this name.
    Twin(String),
    /// Its place in the order on the robot could not be kept.
    Unordered(io::Error),
    /// It cannot be recorded, and should be.
    NotRecorded(NotRecorded),
    /// Stop was pressed before anything was prepared.
    StopPressed(Option<String>),
    /// Stop was pressed while it was prepared.
    StoppedBefore,
    /// The robot was stopped between the press and its coming here.
    StoppedSince,
    /// What it should follow was stopped.
    StoppedMeanwhile,
    /// What it should follow does not run.
    Ended,
    /// Another edited behaviour is about to follow.
    AppliedJustNow,
    /// Nobody knows yet whether it was applied.
    StillApplying,
    /// The server itself failed.
    Inside,
}

impl From<StoppedSince> for StartError {
    fn from(StoppedSince: StoppedSince) -> Self {
        Self::StoppedSince
    }
}

impl From<StoppedSince> for Refused {
    fn from(StoppedSince: StoppedSince) -> Self {
        Self::StoppedSince
    }
}

impl From<NotRecorded> for StartError {
    fn from(why: NotRecorded) -> Self {
        Self::NotRecorded(why)
    }
}

impl StartError {
    /// This as why a behaviour cannot start.
    pub(crate) fn cannot_start(self) -> Refused {
        match self {
            Self::StoppedSince => Refused::StoppedSince,
            why => Refused::CannotStart(why.phrase()),
        }
    }

    /// This as why what runs does not go on with an edited behaviour. Where a Stop came first, nothing goes on.
    pub(crate) fn not_applied(self) -> Refused {
        match self {
            Self::Ended | Self::StoppedMeanwhile => Refused::NotRunning,
            Self::StoppedSince => Refused::StoppedSince,
            why => Refused::NotApplied(why.phrase()),
        }
    }
}

/// The reason why something was not done by hand.
#[derive(Debug, PartialEq)]
pub(crate) enum NotByHand {
    /// Stop was pressed before.
    StopPressed,
    /// The robot is the same body as another one, of this name.
    Twin(String),
    /// The value and settings have too many bytes.
    Large,
    /// The robot does not answer in time.
    Silent,
    /// The robot does not do it, for its own reason.
    Robot(RobotFault),
}

impl<F: Into<RobotFault>> From<F> for NotByHand {
    fn from(fault: F) -> Self {
        Self::Robot(fault.into())
    }
}

impl NotByHand {
    /// Returns this as the refusal that a client hears.
    pub(crate) fn refused(self) -> Refused {
        Refused::RobotCannot(self.phrase())
    }
}

/// Why a run ended by itself.
#[derive(Debug)]
pub(crate) enum RunFailure {
    /// The engine ended it; with the engine's reason.
    Engine(Phrase),
    /// A procedure takes too long again and again: the one that makes the stream that people call so.
    TooLong(String),
    /// It was ready when nobody waited for it any more.
    Late,
    /// The run that should follow it is gone.
    NotFollowed,
    /// The robot failed.
    Robot,
    /// The robot wants everything to end; with its reason.
    Halt(Phrase),
    /// The server itself failed.
    Inside,
}

/// Why a robot was not added or not removed.
#[derive(Debug)]
pub(crate) enum RobotsUnchanged {
    /// It has no name that people can read.
    Nameless,
    /// Its name is too long.
    LongName,
    /// No robot can have this address.
    Address,
    /// Its user name or password is too long.
    LongLogin,
    /// There are as many as may be.
    TooMany,
    /// The places that are left are for the host.
    KeptForHost,
    /// The new one could not be written down, or has no thread.
    NewUnkept(io::Error),
    /// There is no other one.
    OnlyOne,
    /// Something runs on it.
    InUse,
    /// It is here already, under this name.
    Twin(String),
    /// It is a simulated one.
    Simulated,
    /// Another robot than the one that was shown answers at its address by now.
    AnotherOne,
    /// That one is gone could not be written down.
    Unkept(io::Error),
}

impl RobotsUnchanged {
    /// This as why a robot was not added.
    pub(crate) fn not_added(self) -> Refused {
        Refused::RobotNotAdded(self.phrase())
    }

    /// This as why a robot stays.
    pub(crate) fn stays(self) -> Refused {
        Refused::RobotStays(self.phrase())
    }
}

/// Why the robots of a backup cannot be put into a data folder. [`std::fmt::Display`] says it and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BackupMisfit {
    /// No server keeps robots like these.
    Malformed,
    /// This folder has other robots.
    Others(PathBuf),
}

impl std::error::Error for BackupMisfit {}
