//! The status of the body: battery, motors, own life, heat, falls. It is heard from events, and asked again and again
//! in case one was missed. Everything halts on a sign of danger to the robot.

use crate::body::is_leg;
use crate::deed::ServiceCall;
use crate::link::try_call;
use crate::senses::listen;
use crate::shared::{NaoShared, NaoState};
use phrase::{Phrase, phrase};
use qi::{Session, Value};
use robot::{Health, Life};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use tokio::time::MissedTickBehavior;

/// Events that say how the body is.
const KEYS: [&str; 11] = [
    "ALMotion/RobotIsFalling",
    "robotHasFallen",
    "HotDeviceDetected",
    "BatteryChargeChanged",
    "BatteryPowerPluggedChanged",
    "BatteryNearlyEmpty",
    "AutonomousLife/State",
    "PostureFamilyChanged",
    "robotIsWakeUp",
    "ALMotion/RobotIsStand",
    "footContactChanged",
];
/// Events that may wait.
const EVENTS_MAX: usize = 256;
/// The periods at which the joints are read, and at which everything else is, in milliseconds.
const ANGLES_MS: u64 = 50;
const ALL_MS: u64 = 1_500;
/// Below this the motors do not hold.
const STIFF_MIN: f64 = 0.05;
/// Below this of any of its legs the robot itself lets no walk begin, as documented.
const LEG_STIFF_MIN: f64 = 0.6;
/// Nearly empty, in percent.
const EMPTY_PERCENT: u8 = 5;

/// Watches for as long as the link lasts.
pub(crate) async fn watch(session: Session, shared: Arc<NaoShared>) {
    let (events, mut heard) = mpsc::channel::<(&'static str, Value, Instant)>(EVENTS_MAX);
    let mut listeners = JoinSet::new();
    for key in KEYS {
        if let Err(error) = listen(&session, key, events.clone(), &mut listeners).await {
            tracing::debug!(key, %error, "an event cannot be heard");
        }
    }
    let (mut angles, mut all) =
        (tokio::time::interval(Duration::from_millis(ANGLES_MS)), tokio::time::interval(Duration::from_millis(ALL_MS)));
    angles.set_missed_tick_behavior(MissedTickBehavior::Delay);
    all.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        tokio::select! {
            event = heard.recv() => match event {
                Some((key, value, _)) => note(&shared, key, &value),
                None => return,
            },
            _ = all.tick() => ask(&session, &shared).await,
            _ = angles.tick() => read_angles(&session, &shared).await,
        }
    }
}

/// Asks everything once.
pub(crate) async fn ask(session: &Session, shared: &NaoShared) {
    let questions = [
        ("BatteryChargeChanged", ServiceCall::new("ALBattery", "getBatteryCharge", [])),
        ("AutonomousLife/State", ServiceCall::new("ALAutonomousLife", "getState", [])),
        ("robotIsWakeUp", ServiceCall::new("ALMotion", "robotIsWakeUp", [])),
        ("PostureFamilyChanged", ServiceCall::new("ALRobotPosture", "getPostureFamily", [])),
        ("stiffness", ServiceCall::new("ALMotion", "getStiffnesses", [Value::dynamic("Body")])),
        ("base", ServiceCall::new("ALMotion", "getRobotPosition", [true.into()])),
        // What is too hot stays so, whether or not the event was heard.
        ("HotDeviceDetected", ServiceCall::new("ALMemory", "getData", ["HotDeviceDetected".into()])),
        ("BatteryPowerPluggedChanged", ServiceCall::new("ALMemory", "getData", ["BatteryPowerPluggedChanged".into()])),
        ("footContactChanged", ServiceCall::new("ALMemory", "getData", ["footContact".into()])),
    ];
    for (key, question) in questions {
        if let Some(value) = try_call(session, &question).await {
            note(shared, key, &value);
        }
    }
}

async fn read_angles(session: &Session, shared: &NaoShared) {
    let Some(value) =
        try_call(session, &ServiceCall::new("ALMotion", "getAngles", [Value::dynamic("Body"), true.into()])).await
    else {
        return;
    };
    let angles: Vec<f64> = value.items().unwrap_or_default().iter().filter_map(Value::as_f64).collect();
    let mut state = shared.state();
    let joints = state.joints.clone();
    if angles.len() == joints.len() {
        state.angles = joints.into_iter().zip(angles).filter(|(_, angle)| angle.is_finite()).collect();
    }
}

fn truth(value: &Value) -> Option<bool> {
    value.as_bool().or_else(|| value.as_f64().map(|number| number != 0.0))
}

/// Notes what an event or an answer says; what is not as expected says nothing.
fn note(shared: &NaoShared, key: &str, value: &Value) {
    let why = {
        let mut state = shared.state();
        let said = said(&mut state, key, value);
        // Whatever else is wrong with the link, its own watch says so.
        if said.is_some() && state.health == Health::Safe {
            state.health = Health::Ready;
        }
        said
    };
    if let Some(why) = why {
        shared.halt(why);
    }
}

/// Why everything has to end, if it has.
fn said(state: &mut NaoState, key: &str, value: &Value) -> Option<Phrase> {
    let condition = &mut state.condition;
    match key {
        "ALMotion/RobotIsFalling" => truth(value).unwrap_or(true).then(|| {
            state.falling = Some(Instant::now());
            phrase!("nao.it_falls", "it falls")
        }),
        "robotHasFallen" => {
            let fallen = truth(value)?;
            condition.fallen = Some(fallen);
            fallen.then(|| phrase!("nao.it_fell", "it fell"))
        }
        "HotDeviceDetected" => {
            let hot = value.items()?.iter().filter_map(|joint| Some(joint.as_text()?.into_owned()));
            condition.hot = hot.take(64).collect();
            let first = condition.hot.first()?;
            Some(phrase!("nao.its_is_too_hot", "its {first} is too hot"))
        }
        "BatteryChargeChanged" => {
            let percent = u8::try_from(value.as_i64()?).ok().filter(|percent| *percent <= 100)?;
            condition.battery = Some(percent);
            empty(condition)
        }
        "BatteryPowerPluggedChanged" => {
            condition.plugged = truth(value);
            None
        }
        "BatteryNearlyEmpty" => (truth(value)? && condition.plugged != Some(true)).then(battery_empty),
        "AutonomousLife/State" => {
            let life = match value.as_text()?.as_ref() {
                "disabled" => Life::Disabled,
                "safeguard" => Life::Safeguard,
                "solitary" => Life::Solitary,
                "interactive" => Life::Interactive,
                _ => return None,
            };
            condition.life = Some(life);
            (life == Life::Safeguard).then(|| phrase!("nao.it_protects_itself", "it protects itself"))
        }
        "PostureFamilyChanged" => {
            let family = value.as_text()?.into_owned();
            if family == "Standing" {
                condition.fallen = Some(false);
            }
            state.posture = family;
            None
        }
        "ALMotion/RobotIsStand" => {
            if truth(value)? {
                condition.fallen = Some(false);
            }
            None
        }
        "footContactChanged" => {
            state.on_ground = truth(value).or(state.on_ground);
            None
        }
        "robotIsWakeUp" => {
            condition.awake = truth(value);
            None
        }
        "stiffness" => {
            let all: Vec<f64> = value.items()?.iter().filter_map(Value::as_f64).collect();
            let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
            condition.stiff = Some(mean > STIFF_MIN);
            if all.len() == state.joints.len() {
                let legs = state.joints.iter().zip(&all).filter(|(joint, _)| is_leg(joint));
                let least = legs.map(|(_, stiffness)| *stiffness).reduce(f64::min);
                state.stiff_legs = least.map(|least| least >= LEG_STIFF_MIN);
            }
            None
        }
        "base" => {
            let parts: Vec<f64> = value.items()?.iter().filter_map(Value::as_f64).collect();
            let [x, y, heading] = parts[..] else { return None };
            state.base = [x, y, heading];
            None
        }
        _ => None,
    }
}

fn battery_empty() -> Phrase {
    phrase!("nao.its_battery_is_empty", "its battery is empty")
}

fn empty(condition: &robot::Condition) -> Option<Phrase> {
    let low = condition.battery.is_some_and(|percent| percent <= EMPTY_PERCENT);
    (low && condition.plugged != Some(true)).then(battery_empty)
}

#[cfg(test)]
mod tests {
    use super::said;
    use crate::shared::NaoState;
    use qi::Value;
    use robot::Life;

    #[test]
    fn what_endangers_the_robot_halts_and_odd_values_say_nothing() {
        let mut state = NaoState::default();
        let mut hear = |key: &str, value: Value| said(&mut state, key, &value);
        assert_eq!(hear("robotHasFallen", Value::F32(1.0)), Some("it fell".into()));
        assert_eq!(hear("AutonomousLife/State", "safeguard".into()), Some("it protects itself".into()));
        assert_eq!(hear("AutonomousLife/State", "solitary".into()), None);
        assert_eq!(hear("BatteryChargeChanged", Value::I32(80)), None);
        assert_eq!(hear("BatteryChargeChanged", Value::I32(4)), Some("its battery is empty".into()));
        assert_eq!(hear("BatteryPowerPluggedChanged", Value::Bool(true)), None);
        assert_eq!(hear("BatteryChargeChanged", Value::I32(4)), None, "it charges");
        for odd in [Value::Unit, Value::I32(-7), Value::List(vec![Value::Unit]), Value::Str(vec![0xff])] {
            for key in super::KEYS.into_iter().chain(["stiffness", "base"]) {
                let _never_panics = hear(key, odd.clone());
            }
        }
        assert_eq!(state.condition.life, Some(Life::Solitary));
    }
}
