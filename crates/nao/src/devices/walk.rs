//! Walking with the speed of the newest value, until half a second after it; by itself it ends within a second (`legs.rs`).

use super::{NaoDriver, OpenActuator, OpenDevice, number};
use crate::deed::Action;
use behaviour::Value;
use robot::RobotFault;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Walk",
    services: &["ALMotion"],
    joints: &[],
    open: |chosen| OpenDevice::act(Walk { speed: chosen.number("speed")?, turn: chosen.number("turn")? }),
};

/// The caps: metres and radians a second.
struct Walk {
    speed: f64,
    turn: f64,
}

impl OpenActuator for Walk {
    /// A number walks ahead; a field that is left out is 0.
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let given = match value {
            Value::Map(_) => ["x", "y", "turn"].map(|name| value.field(name)),
            number => [Some(number), None, None],
        };
        if given.iter().all(Option::is_none) {
            return Err(RobotFault::NoNumber);
        }
        let mut speeds = [0.0; 3];
        for ((speed, field), cap) in speeds.iter_mut().zip(given).zip([self.speed, self.speed, self.turn]) {
            *speed = field.map_or(Ok(0.0), number)?.clamp(-cap, cap);
        }
        Ok(Action::Walk(speeds))
    }
}

#[cfg(test)]
mod tests {
    use super::{Action, OpenActuator, Walk};
    use behaviour::Value;

    #[test]
    fn nobody_walks_faster_than_chosen() {
        let walk = Walk { speed: 0.05, turn: 0.3 };
        assert_eq!(walk.deed(&Value::Float(9.0)), Ok(Action::Walk([0.05, 0.0, 0.0])));
        let turn = Value::object([("turn", Value::Float(-2.0))]);
        assert_eq!(walk.deed(&turn), Ok(Action::Walk([0.0, 0.0, -0.3])));
        assert!(walk.deed(&Value::text("go")).is_err());
    }
}
