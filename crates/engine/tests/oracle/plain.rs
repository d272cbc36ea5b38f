//! The common parts of both slow engines: calling Rhai plainly, the rank of a connector, what is said.

use behaviour::{BehaviourFile, FileConnector, FileHelper, Value};
use rhai::{Dynamic, Engine, Map, Scope};

/// One thing that is said: time and stream or connector.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Said {
    /// A value on a stream.
    Value(u64, usize, Value),
    /// A connector dropped a value.
    Fault(u64, usize),
}

impl Said {
    /// The time at which it is said.
    pub(crate) fn at(&self) -> u64 {
        match self {
            Self::Value(at, ..) | Self::Fault(at, _) => *at,
        }
    }
}

/// The way on which a value came, as a plain list: the value itself, the one that triggered it, and so on to a reading.
pub(crate) type Way = Vec<Step>;

/// One value on a way.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Step {
    /// The connector that gave it; none of a reading.
    pub(crate) connector: Option<usize>,
    pub(crate) stream: usize,
    pub(crate) at: u64,
    pub(crate) value: Value,
    /// The other values that were used.
    pub(crate) with: Vec<With>,
}

/// A value that was used beside the one that triggered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum With {
    /// The newest one of another input: its stream, and when it came.
    Value(usize, u64, Value),
    /// The value that a scan made before, and since when it is that.
    Memory(Value, u64),
}

/// The place of a stream in the file.
pub(crate) fn stream(file: &BehaviourFile, id: &str) -> usize {
    file.streams.iter().position(|stream| stream.id == id).unwrap()
}

/// The connectors by the length of the longest path from a source, then by place. Lengths grow until nothing changes.
pub(crate) fn by_rank(file: &BehaviourFile) -> Vec<usize> {
    let mut ranks = vec![1_usize; file.connectors.len()];
    loop {
        let before = ranks.clone();
        for (at, connector) in file.connectors.iter().enumerate() {
            for (other, feeding) in file.connectors.iter().enumerate() {
                if connector.inputs.contains(&feeding.output) {
                    ranks[at] = ranks[at].max(ranks[other] + 1);
                }
            }
        }
        if ranks == before {
            break;
        }
    }
    let mut order: Vec<usize> = (0..file.connectors.len()).collect();
    order.sort_by_key(|&at| (ranks[at], at));
    order
}

/// True if distinct takes two values for one: numbers by exact value, lists and objects by their parts.
pub(crate) fn same(one: &Value, other: &Value) -> bool {
    match (one, other) {
        (Value::List(one), Value::List(other)) => {
            one.len() == other.len() && (0..one.len()).all(|at| same(&one[at], &other[at]))
        }
        (Value::Map(one), Value::Map(other)) => {
            let found =
                |(name, value): (_, &Value)| other.iter().any(|(twin, other)| twin == name && same(value, other));
            one.len() == other.len() && one.iter().all(found)
        }
        (Value::Float(number), Value::Int(whole)) | (Value::Int(whole), Value::Float(number)) => {
            // Every float without a fraction that an i64 could equal is exact as an i128.
            number.fract() == 0.0 && number.abs() < 1e20 && *number as i128 == i128::from(*whole)
        }
        _ => one == other,
    }
}

/// True if distinct compares what a procedure makes.
pub(crate) fn has_procedure(connector: &FileConnector) -> bool {
    connector.body.is_some() || connector.helper.is_some()
}

/// A procedure on its inputs; nothing for any fault.
pub(crate) fn call(file: &BehaviourFile, connector: &FileConnector, inputs: &[Value]) -> Option<Value> {
    let names = connector.args.as_ref().unwrap();
    let mut scope = Scope::new();
    for (name, input) in names.iter().zip(inputs) {
        scope.push_dynamic(name.as_str(), to_rhai(input));
    }
    let body = match &connector.helper {
        Some(helper) => format!("{helper}({})", names.join(", ")),
        None => connector.body.clone().unwrap(),
    };
    let program: String = file.helpers.iter().map(function).chain([body]).collect();
    PLAIN.with(|engine| from_rhai(&engine.eval_with_scope::<Dynamic>(&mut scope, &program).ok()?))
}

thread_local! {
    /// Made once: it takes longer than everything else here.
    static PLAIN: Engine = plain_engine();
}

fn function(helper: &FileHelper) -> String {
    format!("fn {}({}) {{ {} }}\n", helper.name, helper.params.join(", "), helper.body)
}

fn plain_engine() -> Engine {
    let mut engine = Engine::new();
    engine.set_fail_on_invalid_map_property(true).set_strict_variables(true).set_max_string_size(4 * 1024);
    engine
}

pub(crate) fn to_rhai(value: &Value) -> Dynamic {
    match value {
        Value::Null => Dynamic::UNIT,
        Value::Bool(truth) => (*truth).into(),
        Value::Int(whole) => (*whole).into(),
        Value::Float(number) => (*number).into(),
        Value::Text(text) => text.to_string().into(),
        Value::List(items) => items.iter().map(to_rhai).collect::<Vec<_>>().into(),
        Value::Map(fields) => {
            Dynamic::from_map(fields.iter().map(|(name, value)| (name.as_ref().into(), to_rhai(value))).collect())
        }
    }
}

/// Nothing for what must not flow.
pub(crate) fn from_rhai(made: &Dynamic) -> Option<Value> {
    if made.is_map() {
        let fields = made.clone_cast::<Map>();
        let fields: Option<Vec<_>> =
            fields.iter().map(|(name, made)| Some((name.as_str(), from_rhai(made)?))).collect();
        return fields.map(Value::object);
    }
    if made.is_array() {
        let items = made.clone_cast::<Vec<Dynamic>>();
        return items.iter().map(from_rhai).collect::<Option<Vec<_>>>().map(Value::list);
    }
    if made.is_string() {
        return Some(Value::text(made.clone_cast::<String>()));
    }
    if made.is_unit() {
        return Some(Value::Null);
    }
    let whole = || made.as_int().ok().map(Value::Int);
    let number = || made.as_float().ok().filter(|number| number.is_finite()).map(Value::Float);
    made.as_bool().ok().map(Value::Bool).or_else(whole).or_else(number)
}
