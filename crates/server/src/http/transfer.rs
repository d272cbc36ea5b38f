//! Behaviours as files, out of the server.

use crate::library::list::names;
use crate::state::ServerState;
use crate::support::file_name::disposition;
use crate::support::identity::Sender;
use crate::support::store_call::bounded;
use axum::Json;
use axum::body::Body;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use behaviour::{BehaviourFile, Id};
use protocol::Refused;
use std::sync::Arc;

/// Lines of a backup that wait to be sent.
const LINES_MAX: usize = 1;

/// A behaviour as a file to keep: `ID.json`, `ID.xml` or `ID.svg`.
pub(crate) async fn download(state: &ServerState, sender: Sender, file: &str) -> Response {
    let rooms = &state.rooms;
    let gone = |no: Refused| (StatusCode::NOT_FOUND, format!("{no}\n")).into_response();
    let (id, format) = file.rsplit_once('.').unwrap_or((file, ""));
    let (Ok(id), "json" | "xml" | "svg") = (Id::new(id), format) else { return gone(Refused::NoBehaviour) };
    let look = match rooms.look(&id).await {
        Ok(look) if look.behaviour().settings().is_some() => look,
        Ok(_) | Err(Refused::NoBehaviour) => return gone(Refused::NoBehaviour),
        Err(no) => return (StatusCode::SERVICE_UNAVAILABLE, format!("{no}\n")).into_response(),
    };
    let (snapshot, format) = (rooms.snapshot(), format.to_owned());
    let written = state.workers.run(sender, move |_| {
        let mut file = BehaviourFile::of(look.behaviour(), &snapshot.helpers());
        file.id = Some(id.to_string());
        write(&file, &format)
    });
    written
        .await
        .unwrap_or_else(|why| (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::from(why))).into_response())
}

/// A behaviour as a file of this format.
fn write(file: &BehaviourFile, format: &str) -> Response {
    match format {
        "json" => attached(&file.name, format, "application/json", store::files::write_json(file)),
        "svg" => attached(&file.name, format, "image/svg+xml", store::files::write_svg(file)),
        _ => match store::files::write_xml(file) {
            Ok(text) => attached(&file.name, format, "application/xml", text),
            Err(reason) => (StatusCode::UNPROCESSABLE_ENTITY, format!("{reason}\n")).into_response(),
        },
    }
}

/// Id and name of every behaviour that is not in the bin, by name.
pub(crate) async fn list(state: &ServerState, sender: &Sender) -> Response {
    let line = |(id, name): &(Id, String)| serde_json::json!({"id": id, "name": name});
    let Some(_turn) = state.lookups.turn(sender).await else {
        return (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::TooFast)).into_response();
    };
    match bounded(names(&*state.store)).await {
        Ok(names) => Json(names.iter().map(line).collect::<Vec<_>>()).into_response(),
        Err(error) => (StatusCode::SERVICE_UNAVAILABLE, format!("{error}\n")).into_response(),
    }
}

/// Everything that is kept, line by line as it is read; the last line tells that nothing is missing.
pub(crate) fn backup(state: &Arc<ServerState>, sender: Sender) -> Response {
    let (tell, told) = tokio::sync::mpsc::channel::<String>(LINES_MAX);
    let writing = Arc::clone(state);
    state.tasks.spawn(async move {
        let put = |line: String| {
            let tell = tell.clone();
            async move { tell.send(line).await.map_err(std::io::Error::other) }
        };
        let kept = writing.robots.clone();
        let Ok(robots) = writing.files.run(sender, move |_| kept.kept()).await else { return };
        let taken = store::backup::backup(&*writing.store, writing.epoch, &robots, put, &|_, _| {});
        match writing.tasks.until_end(taken).await {
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

/// As a file to keep, named after the behaviour.
fn attached(name: &str, ending: &str, kind: &str, text: String) -> Response {
    let headers = [(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, disposition(name, ending))];
    (headers, text).into_response()
}
