//! The things that people do in the simulated room.

use crate::base::Base;
use crate::body::BodyPoses;
use crate::math::{Vector, vector, wrapped};
use crate::nao::SimulatedNao;
use crate::nao::condition::OwnState;
use crate::nao::devices::{Charge, Eyes, Lean, RoomClock};
use crate::nao::hearing::RoomSound;
use crate::room::{ball_place, inside, obstacle_place, person_place};
use crate::servo::Servo;
use crate::world::World;
use phrase::{Phrase, Phrased, phrase};
use robot::{SPOKEN_MAX_CHARS, SceneEdit};
use std::sync::Arc;

/// Fastest throw in metres a second; a child throws at 1.5 to 5.
const THROW_MPS: f32 = 300.0;

/// The loudness of somebody who speaks, and of a clap, from 0 to 1; our planning values.
const LOUDNESS: [f32; 2] = [0.6, 0.95];
/// Somebody who is not there speaks so far ahead of the robot, and so high, in metres.
const VOICE_M: [f32; 2] = [1.0, 1.0];

/// Why something cannot be done in the simulated room. [`std::fmt::Display`] says it in a few English words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RoomFault {
    /// There is no ball of this name.
    NoBall(String),
    /// There is no person of this name.
    NoPerson(String),
    /// There is no obstacle of this name.
    NoObstacle(String),
    /// There is no printed mark of this name.
    NoLandmark(String),
    /// There is neither a person nor a thing of this name.
    Nothing(String),
    /// Nothing was said.
    NoWords,
    /// The words that were said are longer than so many characters.
    WordsTooLong(usize),
    /// The sound is left out, as so much is heard at once.
    TooLoud,
    /// A battery cannot be so full, in percent.
    TooFull(u8),
    /// A place or a speed has a number that is not finite.
    Infinite,
}

impl SimulatedNao {
    /// Does what a person does in the room. Places are brought inside the room and outside the robot.
    ///
    /// # Errors
    /// Why not, if there is no such thing or person, a place is not finite, or words are too long; nothing changes then.
    pub fn edit(&mut self, edit: &SceneEdit) -> Result<(), RoomFault> {
        match edit {
            SceneEdit::MoveBall { id, at } => self.move_ball(id, *at)?,
            SceneEdit::MovePerson { id, at } => self.move_person(id, *at)?,
            SceneEdit::MoveObstacle { id, at } => self.move_obstacle(id, *at)?,
            SceneEdit::MoveLandmark { id, at, facing } => self.move_landmark(id, *at, *facing)?,
            SceneEdit::SetPresent { id, present } => self.set_present(id, *present)?,
            SceneEdit::Touch { part, down } => self.pads.touch(*part, *down),
            SceneEdit::Speak { words } => self.speak(words)?,
            SceneEdit::Noise { at } => {
                finite(at)?;
                self.sound(None, inside(*at), LOUDNESS[1])?;
            }
            SceneEdit::SetBattery { percent: more @ 101.. } => return Err(RoomFault::TooFull(*more)),
            SceneEdit::SetBattery { percent } => self.charge.set(*percent),
            SceneEdit::Plug { plugged } => self.charge.plugged = *plugged,
            SceneEdit::PassTime { minutes } => self.clock.pass(*minutes),
            SceneEdit::Push => self.push(),
            SceneEdit::HelpUp => self.help_up(),
            SceneEdit::Reset => self.reset(),
        }
        Ok(())
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

    fn move_obstacle(&mut self, id: &str, at: [f32; 2]) -> Result<(), RoomFault> {
        finite(&at)?;
        let found = self.world.obstacles.iter().position(|obstacle| obstacle.id == id);
        let found = found.ok_or_else(|| RoomFault::NoObstacle(id.to_owned()))?;
        let obstacle = &self.world.obstacles[found];
        let (at, present) = (obstacle_place(at, obstacle.size, self.base.at), obstacle.present);
        self.world.put_obstacle(found, at, present);
        Ok(())
    }

    fn move_landmark(&mut self, id: &str, at: [f32; 3], facing: f32) -> Result<(), RoomFault> {
        finite(&at)?;
        finite(&[facing])?;
        let found = self.world.marks.iter_mut().find(|mark| mark.id == id);
        let mark = found.ok_or_else(|| RoomFault::NoLandmark(id.to_owned()))?;
        (mark.at, mark.facing) = (inside(at), wrapped(facing));
        Ok(())
    }

    fn set_present(&mut self, id: &str, present: bool) -> Result<(), RoomFault> {
        if let Ok(person) = self.person(id) {
            let at = person_place(self.world.people[person].at, self.base.at);
            self.world.put_person(person, at, present);
        } else if let Some(found) = self.world.obstacles.iter().position(|obstacle| obstacle.id == id) {
            let obstacle = &self.world.obstacles[found];
            let at = obstacle_place(obstacle.at, obstacle.size, self.base.at);
            self.world.put_obstacle(found, at, present);
        } else if let Some(mark) = self.world.marks.iter_mut().find(|mark| mark.id == id) {
            mark.present = present;
        } else {
            return Err(RoomFault::Nothing(id.to_owned()));
        }
        Ok(())
    }

    fn speak(&mut self, words: &str) -> Result<(), RoomFault> {
        let words = words.trim();
        if words.is_empty() {
            return Err(RoomFault::NoWords);
        }
        if words.chars().count() > SPOKEN_MAX_CHARS {
            return Err(RoomFault::WordsTooLong(SPOKEN_MAX_CHARS));
        }
        self.sound(Some(Arc::from(words)), self.voice(), LOUDNESS[0])
    }

    /// Where a voice comes from: the nearest person's head, or ahead of the robot.
    fn voice(&self) -> Vector {
        let ears = self.body.head().translation;
        let heads = self.world.people.iter().filter(|person| person.present).map(World::head_at);
        let nearest = heads.min_by(|one, other| (*one - ears).length().total_cmp(&(*other - ears).length()));
        nearest.unwrap_or_else(|| {
            let [x, y, heading] = self.base.at;
            let (sin, cos) = libm::sincosf(heading);
            Vector::new(x + cos * VOICE_M[0], y + sin * VOICE_M[0], VOICE_M[1])
        })
    }

    fn sound(&mut self, words: Option<Arc<str>>, at: Vector, loudness: f32) -> Result<(), RoomFault> {
        if self.hearing.make(RoomSound { words, at, loudness }) { Ok(()) } else { Err(RoomFault::TooLoud) }
    }

    /// Everything as it was at first. Robot time goes on and open devices stay open.
    fn reset(&mut self) {
        self.end_motion();
        self.pads.let_go();
        self.hearing.forget();
        self.sounds.stop(self.now);
        (self.lean, self.charge, self.own) = (Lean::default(), Charge::default(), OwnState::default());
        self.clock = RoomClock::default();
        self.halted = None;
        self.body = BodyPoses::new(self.model);
        self.world = World::new(self.model, &self.body);
        self.servo = Servo::new(self.model);
        self.base = Base::default();
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

phrase::shown!(RoomFault);

impl Phrased for RoomFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::NoBall(id) => phrase!("RoomFault.NoBall", "there is no ball called “{id}”", id = shown(id)),
            Self::NoPerson(id) => phrase!("RoomFault.NoPerson", "there is no person called “{id}”", id = shown(id)),
            Self::NoObstacle(id) => {
                phrase!("RoomFault.NoObstacle", "there is no obstacle called “{id}”", id = shown(id))
            }
            Self::NoLandmark(id) => {
                phrase!("RoomFault.NoLandmark", "there is no printed mark called “{id}”", id = shown(id))
            }
            Self::Nothing(id) => phrase!("RoomFault.Nothing", "nobody and nothing is called “{id}”", id = shown(id)),
            Self::NoWords => phrase!("RoomFault.NoWords", "there are no words to say; write some"),
            Self::WordsTooLong(chars) => {
                phrase!("RoomFault.WordsTooLong", "somebody may say {chars} characters at once")
            }
            Self::TooLoud => {
                phrase!("RoomFault.TooLoud", "too much is said at once, so this was left out; wait a moment")
            }
            Self::TooFull(percent) => phrase!("RoomFault.TooFull", "a battery holds 0 to 100 percent, not {percent}"),
            Self::Infinite => phrase!("RoomFault.Infinite", "a place needs finite numbers"),
        }
    }
}

fn shown(id: &str) -> String {
    id.chars().take(40).collect()
}
