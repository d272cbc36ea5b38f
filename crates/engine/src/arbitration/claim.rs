//! The claim of an actuator stream when it commands: live and replayed, from its file alone.

use behaviour::FileStream;

/// For how long a command holds its parts, in milliseconds, if nothing else is said.
const HOLD_MS: u64 = 1_000;

/// The claim of a stream when it commands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The parts of the robot.
    pub resources: Vec<String>,
    /// Higher wins.
    pub priority: i64,
    /// The time for which a command holds, in milliseconds.
    pub hold_ms: u64,
}

impl Claim {
    /// The claim of a stream, with the defaults for what it leaves out.
    #[must_use]
    pub fn of(stream: &FileStream) -> Self {
        Self {
            resources: stream.resources.clone().unwrap_or_else(|| parts(stream)),
            priority: stream.priority.unwrap_or(0),
            hold_ms: stream.hold_ms.unwrap_or(HOLD_MS),
        }
    }
}

/// The parts that the catalogue says the device uses; one that it does not know is a part of its own.
fn parts(stream: &FileStream) -> Vec<String> {
    let Some(name) = &stream.device else { return Vec::new() };
    let parts = |device: &robot::Device| device.parts(&stream.params.clone().unwrap_or_default());
    match robot::device(stream.kind, name) {
        Ok(device) => parts(device).into_iter().map(|part| part.word().to_owned()).collect(),
        Err(_) => vec![name.clone()],
    }
}

#[cfg(test)]
mod tests {
    use super::Claim;

    fn resources(stream: &serde_json::Value) -> Vec<String> {
        Claim::of(&serde_json::from_value(stream.clone()).unwrap()).resources
    }

    #[test]
    fn a_stream_claims_what_it_says_else_what_the_catalogue_says_else_its_device() {
        let mut stream = serde_json::json!({"id": "a", "kind": "actuator", "name": "A"});
        assert!(resources(&stream).is_empty());
        stream["device"] = "Lamp".into();
        assert_eq!(resources(&stream), ["Lamp"]);
        stream["device"] = "Tracker".into();
        assert_eq!(resources(&stream), ["head"]);
        stream["params"] = serde_json::json!({"mode": "Arm", "effector": "LArm"});
        assert_eq!(resources(&stream), ["left arm"]);
        stream["resources"] = serde_json::json!(["voice"]);
        assert_eq!(resources(&stream), ["voice"]);
    }
}
