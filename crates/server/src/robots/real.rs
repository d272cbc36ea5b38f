//! A real robot as the robot's thread sees it, and what people ask about robots that are not there yet.

use super::Robots;
use super::names::OWN_NAME;
use super::refusal::RobotsUnchanged;
use super::register::check_real;
use super::robot_thread::RoomRobot;
use behaviour::Id;
use nao::{Login, Nao, ReachStep, RobotSettings};
use protocol::{CheckStage, CheckStep, FoundRobot, RealRobot, Refused, RobotFindings, answer};
use robot::SceneEdit;
use std::time::Duration;

/// How long is listened for robots that announce themselves.
const FIND: Duration = Duration::from_millis(2_000);

/// A NAO or Pepper; it connects by itself and for as long as it lasts.
pub(super) fn nao((own_name, former): (String, Vec<String>), real: &RealRobot) -> Nao {
    Nao::start(RobotSettings { former, ..settings(&own_name, real) })
}

fn settings(own_name: &str, real: &RealRobot) -> RobotSettings {
    let login = real
        .user
        .as_ref()
        .map(|user| Login { user: user.clone(), password: real.password.clone().unwrap_or_default() });
    RobotSettings {
        address: real.address.trim().to_owned(),
        login,
        own_name: own_name.to_owned(),
        trusted: real.fingerprint.clone(),
        expected: real.identity.clone(),
        former: Vec::new(),
    }
}

impl RoomRobot for Nao {
    /// A real room is not moved from here.
    fn edit(&mut self, _: &SceneEdit) {}
}

/// Looks step by step whether a robot can be reached, with the login of `robot` where none is said, and whether it is
/// here already under another name.
///
/// # Errors
/// If no robot can have this address.
pub(crate) async fn check(
    robots: &Robots,
    real: &RealRobot,
    robot: Option<&Id>,
) -> Result<answer::RobotChecked, Refused> {
    check_real(real).map_err(RobotsUnchanged::not_added)?;
    let real = robot.map_or_else(|| real.clone(), |robot| robots.with_login(robot, real.clone()));
    let found = nao::check(&settings(OWN_NAME, &real)).await;
    let known_as = found.identity.as_ref().and_then(|identity| robots.known_as(identity, robot));
    let steps = found.steps.into_iter().map(|(step, failed)| CheckStep { stage: stage(step), failed }).collect();
    let (name, model, fingerprint, lacking) = (found.name, found.model, found.fingerprint, found.lacking);
    let identity = found.identity;
    let checked = RobotFindings { steps, name, model, fingerprint, lacking, identity, known_as };
    Ok(answer::RobotChecked { checked: Box::new(checked) })
}

fn stage(step: ReachStep) -> CheckStage {
    match step {
        ReachStep::Name => CheckStage::Name,
        ReachStep::Tcp => CheckStage::Tcp,
        ReachStep::Tls => CheckStage::Tls,
        ReachStep::Login => CheckStage::Login,
        ReachStep::Directory => CheckStage::Directory,
        ReachStep::Services => CheckStage::Services,
    }
}

/// Robots that announce themselves.
///
/// # Errors
/// If the network cannot be listened to.
pub(crate) async fn find() -> Result<answer::FoundRobots, Refused> {
    let found = nao::discover(FIND).await.map_err(|error| Refused::NotSearched(error.to_string().into()))?;
    let robots = found.into_iter().map(|robot| FoundRobot { name: robot.name, address: robot.address });
    Ok(answer::FoundRobots { robots: robots.collect() })
}
