//! From metres in the room to units of the picture and back. Ahead of the robot is up, its left is left.

use robot::Scene;

/// The picture's width and height.
pub(super) const WIDTH: f32 = 320.0;
pub(super) const HEIGHT: f32 = 300.0;
pub(super) const VIEW_BOX: &str = "0 0 320 300";

/// The height at the lower edge that is left for what the robot says, in units of the picture.
const FOOT: f32 = 52.0;
/// How much of the room behind the robot is shown above that, in metres.
const BEHIND: f32 = 0.15;
/// How far ahead the picture may reach, in metres.
const DEPTHS: [f32; 5] = [1.2, 1.8, 2.6, 4.0, 6.0];
/// What stands nearer to the edge than this counts as outside, in metres.
const MARGIN: f32 = 0.12;

/// Which part of the room is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RoomMap {
    /// Units in a metre.
    pub(super) scale: f32,
}

impl RoomMap {
    /// The closest map that shows everything in the room.
    pub(super) fn of(scene: &Scene) -> Self {
        let balls = scene.balls.iter().map(|ball| [ball.at[0], ball.at[1]]);
        let people = scene.people.iter().filter(|person| person.present).map(|person| person.at);
        let places: Vec<[f32; 2]> = balls.chain(people).chain([[scene.body.base[0], scene.body.base[1]]]).collect();
        let maps = DEPTHS.map(|depth| Self { scale: (HEIGHT - FOOT) / (depth + BEHIND) });
        let fits = |map: &Self| places.iter().all(|place| map.shows(*place));
        maps.into_iter().find(fits).unwrap_or(maps[DEPTHS.len() - 1])
    }

    fn shows(self, [x, y]: [f32; 2]) -> bool {
        let ahead = (HEIGHT - FOOT) / self.scale - BEHIND;
        x <= ahead - MARGIN && y.abs() <= WIDTH / 2.0 / self.scale - MARGIN
    }

    /// Where a place in the room is in the picture.
    pub(super) fn at(self, x: f32, y: f32) -> (f32, f32) {
        (WIDTH / 2.0 - y * self.scale, HEIGHT - FOOT - (BEHIND + x) * self.scale)
    }

    /// Which place in the room a point of the picture is.
    pub(super) fn place(self, right: f32, down: f32) -> (f32, f32) {
        ((HEIGHT - FOOT - down) / self.scale - BEHIND, (WIDTH / 2.0 - right) / self.scale)
    }

    /// How long a length in metres is in the picture.
    pub(super) fn length(self, metres: f32) -> f32 {
        metres * self.scale
    }

    /// The lines of a grid of half metres: across and along.
    pub(super) fn grid(self) -> (Vec<f32>, Vec<f32>) {
        let count = |units: f32| (units / self.scale / 0.5) as i32 + 1;
        let along = (-count(WIDTH) / 2..=count(WIDTH) / 2).map(|line| self.at(0.0, line as f32 * 0.5).0);
        let across = (-count(FOOT)..=count(HEIGHT)).map(|line| self.at(line as f32 * 0.5, 0.0).1);
        (across.collect(), along.collect())
    }
}

/// The point of the picture under a point of the window, given where the picture stands in the window.
pub(super) fn point(client: (f32, f32), corner: (f32, f32), size: (f32, f32)) -> (f32, f32) {
    let zoom = (size.0 / WIDTH).min(size.1 / HEIGHT).max(f32::EPSILON);
    let empty = ((size.0 - WIDTH * zoom) / 2.0, (size.1 - HEIGHT * zoom) / 2.0);
    ((client.0 - corner.0 - empty.0) / zoom, (client.1 - corner.1 - empty.1) / zoom)
}

#[cfg(test)]
mod tests {
    use super::{RoomMap, point};
    use robot::{Ball, Scene};

    fn ball(x: f32, y: f32) -> Ball {
        Ball { id: "red".into(), color: "red".into(), at: [x, y, 0.4], radius: 0.03, seen: true }
    }

    #[test]
    fn a_place_and_its_point_belong_together() {
        let map = RoomMap { scale: 100.0 };
        let (right, down) = map.at(0.7, -0.3);
        let (x, y) = map.place(right, down);
        assert!((x - 0.7).abs() < 1e-5 && (y + 0.3).abs() < 1e-5);
        assert_eq!(point((170.0, 130.0), (10.0, 10.0), (320.0, 300.0)), (160.0, 120.0));
    }

    #[test]
    fn the_map_widens_for_what_is_far() {
        let near = RoomMap::of(&Scene { balls: vec![ball(0.5, 0.0)], ..Scene::default() });
        let far = RoomMap::of(&Scene { balls: vec![ball(2.0, 0.0)], ..Scene::default() });
        assert!(far.scale < near.scale);
    }
}
