//! The outcome of something that was asked of the robot, in words for people: never the robot's own text, which names
//! files and lines of its code.

use crate::deed::ServiceCall;
use phrase::{Phrase, phrase};
use qi::{QiError, Value};
use robot::RobotFault;

/// Why an action did not come about, if it did not. Who ended it knows why it ended.
pub(crate) fn failed(wanted: &ServiceCall, done: &Result<Value, QiError>) -> Option<RobotFault> {
    let not_now = |why: Phrase| Some(RobotFault::NotNow(why));
    match (wanted.method, done) {
        ("learnFace", Ok(value)) if value.as_bool() == Some(false) => Some(RobotFault::NoFace),
        ("goToPosture", Ok(value)) if value.as_bool() == Some(false) => not_now(no_posture()),
        (_, Ok(_) | Err(QiError::Disconnected(_))) => None,
        ("goToPosture", Err(QiError::Remote { .. })) => not_now(no_posture()),
        ("run", Err(QiError::Remote { .. })) => not_now(phrase!(
            "nao.it_does_not_know_this",
            "it does not know this gesture, or something keeps it from it"
        )),
        ("playFile", Err(QiError::Remote { .. })) => {
            not_now(phrase!("nao.it_has_no_such_sound", "it has no such sound, or cannot play it"))
        }
        ("learnFace", Err(QiError::Remote { .. })) => {
            not_now(phrase!("nao.it_could_not_learn_the", "it could not learn the face"))
        }
        (_, Err(error)) => Some(RobotFault::NotNow(why(error))),
    }
}

fn no_posture() -> Phrase {
    phrase!("nao.no_posture", "it did not come into the posture")
}

/// Why a call had no result, without the robot's own text.
pub(crate) fn why(error: &QiError) -> Phrase {
    match error {
        QiError::NoService { name } => phrase!("nao.its_is_not_there", "its {service} is not there", service = name),
        QiError::Timeout { .. } => phrase!("nao.it_did_not_answer_in", "it did not answer in time"),
        QiError::Disconnected(_) => phrase!("nao.the_connection_ended_2", "the connection ended"),
        QiError::NoMethod { .. } => phrase!("nao.its_software_cannot_do_this", "its software cannot do this"),
        _ => phrase!("nao.it_refuses", "it refuses"),
    }
}
