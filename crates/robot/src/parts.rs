//! Which parts of the body an action uses, with its parameters.

use crate::{Device, Resource, Resources};
use behaviour::Params;

impl Resource {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Head, Self::LeftArm, Self::RightArm, Self::Legs, Self::Voice, Self::Eyes, Self::Memory];

    /// Returns the name of the part, in files and for people.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::LeftArm => "left arm",
            Self::RightArm => "right arm",
            Self::Legs => "legs",
            Self::Voice => "voice",
            Self::Eyes => "eyes",
            Self::Memory => "memory of faces",
        }
    }
}

impl Device {
    /// The parts of the body that it uses with these parameters.
    #[must_use]
    pub fn parts(&self, params: &Params) -> Vec<Resource> {
        match self.resources {
            Resources::Always(parts) => parts.to_vec(),
            Resources::By(parts) => parts(params),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Resource, actuators, device};
    use behaviour::{Params, StreamKind, Value};

    fn parts(name: &str, params: &[(&str, &str)]) -> Vec<Resource> {
        let params: Params = params.iter().map(|&(name, value)| (name.to_owned(), Value::text(value))).collect();
        device(StreamKind::Actuator, name).unwrap().parts(&params)
    }

    #[test]
    fn a_tracker_uses_what_it_is_told_to_use() {
        assert_eq!(parts("Tracker", &[]), [Resource::Head]);
        let arm = [("mode", "Arm"), ("effector", "Value")];
        assert_eq!(parts("Tracker", &arm), [Resource::LeftArm, Resource::RightArm]);
        let all = [("mode", "Move"), ("effector", "LArm")];
        assert_eq!(parts("Tracker", &all), [Resource::Head, Resource::Legs, Resource::LeftArm]);
        assert_eq!(parts("SetJointPosition", &[("joint", "RHand")]), [Resource::RightArm]);
        assert_eq!(parts("SayInput", &[]), [Resource::Voice]);
    }

    #[test]
    fn parts_have_different_words() {
        let mut words: Vec<_> = actuators().flat_map(|one| one.parts(&Params::new())).map(Resource::word).collect();
        words.sort_unstable();
        words.dedup();
        assert!(words.len() >= 5 && words.iter().all(|word| !word.is_empty()));
    }
}
