//! Calls on one session, each within a bound and never waited for by who has something else to do.

use crate::deed::ServiceCall;
use qi::{QiError, Session, Value};
use std::time::Duration;

/// The longest that a call may take that answers at once.
pub(crate) const CALL: Duration = Duration::from_millis(2_000);

/// Calls and waits for the answer.
pub(crate) async fn call(session: &Session, call: &ServiceCall, within: Duration) -> Result<Value, QiError> {
    let object = session.service(call.service).await?;
    object.call_within(call.method, &call.arguments, within).await
}

/// Calls and waits for the answer, until nobody wants that any more: then the robot is asked to give it up.
pub(crate) async fn call_until(
    session: &Session,
    call: &ServiceCall,
    within: Duration,
    unwanted: impl Future<Output = ()>,
) -> Result<Value, QiError> {
    let object = session.service(call.service).await?;
    object.call_until(call.method, &call.arguments, within, unwanted).await
}

/// Calls, and says in the log if that went wrong.
pub(crate) async fn try_call(session: &Session, wanted: &ServiceCall) -> Option<Value> {
    let done = call(session, wanted, CALL).await;
    done.inspect_err(|error| {
        tracing::debug!(service = wanted.service, method = wanted.method, %error, "the robot did not do it");
    })
    .ok()
}

/// The link is over.
pub(crate) struct Over;

/// True if a call had no answer.
pub(crate) fn is_silent(done: &Result<Value, QiError>) -> Result<bool, Over> {
    match done {
        Ok(_) | Err(QiError::NoService { .. } | QiError::NoMethod { .. } | QiError::Remote { .. }) => Ok(false),
        Err(QiError::Disconnected(_)) => Err(Over),
        Err(_) => Ok(true),
    }
}
