//! The physical room: floor, walls, balls, people and the robot's parts as bodies of rapier.

use crate::body::BodyPoses;
use crate::hash::RunningHash;
use crate::math::{Pose, Vector, across};
use crate::model::BodyModel;
use crate::parts::{add_obstacle, add_parts, add_person, add_room, group};
use crate::room::{self, HALF_M, MARKS, OBSTACLES, PEOPLE, WAIST_M};
use crate::servo::STEP_S;
use rapier3d::prelude::{
    ColliderBuilder, InteractionGroups, InteractionTestMode, PhysicsWorld, QueryFilter, Ray, RigidBodyBuilder,
    RigidBodyHandle, RigidBodyType,
};

/// A surface sends a sonar's ray back if it meets it this steeply: within 41° of straight, so that the floor is silent.
const ECHO_COS: f32 = 0.75;

/// A ball as a body.
pub(crate) struct BallBody {
    pub(crate) color: &'static str,
    pub(crate) radius: f32,
    pub(crate) body: RigidBodyHandle,
    /// Where it goes back to when physics loses it.
    home: Vector,
}

/// A person as a body.
pub(crate) struct PersonBody {
    pub(crate) id: &'static str,
    pub(crate) height: f32,
    pub(crate) at: [f32; 2],
    pub(crate) present: bool,
    pub(crate) body: RigidBodyHandle,
}

/// An obstacle as a body.
pub(crate) struct ObstacleBody {
    pub(crate) id: &'static str,
    pub(crate) color: &'static str,
    pub(crate) at: [f32; 2],
    pub(crate) size: [f32; 3],
    pub(crate) present: bool,
    pub(crate) body: RigidBodyHandle,
}

/// A printed mark, too thin to be a body.
pub(crate) struct WorldMark {
    pub(crate) id: &'static str,
    pub(crate) number: u16,
    pub(crate) at: Vector,
    /// The heading of its front in radians.
    pub(crate) facing: f32,
    pub(crate) present: bool,
}

/// The room with everything in it.
pub(crate) struct World {
    physics: PhysicsWorld,
    parts: Vec<(usize, RigidBodyHandle)>,
    pub(crate) balls: Vec<BallBody>,
    pub(crate) people: Vec<PersonBody>,
    pub(crate) obstacles: Vec<ObstacleBody>,
    pub(crate) marks: Vec<WorldMark>,
}

impl World {
    /// The room as it is at first, the robot standing in it.
    pub(crate) fn new(model: &BodyModel, robot: &BodyPoses) -> Self {
        let mut physics = PhysicsWorld { gravity: Vector::new(0.0, 0.0, -9.81), ..PhysicsWorld::default() };
        physics.integration_parameters.dt = STEP_S;
        add_room(&mut physics);
        let parts = add_parts(&mut physics, model, robot);
        let balls = room::BALLS.iter().map(|kind| add_ball(&mut physics, kind)).collect();
        let people = PEOPLE.iter().map(|kind| PersonBody {
            id: kind.id,
            height: kind.height,
            at: kind.at,
            present: false,
            body: add_person(&mut physics, kind),
        });
        let people = people.collect();
        let obstacles = OBSTACLES.iter().map(|kind| ObstacleBody {
            id: kind.id,
            color: kind.color,
            at: kind.at,
            size: kind.size,
            present: false,
            body: add_obstacle(&mut physics, kind),
        });
        let obstacles = obstacles.collect();
        let mut world = Self { physics, parts, balls, people, obstacles, marks: marks() };
        world.physics.step();
        world
    }

    /// One step: the robot's parts go where its body says, everything else where physics says.
    pub(crate) fn step(&mut self, robot: &BodyPoses, base: [f32; 3]) {
        for (link, part) in &self.parts {
            if let Some(part) = self.physics.bodies.get_mut(*part) {
                part.set_next_kinematic_position(robot.links()[*link]);
            }
        }
        self.keep_balls_off(base);
        self.physics.step();
        self.mend();
    }

    /// Where a ball is.
    pub(crate) fn ball_at(&self, ball: &BallBody) -> Vector {
        self.physics.bodies.get(ball.body).map_or(ball.home, |body| body.translation())
    }

    /// The middle of a person's head.
    pub(crate) fn head_at(person: &PersonBody) -> Vector {
        Vector::new(person.at[0], person.at[1], person.height - room::HEAD_M)
    }

    /// Puts a ball somewhere and holds it there.
    pub(crate) fn hold_ball(&mut self, ball: usize, at: Vector) {
        if let Some(body) = self.balls.get(ball).and_then(|ball| self.physics.bodies.get_mut(ball.body)) {
            body.set_body_type(RigidBodyType::KinematicPositionBased, true);
            body.set_linvel(Vector::ZERO, true);
            body.set_angvel(Vector::ZERO, true);
            body.set_position(Pose::from_translation(at), true);
        }
    }

    /// Lets a ball go with a speed in metres a second.
    pub(crate) fn throw_ball(&mut self, ball: usize, speed: Vector) {
        if let Some(body) = self.balls.get(ball).and_then(|ball| self.physics.bodies.get_mut(ball.body)) {
            body.set_body_type(RigidBodyType::Dynamic, true);
            body.set_linvel(speed, true);
        }
    }

    /// Moves a person's feet and says whether they are in the room.
    pub(crate) fn put_person(&mut self, person: usize, at: [f32; 2], present: bool) {
        let Some(person) = self.people.get_mut(person) else { return };
        (person.at, person.present) = (at, present);
        if let Some(body) = self.physics.bodies.get_mut(person.body) {
            body.set_position(Pose::translation(at[0], at[1], 0.0), true);
            body.set_enabled(present);
        }
    }

    /// Moves an obstacle and says whether it is in the room.
    pub(crate) fn put_obstacle(&mut self, obstacle: usize, at: [f32; 2], present: bool) {
        let Some(obstacle) = self.obstacles.get_mut(obstacle) else { return };
        (obstacle.at, obstacle.present) = (at, present);
        if let Some(body) = self.physics.bodies.get_mut(obstacle.body) {
            body.set_position(Pose::translation(at[0], at[1], obstacle.size[2] / 2.0), true);
            body.set_enabled(present);
        }
    }

    /// The obstacles that are in the room.
    pub(crate) fn in_the_way(&self) -> impl Iterator<Item = &ObstacleBody> {
        self.obstacles.iter().filter(|obstacle| obstacle.present)
    }

    /// True if a foot would meet an obstacle on the way from `base` to `next`, and more than it does already.
    pub(crate) fn obstacle_blocks(&self, robot: &BodyPoses, base: [f32; 3], next: [f32; 2]) -> bool {
        let way = Vector::new(next[0] - base[0], next[1] - base[1], 0.0);
        self.in_the_way().any(|obstacle| {
            let nearest = |way: Vector| {
                robot.corners().map(|corner| obstacle.distance(corner + way)).fold(f32::INFINITY, f32::min)
            };
            let distance = nearest(way);
            distance < room::FOOT_CLEAR_M && distance < nearest(Vector::ZERO)
        })
    }

    /// True if anything is there that a foot could meet.
    pub(crate) fn is_anything_low(&self) -> bool {
        let low = |ball: &BallBody| self.ball_at(ball).z < room::FOOT_M + ball.radius;
        self.in_the_way().next().is_some() || self.balls.iter().any(low)
    }

    /// Returns the distance of the nearest obstacle or ball from a point, in metres; negative inside of it.
    pub(crate) fn distance_to_things(&self, point: Vector) -> f32 {
        let obstacles = self.in_the_way().map(|obstacle| obstacle.distance(point));
        let balls = self.balls.iter().map(|ball| (self.ball_at(ball) - point).length() - ball.radius);
        obstacles.chain(balls).fold(f32::INFINITY, f32::min)
    }

    /// Returns how far a sonar's ray goes before something sends it back, in metres: neither the robot, nor what it
    /// grazes. None if that is more than `most`.
    pub(crate) fn echo(&self, from: Vector, way: Vector, most: f32) -> Option<f32> {
        let things = InteractionGroups::new(group::ALL, group::THING, InteractionTestMode::And);
        let (ray, filter) = (Ray::new(from, way), QueryFilter::new().groups(things));
        let (_, hit) = self.physics.cast_ray_and_get_normal(&ray, most, true, filter)?;
        (-hit.normal.dot(way) > ECHO_COS).then_some(hit.time_of_impact)
    }

    /// True if somebody stands closer to `next` than the robot may walk, and nearer than from `base`.
    pub(crate) fn person_blocks(&self, base: [f32; 3], next: [f32; 2]) -> bool {
        let far = |person: &PersonBody, x: f32, y: f32| libm::hypotf(person.at[0] - x, person.at[1] - y);
        self.people.iter().filter(|person| person.present).any(|person| {
            let distance = far(person, next[0], next[1]);
            distance < room::PERSON_CLEAR_M + WAIST_M && distance < far(person, base[0], base[1])
        })
    }

    /// True if a straight line of sight from the head to a point of `target` is free. The head itself never hides.
    pub(crate) fn free(&self, from: Vector, to: Vector, target: RigidBodyHandle) -> bool {
        let way = to - from;
        let distance = way.length();
        let others = InteractionGroups::new(group::ALL, group::ALL & !group::HEAD, InteractionTestMode::And);
        let filter = QueryFilter::new().groups(others).exclude_rigid_body(target);
        distance > 0.0 && self.physics.cast_ray(&Ray::new(from, way / distance), distance, true, filter).is_none()
    }

    /// Held balls make way for a walking robot.
    fn keep_balls_off(&mut self, base: [f32; 3]) {
        for ball in &self.balls {
            let Some(body) = self.physics.bodies.get_mut(ball.body).filter(|body| body.is_kinematic()) else {
                continue;
            };
            let clear = room::ball_place(body.translation(), base);
            if clear != body.translation() {
                body.set_position(Pose::from_translation(clear), true);
            }
        }
    }

    /// A ball that physics lost, by a number that is none or a place outside the room, is held at home again.
    fn mend(&mut self) {
        for ball in 0..self.balls.len() {
            let at = self.ball_at(&self.balls[ball]);
            let inside = at.is_finite() && across(at) < 2.0 * HALF_M && (-0.1..6.0).contains(&at.z);
            if !inside {
                self.hold_ball(ball, self.balls[ball].home);
            }
        }
    }

    /// Everything that moves, bit for bit, in the order it was made.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        for (_, body) in self.physics.bodies.iter() {
            let (pose, linear, angular) = (body.position(), body.linvel(), body.angvel());
            digest.floats(&pose.translation.to_array());
            digest.floats(&pose.rotation.to_array());
            digest.floats(&linear.to_array());
            digest.floats(&angular.to_array());
            digest.truth(body.is_enabled());
            digest.truth(body.is_dynamic());
        }
        for person in &self.people {
            digest.floats(&person.at);
            digest.truth(person.present);
        }
        for obstacle in &self.obstacles {
            digest.floats(&obstacle.at);
            digest.truth(obstacle.present);
        }
        for mark in &self.marks {
            digest.floats(&mark.at.to_array());
            digest.floats(&[mark.facing]);
            digest.truth(mark.present);
        }
    }
}

impl ObstacleBody {
    /// Returns the distance of its surface from a point, in metres; negative inside.
    fn distance(&self, point: Vector) -> f32 {
        let half = self.size.map(|size| size / 2.0);
        let out = [
            (point.x - self.at[0]).abs() - half[0],
            (point.y - self.at[1]).abs() - half[1],
            (point.z - half[2]).abs() - half[2],
        ];
        let outside = Vector::new(out[0].max(0.0), out[1].max(0.0), out[2].max(0.0)).length();
        outside + out.into_iter().fold(f32::NEG_INFINITY, f32::max).min(0.0)
    }
}

/// The marks as they are at first, facing where the robot stands then.
fn marks() -> Vec<WorldMark> {
    let mark = |kind: &room::MarkKind| WorldMark {
        id: kind.id,
        number: kind.number,
        at: kind.at,
        facing: libm::atan2f(-kind.at.y, -kind.at.x),
        present: false,
    };
    MARKS.iter().map(mark).collect()
}

fn add_ball(physics: &mut PhysicsWorld, kind: &room::BallKind) -> BallBody {
    let body = RigidBodyBuilder::kinematic_position_based().translation(kind.at).ccd_enabled(true).linear_damping(0.1);
    let shape = ColliderBuilder::ball(kind.radius).density(60.0).restitution(0.6).collision_groups(group::things());
    let (body, _) = physics.insert(body, shape);
    BallBody { color: kind.color, radius: kind.radius, body, home: kind.at }
}
