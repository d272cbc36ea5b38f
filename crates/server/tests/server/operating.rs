//! Operating: recorded from the middle of a run on, marked at the moment of the press, done by hand, and marked again later.

use crate::house::{House, connect, connector_id, printer, start, stream, stream_id};
use behaviour::{Id, Params, Record, StreamKind, Value, connectors};
use protocol::{Event, MarkSort, RecordedSession, Recording, RecordingMark, Refused, answer, request};
use shell::{Client, ClientError};
use std::sync::Arc;
use std::time::{Duration, Instant};
use store::MemoryStore;

async fn recordings(aiko: &Client) -> Vec<Recording> {
    let answer::Recordings { recordings } = aiko.ask(request::Recordings {}).await.unwrap();
    recordings
}

async fn marks(aiko: &Client, file: &str) -> Vec<RecordingMark> {
    let answer::Marks { marks, .. } = aiko.ask(request::Marks { file: file.to_owned() }).await.unwrap();
    marks
}

#[tokio::test]
async fn what_runs_is_recorded_marked_and_marked_again_later() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("head"), Some(Record::Stream(stream("Head", StreamKind::Sensor, Some("HeadTouch")))))
        .await
        .unwrap();
    aiko.put("Add", stream_id("out"), Some(printer("Out"))).await.unwrap();
    let through = connect(connectors::subscribe::SPEC.with(()), &["head"], "out");
    aiko.put("Add", connector_id("c"), Some(through)).await.unwrap();
    let (behaviour, robot) = (play.clone(), None);
    let session = RecordedSession { participant: Some("C-07".to_owned()), ..RecordedSession::default() };
    let record = request::Record { behaviour: behaviour.clone(), robot: None, session };
    assert_eq!(aiko.ask(record.clone()).await, Err(ClientError::No(Refused::NotRunning)));
    aiko.ask(start(&behaviour)).await.unwrap();
    aiko.ask(record).await.unwrap();
    let value = Value::Int(7);
    aiko.ask(request::Stimulate { behaviour: play.clone(), robot: None, stream: "head".parse().unwrap(), value })
        .await
        .unwrap();
    let hand = |device: &str| {
        let (device, params, value) = (device.to_owned(), Params::default(), Value::text("Hello"));
        aiko.ask(request::Hand { robot: None, device, params, value })
    };
    assert_eq!(hand("SayInput").await, Ok(()));
    assert!(
        matches!(hand("Dance").await, Err(ClientError::No(Refused::RobotCannot(why))) if why.to_string().contains("Dance"))
    );
    aiko.ask(request::Mark::with_note(play.clone(), None, "she smiles", 86_400_000)).await.unwrap();
    aiko.ask(request::Stop { behaviour: None, robot }).await.unwrap();
    let began = Instant::now();
    let listed = loop {
        let listed = recordings(&aiko).await;
        if listed.first().is_some_and(|one| one.marks.is_some()) {
            break listed;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "it never ends: {listed:?}");
    };
    let [known] = &listed[..] else { panic!("{listed:?}") };
    assert_eq!((known.session.participant.as_deref(), known.by.as_str(), known.marks), (Some("C-07"), "Aiko", Some(1)));
    let first = marks(&aiko, &known.file).await;
    assert_eq!((first[0].t, first[0].note.as_str(), first[0].by.as_str()), (0, "she smiles", "Aiko"));
    let (file, id) = (known.file.clone(), Id::new("m1").unwrap());
    let mark =
        RecordingMark { id, t: 5, until: Some(9), word: "laughs".to_owned(), sort: MarkSort::Good, ..first[0].clone() };
    aiko.ask(request::PutMark { file: file.clone(), mark: Box::new(mark.clone()) }).await.unwrap();
    assert_eq!(marks(&aiko, &file).await.len(), 2);
    aiko.ask(request::PutMark { file: file.clone(), mark: Box::new(RecordingMark { gone: true, ..mark }) })
        .await
        .unwrap();
    assert_eq!(marks(&aiko, &file).await, first);
    let path = folder.path().join("recordings").join(&file);
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains(r#""hand":"SayInput""#) && text.contains(r#""by":"Aiko""#), "{text}");
    let Ok(()) = aiko.ask(request::RemoveRecording { file: file.clone() }).await else { panic!() };
    assert_eq!(aiko.ask(request::Marks { file }).await, Err(ClientError::No(Refused::NoRecording)));
    // A name is no code, and such a Start does not begin.
    let session = RecordedSession { participant: Some("Emma Smith".to_owned()), ..RecordedSession::default() };
    let no = aiko.ask(request::Start { behaviour: play, robot: None, record: true, session }).await.unwrap_err();
    assert!(no.to_string().contains("is no name"), "{no}");
    house.close().await;
}

#[tokio::test]
async fn everyone_is_told_who_pressed_what_and_what_became_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut yuki = house.person("Yuki").await;
    aiko.put("Add", stream_id("head"), Some(Record::Stream(stream("Head", StreamKind::Sensor, Some("HeadTouch")))))
        .await
        .unwrap();
    aiko.put("Add", stream_id("out"), Some(printer("Out"))).await.unwrap();
    let through = connect(connectors::subscribe::SPEC.with(()), &["head"], "out");
    aiko.put("Add", connector_id("c"), Some(through)).await.unwrap();
    aiko.ask(start(&play)).await.unwrap();
    let pretend = |value: Value| request::Stimulate {
        behaviour: play.clone(),
        robot: None,
        stream: "head".parse().unwrap(),
        value,
    };
    aiko.ask(pretend(Value::Int(7))).await.unwrap();
    aiko.ask(pretend(Value::text("x".repeat(5_000)))).await.unwrap();
    let hand = |device: &str| {
        let (device, params, value) = (device.to_owned(), Params::default(), Value::text("Hello"));
        aiko.ask(request::Hand { robot: None, device, params, value })
    };
    hand("SayInput").await.unwrap();
    hand("Dance").await.unwrap_err();
    let mut told = Vec::new();
    while told.len() < 4 {
        if let Event::Pressed { press } = yuki.until(|told| matches!(told, Event::Pressed { .. })).await.unwrap() {
            assert_eq!((&press.client, press.by.as_str()), (&aiko.you().client, "Aiko"));
            told.push((press.what.to_string(), press.pretended, press.value, press.why.is_some()));
        }
    }
    let (seven, hello) = (Value::Int(7), Value::text("Hello"));
    // A value that is larger than any tile's is of no tile, and is not carried to everyone.
    let wanted = [
        ("head".to_owned(), true, seven, false),
        ("head".to_owned(), true, Value::Null, false),
        ("SayInput".to_owned(), false, hello.clone(), false),
        ("Dance".to_owned(), false, hello, true),
    ];
    assert_eq!(told, wanted);
    house.close().await;
}
