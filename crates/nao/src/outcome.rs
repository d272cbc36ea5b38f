//! The outcome of something that was asked of the robot, in words for people: never the robot's own text, which names
//! files and lines of its code.

use crate::deed::ServiceCall;
use qi::{QiError, Value};
use robot::RobotFault;

/// Why an action did not come about, if it did not. Who ended it knows why it ended.
pub(crate) fn failed(wanted: &ServiceCall, done: &Result<Value, QiError>) -> Option<RobotFault> {
    let not_now = |why: &str| Some(RobotFault::NotNow(why.to_owned()));
    match (wanted.method, done) {
        ("learnFace", Ok(value)) if value.as_bool() == Some(false) => Some(RobotFault::NoFace),
        ("goToPosture", Ok(value)) if value.as_bool() == Some(false) => not_now(POSTURE),
        (_, Ok(_) | Err(QiError::Disconnected(_))) => None,
        ("goToPosture", Err(QiError::Remote { .. })) => not_now(POSTURE),
        ("run", Err(QiError::Remote { .. })) => not_now("it does not know this gesture, or something keeps it from it"),
        ("playFile", Err(QiError::Remote { .. })) => not_now("it has no such sound, or cannot play it"),
        ("learnFace", Err(QiError::Remote { .. })) => not_now("it could not learn the face"),
        (_, Err(error)) => Some(RobotFault::NotNow(why(error))),
    }
}

const POSTURE: &str = "it did not come into the posture";

/// Why a call had no result, without the robot's own text.
pub(crate) fn why(error: &QiError) -> String {
    match error {
        QiError::NoService { name } => format!("its {service} is not there", service = name),
        QiError::Timeout { .. } => "it did not answer in time".to_owned(),
        QiError::Disconnected(_) => "the connection ended".to_owned(),
        QiError::NoMethod { .. } => "its software cannot do this".to_owned(),
        _ => "it refuses".to_owned(),
    }
}
