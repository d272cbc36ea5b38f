//! The robot looks around: the largest ball of a colour and the largest face in view.

use crate::follow::Target;
use crate::math::Vector;
use crate::nao::SimulatedNao;
use crate::room::HEAD_M;
use crate::sight::{Round, Sighting, look};
use crate::world::World;

/// Faces are found up to this distance in metres.
const FACE_M: f32 = 3.0;
/// A face is seen well enough to be learned up to this distance in metres.
const LEARN_M: f32 = 2.0;
/// Radius of the ball the tracker assumes, in metres; a camera knows distances only from known sizes.
const BALL_M: f32 = 0.03;

impl SimulatedNao {
    /// What the camera sees of a ball, undisturbed.
    pub(crate) fn ball_in_view(&self, ball: usize) -> Option<Sighting> {
        let ball = &self.world.balls[ball];
        let round = Round { at: self.world.ball_at(ball), radius: ball.radius, body: ball.body };
        look(&self.world, &self.body.camera(), self.model.camera.half, &round)
    }

    /// What the camera sees of a face, undisturbed. People always face the robot.
    pub(crate) fn face_in_view(&self, person: usize) -> Option<Sighting> {
        let someone = &self.world.people[person];
        if !someone.present || self.face_distance(person) > FACE_M {
            return None;
        }
        let round = Round { at: World::head_at(someone), radius: HEAD_M, body: someone.body };
        look(&self.world, &self.body.camera(), self.model.camera.half, &round)
    }

    fn face_distance(&self, person: usize) -> f32 {
        (World::head_at(&self.world.people[person]) - self.body.camera().translation).length()
    }

    /// Whether a face is near enough to be learned.
    pub(crate) fn is_near(&self, person: usize) -> bool {
        self.face_distance(person) < LEARN_M
    }

    /// The largest ball of a colour as the camera reports it.
    pub(crate) fn see_ball(&mut self, color: &str) -> Option<(usize, Sighting)> {
        let of_color = (0..self.world.balls.len()).filter(|ball| self.world.balls[*ball].color == color);
        let seen = largest(of_color.filter_map(|ball| Some((ball, self.ball_in_view(ball)?))))?;
        self.random.disturb(self.noise, seen.1).map(|disturbed| (seen.0, disturbed))
    }

    /// The largest face as the camera reports it.
    pub(crate) fn see_face(&mut self) -> Option<(usize, Sighting)> {
        let all = 0..self.world.people.len();
        let seen = largest(all.filter_map(|person| Some((person, self.face_in_view(person)?))))?;
        self.random.disturb(self.noise, seen.1).map(|disturbed| (seen.0, disturbed))
    }

    /// A target of a tracker: what the camera reports, and where that is in the torso's frame in metres.
    pub(crate) fn see_target(&mut self, target: Target) -> Option<(Sighting, Vector)> {
        let (seen, radius) = match target {
            Target::RedBall => (self.see_ball("red")?.1, BALL_M),
            Target::Face => (self.see_face()?.1, HEAD_M),
        };
        let in_room = self.body.camera().transform_point(seen.place(radius));
        Some((seen, self.body.torso().inverse_transform_point(in_room)))
    }
}

fn largest(seen: impl Iterator<Item = (usize, Sighting)>) -> Option<(usize, Sighting)> {
    seen.max_by(|one, other| one.1.size.total_cmp(&other.1.size))
}
