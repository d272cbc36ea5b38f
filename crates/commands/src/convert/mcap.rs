//! MCAP, for programs that show what robots did: a channel each for what was sensed, told and done, in JSON. Times are since
//! Start.

use ::mcap::records::MessageHeader;
use ::mcap::{McapResult, Writer};
use recording::{Timeline, json};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Cursor;

/// The schema of each message: an object.
const SCHEMA: &[u8] = br#"{"type":"object"}"#;
/// Nanoseconds in a millisecond.
const NS: u64 = 1_000_000;

/// A message.
#[derive(Serialize)]
struct Message<'a, T> {
    value: T,
    #[serde(skip_serializing_if = "str::is_empty")]
    by: &'a str,
}

/// The file.
///
/// # Errors
/// If it could not be written.
pub(super) fn written(timeline: &Timeline) -> McapResult<Vec<u8>> {
    let mut file = Cursor::new(Vec::new());
    let mut to = Writer::new(&mut file)?;
    let schema = to.add_schema("rrp", "jsonschema", SCHEMA)?;
    let mut messages: Vec<(u64, String, String)> = Vec::new();
    for event in &timeline.events {
        let topic = topic(event.what.word(), &event.subject);
        let text = match &event.value {
            Some(value) => json(&Message { value, by: &event.by }),
            None => json(&Message { value: &event.says, by: &event.by }),
        };
        messages.push((event.at_ms, topic, text));
    }
    messages.extend(timeline.marks.iter().map(|mark| (mark.t, topic("mark", &mark.word), json(mark))));
    messages.sort_by_key(|(at_ms, ..)| *at_ms);
    let mut sequences: BTreeMap<u16, u32> = BTreeMap::new();
    for (at_ms, topic, text) in messages {
        let channel_id = to.add_channel(schema, &topic, "json", &BTreeMap::new())?;
        let sequence = sequences.entry(channel_id).and_modify(|number| *number += 1).or_default();
        let time = at_ms.saturating_mul(NS);
        let header = MessageHeader { channel_id, sequence: *sequence, log_time: time, publish_time: time };
        to.write_to_known_channel(&header, text.as_bytes())?;
    }
    to.finish()?;
    drop(to);
    Ok(file.into_inner())
}

/// `/action/eye-color`: what a channel is called.
fn topic(what: &str, subject: &str) -> String {
    let word = |text: &str| text.split_whitespace().collect::<Vec<_>>().join("-").replace('/', "-");
    if subject.is_empty() { format!("/{}", word(what)) } else { format!("/{}/{}", word(what), word(subject)) }
}
