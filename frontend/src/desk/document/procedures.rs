//! Trying procedures while they are written.

use super::Document;
use crate::link;
use behaviour::Value;
use phrase::Phrase;
use protocol::{UnknownName, answer, request};

/// The results of a procedure for given values: why it cannot run at all, one result per set of values, and a name in
/// it that means nothing.
pub(crate) type ProcedureResults = (Option<Phrase>, Vec<Result<Value, Phrase>>, Option<UnknownName>);

impl Document {
    /// Asks if a procedure can run, and what it makes of at most 8 sets of values. Not answered while offline.
    pub(crate) fn check_body(
        &self,
        arguments: Vec<String>,
        body: String,
        inputs: Vec<Vec<Value>>,
        on_answer: impl FnOnce(ProcedureResults) + 'static,
    ) {
        link::ask(request::Check { arguments, body, inputs }, move |answer| {
            if let Ok(answer::Checked { error, results, unknown }) = answer {
                on_answer((error, results, unknown));
            }
        });
    }
}
