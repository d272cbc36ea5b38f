//! The gate between a run and the robot: once closed, nothing of the run reaches the robot any more.

use crate::support::lock;
use behaviour::Id;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// Open while a run may move the robot. Closing needs no lock, and what was sent before is void from then on.
#[derive(Debug, Default)]
pub(super) struct Gate {
    closed: AtomicBool,
    stopped_by: OnceLock<String>,
}

impl Gate {
    /// Closes it for good; true if it was open.
    pub(super) fn close(&self) -> bool {
        !self.closed.swap(true, Ordering::SeqCst)
    }

    /// Whether commands still pass.
    pub(super) fn is_open(&self) -> bool {
        !self.closed.load(Ordering::SeqCst)
    }

    /// Who pressed Stop, if that closed it.
    pub(super) fn stopped_by(&self) -> Option<&str> {
        self.stopped_by.get().map(String::as_str)
    }

    fn stop(&self, by: &str) -> bool {
        if !self.is_open() {
            return false;
        }
        // Before it closes, so that whoever sees it closed knows why.
        let _first = self.stopped_by.set(by.to_owned());
        self.close()
    }
}

/// The gates of everything that runs or is about to on one robot. Their lock is held for a few instructions at a time,
/// whatever else is locked: it is the only one on the way of a Stop.
#[derive(Debug, Default)]
pub(super) struct Gates(Mutex<Vec<(Id, Arc<Gate>)>>);

impl Gates {
    /// A gate for a run of this behaviour.
    pub(super) fn open(&self, behaviour: &Id) -> Arc<Gate> {
        let (gate, behaviour) = (Arc::new(Gate::default()), behaviour.clone());
        let mut gates = lock(&self.0);
        gates.retain(|(_, gate)| gate.is_open());
        gates.push((behaviour, Arc::clone(&gate)));
        gate
    }

    /// Closes the gates of a behaviour, or all; true if any was open.
    pub(super) fn stop(&self, behaviour: Option<&Id>, by: &str) -> bool {
        let is_meant = |id: &Id| behaviour.is_none_or(|behaviour| behaviour == id);
        let gates = lock(&self.0);
        gates.iter().filter(|(id, gate)| is_meant(id) && gate.stop(by)).count() > 0
    }
}

#[cfg(test)]
mod tests {
    use super::Gates;
    use behaviour::Id;

    #[test]
    fn a_stop_closes_what_it_means_and_says_by_whom() {
        let (gates, id) = (Gates::default(), |text: &str| Id::new(text).unwrap());
        let (greet, follow) = (gates.open(&id("greet")), gates.open(&id("follow")));
        assert!(gates.stop(Some(&id("greet")), "Aiko") && !gates.stop(Some(&id("greet")), "Ben"));
        assert_eq!((greet.is_open(), greet.stopped_by()), (false, Some("Aiko")));
        assert!(follow.is_open() && gates.stop(None, "Ben") && !follow.is_open());
    }
}
