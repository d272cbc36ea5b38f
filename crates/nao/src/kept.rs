//! The settings that were changed on a robot for us and have to be put back: how they were is kept in the robot's own
//! memory, so that the next connection finds it, whatever became of who set them.

use crate::deed::ServiceCall;
use crate::link::try_call;
use qi::{Session, Value};

pub(crate) fn key(own_name: &str, what: &str) -> String {
    format!("{own_name}/{what}")
}

pub(crate) fn memory(method: &'static str, arguments: impl Into<Vec<Value>>) -> ServiceCall {
    ServiceCall::new("ALMemory", method, arguments)
}

/// Returns what was kept, if something was.
pub(crate) async fn kept(session: &Session, own_name: &str, what: &str) -> Option<Value> {
    let value = try_call(session, &memory("getData", [key(own_name, what).into()])).await?;
    let is_gone = value.as_text().is_some_and(|text| text.is_empty());
    (!is_gone).then_some(value)
}

/// Keeps it.
pub(crate) async fn keep(session: &Session, own_name: &str, what: &str, value: Value) {
    try_call(session, &memory("insertData", [key(own_name, what).into(), Value::dynamic(value)])).await;
}

/// It was put back.
pub(crate) async fn forget(session: &Session, own_name: &str, what: &str) {
    // Before it is gone for good: some robots cannot take data away.
    keep(session, own_name, what, "".into()).await;
    try_call(session, &memory("removeData", [key(own_name, what).into()])).await;
}
