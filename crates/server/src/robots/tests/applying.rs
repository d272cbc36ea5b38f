//! Applying an edited behaviour to what runs.

use super::puppet::Puppet;
use super::{filtered, id, phase, shows_until_told, stopped_by, until};
use crate::robots::{Host, SeenLive, StartOrder};
use behaviour::{BehaviourFile, FileConnector, StreamKind, Value};
use engine::Limits;
use protocol::Refused;
use protocol::{RunPhase, RunState};
use std::sync::Arc;

/// What starts, at a later revision and changed.
fn edited(start: StartOrder, change: impl FnOnce(&mut BehaviourFile)) -> StartOrder {
    let mut file = (*start.file).clone();
    change(&mut file);
    StartOrder { revision: start.revision + 4, file: Arc::new(file), by: "Ben".to_owned(), ..start }
}

fn body(text: &str) -> impl FnOnce(&mut BehaviourFile) {
    move |file| file.connectors[0].body = Some(text.to_owned())
}

fn state(robots: &Host, run: &RunState) -> RunState {
    let runs = robots.runs().borrow().clone();
    runs.iter().find(|known| known.run == run.run).unwrap().clone()
}

#[tokio::test]
async fn the_edited_behaviour_takes_over_with_the_same_run_and_the_same_devices() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "ball > 3")).await.unwrap();
    shows_until_told(&puppet, &run, 5).await;
    let (stops, opened) = (puppet.stops(), puppet.opened());
    let next = robots.apply(edited(filtered("one", "ball > 3"), body("ball < 3")), None).await.unwrap();
    assert_eq!((next.run, next.revision, next.by.as_str()), (run.run, 5, "Aiko"));
    shows_until_told(&puppet, &run, 1).await;
    assert_eq!(state(&robots, &run), next);
    assert_eq!((puppet.stops(), puppet.opened()), (stops, opened), "the robot was not disturbed");
    until("the thread of the one before ends", || robots.shared().threads() == 1).await;
    assert!(robots.stop(None, "Ben"));
    assert_eq!(phase(&robots, &run), stopped_by("Ben"));
    until("nothing is left", || puppet.users().is_empty() && robots.shared().threads() == 0).await;
}

#[tokio::test]
async fn a_refused_edit_leaves_what_runs_as_it_is() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let ended = robots.apply(filtered("one", "true"), None).await.unwrap_err();
    assert_eq!(ended.to_string(), "it does not run any more");
    assert_eq!(ended.not_applied(), Refused::NotRunning, "nobody is told that it goes on");
    let run = robots.start(filtered("one", "ball > 3")).await.unwrap();
    let bad = robots.apply(edited(filtered("one", "true"), body("ball >")), None).await.unwrap_err().to_string();
    assert!(bad.contains("at character 7"), "{bad}");
    puppet.refuse("Tracker");
    let tracker = |file: &mut BehaviourFile| file.streams[2].device = Some("Tracker".to_owned());
    let refused = robots.apply(edited(filtered("one", "true"), tracker), None).await.unwrap_err();
    assert_eq!(refused.to_string(), "“page”: this robot has no device called “Tracker”");
    assert_eq!(state(&robots, &run).revision, 1);
    shows_until_told(&puppet, &run, 5).await;
    assert_eq!(puppet.users(), [run.run].into());
    let good = robots.apply(edited(filtered("one", "true"), body("ball < 3")), None).await;
    assert_eq!(good.unwrap().revision, 5, "the next one may");
    shows_until_told(&puppet, &run, 2).await;
}

/// What a combineLatest of two senses knows, and how often its stream carried something.
fn pair() -> StartOrder {
    edited(filtered("pair", "true"), |file| {
        let mut other = file.streams[0].clone();
        (other.id, other.name) = ("touch".to_owned(), "touch".to_owned());
        file.streams.push(other);
        file.connectors[0] = FileConnector {
            operation: "combineLatest".to_owned(),
            inputs: vec!["ball".to_owned(), "touch".to_owned()],
            body: Some("ball + touch".to_owned()),
            ..file.connectors[0].clone()
        };
    })
}

#[tokio::test]
async fn what_did_not_change_remembers_and_its_counts_go_on() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(pair()).await.unwrap();
    let live = robots.values(run.run).unwrap();
    let send = |stream, value| robots.stimulate(&id("pair"), &id(stream), Value::Int(value), "Ben").unwrap();
    send("ball", 10);
    send("touch", 1);
    until("the first sum", || puppet.told(run.run) == [Value::Int(11)]).await;
    // Another action is added; nothing that was there changes.
    let more = edited(pair(), |file| {
        let mut second = file.streams[2].clone();
        (second.id, second.name) = ("more".to_owned(), "more".to_owned());
        file.streams.push(second);
        let show = FileConnector { id: "again".to_owned(), output: "more".to_owned(), ..file.connectors[1].clone() };
        file.connectors.push(show);
        file.streams.rotate_left(2);
        assert_eq!(file.streams[0].kind, StreamKind::Actuator);
    });
    robots.apply(more, None).await.unwrap();
    send("touch", 2);
    until("both actions", || puppet.told(run.run) == [11, 12, 12].map(Value::Int)).await;
    let count = |stream: &str| {
        let values = live.since(&mut SeenLive::default())?;
        Some(values.streams.iter().find(|sample| sample.stream == id(stream))?.count)
    };
    until("the counts go on", || count("good") == Some(2) && count("more") == Some(1)).await;
    // With another procedure it begins anew.
    let other = edited(pair(), |file| file.connectors[0].body = Some("ball - touch".to_owned()));
    robots.apply(other, None).await.unwrap();
    send("touch", 3);
    send("ball", 20);
    until("only with both inputs", || puppet.told(run.run) == [11, 12, 12, 17].map(Value::Int)).await;
    assert_eq!(phase(&robots, &run), RunPhase::Running);
}

#[tokio::test]
async fn stop_wins_over_an_edit_that_is_being_applied() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    for round in 0..20 {
        let run = robots.start(filtered("one", "ball > 3")).await.unwrap();
        let applying = tokio::spawn({
            let robots = robots.clone();
            async move { robots.apply(edited(filtered("one", "true"), body("ball < 3")), None).await }
        });
        if round % 2 == 0 {
            tokio::task::yield_now().await;
        }
        assert!(robots.stop(None, "Ben"));
        drop(applying.await.unwrap());
        assert_eq!(phase(&robots, &run), stopped_by("Ben"));
        until("nothing is left", || puppet.users().is_empty() && robots.shared().threads() == 0).await;
    }
}
