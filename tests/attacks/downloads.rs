//! Attacks by files: downloads that nobody reads, and imports that are slow to read.

use crate::target::{Target, fresh, note, note_id, nothing};
use behaviour::Id;
use futures_util::future::join_all;
use house::Outcome;
use protocol::request;
use serde_json::json;
use shell::Client;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

/// Downloads that nobody reads.
const UNREAD_BACKUPS: usize = 700;
const UNREAD_RECORDINGS: usize = 530;
/// The recording that is downloaded.
const RECORDING: &str = "2026-01-01T00-00-00Z-attack.jsonl";
/// Its readings.
const READINGS: usize = 100_000;
/// Senders of files.
const SENDERS: usize = 4;
/// Attributes of one element.
const ATTRIBUTES: usize = 180_000;
/// Helpers of one file, each of which calls the one before, or many.
const HELPERS: usize = 1_000;
/// Before who was turned away comes again.
const PAUSE: Duration = Duration::from_millis(200);

/// A recording in the data folder, before the server starts.
pub(crate) fn prepare(data: &Path) -> Outcome<()> {
    let mut text = r#"{"format":"rrp-recording/1","behaviour":"b","name":"Attack","revision":1,"mode":"event",
        "by":"","began":"2026-01-01T00:00:00Z","run":1,"robot":""}"#
        .replace(['\n', ' '], "");
    for at in 0..READINGS {
        write!(
            text,
            "\n{{\"t\":{at},\"stream\":\"ball\",\"value\":{{\"x\":0.1,\"y\":0.2,\"size\":0.3,\"time\":{at}}}}}"
        )?;
    }
    std::fs::create_dir_all(data.join("recordings"))?;
    Ok(std::fs::write(data.join("recordings").join(RECORDING), text + "\n")?)
}

/// A behaviour that is as large as the server lets one be, or a megabyte.
pub(crate) async fn fill(target: &Target) -> Outcome<()> {
    let (client, large) = (Client::connect(&target.url(), "Filler").await?, Id::new("large")?);
    client.ask(request::Create { behaviour: large.clone(), name: "Large".to_owned(), template: None }).await?;
    for _ in 0..25 {
        let notes = (0..10).map(|_| (note_id(&fresh("n")), Some(note(&"n".repeat(4_000))))).collect();
        let change = client.change("Fill", &nothing(), notes);
        if client.ask(request::Propose { behaviour: large.clone(), change, tokens: Vec::new() }).await.is_err() {
            break;
        }
    }
    Ok(())
}

/// Asks for backups and recordings and reads nothing; who is closed comes again.
pub(crate) async fn unread(target: Target) {
    let ask = |path: String| {
        let target = target.clone();
        async move {
            loop {
                unread_one(&target, &path).await;
                tokio::time::sleep(PAUSE).await;
            }
        }
    };
    let backups = (0..UNREAD_BACKUPS).map(|_| ask("/api/backup".to_owned()));
    let recordings = (0..UNREAD_RECORDINGS).map(|_| ask(format!("/api/recordings/{RECORDING}")));
    join_all(backups.map(tokio::spawn)).await;
    join_all(recordings.map(tokio::spawn)).await;
}

async fn unread_one(target: &Target, path: &str) {
    let Ok(mut stream) = TcpStream::connect(target.address).await else { return };
    let host = house::host_line(target.address);
    let request = format!("GET {path} HTTP/1.1\r\nHost: {}\r\n{host}\r\n", target.address);
    if stream.write_all(request.as_bytes()).await.is_ok() {
        // As long as the server holds on: it cannot write to the end of it.
        let closed = async {
            while stream.write_all(b"x").await.is_ok() {
                tokio::time::sleep(PAUSE).await
            }
        };
        closed.await;
    }
}

/// Sends files that once took very long to read; every other sender leaves in the middle.
pub(crate) async fn imports(target: Target) {
    let files = [attributes(), chained(), dense()];
    let all = (0..SENDERS).map(|number| {
        let (target, files) = (target.clone(), files.clone());
        async move {
            for file in files.iter().cycle() {
                let patience = if number % 2 == 0 { 60_000 } else { 100 };
                let sent = import(&target, file);
                drop(tokio::time::timeout(Duration::from_millis(patience), sent).await);
            }
        }
    });
    join_all(all.map(tokio::spawn)).await;
}

async fn import(target: &Target, file: &str) -> Outcome<()> {
    let mut stream = TcpStream::connect(target.address).await?;
    let head = format!(
        "POST /api/import HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\n{1}Content-Length: {2}\r\n\r\n",
        target.address,
        house::host_line(target.address),
        file.len()
    );
    stream.write_all(head.as_bytes()).await?;
    stream.write_all(file.as_bytes()).await?;
    stream.read_to_end(&mut Vec::new()).await?;
    Ok(())
}

/// One element with very many attributes.
fn attributes() -> String {
    let attributes = (0..ATTRIBUTES).map(|number| format!(" a{number}=\"\""));
    format!("<behaviour{}/>", attributes.collect::<String>())
}

fn chained() -> String {
    file((0..HELPERS).map(|number| match number {
        0 => "x + 1".to_owned(),
        _ => format!("h{}(x) + 1", number - 1),
    }))
}

fn dense() -> String {
    file((0..HELPERS).map(|number| {
        let calls = (number.saturating_sub(40)..number).map(|other| format!("h{other}(x)"));
        calls.chain(["1".to_owned()]).collect::<Vec<_>>().join(" + ")
    }))
}

fn file(bodies: impl Iterator<Item = String>) -> String {
    let helper = |(number, body)| json!({ "name": format!("h{number}"), "params": ["x"], "body": body });
    let helpers: Vec<_> = bodies.enumerate().map(helper).collect();
    let last = format!("h{}", HELPERS - 1);
    json!({
        "format": "rrp-behaviour/1", "name": "Attack", "helpers": helpers,
        "streams": [{ "id": "a", "kind": "sensor", "name": "A", "device": "RedBall" },
            { "id": "b", "kind": "ordinary", "name": "B" }],
        "connectors": [{ "id": "c", "type": "map", "inputs": ["a"], "output": "b", "helper": last }],
    })
    .to_string()
}
