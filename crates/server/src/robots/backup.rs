//! The robots of a data folder as a backup keeps them, without a server.

use super::order::{ORDER_MAX, Order};
use super::refusal::BackupMisfit;
use super::register::{Known, Register};
use behaviour::Id;
use protocol::{ROBOT_NAME_MAX_CHARS, ROBOTS_MAX};
use std::collections::BTreeSet;
use std::path::Path;
use store::backup::Robot;

/// The seed that is written for the first robot while nothing else about it was ever kept.
const SEED: u64 = 1;

/// The robots that are kept in a data folder, each with its order; none while there is nothing to keep of them.
#[must_use]
pub fn robots_in(data: &Path) -> Vec<Robot> {
    let register = Register::within(Some(data), SEED);
    let robots: Vec<_> = register.known().iter().map(|known| robot(data, known)).collect();
    if register.is_kept() || robots.iter().any(|robot| !robot.order.is_empty()) { robots } else { Vec::new() }
}

fn robot(data: &Path, known: &Known) -> Robot {
    let order = Order::within(Some(data), &known.robot).list();
    Robot { id: known.robot.clone(), name: known.name.clone(), seed: known.seed, order }
}

/// Whether these robots can be put into a data folder: it has none, or the same, or a part from a restore that ended early.
///
/// # Errors
/// Why not.
pub fn check_robots(data: &Path, robots: &[Robot]) -> Result<(), BackupMisfit> {
    let ids: BTreeSet<&Id> = robots.iter().map(|robot| &robot.id).collect();
    let is_named = |robot: &Robot| (1..=ROBOT_NAME_MAX_CHARS).contains(&robot.name.chars().count());
    let fits = |robot: &Robot| is_named(robot) && robot.order.len() <= ORDER_MAX;
    if ids.len() < robots.len() || robots.len() > ROBOTS_MAX || !robots.iter().all(fits) {
        return Err(BackupMisfit::Malformed);
    }
    let goes_on = store::backup::check_finished(data).is_err();
    let here = robots_in(data);
    if goes_on || robots.is_empty() || here.is_empty() || here == robots {
        return Ok(());
    }
    Err(BackupMisfit::Others(data.to_owned()))
}

/// Puts robots and their orders into a data folder.
///
/// # Errors
/// If they cannot be written.
pub fn put_robots(data: &Path, robots: &[Robot]) -> std::io::Result<()> {
    for robot in robots {
        Order::within(Some(data), &robot.id).replace(robot.order.clone())?;
    }
    let known = |robot: &Robot| Known { robot: robot.id.clone(), name: robot.name.clone(), seed: robot.seed };
    let known: Vec<_> = robots.iter().map(known).collect();
    if known.is_empty() { Ok(()) } else { Register::within(Some(data), SEED).replace(known) }
}

#[cfg(test)]
mod tests {
    use super::{Robot, check_robots, put_robots, robots_in};
    use behaviour::Id;

    fn robot(name: &str, order: &[&str]) -> Robot {
        let id = |text: &&str| Id::new(text).unwrap();
        Robot { id: id(&name), name: name.to_uppercase(), seed: 7, order: order.iter().map(id).collect() }
    }

    #[test]
    fn robots_come_back_with_their_orders() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(robots_in(folder.path()), [], "nothing was ever kept");
        let robots = [robot("first", &["a", "b"]), robot("second", &[])];
        assert_eq!(check_robots(folder.path(), &robots), Ok(()));
        put_robots(folder.path(), &robots).unwrap();
        assert_eq!(robots_in(folder.path()), robots);
        assert_eq!(check_robots(folder.path(), &robots), Ok(()), "once more is fine");
        assert_eq!(check_robots(folder.path(), &[]), Ok(()), "a backup of an older rrp has none");
        let refused = check_robots(folder.path(), &robots[..1]).unwrap_err();
        assert!(refused.to_string().contains("Choose an empty folder"), "{refused}");
    }

    #[test]
    fn robots_that_no_server_keeps_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let twice = [robot("one", &[]), robot("one", &[])];
        let long = [Robot { name: "x".repeat(41), ..robot("one", &[]) }];
        let many: Vec<_> = (0..100).map(|number| robot(&format!("r{number}"), &[])).collect();
        for robots in [&twice[..], &long, &many] {
            assert!(check_robots(folder.path(), robots).is_err());
        }
    }
}
