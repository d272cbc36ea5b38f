//! The picture of the simulated camera: the room painted by geometry, a ray a pixel, for people who look. Senses do not use
//! it (`sight.rs`): they are told by geometry what a robot's software would find.

use crate::math::{Pose, Vector};
use crate::nao::SimulatedNao;
use crate::room::{HALF_M, HEAD_M, MARK_M, WAIST_M};
use crate::world::World;
use robot::{Camera, Picture};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Width and height in pixels, as the smaller of the two usual sizes of a NAO's camera.
const SIZE: [u16; 2] = [160, 120];
/// Pause between two pictures in robot time, in milliseconds: ten a second.
const EVERY_MS: u64 = 100;
/// Height of the walls that are painted, in metres.
const WALL_M: f32 = 3.0;
/// Side of a tile of the floor, in metres.
const TILE_M: f32 = 0.5;

/// Red, green and blue.
type Rgb = [u8; 3];

const FLOOR: [Rgb; 2] = [[196, 186, 170], [184, 173, 156]];
const WALL: Rgb = [226, 224, 216];
const CEILING: Rgb = [240, 240, 238];
const SKIN: Rgb = [224, 176, 142];
const HAIR: Rgb = [84, 60, 44];
const EYE: Rgb = [40, 32, 30];
const CLOTHES: [Rgb; 2] = [[72, 110, 168], [176, 96, 120]];
const PAPER: Rgb = [250, 250, 250];
const INK: Rgb = [20, 20, 20];

/// A thing in the room, as it is painted.
#[derive(Clone, Copy, Debug)]
enum Thing {
    Ball {
        at: Vector,
        radius: f32,
        color: Rgb,
    },
    /// A head that faces `to`.
    Head {
        at: Vector,
        to: Vector,
    },
    /// An upright body from the floor to `height`.
    Body {
        at: [f32; 2],
        height: f32,
        color: Rgb,
    },
    Box {
        low: Vector,
        high: Vector,
        color: Rgb,
    },
    /// A printed mark: a disc whose front looks along `front`.
    Mark {
        at: Vector,
        front: Vector,
    },
}

/// The things that the camera has before it at one moment.
#[derive(Debug)]
struct ViewBefore {
    number: u64,
    camera: Pose,
    half: [f32; 2],
    things: Vec<Thing>,
}

/// The state that the robot's thread and those who look have in common.
#[derive(Debug, Default)]
pub(crate) struct CameraShared {
    looks: AtomicBool,
    view: Mutex<Option<Arc<ViewBefore>>>,
}

impl CameraShared {
    fn view(&self) -> MutexGuard<'_, Option<Arc<ViewBefore>>> {
        self.view.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Camera for CameraShared {
    fn look(&self, looks: bool) {
        self.looks.store(looks, Ordering::SeqCst);
        if !looks {
            *self.view() = None;
        }
    }

    fn picture(&self, after: u64) -> Option<Arc<Picture>> {
        let view = self.view().clone().filter(|view| view.number > after)?;
        view.paint().map(Arc::new)
    }
}

impl SimulatedNao {
    /// Notes what the camera sees now, if somebody looks and it is time for a picture.
    pub(crate) fn show_camera(&self) {
        if !self.now.is_multiple_of(EVERY_MS) || !self.shown.looks.load(Ordering::SeqCst) {
            return;
        }
        let (camera, half) = (self.body.camera(), self.model.camera.half);
        let things = things(&self.world, camera.translation);
        *self.shown.view() = Some(Arc::new(ViewBefore { number: self.now, camera, half, things }));
    }
}

fn things(world: &World, eye: Vector) -> Vec<Thing> {
    let ball = |ball: &crate::world::BallBody| Thing::Ball {
        at: world.ball_at(ball),
        radius: ball.radius,
        color: paint(ball.color),
    };
    let mut things: Vec<Thing> = world.balls.iter().map(ball).collect();
    for (person, clothes) in world.people.iter().zip(CLOTHES).filter(|(person, _)| person.present) {
        let at = World::head_at(person);
        things.push(Thing::Head { at, to: (eye - at).normalize_or_zero() });
        things.push(Thing::Body { at: person.at, height: person.height - 2.0 * HEAD_M, color: clothes });
    }
    for obstacle in world.in_the_way() {
        let ([x, y], [long, wide, high]) = (obstacle.at, obstacle.size);
        let low = Vector::new(x - long / 2.0, y - wide / 2.0, 0.0);
        let high = Vector::new(x + long / 2.0, y + wide / 2.0, high);
        things.push(Thing::Box { low, high, color: paint(obstacle.color) });
    }
    for mark in world.marks.iter().filter(|mark| mark.present) {
        let (sin, cos) = libm::sincosf(mark.facing);
        things.push(Thing::Mark { at: mark.at, front: Vector::new(cos, sin, 0.0) });
    }
    things
}

/// The colour that is meant by a name of the room.
fn paint(name: &str) -> Rgb {
    match name {
        "red" => [206, 44, 40],
        "green" => [46, 150, 62],
        "blue" => [44, 88, 190],
        _ => [140, 140, 140],
    }
}

impl ViewBefore {
    fn paint(&self) -> Option<Picture> {
        let [width, height] = SIZE;
        let mut rgb = Vec::with_capacity(usize::from(width) * usize::from(height) * 3);
        let (wide, high) = (libm::tanf(self.half[0]), libm::tanf(self.half[1]));
        for row in 0..height {
            for column in 0..width {
                let aside = 1.0 - (2.0 * f32::from(column) + 1.0) / f32::from(width);
                let up = 1.0 - (2.0 * f32::from(row) + 1.0) / f32::from(height);
                let way = self.camera.transform_vector(Vector::new(1.0, aside * wide, up * high)).normalize_or_zero();
                rgb.extend(self.along(way));
            }
        }
        Picture::new(self.number, SIZE, rgb)
    }

    /// The colour of what a ray meets first.
    fn along(&self, way: Vector) -> Rgb {
        let from = self.camera.translation;
        let met = self.things.iter().filter_map(|thing| thing.meet(from, way));
        let nearest = met.min_by(|one, other| one.0.total_cmp(&other.0));
        let (far, behind) = room(from, way);
        match nearest {
            Some((distance, color)) if distance < far => color,
            _ => behind,
        }
    }
}

impl Thing {
    /// Returns how far along a ray the thing is, and its colour there.
    fn meet(&self, from: Vector, way: Vector) -> Option<(f32, Rgb)> {
        match *self {
            Self::Ball { at, radius, color } => {
                let far = sphere(from - at, way, radius)?;
                Some((far, lit(color, (from + way * far - at) / radius)))
            }
            Self::Head { at, to } => {
                let far = sphere(from - at, way, HEAD_M)?;
                let out = (from + way * far - at) / HEAD_M;
                Some((far, lit(face(out, to), out)))
            }
            Self::Body { at, height, color } => {
                let (far, out) = upright(from, way, at, height)?;
                Some((far, lit(color, out)))
            }
            Self::Box { low, high, color } => {
                let (far, out) = cuboid(from, way, low, high)?;
                Some((far, lit(color, out)))
            }
            Self::Mark { at, front } => {
                let against = -way.dot(front);
                let far = (from - at).dot(front) / against;
                let out = (from + way * far - at).length() / MARK_M;
                (against > 0.0 && far > 0.0 && out <= 1.0).then_some((far, if out > 0.55 { INK } else { PAPER }))
            }
        }
    }
}

/// The colour of a head where its surface looks along `out`, with hair above and behind and two eyes.
fn face(out: Vector, to: Vector) -> Rgb {
    let left = Vector::new(-to.y, to.x, 0.0).normalize_or_zero();
    let (ahead, aside, up) = (out.dot(to), out.dot(left), out.z);
    let eye = libm::hypotf(aside.abs() - 0.34, up - 0.15) < 0.12;
    match () {
        () if up > 0.6 || ahead < 0.1 => HAIR,
        () if eye => EYE,
        () => SKIN,
    }
}

/// A colour as it looks where the surface looks along `out`: light comes from above.
fn lit(color: Rgb, out: Vector) -> Rgb {
    let part = 0.72 + 0.28 * out.z.clamp(-1.0, 1.0);
    color.map(|shade| (f32::from(shade) * part) as u8)
}

/// Returns how far along a ray a sphere is, with `from` as seen from its middle.
fn sphere(from: Vector, way: Vector, radius: f32) -> Option<f32> {
    let half = from.dot(way);
    let under = half * half - from.dot(from) + radius * radius;
    let far = -half - libm::sqrtf(under.max(0.0));
    (under >= 0.0 && far > 0.0).then_some(far)
}

/// Returns how far along a ray an upright cylinder on the floor is, and where its surface looks there.
fn upright(from: Vector, way: Vector, at: [f32; 2], height: f32) -> Option<(f32, Vector)> {
    let (x, y) = (from.x - at[0], from.y - at[1]);
    let (a, half) = (way.x * way.x + way.y * way.y, x * way.x + y * way.y);
    let under = half * half - a * (x * x + y * y - WAIST_M * WAIST_M);
    if a <= f32::EPSILON || under < 0.0 {
        return None;
    }
    let far = (-half - libm::sqrtf(under)) / a;
    let met = from + way * far;
    let out = Vector::new(met.x - at[0], met.y - at[1], 0.0) / WAIST_M;
    (far > 0.0 && (0.0..=height).contains(&met.z)).then_some((far, out))
}

/// Returns how far along a ray a box is, and where the side that it meets looks.
fn cuboid(from: Vector, way: Vector, low: Vector, high: Vector) -> Option<(f32, Vector)> {
    let (from, way) = (from.to_array(), way.to_array());
    let (low, high) = (low.to_array(), high.to_array());
    let (mut enters, mut leaves, mut out) = (f32::NEG_INFINITY, f32::INFINITY, Vector::ZERO);
    for axis in 0..3 {
        if way[axis].abs() <= f32::EPSILON {
            if !(low[axis]..=high[axis]).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let ends = [low[axis], high[axis]].map(|side| (side - from[axis]) / way[axis]);
        let (near, far) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        if near > enters {
            enters = near;
            let mut normal = [0.0; 3];
            normal[axis] = -way[axis].signum();
            out = Vector::new(normal[0], normal[1], normal[2]);
        }
        leaves = leaves.min(far);
    }
    (enters > 0.0 && enters <= leaves).then_some((enters, out))
}

/// Returns how far along a ray the floor, a wall or the ceiling is, and its colour.
fn room(from: Vector, way: Vector) -> (f32, Rgb) {
    let side = |at: f32, along: f32| match along {
        0.0 => f32::INFINITY,
        _ => (HALF_M + 0.1 - at * along.signum()) / along.abs(),
    };
    let wall = side(from.x, way.x).min(side(from.y, way.y));
    let down = if way.z < 0.0 { -from.z / way.z } else { f32::INFINITY };
    let up = if way.z > 0.0 { (WALL_M - from.z) / way.z } else { f32::INFINITY };
    let far = wall.min(down).min(up);
    let met = from + way * far;
    let color = match () {
        () if far == down => {
            let tile = (libm::floorf(met.x / TILE_M) + libm::floorf(met.y / TILE_M)) as i32;
            FLOOR[usize::from(tile.rem_euclid(2) == 1)]
        }
        () if far == up => CEILING,
        () => WALL,
    };
    (far, color)
}

#[cfg(test)]
mod tests {
    use super::{Picture, SIZE};
    use crate::SimulatedNao;
    use robot::{Millis, Robot, SceneEdit};
    use std::sync::Arc;

    fn picture(robot: &mut SimulatedNao, ms: u64) -> Option<Arc<Picture>> {
        let now = robot.time().0 + ms;
        robot.poll(Millis(now), &mut Vec::new());
        robot.camera().expect("it has one").picture(0)
    }

    /// The middle of the pixels that look like this, from −1 (left, top) to 1, and how many there are.
    fn middle(picture: &Picture, is: impl Fn(&[u8]) -> bool) -> ([f32; 2], usize) {
        let (mut sum, mut count) = ([0.0; 2], 0_usize);
        for (index, _) in picture.rgb.chunks(3).enumerate().filter(|(_, pixel)| is(pixel)) {
            let (column, row) = (index % usize::from(picture.width), index / usize::from(picture.width));
            sum[0] += 2.0 * column as f32 / f32::from(picture.width) - 1.0;
            sum[1] += 2.0 * row as f32 / f32::from(picture.height) - 1.0;
            count += 1;
        }
        (sum.map(|sum| sum / count.max(1) as f32), count)
    }

    fn red(pixel: &[u8]) -> bool {
        pixel[0] > 100 && pixel[1] < 60 && pixel[2] < 60
    }

    #[test]
    fn there_are_pictures_only_while_somebody_looks() {
        let mut robot = SimulatedNao::new(1);
        assert!(picture(&mut robot, 200).is_none());
        let camera = robot.camera().expect("it has one");
        camera.look(true);
        let first = picture(&mut robot, 200).expect("somebody looks");
        assert_eq!([first.width, first.height], SIZE);
        assert!(camera.picture(first.number).is_none(), "the same twice");
        let next = picture(&mut robot, 100).expect("still");
        assert!(next.number > first.number);
        camera.look(false);
        assert!(picture(&mut robot, 200).is_none());
    }

    #[test]
    fn a_ball_is_where_the_senses_see_it() {
        let mut robot = SimulatedNao::new(1);
        robot.camera().expect("it has one").look(true);
        let left = picture(&mut robot, 100).expect("somebody looks");
        let (at, count) = middle(&left, red);
        let seen = robot.ball_in_view(0).expect("in view");
        let half = robot.model.camera.half;
        let wanted = [-libm::tanf(seen.x) / libm::tanf(half[0]), libm::tanf(seen.y) / libm::tanf(half[1])];
        assert!(count > 20, "{count} pixels");
        assert!((at[0] - wanted[0]).abs() < 0.03 && (at[1] - wanted[1]).abs() < 0.04, "{at:?} for {wanted:?}");
    }

    #[test]
    fn who_comes_in_is_in_the_picture_and_hides_what_is_behind() {
        let mut robot = SimulatedNao::new(1);
        robot.camera().expect("it has one").look(true);
        let skin = |pixel: &[u8]| pixel[0] > 150 && pixel[1] > 100 && pixel[1] < 180 && pixel[2] < 145 && pixel[2] > 80;
        let alone = picture(&mut robot, 100).expect("somebody looks");
        assert_eq!(middle(&alone, skin).1, 0);
        robot.edit(&SceneEdit::SetPresent { id: "person".into(), present: true }).expect("there is one");
        robot.edit(&SceneEdit::MovePerson { id: "person".into(), at: [1.2, 0.0] }).expect("there is one");
        robot.edit(&SceneEdit::MoveBall { id: "red".into(), at: [1.6, 0.0, 0.5] }).expect("there is one");
        let together = picture(&mut robot, 100).expect("somebody looks");
        let clothes = |pixel: &[u8]| pixel[2] > pixel[0].saturating_add(50) && pixel[2] > 90;
        assert!(middle(&together, clothes).1 > 100, "nobody in the picture");
        assert_eq!(middle(&together, red).1, 0, "the ball behind them");
    }
}
