//! Balls: the red one by its own detector, others as blobs of a colour. The robot looks for one colour at a time; uses with
//! different ones take turns.

use super::{NaoDriver, OpenDevice, Sense, SenseTurn, at, float, time};
use crate::deed::ServiceCall;
use behaviour::Value;

pub(super) const RED: NaoDriver = NaoDriver {
    name: "RedBall",
    services: &["ALMemory", "ALRedBallDetection"],
    joints: &[],
    open: |_| OpenDevice::sense(Red),
};
pub(super) const COLOR: NaoDriver = NaoDriver {
    name: "ColorBall",
    services: &["ALMemory", "ALColorBlobDetection"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Blob::of(chosen.text("color")?, true, 0.0)),
};
pub(super) const BLOB: NaoDriver = NaoDriver {
    name: "Blob",
    services: &["ALMemory", "ALColorBlobDetection"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Blob::of(chosen.text("color")?, false, chosen.number("size")?)),
};

/// The most that a colour may be off, of 255. With the colours below it is a guess: cameras and lamps differ.
const THRESHOLD: i32 = 90;
/// The smallest blob, in pixels; and the diameter that is assumed for the distance, in metres.
const PIXELS_MIN: i32 = 20;
const SPAN_M: f32 = 0.06;
/// After so long a picture was looked at for another colour, in milliseconds: two at 15 a second.
const PICTURES_MS: u64 = 140;
/// The event that is raised for each picture in which there is one; nothing is raised when it is gone.
const DETECTED: &str = "ALTracker/ColorBlobDetected";
/// The time after that at which it is lost, in milliseconds: a few pictures, as one can be late.
const LOST_MS: u64 = 300;
/// The pictures that are looked at: columns and rows, of which places are told in parts.
const COLUMNS: f64 = 320.0;
const ROWS: f64 = 240.0;
/// The camera's field of view in radians: the picture is told in parts of it.
const FIELD: [f64; 2] = [0.9826, 0.7627];

struct Red;

impl Sense for Red {
    fn keys(&self) -> Vec<&'static str> {
        vec!["redBallDetected"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALRedBallDetection")
    }

    /// `[[s, us], [x, y, sx, sy], ...]`, all in radians.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        Some(ball(at(value, &[1, 0])?, at(value, &[1, 1])?, at(value, &[1, 2])?, at_ms))
    }
}

struct Blob {
    color: String,
    round: bool,
    /// The smallest angular radius that counts, in radians.
    size: f64,
    /// When the robot said last that there is one.
    detected_ms: Option<u64>,
    /// The moment, in milliseconds, from which on it tells of this colour; before, it told of another one.
    since_ms: u64,
}

impl Blob {
    fn of(color: &str, round: bool, size: f64) -> Self {
        Self { color: color.to_owned(), round, size, detected_ms: None, since_ms: 0 }
    }

    /// True if there is one: the circle of the last one stays on the robot when it is gone.
    fn is_there(&self, at_ms: u64) -> bool {
        self.detected_ms.is_some_and(|told| told >= self.since_ms && at_ms.saturating_sub(told) <= LOST_MS)
    }
}

impl Sense for Blob {
    fn keys(&self) -> Vec<&'static str> {
        vec![DETECTED]
    }

    fn turned(&mut self, since_ms: u64) {
        self.since_ms = since_ms + PICTURES_MS / 2;
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALColorBlobDetection")
    }

    fn turn(&self) -> Option<SenseTurn> {
        let [red, green, blue]: [i32; 3] = match self.color.as_str() {
            "green" => [40, 200, 60],
            "blue" => [40, 80, 230],
            _ => [230, 40, 40],
        };
        let color = [red.into(), green.into(), blue.into(), THRESHOLD.into()];
        let shape = if self.round { "Circle" } else { "Unknown" };
        let properties = [PIXELS_MIN.into(), SPAN_M.into(), shape.into()];
        let calls = vec![
            ServiceCall::new("ALColorBlobDetection", "setColor", color),
            ServiceCall::new("ALColorBlobDetection", "setObjectProperties", properties),
        ];
        Some(SenseTurn { calls, wait_ms: PICTURES_MS })
    }

    /// Where it is in the picture is not in the event, so it is asked for, as often as pictures come.
    fn poll(&self) -> Option<(ServiceCall, u64)> {
        Some((ServiceCall::new("ALColorBlobDetection", "getCircle", []), 66))
    }

    /// `[x, y, radius]` from the upper left corner of the picture: x and radius in parts of its rows, y in parts of its
    /// columns; that of the last one also when there is none any more.
    fn read(&mut self, key: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        if key == DETECTED {
            self.detected_ms = Some(at_ms);
            return None;
        }
        if !self.is_there(at_ms) {
            return None;
        }
        let (x, y) = (at(value, &[0])? * ROWS / COLUMNS, at(value, &[1])? * COLUMNS / ROWS);
        let radius = at(value, &[2])? * ROWS / COLUMNS;
        let size = angle(0.5 + radius, FIELD[0]);
        let inside = [x, y].iter().all(|part| (0.0..=1.0).contains(part)) && radius > 0.0;
        (inside && size >= self.size).then(|| ball(-angle(x, FIELD[0]), angle(y, FIELD[1]), size, at_ms))
    }
}

/// The angle of a place in the picture from its middle: a picture is flat.
fn angle(part: f64, field: f64) -> f64 {
    ((2.0 * part - 1.0) * (field / 2.0).tan()).atan()
}

fn ball(x: f64, y: f64, size: f64, at_ms: u64) -> Value {
    Value::object([("x", float(x)), ("y", float(y)), ("size", float(size)), ("time", time(at_ms))])
}
