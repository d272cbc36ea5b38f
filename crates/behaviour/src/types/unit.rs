//! The units of numbers, and how one unit becomes another.

use phrase::{Phrase, Phrased, phrase};
use serde::{Deserialize, Serialize};

/// The quantities that are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The distance of something.
    Length,
    /// The angle by which something is turned.
    Angle,
    /// The duration of something.
    Time,
    /// A part of a whole.
    Ratio,
    /// The speed of something.
    Speed,
    /// The speed at which something turns.
    Turning,
}

/// The units of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Unit {
    /// m
    Metres,
    /// cm
    Centimetres,
    /// rad
    Radians,
    /// °
    Degrees,
    /// s
    Seconds,
    /// ms
    Milliseconds,
    /// From 0 to 1.
    Fraction,
    /// %
    Percent,
    /// m/s
    MetresPerSecond,
    /// rad/s
    RadiansPerSecond,
}

impl Unit {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Metres,
        Self::Centimetres,
        Self::Radians,
        Self::Degrees,
        Self::Seconds,
        Self::Milliseconds,
        Self::Fraction,
        Self::Percent,
        Self::MetresPerSecond,
        Self::RadiansPerSecond,
    ];

    /// Returns the sign behind a number; of a fraction, which has none, the range that it lies in.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metres => "m",
            Self::Centimetres => "cm",
            Self::Radians => "rad",
            Self::Degrees => "°",
            Self::Seconds => "s",
            Self::Milliseconds => "ms",
            Self::Fraction => "0 to 1",
            Self::Percent => "%",
            Self::MetresPerSecond => "m/s",
            Self::RadiansPerSecond => "rad/s",
        }
    }

    /// Names a stream whose values are those of the stream `name` in this unit: "Distance in m".
    #[must_use]
    pub fn of(self, name: &str) -> String {
        if self == Self::Fraction { format!("{name} as a fraction") } else { format!("{name} in {}", self.symbol()) }
    }

    /// Returns the quantity that is measured with it.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Metres | Self::Centimetres => Quantity::Length,
            Self::Radians | Self::Degrees => Quantity::Angle,
            Self::Seconds | Self::Milliseconds => Quantity::Time,
            Self::Fraction | Self::Percent => Quantity::Ratio,
            Self::MetresPerSecond => Quantity::Speed,
            Self::RadiansPerSecond => Quantity::Turning,
        }
    }

    /// Between which numbers all values of this unit lie, if they do.
    #[must_use]
    pub fn range(self) -> Option<(f64, f64)> {
        match self {
            Self::Fraction => Some((0.0, 1.0)),
            Self::Percent => Some((0.0, 100.0)),
            _ => None,
        }
    }

    /// The expression that turns the number `x` of this unit into one of another: `x * 100.0`. None if they do not
    /// measure the same.
    #[must_use]
    pub fn convert(self, to: Self, x: &str) -> Option<String> {
        if self.quantity() != to.quantity() {
            return None;
        }
        Some(match (self, to) {
            (Self::Radians, Self::Degrees) => format!("to_degrees({x})"),
            (Self::Degrees, Self::Radians) => format!("to_radians({x})"),
            (from, to) if from.parts() < to.parts() => format!("{x} * {:.1}", to.parts() / from.parts()),
            (from, to) if from.parts() > to.parts() => format!("{x} / {:.1}", from.parts() / to.parts()),
            _ => x.to_owned(),
        })
    }

    /// Returns the number of these that make one of the first unit of the same quantity. Functions convert angles.
    fn parts(self) -> f64 {
        match self {
            Self::Centimetres | Self::Percent => 100.0,
            Self::Milliseconds => 1_000.0,
            _ => 1.0,
        }
    }
}

/// In a sentence: by its sign, which most languages share, unless there is none.
impl Phrased for Unit {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Fraction => phrase!("unit.fraction", "a number from 0 to 1"),
            Self::Seconds => phrase!("unit.s", "s"),
            Self::Milliseconds => phrase!("unit.ms", "ms"),
            sign => sign.symbol().phrase(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;
    use std::collections::BTreeSet;

    #[test]
    fn a_unit_becomes_another_of_the_same_quantity() {
        let said = |from: Unit, to| from.convert(to, "x");
        assert_eq!(said(Unit::Centimetres, Unit::Metres).as_deref(), Some("x / 100.0"));
        assert_eq!(said(Unit::Metres, Unit::Centimetres).as_deref(), Some("x * 100.0"));
        assert_eq!(said(Unit::Seconds, Unit::Milliseconds).as_deref(), Some("x * 1000.0"));
        assert_eq!(said(Unit::Percent, Unit::Fraction).as_deref(), Some("x / 100.0"));
        assert_eq!(said(Unit::Radians, Unit::Degrees).as_deref(), Some("to_degrees(x)"));
        assert_eq!(said(Unit::Metres, Unit::Seconds), None);
    }

    #[test]
    fn every_unit_has_a_symbol_of_its_own() {
        let symbols: BTreeSet<_> = Unit::ALL.iter().map(|unit| unit.symbol()).collect();
        assert_eq!(symbols.len(), Unit::ALL.len());
    }
}
