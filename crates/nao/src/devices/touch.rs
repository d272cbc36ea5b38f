//! Touch fields and bumpers: 1.0 when touched, 0.0 when let go.

use super::{ChosenParams, NaoDriver, OpenDevice, Sense};
use behaviour::Value;
use std::collections::BTreeSet;

pub(super) const HEAD: NaoDriver = NaoDriver { name: "HeadTouch", services: &["ALMemory"], joints: &[], open: head };
pub(super) const HAND: NaoDriver =
    NaoDriver { name: "HandTouch", services: &["ALMemory"], joints: &["LHand", "RHand"], open: hand };
pub(super) const BUMPER: NaoDriver = NaoDriver { name: "Bumper", services: &["ALMemory"], joints: &[], open: bumper };

struct Touch {
    keys: Vec<&'static str>,
    release: bool,
    /// The keys of the fields that are touched now.
    down: BTreeSet<String>,
}

/// Those of all fields whose names have what was chosen.
fn touch(all: &[(&'static str, &[&str])], wanted: &[&str], chosen: &ChosenParams) -> Option<OpenDevice> {
    let fits = |words: &[&str]| wanted.iter().all(|want| *want == "any" || words.contains(want));
    let keys = all.iter().filter(|(_, words)| fits(words)).map(|(key, _)| *key).collect();
    OpenDevice::sense(Touch { keys, release: chosen.is("release", "yes"), down: BTreeSet::new() })
}

fn head(chosen: &ChosenParams) -> Option<OpenDevice> {
    let all: [(&str, &[&str]); 3] =
        [("FrontTactilTouched", &["front"]), ("MiddleTactilTouched", &["middle"]), ("RearTactilTouched", &["rear"])];
    touch(&all, &[chosen.text("part")?], chosen)
}

fn hand(chosen: &ChosenParams) -> Option<OpenDevice> {
    let all: [(&str, &[&str]); 6] = [
        ("HandLeftBackTouched", &["of left", "back"]),
        ("HandLeftLeftTouched", &["of left", "left"]),
        ("HandLeftRightTouched", &["of left", "right"]),
        ("HandRightBackTouched", &["of right", "back"]),
        ("HandRightLeftTouched", &["of right", "left"]),
        ("HandRightRightTouched", &["of right", "right"]),
    ];
    let hand = match chosen.text("hand")? {
        "left" => "of left",
        "right" => "of right",
        _ => "any",
    };
    touch(&all, &[hand, chosen.text("part")?], chosen)
}

fn bumper(chosen: &ChosenParams) -> Option<OpenDevice> {
    let all: [(&str, &[&str]); 3] =
        [("LeftBumperPressed", &["left"]), ("RightBumperPressed", &["right"]), ("BackBumperPressed", &["back"])];
    touch(&all, &[chosen.text("foot")?], chosen)
}

impl Sense for Touch {
    fn keys(&self) -> Vec<&'static str> {
        self.keys.clone()
    }

    fn read(&mut self, key: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let down = value.as_f64()? > 0.5;
        // Of several fields the first touch counts, and the last that is let go.
        let before = self.down.is_empty();
        let news = if down { self.down.insert(key.to_owned()) } else { self.down.remove(key) };
        let changes = news && before != self.down.is_empty();
        (changes && (down || self.release)).then_some(Value::Bool(down))
    }
}
