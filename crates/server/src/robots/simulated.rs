//! The simulated NAO as the robot's thread sees it.

use super::robot_thread::RoomRobot;
use robot::SceneEdit;
use simulation::SimulatedNao;

/// A simulated NAO that behaves the same for the same seed.
pub(super) fn nao(seed: u64) -> SimulatedNao {
    SimulatedNao::new(seed)
}

impl RoomRobot for SimulatedNao {
    fn edit(&mut self, edit: &SceneEdit) {
        if let Err(fault) = Self::edit(self, edit) {
            tracing::debug!(%fault, "nothing changed in the room");
        }
    }
}
