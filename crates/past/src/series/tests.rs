//! Columns against a plain count.

use super::{AllSeries, Columns, SLOT_MS, drawn, field};
use behaviour::Value;
use protocol::LaneColumn;

/// Columns the slow way: each value in the column of its slot.
fn plain(all: &[(u64, Value)], slot_ms: u64, axis: &Columns) -> Vec<LaneColumn> {
    let of = |at: u32| {
        let here: Vec<&Value> = all
            .iter()
            .filter(|(at_ms, _)| axis.of(at_ms / slot_ms * slot_ms) == Some(at))
            .map(|(_, value)| value)
            .collect();
        let numbers: Vec<f32> = here.iter().filter_map(|value| drawn(value)).map(|number| number as f32).collect();
        let (low, high) = numbers.iter().fold((f32::MAX, f32::MIN), |(low, high), &n| (low.min(n), high.max(n)));
        let numbers = numbers.first().zip(numbers.last()).map(|(first, last)| [low, high, *first, *last]);
        (!here.is_empty()).then(|| LaneColumn { at, count: u32::try_from(here.len()).unwrap(), numbers })
    };
    (0..u32::try_from(axis.count).unwrap()).filter_map(of).collect()
}

fn values(many: u64) -> Vec<(u64, Value)> {
    let value = |at: u64| match at % 11 {
        0 => Value::text("red"),
        1 => Value::Bool(at.is_multiple_of(2)),
        _ => Value::Float(((at * 7_919) % 1_000) as f64 / 9.0),
    };
    // With gaps, of which none may be bridged.
    (0..many).map(|at| (at * 37 + at / 50 * 4_000, value(at))).collect()
}

#[test]
fn columns_are_those_of_a_plain_count_also_after_slots_became_longer() {
    let all = values(3_000);
    let end = all.last().unwrap().0 + 1;
    for slots_max in [1_000_000, 700, 90] {
        let mut series = AllSeries::within(slots_max);
        all.iter().for_each(|(at_ms, value)| series.add(2, *at_ms, value, false));
        assert_eq!(series.slot_ms > SLOT_MS, slots_max < 1_000);
        assert!(series.bytes() < 24 * 2 * slots_max.min(100_000) + 500_000);
        for (from_ms, to_ms, count) in [(0, end, 100), (0, end * 2, 7), (5_100, 5_200, 3), (12_345, 99_999, 1_000)] {
            let axis = Columns { from_ms, to_ms, count };
            assert_eq!(series.columns(2, None, &axis), plain(&all, series.slot_ms, &axis), "{axis:?}");
        }
    }
}

#[test]
fn fields_have_series_of_their_own_and_many_are_bounded() {
    let mut series = AllSeries::within(10_000);
    let place = |x: f64| Value::object([("x", Value::Float(x)), ("label", Value::text("a"))]);
    for at in 0..100_u32 {
        let value = Value::object([("size", Value::Float(f64::from(at))), ("place", place(f64::from(at) * 2.0))]);
        series.add(0, u64::from(at) * 100, &value, false);
    }
    let names: Vec<&str> = series.streams[0].fields.iter().map(|(name, _)| &**name).collect();
    assert_eq!(names, ["place.x", "size"]);
    let axis = Columns { from_ms: 0, to_ms: 10_000, count: 2 };
    let columns = series.columns(0, Some("place.x"), &axis);
    assert_eq!(columns[1], LaneColumn { at: 1, count: 50, numbers: Some([100.0, 198.0, 100.0, 198.0]) });
    assert!(series.columns(0, None, &axis).iter().all(|column| column.numbers.is_none() && column.count == 50));
    for at in 0..10_000_u64 {
        let name = format!("field{at}");
        series.add(1, at, &Value::object([(name.as_str(), Value::Int(1))]), false);
    }
    assert_eq!(series.streams[1].fields.len(), super::FIELDS_MAX);
}

#[test]
fn a_field_is_found_by_its_path_also_if_its_name_has_points() {
    let inner = Value::object([("b.c", Value::Int(1)), ("d", Value::Int(2))]);
    let value = Value::object([("a", inner), ("a.d", Value::Int(3))]);
    assert_eq!(field(&value, "a.b.c"), Some(&Value::Int(1)));
    assert_eq!(field(&value, "a.d"), Some(&Value::Int(3)));
    assert_eq!(field(&value, "a.e"), None);
}
