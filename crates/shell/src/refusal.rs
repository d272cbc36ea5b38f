//! The reasons why a line that was typed is not obeyed. The sentences about them stand in `words.rs`.

use crate::ClientError;

/// The reasons why a line that was typed is not obeyed.
#[derive(Debug)]
pub(crate) enum NotDone {
    /// The server did not do it.
    Trouble(ClientError),
    /// No command is called like what was typed.
    NoCommand(String),
    /// Several commands begin like what was typed.
    SeveralCommands {
        /// The text that was typed.
        typed: String,
        /// The names of these commands.
        names: Vec<&'static str>,
    },
    /// No one thing is called like what was typed.
    NotFound(NotFound),
    /// There is no connection.
    NotConnected,
    /// No program is loaded.
    NoProgram,
    /// No stream is loaded.
    NoStream,
    /// The robot to add has no name.
    NoRobotName,
    /// The robot to add cannot be reached; with a sentence that says why.
    NotReached(String),
    /// The robot does not answer at its new address; with a sentence that says why.
    NotMoved(String),
    /// A robot should have another address, and it is not said which.
    NoNewAddress,
    /// Nobody else answers in the place of the robot that is called so.
    NoStranger(String),
    /// A robot should have another name, and it is not said which.
    NoNewName,
    /// A face should be forgotten, and it is not said whose robot's.
    NoFaceOf,
    /// It is said neither up nor down.
    NoWay,
    /// The thing of this name cannot be moved further.
    There(String),
    /// It is said neither on nor off.
    NeitherOnNorOff,
    /// The time is no number of seconds up to this one.
    Seconds(u64),
    /// An id is none; with the reason.
    Id(String),
    /// There is no such sense; with what the catalogue says.
    NoSense(String),
    /// A word stands where a value or settings should.
    NoJson(serde_json::Error),
    /// The catalogue's own example is no value.
    NoExample(serde_json::Error),
    /// It is not said which action is meant.
    NoAction,
    /// A word is no time.
    NoTime(String),
    /// It did not run at a time of day.
    NotThen,
    /// The program has not run since the server started.
    NeverRan,
}

/// The reasons why no one thing is meant by a name.
#[derive(Debug)]
pub(crate) enum NotFound {
    /// No name was typed.
    Nameless {
        /// The kind of thing that is looked for.
        what: &'static str,
        /// The names of all there are.
        names: Vec<String>,
    },
    /// Several things fit.
    Several {
        /// The text that was typed.
        wanted: String,
        /// The names of those that fit.
        names: Vec<String>,
    },
    /// Nothing fits.
    Unknown {
        /// The kind of thing that is looked for.
        what: &'static str,
        /// The text that was typed.
        wanted: String,
        /// The names of all there are.
        names: Vec<String>,
    },
}

impl From<ClientError> for NotDone {
    fn from(trouble: ClientError) -> Self {
        Self::Trouble(trouble)
    }
}

impl From<NotFound> for NotDone {
    fn from(why: NotFound) -> Self {
        Self::NotFound(why)
    }
}
