//! The robots of a data folder as a backup keeps them, without a server.

use super::order::{ORDER_MAX, Order};
use super::refusal::BackupMisfit;
use super::register::{Known, Register, check_real};
use behaviour::{Id, has_unseen};
use protocol::{ROBOT_NAME_MAX_CHARS, ROBOTS_MAX, RealRobot};
use std::collections::HashSet;
use std::path::Path;
use store::backup::{Reached, Robot};

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
    Robot {
        id: known.robot.clone(),
        name: known.name.clone(),
        seed: known.seed,
        real: known.real.as_ref().map(reached),
        order,
    }
}

fn reached(real: &RealRobot) -> Reached {
    let RealRobot { address, user, fingerprint, password: _, identity: _ } = real.clone();
    Reached { address, user, fingerprint }
}

/// Its password has to be given again; the first body that answers is kept.
fn real(reached: &Reached) -> RealRobot {
    let Reached { address, user, fingerprint } = reached.clone();
    RealRobot { address, user, password: None, fingerprint, identity: None }
}

/// Whether these robots can be put into a data folder: it has none, or the same, or a part from a restore that ended early and
/// goes on.
///
/// # Errors
/// Why not.
pub fn check_robots(data: &Path, robots: &[Robot], goes_on: bool) -> Result<(), BackupMisfit> {
    let ids: HashSet<&Id> = robots.iter().map(|robot| &robot.id).collect();
    let is_named =
        |robot: &Robot| (1..=ROBOT_NAME_MAX_CHARS).contains(&robot.name.chars().count()) && !has_unseen(&robot.name);
    let is_reached = |robot: &Robot| robot.real.as_ref().is_none_or(|reached| check_real(&real(reached)).is_ok());
    let fits = |robot: &Robot| is_named(robot) && is_reached(robot) && robot.order.len() <= ORDER_MAX;
    if ids.len() < robots.len() || robots.len() > ROBOTS_MAX || !robots.iter().all(fits) {
        return Err(BackupMisfit::Malformed);
    }
    let goes_on = goes_on || store::check_folder(data).is_err();
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
    let known = |robot: &Robot| Known {
        robot: robot.id.clone(),
        name: robot.name.clone(),
        seed: robot.seed,
        real: robot.real.as_ref().map(real),
    };
    let known: Vec<_> = robots.iter().map(known).collect();
    if known.is_empty() { Ok(()) } else { Register::within(Some(data), SEED).replace(known) }
}

#[cfg(test)]
mod tests {
    use super::{Register, Robot, check_robots, put_robots, robots_in};
    use behaviour::Id;
    use protocol::RealRobot;

    fn robot(name: &str, order: &[&str]) -> Robot {
        let id = |text: &&str| Id::new(text).unwrap();
        let order = order.iter().map(id).collect();
        Robot { id: id(&name), name: name.to_uppercase(), seed: 7, real: None, order }
    }

    #[test]
    fn a_password_is_in_no_backup() {
        let folder = tempfile::tempdir().unwrap();
        let real = RealRobot {
            address: "nao.local".into(),
            user: Some("nao".into()),
            password: Some("hush".into()),
            fingerprint: None,
            identity: None,
        };
        let mut register = Register::within(Some(folder.path()), 1);
        let known = register.newcomer(&Id::new("a").unwrap(), "NAO", Some(real.clone())).unwrap();
        register.add(known).unwrap();
        let kept = robots_in(folder.path());
        assert!(!serde_json::to_string(&kept).unwrap().contains("hush"));
        let other = tempfile::tempdir().unwrap();
        put_robots(other.path(), &kept).unwrap();
        let again = Register::within(Some(other.path()), 1);
        assert_eq!(again.known()[1].real, Some(RealRobot { password: None, ..real }));
    }

    #[test]
    fn robots_come_back_with_their_orders() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(robots_in(folder.path()), [], "nothing was ever kept");
        let robots = [robot("first", &["a", "b"]), robot("second", &[])];
        assert_eq!(check_robots(folder.path(), &robots, false), Ok(()));
        put_robots(folder.path(), &robots).unwrap();
        assert_eq!(robots_in(folder.path()), robots);
        assert_eq!(check_robots(folder.path(), &robots, false), Ok(()), "once more is fine");
        assert_eq!(check_robots(folder.path(), &[], false), Ok(()), "a backup of an older rrp has none");
        let refused = check_robots(folder.path(), &robots[..1], false).unwrap_err();
        assert!(refused.to_string().contains("Choose an empty folder"), "{refused}");
    }

    #[test]
    fn robots_that_no_server_keeps_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let twice = [robot("one", &[]), robot("one", &[])];
        let long = [Robot { name: "x".repeat(41), ..robot("one", &[]) }];
        let unseen = [Robot { name: "a\0b".to_owned(), ..robot("one", &[]) }];
        let many: Vec<_> = (0..100).map(|number| robot(&format!("r{number}"), &[])).collect();
        for robots in [&twice[..], &long, &unseen, &many] {
            assert!(check_robots(folder.path(), robots, false).is_err());
        }
    }
}
