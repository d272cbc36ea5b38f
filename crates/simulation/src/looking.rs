//! The robot looks around: the largest ball of a colour and the largest face in view.

use crate::math::Vector;
use crate::nao::SimulatedNao;
use crate::room::{HEAD_M, MARK_M};
use crate::sight::{Round, Sighting, look};
use crate::world::{ObstacleBody, World};
use rapier3d::prelude::RigidBodyHandle;
use robot::TrackTarget;

/// Faces are found up to this distance in metres.
const FACE_M: f32 = 3.0;
/// People are found from here to here in metres, as ALPeoplePerception finds them.
const PEOPLE_M: [f32; 2] = [0.5, 3.5];
/// Printed marks are read when their diameter looks so large, in radians: 2° to 23° ...
const MARK_SIZE: [f32; 2] = [0.034_907, 0.401_426];
/// ... and when they are turned away less than 45°: the cosine of that.
const MARK_COS: f32 = core::f32::consts::FRAC_1_SQRT_2;
/// A face is seen well enough to be learned up to this distance in metres.
const LEARN_M: f32 = 2.0;
/// Radius of the ball the tracker assumes, in metres; a camera knows distances only from known sizes.
const BALL_M: f32 = 0.03;

impl SimulatedNao {
    /// Returns what the camera sees of a ball, undisturbed.
    pub(crate) fn ball_in_view(&self, ball: usize) -> Option<Sighting> {
        let ball = &self.world.balls[ball];
        let round = Round { at: self.world.ball_at(ball), radius: ball.radius, body: ball.body };
        look(&self.world, &self.body.camera(), self.model.camera.half, &round)
    }

    /// Returns what the camera sees of a face, undisturbed. People always face the robot.
    pub(crate) fn face_in_view(&self, person: usize) -> Option<Sighting> {
        let someone = &self.world.people[person];
        if !someone.present || self.face_distance(person) > FACE_M {
            return None;
        }
        self.head_in_view(person)
    }

    fn head_in_view(&self, person: usize) -> Option<Sighting> {
        let someone = &self.world.people[person];
        let round = Round { at: World::head_at(someone), radius: HEAD_M, body: someone.body };
        look(&self.world, &self.body.camera(), self.model.camera.half, &round)
    }

    fn face_distance(&self, person: usize) -> f32 {
        (World::head_at(&self.world.people[person]) - self.body.camera().translation).length()
    }

    /// True if a face is near enough to be learned.
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

    /// Returns what the camera sees of anything of a colour: its largest ball or box, the latter as a circle as large.
    pub(crate) fn see_colored(&mut self, color: &str) -> Option<Sighting> {
        let boxes = self.world.in_the_way().filter(|obstacle| obstacle.color == color);
        let boxes = boxes.filter_map(|obstacle| self.box_in_view(obstacle));
        let balls = (0..self.world.balls.len()).filter(|ball| self.world.balls[*ball].color == color);
        let seen = balls.filter_map(|ball| self.ball_in_view(ball)).chain(boxes);
        let seen = seen.max_by(|one, other| one.size.total_cmp(&other.size))?;
        self.random.disturb(self.noise, seen)
    }

    fn box_in_view(&self, obstacle: &ObstacleBody) -> Option<Sighting> {
        let [long, wide, high] = obstacle.size;
        let at = Vector::new(obstacle.at[0], obstacle.at[1], high / 2.0);
        let round = Round { at, radius: (long + wide + high) / 6.0, body: obstacle.body };
        look(&self.world, &self.body.camera(), self.model.camera.half, &round)
    }

    /// The people whose faces the camera finds, near enough and not too near: who, how far in metres, and where.
    pub(crate) fn see_people(&mut self) -> Vec<(usize, f32, Sighting)> {
        let here = (0..self.world.people.len()).filter(|person| self.world.people[*person].present);
        let here: Vec<_> = here.map(|person| (person, self.face_distance(person))).collect();
        let near = here.into_iter().filter(|(_, distance)| (PEOPLE_M[0]..=PEOPLE_M[1]).contains(distance));
        let seen: Vec<_> = near.filter_map(|(person, far)| Some((person, far, self.head_in_view(person)?))).collect();
        let disturbed = |(person, far, seen)| Some((person, far, self.random.disturb(self.noise, seen)?));
        seen.into_iter().filter_map(disturbed).collect()
    }

    /// Returns what the camera sees of a printed mark that it can read, undisturbed.
    pub(crate) fn mark_in_view(&self, mark: usize) -> Option<Sighting> {
        let mark = &self.world.marks[mark];
        let camera = self.body.camera();
        let (sin, cos) = libm::sincosf(mark.facing);
        let way = camera.translation - mark.at;
        let turned = Vector::new(cos, sin, 0.0).dot(way) / way.length().max(1e-6);
        if !mark.present || turned < MARK_COS {
            return None;
        }
        let round = Round { at: mark.at, radius: MARK_M, body: RigidBodyHandle::invalid() };
        let seen = look(&self.world, &camera, self.model.camera.half, &round)?;
        (MARK_SIZE[0]..=MARK_SIZE[1]).contains(&(2.0 * seen.size)).then_some(seen)
    }

    /// The mark of this number, 0 for any, that looks largest, as the camera reports it.
    pub(crate) fn see_mark(&mut self, number: u16) -> Option<(usize, Sighting)> {
        let wanted = |mark: &usize| number == 0 || self.world.marks[*mark].number == number;
        let marks = (0..self.world.marks.len()).filter(wanted);
        let seen = largest(marks.filter_map(|mark| Some((mark, self.mark_in_view(mark)?))))?;
        self.random.disturb(self.noise, seen.1).map(|disturbed| (seen.0, disturbed))
    }

    /// A target of a tracker: what the camera reports, and where that is in the torso's frame in metres.
    pub(crate) fn see_target(&mut self, target: TrackTarget) -> Option<(Sighting, Vector)> {
        let (seen, radius) = match target {
            TrackTarget::RedBall => (self.see_ball("red")?.1, BALL_M),
            TrackTarget::Face => (self.see_face()?.1, HEAD_M),
        };
        let in_room = self.body.camera().transform_point(seen.place(radius));
        Some((seen, self.body.torso().inverse_transform_point(in_room)))
    }
}

fn largest(seen: impl Iterator<Item = (usize, Sighting)>) -> Option<(usize, Sighting)> {
    seen.max_by(|one, other| one.1.size.total_cmp(&other.1.size))
}
