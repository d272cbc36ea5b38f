//! The distance of a value from passing a test that kept it back.

use super::fix::KeptSide;
use crate::test::{TestSide, comparisons};
use behaviour::{Behaviour, Connector, Procedure, Value};

/// Measures how nearly values pass a test that compares with numbers.
pub struct TestMeasure {
    sides: Vec<TestSide>,
    /// True if one of the sides is enough.
    any: bool,
}

impl TestMeasure {
    /// Returns the measure of a connector's test; none if it is anything but comparisons.
    #[must_use]
    pub fn of(behaviour: &Behaviour, connector: &Connector) -> Option<Self> {
        let Procedure::Body { body, .. } = connector.operation.procedure()? else { return None };
        let (sides, any) = comparisons(body, &behaviour.arguments(connector))?;
        Some(Self { sides, any })
    }

    /// Returns the distance of a value that was kept back from passing, as a part of the number beside it. None if no number of
    /// the test is in its way.
    #[must_use]
    pub fn distance(&self, value: &Value) -> Option<f64> {
        let kept = self.sides.iter().map(|side| KeptSide::of(side, value)).collect::<Option<Vec<_>>>()?;
        let distances =
            self.sides.iter().zip(kept).filter(|(_, kept)| !kept.passes).map(|(side, kept)| kept.distance(side));
        if self.any {
            return distances.flatten().min_by(f64::total_cmp);
        }
        let all = distances.collect::<Option<Vec<_>>>()?;
        (!all.is_empty()).then(|| all.iter().sum())
    }
}

#[cfg(test)]
mod tests {
    use super::TestMeasure;
    use crate::test::comparisons;
    use behaviour::Value;

    fn distance(body: &str, value: Value) -> Option<f64> {
        let (sides, any) = comparisons(body, &["a".to_owned()]).unwrap();
        TestMeasure { sides, any }.distance(&value).map(|distance| (distance * 1_000.0).round() / 1_000.0)
    }

    #[test]
    fn the_distance_is_that_to_the_number_which_is_in_the_way() {
        assert_eq!(distance("a < 80", Value::Int(100)), Some(0.25));
        assert_eq!(distance("a < 80", Value::Float(80.0)), Some(0.0));
        assert_eq!(distance("a > -10", Value::Int(-15)), Some(0.5));
        assert_eq!(distance("a > 0", Value::Int(-3)), Some(3.0), "beside nothing it is the number itself");
        assert_eq!(distance("a > 10 && a < 20", Value::Int(25)), Some(0.25));
        assert_eq!(distance("a < 10 || a > 20", Value::Int(12)), Some(0.2), "the nearer of two ways");
    }

    #[test]
    fn where_no_number_is_in_the_way_there_is_no_distance() {
        let ball = |color, size| Value::object([("color", Value::text(color)), ("size", Value::Int(size))]);
        let test = "a.color == \"red\" && a.size > 10";
        assert_eq!(distance(test, ball("red", 8)), Some(0.2));
        assert_eq!(distance(test, ball("blue", 8)), None, "another number does not help");
        assert_eq!(distance("a != 5", Value::Int(5)), None);
        assert_eq!(distance("a < 5", Value::text("blue")), None);
        assert_eq!(distance("a < 5", Value::Int(3)), None, "it passes");
    }
}
