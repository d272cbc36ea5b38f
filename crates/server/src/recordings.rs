//! Recordings of runs: files of JSON lines in the data folder, each written by a thread of its own.

mod bin;
pub(crate) mod clock;
mod described;
mod looked;
mod looking_places;
mod marks;
mod pasts;
mod recorder;
mod session;
#[cfg(test)]
mod tests;
mod titles;
mod writer;

use crate::support::file_name::dashed;
use crate::support::lock;
use behaviour::{Engine, Id, numbered};
use described::described;
pub(crate) use looked::ReportSource;
use marks::later;
pub(crate) use marks::tidied;
pub(crate) use pasts::{LivePast, Pasts};
use phrase::Phrased;
use protocol::{RecordedSession, Recording, Refused};
pub(crate) use recorder::{RecordedStep, Recorder};
use recording::Header;
use session::checked;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
pub(crate) use writer::Stuck;

/// The largest a recording may grow, in bytes.
pub(crate) const RECORDING_MAX_BYTES: u64 = 256 << 20;
/// The most that all recordings may take, in bytes.
pub(crate) const ALL_MAX_BYTES: u64 = 4 << 30;
/// Recordings that are kept.
const KEPT_MAX: usize = 1_000;
/// What a recording's name ends with.
const ENDING: &str = ".jsonl";
/// The ending of the name of the file of a recording's later marks.
const MARKS_ENDING: &str = ".marks.jsonl";

/// The folder of the recordings. A clone is the same folder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Recordings {
    folder: Option<Arc<Path>>,
    /// Taken while a name is chosen.
    naming: Arc<Mutex<()>>,
    /// The files that are being written.
    open: Arc<Mutex<BTreeSet<String>>>,
    /// By file what its replay gave, as long as the file is the same.
    checked: Arc<Mutex<BTreeMap<String, (looked::Version, report::Replayed)>>>,
    /// Taken while a mark is written.
    marking: Arc<Mutex<()>>,
    /// Those that people look back at.
    pub(crate) pasts: Pasts,
    bounds: RecordingBounds,
}

/// The bounds of the recordings that are kept.
#[derive(Clone, Copy, Debug)]
struct RecordingBounds {
    /// The most that are kept.
    kept: usize,
    /// The most bytes that they have together.
    bytes: u64,
}

impl Default for RecordingBounds {
    fn default() -> Self {
        Self { kept: KEPT_MAX, bytes: ALL_MAX_BYTES }
    }
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
    /// The run has no such mark.
    NoMark,
    /// A mark cannot be taken back any more, or not by this person.
    NotUndone,
    /// The word or the note of a mark is too long.
    LongNote,
    /// A mark ends before it begins, or is too late.
    NoSpan,
    /// The recording has as many marks as it may have.
    TooManyMarks,
    /// A mark could not be written.
    MarkUnwritten(io::Error),
    /// The recording or its marks cannot be read.
    Unread(io::Error),
    /// It is still being written.
    GoesOn,
    /// The name that it shall have is too long.
    LongTitle,
    /// The name could not be written.
    TitleUnwritten(io::Error),
    /// It is larger than is converted here.
    TooLarge,
    /// The code of who takes part has signs that it may not have, or too many.
    StrangeCode,
    /// The name of the session is too long.
    LongSession,
}

impl From<NotRecorded> for Refused {
    fn from(why: NotRecorded) -> Self {
        Self::CannotRecord(why.phrase())
    }
}

/// A file that is being written, until this is dropped.
#[derive(Debug)]
struct OpenRecordingFile {
    all: Arc<Mutex<BTreeSet<String>>>,
    name: String,
}

impl Drop for OpenRecordingFile {
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
    pub(crate) file: &'a Arc<behaviour::BehaviourFile>,
    /// The session that it is part of, and what is recorded.
    pub(crate) session: &'a RecordedSession,
}

impl About<'_> {
    fn header(&self, began: &str) -> Header {
        let (mode, frame_ms) = match self.file.engine.unwrap_or_default() {
            Engine::Event => ("event", None),
            Engine::Frame { frame_ms } => ("frame", Some(frame_ms)),
        };
        Header {
            format: recording::FORMAT.to_owned(),
            behaviour: self.behaviour.to_string(),
            name: self.file.name.clone(),
            revision: self.revision,
            mode: mode.to_owned(),
            frame_ms,
            by: self.by.to_owned(),
            began: began.to_owned(),
            run: self.run,
            robot: self.robot.to_owned(),
            participant: self.session.participant.clone(),
            session: self.session.session.clone(),
            records: self.session.records,
        }
    }
}

impl Recordings {
    /// In a data folder, or nowhere.
    pub(crate) fn within(data: Option<&Path>) -> Self {
        Self { folder: data.map(|data| data.join("recordings").into()), ..Self::default() }
    }

    /// Begins a recording: when this answers, its first lines are on the disk. If there are as many as are kept, the oldest
    /// give way to it.
    ///
    /// # Errors
    /// Why it cannot be recorded.
    pub(crate) fn begin(&self, about: &About) -> Result<Recorder, NotRecorded> {
        let folder = self.folder.as_deref().ok_or(NotRecorded::NoFolder)?;
        let session = &checked(about.session.clone())?;
        let about = &About { session, ..*about };
        let _naming = lock(&self.naming);
        store::disk::make_folder(folder).map_err(|error| NotRecorded::NoneMade(folder.to_owned(), error))?;
        let gave_way = self.make_room(folder, self.bounds)?;
        let began = clock::now();
        let (name, file) = create(folder, &began, about.file.name.as_str())?;
        let started = Recorder::start(self.opened(&name), file, &about.header(&began), (about.file, gave_way));
        let started = started.and_then(|recorder| store::disk::sync_names(folder).map(|()| recorder));
        started.map_err(|error| {
            // It has not begun; what is left of its file says nothing.
            let _none_is_fine = std::fs::remove_file(folder.join(&name));
            NotRecorded::NotBegun(error)
        })
    }

    /// Removes the oldest recordings until there is room for one more; answers how many went.
    fn make_room(&self, folder: &Path, RecordingBounds { kept, bytes }: RecordingBounds) -> Result<u64, NotRecorded> {
        let written = |path: &Path| path.metadata().and_then(|about| about.modified()).ok();
        let bin = self.bin().unwrap_or_default();
        let is_binned = |path: &Path| path.parent() == Some(&*bin);
        let mut all: Vec<(PathBuf, u64)> = files(folder).chain(files(&bin)).collect();
        // The bin gives way first.
        all.sort_by_cached_key(|(path, _)| (!is_binned(path), written(path), path.clone()));
        let open = lock(&self.open).clone();
        let is_open =
            |path: &Path| path.file_name().and_then(|name| name.to_str()).is_some_and(|name| open.contains(name));
        let (mut left, mut taken) = (all.len(), all.iter().map(|(_, bytes)| bytes).sum::<u64>());
        let mut gone = 0;
        for (path, size) in all.iter().filter(|(path, _)| !is_open(path)) {
            if left < kept && taken + RECORDING_MAX_BYTES <= bytes {
                break;
            }
            if let Err(error) = removed(path) {
                tracing::warn!(%error, path = %path.display(), "an old recording could not give way");
                continue;
            }
            tracing::info!(path = %path.display(), "an old recording gave way to a new one");
            (left, taken, gone) = (left - 1, taken - size, gone + u64::from(!is_binned(path)));
        }
        if left < kept && taken + RECORDING_MAX_BYTES <= bytes { Ok(gone) } else { Err(NotRecorded::Full) }
    }

    fn opened(&self, name: &str) -> OpenRecordingFile {
        lock(&self.open).insert(name.to_owned());
        OpenRecordingFile { all: self.open.clone(), name: name.to_owned() }
    }

    /// True if one is still being written.
    #[cfg(test)]
    pub(crate) fn is_writing(&self) -> bool {
        !lock(&self.open).is_empty()
    }

    /// All recordings, newest first. Reads the folder: not for the async threads.
    pub(crate) fn list(&self) -> Vec<Recording> {
        let Some(folder) = self.folder.as_deref() else { return Vec::new() };
        // Asked first: what ends meanwhile has its end.
        let open = lock(&self.open).clone();
        let mut all: Vec<Recording> = files(folder).filter_map(|(path, bytes)| described(&path, bytes)).collect();
        all.sort_by(|one, other| other.file.cmp(&one.file));
        all.truncate(KEPT_MAX);
        for recording in &mut all {
            recording.goes_on = open.contains(&recording.file);
            recording.cut_off &= !recording.goes_on;
        }
        all
    }

    /// Where a recording is, if there is one of that name.
    pub(crate) fn find(&self, name: &str) -> Option<PathBuf> {
        let folder = self.folder.as_deref()?;
        files(folder).map(|(path, _)| path).find(|path| path.file_name().is_some_and(|known| known == name))
    }
}

/// Removes a recording with its later marks and its name.
fn removed(path: &Path) -> io::Result<()> {
    std::fs::remove_file(path)?;
    [marks_of(path), titles::title_of(path)]
        .iter()
        .try_for_each(|beside| bin::none_is_fine(std::fs::remove_file(beside)))
}

/// Returns the path of the later marks of a recording.
fn marks_of(path: &Path) -> PathBuf {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    path.with_file_name(format!("{}{MARKS_ENDING}", name.trim_end_matches(ENDING)))
}

/// Recordings in a folder with their sizes.
fn files(folder: &Path) -> impl Iterator<Item = (PathBuf, u64)> + use<> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| {
        let is_one = entry.file_name().to_str().is_some_and(is_recording);
        let about = entry.metadata().ok()?;
        (is_one && about.is_file()).then(|| (entry.path(), about.len()))
    })
}

/// True if a file of this name is a recording, not its later marks.
fn is_recording(name: &str) -> bool {
    name.ends_with(ENDING) && !name.ends_with(MARKS_ENDING)
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
