//! A recorded session for tests that look back: ten minutes with a ball, as a file in the data folder of a server.

use crate::{Outcome, Trouble};
use behaviour::{BehaviourFile, Id, Kind};
use protocol::request;
use serde_json::json;
use shell::{Client, ClientError};
use std::fmt::Write;
use std::path::Path;

/// The name of the file.
pub const SESSION: &str = "2026-11-24T11-54-17Z-tracker.jsonl";
/// The length of the session, in milliseconds.
pub const SESSION_MS: u64 = 600_000;
/// The program that ran.
const PROGRAM: &str = include_str!("../behaviours/track_far_and_close.json");
/// The time between two readings, in milliseconds.
const EVERY_MS: u64 = 200;
/// The ball is seen for so long, and then away for so long, in milliseconds.
const SEEN_MS: u64 = 20_000;
const AWAY_MS: u64 = 10_000;

/// Puts the session into the data folder of a server that does not run yet.
///
/// # Errors
/// If the file cannot be written.
pub fn keep_session(data: &Path) -> Outcome<()> {
    keep_session_of(data, "tracker", PROGRAM)
}

/// Puts the session into the data folder of a server as one of the program with this id, told as a file.
///
/// # Errors
/// If the file cannot be written, or the program has other streams.
pub fn keep_session_of(data: &Path, id: &str, program: &str) -> Outcome<()> {
    let folder = data.join("recordings");
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join(SESSION), session(id, program)?)?;
    Ok(())
}

/// Saves the program that ran, under the ids that it had then, on a server that runs.
///
/// # Errors
/// If the server does not take it.
pub async fn keep_session_program(url: &str) -> Outcome<Client> {
    // It has its work in itself: helpers are those of the library.
    let text =
        PROGRAM.replace(r#""helper": "ball_to_distance""#, r#""args": ["ball"], "body": "0.03 / sin(ball.size)""#);
    let file: BehaviourFile = serde_json::from_str(&text)?;
    let flawed = |flaws| Trouble(format!("{flaws:?}"));
    let records = file.records(|_| None).map_err(flawed)?.records;
    let said = |why: ClientError| Trouble(why.to_string());
    let client = Client::connect(url, "Yuki").await.map_err(said)?;
    let behaviour = Id::new("tracker").map_err(|why| Trouble(format!("{why:?}")))?;
    let create = request::Create { behaviour: behaviour.clone(), name: file.name.clone(), template: None };
    client.ask(create).await.map_err(said)?;
    let now = client.load(&behaviour).await.map_err(said)?.records;
    let records = records.into_iter().filter(|(id, _)| id.kind != Kind::Settings);
    let change = client.change("Add all of it", &now, records.map(|(id, record)| (id, Some(record))).collect());
    client.ask(request::Propose { behaviour, change, tokens: Vec::new() }).await.map_err(said)?;
    Ok(client)
}

fn session(id: &str, program: &str) -> Outcome<String> {
    let program: serde_json::Value = serde_json::from_str(program)?;
    let stream = |name: &str| -> Outcome<String> {
        let streams = program["streams"].as_array().into_iter().flatten();
        let named = streams.filter(|stream| stream["name"] == name).find_map(|stream| stream["id"].as_str());
        Ok(named.ok_or_else(|| Trouble(format!("The program has no stream “{name}”.")))?.to_owned())
    };
    let (ball, head, body) = (stream("Ball")?, stream("Head tracker")?, stream("Head and body tracker")?);
    let header = json!({
        "format": "rrp-recording/2", "behaviour": id, "name": "Track far and close balls", "revision": 1, "mode": "event",
        "by": "Aiko", "began": "2026-11-24T11:54:17Z", "run": 1, "robot": "NAO", "participant": "P-07",
    });
    let mut lines = format!("{header}\n{}\n", json!({ "t": 0, "mark": "file", "revision": 1, "file": &program }));
    for t in (0..SESSION_MS).step_by(EVERY_MS as usize) {
        let (into, round) = (t % (SEEN_MS + AWAY_MS), t / (SEEN_MS + AWAY_MS));
        if into < SEEN_MS {
            // It comes nearer and goes away again, each time a little further.
            let way = (into as f64 / SEEN_MS as f64 - 0.5).abs() * 2.0;
            let size = 0.035 + 0.05 * (1.0 - way) + 0.001 * (round % 7) as f64;
            let seen = json!({ "x": 0.2 - 0.02 * round as f64, "y": 0.05, "size": size, "time": t });
            writeln!(lines, "{}", json!({ "t": t, "stream": ball, "value": seen }))?;
            let distance = 0.03 / size.sin();
            let action = if distance >= 0.5 { &head } else { &body };
            writeln!(lines, "{}", json!({ "t": t, "stream": action, "value": distance }))?;
        }
        for (at, note) in [(150_000, "laughs"), (300_000, "looks away"), (420_000, "asks for it"), (580_000, "laughs")]
        {
            if at == t {
                writeln!(lines, "{}", json!({ "t": t, "mark": "note", "by": "Yuki", "note": note }))?;
            }
        }
    }
    writeln!(
        lines,
        "{}",
        json!({ "t": SESSION_MS, "mark": "end", "closed": SESSION_MS, "late": 0, "why": "it was stopped", "by": "Aiko" })
    )?;
    Ok(lines)
}
