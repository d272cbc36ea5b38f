//! Which body each robot is: kept as soon as it is known, and compared with the others, as one body under two names would be
//! told two things at once. On a thread of its own, as the disk may take its time.

use super::Fleet;
use super::refusal::RobotsUnchanged;
use crate::support::lock;
use behaviour::Id;
use protocol::{RealRobot, RobotState};
use robot::{Health, Identity};
use std::sync::Arc;

/// Starts the thread, which ends with the robots.
///
/// # Errors
/// If it cannot be made.
pub(super) fn start(fleet: &Arc<Fleet>) -> std::io::Result<()> {
    let (mut states, fleet) = (fleet.feed.robots(), Arc::downgrade(fleet));
    let runtime = tokio::runtime::Builder::new_current_thread().build()?;
    let work = async move {
        loop {
            let now = Arc::clone(&states.borrow_and_update());
            let Some(fleet) = fleet.upgrade() else { return };
            now.iter().for_each(|state| fleet.note(state));
            drop(fleet);
            if states.changed().await.is_err() {
                return;
            }
        }
    };
    std::thread::Builder::new().name("identities".into()).spawn(move || runtime.block_on(work)).map(drop)
}

impl Fleet {
    /// Keeps which body a robot is, unless another one is that body.
    fn note(&self, state: &RobotState) {
        let (Some(found), robot) = (&state.identity, &state.robot) else { return };
        let mut register = lock(&self.register);
        let Some(real) = register.real(robot).cloned() else { return };
        // Told of the one before, just as people said that another one is meant.
        if real.identity.as_ref().is_some_and(|kept| !kept.is_same(found)) {
            return;
        }
        let twin = register.twin(found, Some(robot)).map(str::to_owned);
        if twin.is_none() && real.identity.as_ref() != Some(found) {
            let kept = register.reach(robot, RealRobot { identity: Some(found.clone()), ..real });
            if let Err(why) = kept {
                tracing::warn!(%robot, %why, "which body a robot is could not be kept");
            }
        }
        drop(register);
        self.feed.edit(robot, |state| state.same_as = twin);
    }
}

impl super::Robots {
    /// The name of another robot here than `but` that is this body.
    pub(crate) fn known_as(&self, identity: &Identity, but: Option<&Id>) -> Option<String> {
        lock(&self.fleet.register).twin(identity, but).map(str::to_owned)
    }

    /// A way to a robot with the login that it has, unless another one is said.
    pub(crate) fn with_login(&self, robot: &Id, real: RealRobot) -> RealRobot {
        let register = lock(&self.fleet.register);
        match register.real(robot) {
            Some(known) if real.user.is_none() && real.password.is_none() => {
                RealRobot { user: known.user.clone(), password: known.password.clone(), ..real }
            }
            _ => real,
        }
    }

    /// Gives a real robot another address; the body that answers there must be the same.
    ///
    /// # Errors
    /// Why it keeps the old one. Waits for the disk.
    pub(crate) fn reach(&self, robot: &Id, real: RealRobot) -> Result<(), protocol::Refused> {
        let real = self.with_login(robot, real);
        self.renew(robot, |known| Ok(RealRobot { identity: known.identity.clone(), ..real }))
    }

    /// From now on the body that answers is this robot.
    ///
    /// # Errors
    /// Why it stays a stranger. Waits for the disk.
    pub(crate) fn accept(&self, robot: &Id, found: &Identity) -> Result<(), protocol::Refused> {
        let answers = self.fleet.feed.stranger(robot);
        self.renew(robot, |known| {
            if answers.is_none_or(|stranger| stranger.found != *found) {
                return Err(RobotsUnchanged::AnotherOne);
            }
            Ok(RealRobot { identity: Some(found.clone()), ..known.clone() })
        })
    }

    /// Makes a robot anew that is reached in another way from now on.
    fn renew(
        &self,
        robot: &Id,
        change: impl FnOnce(&RealRobot) -> Result<RealRobot, RobotsUnchanged>,
    ) -> Result<(), protocol::Refused> {
        let mut register = lock(&self.fleet.register);
        let host = self.meant(Some(robot))?;
        host.settle();
        if !host.is_idle() {
            return Err(RobotsUnchanged::InUse.stays());
        }
        let known = register.real(robot).ok_or_else(|| RobotsUnchanged::Simulated.stays())?;
        let real = change(known).map_err(RobotsUnchanged::stays)?;
        if let Some(name) = real.identity.as_ref().and_then(|identity| register.twin(identity, Some(robot))) {
            return Err(RobotsUnchanged::Twin(name.to_owned()).stays());
        }
        let known = register.reach(robot, real).map_err(RobotsUnchanged::stays)?;
        drop(register);
        // First, so that the one of before says no more how it is.
        host.renew();
        self.fleet.feed.edit(robot, |state| {
            state.address = known.real.as_ref().map(|real| real.address.clone());
            state.health = Health::Connecting;
        });
        Ok(())
    }
}
