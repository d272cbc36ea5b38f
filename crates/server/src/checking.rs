//! Tries procedures on a thread of their own: people's procedures never run on the threads that carry messages.

use behaviour::{
    Behaviour, BehaviourFile, Connector, FileHelper, Helper, Id, Kind, Operation, Procedure, Record, RecordId, Value,
};
use engine::Limits;
use protocol::{Reply, SaidNo};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::{Duration, Instant};
use tokio::sync::oneshot;

/// Trials that may wait.
const WAITING_MAX: usize = 64;
/// Sets of values in one trial.
const INPUTS_MAX: usize = 8;
/// How long a procedure may take for one set of values.
const CALL_MS: u64 = 20;
/// The thread's stack; debug builds need the most.
const STACK_BYTES: usize = 16 << 20;

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

/// The way to the thread.
#[derive(Clone, Debug)]
pub(crate) struct Checker(SyncSender<(Trial, oneshot::Sender<Reply>)>);

impl Checker {
    /// Starts the thread; it ends with the last way to it.
    pub(crate) fn start() -> std::io::Result<Self> {
        let (queue, trials) = sync_channel(WAITING_MAX);
        std::thread::Builder::new().name("checking".into()).stack_size(STACK_BYTES).spawn(move || work(&trials))?;
        Ok(Self(queue))
    }

    /// Whether the procedure can run, and what it makes of the values.
    pub(crate) async fn check(&self, trial: Trial) -> Reply {
        let (waiting, answer) = oneshot::channel();
        if self.0.try_send((trial, waiting)).is_err() {
            return Reply::No { no: SaidNo::TooFast };
        }
        answer.await.unwrap_or(Reply::No { no: SaidNo::TooFast })
    }
}

fn work(trials: &Receiver<(Trial, oneshot::Sender<Reply>)>) {
    while let Ok((trial, waiting)) = trials.recv() {
        if !waiting.is_closed() {
            let reply = catch_unwind(AssertUnwindSafe(|| answer(&trial)));
            let _ = waiting.send(reply.unwrap_or_else(|_| failed("it makes the checker fail".to_owned())));
        }
    }
}

fn failed(error: String) -> Reply {
    Reply::Checked { error: Some(error), results: Vec::new() }
}

fn answer(trial: &Trial) -> Reply {
    if trial.body.chars().count() > behaviour::BODY_MAX_CHARS {
        return failed(format!("it is longer than {} characters", behaviour::BODY_MAX_CHARS));
    }
    if let Err(reason) = engine::check_body(&trial.arguments, &trial.body) {
        return failed(reason);
    }
    let results = trial.inputs.iter().take(INPUTS_MAX).map(|inputs| try_on(trial, inputs)).collect();
    Reply::Checked { error: None, results }
}

fn try_on(trial: &Trial, inputs: &[Value]) -> Result<Value, String> {
    let end = Instant::now() + Duration::from_millis(CALL_MS);
    let limits = Limits::default().interrupted_by(move || Instant::now() >= end);
    engine::try_body(&trial.helpers, &trial.arguments, &trial.body, inputs, &limits)
}

/// The helpers that a procedure uses, also through other helpers.
pub(crate) fn helpers_of(body: &str, library: &[&Helper]) -> Vec<FileHelper> {
    let Ok(id) = Id::new("it") else { return Vec::new() };
    let operation = Operation::Map(Procedure::body(body));
    let connector = Connector { operation, inputs: Vec::new(), output: id.clone(), order: 0 };
    let mut behaviour = Behaviour::default();
    behaviour.records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(connector));
    BehaviourFile::of(&behaviour, library).helpers
}

#[cfg(test)]
mod tests {
    use super::{Checker, Trial, helpers_of};
    use behaviour::Value;
    use protocol::Reply;

    fn trial(body: &str, inputs: &[f64]) -> Trial {
        let helpers = robot::shipped_helpers();
        let helpers = helpers_of(body, &helpers.iter().collect::<Vec<_>>());
        let inputs = inputs.iter().map(|input| vec![Value::Float(*input)]).collect();
        Trial { arguments: vec!["d".into()], body: body.into(), inputs, helpers }
    }

    #[tokio::test]
    async fn a_procedure_is_tried_with_the_helpers_it_uses() {
        let checker = Checker::start().unwrap();
        let reply = checker.check(trial("distance_to_brightness(d) + 1.0", &[0.2, 1.2])).await;
        let results = vec![Ok(Value::Float(2.0)), Ok(Value::Float(1.0))];
        assert_eq!(reply, Reply::Checked { error: None, results });
    }

    #[tokio::test]
    async fn an_endless_procedure_ends_and_a_broken_one_is_named() {
        let checker = Checker::start().unwrap();
        let Reply::Checked { error: None, results } = checker.check(trial("loop {}", &[1.0])).await else { panic!() };
        assert!(results[0].is_err());
        let reply = checker.check(trial("d +", &[1.0])).await;
        assert!(matches!(reply, Reply::Checked { error: Some(_), .. }), "{reply:?}");
    }
}
