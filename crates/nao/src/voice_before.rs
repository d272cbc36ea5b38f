//! The manner in which a robot spoke before somebody changed its voice.

use qi::Value;

/// The speed of a voice that nobody changed, in percent.
pub(crate) const USUAL_SPEED: f32 = 100.0;

/// The manner in which the robot spoke before.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct VoiceBefore {
    pub(crate) volume: Option<f32>,
    pub(crate) speed: Option<f32>,
    /// Only if it was changed.
    pub(crate) language: Option<String>,
}

impl VoiceBefore {
    /// Returns the value in the form in which the robot keeps it.
    pub(crate) fn value(&self) -> Value {
        let number = |number: Option<f32>| number.map_or_else(|| "".into(), Value::F32);
        let language = self.language.as_deref().unwrap_or_default();
        let parts = [number(self.volume), number(self.speed), language.into()];
        Value::List(parts.into_iter().map(Value::dynamic).collect())
    }

    /// Reads what the robot kept; what is odd there says nothing.
    pub(crate) fn of(value: &Value) -> Self {
        let part = |at: usize| value.items()?.get(at);
        let number = |at| part(at)?.as_f64().map(|number| number as f32);
        let language = part(2).and_then(Value::as_text).filter(|language| !language.is_empty());
        Self { volume: number(0), speed: number(1), language: language.map(|language| language.into_owned()) }
    }
}

#[cfg(test)]
mod tests {
    use super::VoiceBefore;
    use qi::Value;

    #[test]
    fn what_the_robot_keeps_of_a_voice_is_what_it_was() {
        let before = VoiceBefore { volume: Some(0.5), speed: Some(90.0), language: Some("French".to_owned()) };
        assert_eq!(VoiceBefore::of(&before.value()), before);
        assert_eq!(VoiceBefore::of(&VoiceBefore::default().value()), VoiceBefore::default());
        for odd in [Value::Unit, "French".into(), Value::List(vec![Value::Unit])] {
            assert_eq!(VoiceBefore::of(&odd), VoiceBefore::default());
        }
    }
}
