//! The later marks of a recording: a file beside it that only grows, so that whoever changes a mark leaves what it was.

use super::{NotRecorded, Recordings, clock, marks_of};
use crate::support::lock;
use behaviour::Id;
use protocol::{MARK_MAX_CHARS, MARK_WORD_MAX_CHARS, RECORDING_MARKS_MAX, RecordingMark, Refused};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

/// The largest that file may grow, in bytes.
const MARKS_MAX_BYTES: u64 = 2 << 20;
/// The lines of marks that are read of one recording: no run writes more.
const LINES_MAX: usize = 4 * RECORDING_MARKS_MAX;
/// The latest that a mark may be, in milliseconds: a hundred days.
const LATEST_MS: u64 = 100 * 86_400_000;

impl Recordings {
    /// The marks of a recording as they are by now, by time. Waits for the disk.
    ///
    /// # Errors
    /// If there is no such recording, or if it cannot be read.
    pub(crate) fn marks(&self, name: &str) -> Result<Vec<RecordingMark>, Refused> {
        let all = self.all_marks(&self.known(name)?)?;
        let mut marks: Vec<_> = all.into_values().filter(|mark| !mark.gone).collect();
        marks.sort_by(|one, other| (one.t, &one.id).cmp(&(other.t, &other.id)));
        Ok(marks)
    }

    /// Adds, changes or removes a mark of a recording that is no longer written. Until then its run has the marks, and what stands
    /// beside it would void what the run says later. Waits for the disk.
    ///
    /// # Errors
    /// As of [`Self::put_mark`], and if the recording goes on.
    pub(crate) fn change_mark(&self, name: &str, mark: RecordingMark, by: &str) -> Result<(), Refused> {
        if lock(&self.open).contains(name) {
            return Err(NotRecorded::GoesOn.into());
        }
        self.put_mark(name, mark, by)
    }

    /// Adds, changes or removes a mark: the line of its id that is written last counts. Waits for the disk.
    ///
    /// # Errors
    /// If there is no such recording, if the mark breaks a bound, or if it cannot be written.
    pub(crate) fn put_mark(&self, name: &str, mark: RecordingMark, by: &str) -> Result<(), Refused> {
        let mark = RecordingMark { by: by.to_owned(), at: clock::now(), ..tidied(mark)? };
        // The marks of the run only become more: they are read before anybody has to wait.
        let run = of_run(&self.known(name)?).map_err(NotRecorded::Unread)?;
        let _marking = lock(&self.marking);
        let path = self.known(name)?;
        let all = recording::all_marks(run, &later(&marks_of(&path)).map_err(NotRecorded::Unread)?);
        if all.len() >= RECORDING_MARKS_MAX && !all.contains_key(&mark.id) {
            return Err(NotRecorded::TooManyMarks.into());
        }
        append(&marks_of(&path), &mark).map_err(Refused::from)
    }

    fn known(&self, name: &str) -> Result<PathBuf, Refused> {
        self.find(name).ok_or(Refused::NoRecording)
    }

    pub(super) fn all_marks(&self, path: &Path) -> Result<BTreeMap<Id, RecordingMark>, Refused> {
        let of_run = of_run(path).map_err(NotRecorded::Unread)?;
        let later = later(&marks_of(path)).map_err(NotRecorded::Unread)?;
        Ok(recording::all_marks(of_run, &later))
    }
}

/// The marks that were made while it ran, with all that followed on them. However large the recording is, a line at a time is
/// read.
fn of_run(path: &Path) -> io::Result<Vec<RecordingMark>> {
    let mut lines = BufReader::new(File::open(path)?);
    let (mut line, mut notes) = (Vec::new(), Vec::new());
    while notes.len() < LINES_MAX && lines.read_until(b'\n', &mut line)? > 0 {
        notes.extend(std::str::from_utf8(&line).ok().and_then(recording::run_note));
        line.clear();
    }
    Ok((1..).zip(notes).filter_map(|(number, note)| recording::mark(number, note)).collect())
}

/// The text of the later marks; nothing if there are none yet.
pub(super) fn later(path: &Path) -> io::Result<String> {
    let mut text = Vec::new();
    match File::open(path) {
        Ok(file) => file.take(MARKS_MAX_BYTES).read_to_end(&mut text)?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => 0,
        Err(error) => return Err(error),
    };
    Ok(String::from_utf8_lossy(&text).into_owned())
}

fn append(path: &Path, mark: &RecordingMark) -> Result<(), NotRecorded> {
    let before = later(path).map_err(NotRecorded::Unread)?;
    // A line that a power cut tore stays a line of its own.
    let torn = if before.is_empty() || before.ends_with('\n') { "" } else { "\n" };
    let line = format!("{torn}{}\n", recording::json(mark));
    if (before.len() + line.len()) as u64 > MARKS_MAX_BYTES {
        return Err(NotRecorded::TooManyMarks);
    }
    let written = store::disk::private().create(true).append(true).open(path).and_then(|mut file| {
        file.write_all(line.as_bytes())?;
        file.sync_all()
    });
    let named = written.and_then(|()| store::disk::sync_names(path.parent().unwrap_or(Path::new(""))));
    named.map_err(NotRecorded::MarkUnwritten)
}

/// A mark within its bounds; no span goes on.
///
/// # Errors
/// If it breaks a bound.
pub(crate) fn tidied(mark: RecordingMark) -> Result<RecordingMark, NotRecorded> {
    let (word, note) = (mark.word.trim().to_owned(), mark.note.trim().to_owned());
    if word.chars().count() > MARK_WORD_MAX_CHARS || note.chars().count() > MARK_MAX_CHARS {
        return Err(NotRecorded::LongNote);
    }
    if mark.t > LATEST_MS || mark.until.is_some_and(|until| until <= mark.t || until > LATEST_MS) {
        return Err(NotRecorded::NoSpan);
    }
    Ok(RecordingMark { word, note, open: false, ..mark })
}
