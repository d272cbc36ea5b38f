//! Behaviours out of files. Reading and judging a file is done by the workers and ends when its sender goes; then the
//! helpers and the behaviour are saved in one step that goes through whatever becomes of the sender.

use super::LibraryService;
use super::list::free_name;
use super::saved::{append, check_name};
use crate::rooms::knowledge::{Knowing, Unchecked};
use crate::support::identity::Sender;
use crate::support::store_call::{bounded, store_no};
use axum::body::Bytes;
use behaviour::{
    Behaviour, BehaviourFile, Change, Committed, Id, Knowledge, NAME_MAX_CHARS, Params, Refusal, Room, StreamKind,
    without_unseen,
};
use phrase::{Phrase, Phrased};
use protocol::Refused;
use std::sync::Arc;
use std::time::{Duration, Instant};
use store::files::{FileFault, Import, ImportError, ImportMode, ReadFile};
use uuid::Uuid;

/// How often a file is tried when others change the library at the same moment.
pub(crate) const TRIES: usize = 5;
/// How long the procedures of a file may take to be checked.
const CHECK_MS: u64 = 2_000;

/// Why a file was not imported.
#[derive(Debug)]
pub(crate) enum NotImported {
    /// The file cannot be read.
    Fault(FileFault),
    /// The behaviour is here already.
    Present,
    /// It is larger than any that is taken.
    TooLarge,
    /// It did not come to its end, or too slowly.
    NotWhole,
    /// What the file asks for is refused.
    Refused(Refused),
}

impl NotImported {
    /// True if somebody else was quicker, so that it may go well another time.
    fn is_overtaken(&self) -> bool {
        matches!(self, Self::Refused(no) if is_overtaken(no))
    }
}

impl From<Refused> for NotImported {
    fn from(no: Refused) -> Self {
        Self::Refused(no)
    }
}

impl From<FileFault> for NotImported {
    fn from(fault: FileFault) -> Self {
        Self::Fault(fault)
    }
}

/// Imports a file in somebody's name. A copy may have an id that is wanted; if that is here already, there is nothing to change.
pub(crate) async fn import(
    library: &Arc<LibraryService>,
    sender: Sender,
    (mode, wanted): (ImportMode, Option<Id>),
    by: &str,
    body: Bytes,
) -> Result<Import, NotImported> {
    let file = Arc::new(library.workers.run(sender.clone(), move |_| read(&body)).await.map_err(Refused::from)??);
    let by: String = without_unseen(by).chars().take(NAME_MAX_CHARS).collect();
    if mode == ImportMode::Restore {
        check_absent(library, &file).await?;
    }
    let wanted = wanted.filter(|id| mode == ImportMode::Copy && id != library.rooms.library());
    let mut last = NotImported::Refused(Refused::TooFast);
    for _ in 0..TRIES {
        if let Some(there) = was_here(library, wanted.as_ref()).await? {
            return Ok(there);
        }
        let brought = judge(library, &sender, &file, mode, &by).await?;
        let brought = Import { behaviour: wanted.clone().unwrap_or(brought.behaviour), ..brought };
        let finishing = finish(Arc::clone(library), Arc::clone(&file), mode, brought);
        match library.tasks.make(finishing).await.map_err(|error| Refused::Unreadable(error.to_string().into()))? {
            Err(no) if no.is_overtaken() => last = no,
            done => return done,
        }
    }
    Err(last)
}

/// The file, if its form and its records are as they should be.
fn read(body: &[u8]) -> Result<BehaviourFile, NotImported> {
    let mut looked = store::files::look(body);
    let Some(file) = looked.file.take() else {
        return Err(looked.faults.into_iter().next().map_or_else(|| Refused::NoBehaviour.into(), NotImported::from));
    };
    check_records(&file, &looked)?;
    check_name(&file.name)?;
    Ok(file)
}

/// What the records say of themselves, with the line.
fn check_records(file: &BehaviourFile, looked: &ReadFile) -> Result<(), NotImported> {
    let flaws = file.records(|_| None).err().unwrap_or_default();
    let faults: Vec<_> = flaws.iter().map(ToString::to_string).collect();
    looked.place(&faults).into_iter().next().map_or(Ok(()), |fault| Err(fault.into()))
}

async fn check_absent(library: &Arc<LibraryService>, file: &BehaviourFile) -> Result<(), NotImported> {
    let Some(id) = file.id.as_deref().and_then(|id| Id::new(id).ok()) else { return Ok(()) };
    let there = bounded(library.store.load(&id)).await.map_err(|error| store_no(&error))?;
    if there.is_none() && id != *library.rooms.library() {
        return Ok(());
    }
    Err(NotImported::Present)
}

/// What was imported under this id before, as an import that changes nothing.
async fn was_here(library: &LibraryService, wanted: Option<&Id>) -> Result<Option<Import>, NotImported> {
    let Some(id) = wanted else { return Ok(None) };
    let there = bounded(library.store.load(id)).await.map_err(|error| store_no(&error))?;
    Ok(there.map(|there| Import {
        behaviour: id.clone(),
        name: there.behaviour.name().to_owned(),
        library: None,
        changes: Vec::new(),
        renamed: Vec::new(),
    }))
}

/// What an import changes, if that keeps the rules. Nothing is saved.
pub(crate) async fn judge(
    library: &Arc<LibraryService>,
    sender: &Sender,
    file: &Arc<BehaviourFile>,
    mode: ImportMode,
    by: &str,
) -> Result<Import, Refused> {
    let (file, helpers, by) = (Arc::clone(file), library.rooms.snapshot(), by.to_owned());
    let knowing = Arc::clone(&library.knowing);
    let judged = library.workers.run(sender.clone(), move |cancel| {
        let new_id = || Id::from_uuid(Uuid::new_v4());
        let brought = store::files::import(&file, mode, &helpers.behaviour, &by, new_id);
        let brought = brought.map_err(|faults| unreadable(&faults))?;
        let until = Instant::now() + Duration::from_millis(CHECK_MS);
        let judge = Judge { knowing: &knowing, is_cancelled: || cancel.is_cancelled(), until };
        Room::rehearse(&brought.changes, &judge).map_err(Refused::Change)?;
        // The library's room asks the same again: its answers come last, so that they are still known there.
        Room::rehearse(brought.library.as_slice(), &judge).map_err(Refused::Change)?;
        Ok(brought)
    });
    judged.await?
}

fn unreadable(faults: &[ImportError]) -> Refused {
    Refused::Unreadable(Phrase::List(faults.iter().map(Phrased::phrase).collect()))
}

/// Saves what was judged. Whoever makes something else meanwhile waits only for this.
async fn finish(
    library: Arc<LibraryService>,
    file: Arc<BehaviourFile>,
    mode: ImportMode,
    brought: Import,
) -> Result<Import, NotImported> {
    shelve(&library, &brought).await?;
    let _one_at_a_time = library.creating.lock().await;
    if mode == ImportMode::Restore {
        check_absent(&library, &file).await?;
    }
    let name = bounded(free_name(&*library.store, file.name.trim())).await.map_err(|error| store_no(&error))?;
    let brought = brought.named(&name);
    save(&library, &brought).await?;
    Ok(brought)
}

/// Puts the helpers of an import into the library.
pub(crate) async fn shelve(library: &Arc<LibraryService>, brought: &Import) -> Result<(), Refused> {
    match brought.library.clone() {
        Some(change) => library.rooms.propose_to_library(change).await,
        None => Ok(()),
    }
}

/// True if somebody changed the library between judging and saving.
pub(crate) fn is_overtaken(no: &Refused) -> bool {
    matches!(no, Refused::Change(Refusal::Stale(_) | Refusal::NameTaken(_)))
}

async fn save(library: &Arc<LibraryService>, brought: &Import) -> Result<(), NotImported> {
    let (mut after, now_ms) = (Behaviour::default(), crate::support::now_ms());
    for (revision, change) in (1..).zip(&brought.changes) {
        after.apply(change);
        let made = Committed { revision, change: Change { at_ms: now_ms, ..change.clone() } };
        append(library, &brought.behaviour, &made, &after).await?;
        library.rooms.news().changed(&made);
    }
    Ok(())
}

/// What the rules ask about a file, for as long as its sender waits and a time. Answers are kept: a second try goes on
/// where the first one ended.
struct Judge<'a, C> {
    knowing: &'a Knowing,
    is_cancelled: C,
    until: Instant,
}

impl<C: Fn() -> bool> Knowledge for Judge<'_, C> {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), phrase::Phrase> {
        self.knowing.device(kind, device, params)
    }

    fn body(&self, arguments: &[String], body: &str) -> Result<(), phrase::Phrase> {
        if (self.is_cancelled)() {
            return Err(Unchecked::NobodyWaits.phrase());
        }
        if Instant::now() >= self.until {
            return Err(Unchecked::TooSlow.phrase());
        }
        self.knowing.body(arguments, body)
    }
}

#[cfg(test)]
mod tests {
    use super::{Judge, Knowing};
    use behaviour::Knowledge;
    use std::cell::Cell;
    use std::time::{Duration, Instant};

    #[test]
    fn judging_ends_with_its_sender_and_with_its_time() {
        let (knowing, gone) = (Knowing::default(), Cell::new(false));
        let judge = |ms: u64| {
            let until = Instant::now() + Duration::from_millis(ms);
            Judge { knowing: &knowing, is_cancelled: || gone.get(), until }
        };
        assert_eq!(judge(60_000).body(&[], "1"), Ok(()));
        assert!(judge(0).body(&[], "1").unwrap_err().to_string().contains("takes too long"));
        gone.set(true);
        assert!(judge(60_000).body(&[], "1").unwrap_err().to_string().contains("nobody waits"));
    }
}
