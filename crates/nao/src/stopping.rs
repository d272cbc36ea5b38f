//! Stop, on a link of its own that is logged in and knows its services before it is needed: whatever the other link does,
//! walking, following, speaking, playing and measuring end, and the joints hold where they are. Motors stay on.

use crate::acting::set_angles;
use crate::deed::Call;
use crate::link::{CALL, call};
use crate::settings::Settings;
use crate::shared::Shared;
use futures_util::future::join_all;
use qi::{Address, QiError, Session, Value};
use std::sync::Arc;
use std::time::Duration;

/// Pause before the link is tried again, in milliseconds.
const AGAIN_MS: u64 = 250;
/// How often it is looked whether the link is still there, in milliseconds.
const PING_MS: u64 = 1_000;
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
            match burst(session, shared).await {
                Ok(()) => shared.stopped(gate),
                Err(QiError::Disconnected(_)) => return,
                Err(error) => {
                    tracing::warn!(%error, "Stop is tried again");
                    tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
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

/// All at once; then the joints are told to stay where they are.
async fn burst(session: &Session, shared: &Shared) -> Result<(), QiError> {
    let (playing, subscribed) = {
        let mut state = shared.state();
        (state.playing.clone(), std::mem::take(&mut state.subscribed))
    };
    let mut calls = vec![
        Call::new("ALMotion", "stopMove", []),
        Call::new("ALTracker", "stopTracker", []),
        Call::new("ALTracker", "unregisterAllTargets", []),
        Call::new("ALTextToSpeech", "stopAll", []),
        Call::new("ALAudioPlayer", "stopAll", []),
        Call::new("ALRobotPosture", "stopMove", []),
        Call::new("ALMotion", "killAll", []),
    ];
    let animations = playing.iter().filter(|name| name.starts_with("animations/"));
    calls.extend(animations.map(|name| Call::new("ALBehaviorManager", "stopBehavior", [name.as_str().into()])));
    let ends = subscribed.iter().map(|(service, name)| Call::new(service, "unsubscribe", [name.as_str().into()]));
    calls.extend(ends);
    let done = join_all(calls.iter().map(|wanted| call(session, wanted, CALL))).await;
    let freezing = freeze(session).await;
    for result in done.into_iter().chain([freezing]) {
        match result {
            // A service that is not there, or refuses, has nothing that goes on.
            Ok(_) | Err(QiError::NoService { .. } | QiError::NoMethod { .. } | QiError::Remote { .. }) => {}
            Err(error) => {
                // They are ended with the next try.
                shared.state().subscribed.extend(subscribed);
                return Err(error);
            }
        }
    }
    Ok(())
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
    call(session, &set_angles(&names, &angles, HOLD_SPEED), CALL).await
}
