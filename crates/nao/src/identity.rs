//! Which body answers: read at each connection, before anything else is asked of it, and compared with the one that is
//! expected. Reading moves nothing and changes nothing.

use crate::deed::ServiceCall;
use crate::devices::eyes::shine;
use crate::link::{CALL, call, try_call};
use crate::models;
use crate::shared::NaoShared;
use qi::{QiError, Session, Value};
use robot::{Identity, Stranger};
use std::sync::Arc;
use std::time::Duration;

/// The number of the body, as DCM tells it; a simulated NAOqi has none.
const SERIAL: &str = "Device/DeviceList/ChestBoard/BodyId";
/// The longest name or number that is believed, in characters.
const TEXT_MAX_CHARS: usize = 80;
/// The number of times that the eyes go dark and bright for a sign, and how long each takes, in milliseconds.
const BLINKS: usize = 3;
const BLINK_MS: u64 = 300;

/// The body that answers is the one that is expected, or the first one; else it is a stranger.
///
/// # Errors
/// If the robot does not say enough to be told from another one: then it is asked again later.
pub(crate) async fn recognise(session: &Session, shared: &NaoShared) -> Result<Option<Box<Stranger>>, QiError> {
    let expected = shared.state().identity.clone();
    let needs_serial = expected.as_ref().is_some_and(|expected| !expected.serial.is_empty());
    let found = read(session, needs_serial).await?;
    let mut state = shared.state();
    match expected {
        Some(expected) if !expected.is_same(&found) => Ok(Some(Box::new(Stranger { expected, found }))),
        Some(expected) => {
            state.identity = Some(found.or(&expected));
            Ok(None)
        }
        None => {
            state.identity = Some(found);
            Ok(None)
        }
    }
}

/// Asks a robot who it is.
///
/// # Errors
/// If the link ends; and, where the number of the body is needed, if the robot is not ready to tell it.
pub(crate) async fn read(session: &Session, needs_serial: bool) -> Result<Identity, QiError> {
    let serial = match call(session, &ServiceCall::new("ALMemory", "getData", [SERIAL.into()]), CALL).await {
        Ok(value) => text(&value),
        // It has none.
        Err(QiError::Remote { .. }) => String::new(),
        Err(error @ QiError::Disconnected(_)) => return Err(error),
        Err(error) if needs_serial => return Err(error),
        Err(_) => String::new(),
    };
    let ask = async |service: &'static str, method: &'static str| {
        let told = try_call(session, &ServiceCall::new(service, method, [])).await;
        told.as_ref().map(text).unwrap_or_default()
    };
    let (head, name) = (ask("ServiceDirectory", "machineId").await, ask("ALSystem", "robotName").await);
    let joints = try_call(session, &ServiceCall::new("ALMotion", "getBodyNames", ["Body".into()])).await;
    let joints: Option<Vec<String>> =
        joints.map(|joints| joints.items().unwrap_or_default().iter().map(text).collect());
    let body = joints.map(|joints| models::kind_of(&joints).to_owned()).unwrap_or_default();
    Ok(Identity { name, body, serial, head })
}

/// Returns what is seen of a text, and no more than a person reads.
fn text(value: &Value) -> String {
    let text = value.as_text().unwrap_or_default();
    text.chars().filter(|sign| !sign.is_control()).take(TEXT_MAX_CHARS).collect::<String>().trim().to_owned()
}

/// The eyes go dark and bright, a few times; then they are as they are wanted by then, or as a stranger has them by itself.
pub(crate) async fn blink(session: Session, ours: Option<Arc<NaoShared>>) {
    for _ in 0..BLINKS {
        for bright in [0.0, 1.0] {
            try_call(&session, &shine([bright; 3])).await;
            tokio::time::sleep(Duration::from_millis(BLINK_MS)).await;
        }
    }
    let last = match ours {
        Some(shared) => shine(shared.state().eyes),
        None => ServiceCall::new("ALLeds", "reset", ["FaceLeds".into()]),
    };
    try_call(&session, &last).await;
}
