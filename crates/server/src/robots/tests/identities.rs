//! Which body each robot is: kept, compared, and never two robots at once.

use super::{filtered, id, until};
use crate::recordings::Recordings;
use crate::robots::{Robots, StartError};
use behaviour::Id;
use protocol::{RealRobot, Refused};
use robot::Identity;
use std::path::Path;

/// Nobody listens there.
fn nowhere(identity: Option<Identity>) -> RealRobot {
    RealRobot { address: "127.0.0.1:9".into(), user: Some("nao".into()), password: None, fingerprint: None, identity }
}

fn body(serial: &str) -> Identity {
    Identity { name: "nao".into(), body: "NAO".into(), serial: serial.into(), head: String::new() }
}

/// Blue and Green, whose bodies nobody knows yet.
fn two(data: &Path) -> (Robots, [Id; 2]) {
    let robots = Robots::within(Some(data), (1, 0), Recordings::default()).unwrap();
    let names = [("blue", "Blue"), ("green", "Green")];
    names.iter().for_each(|(robot, name)| robots.add(&id(robot), name, Some(nowhere(None)), true).unwrap());
    (robots, [id("blue"), id("green")])
}

/// A robot tells which body it is.
fn tells(robots: &Robots, robot: &Id, serial: &str) {
    robots.fleet.feed.edit(robot, |state| state.identity = Some(body(serial)));
}

fn same_as(robots: &Robots, robot: &Id) -> Option<String> {
    robots.fleet.feed.same_as(robot)
}

#[tokio::test]
async fn the_first_body_is_kept_and_one_body_is_one_robot() {
    let folder = tempfile::tempdir().unwrap();
    let (robots, [blue, green]) = two(folder.path());
    tells(&robots, &blue, "B1");
    until("it is kept", || robots.known_as(&body("B1"), None).as_deref() == Some("Blue")).await;
    // Under another name it is noticed, and nothing is started there.
    tells(&robots, &green, "B1");
    until("it is noticed", || same_as(&robots, &green).as_deref() == Some("Blue")).await;
    assert_eq!(same_as(&robots, &blue), None);
    let refused = robots.meant(Some(&green)).unwrap().start(filtered("greeting", "true")).await.unwrap_err();
    assert!(matches!(&refused, StartError::Twin(other) if other == "Blue"), "{refused}");
    let again = robots.add(&id("again"), "Again", Some(nowhere(Some(body("B1")))), true).unwrap_err();
    assert!(matches!(&again, Refused::RobotNotAdded(why) if why.to_string().contains("“Blue”")), "{again:?}");
    // With the first one gone it is that robot.
    robots.remove(&blue).unwrap();
    until("it is the only one", || same_as(&robots, &green).is_none()).await;
    until("it is kept", || robots.known_as(&body("B1"), None).as_deref() == Some("Green")).await;
    robots.shut_down();
    let again = Robots::within(Some(folder.path()), (1, 0), Recordings::default()).unwrap();
    assert_eq!(again.known_as(&body("B1"), None).as_deref(), Some("Green"), "after a restart too");
    again.shut_down();
}

#[tokio::test]
async fn an_address_changes_and_everything_else_stays() {
    let folder = tempfile::tempdir().unwrap();
    let (robots, [blue, _]) = two(folder.path());
    tells(&robots, &blue, "B1");
    until("it is kept", || robots.known_as(&body("B1"), None).is_some()).await;
    let elsewhere = RealRobot { address: "127.0.0.1:10".into(), user: None, ..nowhere(None) };
    robots.reach(&blue, elsewhere.clone()).unwrap();
    let state = || robots.states().borrow().iter().find(|state| state.robot == blue).cloned().unwrap();
    assert_eq!(state().address.as_deref(), Some("127.0.0.1:10"));
    assert_eq!(robots.known_as(&body("B1"), None).as_deref(), Some("Blue"), "which body it is stays");
    assert_eq!(robots.with_login(&blue, elsewhere.clone()).user.as_deref(), Some("nao"), "and its login");
    let refused = robots.reach(&id("simulated-nao"), elsewhere.clone()).unwrap_err();
    assert!(matches!(&refused, Refused::RobotStays(why) if why.to_string().contains("simulated")), "{refused:?}");
    assert!(robots.reach(&blue, RealRobot { address: " ".into(), ..elsewhere }).is_err());
    // Nobody is accepted who does not answer there.
    let refused = robots.accept(&blue, &body("B2")).unwrap_err();
    assert!(matches!(&refused, Refused::RobotStays(why) if why.to_string().contains("another robot")), "{refused:?}");
    robots.shut_down();
}
