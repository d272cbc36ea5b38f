//! Recordings of runs: files of JSON lines in the data folder, each written by a thread of its own.

mod clock;
mod lines;
mod recorder;
mod writer;

use crate::support::file_name::dashed;
use crate::support::lock;
use behaviour::{Id, numbered};
use lines::Header;
pub(crate) use lines::Note;
use protocol::{Recording, Refused};
pub(crate) use recorder::{Recorder, Step};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
pub(crate) use writer::Stuck;

/// The largest a recording may grow, in bytes.
pub(crate) const RECORDING_MAX_BYTES: u64 = 256 << 20;
/// The most that all recordings may take, in bytes.
const ALL_MAX_BYTES: u64 = 4 << 30;
/// Recordings that are kept.
const KEPT_MAX: usize = 1_000;
/// The longest first line that is read, in bytes.
const HEADER_MAX_BYTES: u64 = 16 << 10;
/// The longest last line, in bytes.
const END_MAX_BYTES: u64 = 4 << 10;
/// What a recording's name ends with.
const ENDING: &str = ".jsonl";

/// The folder of the recordings. A clone is the same folder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recordings {
    folder: Option<Arc<Path>>,
    /// Taken while a name is chosen.
    naming: Arc<Mutex<()>>,
    /// The files that are being written.
    open: Arc<Mutex<BTreeSet<String>>>,
}

/// Why something about a recording was not done.
#[derive(Debug)]
pub(crate) enum NotRecorded {
    /// The server has no folder to record into.
    NoFolder,
    /// The folder of the recordings cannot be made.
    NoneMade(PathBuf, io::Error),
    /// There are as many recordings as may be, or as large.
    Full,
    /// The file cannot be made.
    Unwritable(PathBuf, io::Error),
    /// Every name that it could have is taken.
    NameTaken,
    /// Its first line could not be written.
    NotBegun(io::Error),
    /// It could not be removed.
    NotRemoved(io::Error),
    /// What shall be marked is not recorded.
    Unrecorded,
    /// The note of a mark is too long.
    LongNote,
}

impl From<NotRecorded> for Refused {
    fn from(why: NotRecorded) -> Self {
        Self::CannotRecord(why.to_string())
    }
}

/// A file that is being written, until this is dropped.
#[derive(Debug)]
struct Open {
    all: Arc<Mutex<BTreeSet<String>>>,
    name: String,
}

impl Drop for Open {
    fn drop(&mut self) {
        lock(&self.all).remove(&self.name);
    }
}

/// What is recorded.
pub(crate) struct About<'a> {
    /// The run's number.
    pub(crate) run: u64,
    /// The name of the robot.
    pub(crate) robot: &'a str,
    /// Which behaviour.
    pub(crate) behaviour: &'a Id,
    /// Its revision.
    pub(crate) revision: u64,
    /// Who started it.
    pub(crate) by: &'a str,
    /// What runs.
    pub(crate) file: &'a behaviour::BehaviourFile,
}

impl Recordings {
    /// In a data folder, or nowhere.
    pub(crate) fn within(data: Option<&Path>) -> Self {
        Self { folder: data.map(|data| data.join("recordings").into()), ..Self::default() }
    }

    /// Begins a recording: when this answers, its first line is on the disk. Nothing that was recorded gives way to it.
    ///
    /// # Errors
    /// Why it cannot be recorded.
    pub(crate) fn begin(&self, about: &About) -> Result<Recorder, NotRecorded> {
        let folder = self.folder.as_deref().ok_or(NotRecorded::NoFolder)?;
        let _naming = lock(&self.naming);
        store::disk::make_folder(folder).map_err(|error| NotRecorded::NoneMade(folder.to_owned(), error))?;
        let (count, bytes) = taken(folder);
        if count >= KEPT_MAX || bytes + RECORDING_MAX_BYTES > ALL_MAX_BYTES {
            return Err(NotRecorded::Full);
        }
        let began = clock::now();
        let (name, file) = create(folder, &began, about.file.name.as_str())?;
        let started = Recorder::start(self.opened(&name), file, &Header::of(about, &began), about.file);
        let started = started.and_then(|recorder| store::disk::sync_names(folder).map(|()| recorder));
        started.map_err(|error| {
            // It has not begun; what is left of its file says nothing.
            let _none_is_fine = std::fs::remove_file(folder.join(&name));
            NotRecorded::NotBegun(error)
        })
    }

    fn opened(&self, name: &str) -> Open {
        lock(&self.open).insert(name.to_owned());
        Open { all: self.open.clone(), name: name.to_owned() }
    }

    /// All recordings, newest first. Reads the folder: not for the async threads.
    pub(crate) fn list(&self) -> Vec<Recording> {
        let Some(folder) = self.folder.as_deref() else { return Vec::new() };
        // Asked first: what ends meanwhile has its end.
        let open = lock(&self.open).clone();
        let mut all: Vec<Recording> = files(folder).filter_map(|(path, bytes)| described(&path, bytes)).collect();
        all.sort_by(|one, other| other.file.cmp(&one.file));
        all.truncate(KEPT_MAX);
        all.iter_mut().for_each(|recording| recording.cut_off &= !open.contains(&recording.file));
        all
    }

    /// Where a recording is, if there is one of that name.
    pub(crate) fn find(&self, name: &str) -> Option<PathBuf> {
        let folder = self.folder.as_deref()?;
        files(folder).map(|(path, _)| path).find(|path| path.file_name().is_some_and(|known| known == name))
    }

    /// Removes a recording for good.
    pub(crate) fn remove(&self, name: &str) -> Result<(), Refused> {
        let path = self.find(name).ok_or(Refused::NoRecording)?;
        let removed = std::fs::remove_file(&path);
        let removed = removed.and_then(|()| store::disk::sync_names(path.parent().unwrap_or(Path::new(""))));
        removed.map_err(|error| NotRecorded::NotRemoved(error).into())
    }
}

/// Recordings in a folder with their sizes.
fn files(folder: &Path) -> impl Iterator<Item = (PathBuf, u64)> + use<> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| {
        let is_one = entry.file_name().to_str().is_some_and(|name| name.ends_with(ENDING));
        let about = entry.metadata().ok()?;
        (is_one && about.is_file()).then(|| (entry.path(), about.len()))
    })
}

/// How many recordings there are, and how large together.
fn taken(folder: &Path) -> (usize, u64) {
    files(folder).fold((0, 0), |(count, bytes), (_, more)| (count + 1, bytes + more))
}

/// A new file, named by time and behaviour.
fn create(folder: &Path, began: &str, behaviour: &str) -> Result<(String, File), NotRecorded> {
    let words = dashed(behaviour);
    let time = began.replace(':', "-");
    for name in numbered(&format!("{time}-{words}"), "-").take(KEPT_MAX) {
        let name = format!("{name}{ENDING}");
        match store::disk::private().create_new(true).open(folder.join(&name)) {
            Ok(file) => return Ok((name, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(NotRecorded::Unwritable(folder.join(name), error)),
        }
    }
    Err(NotRecorded::NameTaken)
}

/// The first line of a recording, as far as it is shown.
#[derive(Deserialize)]
struct First {
    /// Not in recordings from before there were several.
    #[serde(default)]
    robot: String,
    name: String,
    revision: u64,
    began: String,
}

fn described(path: &Path, bytes: u64) -> Option<Recording> {
    let mut file = File::open(path).ok()?;
    let mut line = String::new();
    BufReader::new((&mut file).take(HEADER_MAX_BYTES)).read_line(&mut line).ok()?;
    let First { robot, name, revision, began } = serde_json::from_str(&line).ok()?;
    let (file, cut_off) = (path.file_name()?.to_str()?.to_owned(), !has_its_end(&mut file, bytes));
    Some(Recording { file, robot, name, revision, began, bytes, cut_off })
}

/// Whether the last line says that it is the last.
fn has_its_end(file: &mut File, bytes: u64) -> bool {
    let mut tail = Vec::new();
    let from = SeekFrom::Start(bytes.saturating_sub(END_MAX_BYTES));
    let read = file.seek(from).and_then(|_| file.take(END_MAX_BYTES).read_to_end(&mut tail));
    let tail = String::from_utf8_lossy(&tail);
    let last = tail.strip_suffix('\n').map(|text| text.rsplit('\n').next().unwrap_or_default());
    let says_so = |line: &str| line.contains("\"mark\":\"end\"") || line.contains("\"mark\":\"full\"");
    read.is_ok() && last.is_some_and(says_so)
}
