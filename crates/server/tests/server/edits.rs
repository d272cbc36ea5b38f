//! Editing together: in order, once, and only what the rules allow.

use crate::house::{House, ball, connect, connector_id, id, make, map, plain, printer, sentence, stream, stream_id};
use behaviour::{Parameters, Procedure, Record, RecordId, Refusal, StreamKind, connectors};
use protocol::{Event, Refused, answer, request};
use shell::{ClientError, Mirror};

#[tokio::test]
async fn two_people_see_each_edit_in_order() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    for number in 0..20 {
        let record = plain(&format!("Stream {number}"));
        aiko.put("Add", stream_id(&format!("s{number}")), Some(record)).await.unwrap();
    }
    for number in 0..20 {
        let told = ben.until(|reply| matches!(reply, Event::Accepted { .. })).await.unwrap();
        let Event::Accepted { accepted, .. } = told else { panic!() };
        assert_eq!(accepted.revision, 2 + number);
        assert_eq!(accepted.change.author, "Aiko");
        assert!(accepted.change.at_ms > 0);
    }
    assert_eq!(aiko.open(), ben.open());
    house.close().await;
}

#[tokio::test]
async fn many_writers_end_with_the_same_behaviour() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut writers = Vec::new();
    for number in 0..5 {
        let writer = house.person(&format!("Writer {number}")).await;
        writer.load(&play).await.unwrap();
        writers.push(tokio::spawn(async move {
            for at in 0..10 {
                let name = format!("w{number}n{at}");
                writer.put("Add", stream_id(&name), Some(plain(&name))).await.unwrap();
            }
            writer
        }));
    }
    let mut all = vec![aiko];
    for writer in writers {
        all.push(writer.await.unwrap());
    }
    for client in &mut all {
        while client.open().unwrap().revision < 51 {
            client.until(|reply| matches!(reply, Event::Accepted { .. })).await.unwrap();
        }
    }
    assert!(all.windows(2).all(|pair| pair[0].open() == pair[1].open()));
    assert_eq!(all[0].open().unwrap().records.streams().count(), 50);
    house.close().await;
}

#[tokio::test]
async fn who_saw_an_older_state_is_refused() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("a"), Some(plain("One"))).await.unwrap();
    let before = aiko.open().unwrap().records;
    aiko.put("Rename", stream_id("a"), Some(plain("Two"))).await.unwrap();
    let late = aiko.change("Rename", &before, vec![(stream_id("a"), Some(plain("Three")))]);
    let answer = aiko.ask(request::Propose { behaviour: play, change: late, tokens: Vec::new() }).await;
    assert_eq!(answer, Err(ClientError::No(Refused::Change(Refusal::Stale("“Two”".into())))));
    assert_eq!(aiko.open().unwrap().revision, 3);
    house.close().await;
}

#[tokio::test]
async fn a_change_sent_twice_is_made_once_and_answered_the_same_also_after_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::at(folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    let change = aiko.change("Add", &aiko.open().unwrap().records, vec![(stream_id("a"), Some(plain("One")))]);
    let propose = || request::Propose { behaviour: play.clone(), change: change.clone(), tokens: Vec::new() };
    let first = aiko.ask(propose()).await.unwrap();
    assert_eq!(aiko.ask(propose()).await.unwrap(), first);
    house.close().await;
    let house = House::at(folder.path()).await;
    let aiko = house.person("Aiko").await;
    assert_eq!(aiko.ask(propose()).await.unwrap(), first);
    assert_eq!(aiko.load(&play).await.unwrap().revision, 2);
    house.close().await;
}

#[tokio::test]
async fn an_op_id_stands_for_one_change_for_ever_also_after_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::at(folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    let change = aiko.change("Add", &aiko.open().unwrap().records, vec![(stream_id("a"), Some(plain("One")))]);
    let other = aiko.change("Add", &aiko.open().unwrap().records, vec![(stream_id("b"), Some(plain("Two")))]);
    let bad = behaviour::Change { edits: vec![change.edits[0].clone(), change.edits[0].clone()], ..change.clone() };
    let other = behaviour::Change { op: change.op.clone(), ..other };
    let undo = crate::history::take_back(&play, change.op.as_str(), false);
    let propose = |change: &behaviour::Change| request::Propose {
        behaviour: play.clone(),
        change: change.clone(),
        tokens: Vec::new(),
    };
    let first = aiko.ask(propose(&change)).await.unwrap();
    let reused = Err(ClientError::No(Refused::Change(Refusal::Reused)));
    for answer in [aiko.ask(propose(&other)).await, aiko.ask(propose(&bad)).await, aiko.ask(undo.clone()).await] {
        assert_eq!(answer, reused);
    }
    house.close().await;
    let house = House::at(folder.path()).await;
    let aiko = house.person("Aiko").await;
    for answer in [aiko.ask(propose(&other)).await, aiko.ask(propose(&bad)).await, aiko.ask(undo).await] {
        assert_eq!(answer, reused);
    }
    assert_eq!(aiko.ask(propose(&change)).await.unwrap(), first);
    assert_eq!(aiko.load(&play).await.unwrap().revision, 2);
    house.close().await;
}

#[tokio::test]
async fn every_bad_change_is_refused_with_a_sentence_and_changes_nothing() {
    let house = House::open().await;
    let (aiko, _) = house.maker("Aiko").await;
    let good = [
        (stream_id("ball"), ball("Red ball")),
        (stream_id("far"), plain("Far")),
        (stream_id("near"), plain("Near")),
        (stream_id("out"), printer("Out")),
        (connector_id("c1"), map("redBall.x", "ball", "far")),
        (connector_id("c2"), map("far", "far", "near")),
    ];
    for (id, record) in good {
        aiko.put("Add", id, Some(record)).await.unwrap();
    }
    let before = aiko.open().unwrap();
    let sample = |period_ms| connect(connectors::sample::SPEC.with(Parameters::period(period_ms)), &["near"], "new");
    let bad: Vec<(&str, RecordId, Option<Record>)> = vec![
        ("cycle", connector_id("c1"), Some(map("near", "near", "far"))),
        ("second input", connector_id("c3"), Some(map("redBall", "ball", "near"))),
        ("into a sensor", connector_id("c3"), Some(map("far", "far", "ball"))),
        ("out of an actuator", connector_id("c3"), Some(map("out", "out", "near"))),
        ("only subscribe", connector_id("c3"), Some(map("far", "far", "out"))),
        ("subscribe end", connector_id("c3"), Some(connect(connectors::subscribe::SPEC.with(()), &["ball"], "far"))),
        (
            "two inputs",
            connector_id("c3"),
            Some(connect(connectors::subscribe::SPEC.with(()), &["ball", "far"], "out")),
        ),
        ("input twice", connector_id("c2"), Some(connect(connectors::merge::SPEC.with(()), &["far", "far"], "near"))),
        ("missing stream", connector_id("c3"), Some(map("nowhere", "nowhere", "near"))),
        ("stream in use", stream_id("far"), None),
        ("does not compile", connector_id("c2"), Some(map("far +", "far", "near"))),
        ("unknown variable", connector_id("c2"), Some(map("farr", "far", "near"))),
        ("too long a body", connector_id("c2"), Some(map(&"1+".repeat(9_000), "far", "near"))),
        ("rate", connector_id("c4"), Some(sample(0))),
        ("unknown device", stream_id("x"), Some(Record::Stream(stream("X", StreamKind::Sensor, Some("Laser"))))),
        ("no device", stream_id("x"), Some(Record::Stream(stream("X", StreamKind::Sensor, None)))),
        ("a name of 9,000 characters", stream_id("x"), Some(plain(&"x".repeat(9_000)))),
        ("no name", stream_id("x"), Some(plain(" "))),
        ("control characters", stream_id("x"), Some(plain("a\u{7}b"))),
        ("a name twice", stream_id("x"), Some(plain("Far"))),
        ("another kind", stream_id("x"), Some(map("far", "far", "near"))),
        ("no settings", RecordId::settings(), None),
        ("a helper in a behaviour", RecordId::new(behaviour::Kind::Helper, &id("h")), Some(helper("h"))),
    ];
    for (what, id, record) in bad {
        let no = sentence(aiko.put("Bad", id, record).await);
        assert!(no.ends_with('.') && no.len() < 400, "{what}: {no}");
        assert_eq!(aiko.open().unwrap(), before, "{what}");
    }
    let ping = aiko.ask(request::Since { behaviour: before.behaviour.clone(), revision: 0 }).await.unwrap();
    let answer::Newer::Missed(answer::Missed { changes, .. }) = ping else { panic!("{ping:?}") };
    assert_eq!(changes.len() as u64, before.revision);
    house.close().await;
}

fn helper(name: &str) -> Record {
    let params = vec!["v".to_owned()];
    Record::Helper(behaviour::Helper { name: name.into(), params, body: "v".into(), ..behaviour::Helper::default() })
}

#[tokio::test]
async fn a_helper_in_use_cannot_be_removed_or_renamed() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let play = make(&aiko, "Far", Some("Track far and close balls")).await;
    let opened = aiko.load(&play).await.unwrap();
    let library = aiko.library();
    let (used, record) = used_helper(&opened, &library);
    let renamed = behaviour::Helper { name: "renamed".into(), ..record.clone() };
    for after in [None, Some(Record::Helper(renamed))] {
        let change = aiko.change("Remove", &library.records, vec![(used.clone(), after)]);
        let no = aiko.ask(request::Propose { behaviour: id("library"), change, tokens: Vec::new() }).await.unwrap_err();
        let ClientError::No(Refused::Change(Refusal::HelperUsed(name, users))) = no else { panic!("{no:?}") };
        assert_eq!((name, users), (record.name.clone(), vec!["“Far”".to_owned()]));
    }
    let edited = behaviour::Helper { says: "Other words.".into(), ..record.clone() };
    let change = aiko.change("Edit", &library.records, vec![(used, Some(Record::Helper(edited)))]);
    aiko.ask(request::Propose { behaviour: id("library"), change, tokens: Vec::new() }).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn a_change_of_a_helper_is_told_to_everyone_and_shows_problems() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let play = make(&aiko, "Far", Some("Track far and close balls")).await;
    let mut ben = house.person("Ben").await;
    let opened = ben.load(&play).await.unwrap();
    let library = aiko.library();
    let (used, record) = used_helper(&opened, &library);
    let emptied = behaviour::Helper { body: String::new(), ..record.clone() };
    let edit = (used, Some(Record::Helper(emptied)));
    let change = aiko.change("Empty", &library.records, vec![edit]);
    aiko.ask(request::Propose { behaviour: id("library"), change, tokens: Vec::new() }).await.unwrap();
    let blocks = |reply: &Event| matches!(reply, Event::Problems { problems, .. } if problems.iter().any(|p| p.blocks));
    ben.until(blocks).await.unwrap();
    assert_eq!(ben.library(), aiko.library());
    house.close().await;
}

/// A helper of the library that a connector names.
fn used_helper(opened: &Mirror, library: &Mirror) -> (RecordId, behaviour::Helper) {
    let uses = |name: &str| {
        let names = |c: &behaviour::Connector| c.operation.procedure() == Some(&Procedure::Helper(name.to_owned()));
        opened.records.connectors().any(|(_, connector)| names(connector))
    };
    let found = library.records.helpers().find(|(_, helper)| uses(&helper.name));
    let (id, helper) = found.expect("the template uses a helper");
    (RecordId::new(behaviour::Kind::Helper, id), helper.clone())
}
