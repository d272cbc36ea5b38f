//! What people do in the simulated room.

use crate::base::Base;
use crate::body::Body;
use crate::eyes::Eyes;
use crate::math::vector;
use crate::nao::SimulatedNao;
use crate::room::{ball_place, person_place};
use crate::servo::Servo;
use crate::world::World;
use robot::SceneEdit;
use std::fmt;

/// Fastest throw in metres a second; a child throws at 1.5 to 5.
const THROW_MPS: f32 = 300.0;

/// Why something cannot be done in the simulated room. [`fmt::Display`] says it in a few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RoomFault {
    /// There is no ball of this name.
    NoBall(String),
    /// There is no person of this name.
    NoPerson(String),
    /// A place or a speed has a number that is not finite.
    Infinite,
}

impl SimulatedNao {
    /// Does what a person does in the room. Places are brought inside the room and outside the robot.
    ///
    /// # Errors
    /// Why not, if there is no such ball or person or a place is not finite; nothing changes then.
    pub fn edit(&mut self, edit: &SceneEdit) -> Result<(), RoomFault> {
        match edit {
            SceneEdit::MoveBall { id, at } => self.move_ball(id, *at),
            SceneEdit::MovePerson { id, at } => self.move_person(id, *at),
            SceneEdit::SetPresent { id, present } => self.set_present(id, *present),
            SceneEdit::TouchHead { down } => {
                self.touch_head(*down);
                Ok(())
            }
            SceneEdit::Reset => {
                self.reset();
                Ok(())
            }
        }
    }

    /// Lets a ball go with a speed in metres a second (x, y, z), at most 300: it falls, rolls and bounces from the
    /// robot, the floor and the walls until somebody moves it again.
    ///
    /// # Errors
    /// Why not, if there is no such ball or the speed is not finite.
    pub fn throw_ball(&mut self, id: &str, speed: [f32; 3]) -> Result<(), RoomFault> {
        finite(&speed)?;
        let ball = self.ball(id)?;
        self.world.throw_ball(ball, vector(speed.map(|part| part.clamp(-THROW_MPS, THROW_MPS))));
        Ok(())
    }

    fn ball(&self, id: &str) -> Result<usize, RoomFault> {
        let found = self.world.balls.iter().position(|ball| ball.color == id);
        found.ok_or_else(|| RoomFault::NoBall(id.to_owned()))
    }

    fn person(&self, id: &str) -> Result<usize, RoomFault> {
        let found = self.world.people.iter().position(|person| person.id == id);
        found.ok_or_else(|| RoomFault::NoPerson(id.to_owned()))
    }

    fn move_ball(&mut self, id: &str, at: [f32; 3]) -> Result<(), RoomFault> {
        finite(&at)?;
        let ball = self.ball(id)?;
        self.world.hold_ball(ball, ball_place(vector(at), self.base.at));
        Ok(())
    }

    fn move_person(&mut self, id: &str, at: [f32; 2]) -> Result<(), RoomFault> {
        finite(&at)?;
        let person = self.person(id)?;
        let present = self.world.people[person].present;
        self.world.put_person(person, person_place(at, self.base.at), present);
        Ok(())
    }

    fn set_present(&mut self, id: &str, present: bool) -> Result<(), RoomFault> {
        let person = self.person(id)?;
        let at = person_place(self.world.people[person].at, self.base.at);
        self.world.put_person(person, at, present);
        Ok(())
    }

    fn touch_head(&mut self, down: bool) {
        if self.touched != down {
            self.touched = down;
            self.senses.touch(down);
        }
    }

    /// Everything as it was at first. Robot time goes on and open devices stay open.
    fn reset(&mut self) {
        self.touch_head(false);
        self.body = Body::new(self.model);
        self.world = World::new(self.model, &self.body);
        self.servo = Servo::new(self.model);
        self.base = Base::default();
        (self.follow, self.points) = (None, Vec::new());
        self.speech.stop(self.now);
        self.eyes = Eyes::default();
        self.printed.clear();
        self.known.fill(false);
    }
}

fn finite(numbers: &[f32]) -> Result<(), RoomFault> {
    if numbers.iter().all(|number| number.is_finite()) { Ok(()) } else { Err(RoomFault::Infinite) }
}

impl std::error::Error for RoomFault {}

impl fmt::Display for RoomFault {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoBall(id) => write!(to, "there is no ball called “{}”", shown(id)),
            Self::NoPerson(id) => write!(to, "there is no person called “{}”", shown(id)),
            Self::Infinite => to.write_str("a place needs finite numbers"),
        }
    }
}

fn shown(id: &str) -> String {
    id.chars().take(40).collect()
}
