//! Stop, on a link of its own that is logged in and knows its services before it is needed: whatever the other link does,
//! walking, following, speaking, playing and measuring end, and the joints hold where they are. Motors stay on. A rest goes
//! the same way: first everything ends, then the robot sits down, unless it falls.
//!
//! Head and arms hold at once. The legs are the robot's own until its `stopMove` has answered, which it does when both feet are
//! on the ground: whoever kills the walk or sets the legs before that makes it fall.

use crate::body::{is_joint, is_leg};
use crate::deed::ServiceCall;
use crate::link::{CALL, Over, call, is_silent};
use crate::settings::RobotSettings;
use crate::shared::NaoShared;
use crate::status;
use crate::targets::set_angles;
use futures_util::{future::join_all, join};
use qi::{PeerAddress, QiError, Session, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

/// Pause before the link is tried again, in milliseconds.
const AGAIN_MS: u64 = 250;
/// The pause before it is looked again whether the link is still there, in milliseconds.
const PING_MS: u64 = 1_000;
/// The number of times that a call without an answer is told again.
const TRIES: usize = 5;
/// The longest that sitting down may take.
const REST: Duration = Duration::from_secs(30);
/// The speed at which joints go back to where they are, as a fraction of the top speed.
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

/// The calls that end whatever was begun; the walk and the joints besides.
const EVERYTHING: [(&str, &str); 5] = [
    ("ALTracker", "stopTracker"),
    ("ALTracker", "unregisterAllTargets"),
    ("ALTextToSpeech", "stopAll"),
    ("ALAudioPlayer", "stopAll"),
    ("ALRobotPosture", "stopMove"),
];

/// Keeps the link for as long as it is not dropped, and carries out every Stop; one that cannot be carried out now is as soon
/// as the robot is there.
pub(crate) async fn keep(address: PeerAddress, settings: RobotSettings, shared: Arc<NaoShared>) {
    loop {
        if let Ok(session) = Session::connect(&address, settings.options()).await {
            join_all(SERVICES.iter().map(|name| session.service(name))).await;
            serve(&session, &shared).await;
        }
        tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
    }
}

/// Until the link is over.
async fn serve(session: &Session, shared: &NaoShared) {
    loop {
        if shared.wants_stop() {
            let stop_generation = shared.stop_generation();
            let ended = tokio::select! {
                biased;
                ended = burst(session, shared) => ended,
                // A new one waits for no answer to the last.
                () = shared.stopping.notified() => continue,
            };
            if !ended {
                return;
            }
            shared.stopped(stop_generation);
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
async fn burst(session: &Session, shared: &NaoShared) -> bool {
    let mut taken = TakenByStop::from(shared);
    let animations = taken
        .animations
        .iter()
        .map(|name| ServiceCall::new("ALBehaviorManager", "stopBehavior", [name.as_str().into()]));
    let ends =
        taken.subscribed.keys().map(|(service, name)| ServiceCall::new(service, "unsubscribe", [name.as_str().into()]));
    let calls = EVERYTHING.map(|(service, method)| ServiceCall::new(service, method, []));
    let mut left: Vec<ServiceCall> = calls.into_iter().chain(animations).chain(ends).collect();
    let (mut upper, mut legs) = (true, true);
    for _ in 0..TRIES {
        let (stands, holds, done) = join!(
            async { if legs { stand(session, shared).await } else { Ok(false) } },
            async { if upper { freeze(session, shared).await } else { Ok(false) } },
            join_all(left.iter().map(|wanted| call(session, wanted, CALL))),
        );
        let silent = done.iter().map(is_silent).collect::<Result<Vec<bool>, Over>>();
        let (Ok(legs_left), Ok(upper_left), Ok(silent)) = (stands, holds, silent) else { return false };
        (legs, upper) = (legs_left, upper_left);
        left = left.into_iter().zip(silent).filter(|(_, silent)| *silent).map(|(wanted, _)| wanted).collect();
        if left.is_empty() && !legs && !upper {
            break;
        }
        tracing::warn!(left = left.len(), legs, upper, "what does not answer is stopped again");
    }
    taken.is_over = true;
    shared.state().note_legs(legs);
    true
}

/// The part of measuring and playing that a Stop ends. It has nothing of what begins meanwhile; what is not known to
/// have ended is put back for the next try.
struct TakenByStop<'a> {
    shared: &'a NaoShared,
    animations: BTreeSet<String>,
    subscribed: BTreeMap<(&'static str, String), u64>,
    is_over: bool,
}

impl<'a> TakenByStop<'a> {
    fn from(shared: &'a NaoShared) -> Self {
        let mut state = shared.state();
        let (animations, subscribed) = (std::mem::take(&mut state.animations), state.subscribed.take());
        drop(state);
        Self { shared, animations, subscribed, is_over: false }
    }
}

impl Drop for TakenByStop<'_> {
    fn drop(&mut self) {
        if !self.is_over {
            let mut state = self.shared.state();
            state.animations.append(&mut self.animations);
            state.subscribed.put_back(std::mem::take(&mut self.subscribed));
        }
    }
}

/// Sits down and lets go of the motors, but never on the way to the floor.
async fn rest(session: &Session, shared: &NaoShared) {
    if shared.state().may_rest()
        && let Err(error) = call(session, &ServiceCall::new("ALMotion", "rest", []), REST).await
    {
        tracing::warn!(%error, "the robot does not rest");
    }
    status::ask(session, shared).await;
}

/// The joints of the body that do not stand on the ground, or those that do. Wheels are no joints.
fn joints(shared: &NaoShared, legs: bool) -> Vec<String> {
    let state = shared.state();
    state.joints.iter().filter(|joint| is_joint(joint) && is_leg(joint) == legs).cloned().collect()
}

fn list(joints: &[String]) -> Value {
    Value::List(joints.iter().map(|joint| joint.as_str().into()).collect())
}

/// Head and arms stay where they are. True if that had no answer.
async fn freeze(session: &Session, shared: &NaoShared) -> Result<bool, Over> {
    let joints = joints(shared, false);
    if joints.is_empty() {
        return Ok(false);
    }
    // What holds joints ends first: calls of one service are done in their order.
    let kill = ServiceCall::new("ALMotion", "killTasksUsingResources", [list(&joints)]);
    let (killed, held) = join!(call(session, &kill, CALL), hold(session, &joints));
    Ok(is_silent(&killed)? || is_silent(&held)?)
}

/// The walk ends as the robot ends it; not before, whatever else has the legs ends, and they stay where they are. True if the
/// robot did not answer, or walks again.
async fn stand(session: &Session, shared: &NaoShared) -> Result<bool, Over> {
    let stopped = call(session, &ServiceCall::new("ALMotion", "stopMove", []), CALL).await;
    if is_silent(&stopped)? {
        return Ok(true);
    }
    if stopped.is_err() {
        // It does not say that it stands: the legs are left alone.
        return Ok(false);
    }
    // Something late may have come by the other link.
    let walks = call(session, &ServiceCall::new("ALMotion", "moveIsActive", []), CALL).await;
    if is_silent(&walks)? || walks.is_ok_and(|walks| walks.as_bool() == Some(true)) {
        return Ok(true);
    }
    let legs = joints(shared, true);
    let kill = ServiceCall::new("ALMotion", "killAll", []);
    let (killed, held) = join!(call(session, &kill, CALL), hold(session, &legs));
    Ok(is_silent(&killed)? || is_silent(&held)?)
}

/// The targets of `setAngles` are no tasks, which end when they are killed: these joints get where they are as their target.
async fn hold(session: &Session, joints: &[String]) -> Result<Value, QiError> {
    if joints.is_empty() {
        return Ok(Value::Unit);
    }
    let angles = ServiceCall::new("ALMotion", "getAngles", [Value::dynamic(list(joints)), true.into()]);
    let angles = call(session, &angles, CALL).await?;
    let angles: Vec<f64> = angles.items().unwrap_or_default().iter().filter_map(Value::as_f64).collect();
    if joints.len() != angles.len() {
        return Ok(Value::Unit);
    }
    call(session, &set_angles(joints, &angles, HOLD_SPEED), CALL).await
}
