//! The inventory of the robot: what is installed on it, how many faces it remembers, and how it is in the network. It
//! is asked at first and now and then, as people change it meanwhile.

use crate::deed::ServiceCall;
use crate::link::try_call;
use crate::shared::NaoShared;
use qi::{Session, Value};
use robot::{FACES_MAX, Installed, Network};
use std::sync::Arc;
use std::time::Duration;

/// The pause before it is looked again.
const AGAIN: Duration = Duration::from_secs(10);
/// Most sets of sounds that are looked into.
const SETS_MAX: usize = 8;
/// Most groups of lights.
const LIGHTS_MAX: usize = 200;
/// The longest name of a face that is told, in characters.
const FACE_MAX_CHARS: usize = 100;
/// The beginning of the names of gestures, among the behaviours.
const GESTURE: &str = "animations/";

/// Looks for as long as the link lasts, and at once when somebody rings.
pub(crate) async fn keep(session: Session, shared: Arc<NaoShared>) {
    loop {
        let installed = Arc::new(installed(&session).await);
        let lights = names(&session, ServiceCall::new("ALLeds", "listGroups", [])).await;
        {
            let mut state = shared.state();
            state.installed = installed;
            state.lights = lights.into_iter().take(LIGHTS_MAX).collect();
        }
        ask(&session, &shared).await;
        tokio::select! {
            () = tokio::time::sleep(AGAIN) => {}
            () = shared.looking.notified() => {}
        }
    }
}

async fn names(session: &Session, wanted: ServiceCall) -> Vec<String> {
    let value = try_call(session, &wanted).await;
    let items = value.as_ref().and_then(Value::items).unwrap_or_default();
    items.iter().filter_map(|name| Some(name.as_text()?.into_owned())).collect()
}

async fn installed(session: &Session) -> Installed {
    let all = names(session, ServiceCall::new("ALBehaviorManager", "getInstalledBehaviors", [])).await;
    // What begins with a dot is what Choregraphe tried last.
    let shown = all.into_iter().filter(|name| !name.starts_with('.'));
    let (gestures, behaviors) = shown.partition(|name| name.starts_with(GESTURE));
    let mut sounds = Vec::new();
    let sets = names(session, ServiceCall::new("ALAudioPlayer", "getInstalledSoundSetsList", [])).await;
    for set in sets.into_iter().take(SETS_MAX) {
        let files =
            names(session, ServiceCall::new("ALAudioPlayer", "getSoundSetFileNames", [set.as_str().into()])).await;
        sounds.extend(files.into_iter().map(|file| format!("{set}/{file}")));
    }
    let languages = names(session, ServiceCall::new("ALTextToSpeech", "getAvailableLanguages", [])).await;
    Installed::bounded([behaviors, gestures, sounds, languages])
}

async fn ask(session: &Session, shared: &NaoShared) {
    let faces = try_call(session, &ServiceCall::new("ALFaceDetection", "getLearnedFacesList", [])).await;
    let faces = faces.as_ref().and_then(Value::items);
    let names = faces.unwrap_or_default().iter().filter_map(|name| Some(name.as_text()?.into_owned()));
    let names: Vec<String> = names.filter(|name| (1..=FACE_MAX_CHARS).contains(&name.chars().count())).collect();
    let faces = faces.and_then(|faces| u16::try_from(faces.len()).ok());
    let services = try_call(session, &ServiceCall::new("ALConnectionManager", "services", [])).await;
    let mut state = shared.state();
    state.faces = names.into_iter().take(FACES_MAX).collect();
    state.condition.faces = faces;
    state.condition.network = services.as_ref().and_then(network);
}

/// `[[["Type", "wifi"], ["State", "online"], ["Strength", 86], ...], ...]`: how it is in the network, by the best of those
/// that are in use. What is not as expected says nothing.
fn network(services: &Value) -> Option<Network> {
    let field = |service: &Value, name: &str| {
        let rows = service.items()?.iter();
        let row =
            rows.filter_map(Value::items).find(|row| row.first().and_then(Value::as_text).as_deref() == Some(name));
        row?.get(1).cloned()
    };
    let text = |service: &Value, name: &str| Some(field(service, name)?.as_text()?.into_owned());
    let in_use = |service: &&Value| matches!(text(service, "State").as_deref(), Some("online" | "ready"));
    let used = services.items()?.iter().filter(in_use);
    let known = used.filter_map(|service| match text(service, "Type")?.as_str() {
        "ethernet" => Some(Network::Cable),
        "wifi" => {
            let strength = field(service, "Strength")?.as_i64()?;
            Some(Network::Wifi(u8::try_from(strength).ok().filter(|percent| *percent <= 100)?))
        }
        _ => None,
    });
    known.max_by_key(|network| match network {
        Network::Cable => 101,
        Network::Wifi(percent) => *percent,
    })
}

#[cfg(test)]
mod tests {
    use super::network;
    use qi::Value;
    use robot::Network;

    fn service(kind: &str, state: &str, strength: i32) -> Value {
        let row = |name: &str, value: Value| Value::List(vec![name.into(), value]);
        Value::List(vec![row("Strength", Value::I32(strength)), row("Type", kind.into()), row("State", state.into())])
    }

    #[test]
    fn what_is_in_use_counts_and_odd_values_say_nothing() {
        let of = |services: Vec<Value>| network(&Value::List(services));
        assert_eq!(of(vec![service("wifi", "idle", 90), service("wifi", "online", 40)]), Some(Network::Wifi(40)));
        assert_eq!(of(vec![service("wifi", "online", 40), service("ethernet", "ready", 0)]), Some(Network::Cable));
        assert_eq!(of(vec![service("wifi", "online", 300), service("tether", "online", 1)]), None);
        assert_eq!([of(vec![]), of(vec![Value::Unit]), network(&Value::Unit)], [None; 3]);
    }
}
