//! The robots of a data folder as a backup keeps them, without a server.

use super::order::{ORDER_MAX, RobotOrder};
use super::refusal::BackupMisfit;
use super::register::{Register, RegisteredRobot, check_real};
use behaviour::{Id, has_unseen};
use protocol::{ROBOT_NAME_MAX_CHARS, ROBOTS_MAX, RealRobot};
use robot::Identity;
use std::collections::HashSet;
use std::path::Path;
use store::backup::{BackedUpBody, BackedUpRobot, Reached};

/// The seed that is written for the first robot while nothing else about it was ever kept.
const SEED: u64 = 1;
/// The longest that a robot says of its body, in characters.
const BODY_MAX_CHARS: usize = 200;

/// The robots that are kept in a data folder, each with its order; none while there is nothing to keep of them.
#[must_use]
pub fn robots_in(data: &Path) -> Vec<BackedUpRobot> {
    let register = Register::within(Some(data), SEED);
    let robots: Vec<_> = register.known().iter().map(|known| robot(data, known)).collect();
    if register.is_kept() || robots.iter().any(|robot| !robot.order.is_empty()) { robots } else { Vec::new() }
}

fn robot(data: &Path, known: &RegisteredRobot) -> BackedUpRobot {
    let order = RobotOrder::within(Some(data), &known.robot).list();
    BackedUpRobot {
        id: known.robot.clone(),
        name: known.name.clone(),
        seed: known.seed,
        real: known.real.as_ref().map(reached),
        order,
    }
}

fn reached(real: &RealRobot) -> Reached {
    let RealRobot { address, user, fingerprint, password: _, identity } = real.clone();
    let body = identity.map(|Identity { name, body, serial, head }| BackedUpBody { name, kind: body, serial, head });
    Reached { address, user, fingerprint, body }
}

/// Returns the way to a robot as it is kept here, without its password: that has to be given again.
fn real(reached: &Reached) -> RealRobot {
    let Reached { address, user, fingerprint, body } = reached.clone();
    let identity = body.map(|BackedUpBody { name, kind, serial, head }| Identity { name, body: kind, serial, head });
    RealRobot { address, user, password: None, fingerprint, identity }
}

/// True if robots are the same, whatever was learned of their bodies meanwhile.
fn are_same(these: &[BackedUpRobot], those: &[BackedUpRobot]) -> bool {
    let bare = |robots: &[BackedUpRobot]| -> Vec<BackedUpRobot> {
        let mut robots = robots.to_vec();
        robots.iter_mut().filter_map(|robot| robot.real.as_mut()).for_each(|reached| reached.body = None);
        robots
    };
    bare(these) == bare(those)
}

/// True if a robot can have told this of itself.
fn is_told(body: &BackedUpBody) -> bool {
    let fits = |text: &String| text.chars().count() <= BODY_MAX_CHARS && !has_unseen(text);
    [&body.name, &body.kind, &body.serial, &body.head].into_iter().all(fits)
}

/// True if these robots can be put into a data folder: it has none, or the same, or a part from a restore that ended early and
/// goes on.
///
/// # Errors
/// Why not.
pub fn check_robots(data: &Path, robots: &[BackedUpRobot], goes_on: bool) -> Result<(), BackupMisfit> {
    let ids: HashSet<&Id> = robots.iter().map(|robot| &robot.id).collect();
    let is_named = |robot: &BackedUpRobot| {
        (1..=ROBOT_NAME_MAX_CHARS).contains(&robot.name.chars().count()) && !has_unseen(&robot.name)
    };
    let fits_real = |reached: &Reached| check_real(&real(reached)).is_ok() && reached.body.as_ref().is_none_or(is_told);
    let is_reached = |robot: &BackedUpRobot| robot.real.as_ref().is_none_or(fits_real);
    let fits = |robot: &BackedUpRobot| is_named(robot) && is_reached(robot) && robot.order.len() <= ORDER_MAX;
    if ids.len() < robots.len() || robots.len() > ROBOTS_MAX || !robots.iter().all(fits) {
        return Err(BackupMisfit::Malformed);
    }
    let goes_on = goes_on || store::check_folder(data).is_err();
    let here = robots_in(data);
    if goes_on || robots.is_empty() || here.is_empty() || are_same(&here, robots) {
        return Ok(());
    }
    Err(BackupMisfit::Others(data.to_owned()))
}

/// Puts robots and their orders into a data folder.
///
/// # Errors
/// If they cannot be written.
pub fn put_robots(data: &Path, robots: &[BackedUpRobot]) -> std::io::Result<()> {
    for robot in robots {
        RobotOrder::within(Some(data), &robot.id).replace(robot.order.clone())?;
    }
    let known = |robot: &BackedUpRobot| RegisteredRobot {
        robot: robot.id.clone(),
        name: robot.name.clone(),
        seed: robot.seed,
        real: robot.real.as_ref().map(real),
    };
    let mut known: Vec<_> = robots.iter().map(known).collect();
    let mut register = Register::within(Some(data), SEED);
    // The register keeps what it knows of a body by now, where a backup from before does not know it.
    for RegisteredRobot { robot, real, .. } in &mut known {
        if let (Some(real), Some(before)) = (real, register.real(robot)) {
            real.identity = real.identity.take().or_else(|| before.identity.clone());
        }
    }
    if known.is_empty() { Ok(()) } else { register.replace(known) }
}

#[cfg(test)]
mod tests {
    use super::{BackedUpBody, BackedUpRobot, Identity, Register, check_robots, put_robots, robots_in};
    use behaviour::Id;
    use protocol::RealRobot;

    fn robot(name: &str, order: &[&str]) -> BackedUpRobot {
        let id = |text: &&str| Id::new(text).unwrap();
        let order = order.iter().map(id).collect();
        BackedUpRobot { id: id(&name), name: name.to_uppercase(), seed: 7, real: None, order }
    }

    #[test]
    fn a_password_is_in_no_backup_and_which_body_it_is_is() {
        let folder = tempfile::tempdir().unwrap();
        let real = RealRobot {
            address: "nao.local".into(),
            user: Some("nao".into()),
            password: Some("hush".into()),
            fingerprint: None,
            identity: Some(Identity { name: "Momo".into(), serial: "B1".into(), ..Identity::default() }),
        };
        let mut register = Register::within(Some(folder.path()), 1);
        let known = register.newcomer(&Id::new("a").unwrap(), "NAO", Some(real.clone())).unwrap();
        register.add(known).unwrap();
        let kept = robots_in(folder.path());
        assert!(!serde_json::to_string(&kept).unwrap().contains("hush"));
        let other = tempfile::tempdir().unwrap();
        put_robots(other.path(), &kept).unwrap();
        let again = Register::within(Some(other.path()), 1);
        assert_eq!(again.known()[1].real, Some(RealRobot { password: None, ..real.clone() }));
        // A backup from before bodies were known is the same, and takes nothing away.
        let mut before = kept.clone();
        before[1].real.as_mut().unwrap().body = None;
        assert_eq!(check_robots(other.path(), &before, false), Ok(()));
        put_robots(other.path(), &before).unwrap();
        assert_eq!(robots_in(other.path()), kept);
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
        let long = [BackedUpRobot { name: "x".repeat(41), ..robot("one", &[]) }];
        let unseen = [BackedUpRobot { name: "a\0b".to_owned(), ..robot("one", &[]) }];
        let told = BackedUpBody { name: "x".repeat(201), ..BackedUpBody::default() };
        let real = store::backup::Reached { address: "nao".into(), user: None, fingerprint: None, body: Some(told) };
        let bodies = [BackedUpRobot { real: Some(real), ..robot("one", &[]) }];
        let many: Vec<_> = (0..100).map(|number| robot(&format!("r{number}"), &[])).collect();
        for robots in [&twice[..], &long, &unseen, &bodies, &many] {
            assert!(check_robots(folder.path(), robots, false).is_err());
        }
    }
}
