//! A device in words: what `rrp devices` and the page of the catalogue say about it.

use crate::{Device, Param, ParamKind};
use behaviour::StreamKind;

impl Device {
    /// Returns a word for the kind of device: sense or action.
    #[must_use]
    pub fn kind_word(&self) -> &'static str {
        if self.kind == StreamKind::Sensor { "sense" } else { "action" }
    }

    /// Returns what it gives or takes: "a number in m"; for an object its fields, comma by comma.
    #[must_use]
    pub fn value_words(&self) -> String {
        let shape = self.shape.usual();
        if shape.fields().is_empty() {
            return shape.value_type().to_string();
        }
        shape.fields().iter().map(|field| field.name).collect::<Vec<_>>().join(", ")
    }
}

impl Param {
    /// Returns the values that it may have: "from 0 to 1, else 0.4"; the first choice counts when nobody chose.
    #[must_use]
    pub fn range_words(&self) -> String {
        match self.kind {
            ParamKind::Choice(options) => options.iter().map(|option| option.1).collect::<Vec<_>>().join(", "),
            ParamKind::Number { min, max, unit, default, .. } => {
                let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
                format!("from {min} to {max}{unit}, else {default}")
            }
            ParamKind::Text { max_chars, default: "", .. } => format!("a text of at most {max_chars} characters"),
            ParamKind::Text { max_chars, default, .. } => {
                format!("a text of at most {max_chars} characters, else “{default}”")
            }
        }
    }
}

/// The catalogue as plain text: a line each, its name first, senses before actions.
#[must_use]
pub fn catalogue_lines() -> Vec<String> {
    let all = || crate::sensors().chain(crate::actuators());
    let width = all().map(|device| device.name.len()).max().unwrap_or_default();
    let line = |device: &Device| {
        let (name, kind) = (device.name, device.kind_word());
        format!("{name:width$}  {kind:6}  {}  Value: {}.", device.says, device.value_words())
    };
    all().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::catalogue_lines;
    use crate::{actuators, sensors};

    #[test]
    fn every_device_has_a_line_that_begins_with_its_name() {
        let lines = catalogue_lines();
        assert_eq!(lines.len(), sensors().chain(actuators()).count());
        for (device, line) in sensors().chain(actuators()).zip(&lines) {
            assert!(line.starts_with(&format!("{} ", device.name)) && line.contains(device.says), "{line}");
        }
        assert!(lines.iter().any(|line| line.starts_with("Sonar") && line.ends_with("Value: a number in m.")));
    }

    #[test]
    fn parameters_say_what_they_may_be() {
        let said = |device: &str, param: &str| {
            let device = sensors().chain(actuators()).find(|known| known.name == device).unwrap();
            device.params.iter().find(|known| known.name == param).unwrap().range_words()
        };
        assert_eq!(said("Blob", "color"), "red, green, blue");
        assert_eq!(said("Walk", "speed"), "from 0.01 to 0.1 m/s, else 0.05");
        assert_eq!(said("SayParameter", "text"), "a text of at most 1000 characters, else “Hello”");
        assert_eq!(said("Sound", "file"), "a text of at most 200 characters");
    }
}
