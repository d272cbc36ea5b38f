//! Stop, on a link of its own that is logged in and knows its services before it is needed: whatever the other link does,
//! walking, following, speaking, playing and measuring end, and the joints hold where they are. Motors stay on. A rest goes
//! the same way: first everything ends, then the robot sits down, unless it falls.

use crate::body::is_joint;
use crate::deed::Call;
use crate::link::{CALL, call};
use crate::settings::Settings;
use crate::shared::Shared;
use crate::status;
use crate::targets::set_angles;
use futures_util::{future::join_all, join};
use qi::{Address, QiError, Session, Value};
use std::sync::Arc;
use std::time::Duration;

/// Pause before the link is tried again, in milliseconds.
const AGAIN_MS: u64 = 250;
/// How often it is looked whether the link is still there, in milliseconds.
const PING_MS: u64 = 1_000;
/// How often what did not answer is told again.
const TRIES: usize = 5;
/// How long sitting down may take.
const REST: Duration = Duration::from_secs(30);
/// How fast joints go back to where they are, as a fraction of the top speed.
const HOLD_SPEED: f64 = 0.2;
/// The services that Stop needs.
const SERVICES: [&str; 7] = [
    "ALMotion",
    "ALTracker",
    "ALTextToSpeech",
    "ALBehaviorManager",
    "ALAudioPlayer",
    "ALRobotPosture",
    "ALSpeechRecognition",
];

/// What ends, whatever was begun.
const EVERYTHING: [(&str, &str); 6] = [
    ("ALMotion", "stopMove"),
    ("ALTracker", "stopTracker"),
    ("ALTracker", "unregisterAllTargets"),
    ("ALTextToSpeech", "stopAll"),
    ("ALAudioPlayer", "stopAll"),
    ("ALRobotPosture", "stopMove"),
];

/// Keeps the link for as long as it is not dropped, and carries out every Stop; one that cannot be carried out now is as soon
/// as the robot is there.
pub(crate) async fn keep(address: Address, settings: Settings, shared: Arc<Shared>) {
    loop {
        if let Ok(session) = Session::connect(&address, settings.options()).await {
            join_all(SERVICES.iter().map(|name| session.service(name))).await;
            serve(&session, &shared).await;
        }
        tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
    }
}

/// Until the link is over.
async fn serve(session: &Session, shared: &Shared) {
    loop {
        if shared.wants_stop() {
            let gate = shared.gate();
            let ended = tokio::select! {
                biased;
                ended = burst(session, shared) => ended,
                // A new one waits for no answer to the last.
                () = shared.stopping.notified() => continue,
            };
            if !ended {
                return;
            }
            shared.stopped(gate);
            if !shared.wants_stop() && shared.take_rest() {
                tokio::select! {
                    () = rest(session, shared) => {}
                    () = shared.stopping.notified() => {}
                }
            }
            continue;
        }
        tokio::select! {
            () = shared.stopping.notified() => {}
            _ = session.link().ended() => return,
            () = tokio::time::sleep(Duration::from_millis(PING_MS)) => {
                // A Stop does not wait for it.
                let gone = tokio::select! {
                    pong = session.link().ping(CALL) => pong.is_err(),
                    () = shared.stopping.notified() => false,
                };
                if gone {
                    session.link().close();
                    return;
                }
            }
        }
    }
}

/// All at once. A service that is not there, or refuses, has nothing that goes on; one that does not answer is told again, a
/// few times. False if the link is over: then it is done with the next one.
async fn burst(session: &Session, shared: &Shared) -> bool {
    let (playing, subscribed) = {
        let state = shared.state();
        (state.animations.clone(), state.subscribed.clone())
    };
    let animations = playing.iter().map(|name| Call::new("ALBehaviorManager", "stopBehavior", [name.as_str().into()]));
    let ends = subscribed.iter().map(|(service, name)| Call::new(service, "unsubscribe", [name.as_str().into()]));
    let calls = EVERYTHING.map(|(service, method)| Call::new(service, method, []));
    let mut left: Vec<Call> = calls.into_iter().chain(animations).chain(ends).collect();
    let mut freezes = true;
    for _ in 0..TRIES {
        // What is frozen comes behind what kills the tasks.
        let hold = async {
            let killed = call(session, &Call::new("ALMotion", "killAll", []), CALL).await;
            if is_silent(&killed)? { Ok(true) } else { is_silent(&freeze(session).await) }
        };
        let (done, held) = join!(join_all(left.iter().map(|wanted| call(session, wanted, CALL))), async {
            if freezes { hold.await } else { Ok(false) }
        });
        let Ok(silent) = done.iter().map(is_silent).chain([held]).collect::<Result<Vec<bool>, Over>>() else {
            return false;
        };
        freezes = silent.last().copied().unwrap_or_default();
        left = left.into_iter().zip(silent).filter(|(_, silent)| *silent).map(|(wanted, _)| wanted).collect();
        if left.is_empty() && !freezes {
            break;
        }
        tracing::warn!(left = left.len(), "what does not answer is stopped again");
    }
    // Not before: what is not known to have ended ends with the next try.
    let mut state = shared.state();
    state.subscribed.retain(|known| !subscribed.contains(known));
    state.animations.retain(|known| !playing.contains(known));
    true
}

/// The link is over.
struct Over;

/// Whether a call had no answer.
fn is_silent(done: &Result<Value, QiError>) -> Result<bool, Over> {
    match done {
        Ok(_) | Err(QiError::NoService { .. } | QiError::NoMethod { .. } | QiError::Remote { .. }) => Ok(false),
        Err(QiError::Disconnected(_)) => Err(Over),
        Err(_) => Ok(true),
    }
}

/// Sits down and lets go of the motors, but never on the way to the floor.
async fn rest(session: &Session, shared: &Shared) {
    if shared.state().may_rest()
        && let Err(error) = call(session, &Call::new("ALMotion", "rest", []), REST).await
    {
        tracing::warn!(%error, "the robot does not rest");
    }
    status::ask(session, shared).await;
}

/// The targets of `setAngles` are no tasks, which `killAll` would end.
async fn freeze(session: &Session) -> Result<Value, QiError> {
    let names = call(session, &Call::new("ALMotion", "getBodyNames", ["Body".into()]), CALL).await?;
    let angles = Call::new("ALMotion", "getAngles", [Value::dynamic("Body"), true.into()]);
    let angles = call(session, &angles, CALL).await?;
    let names: Vec<String> =
        names.items().unwrap_or_default().iter().filter_map(|name| Some(name.as_text()?.into_owned())).collect();
    let angles: Vec<f64> = angles.items().unwrap_or_default().iter().filter_map(Value::as_f64).collect();
    if names.is_empty() || names.len() != angles.len() {
        return Ok(Value::Unit);
    }
    let held = names.into_iter().zip(angles).filter(|(name, _)| is_joint(name));
    let (names, angles): (Vec<String>, Vec<f64>) = held.unzip();
    call(session, &set_angles(&names, &angles, HOLD_SPEED), CALL).await
}
