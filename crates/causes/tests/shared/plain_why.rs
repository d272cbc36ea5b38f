//! The ways that the engine's slow, plain twin gives its values, in the words of the product.

use crate::plain::{Step, Way, With};
use behaviour::BehaviourFile;
use protocol::{Why, WhyStep, WhyWith};

/// A plain way, as the product tells it.
pub(crate) fn told(file: &BehaviourFile, way: &Way) -> Why {
    let id = |stream: usize| file.streams[stream].id.clone();
    let with = |with: &With| match with {
        With::Value(stream, t, value) => WhyWith::Value { stream: id(*stream), t: *t, value: value.clone() },
        With::Memory(memory, t) => WhyWith::Memory { memory: memory.clone(), t: *t },
    };
    let step = |step: &Step| WhyStep {
        connector: step.connector.map(|connector| file.connectors[connector].id.clone()),
        stream: id(step.stream),
        t: step.at,
        value: step.value.clone(),
        with: step.with.iter().map(with).collect(),
    };
    Why { stream: id(way[0].stream), t: way[0].at, value: way[0].value.clone(), steps: way.iter().map(step).collect() }
}
