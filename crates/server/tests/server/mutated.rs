//! Messages that are almost ours: changed byte by byte, by a seed that is told. Nothing fails, and the link goes on.

use crate::house::{House, id, map, plain, stream_id};
use crate::links::socket;
use behaviour::{Behaviour, Change, SeenKinds, ValueType};
use futures_util::{SinkExt, StreamExt};
use protocol::{AnyRequest, Ask, ListQuery, LookedMoment, PastOf, VERSION, request};
use std::time::Duration;
use tokio_tungstenite::tungstenite::Message;

/// Messages of one link, and links. Fewer than its bucket holds, so that every one is looked at.
const MESSAGES: u32 = 150;
const LINKS: u64 = 8;
/// What means something in our messages.
const MARKS: &[u8] = b"{}[]\",:0-e";

/// A number from the last one (splitmix64).
fn next(state: &mut u64) -> usize {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (mixed ^ (mixed >> 31)) as usize
}

fn samples() -> Vec<String> {
    let now = Behaviour::default();
    let change = Change::of(id("op"), "Aiko", "Add").put(&now, stream_id("s"), plain("S"));
    let change = change.put(&now, crate::house::connector_id("m"), map("s + 1", "s", "t"));
    let requests: [AnyRequest; 12] = [
        request::List { query: ListQuery::default() }.into(),
        request::Open { behaviour: id("b") }.into(),
        request::Propose { behaviour: id("b"), change: change.clone(), tokens: Vec::new() }.into(),
        request::Propose { behaviour: id(protocol::LIBRARY), change, tokens: Vec::new() }.into(),
        request::Since { behaviour: id("b"), revision: 0 }.into(),
        request::Check { arguments: vec!["x".into()], body: "x + 1".into(), inputs: vec![vec![1.into()]] }.into(),
        request::Types { behaviour: id("b"), seen: SeenKinds::from([(id("s"), ValueType::Text)]) }.into(),
        request::Start { behaviour: id("b"), robot: None, record: true, session: protocol::RecordedSession::default() }
            .into(),
        request::Stimulate { behaviour: id("b"), robot: None, stream: id("s"), value: 1.into() }.into(),
        request::Present { pointer: None, selected: Some(id("s")), view: None }.into(),
        request::PresentMoment {
            at: Some(LookedMoment { past: PastOf::Run(1), at_ms: 10, clock_ms: 20, with: Some(id("c")) }),
        }
        .into(),
        request::CallMe { name: "Aiko".to_owned() }.into(),
    ];
    let asks = requests.into_iter().zip(1..).map(|(request, ask)| Ask::new(ask, request));
    asks.map(|ask| serde_json::to_string(&ask).unwrap()).collect()
}

/// One to four bytes replaced, cut out or doubled, as far as it stays a text.
fn mutated(text: &str, state: &mut u64) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=next(state) % 4 {
        let at = next(state) % bytes.len();
        match next(state) % 4 {
            0 => bytes[at] = b' ' + (next(state) % 95) as u8,
            1 => drop(bytes.drain(at..(at + 1 + next(state) % 8).min(bytes.len()))),
            2 => bytes.extend_from_within(at..),
            _ => bytes.insert(at, MARKS[next(state) % MARKS.len()]),
        }
        if bytes.is_empty() {
            bytes.push(b'{');
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[tokio::test]
async fn messages_that_are_almost_ours_break_nothing() {
    let (house, samples) = (House::open().await, samples());
    for seed in 1..=LINKS {
        let (mut state, mut link) = (seed, socket(&house).await);
        let hello = Ask::new(0, request::Hello { version: VERSION, name: "Seed".into(), again: None });
        link.send(Message::text(serde_json::to_string(&hello).unwrap())).await.unwrap();
        for _ in 0..MESSAGES {
            let text = mutated(&samples[next(&mut state) % samples.len()], &mut state);
            link.send(Message::text(text)).await.unwrap();
        }
        let list = Ask::new(u32::MAX, request::Runs {});
        link.send(Message::text(serde_json::to_string(&list).unwrap())).await.unwrap();
        let answered = async {
            while let Some(Ok(message)) = link.next().await {
                if message.to_text().is_ok_and(|text| text.contains("4294967295")) {
                    return true;
                }
            }
            false
        };
        let answered = tokio::time::timeout(Duration::from_secs(20), answered).await;
        assert_eq!(answered, Ok(true), "seed {seed}");
    }
    house.person("Aiko").await;
    house.close().await;
}
