//! Damage of data, and texts that are no address of a store.

use behaviour::{BadId, Id};
use phrase::{Phrase, Phrased};
use std::fmt::Display;
use std::path::Path;

/// Damage of the data, in the words of the library that found it.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub enum Damage {
    /// A file.
    #[error("{file}: {why}")]
    File {
        /// The path of the file.
        file: String,
        /// The reason.
        why: Phrase,
    },
    /// A line of a file.
    #[error("{file} line {line}: {why}")]
    Line {
        /// The path of the file.
        file: String,
        /// The number of the line, from 1.
        line: u64,
        /// The reason.
        why: Phrase,
    },
    /// A Neo4j.
    #[error("the Neo4j database: {0}")]
    Neo4j(Phrase),
    /// A change in a Neo4j.
    #[error("the Neo4j database: change {revision}: {why}")]
    Neo4jChange {
        /// The revision that the change made.
        revision: u64,
        /// The reason.
        why: Phrase,
    },
    /// A Neo4j has lost what a change does.
    #[error("the Neo4j database: change {0}: it has lost what it does")]
    LostChange(u64),
    /// A Neo4j has lost the number of its starts.
    #[error("the Neo4j database: it has lost the number of its starts")]
    LostStarts,
    /// A connector in a Neo4j has too few parts.
    #[error("the Neo4j database: connector {0} has a part too few")]
    PartMissing(Id),
    /// Changes are missing in the history of a behaviour.
    #[error("the history of {id} has a gap after revision {from}")]
    Gap {
        /// The behaviour.
        id: Id,
        /// The last revision before the gap.
        from: u64,
    },
    /// The history of a behaviour ends too early.
    #[error("the history of {id} ends at {since} instead of {revision}")]
    EndsEarly {
        /// The behaviour.
        id: Id,
        /// The last revision that is there.
        since: u64,
        /// The revision that the behaviour has.
        revision: u64,
    },
    /// A text that should be an id is none.
    #[error("{0}")]
    Id(BadId),
}

impl Damage {
    /// The damage of a file.
    pub(crate) fn file(file: &Path, why: &impl Display) -> Self {
        Self::File { file: file.display().to_string(), why: why.to_string().into() }
    }

    /// The damage of a line of a file.
    pub(crate) fn line(file: &Path, line: u64, why: &impl Display) -> Self {
        Self::Line { file: file.display().to_string(), line, why: why.to_string().into() }
    }
}

/// A reason for which a text is no address of a store.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub enum BadAddress {
    /// It begins like no store.
    #[error("begin it with sqlite: or files: and a folder, or with bolt:// for a Neo4j")]
    Kind,
    /// It has not the form of a Neo4j's address.
    #[error("write it as bolt://USER@HOST:PORT, with the password in RRP_NEO4J_PASSWORD")]
    Neo4j,
    /// There is no password.
    #[error("it has no password; put it into {variable}, or its file's name into {of_file}")]
    NoPassword {
        /// The variable that has the password.
        variable: &'static str,
        /// The variable that has the name of a file with the password.
        of_file: &'static str,
    },
    /// The file with the password cannot be read.
    #[error("the password file {file} that {of_file} names cannot be read: {why}")]
    PasswordUnread {
        /// The path of the file.
        file: String,
        /// The variable that names it.
        of_file: &'static str,
        /// The words of the system.
        why: String,
    },
}
