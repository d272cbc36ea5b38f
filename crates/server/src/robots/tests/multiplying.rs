//! Behaviours whose values multiply: they end by themselves at the same value as a replay, or at once when stopped.

use super::puppet::Puppet;
use super::recording::{lines, outputs, recorded, replayed, text};
use super::{filtered, id, phase, until};
use crate::recordings::Recordings;
use crate::robots::StartOrder;
use behaviour::{FileConnector, FileStream, StreamKind, Value};
use engine::Limits;
use protocol::RunPhase;
use std::sync::Arc;

/// As many as a run carries: only Stop ends it.
fn without_a_bound() -> Limits {
    Limits { handed: u64::MAX, ..Limits::default() }
}

/// A ball, 60 diamonds in a row that each double its values, and a text on the page for each of them.
fn diamonds(name: &str) -> StartOrder {
    let mut start = filtered(name, "true");
    let file = Arc::make_mut(&mut start.file);
    let (stream, connector) = (file.streams[1].clone(), file.connectors[0].clone());
    let mut last = "good".to_owned();
    for at in 0..60 {
        let [left, right, merged] = [format!("l{at}"), format!("r{at}"), format!("m{at}")];
        for id in [&left, &right, &merged] {
            let kind = StreamKind::Ordinary;
            file.streams.push(FileStream { id: id.clone(), name: id.clone(), kind, ..stream.clone() });
        }
        for way in [&left, &right] {
            let (id, inputs) = (format!("to {way}"), vec![last.clone()]);
            let args = Some(vec!["ball".to_owned()]);
            file.connectors.push(FileConnector { id, inputs, output: way.clone(), args, ..connector.clone() });
        }
        let (id, operation) = (format!("to {merged}"), "merge".to_owned());
        let (inputs, output) = (vec![left, right], merged.clone());
        file.connectors.push(FileConnector { id, operation, inputs, output, body: None, ..connector.clone() });
        last = merged;
    }
    file.connectors[1].inputs = vec![last];
    start
}

#[tokio::test]
async fn it_ends_with_its_reason_and_its_recording_replays_to_the_same_values() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let run = robots.start(recorded(diamonds("one"))).await.unwrap();
    robots.stimulate(&id("one"), &id("ball"), Value::Int(1), "Ben").unwrap();
    until("it ends by itself", || phase(&robots, &run) != RunPhase::Running).await;
    let RunPhase::Faulted(why) = phase(&robots, &run) else { panic!("{:?}", phase(&robots, &run)) };
    assert!(why.to_string().starts_with("values multiply at “m"), "{why}");
    until("devices and thread are given back", || puppet.users().is_empty() && robots.shared().threads() == 0).await;
    let lines = lines(&recordings).await;
    assert_eq!(text(lines.last().unwrap(), "why"), Some(why.to_string().as_str()));
    let told = outputs(&lines);
    assert!((1_000..100_000).contains(&told.len()), "{}", told.len());
    assert_eq!(told, replayed(&diamonds("one").file, &lines));
    assert_eq!(robots.start(filtered("one", "true")).await.unwrap().phase, RunPhase::Running);
}

#[tokio::test]
async fn nothing_of_it_outlives_stop() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(without_a_bound, recordings.clone());
    for pass in 0..3 {
        let run = robots.start(recorded(diamonds("one"))).await.unwrap();
        robots.stimulate(&id("one"), &id("ball"), Value::Int(1), "Ben").unwrap();
        until("values are on their way", || !puppet.told(run.run).is_empty()).await;
        assert!(robots.stop(None, "Ben"), "pass {pass}");
        until("its thread ends", || robots.shared().threads() == 0).await;
        let told = puppet.told(run.run).len();
        until("its devices are given back", || puppet.users().is_empty()).await;
        assert_eq!(puppet.told(run.run).len(), told, "nothing reaches the robot after Stop");
    }
    let lines = lines(&recordings).await;
    assert_eq!(text(lines.last().unwrap(), "why"), Some("it was stopped"));
    assert!(outputs(&lines).is_empty(), "a step that Stop cut short is left out as a whole");
}
