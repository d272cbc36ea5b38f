//! The files: `b-ID.jsonl`, one JSON object a line, each line whole and synced or not there.

use crate::disk::{self, told};
use crate::{Damage, StoreError, json};
use behaviour::{Checkpoint, Committed, Id};
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::str::Utf8Error;
use thiserror::Error;

const PREFIX: &str = "b-";
const SUFFIX: &str = ".jsonl";
/// Stands before a letter that is upper case, since some disks do not tell the cases apart.
const UPPER: char = '+';
const EPOCH: &str = "epoch.json";
/// With less room than that the disk is full, in bytes.
const ROOM_MIN_BYTES: usize = 4_096;

/// One line of a file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) enum LogLine {
    /// A change and its revision.
    Change(Committed),
    /// It went to the bin.
    #[serde(rename_all = "camelCase")]
    Removed {
        /// The time, in milliseconds since 1970.
        at_ms: u64,
        /// The name of the person who said so.
        by: String,
    },
    /// It came back from the bin.
    Restored,
    /// A revision got a name.
    Named(Checkpoint),
    /// A name went.
    Unnamed {
        /// The name of the version.
        name: String,
    },
    /// The number of times that a server started; in a file of its own.
    Epoch(u64),
}

/// The reasons why a line of a file is not one that was written there.
#[derive(Debug, Error)]
pub(super) enum Strange {
    /// It is no text.
    #[error("{0}")]
    Bytes(#[from] Utf8Error),
    /// It is none of our lines.
    #[error("{0}")]
    Form(#[from] serde_json::Error),
    /// The change does not come after the one before it; with its revision.
    #[error("revision {0} does not follow")]
    Order(u64),
    /// The name that it gives or takes cannot be given or taken there.
    #[error("{0:?} cannot be named so")]
    Name(String),
    /// The change cannot be made.
    #[error("{0}")]
    Refused(#[from] StoreError),
}

/// The files of a folder.
pub(super) struct Logs {
    folder: PathBuf,
    /// The reason why nothing more can be written, once a line could not be taken back.
    broken: Option<StoreError>,
    /// The free space in bytes that ends a full disk.
    wants_bytes: usize,
}

impl Logs {
    /// Reads every file, each line through `take`.
    pub(super) fn open(folder: &Path, take: impl Fn(&Id, LogLine) -> Result<(), Strange>) -> Result<Self, StoreError> {
        let logs = Self { folder: folder.to_owned(), broken: None, wants_bytes: ROOM_MIN_BYTES };
        for (id, path) in logs.files()? {
            let length = read(&path, |line| take(&id, line))?;
            cut(&path, length).map_err(|error| told(&path, &error))?;
        }
        let epoch = logs.folder.join(EPOCH);
        if let Ok(text) = std::fs::read_to_string(&epoch) {
            let library = Id::new(crate::LIBRARY).map_err(|reason| damaged(&epoch, 1, &reason))?;
            let line = json::decode(&text).map_err(Strange::from).and_then(|line| take(&library, line));
            line.map_err(|reason| damaged(&epoch, 1, &reason))?;
        }
        Ok(logs)
    }

    /// Returns the folder of the files.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    fn files(&self) -> Result<Vec<(Id, PathBuf)>, StoreError> {
        let unreadable = |error: io::Error| told(&self.folder, &error);
        let mut files = Vec::new();
        for entry in std::fs::read_dir(&self.folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            if let Some(id) = path.file_name().and_then(|name| id_of(name.to_str()?)) {
                files.push((id, path));
            }
        }
        files.sort();
        Ok(files)
    }

    /// Writes a line and syncs it; after an error the file is as it was.
    pub(super) fn add(&mut self, id: &Id, line: &LogLine) -> Result<(), StoreError> {
        if let Some(broken) = &self.broken {
            return Err(broken.clone());
        }
        let path = self.folder.join(name_of(id));
        let mut text = json::encode(line).map_err(json::unwritable)?;
        text.push('\n');
        let was = std::fs::metadata(&path).map_or(0, |about| about.len());
        let written = write(&path, text.as_bytes()).and_then(|()| if was == 0 { self.sync_names() } else { Ok(()) });
        written.map_err(|error| {
            self.wants_bytes = self.wants_bytes.max(ROOM_MIN_BYTES + text.len());
            if let Err(worse) = cut(&path, was) {
                self.broken = Some(told(&path, &worse));
            }
            told(&path, &error)
        })
    }

    /// Deletes a behaviour for ever.
    pub(super) fn delete(&mut self, id: &Id) -> Result<(), StoreError> {
        let path = self.folder.join(name_of(id));
        std::fs::remove_file(&path).and_then(|()| self.sync_names()).map_err(|error| told(&path, &error))
    }

    /// Keeps the number of the server's start.
    pub(super) fn set_epoch(&mut self, epoch: u64) -> Result<(), StoreError> {
        let path = self.folder.join(EPOCH);
        let text = json::encode(&LogLine::Epoch(epoch)).map_err(json::unwritable)?;
        disk::put(&path, text.as_bytes()).map_err(|error| told(&path, &error))
    }

    /// Writes without changing anything, to see whether that works.
    pub(super) fn probe(&mut self) -> Result<(), StoreError> {
        disk::has_room(&self.folder, self.wants_bytes).map_err(|error| told(&self.folder, &error))?;
        self.wants_bytes = ROOM_MIN_BYTES;
        self.broken.clone().map_or(Ok(()), Err)
    }

    /// Makes new and lost names survive a power cut.
    fn sync_names(&self) -> io::Result<()> {
        disk::sync_names(&self.folder)
    }
}

fn name_of(id: &Id) -> String {
    let mut name = PREFIX.to_owned();
    for letter in id.as_str().chars() {
        if letter.is_ascii_uppercase() {
            name.push(UPPER);
        }
        name.push(letter.to_ascii_lowercase());
    }
    name + SUFFIX
}

fn id_of(name: &str) -> Option<Id> {
    let mut id = String::new();
    let mut upper = false;
    for letter in name.strip_prefix(PREFIX)?.strip_suffix(SUFFIX)?.chars() {
        match letter {
            UPPER => upper = true,
            _ => {
                id.push(if upper { letter.to_ascii_uppercase() } else { letter });
                upper = false;
            }
        }
    }
    Id::new(&id).ok()
}

/// Reads the lines of a file; says how many bytes are whole lines.
fn read(path: &Path, mut take: impl FnMut(LogLine) -> Result<(), Strange>) -> Result<u64, StoreError> {
    let mut from = BufReader::new(File::open(path).map_err(|error| told(path, &error))?);
    let (mut length, mut text) = (0, Vec::new());
    for number in 1.. {
        text.clear();
        let bytes = from.read_until(b'\n', &mut text).map_err(|error| told(path, &error))?;
        if text.pop() != Some(b'\n') {
            break;
        }
        line(&text).and_then(&mut take).map_err(|reason| damaged(path, number, &reason))?;
        length += bytes as u64;
    }
    Ok(length)
}

fn line(text: &[u8]) -> Result<LogLine, Strange> {
    Ok(json::decode(std::str::from_utf8(text)?)?)
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = disk::private().create(true).append(true).open(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Cuts a file to its whole lines.
fn cut(path: &Path, length: u64) -> io::Result<()> {
    match std::fs::metadata(path) {
        Ok(about) if about.len() > length => {
            let file = File::options().write(true).open(path)?;
            file.set_len(length)?;
            file.sync_all()
        }
        _ => Ok(()),
    }
}

fn damaged(path: &Path, line: u64, reason: &impl Display) -> StoreError {
    StoreError::Damaged(Damage::line(path, line, reason))
}
