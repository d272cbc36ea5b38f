//! Why a command did not do what it should. What is said about it stands in `words.rs`; only `main` prints it.

use crate::no_answer::WhyFailure;
use behaviour::Refusal;
use phrase::{Phrase, Phrased, phrase};
use server::{BackupMisfit, ServeError};
use std::error::Error;
use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use store::StoreError;
use store::backup::{BackupError, StoreDifference};
use store::files::{FileFault, ImportError, NoXml};

/// Why a command did not do what it should.
#[derive(Debug)]
pub(crate) enum Failure {
    /// There are no threads to work with.
    NotStarted(io::Error),
    /// There are no threads to serve with.
    ServerNotStarted(io::Error),
    /// The addresses to listen on do not go together.
    Listening(ListenConflict),
    /// The server did not start, or ended.
    Serve(ServeError),
    /// Nobody said where the data is, and there is no home folder.
    NoHome,
    /// This variable says no whole path to the data.
    RelativeFolder(&'static str, PathBuf),
    /// The folder of what programs remember is said by `XDG_STATE_HOME`, in a way that means another one from every place.
    RelativeState(PathBuf),
    /// The store could not do it.
    Store(StoreError),
    /// A running server uses the store in this folder.
    Busy(PathBuf),
    /// A backup, a restore or a migration did not come to its end.
    Backup(BackupError),
    /// The robots of the backup cannot go where they should.
    Robots(BackupMisfit),
    /// There is no folder for the robots of the backup.
    NoRobotsFolder,
    /// The data folder cannot be written.
    DataFolder(io::Error),
    /// In these the copied store differs from the first one.
    Differences(Vec<StoreDifference>),
    /// This file could not be opened.
    Unopened(PathBuf, io::Error),
    /// This file could not be written.
    Unwritten(PathBuf, io::Error),
    /// These words of a sentence are in doubt; none where something is missing.
    InDoubt { words: String, suggestions: Vec<String>, why: Option<String> },
    /// What should go to standard output did not.
    UnwrittenOut(io::Error),
    /// What was done could not be told.
    Untold(io::Error),
    /// No behaviour has this id or name.
    Unknown {
        /// What was asked for.
        wanted: String,
        /// The names that there are.
        names: Vec<String>,
    },
    /// Several behaviours have this name.
    Several {
        /// What was asked for.
        wanted: String,
        /// The ids of all of them.
        ids: Vec<String>,
    },
    /// The behaviour went while it was looked for.
    Gone,
    /// It cannot be written as XML.
    NoXml(NoXml),
    /// An id of our own is none; with the reason.
    Id(String),
    /// No server runs on this data folder.
    NoServer(PathBuf),
    /// The running server does not answer.
    Silent(SocketAddr, BoxError),
    /// The running server ended its answer too early.
    CutOff(BoxError),
    /// The running server's list cannot be read.
    StrangeList(serde_json::Error),
    /// The running server's answer cannot be read.
    StrangeAnswer(serde_json::Error),
    /// The running server refused; with what it says.
    ServerSays(String),
    /// The running server refused this file; with what it says.
    ServerSaysOf(PathBuf, String),
    /// This file is larger than any that is imported.
    TooLarge(PathBuf),
    /// What is wrong with this file.
    Faults(PathBuf, Vec<FileFault>),
    /// The behaviour of this name is in the store already.
    Present(String),
    /// A record of the file is not as it should be; said with its id first.
    Record(Phrase),
    /// The file cannot be imported.
    Unfit(ImportError),
    /// The rules refuse it.
    Refused(Refusal),
    /// Somebody else changed the store meanwhile.
    Overtaken,
    /// This file has more bytes than are read.
    Large(PathBuf, u64),
    /// This file should have readings, and is something else; with what it is.
    NoTrace(PathBuf, String),
    /// The engine cannot run it.
    Engine(engine::GraphFault),
    /// The engine cannot run what a file holds, whose lines are not those of a procedure.
    EngineOfFile(engine::GraphFault),
    /// It ended by itself; with the engine's reason.
    Ended(String),
    /// The behaviour of this name ended by itself; with the engine's reason.
    EndedOf(String, String),
    /// A recording does not give its own actions again.
    Differs(recording::Different),
    /// There are neither as many traces as behaviours nor one.
    Traces {
        /// How many traces there are.
        traces: usize,
        /// How many behaviours there are.
        behaviours: usize,
    },
    /// Nothing can be told about why something came or did not.
    NoAnswer(WhyFailure),
    /// The trace has nothing to play.
    NoReadings,
    /// This line of a trace makes no sense.
    TraceLine(usize, TraceLineError),
    /// This line of a recording makes no sense.
    RecordingLine(usize, TraceLineError),
}

/// Why a line of a trace makes no sense.
#[derive(Debug)]
pub(crate) enum TraceLineError {
    /// It is no JSON object.
    NoReading,
    /// It has no time.
    NoTime,
    /// Its time stands under this name.
    OtherTime(String),
    /// Its time is no number.
    Time,
    /// Its time has a fraction, as seconds have one.
    Seconds {
        /// What stands there.
        t: f64,
        /// The same in milliseconds, if it is in seconds.
        ms: f64,
    },
    /// Its time is one since 1970.
    Epoch(String),
    /// Its time is before the start.
    Negative,
    /// It names no stream.
    Stream,
    /// It has no value.
    Value,
    /// Its time is before that of the line before it.
    Backwards {
        /// The time before, in milliseconds.
        from: u64,
        /// Its own time, in milliseconds.
        to: u64,
    },
    /// The behaviour has no such stream.
    Unknown(String),
    /// The stream is none of a sensor.
    NoSensor(String),
}

/// What a library complains about.
pub(crate) type BoxError = Box<dyn Error + Send + Sync>;

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

impl From<BackupError> for Failure {
    fn from(error: BackupError) -> Self {
        Self::Backup(error)
    }
}

impl From<serde_json::Error> for TraceLineError {
    fn from(_: serde_json::Error) -> Self {
        Self::NoReading
    }
}

/// Why the addresses do not go together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ListenConflict {
    /// There are two for this computer, or two for others.
    TwoOfAKind,
    /// There is a certificate and nobody to show it to.
    NoNetwork,
    /// This is no origin.
    Origin(String),
    /// This is no address to listen on.
    Address(String),
}

impl std::error::Error for ListenConflict {}

impl Phrased for Failure {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Engine(fault) => fault.phrase(),
            Self::EngineOfFile(fault) => of_file(fault),
            Self::Unfit(error) => error.phrase(),
            Self::Record(fault) => fault.clone(),
            other => Phrase::Text(other.to_string()),
        }
    }
}

/// A line within a procedure is not one of the file.
pub(crate) fn of_file(fault: &engine::GraphFault) -> Phrase {
    let reason = fault.reason.phrase();
    match reason.key() {
        Some("TextPlace.Both" | "TextPlace.Line") => {
            phrase!(
                "fault_at",
                "{id}: {reason}",
                id = fault.id,
                reason = phrase!("fault_inside", "in its procedure, {reason}")
            )
        }
        _ => fault.phrase(),
    }
}
