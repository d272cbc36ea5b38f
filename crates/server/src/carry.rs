//! Behaviours as files, out of the server and into it.

use crate::create::{append, check_name};
use crate::hub::{Hub, bounded, store_no};
use crate::programs::{free_name, names};
use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::rejection::BytesRejection;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use behaviour::{Behaviour, BehaviourFile, Change, Committed, Id, NAME_MAX_CHARS, Refusal, Room};
use protocol::SaidNo;
use serde::Deserialize;
use std::sync::Arc;
use store::files::{FILE_MAX_BYTES, FileFault, Import, Looked, Mode};
use uuid::Uuid;

/// Lines of a backup that wait to be sent.
const LINES_MAX: usize = 16;
/// How often a helper is offered to the library when others change it at the same moment.
const TRIES: usize = 5;

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
struct No(StatusCode, String);

impl From<SaidNo> for No {
    fn from(no: SaidNo) -> Self {
        let status = match no {
            SaidNo::Store(_) | SaidNo::TooFast => StatusCode::SERVICE_UNAVAILABLE,
            _ => StatusCode::UNPROCESSABLE_ENTITY,
        };
        Self(status, no.to_string())
    }
}

impl From<FileFault> for No {
    fn from(fault: FileFault) -> Self {
        Self(StatusCode::BAD_REQUEST, fault.to_string())
    }
}

/// A behaviour as a file to keep: `ID.json`, `ID.xml` or `ID.svg`.
pub(crate) async fn download(hub: &Arc<Hub>, file: &str) -> Response {
    let gone = |no: SaidNo| (StatusCode::NOT_FOUND, format!("{no}\n")).into_response();
    let (id, format) = file.rsplit_once('.').unwrap_or((file, ""));
    let (Ok(id), "json" | "xml" | "svg") = (Id::new(id), format) else { return gone(SaidNo::NoBehaviour) };
    let look = match hub.look(&id).await {
        Ok(look) if look.behaviour.settings().is_some() => look,
        Ok(_) | Err(SaidNo::NoBehaviour) => return gone(SaidNo::NoBehaviour),
        Err(no) => return (StatusCode::SERVICE_UNAVAILABLE, format!("{no}\n")).into_response(),
    };
    let mut file = BehaviourFile::of(&look.behaviour, &hub.shelf().helpers());
    file.id = Some(id.to_string());
    match format {
        "json" => attached(&file.name, format, "application/json", store::files::write_json(&file)),
        "svg" => attached(&file.name, format, "image/svg+xml", store::files::write_svg(&file)),
        _ => match store::files::write_xml(&file) {
            Ok(text) => attached(&file.name, format, "application/xml", text),
            Err(reason) => (StatusCode::UNPROCESSABLE_ENTITY, format!("{reason}\n")).into_response(),
        },
    }
}

/// Id and name of every behaviour that is not in the bin, by name.
pub(crate) async fn list(hub: &Hub) -> Response {
    let line = |(id, name): &(Id, String)| serde_json::json!({"id": id, "name": name});
    match names(&*hub.store).await {
        Ok(names) => Json(names.iter().map(line).collect::<Vec<_>>()).into_response(),
        Err(error) => (StatusCode::SERVICE_UNAVAILABLE, format!("{error}\n")).into_response(),
    }
}

/// Everything that is kept, line by line as it is read; the last line tells that nothing is missing.
pub(crate) fn backup(hub: &Arc<Hub>) -> Response {
    let (tell, told) = tokio::sync::mpsc::channel::<String>(LINES_MAX);
    let writing = Arc::clone(hub);
    hub.tasks.spawn(async move {
        let put = |line: String| {
            let tell = tell.clone();
            async move { tell.send(line).await.map_err(std::io::Error::other) }
        };
        let taken = store::backup::backup(&*writing.store, writing.epoch, put, &|_, _| {});
        match writing.stopping.run_until_cancelled(taken).await {
            Some(Ok(done)) => tracing::info!(?done, "a backup was taken"),
            Some(Err(error)) => tracing::warn!(%error, "a backup did not come to its end"),
            None => {}
        }
    });
    let lines = futures_util::stream::unfold(told, async |mut told| {
        let line = told.recv().await?;
        Some((Ok::<_, std::io::Error>(line), told))
    });
    let headers = [
        (header::CONTENT_TYPE, "application/jsonl"),
        (header::CONTENT_DISPOSITION, "attachment; filename=\"rrp.rrpbackup\""),
    ];
    (headers, Body::from_stream(lines)).into_response()
}

/// As a file to keep, named after the behaviour as far as letters of file names go.
fn attached(name: &str, ending: &str, kind: &str, text: String) -> Response {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let name: String = name.chars().take(60).map(plain).collect();
    let disposition = format!("attachment; filename=\"{name}.{ending}\"");
    let headers = [(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, disposition)];
    (headers, text).into_response()
}

/// Imports a file and says what became of it.
pub(crate) async fn upload(hub: &Arc<Hub>, how: How, body: Result<Bytes, BytesRejection>) -> Response {
    let too_large = format!("The file is larger than {FILE_MAX_BYTES} bytes. Split it into several.");
    let brought = match body {
        Ok(body) => bring(hub, how, body).await,
        Err(_) => Err(No(StatusCode::PAYLOAD_TOO_LARGE, too_large)),
    };
    match brought {
        Ok(brought) => {
            let Import { behaviour, name, renamed, .. } = brought;
            tracing::info!(%behaviour, "a behaviour was imported");
            Json(serde_json::json!({"id": behaviour, "name": name, "renamedHelpers": renamed})).into_response()
        }
        Err(No(status, sentence)) => (status, Json(serde_json::json!({ "error": sentence }))).into_response(),
    }
}

async fn bring(hub: &Arc<Hub>, how: How, body: Bytes) -> Result<Import, No> {
    let looked = tokio::task::spawn_blocking(move || store::files::look(&body)).await;
    let mut looked = looked.map_err(|error| SaidNo::Unreadable(error.to_string()))?;
    let Some(mut file) = looked.file.take() else {
        return Err(looked.faults.into_iter().next().map_or_else(|| SaidNo::NoBehaviour.into(), No::from));
    };
    check_records(&file, &looked)?;
    check_name(&file.name)?;
    let mode = if matches!(how.mode, Wanted::Restore) { Mode::Restore } else { Mode::Copy };
    let by = how.by.unwrap_or_default();
    let by: String = by.chars().filter(|c| !c.is_control()).take(NAME_MAX_CHARS).collect();
    let _one_at_a_time = hub.creating.lock().await;
    if mode == Mode::Restore {
        check_absent(hub, &file).await?;
    }
    let name = free_name(&*hub.store, file.name.trim()).await;
    file.name = name.map_err(|error| store_no(&error))?;
    let brought = shelve(hub, &Arc::new(file), mode, &by).await?;
    save(hub, &brought).await?;
    Ok(brought)
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
    Err(No(StatusCode::CONFLICT, sentence.to_owned()))
}

/// What an import changes, with its helpers in the library already; nothing is put there if a rule would be broken.
pub(crate) async fn shelve(hub: &Arc<Hub>, file: &Arc<BehaviourFile>, mode: Mode, by: &str) -> Result<Import, SaidNo> {
    let mut last = SaidNo::TooFast;
    for _ in 0..TRIES {
        let (file, shelf, knowing, by) = (Arc::clone(file), hub.shelf(), Arc::clone(&hub.knowing), by.to_owned());
        let judged = tokio::task::spawn_blocking(move || {
            let new_id = || Id::from_uuid(Uuid::new_v4());
            let brought = store::files::import(&file, mode, &shelf.behaviour, &by, new_id);
            let brought = brought.map_err(|faults| SaidNo::Unreadable(faults.join("; ")))?;
            Room::rehearse(&brought.changes, &*knowing).map_err(SaidNo::Change)?;
            Ok(brought)
        });
        let brought = judged.await.map_err(|error| SaidNo::Unreadable(error.to_string()))??;
        let Some(change) = brought.library.clone() else { return Ok(brought) };
        match hub.propose_to_library(change).await {
            Ok(()) => return Ok(brought),
            Err(no @ SaidNo::Change(Refusal::Stale(_) | Refusal::NameTaken(_))) => last = no,
            Err(no) => return Err(no),
        }
    }
    Err(last)
}

async fn save(hub: &Arc<Hub>, brought: &Import) -> Result<(), No> {
    let (mut after, now_ms) = (Behaviour::default(), crate::now_ms());
    for (revision, change) in (1..).zip(&brought.changes) {
        after.apply(change);
        let made = Committed { revision, change: Change { at_ms: now_ms, ..change.clone() } };
        append(hub, &brought.behaviour, &made, &after).await?;
        hub.programs.changed(&made);
    }
    Ok(())
}
