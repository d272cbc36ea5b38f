//! What cancels a run: once its flag is set, nothing of the run reaches the robot any more.

use crate::support::lock;
use behaviour::Id;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// Set once a run may not move the robot any more. Setting it needs no lock, and what was sent before is void from then on.
#[derive(Debug, Default)]
pub(super) struct CancelFlag {
    is_cancelled: AtomicBool,
    stopped_by: OnceLock<String>,
}

impl CancelFlag {
    /// Sets it for good; true if it was not set.
    pub(super) fn cancel(&self) -> bool {
        !self.is_cancelled.swap(true, Ordering::SeqCst)
    }

    /// Whether commands do not pass any more.
    pub(super) fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::SeqCst)
    }

    /// Who pressed Stop, if that set it.
    pub(super) fn stopped_by(&self) -> Option<&str> {
        self.stopped_by.get().map(String::as_str)
    }

    fn stop(&self, by: &str) -> bool {
        if self.is_cancelled() {
            return false;
        }
        // Before it is set, so that whoever sees it knows why.
        let _first = self.stopped_by.set(by.to_owned());
        self.cancel()
    }
}

/// The flags of everything that runs or is about to on one robot. Their lock is held for a few instructions at a time,
/// whatever else is locked: it is the only one on the way of a Stop.
#[derive(Debug, Default)]
pub(super) struct CancelFlags(Mutex<Vec<(Id, Arc<CancelFlag>)>>);

impl CancelFlags {
    /// A flag for a run of this behaviour.
    pub(super) fn add(&self, behaviour: &Id) -> Arc<CancelFlag> {
        let (cancel, behaviour) = (Arc::new(CancelFlag::default()), behaviour.clone());
        let mut flags = lock(&self.0);
        flags.retain(|(_, cancel)| !cancel.is_cancelled());
        flags.push((behaviour, Arc::clone(&cancel)));
        cancel
    }

    /// Sets the flags of a behaviour, or all; true if any was not set.
    pub(super) fn stop(&self, behaviour: Option<&Id>, by: &str) -> bool {
        let is_meant = |id: &Id| behaviour.is_none_or(|behaviour| behaviour == id);
        let flags = lock(&self.0);
        flags.iter().filter(|(id, cancel)| is_meant(id) && cancel.stop(by)).count() > 0
    }
}

#[cfg(test)]
mod tests {
    use super::CancelFlags;
    use behaviour::Id;

    #[test]
    fn a_stop_cancels_what_it_means_and_says_by_whom() {
        let (cancel_flags, id) = (CancelFlags::default(), |text: &str| Id::new(text).unwrap());
        let (greet, follow) = (cancel_flags.add(&id("greet")), cancel_flags.add(&id("follow")));
        assert!(cancel_flags.stop(Some(&id("greet")), "Aiko") && !cancel_flags.stop(Some(&id("greet")), "Ben"));
        assert_eq!((greet.is_cancelled(), greet.stopped_by()), (true, Some("Aiko")));
        assert!(!follow.is_cancelled() && cancel_flags.stop(None, "Ben") && follow.is_cancelled());
    }
}
