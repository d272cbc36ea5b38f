//! What every robot can do, done by the simulated one.

use crate::body::Side;
use crate::device::{Device, NAMES, device};
use crate::nao::{STEP_MS, SimulatedNao};
use behaviour::{Params, Value};
use robot::{Ball, Body, Health, Millis, Person, Reading, Robot, RobotFault, Scene, Use};

/// Most open devices.
const USES_MAX: usize = 512;
/// Most steps in one call; the rest follows in the next.
const STEPS_MAX: usize = 1_000;

impl Robot for SimulatedNao {
    fn kind(&self) -> &'static str {
        "nao"
    }

    fn devices(&self) -> Vec<&'static str> {
        NAMES.to_vec()
    }

    fn open(&mut self, user: &Use, name: &str, params: &Params) -> Result<(), RobotFault> {
        let device = device(name, params)?;
        self.close(user);
        if self.senses.len() + self.acts.len() >= USES_MAX {
            return Err(RobotFault::Full(USES_MAX));
        }
        self.safe = false;
        match device {
            Device::Sense(sense) => self.senses.open(user, sense, self.now),
            Device::Act(act) => {
                self.acts.insert(user.clone(), act);
            }
        }
        Ok(())
    }

    fn close(&mut self, user: &Use) {
        self.senses.close(user);
        if self.acts.remove(user).is_some() {
            self.release(user);
            self.speech.end(user, self.now);
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
        self.act(user, &act, value)?;
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
        self.follow = None;
        self.points.clear();
        self.base.hold();
        self.servo.hold();
        self.speech.stop(self.now);
        self.safe = true;
    }

    fn health(&self) -> Health {
        if self.safe { Health::Safe } else { Health::Ready }
    }

    fn scene(&self) -> Scene {
        Scene {
            at_ms: self.now,
            body: self.body_picture(),
            balls: self.ball_pictures(),
            people: self.people_pictures(),
        }
    }
}

impl SimulatedNao {
    fn body_picture(&self) -> Body {
        let hands = [Side::Left, Side::Right].map(|side| self.body.hand(side).to_array());
        Body {
            base: self.base.at,
            joints: self.servo.now.to_vec(),
            eyes: self.eyes.shine(),
            saying: self.speech.saying().to_owned(),
            tracking: self.tracking(),
            printed: self.printed.iter().cloned().collect(),
            gaze: self.body.gaze(),
            gaze_half: self.model.camera.half[0],
            hands,
            head_touched: self.touched,
        }
    }

    fn tracking(&self) -> String {
        let head = self.follow.iter().map(crate::follow::Follow::words);
        let arms = self.points.iter().map(crate::follow::Point::words);
        head.chain(arms).collect::<Vec<_>>().join(", ")
    }

    fn ball_pictures(&self) -> Vec<Ball> {
        let picture = |(index, ball): (usize, &crate::world::BallBody)| Ball {
            id: ball.color.to_owned(),
            color: ball.color.to_owned(),
            at: self.world.ball_at(ball).to_array(),
            radius: ball.radius,
            seen: self.ball_in_view(index).is_some(),
        };
        self.world.balls.iter().enumerate().map(picture).collect()
    }

    fn people_pictures(&self) -> Vec<Person> {
        let picture = |(index, person): (usize, &crate::world::PersonBody)| Person {
            id: person.id.to_owned(),
            at: person.at,
            height: person.height,
            seen: self.face_in_view(index).is_some(),
            known: self.known[index],
            present: person.present,
        };
        self.world.people.iter().enumerate().map(picture).collect()
    }
}
