//! The open senses: when each is due, and what it gives.

use crate::device::Sense;
use crate::follow::digest_use;
use crate::hash::Digest;
use crate::nao::SimulatedNao;
use crate::sight::Sighting;
use behaviour::Value;
use robot::{Millis, Reading, Use};
use std::collections::{BTreeMap, VecDeque};

/// Changes of touch that wait for their step.
const TOUCHES_MAX: usize = 16;

/// An open sense and how often it was due since.
#[derive(Clone, Debug)]
struct Open {
    sense: Sense,
    since: u64,
    count: u64,
}

/// All open senses.
#[derive(Default)]
pub(crate) struct Senses {
    open: BTreeMap<Use, Open>,
    touches: VecDeque<bool>,
}

impl Senses {
    /// Opens a sense; its beat starts now.
    pub(crate) fn open(&mut self, user: &Use, sense: Sense, now: u64) {
        self.open.insert(user.clone(), Open { sense, since: now, count: 0 });
    }

    /// Closes a sense, if it is open.
    pub(crate) fn close(&mut self, user: &Use) {
        self.open.remove(user);
    }

    /// Whether it is open.
    pub(crate) fn has(&self, user: &Use) -> bool {
        self.open.contains_key(user)
    }

    /// How many are open.
    pub(crate) fn len(&self) -> usize {
        self.open.len()
    }

    /// A hand came to the head or left it; told in the next step. Too many changes at once are left out in pairs.
    pub(crate) fn touch(&mut self, down: bool) {
        if self.touches.len() < TOUCHES_MAX {
            self.touches.push_back(down);
        } else {
            self.touches.pop_back();
        }
    }

    /// Adds what is open and waiting.
    pub(crate) fn digest(&self, digest: &mut Digest) {
        digest.count(self.open.len());
        for (user, open) in &self.open {
            digest_use(user, digest);
            digest.text(&format!("{:?}", open.sense));
            digest.whole(open.since);
            digest.whole(open.count);
        }
        digest.count(self.touches.len());
        self.touches.iter().for_each(|down| digest.truth(*down));
    }

    /// The senses whose beat came, with the moment, in the order of their streams.
    fn due(&mut self, now: u64) -> Vec<(Use, Sense, u64, u64)> {
        let mut due = Vec::new();
        for (user, open) in &mut self.open {
            let Some((micros, parts)) = beat(&open.sense) else { continue };
            let at = open.since + (open.count + 1) * micros / parts / 1_000;
            if at <= now {
                open.count += 1;
                due.push((user.clone(), open.sense.clone(), at, open.count));
            }
        }
        due
    }
}

/// The beat of a sense as so many microseconds for so many times; touch has none.
fn beat(sense: &Sense) -> Option<(u64, u64)> {
    match sense {
        Sense::Ball(_) => Some((1_000_000, 30)),
        Sense::Face => Some((1_000_000, 10)),
        Sense::Joint(_) => Some((1_000_000, 20)),
        Sense::Tick(micros) => Some((*micros, 1)),
        Sense::Touch { .. } => None,
    }
}

impl SimulatedNao {
    /// Appends what the senses read in this step, by time and then by stream.
    pub(crate) fn read(&mut self, readings: &mut Vec<Reading>) {
        let first = readings.len();
        self.read_touch(readings);
        for (to, sense, at, count) in self.senses.due(self.now) {
            let at = if matches!(sense, Sense::Tick(_)) { at } else { self.now };
            if let Some(value) = self.sense(&sense, count) {
                readings.push(Reading { to, at: Millis(at), value });
            }
        }
        readings[first..].sort_by(|one, other| (one.at, &one.to).cmp(&(other.at, &other.to)));
    }

    fn read_touch(&mut self, readings: &mut Vec<Reading>) {
        let Some(down) = self.senses.touches.pop_front() else { return };
        let feels = |sense: &Sense| matches!(sense, Sense::Touch { release } if down || *release);
        let feeling = self.senses.open.iter().filter(|(_, open)| feels(&open.sense));
        readings.extend(feeling.map(|(user, _)| Reading {
            to: user.clone(),
            at: Millis(self.now),
            value: Value::Bool(down),
        }));
    }

    /// What a sense gives now. A lost ball or face gives nothing.
    fn sense(&mut self, sense: &Sense, count: u64) -> Option<Value> {
        match sense {
            Sense::Ball(color) => self.see_ball(color).map(|(_, seen)| Value::object(self.place(seen))),
            Sense::Face => self.face(),
            Sense::Joint(motor) => Some(Value::Float(f64::from(self.servo.now[*motor]))),
            Sense::Tick(_) => Some(Value::Int(count.cast_signed())),
            Sense::Touch { .. } => None,
        }
    }

    fn place(&self, seen: Sighting) -> [(&'static str, Value); 4] {
        let angle = |angle: f32| Value::Float(f64::from(angle));
        let time = Value::Int(self.now.cast_signed());
        [("x", angle(seen.x)), ("y", angle(seen.y)), ("size", angle(seen.size)), ("time", time)]
    }

    fn face(&mut self) -> Option<Value> {
        let (person, seen) = self.see_face()?;
        let new = !self.known[person];
        let label = if new { String::new() } else { format!("face {}", person + 1) };
        let words = [
            ("id", Value::Int(person as i64 + 1)),
            ("label", Value::text(label)),
            ("new", Value::Bool(new)),
            ("recognized_new_face", Value::Bool(new && self.is_near(person))),
        ];
        Some(Value::object(words.into_iter().chain(self.place(seen))))
    }
}
