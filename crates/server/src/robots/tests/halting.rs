//! A robot that wants everything to end: it fell, is too hot, or its link is gone. And who has it.

use super::puppet::Puppet;
use super::{filtered, phase, shows_until_told, until};
use engine::Limits;
use protocol::{Refused, RunPhase};
use robot::Control;

#[tokio::test]
async fn everything_ends_with_the_robots_reason_and_nothing_goes_on_by_itself() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let one = robots.start(filtered("one", "true")).await.unwrap();
    let two = robots.start(filtered("two", "true")).await.unwrap();
    shows_until_told(&puppet, &one, 5).await;
    let stops = puppet.stops();
    puppet.halt("it fell");
    until("nobody uses the robot", || puppet.users().is_empty() && puppet.stops() > stops).await;
    for run in [&one, &two] {
        let RunPhase::Faulted(why) = phase(&robots, run) else { panic!("{:?}", phase(&robots, run)) };
        assert!(why.starts_with("it fell") && why.contains("press Start"), "{why}");
    }
    let again = robots.start(filtered("one", "true")).await.unwrap();
    shows_until_told(&puppet, &again, 6).await;
}

#[tokio::test]
async fn giving_back_stops_what_runs_and_taking_control_does_not() {
    let puppet = Puppet::default();
    let robots = puppet.robots(Limits::default);
    let run = robots.start(filtered("one", "true")).await.unwrap();
    robots.control(Control::Take, "Aiko").await.unwrap();
    assert_eq!(phase(&robots, &run), RunPhase::Running);
    robots.control(Control::GiveBack, "Aiko").await.unwrap();
    assert_eq!(phase(&robots, &run), RunPhase::Stopped("Aiko".to_owned()));
    let log = puppet.log();
    let at = |what: &str| log.iter().rposition(|line| line == what).unwrap();
    assert!(at("held") < at("GiveBack") && at("Take") < at("GiveBack"), "{log:?}");
    let refused = robots.control(Control::Rest, "Aiko").await.unwrap_err();
    assert!(matches!(&refused, Refused::RobotCannot(why) if why.contains("strings")), "{refused}");
}
