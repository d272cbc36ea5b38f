//! The time that a sense tells as soon as it is opened. Where a run goes on after an interruption its senses are opened anew and
//! tell the time that the run knows already: that is no news, and nothing acts for it a second time. Other states, as a battery
//! that is low, are told again: whether the robot did what followed from them before it was interrupted, nobody knows.

use behaviour::{Params, StreamKind, Value};
use engine::{Run, StreamIx};
use std::collections::BTreeMap;

/// The newest time that each of these senses told a run.
#[derive(Clone, Debug, Default)]
pub(super) struct ToldTimes(BTreeMap<StreamIx, TimeSense>);

/// A stream of such a sense.
#[derive(Clone, Debug)]
struct TimeSense {
    id: String,
    device: Option<String>,
    params: Params,
    told: Option<Value>,
}

impl TimeSense {
    fn is_of(&self, other: &Self) -> bool {
        (&self.id, &self.device, &self.params) == (&other.id, &other.device, &other.params)
    }
}

impl ToldTimes {
    /// The senses of a run, which have told nothing yet.
    pub(super) fn of(run: &Run) -> Self {
        let senses = run.streams().enumerate().filter(|(_, info)| {
            let device = info.device.as_deref().filter(|_| info.kind == StreamKind::Sensor);
            device.is_some_and(robot::tells_time)
        });
        let sense = |(index, info): (StreamIx, &engine::StreamInfo)| {
            let (id, device, params) = (info.id.clone(), info.device.clone(), info.params.clone());
            (index, TimeSense { id, device, params, told: None })
        };
        Self(senses.map(sense).collect())
    }

    /// These senses with what they told the run before.
    pub(super) fn since(mut self, before: &Self) -> Self {
        for sense in self.0.values_mut() {
            sense.told = before.0.values().find(|known| known.is_of(sense)).and_then(|known| known.told.clone());
        }
        self
    }

    /// Returns true if what was sensed is another time than before, or no time.
    pub(super) fn is_news(&self, stream: StreamIx, sensed: &Value) -> bool {
        self.0.get(&stream).is_none_or(|sense| sense.told.as_ref() != Some(sensed))
    }

    /// Notes what was told to its end.
    pub(super) fn note(&mut self, stream: StreamIx, told: Value) {
        if let Some(sense) = self.0.get_mut(&stream) {
            sense.told = Some(told);
        }
    }
}
