//! What an exercise shall become, as data: readings in logical time, and what actions are told meanwhile.

use behaviour::{Params, Value};
use phrase::Phrase;
use robot::Millis;
use serde::Deserialize;
use std::collections::HashMap;

/// A part counts from so long after it began, so that what samples or waits has settled, in milliseconds.
const SETTLE_MS: u64 = 1_000;

/// The goal of an exercise.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct ExerciseGoal {
    /// What shall be reached, in a sentence.
    pub(crate) says: Phrase,
    /// What was reached, in a sentence.
    pub(crate) reached: Phrase,
    /// What is sensed, one part after the other.
    pub(crate) trace: Vec<SensePart>,
    /// What shall come of it; the first that does not is told.
    pub(crate) expects: Vec<Expectation>,
    /// What one is asked about it; where there is something, the behaviour is explained and not changed.
    #[serde(default)]
    pub(crate) asks: Vec<GoalQuestion>,
}

/// A question about what the behaviour will do.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct GoalQuestion {
    /// In a sentence.
    pub(crate) ask: Phrase,
    /// What can be answered.
    pub(crate) answers: Vec<Phrase>,
    /// Which of the answers is true, counted from 0.
    pub(crate) right: u8,
    /// What is said to another answer, in a sentence that helps to find it.
    pub(crate) otherwise: Phrase,
}

/// A sense that reads something for a while.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct SensePart {
    /// What expectations call it; parts of one name are all meant.
    pub(crate) name: String,
    /// The sense, by its name in the catalogue.
    pub(crate) sense: String,
    /// What has to be chosen for it.
    #[serde(default)]
    pub(crate) params: Params,
    /// What it reads, in turn.
    pub(crate) values: Vec<Value>,
    /// How often.
    pub(crate) every_ms: u64,
    /// For how long.
    pub(crate) for_ms: u64,
}

/// What an action shall be told during a part.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct Expectation {
    /// During which parts.
    pub(crate) during: String,
    /// The action, by its name in the catalogue.
    pub(crate) action: String,
    /// What may be chosen for it; what is not named may be anything.
    #[serde(default)]
    pub(crate) with: HashMap<String, Vec<Value>>,
    /// What it shall be told.
    pub(crate) is: WantedAction,
    /// What is said where it is not so, in a sentence.
    pub(crate) otherwise: Phrase,
}

/// What an action shall be told.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) enum WantedAction {
    /// Something, in each of the parts.
    Told,
    /// Nothing.
    NotTold,
    /// Only numbers that are at least so large, and some.
    AtLeast(f64),
    /// Only numbers that are at most so large, and some.
    AtMost(f64),
    /// Something, at least and at most so often in each of the parts.
    Times(usize, usize),
}

/// An action of a behaviour, and what it was told.
#[derive(Debug)]
pub(super) struct ToldAction {
    pub(super) device: String,
    /// What is chosen for it, with what is chosen where nobody did.
    pub(super) params: Params,
    pub(super) told: Vec<(Millis, Value)>,
}

impl ExerciseGoal {
    /// Gives every text its key, by the name of the exercise and where it stands.
    pub(super) fn keyed(mut self, exercise: &str) -> Self {
        let name = |text: &mut Phrase, place: String| {
            *text = Phrase::named(format!("exercise.{exercise}.{place}"), text.to_string());
        };
        name(&mut self.says, "goal".to_owned());
        name(&mut self.reached, "reached".to_owned());
        for (nth, expected) in self.expects.iter_mut().enumerate() {
            name(&mut expected.otherwise, format!("expects{nth}"));
        }
        for (nth, asked) in self.asks.iter_mut().enumerate() {
            name(&mut asked.ask, format!("asks{nth}"));
            name(&mut asked.otherwise, format!("asks{nth}.otherwise"));
            for (which, answer) in asked.answers.iter_mut().enumerate() {
                name(answer, format!("asks{nth}.answer{which}"));
            }
        }
        self
    }

    /// The readings in order of time: which part, when, and what.
    pub(super) fn readings(&self) -> Vec<(&SensePart, Millis, Value)> {
        self.trace.iter().zip(self.begins()).flat_map(|(part, begin)| of_part(part, begin)).collect()
    }

    /// When it is over.
    pub(super) fn ends(&self) -> Millis {
        Millis(self.trace.iter().map(|part| part.for_ms).sum())
    }

    fn begins(&self) -> impl Iterator<Item = u64> {
        self.trace.iter().scan(0, |next, part| {
            let begin = *next;
            *next += part.for_ms;
            Some(begin)
        })
    }

    /// What is said to the first answer that is not right.
    pub(super) fn wrong(&self, answers: &[u8]) -> Option<&Phrase> {
        let given = answers.iter().map(Some).chain(std::iter::repeat(None));
        let is_wrong = |(question, given): &(&GoalQuestion, Option<&u8>)| *given != Some(&question.right);
        self.asks.iter().zip(given).find(is_wrong).map(|(question, _)| &question.otherwise)
    }

    /// What is said of the first expectation that is not met.
    pub(super) fn missed(&self, actions: &[ToldAction]) -> Option<&Phrase> {
        let windows = |name: &str| -> Vec<(u64, u64)> {
            let named = self.trace.iter().zip(self.begins()).filter(|(part, _)| part.name == name);
            named.map(|(part, begin)| (begin + SETTLE_MS.min(part.for_ms), begin + part.for_ms)).collect()
        };
        let is_met = |one: &Expectation| windows(&one.during).into_iter().all(|window| one.is_met(actions, window));
        self.expects.iter().find(|one| !is_met(one)).map(|one| &one.otherwise)
    }
}

fn of_part(part: &SensePart, begin: u64) -> impl Iterator<Item = (&SensePart, Millis, Value)> {
    let times = (begin..begin + part.for_ms).step_by(usize::try_from(part.every_ms.max(1)).unwrap_or(usize::MAX));
    times.zip(part.values.iter().cycle()).map(move |(at, value)| (part, Millis(at), stamped(value, at)))
}

/// A reading that says when it was read says so truly.
fn stamped(value: &Value, at: u64) -> Value {
    let Value::Map(fields) = value else { return value.clone() };
    let now = Value::Int(i64::try_from(at).unwrap_or(i64::MAX));
    let stamp = |name: &str, value: &Value| if name == "time" { now.clone() } else { value.clone() };
    Value::object(fields.iter().map(|(name, value)| (&**name, stamp(name, value))))
}

impl Expectation {
    fn is_met(&self, actions: &[ToldAction], (from, until): (u64, u64)) -> bool {
        let during = |told: &&(Millis, Value)| (from..until).contains(&told.0.0);
        let meant = actions.iter().filter(|action| self.means(action));
        let told: Vec<&Value> = meant.flat_map(|action| &action.told).filter(during).map(|(_, value)| value).collect();
        let all = |is_so: &dyn Fn(f64) -> bool| {
            !told.is_empty() && told.iter().all(|value| value.as_number().is_some_and(is_so))
        };
        match self.is {
            WantedAction::Told => !told.is_empty(),
            WantedAction::NotTold => told.is_empty(),
            WantedAction::Times(least, most) => (least..=most).contains(&told.len()),
            WantedAction::AtLeast(least) => all(&|number| number >= least),
            WantedAction::AtMost(most) => all(&|number| number <= most),
        }
    }

    fn means(&self, action: &ToldAction) -> bool {
        let may_be = |(name, values): (&String, &Vec<Value>)| {
            action.params.get(name).is_some_and(|chosen| values.contains(chosen))
        };
        action.device == self.action && self.with.iter().all(may_be)
    }
}
