//! Printed marks with a number.

use super::{NaoDriver, OpenDevice, Sense, at, float, time, within};
use behaviour::Value;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "Landmark",
    services: &["ALMemory", "ALLandMarkDetection"],
    joints: &[],
    open: |chosen| OpenDevice::sense(Landmark(chosen.number("number")? as i64)),
};

/// Which, 0 for any.
struct Landmark(i64);

impl Sense for Landmark {
    fn keys(&self) -> Vec<&'static str> {
        vec!["LandmarkDetected"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALLandMarkDetection")
    }

    /// `[[s, us], [[[1, x, y, width, height, heading], [number]], ...], ...]`, empty when there is none; width and height are
    /// angles of the whole mark. The largest of the wanted ones counts.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        let marks = within(value, &[1])?.items()?;
        let number = |mark: &qi::Value| at(mark, &[1, 0]).map(|number| number as i64);
        let size = |mark: &&qi::Value| at(mark, &[0, 3]).unwrap_or_default();
        let wanted = marks.iter().filter(|mark| number(mark).is_some_and(|found| self.0 == 0 || found == self.0));
        let mark = wanted.max_by(|one, other| size(one).total_cmp(&size(other)))?;
        Some(Value::object([
            ("number", Value::Int(number(mark)?)),
            ("x", float(at(mark, &[0, 1])?)),
            ("y", float(at(mark, &[0, 2])?)),
            ("size", float(at(mark, &[0, 3])? / 2.0)),
            ("heading", float(at(mark, &[0, 5]).unwrap_or_default())),
            ("time", time(at_ms)),
        ]))
    }
}
