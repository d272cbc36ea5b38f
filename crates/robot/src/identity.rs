//! Which body a robot is, whatever its address: addresses are given out anew, and names can be the same.

use serde::{Deserialize, Serialize};

/// The last characters of a number by which people tell two bodies apart.
const TAIL_CHARS: usize = 4;

/// A body and its head. What is not known is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Identity {
    /// The name that the robot gives itself; people can change it, and several may have the same.
    pub name: String,
    /// The kind of the robot: "NAO", "NAO without hands (H21)", "Pepper".
    pub body: String,
    /// The number of its body, which is printed on it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub serial: String,
    /// The number of the computer in its head.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub head: String,
}

/// A body that answers in the place of another one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Stranger {
    /// The identity that was expected.
    pub expected: Identity,
    /// The identity of the robot that answers.
    pub found: Identity,
}

impl Identity {
    /// True if both are one robot: no number that is known of both differs. Where no number is known of both, name and
    /// kind have to be the same.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        let differ = |one: &str, other: &str| !one.is_empty() && !other.is_empty() && one != other;
        let agree = |one: &str, other: &str| !one.is_empty() && one == other;
        if differ(&self.serial, &other.serial) || differ(&self.head, &other.head) {
            return false;
        }
        let same_kind = !differ(&self.body, &other.body);
        agree(&self.serial, &other.serial) || (same_kind && (agree(&self.head, &other.head) || self.name == other.name))
    }

    /// True if it has a number, so that another robot can be told from it.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        !self.serial.is_empty() || !self.head.is_empty()
    }

    /// Returns what is known now, with what was known before where that says nothing.
    #[must_use]
    pub fn or(self, before: &Self) -> Self {
        let known = |now: String, before: &String| if now.is_empty() { before.clone() } else { now };
        Self {
            name: known(self.name, &before.name),
            body: known(self.body, &before.body),
            serial: known(self.serial, &before.serial),
            head: known(self.head, &before.head),
        }
    }

    /// The end of its number, by which people tell it from one with the same name: "0344"; empty if it has none.
    #[must_use]
    pub fn tail(&self) -> String {
        let number = if self.serial.is_empty() { &self.head } else { &self.serial };
        let skipped = number.chars().count().saturating_sub(TAIL_CHARS);
        number.chars().skip(skipped).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Identity;

    fn body(name: &str, serial: &str, head: &str) -> Identity {
        Identity { name: name.into(), body: "NAO".into(), serial: serial.into(), head: head.into() }
    }

    #[test]
    fn a_number_tells_more_than_a_name() {
        let known = body("Momo", "ALDR1", "h1");
        assert!(known.is_same(&body("Renamed", "ALDR1", "h1")));
        assert!(!known.is_same(&body("Momo", "ALDR2", "h2")), "two with the same name");
        assert!(!known.is_same(&body("Momo", "ALDR2", "h1")), "another body under the head");
        assert!(!known.is_same(&body("Momo", "ALDR1", "h2")), "another head on the body");
        assert!(known.is_same(&body("Momo", "", "h1")) && known.is_same(&body("Momo", "ALDR1", "")));
        let pepper = Identity { body: "Pepper".into(), ..body("Momo", "", "h1") };
        assert!(!known.is_same(&pepper));
    }

    #[test]
    fn without_numbers_the_name_counts() {
        let known = body("Momo", "", "");
        assert!(known.is_same(&body("Momo", "ALDR1", "")) && !known.is_same(&body("Pico", "", "")));
        assert!(!known.is_proven() && body("", "", "h").is_proven());
        assert_eq!(body("Pico", "ALDR1", "").or(&body("Momo", "", "h")), body("Pico", "ALDR1", "h"));
    }

    #[test]
    fn the_end_of_a_number_is_short() {
        assert_eq!(body("", "ALDR1312N090344", "h").tail(), "0344");
        assert_eq!((body("", "", "ab").tail().as_str(), body("", "", "").tail().as_str()), ("ab", ""));
    }
}
