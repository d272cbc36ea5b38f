//! Who answers for what the robot does: who pressed Stop, who started it, and what only the host may do to robots.

use crate::house::{House, make, start};
use crate::invited::Scene;
use protocol::{Event, Refused, Role, RunPhase, RunState, request};
use shell::{Client, ClientError};

/// Waits until people are told of a run like this.
async fn run_like(aiko: &mut Client, is_like: impl Fn(&RunState) -> bool) -> RunState {
    let mut found = None;
    let told = |event: &Event| matches!(event, Event::Runs { runs, .. } if runs.iter().any(&is_like));
    if let Event::Runs { runs, .. } = aiko.until(told).await.unwrap() {
        found = runs.into_iter().find(|run| is_like(run));
    }
    found.unwrap()
}

#[tokio::test]
async fn people_are_told_who_pressed_stop_by_whatever_way() {
    let mut scene = Scene::open().await;
    let greet = make(&scene.aiko, "Greet", Some("Greeter")).await;
    let (browser, _) = scene.guest(Role::Viewer).await;
    let _ben = browser.socket("Ben").await.unwrap();
    scene.aiko.ask(start(&greet)).await.unwrap();
    assert!(browser.post("/stop", "").await.contains("stopped"));
    run_like(&mut scene.aiko, |run| run.phase == RunPhase::Stopped("Ben".into())).await;
    scene.aiko.ask(start(&greet)).await.unwrap();
    scene.aiko.ask(request::Stop { behaviour: Some(greet), robot: None }).await.unwrap();
    run_like(&mut scene.aiko, |run| run.phase == RunPhase::Stopped("Aiko".into())).await;
    scene.house.close().await;
}

#[tokio::test]
async fn what_a_revoked_operator_started_is_shown_as_such_and_runs_until_it_is_stopped() {
    let mut scene = Scene::open().await;
    let greet = make(&scene.aiko, "Greet", Some("Greeter")).await;
    let (browser, invitation) = scene.guest(Role::Operator).await;
    let mut ben = browser.socket("Ben").await.unwrap();
    assert_eq!(ben.ask(start(&greet)).await, Ok(()));
    let run = run_like(&mut scene.aiko, |run| run.phase == RunPhase::Running).await;
    assert!(run.by == "Ben" && !run.revoked, "{run:?}");
    scene.aiko.ask(request::Revoke { invitation: invitation.id }).await.unwrap();
    let run = run_like(&mut scene.aiko, |run| run.revoked).await;
    assert_eq!((run.by.as_str(), &run.phase), ("Ben", &RunPhase::Running));
    let stop = browser.request("POST", "/stop", &browser.own_page(), "");
    assert!(!browser.raw(&stop).await.contains("stopped"), "and may stop nothing any more");
    scene.aiko.ask(request::Stop { behaviour: Some(greet), robot: run.robot.into() }).await.unwrap();
    run_like(&mut scene.aiko, |run| run.revoked && run.phase == RunPhase::Stopped("Aiko".into())).await;
    scene.house.close().await;
}

#[tokio::test]
async fn an_operator_neither_removes_the_hosts_robot_nor_fills_its_places() {
    let scene = Scene::open().await;
    let nao = serde_json::json!({"robot": "nao", "name": "NAO", "real": {"address": "127.0.0.1:9"}});
    assert_eq!(scene.aiko.ask(serde_json::from_value::<request::AddRobot>(nao).unwrap()).await, Ok(()));
    let (browser, _) = scene.guest(Role::Operator).await;
    let mut ben = browser.socket("Ben").await.unwrap();
    let remove = request::RemoveRobot { robot: "nao".parse().unwrap() };
    assert_eq!(ben.ask(remove.clone()).await, Err(Refused::Role(Role::Host)));
    let mut added = 0;
    let no = loop {
        let robot = format!("r{added}").parse().unwrap();
        match ben.ask(request::AddRobot { robot, name: "Momo".into(), real: None }).await {
            Ok(()) => added += 1,
            Err(no) => break no,
        }
    };
    assert!(matches!(&no, Refused::RobotNotAdded(why) if why.to_string().contains("host")), "{no:?}");
    let more = request::AddRobot { robot: "own".parse().unwrap(), name: "Own".into(), real: None };
    assert_eq!(scene.aiko.ask(more).await, Ok(()), "the host finds a place after {added}");
    assert_eq!(ben.ask(request::RemoveRobot { robot: "r0".parse().unwrap() }).await, Ok(()), "and their own");
    assert_eq!(scene.aiko.ask(remove).await, Ok(()));
    scene.house.close().await;
}

#[tokio::test]
async fn an_import_has_the_author_that_the_cookie_says() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Editor).await;
    let file = browser.get(&format!("/api/behaviours/{}.json", scene.play)).await;
    let file = file.split_once("\r\n\r\n").unwrap().1.to_owned();
    for author in ["Somebody", "Ben"] {
        let _link = if author == "Ben" { browser.socket(author).await.ok() } else { None };
        let brought = browser.post("/api/import?by=Host", &file).await;
        let made: serde_json::Value = serde_json::from_str(brought.split_once("\r\n\r\n").unwrap().1).unwrap();
        let history = serde_json::json!({"behaviour": made["id"]});
        let history: request::History = serde_json::from_value(history).unwrap();
        let told = scene.aiko.ask(history).await.unwrap();
        let told = serde_json::to_string(&told).unwrap();
        assert!(told.contains(&format!("\"author\":\"{author}\"")) && !told.contains("\"author\":\"Host\""), "{told}");
    }
    scene.house.close().await;
}

#[tokio::test]
async fn a_program_is_not_removed_under_somebodys_hands() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    let records = [behaviour::RecordId::settings()].into();
    let grant = ben.ask(request::Lock { behaviour: play.clone(), records }).await.unwrap().grant;
    let no = aiko.ask(request::Remove { behaviour: play.clone() }).await.unwrap_err();
    assert!(matches!(&no, ClientError::No(Refused::Change(_))) && no.to_string().contains("Ben is editing"), "{no}");
    ben.ask(request::Unlock { behaviour: play.clone(), token: grant.token }).await.unwrap();
    assert_eq!(aiko.ask(request::Remove { behaviour: play }).await, Ok(()));
    house.close().await;
}
