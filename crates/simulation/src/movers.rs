//! The use that moves each motor: when a use of the robot ends, what it moves holds, and nothing else does.

use crate::hash::{RunningHash, digest_use};
use robot::Use;
use std::collections::BTreeMap;

/// The last use that sent each motor somewhere.
#[derive(Default)]
pub(crate) struct Movers(BTreeMap<usize, Use>);

impl Movers {
    /// A use sends motors somewhere.
    pub(crate) fn take(&mut self, motors: impl IntoIterator<Item = usize>, user: &Use) {
        for motor in motors {
            if self.0.get(&motor) != Some(user) {
                self.0.insert(motor, user.clone());
            }
        }
    }

    /// A use ends: the motors that were its own are nobody's.
    pub(crate) fn end(&mut self, user: &Use) -> Vec<usize> {
        let own: Vec<usize> = self.0.iter().filter(|(_, mover)| *mover == user).map(|(motor, _)| *motor).collect();
        own.iter().for_each(|motor| drop(self.0.remove(motor)));
        own
    }

    /// True if a motor was last sent somewhere by this use.
    pub(crate) fn is(&self, motor: usize, user: &Use) -> bool {
        self.0.get(&motor) == Some(user)
    }

    /// Motors are nobody's.
    pub(crate) fn free(&mut self, motors: impl IntoIterator<Item = usize>) {
        motors.into_iter().for_each(|motor| drop(self.0.remove(&motor)));
    }

    /// Adds who moves what.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.count(self.0.len());
        for (motor, user) in &self.0 {
            digest.count(*motor);
            digest_use(user, digest);
        }
    }
}
