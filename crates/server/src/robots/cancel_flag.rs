//! What cancels a run: once its flag is set, nothing of the run reaches the robot any more.

use super::stops::{StopNumbers, StoppedSince};
use crate::support::lock;
use behaviour::Id;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// The most Stops of one behaviour alone that are remembered.
const ALONE_MAX: usize = 64;

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

    /// True if commands do not pass any more.
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

/// The flags of everything that runs or is about to on one robot, and its newest Stop. Their lock is held for a few
/// instructions at a time, whatever else is locked: it is the only one on the way of a Stop.
#[derive(Debug)]
pub(super) struct CancelFlags {
    numbers: Arc<StopNumbers>,
    inner: Mutex<Flags>,
}

#[derive(Debug)]
struct Flags {
    /// The number of the newest Stop of everything on this robot.
    last: u64,
    /// The numbers of newer Stops of one behaviour alone.
    alone: Vec<(Id, u64)>,
    /// The flags, each with its behaviour.
    all: Vec<(Id, Arc<CancelFlag>)>,
}

impl CancelFlags {
    /// Nothing runs, and no Stop came since the server started.
    pub(super) fn new(numbers: Arc<StopNumbers>) -> Self {
        let inner = Mutex::new(Flags { last: numbers.first(), alone: Vec::new(), all: Vec::new() });
        Self { numbers, inner }
    }

    /// A flag for a run of this behaviour.
    pub(super) fn add(&self, behaviour: &Id) -> Arc<CancelFlag> {
        lock(&self.inner).add(behaviour)
    }

    /// A flag for what somebody pressed who had heard of Stops up to this one. A Stop that comes from now on sets it.
    ///
    /// # Errors
    /// If the behaviour, or everything, was stopped since.
    pub(super) fn add_pressed(&self, behaviour: &Id, stops: Option<u64>) -> Result<Arc<CancelFlag>, StoppedSince> {
        let mut flags = lock(&self.inner);
        flags.check(behaviour, stops, &self.numbers)?;
        Ok(flags.add(behaviour))
    }

    /// Looks whether what somebody pressed for a behaviour still counts who had heard of Stops up to this one.
    ///
    /// # Errors
    /// If the behaviour, or everything, was stopped since.
    pub(super) fn check(&self, behaviour: &Id, stops: Option<u64>) -> Result<(), StoppedSince> {
        lock(&self.inner).check(behaviour, stops, &self.numbers)
    }

    /// Sets the flags of a behaviour, or all; true if any was not set. What was pressed for them before is void.
    pub(super) fn stop(&self, behaviour: Option<&Id>, by: &str) -> bool {
        let is_meant = |id: &Id| behaviour.is_none_or(|behaviour| behaviour == id);
        let mut flags = lock(&self.inner);
        flags.stopped(behaviour, self.numbers.next());
        flags.all.iter().filter(|(id, cancel)| is_meant(id) && cancel.stop(by)).count() > 0
    }

    /// The robot stopped by itself: what was pressed before is void, also what waits in its queue for its body alone.
    pub(super) fn halted(&self, robot: &Id) {
        let mut flags = lock(&self.inner);
        flags.stopped(None, self.numbers.next());
        flags.all.iter().filter(|(id, _)| id == robot).for_each(|(_, flag)| {
            flag.cancel();
        });
    }
}

impl Flags {
    fn add(&mut self, behaviour: &Id) -> Arc<CancelFlag> {
        let cancel = Arc::new(CancelFlag::default());
        self.all.retain(|(_, cancel)| !cancel.is_cancelled());
        self.all.push((behaviour.clone(), Arc::clone(&cancel)));
        cancel
    }

    fn stopped(&mut self, behaviour: Option<&Id>, number: u64) {
        let Some(behaviour) = behaviour else {
            self.alone.clear();
            self.last = number;
            return;
        };
        self.alone.retain(|(id, _)| id != behaviour);
        if self.alone.len() >= ALONE_MAX {
            // Better too much is void than too little.
            self.last = self.alone.remove(0).1;
        }
        self.alone.push((behaviour.clone(), number));
    }

    /// A number that was never given is of another server.
    fn check(&self, behaviour: &Id, stops: Option<u64>, numbers: &StopNumbers) -> Result<(), StoppedSince> {
        let alone = self.alone.iter().find(|(id, _)| id == behaviour);
        let last = alone.map_or(self.last, |(_, number)| *number);
        let counts = stops.is_none_or(|stops| (last..=numbers.newest()).contains(&stops));
        if counts { Ok(()) } else { Err(StoppedSince) }
    }
}

#[cfg(test)]
mod tests {
    use super::{ALONE_MAX, CancelFlags, StopNumbers, StoppedSince};
    use behaviour::Id;
    use std::sync::Arc;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    #[test]
    fn what_was_pressed_before_a_stop_is_void_after_it_and_what_is_pressed_then_counts() {
        let numbers = Arc::new(StopNumbers::of(7));
        let [robot, other] = [(); 2].map(|()| CancelFlags::new(Arc::clone(&numbers)));
        let before = Some(numbers.newest());
        let (greet, follow) = (id("greet"), id("follow"));
        assert!(robot.add_pressed(&greet, before).is_ok() && robot.check(&greet, before).is_ok());
        robot.stop(Some(&greet), "Aiko");
        assert!(robot.add_pressed(&follow, before).is_ok(), "only the other program was stopped");
        let between = Some(numbers.newest());
        for (behaviour, before) in [(Some(&greet), before), (None, between)] {
            robot.stop(behaviour, "Aiko");
            assert_eq!(robot.add_pressed(&greet, before).unwrap_err(), StoppedSince, "{behaviour:?}");
            assert_eq!(robot.check(&greet, before), Err(StoppedSince), "{behaviour:?}");
            assert!(robot.add_pressed(&greet, Some(numbers.newest())).is_ok(), "{behaviour:?}: at once");
        }
        assert_eq!(robot.check(&follow, between), Err(StoppedSince), "everything was stopped");
        assert!(other.check(&greet, before).is_ok(), "the other robot was not stopped");
        let after = Some(numbers.newest());
        let (waits, runs) = (robot.add(&id("nao")), robot.add(&greet));
        robot.halted(&id("nao"));
        assert!(
            waits.is_cancelled() && !runs.is_cancelled(),
            "a tile waits for nothing more; a run is paused by its own way"
        );
        assert_eq!(robot.check(&greet, after), Err(StoppedSince), "a robot that stopped by itself");
        assert!(robot.check(&greet, None).is_ok(), "whose client hears of no Stop");
    }

    #[test]
    fn what_is_remembered_of_stops_is_bounded_and_none_is_forgotten() {
        let numbers = Arc::new(StopNumbers::of(1));
        let robot = CancelFlags::new(Arc::clone(&numbers));
        let before = Some(numbers.newest());
        let programs: Vec<Id> = (0..3 * ALONE_MAX).map(|number| id(&format!("p{number}"))).collect();
        for program in &programs {
            robot.stop(Some(program), "Aiko");
        }
        assert_eq!(robot.inner.lock().unwrap().alone.len(), ALONE_MAX);
        assert!(programs.iter().all(|program| robot.check(program, before).is_err()));
    }

    #[test]
    fn no_start_of_the_server_takes_what_was_pressed_for_another_one() {
        let [before, now] = [6, 7].map(|epoch| Arc::new(StopNumbers::of(epoch)));
        let [old, robot] = [&before, &now].map(|numbers| CancelFlags::new(Arc::clone(numbers)));
        (0..1_000).for_each(|_| old.halted(&id("nao")));
        assert_eq!(robot.check(&id("greet"), Some(before.newest())), Err(StoppedSince), "of the start before");
        assert_eq!(
            old.check(&id("greet"), Some(now.newest())),
            Err(StoppedSince),
            "a store that was put back gives smaller ones"
        );
        assert!(robot.check(&id("greet"), Some(now.newest())).is_ok());
    }

    #[test]
    fn a_stop_cancels_what_it_means_and_says_by_whom() {
        let cancel_flags = CancelFlags::new(Arc::default());
        let (greet, follow) = (cancel_flags.add(&id("greet")), cancel_flags.add(&id("follow")));
        assert!(cancel_flags.stop(Some(&id("greet")), "Aiko") && !cancel_flags.stop(Some(&id("greet")), "Ben"));
        assert_eq!((greet.is_cancelled(), greet.stopped_by()), (true, Some("Aiko")));
        assert!(!follow.is_cancelled() && cancel_flags.stop(None, "Ben") && follow.is_cancelled());
    }
}
