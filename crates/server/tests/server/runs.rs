//! Running: problems stop Start, Stop stops, values come.

use crate::house::{House, ball, connect, connector_id, id, make, map, plain, printer, start, stream, stream_id};
use behaviour::{SeenKinds, Value, connectors};
use protocol::{Event, Refused, RunPhase, answer, request};
use shell::ClientError;

#[tokio::test]
async fn problems_stop_start() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("ball"), Some(ball("Red ball"))).await.unwrap();
    aiko.put("Add", stream_id("far"), Some(plain("Far"))).await.unwrap();
    aiko.put("Add", connector_id("c"), Some(map("", "ball", "far"))).await.unwrap();
    let no = aiko.ask(start(&play)).await.unwrap_err();
    assert!(matches!(&no, ClientError::No(Refused::Problems(problems)) if problems.len() == 1), "{no:?}");
    house.close().await;
}

#[tokio::test]
async fn a_behaviour_runs_tells_its_values_and_stops() {
    let house = House::open().await;
    let (mut aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("head"), Some(touch())).await.unwrap();
    aiko.put("Add", stream_id("out"), Some(printer("Out"))).await.unwrap();
    aiko.put("Add", connector_id("c"), Some(connect(connectors::subscribe::SPEC.with(()), &["head"], "out")))
        .await
        .unwrap();
    aiko.ask(start(&play)).await.unwrap();
    aiko.ask(request::Stimulate {
        behaviour: play.clone(),
        robot: None,
        stream: "head".parse().unwrap(),
        value: Value::Int(7),
    })
    .await
    .unwrap();
    let seven = |reply: &Event| matches!(reply, Event::Values { values } if values.streams.iter().any(|s| s.value == Value::Int(7)));
    aiko.until(seven).await.unwrap();
    assert_eq!(aiko.ask(request::Remove { behaviour: play.clone() }).await, Err(ClientError::No(Refused::Running)));
    aiko.ask(request::Stop { behaviour: Some(play.clone()), robot: None }).await.unwrap();
    let stopped = |reply: &Event| matches!(reply, Event::Runs { runs, .. } if runs.iter().all(|run| run.phase == RunPhase::Stopped("Aiko".into())) && !runs.is_empty());
    aiko.until(stopped).await.unwrap();
    aiko.ask(request::Remove { behaviour: play }).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn a_stop_of_one_behaviour_leaves_the_start_of_another_alone() {
    let house = House::open().await;
    let (aiko, ben) = (house.person("Aiko").await, house.person("Ben").await);
    let greet = make(&aiko, "Greet", Some("Greeter")).await;
    let other = make(&aiko, "Other", Some("Reflect ball color")).await;
    for _ in 0..20 {
        let stop = || ben.ask(request::Stop { behaviour: Some(other.clone()), robot: None });
        let (started, ..) = tokio::join!(aiko.ask(start(&greet)), stop(), stop(), stop());
        assert_eq!(started, Ok(()));
        aiko.ask(request::Stop { behaviour: Some(greet.clone()), robot: None }).await.unwrap();
    }
    house.close().await;
}

#[tokio::test]
async fn nothing_runs_that_is_in_the_bin() {
    let house = House::open().await;
    let (mut aiko, ben) = (house.person("Aiko").await, house.person("Ben").await);
    for number in 0..20 {
        let play = make(&aiko, &format!("Play {number}"), Some("Reflect ball color")).await;
        let start = aiko.ask(start(&play));
        let remove = ben.ask(request::Remove { behaviour: play.clone() });
        let (started, gone) = tokio::join!(start, remove);
        assert!(started.is_err() || gone.is_err(), "{started:?} {gone:?}");
        aiko.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
    }
    let all_ended = |reply: &Event| matches!(reply, Event::Runs { runs, .. } if runs.iter().all(|run| run.phase != RunPhase::Running));
    aiko.until(all_ended).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn edits_disturb_nothing_until_they_are_applied() {
    let house = House::open().await;
    let (mut aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("head"), Some(touch())).await.unwrap();
    aiko.put("Add", stream_id("out"), Some(printer("Out"))).await.unwrap();
    aiko.put("Add", stream_id("next"), Some(plain("Next"))).await.unwrap();
    aiko.put("Add", connector_id("m"), Some(map("head + 1", "head", "next"))).await.unwrap();
    aiko.put("Add", connector_id("c"), Some(connect(connectors::subscribe::SPEC.with(()), &["next"], "out")))
        .await
        .unwrap();
    let apply = request::Apply { behaviour: play.clone(), robot: None };
    assert_eq!(aiko.ask(apply.clone()).await, Err(ClientError::No(Refused::NotRunning)));
    aiko.ask(start(&play)).await.unwrap();
    aiko.put("Edit", connector_id("m"), Some(map("head + 2", "head", "next"))).await.unwrap();
    let seven =
        |value| request::Stimulate { behaviour: play.clone(), robot: None, stream: "head".parse().unwrap(), value };
    let shows = |wanted: i64| move |reply: &Event| matches!(reply, Event::Values { values } if values.streams.iter().any(|s| s.stream.as_str() == "out" && s.value == Value::Int(wanted)));
    aiko.ask(seven(Value::Int(7))).await.unwrap();
    aiko.until(shows(8)).await.unwrap();
    aiko.ask(apply.clone()).await.unwrap();
    aiko.ask(seven(Value::Int(7))).await.unwrap();
    aiko.until(shows(9)).await.unwrap();
    // What cannot run is not applied; the sentence says why and that the robot goes on.
    aiko.put("Edit", connector_id("m"), Some(map("", "head", "next"))).await.unwrap();
    let no = aiko.ask(apply).await.unwrap_err();
    assert!(matches!(&no, ClientError::No(Refused::NotApplied(_))), "{no:?}");
    assert!(no.to_string().starts_with("The robot goes on with what it ran before"), "{no}");
    aiko.ask(seven(Value::Int(1))).await.unwrap();
    aiko.until(shows(3)).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn templates_start() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let play = make(&aiko, "Far", Some("Track far and close balls")).await;
    aiko.ask(start(&play)).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn a_procedure_is_tried() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let inputs = vec![vec![Value::Int(1)], vec![Value::Int(41)]];
    let check = request::Check { arguments: vec!["n".into()], body: "n + 1".into(), inputs };
    let results = vec![Ok(Value::Int(2)), Ok(Value::Int(42))];
    assert_eq!(aiko.ask(check).await.unwrap(), answer::Checked { error: None, results, unknown: None });
    house.close().await;
}

#[tokio::test]
async fn a_hint_is_told_with_what_mends_it() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let play = make(&aiko, "Arm", Some("Track with nearest arm")).await;
    let answer::Opened { problems, .. } = aiko.ask(request::Open { behaviour: play.clone() }).await.unwrap();
    let [problem] = &problems[..] else { panic!("{problems:?}") };
    let ask = request::Fixes { behaviour: play.clone(), problem: problem.clone(), seen: SeenKinds::new() };
    let answer::Fixes { fixes } = aiko.ask(ask).await.unwrap();
    assert_eq!(fixes.iter().map(|fix| fix.kind.to_string()).collect::<Vec<_>>(), ["Leave out what is older than 1 s."]);
    let change = fixes[0].change(id("fix"), "Aiko");
    aiko.ask(request::Propose { behaviour: play.clone(), change, tokens: Vec::new() }).await.unwrap();
    let ask = request::Types { behaviour: play, seen: SeenKinds::new() };
    let answer::Types { types, hints } = aiko.ask(ask).await.unwrap();
    assert_eq!(hints, [], "nothing was seen");
    assert!(types.values().any(|of| of.unit() == Some(behaviour::Unit::Metres)), "{types:?}");
    house.close().await;
}

#[tokio::test]
async fn what_a_program_does_is_told_in_sentences_with_the_connector_of_each() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let play = make(&aiko, "Far", Some("Track far and close balls")).await;
    let mut told = Vec::new();
    for language in ["en", "ja", "tlh"] {
        let ask = request::Told { behaviour: play.clone(), language: language.to_owned() };
        let answer::Told { sentences } = aiko.ask(ask).await.unwrap();
        told.push(sentences);
    }
    let [english, japanese, unknown] = &told[..] else { panic!() };
    let texts: Vec<_> = english.iter().map(|one| (one.lead.as_str(), one.does.as_str())).collect();
    assert!(texts[0].0.contains("0.5 m") && texts.iter().all(|(_, does)| does.contains("follow")), "{texts:?}");
    assert!(english.len() == 2 && english.iter().all(|one| one.connector.is_some()), "{english:?}");
    assert!(japanese.len() == 2 && !japanese[0].does.is_ascii(), "{japanese:?}");
    assert_eq!(unknown, english, "a language that is not spoken is told in English");
    let ask = request::Told { behaviour: id("gone"), language: "en".to_owned() };
    assert!(aiko.ask(ask).await.is_err());
    house.close().await;
}

/// A sense that reads nothing by itself here, so that what a person sends stays the newest value.
fn touch() -> behaviour::Record {
    behaviour::Record::Stream(stream("Head", behaviour::StreamKind::Sensor, Some("HeadTouch")))
}
