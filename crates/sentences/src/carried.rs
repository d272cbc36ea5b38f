//! What a stream carries, as far as it decides the words for it.

use crate::clauses::{CONVERSIONS, is_ball};
use crate::does::{Calc, Does};
use behaviour::{Helper, StreamKind, Unit};
use robot::Shape;

/// What a stream carries.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Carried {
    /// What this sense reads.
    Sense(&'static str),
    /// A distance, in `cm` or `m`.
    Distance(&'static str),
    /// An angle `x` and a distance `d`.
    Sides,
    /// An angle in radians.
    Angle,
    /// From 0 to 1.
    Brightness,
    /// An arm's name.
    Arm,
    /// A number with its unit.
    Number(String),
    /// Anything else.
    Other,
}

/// How a value, or one of its fields, is measured.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Measure {
    /// As a distance, in `cm` or `m`.
    Distance(&'static str),
    /// As a number, with its unit.
    Number(String),
}

impl Carried {
    /// What is carried after a connector that takes from this.
    pub(crate) fn after(&self, does: &Does) -> Self {
        match does {
            Does::Make(Calc::Helper(helper)) => match helper.as_str() {
                "distance" => Self::Distance("cm"),
                "ball_to_distance" => Self::Distance("m"),
                "ball_x_and_distance" => Self::Sides,
                "distance_to_brightness" => Self::Brightness,
                "select_arm" => Self::Arm,
                _ => Self::Other,
            },
            Does::Make(Calc::Field(field)) => match self.measure(Some(field)) {
                Measure::Distance(unit) => Self::Distance(unit),
                Measure::Number(unit) if unit == "rad" => Self::Angle,
                Measure::Number(unit) if unit.is_empty() => Self::Other,
                Measure::Number(unit) => Self::Number(unit),
            },
            Does::Make(_) | Does::Stamp | Does::Remember(_) | Does::Any | Does::Together(_) | Does::Latest(_) => {
                Self::Other
            }
            Does::Keep(_) | Does::KeepBy(_) | Does::Every(_) | Does::Later(_) | Does::Quiet(_) | Does::Changed(_) => {
                self.clone()
            }
        }
    }

    /// How it, or one of its fields, is measured.
    pub(crate) fn measure(&self, field: Option<&str>) -> Measure {
        match (self, field) {
            (Self::Distance(unit), None) => Measure::Distance(unit),
            (Self::Sides, Some("d")) => Measure::Distance("m"),
            (Self::Sides, Some("x")) | (Self::Angle, None) => Measure::Number("rad".to_owned()),
            (Self::Number(unit), None) => Measure::Number(unit.clone()),
            (Self::Sense(sense), field) => measured(sense, field),
            _ => Measure::Number(String::new()),
        }
    }

    /// Whether it is where a ball is and how large it looks.
    pub(crate) fn is_ball(&self) -> bool {
        matches!(self, Self::Sense(sense) if is_ball(sense))
    }
}

/// How the catalogue says that values of a sense, or their fields, are measured.
fn measured(sense: &str, field: Option<&str>) -> Measure {
    let number = |unit: &str| Measure::Number(unit.to_owned());
    let Ok(device) = robot::device(StreamKind::Sensor, sense) else { return number("") };
    let shape = match field {
        None => Some(device.shape.usual()),
        Some(name) => device.shape.fields().iter().find(|field| field.name == name).map(|field| &field.of),
    };
    match shape {
        Some(Shape::Number(Some(Unit::Metres))) => Measure::Distance("m"),
        Some(Shape::Number(Some(Unit::Fraction) | None)) | None => number(""),
        Some(Shape::Number(Some(unit))) => number(unit.symbol()),
        Some(_) => number(""),
    }
}

/// Whether a helper means what the words for its name say: it is the one that every library starts with, or is missing.
pub(crate) fn is_known_helper(name: &str, helpers: &[&Helper]) -> bool {
    if !CONVERSIONS.contains(&name) {
        return false;
    }
    let Some(here) = helpers.iter().find(|helper| helper.name == name) else { return true };
    robot::shipped_helpers().iter().any(|shipped| shipped.name == name && shipped.body == here.body)
}
