//! The open senses: when each is due, and what it gives.

use crate::hash::{RunningHash, digest_use};
use crate::nao::SimulatedNao;
use crate::nao::devices::{Beat, Sense};
use robot::{Millis, Reading, Use};
use std::collections::BTreeMap;

/// An open sense and how often it was due since.
struct SimulatedOpenSense {
    sense: Box<dyn Sense>,
    since: u64,
    count: u64,
}

/// All open senses.
#[derive(Default)]
pub(crate) struct OpenSenses {
    open: BTreeMap<Use, SimulatedOpenSense>,
}

impl OpenSenses {
    /// Opens a sense; its beat starts now.
    pub(crate) fn open(&mut self, user: &Use, sense: Box<dyn Sense>, now: u64) {
        self.open.insert(user.clone(), SimulatedOpenSense { sense, since: now, count: 0 });
    }

    /// Closes a sense, if it is open.
    pub(crate) fn close(&mut self, user: &Use) {
        self.open.remove(user);
    }

    /// True if the sense of this use is open.
    pub(crate) fn has(&self, user: &Use) -> bool {
        self.open.contains_key(user)
    }

    /// Returns the number of open senses.
    pub(crate) fn len(&self) -> usize {
        self.open.len()
    }

    /// Adds what is open.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.count(self.open.len());
        for (user, open) in &self.open {
            digest_use(user, digest);
            digest.text(&format!("{:?}", open.sense));
            digest.whole(open.since);
            digest.whole(open.count);
        }
    }
}

impl SimulatedOpenSense {
    /// The moment for which it is due, if it is; counts it.
    fn due(&mut self, now: u64) -> Option<u64> {
        let (micros, parts) = match self.sense.beat() {
            Beat::Step => (0, 1),
            Beat::PerSecond(times) => (1_000_000, times),
            Beat::Micros(micros) => (micros, 1),
        };
        let at = self.since + (self.count + 1) * micros / parts / 1_000;
        if at > now {
            return None;
        }
        self.count += 1;
        Some(if matches!(self.sense.beat(), Beat::Micros(_)) { at } else { now })
    }
}

impl SimulatedNao {
    /// Appends what the senses read in this step, by time and then by stream.
    pub(crate) fn read(&mut self, readings: &mut Vec<Reading>) {
        let first = readings.len();
        let mut open = core::mem::take(&mut self.senses.open);
        for (user, one) in &mut open {
            let Some(at) = one.due(self.now) else { continue };
            if let Some(value) = one.sense.read(self, one.count) {
                readings.push(Reading { to: user.clone(), at: Millis(at), value });
            }
        }
        self.senses.open = open;
        readings[first..].sort_by(|one, other| (one.at, &one.to).cmp(&(other.at, &other.to)));
    }
}
