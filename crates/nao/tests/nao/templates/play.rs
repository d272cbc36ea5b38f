//! A template at work on any robot, in steps of robot time.

use crate::driver::user;
use behaviour::{BehaviourFile, StreamKind, Value};
use engine::{Emission, Limits, Run, StreamIx};
use robot::{Millis, Reading, Robot, Use};
use std::collections::{BTreeMap, BTreeSet};

/// The newest value of a stream in a phase, and how many came.
pub(crate) type Newest = BTreeMap<String, (Value, usize)>;

/// A graph, the robot that it runs on, and what was seen of both.
pub(crate) struct Play<R> {
    pub(crate) robot: R,
    run: Run,
    uses: Vec<Use>,
    actions: BTreeMap<StreamIx, Use>,
    readings: Vec<Reading>,
    pub(crate) now_ms: u64,
    /// The values that came in this phase.
    pub(crate) newest: Newest,
    /// Of which forms the values of each stream were, in all phases.
    pub(crate) shapes: BTreeMap<String, BTreeSet<String>>,
    /// Procedures that failed, and what the robot refused.
    pub(crate) troubles: Vec<String>,
}

impl<R: Robot> Play<R> {
    /// Opens the devices as the server does: actions first.
    pub(crate) fn begin(file: &BehaviourFile, mut robot: R) -> Self {
        let run = Run::build(file, Limits::default()).unwrap();
        let (mut uses, mut actions) = (Vec::new(), BTreeMap::new());
        for kind in [StreamKind::Actuator, StreamKind::Sensor] {
            for (stream, info) in run.streams().enumerate().filter(|(_, info)| info.kind == kind) {
                let of = user(&info.id);
                robot.open(&of, info.device.as_deref().unwrap(), &info.params).unwrap();
                if kind == StreamKind::Actuator {
                    actions.insert(stream, of.clone());
                }
                uses.push(of);
            }
        }
        let (newest, shapes) = (Newest::new(), BTreeMap::new());
        Self { robot, run, uses, actions, readings: Vec::new(), now_ms: 0, newest, shapes, troubles: Vec::new() }
    }

    /// Makes a step: what the robot senses, what the graph makes of it, and what the robot does then.
    pub(crate) fn step(&mut self, by_ms: u64) {
        self.now_ms += by_ms;
        let now = Millis(self.now_ms);
        self.robot.poll(now, &mut self.readings);
        let (mut emitted, mut troubles) = (Vec::new(), Vec::new());
        let mut note = |emission: Emission| match emission {
            Emission::Value { stream, value, .. } => emitted.push((stream, value.clone())),
            Emission::Fault { error, .. } => troubles.push(error.to_string()),
        };
        for reading in self.readings.drain(..) {
            let stream = self.run.stream_index(reading.to.stream.as_str()).unwrap();
            self.run.feed(reading.at, stream, reading.value, &mut note);
        }
        self.run.until(now, &mut note);
        for (stream, value) in emitted {
            if let Some(action) = self.actions.get(&stream)
                && let Err(refused) = self.robot.command(action, &value, now)
            {
                troubles.push(format!("{}: {refused}", action.stream));
            }
            let id = self.run.streams()[stream].id.clone();
            self.shapes.entry(id.clone()).or_default().insert(shape(&value));
            let newest = self.newest.entry(id).or_insert_with(|| (Value::Null, 0));
            *newest = (value, newest.1 + 1);
        }
        self.troubles.extend(troubles);
    }

    /// The run ends.
    pub(crate) fn end(&mut self) {
        self.uses.iter().for_each(|of| self.robot.close(of));
    }
}

/// The form of a value: its type, and that of its fields.
fn shape(value: &Value) -> String {
    match value {
        Value::Null => "nothing".to_owned(),
        Value::Bool(_) => "truth".to_owned(),
        Value::Int(_) => "whole".to_owned(),
        Value::Float(_) => "number".to_owned(),
        Value::Text(_) => "text".to_owned(),
        Value::List(items) => format!("{:?}", items.iter().map(shape).collect::<Vec<_>>()),
        Value::Map(fields) => {
            let fields: Vec<String> = fields.iter().map(|(name, value)| format!("{name}: {}", shape(value))).collect();
            format!("{{{}}}", fields.join(", "))
        }
    }
}

/// The most that angles in radians, distances in metres and brightnesses may be apart.
const NEAR: f64 = 0.02;
/// Fields that are moments.
const MOMENTS: [&str; 2] = ["time", "t"];

fn is_moment(field: &std::sync::Arc<str>) -> bool {
    MOMENTS.contains(&field.as_ref())
}

/// True if two values say the same.
pub(crate) fn alike(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::Float(one), Value::Float(other)) => (one - other).abs() < NEAR,
        (Value::Map(one), Value::Map(other)) => {
            let same = |(one, other): ((&_, &Value), (&_, &Value))| {
                one.0 == other.0 && (is_moment(one.0) || alike(one.1, other.1))
            };
            one.iter().len() == other.iter().len() && one.iter().zip(other.iter()).all(same)
        }
        _ => one == other,
    }
}
