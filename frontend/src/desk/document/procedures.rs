//! Trying procedures while they are written.

use super::Document;
use crate::link;
use behaviour::Value;
use protocol::{Reply, Request, UnknownName};

/// The results of a procedure for given values: why it cannot run at all, one result per set of values, and a name in
/// it that means nothing.
pub(crate) type ProcedureResults = (Option<String>, Vec<Result<Value, String>>, Option<UnknownName>);

impl Document {
    /// Asks if a procedure can run, and what it makes of at most 8 sets of values. Not answered while offline.
    pub(crate) fn check_body(
        &self,
        arguments: Vec<String>,
        body: String,
        inputs: Vec<Vec<Value>>,
        on_answer: impl FnOnce(ProcedureResults) + 'static,
    ) {
        link::ask(Request::Check { arguments, body, inputs }, move |reply| {
            if let Some(Reply::Checked { error, results, unknown }) = reply {
                on_answer((error.clone(), results.clone(), unknown.clone()));
            }
        });
    }
}
