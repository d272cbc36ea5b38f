//! The four graphs, and the readings they get in turn.

use crate::{hand, streams};
use behaviour::{BehaviourFile, Value};
use serde_json::{Value as Json, json};

/// A way to run a graph: it handles that many events.
pub(crate) type Way = Box<dyn FnMut(u64)>;

/// A graph to measure.
pub(crate) struct Graph {
    pub(crate) name: &'static str,
    pub(crate) file: BehaviourFile,
    pub(crate) readings: Vec<(String, Value)>,
    /// With closures over shared streams, and with closures that call each other directly.
    pub(crate) by_hand: [fn() -> Way; 2],
}

impl Graph {
    /// The ids of the streams that nothing takes from.
    pub(crate) fn leaves(&self) -> Vec<String> {
        let taken = |id: &String| self.file.connectors.iter().any(|connector| connector.inputs.contains(id));
        let ids = self.file.streams.iter().map(|stream| &stream.id);
        ids.filter(|id| !taken(id)).cloned().collect()
    }
}

/// All of them.
pub(crate) fn all() -> [Graph; 4] {
    let numbers = |stream: &str| (0..64).map(|at| (stream.to_owned(), Value::Int(at * 100 / 64))).collect();
    let sensors = (0..100).map(|at| (format!("s{at}"), Value::Int(at))).collect();
    [
        Graph { name: "chain10", file: chain(10), readings: numbers("s"), by_hand: [streams::chain, hand::chain] },
        Graph {
            name: "tracking",
            file: tracking(),
            readings: sightings(),
            by_hand: [streams::tracking, hand::tracking],
        },
        Graph { name: "fanout100", file: fanout(), readings: numbers("s"), by_hand: [streams::fanout, hand::fanout] },
        Graph { name: "merge100", file: merge(), readings: sensors, by_hand: [streams::merge, hand::merge] },
    ]
}

fn file(streams: &[Json], connectors: &[Json]) -> BehaviourFile {
    let file = json!({
        "format": "rrp-behaviour/1", "name": "", "helpers": [], "streams": streams, "connectors": connectors,
    });
    serde_json::from_value(file).unwrap()
}

fn stream(id: &str, kind: &str) -> Json {
    json!({"id": id, "kind": kind, "name": id})
}

fn connector(operation: &str, inputs: &[String], output: &str, body: &str) -> Json {
    let mut connector = json!({"id": format!("to {output}"), "type": operation, "inputs": inputs, "output": output});
    if !body.is_empty() {
        connector["args"] = json!(["x"]);
        connector["body"] = body.into();
    }
    connector
}

/// Makes so many maps in a row.
pub(crate) fn long_chain(maps: usize) -> Graph {
    let readings = vec![("s".to_owned(), Value::Int(0))];
    Graph { name: "long chain", file: chain(maps), readings, by_hand: [streams::chain, hand::chain] }
}

fn chain(maps: usize) -> BehaviourFile {
    let names: Vec<String> = ["s".to_owned()].into_iter().chain((1..=maps).map(|at| format!("o{at}"))).collect();
    let kind = |at| if at == 0 { "sensor" } else { "ordinary" };
    let streams: Vec<_> = names.iter().enumerate().map(|(at, name)| stream(name, kind(at))).collect();
    let connectors: Vec<_> = names.windows(2).map(|pair| connector("map", &pair[..1], &pair[1], "x + 1")).collect();
    file(&streams, &connectors)
}

fn fanout() -> BehaviourFile {
    let (mut streams, mut connectors) = (vec![stream("s", "sensor")], Vec::new());
    for at in 0..100 {
        let (passed, actuator) = (format!("o{at}"), format!("a{at}"));
        streams.extend([stream(&passed, "ordinary"), stream(&actuator, "actuator")]);
        connectors.push(connector("filter", &["s".to_owned()], &passed, &format!("x > {at}")));
        connectors.push(connector("subscribe", &[passed], &actuator, ""));
    }
    file(&streams, &connectors)
}

fn merge() -> BehaviourFile {
    let sensors: Vec<String> = (0..100).map(|at| format!("s{at}")).collect();
    let mut streams: Vec<_> = sensors.iter().map(|name| stream(name, "sensor")).collect();
    streams.extend([stream("all", "ordinary"), stream("more", "ordinary"), stream("a", "actuator")]);
    let connectors = [
        connector("merge", &sensors, "all", ""),
        connector("map", &["all".to_owned()], "more", "x + 1"),
        connector("subscribe", &["more".to_owned()], "a", ""),
    ];
    file(&streams, &connectors)
}

/// Figure 4.20 of the thesis.
fn tracking() -> BehaviourFile {
    serde_json::from_str(include_str!("../../../../tests/gold/4.20-tracking-fixed/behaviour.json")).unwrap()
}

/// A ball far away, at middle distance and close, and the angle of the head in between.
fn sightings() -> Vec<(String, Value)> {
    let ball = |size| Value::object([("x", (-0.3).into()), ("y", 0.1.into()), ("size", Value::Float(size))]);
    let sights = hand::SIZES.into_iter().zip(hand::YAWS);
    sights.flat_map(|(size, yaw)| [("s0".to_owned(), ball(size)), ("s1".to_owned(), yaw.into())]).collect()
}
