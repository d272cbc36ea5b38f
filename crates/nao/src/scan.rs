//! Scans what the robot at the other end has: its services, its body, and what an ended server left behind on it.

use crate::body::joint_words;
use crate::deed::ServiceCall;
use crate::devices::ALL;
use crate::link::{CALL, call, try_call};
use crate::settings::RobotSettings;
use crate::shared::{NaoShared, NaoState};
use futures_util::future::join_all;
use phrase::{Phrase, phrase};
use qi::{QiError, Session, Value};
use robot::Lacking;
use std::collections::BTreeSet;

/// The services that only measure for those who subscribe.
const EXTRACTORS: [&str; 8] = [
    "ALRedBallDetection",
    "ALColorBlobDetection",
    "ALFaceDetection",
    "ALLandMarkDetection",
    "ALPeoplePerception",
    "ALSpeechRecognition",
    "ALSonar",
    "ALSoundLocalization",
];
/// The words about a robot without a tablet.
fn no_tablet() -> Phrase {
    phrase!("nao.no_tablet", "it has no tablet; a Pepper has one")
}
/// The word of `getRobotType` and the model for a Pepper.
const PEPPER: &str = "Juliette";

/// The findings of a look at a robot.
pub(crate) struct Scanned {
    pub(crate) name: String,
    pub(crate) version: String,
    pub(crate) is_pepper: bool,
    pub(crate) joints: Vec<String>,
    limits: Vec<(f64, f64)>,
    pub(crate) devices: Vec<&'static str>,
    pub(crate) lacking: Vec<Lacking>,
}

/// Looks.
///
/// # Errors
/// If the robot does not tell its services, or its body.
pub(crate) async fn scan(session: &Session) -> Result<Scanned, QiError> {
    let services: BTreeSet<String> = session.services().await?.into_iter().map(|service| service.name).collect();
    let text = async |service: &'static str, method: &'static str| {
        let value = try_call(session, &ServiceCall::new(service, method, [])).await;
        value.and_then(|value| value.as_text().map(|text| text.into_owned())).unwrap_or_default()
    };
    let (name, version) = (text("ALSystem", "robotName").await, text("ALSystem", "systemVersion").await);
    let joints = call(session, &ServiceCall::new("ALMotion", "getBodyNames", ["Body".into()]), CALL).await?;
    let joints: Vec<String> =
        joints.items().unwrap_or_default().iter().filter_map(|name| Some(name.as_text()?.into_owned())).collect();
    let limits = try_call(session, &ServiceCall::new("ALMotion", "getLimits", ["Body".into()])).await;
    let limits = limits.map(|limits| limits_of(&limits)).unwrap_or_default();
    let config =
        if services.contains("ALRobotModel") { text("ALRobotModel", "getRobotType").await } else { String::new() };
    // A Pepper stands on wheels.
    let is_pepper = config == PEPPER || joints.iter().any(|joint| joint == "KneePitch" || joint == "WheelB");
    let (devices, lacking) = has(&services, &joints);
    Ok(Scanned { name, version, is_pepper, joints, limits, devices, lacking })
}

/// `[[lowest, highest, speed, torque], ...]` in the order of the body.
fn limits_of(value: &Value) -> Vec<(f64, f64)> {
    let pair = |row: &Value| {
        let row = row.items()?;
        Some((row.first()?.as_f64()?, row.get(1)?.as_f64()?))
    };
    value.items().unwrap_or_default().iter().map_while(pair).collect()
}

fn has(services: &BTreeSet<String>, joints: &[String]) -> (Vec<&'static str>, Vec<Lacking>) {
    let (mut devices, mut lacking) = (Vec::new(), Vec::new());
    // In the order of the catalogue.
    for known in robot::sensors().chain(robot::actuators()) {
        let Some(driver) = ALL.iter().find(|driver| driver.name == known.name) else { continue };
        let service = driver.services.iter().find(|service| !services.contains(**service));
        let joint = driver.joints.iter().find(|joint| !joints.iter().any(|there| there == *joint));
        match (service, joint) {
            (None, None) => devices.push(driver.name),
            (Some(&"ALTabletService"), _) => lacking.push(lack(driver.name, no_tablet())),
            (Some(service), _) => {
                lacking.push(lack(driver.name, phrase!("nao.its_is_not_there", "its {service} is not there")))
            }
            (None, Some(joint)) => lacking.push(lack(
                driver.name,
                phrase!("nao.its_body_has_no", "its body has no {joint}", joint = joint_words(joint)),
            )),
        }
    }
    (devices, lacking)
}

fn lack(device: &str, why: Phrase) -> Lacking {
    Lacking { device: device.to_owned(), why }
}

impl Scanned {
    /// "NAO, NAOqi 2.8.7".
    pub(crate) fn model(&self) -> String {
        let kind = if self.is_pepper { "Pepper" } else { "NAO" };
        if self.version.is_empty() { kind.to_owned() } else { format!("{kind}, NAOqi {}", self.version) }
    }

    pub(crate) fn note(&self, state: &mut NaoState) {
        state.is_pepper = self.is_pepper;
        state.devices.clone_from(&self.devices);
        state.lacking.clone_from(&self.lacking);
        state.joints.clone_from(&self.joints);
        for (joint, (lowest, highest)) in self.joints.iter().zip(&self.limits) {
            state.limits.tell(joint, *lowest, *highest);
        }
    }
}

/// Ends the subscriptions that begin with a name of ours, which outlive the process that made them. True if there were some.
pub(crate) async fn clean(session: &Session, settings: &RobotSettings, shared: &NaoShared) -> bool {
    let ours = |name: &str| settings.names().any(|own| name == own || name.starts_with(&format!("{own}/")));
    let clean = EXTRACTORS.iter().map(|service| async move {
        let mut found = false;
        let Ok(object) = session.service(service).await else { return found };
        let Ok(known) = object.call("getSubscribersInfo", &[]).await else { return found };
        for row in known.items().unwrap_or_default() {
            let name = row.items().and_then(|row| row.first()).and_then(Value::as_text);
            if let Some(name) = name.filter(|name| ours(name)) {
                let _ = object.call("unsubscribe", &[name.as_ref().into()]).await;
                found = true;
            }
        }
        found
    });
    let found = join_all(clean).await.contains(&true);
    shared.state().subscribed.take();
    found
}
