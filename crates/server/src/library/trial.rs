//! Tries procedures. Done by workers: people's procedures never run on the threads that carry messages.

use crate::rooms::knowledge::Unchecked;
use behaviour::{
    Behaviour, BehaviourFile, Connector, FileHelper, Helper, Id, Kind, Procedure, Record, RecordId, Value, ValueType,
    connectors,
};
use engine::Limits;
use phrase::Phrased;
use protocol::UnknownName;
use protocol::answer::Checked;
use std::time::{Duration, Instant};

/// Sets of values in one trial.
const INPUTS_MAX: usize = 8;
/// How long a procedure may take for one set of values.
const CALL_MS: u64 = 20;

/// A procedure and what to try it on.
#[derive(Debug)]
pub(crate) struct ProcedureTrial {
    /// Argument names.
    pub(crate) arguments: Vec<String>,
    /// The procedure.
    pub(crate) body: String,
    /// Sets of values.
    pub(crate) inputs: Vec<Vec<Value>>,
    /// The helpers it uses.
    pub(crate) helpers: Vec<FileHelper>,
    /// The names of all helpers.
    pub(crate) known: Vec<String>,
}

fn failed(why: &impl Phrased, unknown: Option<UnknownName>) -> Checked {
    Checked { error: Some(why.phrase()), results: Vec::new(), unknown }
}

/// Whether the procedure can run, and what it makes of the values.
pub(crate) fn check(trial: &ProcedureTrial) -> Checked {
    if trial.body.chars().count() > behaviour::BODY_MAX_CHARS {
        return failed(&Unchecked::TooLong, None);
    }
    let unknown = unknown_name(trial);
    if let Err(reason) = engine::check_body(&trial.arguments, &trial.body) {
        return failed(&reason, unknown);
    }
    let try_on = |inputs: &Vec<Value>| {
        let ProcedureTrial { helpers, arguments, body, .. } = trial;
        engine::try_body(helpers, arguments, body, inputs, &limits()).map_err(|reason| reason.phrase())
    };
    Checked { error: None, results: trial.inputs.iter().take(INPUTS_MAX).map(try_on).collect(), unknown }
}

/// A name that means nothing, with the one that is probably meant.
fn unknown_name(trial: &ProcedureTrial) -> Option<UnknownName> {
    let arguments: Vec<_> = trial.arguments.iter().map(|name| (name.clone(), ValueType::Any)).collect();
    let helpers: Vec<&str> = trial.known.iter().map(String::as_str).collect();
    let (name, known) = engine::unknown_name(&arguments, &trial.body, &helpers)?;
    Some(UnknownName { near: behaviour::near(&name, &known), name })
}

/// The limits of one call that begins now.
fn limits() -> Limits {
    let end = Instant::now() + Duration::from_millis(CALL_MS);
    Limits::default().interrupted_by(move || Instant::now() >= end)
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
    use super::{ProcedureTrial, check, helpers_of};
    use behaviour::Value;
    use protocol::answer::Checked;

    fn trial(body: &str, inputs: &[f64]) -> ProcedureTrial {
        let helpers = robot::shipped_helpers();
        let helpers = helpers_of(body, &helpers.iter().collect::<Vec<_>>());
        let inputs = inputs.iter().map(|input| vec![Value::Float(*input)]).collect();
        let known = robot::shipped_helpers().into_iter().map(|helper| helper.name).collect();
        ProcedureTrial { arguments: vec!["d".into()], body: body.into(), inputs, helpers, known }
    }

    #[test]
    fn a_procedure_is_tried_with_the_helpers_it_uses() {
        let reply = check(&trial("distance_to_brightness(d) + 1.0", &[0.2, 1.2]));
        let results = vec![Ok(Value::Float(2.0)), Ok(Value::Float(1.0))];
        assert_eq!(reply, Checked { error: None, results, unknown: None });
    }

    #[test]
    fn an_endless_procedure_ends_and_a_broken_one_is_named() {
        let Checked { error: None, results, .. } = check(&trial("loop {}", &[1.0])) else { panic!() };
        assert!(results[0].is_err());
        let reply = check(&trial("d +", &[1.0]));
        assert!(matches!(reply, Checked { error: Some(_), .. }), "{reply:?}");
    }

    #[test]
    fn a_mistyped_name_is_told_with_what_is_meant() {
        for (body, wrong, meant) in [
            ("dd + 1.0", "dd", Some("d")),
            ("distance_to_brightnes(d)", "distance_to_brightnes", Some("distance_to_brightness")),
            ("qwertyuiop(d)", "qwertyuiop", None),
        ] {
            let Checked { unknown, .. } = check(&trial(body, &[1.0]));
            let unknown = unknown.unwrap();
            assert_eq!((unknown.name.as_str(), unknown.near.as_deref()), (wrong, meant));
        }
    }
}
