//! Why a command did not do what it should, in an English sentence for standard error. A command says its own reasons where
//! they arise; here stand those that several commands have.

use phrase::{Phrase, Phrased};
use std::fmt;
use std::io;
use std::path::Path;
use store::StoreError;
use store::backup::BackupError;
use store::files::FileFault;

/// Names that are shown to somebody who looks for another one.
const NAMES_MAX: usize = 10;

/// A reason for which a command did not do what it should.
#[derive(Clone, Debug)]
pub(crate) struct Failure(Phrase);

impl Failure {
    /// A failure that says this sentence.
    pub(crate) fn of(sentence: impl fmt::Display) -> Self {
        Self(Phrase::Text(sentence.to_string()))
    }

    /// This file could not be opened.
    pub(crate) fn unopened(path: &Path, error: &io::Error) -> Self {
        Self::of(format!("{} could not be opened: {error}.", path.display()))
    }

    /// This file could not be written.
    pub(crate) fn unwritten(path: &Path, error: &io::Error) -> Self {
        Self::of(format!("{} could not be written: {error}.", path.display()))
    }

    /// The output could not be written.
    pub(crate) fn unwritten_out(error: impl fmt::Display) -> Self {
        Self::of(format!("The file could not be written: {error}."))
    }

    /// This file has more bytes than are read.
    pub(crate) fn too_long(path: &Path, most_bytes: u64) -> Self {
        Self::of(format!("{}: it is larger than {most_bytes} bytes", path.display()))
    }

    /// These faults are in this file; a line each.
    pub(crate) fn faults(path: &Path, all: &[FileFault]) -> Self {
        let line =
            |FileFault { line, column, reason }: &FileFault| format!("{}:{line}:{column}: {reason}", path.display());
        Self::of(all.iter().map(line).collect::<Vec<_>>().join("\n"))
    }

    /// These records of a file are not as they should be.
    pub(crate) fn records(flaws: &[impl Phrased]) -> Vec<Self> {
        flaws.iter().map(|flaw| Self(flaw.phrase())).collect()
    }
}

/// A few of the names that there are, to choose from.
pub(crate) fn few(names: &[String]) -> String {
    let shown: Vec<_> = names.iter().take(NAMES_MAX).map(|name| format!("“{name}”")).collect();
    let more = if names.len() > NAMES_MAX { ", …" } else { "" };
    format!("There are {}{more}.", shown.join(", "))
}

impl Phrased for Failure {
    fn phrase(&self) -> Phrase {
        self.0.clone()
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(to)
    }
}

impl From<Phrase> for Failure {
    fn from(sentence: Phrase) -> Self {
        Self(sentence)
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        Self::of(error)
    }
}

impl From<BackupError> for Failure {
    fn from(error: BackupError) -> Self {
        Self::of(error)
    }
}
