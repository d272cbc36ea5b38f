//! What a stream carries, as far as it decides the words for it.

use crate::clauses::{CONVERSIONS, is_ball};
use crate::does::{Calc, SpokenConnector};
use behaviour::{Helper, StreamKind, Unit};
use robot::Shape;

/// What a stream carries.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum CarriedKind {
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
pub(crate) enum ValueMeasure {
    /// As a distance, in `cm` or `m`.
    Distance(&'static str),
    /// As a number, with its unit.
    Number(String),
}

impl CarriedKind {
    /// What is carried after a connector that takes from this.
    pub(crate) fn after(&self, does: &SpokenConnector) -> Self {
        match does {
            SpokenConnector::Make(Calc::Helper(helper)) => match helper.as_str() {
                "distance" => Self::Distance("cm"),
                "ball_to_distance" => Self::Distance("m"),
                "ball_x_and_distance" => Self::Sides,
                "distance_to_brightness" => Self::Brightness,
                "select_arm" => Self::Arm,
                _ => Self::Other,
            },
            SpokenConnector::Make(Calc::Field(field)) => match self.measure(Some(field)) {
                ValueMeasure::Distance(unit) => Self::Distance(unit),
                ValueMeasure::Number(unit) if unit == "rad" => Self::Angle,
                ValueMeasure::Number(unit) if unit.is_empty() => Self::Other,
                ValueMeasure::Number(unit) => Self::Number(unit),
            },
            SpokenConnector::Make(_)
            | SpokenConnector::Stamp
            | SpokenConnector::Remember(_)
            | SpokenConnector::Any
            | SpokenConnector::Together(_)
            | SpokenConnector::Latest(_) => Self::Other,
            SpokenConnector::Keep(_)
            | SpokenConnector::KeepBy(_)
            | SpokenConnector::Every(_)
            | SpokenConnector::Later(_)
            | SpokenConnector::Quiet(_)
            | SpokenConnector::Changed(_) => self.clone(),
        }
    }

    /// How it, or one of its fields, is measured.
    pub(crate) fn measure(&self, field: Option<&str>) -> ValueMeasure {
        match (self, field) {
            (Self::Distance(unit), None) => ValueMeasure::Distance(unit),
            (Self::Sides, Some("d")) => ValueMeasure::Distance("m"),
            (Self::Sides, Some("x")) | (Self::Angle, None) => ValueMeasure::Number("rad".to_owned()),
            (Self::Number(unit), None) => ValueMeasure::Number(unit.clone()),
            (Self::Sense(sense), field) => measured(sense, field),
            _ => ValueMeasure::Number(String::new()),
        }
    }

    /// Whether it is where a ball is and how large it looks.
    pub(crate) fn is_ball(&self) -> bool {
        matches!(self, Self::Sense(sense) if is_ball(sense))
    }
}

/// How the catalogue says that values of a sense, or their fields, are measured.
fn measured(sense: &str, field: Option<&str>) -> ValueMeasure {
    let number = |unit: &str| ValueMeasure::Number(unit.to_owned());
    let Ok(device) = robot::device(StreamKind::Sensor, sense) else { return number("") };
    let shape = match field {
        None => Some(device.shape.usual()),
        Some(name) => device.shape.fields().iter().find(|field| field.name == name).map(|field| &field.of),
    };
    match shape {
        Some(Shape::Number(Some(Unit::Metres))) => ValueMeasure::Distance("m"),
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
