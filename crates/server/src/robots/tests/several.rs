//! Several robots at once.

use super::{filtered, id, stopped_by, until};
use crate::recordings::Recordings;
use crate::robots::Robots;
use behaviour::{Id, Value};
use protocol::{ROBOTS_MAX, Refused, RunState};
use robot::{Health, SceneEdit};

const FIRST: &str = "simulated-nao";

/// The first robot and Momo.
fn two() -> (Robots, [Id; 2]) {
    let robots = Robots::within(None, (1, 0), Recordings::default()).unwrap();
    robots.add(&id("momo"), "Momo", None, true).unwrap();
    (robots, [id(FIRST), id("momo")])
}

async fn start(robots: &Robots, name: &str, on: &Id) -> RunState {
    robots.meant(Some(on)).unwrap().start(filtered(name, "ball == 7 || ball == 8")).await.unwrap()
}

/// What a robot printed last.
fn printed(robots: &Robots, on: &Id) -> String {
    let scene = robots.meant(Some(on)).unwrap().scene();
    let printed = scene.borrow().body.printed.last().cloned();
    printed.map(|printed| printed.text).unwrap_or_default()
}

fn phase(robots: &Robots, run: &RunState) -> protocol::RunPhase {
    let runs = robots.runs().borrow().clone();
    runs.iter().find(|known| known.run == run.run).unwrap().phase.clone()
}

#[tokio::test]
async fn one_behaviour_runs_on_two_robots_and_each_is_stopped_by_itself() {
    let (robots, [first, momo]) = two();
    let one = start(&robots, "greeting", &first).await;
    let two = start(&robots, "greeting", &momo).await;
    assert_eq!([&one.robot, &two.robot], [&first, &momo]);
    assert_ne!(one.run, two.run);
    let tell =
        |on: Option<&Id>, value| robots.stimulate(&id("greeting"), on, (&id("ball"), &Value::Int(value)), "Ben".into());
    tell(Some(&momo), 7).unwrap();
    until("Momo prints", || printed(&robots, &momo) == "7").await;
    assert_eq!(printed(&robots, &first), "", "the other one heard nothing");
    tell(None, 8).unwrap();
    until("both print", || [&first, &momo].iter().all(|robot| printed(&robots, robot) == "8")).await;

    assert!(robots.stop(None, Some(&momo), "Ben"));
    assert_eq!([phase(&robots, &one), phase(&robots, &two)], [protocol::RunPhase::Running, stopped_by("Ben")]);
    assert_eq!(tell(Some(&momo), 9), Err(Refused::NotRunning));
    assert!(robots.stop(None, Some(&id("nobody")), "Ben"), "whoever names nobody stops all");
    assert_eq!(phase(&robots, &one), stopped_by("Ben"));
    robots.shut_down();
}

#[tokio::test]
async fn each_robot_has_a_room_and_an_order_of_its_own() {
    let (robots, [first, momo]) = two();
    let place = |on: &Id, name: &str| {
        let runs = robots.runs().borrow().clone();
        runs.iter().find(|run| run.robot == *on && run.behaviour == id(name)).unwrap().place
    };
    for robot in [&first, &momo] {
        start(&robots, "greeting", robot).await;
        start(&robots, "idle", robot).await;
    }
    robots.meant(Some(&momo)).unwrap().place(&id("idle"), Some(&id("greeting"))).unwrap();
    assert_eq!([place(&momo, "idle"), place(&first, "idle")], [0, 1]);

    let at = [0.9, 0.4, 0.3];
    robots.edit_scene(Some(&momo), SceneEdit::MoveBall { id: "red".to_owned(), at });
    let red = |on: &Id| {
        let scene = robots.meant(Some(on)).unwrap().scene();
        let scene = scene.borrow().clone();
        scene.balls.iter().find(|ball| ball.id == "red").map(|ball| ball.at)
    };
    until("the ball moved", || red(&momo).is_some_and(|now| (now[0] - at[0]).abs() < 0.01)).await;
    assert!(red(&first).is_some_and(|now| (now[0] - at[0]).abs() > 0.01));
    robots.shut_down();
}

#[tokio::test]
async fn a_robot_goes_only_when_nothing_runs_on_it() {
    let (robots, [first, momo]) = two();
    start(&robots, "greeting", &momo).await;
    assert!(matches!(robots.remove(&momo), Err(Refused::RobotStays(_))));
    robots.stop(None, Some(&momo), "Ben");
    robots.remove(&momo).unwrap();
    assert_eq!(robots.remove(&momo), Err(Refused::NoRobot));
    assert!(matches!(robots.remove(&first), Err(Refused::RobotStays(_))), "there is always one");
    let left: Vec<_> = robots.states().borrow().iter().map(|state| state.robot.clone()).collect();
    assert_eq!(left, [first]);
    assert!(robots.runs().borrow().is_empty(), "what ran on it is not shown any more");
    robots.shut_down();
}

#[tokio::test]
async fn robots_are_there_again_after_a_restart_and_not_without_bound() {
    let folder = tempfile::tempdir().unwrap();
    let within = || Robots::within(Some(folder.path()), (1, 0), Recordings::default()).unwrap();
    let robots = within();
    for (at, name) in ["Momo", "Momo", "Kiki"].into_iter().enumerate() {
        robots.add(&id(&format!("r{at}")), name, None, true).unwrap();
        robots.add(&id(&format!("r{at}")), "asked twice", None, true).unwrap();
    }
    robots.remove(&id("r2")).unwrap();
    robots.shut_down();
    let robots = within();
    let names = |robots: &Robots| robots.states().borrow().iter().map(|state| state.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&robots), ["Simulated NAO", "Momo", "Momo 2"]);
    let ready = |robots: &Robots| robots.states().borrow().iter().all(|state| state.health == Health::Ready);
    until("all are ready", || ready(&robots)).await;
    robots.add(&id("more3"), "More", None, false).unwrap();
    let of_guest = robots.add(&id("too-many"), "X", None, false);
    assert!(
        matches!(of_guest, Err(Refused::RobotNotAdded(why)) if why.to_string().contains("host")),
        "places are kept for it"
    );
    for at in 4..ROBOTS_MAX {
        robots.add(&id(&format!("more{at}")), "More", None, true).unwrap();
    }
    assert!(matches!(robots.add(&id("too-many"), "X", None, true), Err(Refused::RobotNotAdded(_))));
    robots.shut_down();
}
