//! Pasts that people look back at: opened once for all, few at a time, within a bound of bytes. No run and no Stop waits for
//! anything here.

use super::looked::{Lines, Version};
use super::looking_places::LookingPlaces;
use super::{NotRecorded, Recordings, later, marks_of};
use crate::support::identity::PersonIdentity;
use crate::support::lock;
use crate::support::until::Until;
use past::{Opening, Past};
use protocol::{NotSeen, PastOf, RecordingMark, Refused};
use recording::{Entry, Header, json, read_line};
use std::rc::Rc;
use std::sync::{Arc, Mutex};
use tokio_util::sync::CancellationToken;

/// The most pasts that are kept open.
const PASTS_MAX: usize = 8;
/// The most bytes of all of them. An hour takes a few dozen million; the last one is kept however large it is, which is bounded.
const PASTS_MAX_BYTES: usize = 192 << 20;
/// The memory that a past may come to take for causes that people ask for, in bytes.
const CAUSES_BYTES: usize = 12 << 20;
/// The time that opening one may take, in milliseconds; what is not read by then is left out.
const OPEN_MS: u64 = 8_000;
/// The time after which an opening ends also in the middle of a reading, in milliseconds.
const OPEN_MAX_MS: u64 = 12_000;

/// The past of a run that goes on.
pub(crate) struct LivePast {
    /// The header that it would be recorded with.
    pub(crate) header: Header,
    /// The readings that moved it lately.
    pub(crate) entries: Vec<Entry>,
    /// The marks of the run.
    pub(crate) marks: Vec<RecordingMark>,
    /// The last instant that is closed.
    pub(crate) now_ms: u64,
}

/// The pasts that are open. A clone is the same.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pasts {
    kept: Arc<Mutex<KeptPasts>>,
    places: Arc<Mutex<LookingPlaces>>,
}

#[derive(Debug, Default)]
struct KeptPasts {
    /// The one that was used last is the last.
    all: Vec<KeptPast>,
}

#[derive(Debug)]
struct KeptPast {
    of: PastOf,
    version: Option<Version>,
    bytes: usize,
    past: Arc<Past>,
}

impl KeptPasts {
    fn find(&mut self, of: &PastOf, is_it: impl Fn(&KeptPast) -> bool) -> Option<Arc<Past>> {
        let at = self.all.iter().position(|kept| kept.of == *of && is_it(kept))?;
        let kept = self.all.remove(at);
        let past = Arc::clone(&kept.past);
        self.all.push(kept);
        Some(past)
    }

    fn keep(&mut self, of: &PastOf, version: Option<Version>, past: &Arc<Past>) {
        self.all.retain(|kept| kept.of != *of);
        self.all.push(KeptPast { of: of.clone(), version, bytes: past.bytes() + CAUSES_BYTES, past: Arc::clone(past) });
        let bytes = |all: &[KeptPast]| all.iter().map(|kept| kept.bytes).sum::<usize>();
        while self.all.len() > PASTS_MAX || (self.all.len() > 1 && bytes(&self.all) > PASTS_MAX_BYTES) {
            self.all.remove(0);
        }
    }
}

impl Pasts {
    /// A place for a person who asks about a past on a link. False if as many people look back as can.
    pub(crate) fn enter(&self, by: &PersonIdentity, link: u64, of: &PastOf) -> bool {
        lock(&self.places).enter(by, link, of)
    }

    /// A recording is gone, and what was opened of it goes too.
    pub(super) fn forget(&self, name: &str) {
        lock(&self.kept).all.retain(|kept| !matches!(&kept.of, PastOf::Recording(known) if known == name));
    }

    /// A link ended.
    pub(crate) fn leave(&self, link: u64) {
        lock(&self.places).leave(link);
    }
}

impl Recordings {
    /// Returns an opened past; with `anew` as it is by now, else as somebody opened it last. `live` is asked for the readings of a
    /// run. Takes a second: on a thread of its own.
    ///
    /// # Errors
    /// If there is none, or if it cannot be shown.
    pub(crate) fn look_back(
        &self,
        of: &PastOf,
        anew: bool,
        live: impl FnOnce(u64) -> Option<LivePast>,
        token: &CancellationToken,
    ) -> Result<Arc<Past>, Refused> {
        if let PastOf::Recording(name) = of
            && self.find(name).is_none()
        {
            // Also where it gave way to a newer one, or went by hand.
            self.pasts.forget(name);
            return Err(Refused::NoRecording);
        }
        if let Some(past) = lock(&self.pasts.kept).find(of, |_| !anew) {
            return Ok(past);
        }
        let version = match of {
            PastOf::Recording(name) => Some(self.version(name)?),
            PastOf::Run(_) => None,
        };
        let is_same = |kept: &KeptPast| !anew || (version.is_some() && kept.version == version && !kept.past.goes_on());
        if let Some(past) = lock(&self.pasts.kept).find(of, is_same) {
            return Ok(past);
        }
        let past = Arc::new(match of {
            PastOf::Recording(name) => self.open_past(name, token)?,
            PastOf::Run(run) => open_live(live(*run).ok_or(Refused::from(NotSeen::NoPast))?, token)?,
        });
        lock(&self.pasts.kept).keep(of, version, &past);
        Ok(past)
    }

    fn version(&self, name: &str) -> Result<Version, Refused> {
        let path = self.find(name).ok_or(Refused::NoRecording)?;
        Ok(Version::of(&path).map_err(NotRecorded::Unread)?)
    }

    fn open_past(&self, name: &str, token: &CancellationToken) -> Result<Past, Refused> {
        let path = self.find(name).ok_or(Refused::NoRecording)?;
        let goes_on = lock(&self.open).contains(name);
        let (mut lines, header) = Lines::open(&path).map_err(NotRecorded::Unread)?.ok_or(Refused::NoRecording)?;
        let (until, hard) = (Until::after(OPEN_MS, token), Until::after(OPEN_MAX_MS, token));
        let mut opening = Opening::of(header, Rc::new(hard.hook())).map_err(Refused::from)?;
        while let Some(line) = lines.next().map_err(NotRecorded::Unread)? {
            if !until.goes_on() {
                opening.cut();
            }
            if opening.is_full() {
                break;
            }
            opening.take(read_line(line)).map_err(Refused::from)?;
        }
        let later = later(&marks_of(&path)).map_err(NotRecorded::Unread)?;
        opening.finish(&later, goes_on.then_some(0)).map_err(Refused::from)
    }
}

fn open_live(live: LivePast, token: &CancellationToken) -> Result<Past, Refused> {
    let LivePast { header, entries, marks, now_ms } = live;
    let until = Until::after(OPEN_MS, token);
    let opening = Opening::of(header, Rc::new(until.hook())).map_err(Refused::from)?;
    let mut opening = opening.without_actions();
    for entry in entries {
        opening.take(entry).map_err(Refused::from)?;
    }
    let marks: String = marks.iter().map(|mark| json(mark) + "\n").collect();
    opening.finish(&marks, Some(now_ms)).map_err(Refused::from)
}
