//! The simulated robot as a [`Robot`]: it does what every robot can do.

use crate::nao::devices::{SimulatedDevice, names, open};
use crate::nao::installed::installed;
use crate::nao::{STEP_MS, SimulatedNao};
use behaviour::{Params, Value};
use phrase::{Phrase, phrase};
use robot::{Camera, Condition, Control, Health, Installed, Lacking, Millis, Reading, Robot, RobotFault, Scene, Use};
use std::sync::Arc;

/// Most open devices.
const USES_MAX: usize = 512;
/// Most steps in one call; the rest follows in the next.
const STEPS_MAX: usize = 1_000;

impl Robot for SimulatedNao {
    fn kind(&self) -> &'static str {
        "nao"
    }

    fn by_body(&self) -> Phrase {
        phrase!("nao.hold_it_and_press_its", "hold it and press its chest button for 3 seconds")
    }

    fn devices(&self) -> Vec<&'static str> {
        names().collect()
    }

    fn lacking(&self) -> Vec<Lacking> {
        vec![Lacking {
            device: "Tablet".to_owned(),
            why: phrase!("nao.it_has_no_tablet_a", "it has no tablet; a Pepper has one"),
        }]
    }

    fn installed(&self) -> Arc<Installed> {
        installed()
    }

    fn open(&mut self, user: &Use, name: &str, params: &Params) -> Result<(), RobotFault> {
        let device = open(name, params)?;
        self.close(user);
        if self.senses.len() + self.acts.len() >= USES_MAX {
            return Err(RobotFault::Full(USES_MAX));
        }
        self.safe = false;
        match device {
            SimulatedDevice::Sense(sense) => self.senses.open(user, sense, self.now),
            SimulatedDevice::Act(act) => {
                self.acts.insert(user.clone(), act);
            }
        }
        Ok(())
    }

    fn close(&mut self, user: &Use) {
        self.senses.close(user);
        if let Some(act) = self.acts.remove(user) {
            act.end(self, user);
            self.end_going(user);
            for motor in self.movers.end(user) {
                self.servo.hold_one(motor);
            }
        }
    }

    /// Takes effect at the robot time computed so far, at most one step behind the caller's.
    fn command(&mut self, user: &Use, value: &Value, _now: Millis) -> Result<(), RobotFault> {
        let Some(act) = self.acts.get(user).cloned() else {
            return Err(if self.senses.has(user) { RobotFault::IntoSense } else { RobotFault::NotOpen });
        };
        if !value.is_finite() {
            return Err(RobotFault::Infinite);
        }
        if act.moves() {
            self.ready()?;
        }
        act.act(self, user, value)?;
        self.safe = false;
        Ok(())
    }

    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>) {
        for _ in 0..STEPS_MAX {
            if now.0.saturating_sub(self.now) < STEP_MS {
                return;
            }
            self.step();
            self.read(readings);
        }
    }

    fn stop(&mut self, _now: Millis) {
        self.hold();
    }

    fn control(&mut self, control: Control, _now: Millis) -> Result<(), RobotFault> {
        self.control_by(control)
    }

    fn faces(&self) -> Arc<[String]> {
        self.faces_now()
    }

    fn take_halt(&mut self) -> Option<Phrase> {
        self.halted.take()
    }

    fn health(&self) -> Health {
        if self.safe { Health::Safe } else { Health::Ready }
    }

    fn condition(&self) -> Condition {
        self.condition_now()
    }

    fn scene(&self) -> Scene {
        self.picture()
    }

    fn camera(&self) -> Option<Arc<dyn Camera>> {
        Some(Arc::clone(&self.shown) as Arc<dyn Camera>)
    }
}
