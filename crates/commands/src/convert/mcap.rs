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
struct McapMessage<'a, T> {
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
            Some(value) => json(&McapMessage { value, by: &event.by }),
            None => json(&McapMessage { value: &event.says, by: &event.by }),
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

#[cfg(test)]
mod tests {
    use super::written;
    use recording::{PrivateParts, Timeline, timeline};
    use std::collections::BTreeSet;

    const RECORDING: &str = include_str!("../../../report/tests/data/greet.jsonl");
    const MARKS: &str = include_str!("../../../report/tests/data/greet.marks.jsonl");

    /// Returns the messages of an MCAP, each with its topic, its time in nanoseconds and its text.
    fn messages(bytes: &[u8]) -> Vec<(String, u64, String)> {
        let read = ::mcap::MessageStream::new(bytes).unwrap().map(|message| {
            let message = message.unwrap();
            assert_eq!(message.channel.message_encoding, "json");
            let text = String::from_utf8(message.data.into_owned()).unwrap();
            (message.channel.topic.clone(), message.log_time, text)
        });
        read.collect()
    }

    /// Returns the code of the one who did something with `subject`.
    fn by<'t>(of: &'t Timeline, subject: &str) -> &'t str {
        of.events.iter().find(|event| event.subject == subject && !event.by.is_empty()).map_or("", |event| &event.by)
    }

    #[test]
    fn no_name_is_in_it_unless_it_is_wanted() {
        let all = |keep| {
            let of = timeline(RECORDING, MARKS, keep).unwrap();
            messages(&written(&of).unwrap()).into_iter().map(|(.., text)| text).collect::<String>()
        };
        let names = ["Aiko", "Ben", "Cleo", "Emma", "banana"];
        let plain = all(PrivateParts::default());
        assert!(names.iter().all(|name| !plain.contains(name)) && plain.contains("P1"), "{plain}");
        let kept = all(PrivateParts { names: true, personal: true });
        assert!(names[1..].iter().all(|name| kept.contains(name)), "{kept}");
    }

    #[test]
    fn an_mcap_is_read_back_by_its_library() {
        let of = timeline(RECORDING, MARKS, PrivateParts::default()).unwrap();
        let bytes = written(&of).unwrap();
        let all = messages(&bytes);
        assert_eq!(all.len(), of.events.len() + of.marks.len());
        assert!(all.windows(2).all(|pair| pair[0].1 <= pair[1].1), "by time");
        let ball = all.iter().find(|(topic, ..)| topic == "/pretended/Ball").unwrap();
        assert_eq!(
            (ball.1, ball.2.as_str()),
            (50_000_000, format!(r#"{{"value":{{"x":0.1}},"by":"{}"}}"#, by(&of, "Ball")).as_str())
        );
        let topics: BTreeSet<&str> = all.iter().map(|(topic, ..)| topic.as_str()).collect();
        for topic in
            ["/sensed/Face", "/action/Eyes", "/by-hand/SayInput", "/mark/laughs", "/not-done/Say,-\"loud\"", "/robot"]
        {
            assert!(topics.contains(topic), "{topic} is not in {topics:?}");
        }
        let summary = ::mcap::Summary::read(&bytes).unwrap().expect("a summary at its end");
        assert_eq!(summary.stats.unwrap().message_count, all.len() as u64);
    }
}
