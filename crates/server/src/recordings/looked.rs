//! Reads a recording for people: for its report, in other forms, and if its replay gives the same. A line at a time, within a
//! time and a size, on threads of its own.

use super::{NotRecorded, RECORDING_MAX_BYTES, Recordings, described, later, marks_of};
use crate::support::lock;
use crate::support::until::Until;
use behaviour::Knowledge;
use phrase::Catalogue;
use protocol::{Recording, Refused};
use recording::{Header, PrivateParts, Replay, Timeline, read_line};
use report::{ChosenRecording, Gathered, ListedRecording, Replayed, SessionNumbers};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::time::SystemTime;
use tokio_util::sync::CancellationToken;

/// The longest that marks are counted for a list, in milliseconds; then the others are not known.
const LISTED_MS: u64 = 3_000;
/// The largest recording that is read to count the marks of its row, in bytes.
const COUNTED_MAX_BYTES: u64 = 16 << 20;
/// The longest line that is read, in bytes: a program with its helpers is below it.
const LINE_MAX_BYTES: u64 = 16 << 20;
/// The time that reading one recording may take, in milliseconds.
const READ_MS: u64 = 20_000;
/// The time that replaying one may take, in milliseconds.
const REPLAY_MS: u64 = 10_000;
/// The time that reading the sessions beside it may take, in milliseconds.
const SESSIONS_MS: u64 = 10_000;
/// The most sessions of one participant that are compared.
const SESSIONS_MAX: usize = 12;
/// The largest recording that is converted here, in bytes: more than an hour.
const CONVERTED_MAX_BYTES: u64 = 32 << 20;
/// The findings of replays that are kept.
const CHECKED_MAX: usize = 2_000;

/// The state of a file: a finding holds as long as this is the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Version {
    bytes: u64,
    modified: Option<SystemTime>,
}

impl Version {
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        let about = path.metadata()?;
        Ok(Self { bytes: about.len(), modified: about.modified().ok() })
    }
}

/// Everything of which the page of a report is made.
pub(crate) struct ReportSource {
    pub(crate) gathered: Gathered,
    pub(crate) replayed: Replayed,
    pub(crate) sessions: Vec<SessionNumbers>,
}

impl Recordings {
    /// Reads a recording for its report. Reads for seconds: on a thread of its own.
    ///
    /// # Errors
    /// If there is no such recording, or if it cannot be read.
    pub(crate) fn look(
        &self,
        name: &str,
        (keep, language): (PrivateParts, &'static Catalogue),
        knowledge: &dyn Knowledge,
        token: &CancellationToken,
    ) -> Result<ReportSource, Refused> {
        let path = self.find(name).ok_or(Refused::NoRecording)?;
        let goes_on = lock(&self.open).contains(name);
        let version = Version::of(&path).map_err(NotRecorded::Unread)?;
        let (mut lines, header) = Lines::open(&path).map_err(NotRecorded::Unread)?.ok_or(Refused::NoRecording)?;
        let mut gathered = Gathered::of(header.clone(), keep, language);
        let known = self.known_finding(name, version);
        let mut replay = known.is_none().then(|| Replaying::of(&header, token));
        let until = Until::after(READ_MS, token);
        while let Some(line) = lines.next().map_err(NotRecorded::Unread)? {
            if !until.goes_on() {
                gathered.was_not_read_to_its_end();
                replay.iter_mut().for_each(Replaying::give_up);
                break;
            }
            let entry = read_line(line);
            gathered.take(&entry, knowledge);
            replay.iter_mut().for_each(|replay| replay.take(&entry));
        }
        if goes_on {
            gathered.goes_on();
        }
        let later = later(&marks_of(&path)).map_err(NotRecorded::Unread)?;
        gathered.finish(&later);
        let replayed = known.unwrap_or_else(|| replay.map_or(Replayed::Unknown, Replaying::found));
        if !goes_on && !token.is_cancelled() {
            self.keep_finding(name, version, replayed);
        }
        let sessions = self.sessions(name, header.participant.as_deref(), &Until::after(SESSIONS_MS, token));
        Ok(ReportSource { gathered, replayed, sessions })
    }

    /// All recordings or all in the bin as a list shows them, with the one that is looked at if there is one of that name. What
    /// replays give is found out for that one alone. Reads for seconds: on a thread of its own.
    pub(crate) fn listed(
        &self,
        bin: bool,
        chosen: Option<&str>,
        token: &CancellationToken,
    ) -> (Vec<ListedRecording>, Option<ChosenRecording>) {
        let all = if bin { self.binned() } else { self.list() };
        let marked = chosen.and_then(|name| {
            let recording = all.iter().find(|one| one.file == name)?.clone();
            let marks = if bin { Vec::new() } else { self.marks(name).unwrap_or_default() };
            let replayed = if bin || recording.goes_on { None } else { self.finding(name, token) };
            Some(ChosenRecording {
                listed: ListedRecording { marks: Some(marks.len() as u64), recording, replayed },
                marks,
            })
        });
        let until = Until::after(LISTED_MS, token);
        let listed = |recording: Recording| {
            let path = self.folder.as_deref().map(|folder| folder.join(&recording.file));
            let replayed =
                path.as_deref().and_then(|path| self.known_finding(&recording.file, Version::of(path).ok()?));
            let marks = path.and_then(|path| self.marks_by_now(&path, recording.marks, &until));
            ListedRecording { marks, recording, replayed }
        };
        (all.into_iter().map(listed).collect(), marked)
    }

    /// The number of marks by now. A recording with later marks is read for it, unless it is large or the time is over: then
    /// nobody knows.
    fn marks_by_now(&self, path: &Path, of_run: Option<u64>, until: &Until) -> Option<u64> {
        if later(&marks_of(path)).ok()?.is_empty() {
            return of_run;
        }
        if !until.goes_on() || path.metadata().ok()?.len() > COUNTED_MAX_BYTES {
            return None;
        }
        let all = self.all_marks(path).ok()?;
        Some(all.values().filter(|mark| !mark.gone).count() as u64)
    }

    /// Returns what a replay of a recording gives, as far as it is found out in time.
    fn finding(&self, name: &str, token: &CancellationToken) -> Option<Replayed> {
        let path = self.find(name)?;
        let version = Version::of(&path).ok()?;
        if let Some(known) = self.known_finding(name, version) {
            return Some(known);
        }
        let (mut lines, header) = Lines::open(&path).ok()??;
        let mut replay = Replaying::of(&header, token);
        while replay.replay.is_some()
            && let Some(line) = lines.next().ok()?
        {
            replay.take(&read_line(line));
        }
        let found = replay.found();
        if !token.is_cancelled() {
            self.keep_finding(name, version, found);
        }
        Some(found)
    }

    /// A recording as a timeline, to be written in another form. Reads for seconds: on a thread of its own.
    ///
    /// # Errors
    /// If there is no such recording, if it cannot be read, or if it is too large.
    pub(crate) fn timeline(&self, name: &str, keep: PrivateParts) -> Result<Timeline, Refused> {
        let path = self.find(name).ok_or(Refused::NoRecording)?;
        let mut text = Vec::new();
        let read = File::open(&path).and_then(|file| file.take(CONVERTED_MAX_BYTES + 1).read_to_end(&mut text));
        if read.map_err(NotRecorded::Unread)? as u64 > CONVERTED_MAX_BYTES {
            return Err(NotRecorded::TooLarge.into());
        }
        let later = later(&marks_of(&path)).map_err(NotRecorded::Unread)?;
        recording::timeline(&String::from_utf8_lossy(&text), &later, keep)
            .map_err(|recording::NoRecording| Refused::NoRecording)
    }

    /// Sessions of one participant, the oldest first, with the one that is looked at; no more than are compared.
    fn sessions(&self, name: &str, participant: Option<&str>, until: &Until) -> Vec<SessionNumbers> {
        let (Some(participant), Some(folder)) = (participant, self.folder.as_deref()) else { return Vec::new() };
        let all = super::files(folder).filter_map(|(path, bytes)| Some((described(&path, bytes)?, path)));
        let mut all: Vec<_> =
            all.filter(|(about, _)| about.session.participant.as_deref() == Some(participant)).collect();
        all.sort_by(|(one, _), (other, _)| one.file.cmp(&other.file));
        // The newest, and those up to the one that is looked at if that is an older one.
        let this = all.iter().position(|(about, _)| about.file == name).map_or(all.len(), |at| at + 1);
        let end = this.max(all.len().min(SESSIONS_MAX));
        let some = &all[end.saturating_sub(SESSIONS_MAX)..end];
        some.iter().map_while(|(about, path)| until.goes_on().then(|| self.session(about, path, name, until))).collect()
    }

    fn session(&self, about: &Recording, path: &Path, name: &str, until: &Until) -> SessionNumbers {
        let mut session = SessionNumbers::of(about, &self.marks(&about.file).unwrap_or_default(), about.file == name);
        let Ok(Some((mut lines, _))) = Lines::open(path) else { return session };
        while let Ok(Some(line)) = lines.next() {
            session.count(line);
            if !until.goes_on() {
                break;
            }
        }
        session
    }

    fn known_finding(&self, name: &str, version: Version) -> Option<Replayed> {
        let found = lock(&self.checked).get(name).copied();
        found.filter(|(of, _)| *of == version).map(|(_, found)| found)
    }

    fn keep_finding(&self, name: &str, version: Version, found: Replayed) {
        let mut checked = lock(&self.checked);
        if checked.len() >= CHECKED_MAX {
            checked.pop_first();
        }
        checked.insert(name.to_owned(), (version, found));
    }
}

/// A replay beside the reading, which has less time.
struct Replaying<'a> {
    replay: Option<Box<Replay>>,
    found: Option<Replayed>,
    until: Until<'a>,
}

impl<'a> Replaying<'a> {
    fn of(header: &Header, token: &'a CancellationToken) -> Self {
        let found = header.lacks().map(|lack| Replayed::from(&Err(recording::Different::Lacks(lack))));
        let until = Until::after(REPLAY_MS, token);
        let over = until.hook();
        let replay = found.is_none().then(|| Box::new(Replay::of(header).stopped_by(over)));
        Self { replay, found, until }
    }

    fn take(&mut self, entry: &recording::Entry) {
        let Some(replay) = &mut self.replay else { return };
        if !self.until.goes_on() {
            return self.give_up();
        }
        let taken = replay.take(entry.clone());
        // A replay that was ended in its middle says nothing.
        if !self.until.goes_on() {
            return self.give_up();
        }
        if let Err(different) = taken {
            (self.replay, self.found) = (None, Some(Replayed::from(&Err(different))));
        }
    }

    fn give_up(&mut self) {
        if self.replay.take().is_some() {
            self.found = Some(Replayed::TooLong);
        }
    }

    fn found(self) -> Replayed {
        let until = self.until;
        let ended = self.replay.map(|replay| {
            let found = Replayed::from(&replay.finish());
            if until.goes_on() { found } else { Replayed::TooLong }
        });
        ended.or(self.found).unwrap_or(Replayed::Unknown)
    }
}

/// The lines of a file, one at a time.
pub(super) struct Lines {
    file: BufReader<io::Take<File>>,
    line: Vec<u8>,
}

impl Lines {
    /// Opens a recording; none if the file is none.
    pub(super) fn open(path: &Path) -> io::Result<Option<(Self, Header)>> {
        let file = File::open(path)?.take(RECORDING_MAX_BYTES);
        let mut lines = Self { file: BufReader::new(file), line: Vec::new() };
        let first = lines.next()?.unwrap_or_default();
        let header = recording::open(first).ok().map(|(header, _)| header);
        Ok(header.map(|header| (lines, header)))
    }

    /// The next line; empty if it is none that can be read.
    pub(super) fn next(&mut self) -> io::Result<Option<&str>> {
        self.line.clear();
        let read = (&mut self.file).take(LINE_MAX_BYTES).read_until(b'\n', &mut self.line)?;
        if read as u64 == LINE_MAX_BYTES && !self.line.ends_with(b"\n") {
            self.line.clear();
            self.file.skip_until(b'\n')?;
        }
        Ok((read > 0).then(|| std::str::from_utf8(&self.line).unwrap_or_default().trim_end_matches(['\n', '\r'])))
    }
}
