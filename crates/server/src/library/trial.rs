//! Tries procedures. Done by workers: people's procedures never run on the threads that carry messages.

use behaviour::{
    Behaviour, BehaviourFile, Connector, FileHelper, Helper, Id, Kind, Procedure, Record, RecordId, Value, connectors,
};
use engine::Limits;
use protocol::Reply;
use std::time::{Duration, Instant};

/// Sets of values in one trial.
const INPUTS_MAX: usize = 8;
/// How long a procedure may take for one set of values.
const CALL_MS: u64 = 20;

/// A procedure and what to try it on.
#[derive(Debug)]
pub(crate) struct Trial {
    /// Argument names.
    pub(crate) arguments: Vec<String>,
    /// The procedure.
    pub(crate) body: String,
    /// Sets of values.
    pub(crate) inputs: Vec<Vec<Value>>,
    /// The helpers it uses.
    pub(crate) helpers: Vec<FileHelper>,
}

fn failed(error: String) -> Reply {
    Reply::Checked { error: Some(error), results: Vec::new() }
}

/// Whether the procedure can run, and what it makes of the values.
pub(crate) fn check(trial: &Trial) -> Reply {
    if trial.body.chars().count() > behaviour::BODY_MAX_CHARS {
        return failed(format!("it is longer than {} characters", behaviour::BODY_MAX_CHARS));
    }
    if let Err(fault) = engine::check_body(&trial.arguments, &trial.body) {
        return failed(fault.to_string());
    }
    let results = trial.inputs.iter().take(INPUTS_MAX).map(|inputs| try_on(trial, inputs)).collect();
    Reply::Checked { error: None, results }
}

fn try_on(trial: &Trial, inputs: &[Value]) -> Result<Value, String> {
    let end = Instant::now() + Duration::from_millis(CALL_MS);
    let limits = Limits::default().interrupted_by(move || Instant::now() >= end);
    engine::try_body(&trial.helpers, &trial.arguments, &trial.body, inputs, &limits).map_err(|fault| fault.to_string())
}

/// The helpers that a procedure uses, also through other helpers.
pub(crate) fn helpers_of(body: &str, library: &[&Helper]) -> Vec<FileHelper> {
    let Ok(id) = Id::new("it") else { return Vec::new() };
    let operation = connectors::to_new_value().with(Procedure::body(body));
    let connector = Connector { operation, inputs: Vec::new(), output: id.clone(), order: 0 };
    let mut behaviour = Behaviour::default();
    behaviour.records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(connector));
    BehaviourFile::of(&behaviour, library).helpers
}

#[cfg(test)]
mod tests {
    use super::{Trial, check, helpers_of};
    use behaviour::Value;
    use protocol::Reply;

    fn trial(body: &str, inputs: &[f64]) -> Trial {
        let helpers = robot::shipped_helpers();
        let helpers = helpers_of(body, &helpers.iter().collect::<Vec<_>>());
        let inputs = inputs.iter().map(|input| vec![Value::Float(*input)]).collect();
        Trial { arguments: vec!["d".into()], body: body.into(), inputs, helpers }
    }

    #[test]
    fn a_procedure_is_tried_with_the_helpers_it_uses() {
        let reply = check(&trial("distance_to_brightness(d) + 1.0", &[0.2, 1.2]));
        let results = vec![Ok(Value::Float(2.0)), Ok(Value::Float(1.0))];
        assert_eq!(reply, Reply::Checked { error: None, results });
    }

    #[test]
    fn an_endless_procedure_ends_and_a_broken_one_is_named() {
        let Reply::Checked { error: None, results } = check(&trial("loop {}", &[1.0])) else { panic!() };
        assert!(results[0].is_err());
        let reply = check(&trial("d +", &[1.0]));
        assert!(matches!(reply, Reply::Checked { error: Some(_), .. }), "{reply:?}");
    }
}
