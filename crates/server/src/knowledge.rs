//! What the rules ask: the catalogue of devices, and whether a procedure can run. Answers about procedures are kept.

use crate::lock;
use behaviour::{Knowledge, Params, StreamKind};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Mutex;

/// Answers that are kept.
const ANSWERS_MAX: usize = 4_096;

type Question = (Vec<String>, String);

/// Devices and procedures, as this rrp knows them.
#[derive(Debug, Default)]
pub struct Knowing(Mutex<Answers>);

#[derive(Debug, Default)]
struct Answers {
    known: BTreeMap<Question, Result<(), String>>,
    order: VecDeque<Question>,
}

impl Knowledge for Knowing {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), String> {
        robot::device(kind, device)?.check(params)
    }

    fn body(&self, arguments: &[String], body: &str) -> Result<(), String> {
        let question = (arguments.to_vec(), body.to_owned());
        if let Some(answer) = lock(&self.0).known.get(&question) {
            return answer.clone();
        }
        let answer = engine::check_body(arguments, body);
        lock(&self.0).keep(question, answer.clone());
        answer
    }
}

impl Answers {
    fn keep(&mut self, question: Question, answer: Result<(), String>) {
        if self.known.insert(question.clone(), answer).is_none() {
            self.order.push_back(question);
        }
        if self.order.len() > ANSWERS_MAX
            && let Some(oldest) = self.order.pop_front()
        {
            self.known.remove(&oldest);
        }
    }
}
