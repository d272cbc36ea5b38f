//! What the rules ask: the catalogue of devices, and whether a procedure can run. Answers about procedures are kept.

use crate::support::lock;
use behaviour::{DeviceType, Helper, HelperCall, Knowledge, Params, Signature, StreamKind, ValueType};
use phrase::{Phrase, Phrased};
use std::cell::Cell;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Answers that are kept.
const ANSWERS_MAX: usize = 4_096;
/// The texts of all kept answers, in bytes.
const ANSWERS_MAX_BYTES: usize = 4 << 20;
/// Procedures that one change may bring to be checked, in bytes.
const NEW_MAX_BYTES: usize = 128 << 10;
/// How long checking one change may take; what fits [`NEW_MAX_BYTES`] takes less, unless the computer is very busy.
const CHECK_MS: u64 = 2_000;

type KnowledgeQuestion = (Vec<String>, String);
/// What [`Knowledge`] answers.
type KnowledgeAnswer = Result<(), Phrase>;

/// Why a procedure was not checked.
#[derive(Debug)]
pub(crate) enum Unchecked {
    /// It is longer than a procedure may be.
    TooLong,
    /// The change brings more procedures than are checked at once.
    TooMuch,
    /// Who asked is gone.
    NobodyWaits,
    /// The procedures of the file take more time than they may.
    TooSlow,
}

/// Devices and procedures, as this rrp knows them.
#[derive(Debug, Default)]
pub struct Knowing(Mutex<KnowledgeAnswers>);

#[derive(Debug, Default)]
struct KnowledgeAnswers {
    known: HashMap<Arc<KnowledgeQuestion>, KnowledgeAnswer>,
    order: VecDeque<Arc<KnowledgeQuestion>>,
    bytes: usize,
}

impl Knowing {
    /// What this knows, for one change, which may not keep anybody busy for long.
    pub(crate) fn within_budget(&self) -> Budgeted<'_> {
        let until = Instant::now() + Duration::from_millis(CHECK_MS);
        Budgeted { knowing: self, bytes: Cell::new(NEW_MAX_BYTES), until }
    }

    fn known(&self, question: &KnowledgeQuestion) -> Option<KnowledgeAnswer> {
        lock(&self.0).known.get(question).cloned()
    }

    fn find_out(&self, question: KnowledgeQuestion) -> KnowledgeAnswer {
        let answer = engine::check_body(&question.0, &question.1).map_err(|fault| fault.phrase());
        lock(&self.0).keep(Arc::new(question), answer.clone());
        answer
    }
}

impl Knowledge for Knowing {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> KnowledgeAnswer {
        robot::device(kind, device).and_then(|device| device.check(params)).map_err(|fault| fault.phrase())
    }

    fn body(&self, arguments: &[String], body: &str) -> KnowledgeAnswer {
        let question = (arguments.to_vec(), body.to_owned());
        self.known(&question).unwrap_or_else(|| self.find_out(question))
    }

    fn device_type(&self, kind: StreamKind, device: &str, params: &Params) -> DeviceType {
        robot::device_type(kind, device, params)
    }

    fn result(&self, arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> ValueType {
        engine::result_type(arguments, body, helper)
    }

    fn signature(&self, helper: &Helper) -> Option<Signature> {
        robot::shipped_signature(helper)
    }

    fn misused(&self, arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> Option<(String, usize)> {
        engine::misused(arguments, body, helper)
    }

    fn stream_of(&self, helper: &str) -> Option<&'static str> {
        robot::helper_stream(helper)
    }

    fn unknown_name(
        &self,
        arguments: &[(String, ValueType)],
        body: &str,
        helpers: &[&str],
    ) -> Option<(String, Vec<String>)> {
        engine::unknown_name(arguments, body, helpers)
    }
}

/// What one change may ask.
pub(crate) struct Budgeted<'a> {
    knowing: &'a Knowing,
    bytes: Cell<usize>,
    until: Instant,
}

impl Knowledge for Budgeted<'_> {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> KnowledgeAnswer {
        self.knowing.device(kind, device, params)
    }

    fn body(&self, arguments: &[String], body: &str) -> KnowledgeAnswer {
        let question = (arguments.to_vec(), body.to_owned());
        if let Some(answer) = self.knowing.known(&question) {
            return answer;
        }
        let too_much = || Unchecked::TooMuch.phrase();
        self.bytes.set(self.bytes.get().checked_sub(body.len()).ok_or_else(too_much)?);
        if Instant::now() >= self.until { Err(too_much()) } else { self.knowing.find_out(question) }
    }
}

impl KnowledgeAnswers {
    fn keep(&mut self, question: Arc<KnowledgeQuestion>, answer: KnowledgeAnswer) {
        let bytes = size(&question);
        if self.known.insert(Arc::clone(&question), answer).is_none() {
            self.order.push_back(question);
            self.bytes += bytes;
        }
        while self.order.len() > ANSWERS_MAX || self.bytes > ANSWERS_MAX_BYTES {
            let Some(oldest) = self.order.pop_front() else { return };
            self.known.remove(&oldest);
            self.bytes -= size(&oldest);
        }
    }
}

fn size(question: &KnowledgeQuestion) -> usize {
    question.1.len() + question.0.iter().map(String::len).sum::<usize>()
}

#[cfg(test)]
mod tests {
    use super::{ANSWERS_MAX_BYTES, Knowing, NEW_MAX_BYTES};
    use crate::support::lock;
    use behaviour::Knowledge;

    fn body(number: usize) -> String {
        format!("{number} + {}", " ".repeat(4_000)) + "1"
    }

    #[test]
    fn one_change_may_bring_so_much_and_what_is_known_is_free() {
        let (knowing, most) = (Knowing::default(), NEW_MAX_BYTES / 4_000);
        let passed = (0..2 * most).filter(|number| knowing.within_budget().body(&[], &body(*number)).is_ok()).count();
        assert_eq!(passed, 2 * most, "each with a budget of its own");
        let change = knowing.within_budget();
        let again = (0..2 * most).filter(|number| change.body(&[], &body(*number)).is_ok()).count();
        assert_eq!(again, 2 * most, "all of them are known");
        let new = (0..2 * most).map(|number| change.body(&[], &body(1_000 + number))).filter(Result::is_ok).count();
        assert!(new < most + 1 && new > most / 2, "{new}");
    }

    #[test]
    fn what_is_kept_is_bounded_in_bytes() {
        let knowing = Knowing::default();
        for number in 0..ANSWERS_MAX_BYTES / 4_000 + 100 {
            knowing.body(&[], &body(number)).unwrap();
        }
        let answers = lock(&knowing.0);
        assert!(answers.bytes <= ANSWERS_MAX_BYTES && answers.known.len() == answers.order.len());
    }
}
