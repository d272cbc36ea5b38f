//! Behaviours out of files. Reading and judging a file is done by the workers and ends when its sender goes; then the
//! helpers and the behaviour are saved in one step that goes through whatever becomes of the sender.

use crate::library::create::{append, check_name};
use crate::library::list::free_name;
use crate::rooms::knowledge::Knowing;
use crate::state::Hub;
use crate::support::store_call::{bounded, store_no};
use crate::support::workers::Sender;
use axum::Json;
use axum::body::Bytes;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use behaviour::{
    Behaviour, BehaviourFile, Change, Committed, Id, Knowledge, NAME_MAX_CHARS, Params, Refusal, Room, StreamKind,
    without_unseen,
};
use protocol::SaidNo;
use serde::Deserialize;
use std::sync::Arc;
use std::time::{Duration, Instant};
use store::files::{FILE_MAX_BYTES, FileFault, Import, Looked, Mode};
use uuid::Uuid;

/// How often a file is tried when others change the library at the same moment.
pub(crate) const TRIES: usize = 5;
/// How long the procedures of a file may take to be checked.
const CHECK_MS: u64 = 2_000;

/// How a file is to be imported.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct How {
    #[serde(default)]
    mode: Wanted,
    /// Who imports it.
    by: Option<String>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Wanted {
    #[default]
    Copy,
    Restore,
}

/// Why a file was not imported: the status and the sentence.
#[derive(Debug)]
struct No {
    status: StatusCode,
    sentence: String,
    /// True if somebody else was quicker, so that it may go well another time.
    overtaken: bool,
}

impl No {
    fn new(status: StatusCode, sentence: impl ToString) -> Self {
        Self { status, sentence: sentence.to_string(), overtaken: false }
    }
}

impl From<SaidNo> for No {
    fn from(no: SaidNo) -> Self {
        let status = match no {
            SaidNo::Store(_) | SaidNo::TooFast => StatusCode::SERVICE_UNAVAILABLE,
            _ => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self { overtaken: is_overtaken(&no), ..Self::new(status, no) }
    }
}

impl From<FileFault> for No {
    fn from(fault: FileFault) -> Self {
        Self::new(StatusCode::BAD_REQUEST, fault)
    }
}

/// Imports a file, none if it was too large, and says what became of it.
pub(crate) async fn upload(hub: &Arc<Hub>, how: How, body: Option<Bytes>) -> Response {
    let too_large = format!("The file is larger than {FILE_MAX_BYTES} bytes. Split it into several.");
    let brought = match body {
        Some(body) => bring(hub, how, body).await,
        None => Err(No::new(StatusCode::PAYLOAD_TOO_LARGE, too_large)),
    };
    match brought {
        Ok(Import { behaviour, name, renamed, .. }) => {
            tracing::info!(%behaviour, "a behaviour was imported");
            Json(serde_json::json!({"id": behaviour, "name": name, "renamedHelpers": renamed})).into_response()
        }
        Err(No { status, sentence, .. }) => (status, Json(serde_json::json!({ "error": sentence }))).into_response(),
    }
}

async fn bring(hub: &Arc<Hub>, how: How, body: Bytes) -> Result<Import, No> {
    let sender = Sender::Request(hub.clients.number());
    let file = Arc::new(hub.workers.run(sender.clone(), move |_| read(&body)).await.map_err(SaidNo::from)??);
    let mode = if matches!(how.mode, Wanted::Restore) { Mode::Restore } else { Mode::Copy };
    let by: String = without_unseen(&how.by.unwrap_or_default()).chars().take(NAME_MAX_CHARS).collect();
    if mode == Mode::Restore {
        check_absent(hub, &file).await?;
    }
    let mut last = SaidNo::TooFast.into();
    for _ in 0..TRIES {
        let brought = judge(hub, &sender, &file, mode, &by).await?;
        let finishing = finish(Arc::clone(hub), Arc::clone(&file), mode, brought);
        match hub.spawn(finishing).await.map_err(|error| SaidNo::Unreadable(error.to_string()))? {
            Err(no) if no.overtaken => last = no,
            done => return done,
        }
    }
    Err(last)
}

/// The file, if its form and its records are as they should be.
fn read(body: &[u8]) -> Result<BehaviourFile, No> {
    let mut looked = store::files::look(body);
    let Some(file) = looked.file.take() else {
        return Err(looked.faults.into_iter().next().map_or_else(|| SaidNo::NoBehaviour.into(), No::from));
    };
    check_records(&file, &looked)?;
    check_name(&file.name)?;
    Ok(file)
}

/// What the records say of themselves, with the line.
fn check_records(file: &BehaviourFile, looked: &Looked) -> Result<(), No> {
    let faults = file.records(|_| None).err().unwrap_or_default();
    looked.place(&faults).into_iter().next().map_or(Ok(()), |fault| Err(fault.into()))
}

async fn check_absent(hub: &Arc<Hub>, file: &BehaviourFile) -> Result<(), No> {
    let Some(id) = file.id.as_deref().and_then(|id| Id::new(id).ok()) else { return Ok(()) };
    let there = bounded(hub.store.load(&id)).await.map_err(|error| store_no(&error))?;
    if there.is_none() && id != hub.library {
        return Ok(());
    }
    let sentence =
        "This behaviour is here already, perhaps in the bin. Import it as a copy, or restore it from the bin.";
    Err(No::new(StatusCode::CONFLICT, sentence))
}

/// What an import changes, if that keeps the rules. Nothing is saved.
pub(crate) async fn judge(
    hub: &Arc<Hub>,
    sender: &Sender,
    file: &Arc<BehaviourFile>,
    mode: Mode,
    by: &str,
) -> Result<Import, SaidNo> {
    let (file, shelf, knowing, by) = (Arc::clone(file), hub.shelf(), Arc::clone(&hub.knowing), by.to_owned());
    let judged = hub.workers.run(sender.clone(), move |cancel| {
        let new_id = || Id::from_uuid(Uuid::new_v4());
        let brought = store::files::import(&file, mode, &shelf.behaviour, &by, new_id);
        let brought = brought.map_err(|faults| SaidNo::Unreadable(faults.join("; ")))?;
        let until = Instant::now() + Duration::from_millis(CHECK_MS);
        let judge = Judge { knowing: &knowing, is_cancelled: || cancel.is_cancelled(), until };
        Room::rehearse(&brought.changes, &judge).map_err(SaidNo::Change)?;
        // The library's room asks the same again: its answers come last, so that they are still known there.
        Room::rehearse(brought.library.as_slice(), &judge).map_err(SaidNo::Change)?;
        Ok(brought)
    });
    judged.await?
}

/// Saves what was judged. Whoever makes something else meanwhile waits only for this.
async fn finish(hub: Arc<Hub>, file: Arc<BehaviourFile>, mode: Mode, brought: Import) -> Result<Import, No> {
    shelve(&hub, &brought).await?;
    let _one_at_a_time = hub.creating.lock().await;
    if mode == Mode::Restore {
        check_absent(&hub, &file).await?;
    }
    let name = free_name(&*hub.store, file.name.trim()).await.map_err(|error| store_no(&error))?;
    let brought = brought.named(&name);
    save(&hub, &brought).await?;
    Ok(brought)
}

/// Puts the helpers of an import into the library.
pub(crate) async fn shelve(hub: &Arc<Hub>, brought: &Import) -> Result<(), SaidNo> {
    match brought.library.clone() {
        Some(change) => hub.propose_to_library(change).await,
        None => Ok(()),
    }
}

/// Whether somebody changed the library between judging and saving.
pub(crate) fn is_overtaken(no: &SaidNo) -> bool {
    matches!(no, SaidNo::Change(Refusal::Stale(_) | Refusal::NameTaken(_)))
}

async fn save(hub: &Arc<Hub>, brought: &Import) -> Result<(), No> {
    let (mut after, now_ms) = (Behaviour::default(), crate::support::now_ms());
    for (revision, change) in (1..).zip(&brought.changes) {
        after.apply(change);
        let made = Committed { revision, change: Change { at_ms: now_ms, ..change.clone() } };
        append(hub, &brought.behaviour, &made, &after).await?;
        hub.programs.changed(&made);
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
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), String> {
        self.knowing.device(kind, device, params)
    }

    fn body(&self, arguments: &[String], body: &str) -> Result<(), String> {
        if (self.is_cancelled)() {
            return Err("nobody waits for it any more".to_owned());
        }
        if Instant::now() >= self.until {
            return Err("checking all procedures of the file takes too long; try again, or split the file".to_owned());
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
        assert!(judge(0).body(&[], "1").unwrap_err().contains("takes too long"));
        gone.set(true);
        assert!(judge(60_000).body(&[], "1").unwrap_err().contains("nobody waits"));
    }
}
