//! The condition of the robot, who has it, and why everything ends.

use crate::hash::RunningHash;
use crate::nao::SimulatedNao;
use crate::nao::devices::{PostureKind, face};
use phrase::{Phrase, phrase};
use robot::{Condition, Control, Life, RobotFault};
use std::sync::Arc;

/// The speed at which it stands up and crouches for control, as a fraction of the speed of a posture.
const SPEED: f32 = 0.5;

/// The robot's own state: motors, life of its own, rest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OwnState {
    /// True if its motors are on and it holds a posture.
    pub(crate) awake: bool,
    pub(crate) stiff: bool,
    life: Life,
    /// The life of its own before control was taken.
    before: Option<Life>,
    /// Crouching, to rest then.
    resting: bool,
    /// True if its battery is known to be empty.
    pub(crate) empty: bool,
}

impl Default for OwnState {
    fn default() -> Self {
        Self { awake: true, stiff: true, life: Life::Disabled, before: None, resting: false, empty: false }
    }
}

impl OwnState {
    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.text(&format!("{self:?}"));
    }
}

impl SimulatedNao {
    /// Checks that it may move its body.
    ///
    /// # Errors
    /// Why not now, and what to do.
    pub(crate) fn ready(&self) -> Result<(), RobotFault> {
        self.able()?;
        let rests = !self.own.awake || self.own.resting;
        if rests {
            Err(RobotFault::NotNow(phrase!("nao.it_rests_take_control_first", "it rests; take control first")))
        } else {
            Ok(())
        }
    }

    /// Checks that it could move its body if it were awake.
    fn able(&self) -> Result<(), RobotFault> {
        let why = match (self.lean.is_fallen(), self.own.empty) {
            (true, _) => phrase!("nao.it_lies_on_the_floor", "it lies on the floor; help it up first"),
            (false, true) => phrase!("nao.its_battery_is_empty_put", "its battery is empty; put it on the cable first"),
            (false, false) => return Ok(()),
        };
        Err(RobotFault::NotNow(why))
    }

    /// Ends everything for this reason, which is told once.
    pub(crate) fn halt(&mut self, why: Phrase) {
        self.hold();
        self.halted.get_or_insert(why);
    }

    /// Takes control, gives it back, wakes up, rests, stands, sits, or forgets faces.
    pub(crate) fn control_by(&mut self, control: Control) -> Result<(), RobotFault> {
        let own = &mut self.own;
        match control {
            // The page shows which one it is.
            Control::Blink => {}
            Control::GiveBack => own.life = own.before.take().unwrap_or(own.life),
            Control::Take => {
                self.wake()?;
                self.own.before.get_or_insert(self.own.life);
                self.own.life = Life::Disabled;
            }
            Control::Rest => {
                self.able()?;
                self.hold();
                self.assume(PostureKind::Crouch, SPEED, None);
                self.own.resting = true;
            }
            Control::WakeUp => self.wake()?,
            Control::Stand => {
                self.ready()?;
                self.assume(PostureKind::Stand, SPEED, None);
            }
            Control::Sit => {
                self.ready()?;
                self.assume(PostureKind::Sit, SPEED, None);
            }
            Control::ForgetFaces => self.known.fill(false),
            Control::ForgetFace(name) => {
                let nobody = || {
                    RobotFault::NotNow(phrase!("nao.it_remembers_nobody_of_that", "it remembers nobody of that name"))
                };
                let person = (0..self.known.len()).find(|person| self.known[*person] && face(*person) == name);
                self.known[person.ok_or_else(nobody)?] = false;
            }
        }
        Ok(())
    }

    fn wake(&mut self) -> Result<(), RobotFault> {
        self.able()?;
        let slept = !self.own.awake || self.own.resting;
        (self.own.awake, self.own.stiff, self.own.resting) = (true, true, false);
        if slept || self.family() != PostureKind::Stand.family() {
            self.assume(PostureKind::Stand, SPEED, None);
        }
        Ok(())
    }

    /// It has crouched: if that was to rest, its motors go off.
    pub(crate) fn fall_asleep(&mut self) {
        if self.own.resting {
            (self.own.awake, self.own.stiff, self.own.resting) = (false, false, false);
        }
    }

    /// Nothing moves, sounds or speaks any more; joints hold where they are.
    pub(crate) fn hold(&mut self) {
        self.end_motion();
        self.base.hold();
        self.servo.hold();
        self.speech.stop(self.now);
        self.sounds.stop(self.now);
        self.own.resting = false;
        self.safe = true;
    }

    /// Ends whatever moves the body; joints go on to where they were sent.
    pub(crate) fn end_motion(&mut self) {
        self.follow = None;
        self.points.clear();
        self.playing = None;
        self.going = None;
        self.stand_still();
    }

    /// The names under which it remembers faces.
    pub(crate) fn faces_now(&self) -> Arc<[String]> {
        self.known.iter().enumerate().filter(|(_, known)| **known).map(|(person, _)| face(person)).collect()
    }

    /// Returns the condition of the body, for people.
    pub(crate) fn condition_now(&self) -> Condition {
        Condition {
            battery: Some(self.charge.percent()),
            plugged: Some(self.charge.plugged),
            awake: Some(self.own.awake),
            stiff: Some(self.own.stiff),
            life: Some(self.own.life),
            hot: Vec::new(),
            fallen: Some(self.lean.is_fallen()),
            legs: self.check_legs().err(),
            // It is in no network.
            network: None,
            faces: u16::try_from(self.known.iter().filter(|known| **known).count()).ok(),
        }
    }
}
