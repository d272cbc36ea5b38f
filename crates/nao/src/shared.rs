//! The state that the robot's thread and the link's thread have in common.

use crate::body::BodyLimits;
use crate::subscribed::Subscribed;
use crate::voice_before::{USUAL_SPEED, VoiceBefore};
use behaviour::Value;
use phrase::{Phrase, phrase};
use robot::{Condition, Control, Health, Identity, Installed, Lacking, Life, Printed, RobotFault, Use, Wake};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::Notify;

/// Readings that may wait for the next step; the oldest go first.
const READINGS_MAX: usize = 4_096;
/// Actions that did not come about, that may wait to be told; the oldest go first.
const REFUSED_MAX: usize = 256;
/// Why it is degraded while its link is slow.
fn slow() -> Phrase {
    phrase!("nao.slow", "it answers slowly")
}
/// Why it is while its legs may still move.
fn legs() -> Phrase {
    phrase!(
        "nao.legs",
        "its legs did not answer to Stop; look whether it stands, and use its own button if it does not"
    )
}
/// The longest that a fall may take.
const FALL: Duration = Duration::from_secs(3);
/// Texts shown beside the room; the oldest go first.
const PRINTED_MAX: usize = 20;

/// Everything shared around one robot. Locked for moments only.
#[derive(Default)]
pub(crate) struct NaoShared {
    state: Mutex<NaoState>,
    /// Rung when a sense has read something.
    wake: OnceLock<Wake>,
    /// Grows with every Stop: what was wanted before it is void.
    stop_generation: AtomicU64,
    /// True if a Stop was not carried out yet.
    stop_wanted: AtomicBool,
    /// True if the robot is to rest once it holds.
    rest_wanted: AtomicBool,
    /// Rung when what changes seldom may have changed.
    pub(crate) looking: Notify,
    /// Rung when it is wanted.
    pub(crate) stopping: Notify,
    /// True if everything is to end.
    pub(crate) ended: AtomicBool,
    /// Rung when everything is to end.
    pub(crate) ending: Notify,
}

/// The state of the robot, as far as it is known.
pub(crate) struct NaoState {
    pub(crate) health: Health,
    /// Which body it is, or must be.
    pub(crate) identity: Option<Identity>,
    pub(crate) is_pepper: bool,
    pub(crate) devices: Vec<&'static str>,
    pub(crate) lacking: Vec<Lacking>,
    pub(crate) condition: Condition,
    pub(crate) halt: Option<Phrase>,
    /// When it fell last, or was about to.
    pub(crate) falling: Option<Instant>,
    pub(crate) limits: BodyLimits,
    /// The joints of this body, in its order.
    pub(crate) joints: Vec<String>,
    /// Their angles, as they were measured last.
    pub(crate) angles: BTreeMap<String, f64>,
    /// Where it stands: x and y in metres, heading in radians.
    pub(crate) base: [f64; 3],
    /// The light of its eyes: the colour that was wanted last times the brightness.
    pub(crate) eyes: [f32; 3],
    /// The colour of its eyes: red, green and blue from 0 to 1.
    pub(crate) eye_color: [f32; 3],
    /// The brightness of its eyes, from 0 to 1.
    pub(crate) eye_brightness: f32,
    pub(crate) saying: String,
    pub(crate) tracking: String,
    pub(crate) posture: String,
    /// True if the motors of its legs hold; the next is true if a foot feels the ground.
    pub(crate) stiff_legs: Option<bool>,
    pub(crate) on_ground: Option<bool>,
    pub(crate) playing: BTreeSet<String>,
    pub(crate) printed: VecDeque<Printed>,
    /// The animations that were begun, until they are known to have ended.
    pub(crate) animations: BTreeSet<String>,
    /// Subscriptions to what is measured only for us, until the robot has said that it no longer is.
    pub(crate) subscribed: Subscribed,
    /// The names of the catalogue for the sense of each use.
    pub(crate) labels: BTreeMap<Use, &'static str>,
    /// The names that are installed on it.
    pub(crate) installed: Arc<Installed>,
    /// The names under which it remembers faces.
    pub(crate) faces: Arc<[String]>,
    /// The groups of its lights; empty before they are known.
    pub(crate) lights: BTreeSet<String>,
    /// The voice as it was before it was changed; none if it was not.
    pub(crate) voice_before: Option<VoiceBefore>,
    /// True if it moves its arms when it speaks.
    pub(crate) gestures: bool,
    /// The speed at which it speaks, in percent of the usual speed.
    pub(crate) voice_speed: f32,
    /// The words that each use listens for.
    pub(crate) words: BTreeMap<Use, Vec<String>>,
    /// True if anybody uses it.
    pub(crate) used: bool,
    /// True while its link is slow.
    is_slow: bool,
    /// True while its legs have not answered to a Stop.
    legs_silent: bool,
    /// Why senses do not work, by their use.
    silent: BTreeMap<Use, Phrase>,
    /// Actions that did not come about, oldest first.
    refused: VecDeque<(Use, RobotFault)>,
    readings: VecDeque<(Use, Value)>,
    /// A moment and the robot time of it in milliseconds.
    clock: (Instant, u64),
}

impl Default for NaoState {
    fn default() -> Self {
        Self {
            health: Health::Connecting,
            identity: None,
            is_pepper: false,
            devices: Vec::new(),
            lacking: Vec::new(),
            condition: Condition::default(),
            halt: None,
            falling: None,
            limits: BodyLimits::default(),
            joints: Vec::new(),
            angles: BTreeMap::new(),
            base: [0.0; 3],
            eyes: [1.0; 3],
            eye_color: [1.0; 3],
            eye_brightness: 1.0,
            saying: String::new(),
            tracking: String::new(),
            posture: String::new(),
            stiff_legs: None,
            on_ground: None,
            playing: BTreeSet::new(),
            animations: BTreeSet::new(),
            printed: VecDeque::new(),
            subscribed: Subscribed::default(),
            labels: BTreeMap::new(),
            installed: Arc::default(),
            faces: Arc::default(),
            lights: BTreeSet::new(),
            voice_before: None,
            gestures: false,
            voice_speed: USUAL_SPEED,
            words: BTreeMap::new(),
            used: false,
            is_slow: false,
            legs_silent: false,
            silent: BTreeMap::new(),
            refused: VecDeque::new(),
            readings: VecDeque::new(),
            clock: (Instant::now(), 0),
        }
    }
}

impl NaoState {
    pub(crate) fn is_linked(&self) -> bool {
        matches!(self.health, Health::Ready | Health::Degraded(_) | Health::Safe)
    }

    /// Why nothing can be asked of it, if that is so.
    pub(crate) fn check_link(&self) -> Result<(), RobotFault> {
        match &self.health {
            Health::Stranger(_) => {
                let why = phrase!(
                    "nao.another_robot_answers_at_its",
                    "another robot answers at its address; say first which one is meant"
                );
                Err(RobotFault::NotNow(why))
            }
            _ if self.is_linked() => Ok(()),
            _ => Err(RobotFault::NoLink),
        }
    }

    /// Why it cannot move now, if it cannot; in the words of the simulated robot.
    pub(crate) fn check_moves(&self) -> Result<(), RobotFault> {
        let why = match (self.condition.fallen, self.condition.awake) {
            (Some(true), _) => phrase!("nao.it_lies_on_the_floor", "it lies on the floor; help it up first"),
            (_, Some(false)) => phrase!("nao.it_rests_take_control_first", "it rests; take control first"),
            _ => return Ok(()),
        };
        Err(RobotFault::NotNow(why))
    }

    /// Why it cannot walk or turn the whole body now, if it cannot; in the words of the simulated robot where that has them.
    pub(crate) fn check_legs(&self) -> Result<(), RobotFault> {
        let why = if self.posture.starts_with("Sitting") {
            phrase!("nao.it_sits_let_it_stand", "it sits; let it stand up first")
        } else if self.condition.fallen == Some(true) || self.posture.starts_with("Lying") {
            phrase!("nao.it_lies_on_the_floor", "it lies on the floor; help it up first")
        } else if self.on_ground == Some(false) {
            phrase!("nao.it_is_carried_set_it", "it is carried; set it on its feet first")
        } else if self.condition.plugged == Some(true) {
            phrase!("nao.it_is_on_its_charging", "it is on its charging cable; unplug it first")
        } else if self.stiff_legs == Some(false) {
            phrase!("nao.its_legs_are_limp_take", "its legs are limp; take control first")
        } else {
            return Ok(());
        };
        Err(RobotFault::NotNow(why))
    }

    /// Why it cannot do now with its body what somebody asks for, if it cannot.
    pub(crate) fn check_control(&self, control: &Control) -> Result<(), RobotFault> {
        let why = match control {
            Control::Stand | Control::Sit if self.condition.awake == Some(false) => {
                phrase!("nao.it_rests_wake_it_up", "it rests; wake it up first")
            }
            Control::WakeUp | Control::Stand | Control::Sit if !self.may_rest() => {
                phrase!("nao.it_lies_on_the_floor", "it lies on the floor; help it up first")
            }
            Control::WakeUp | Control::Stand | Control::Sit if self.on_ground == Some(false) => {
                phrase!("nao.it_is_carried_set_it", "it is carried; set it on its feet first")
            }
            Control::Sit if self.is_pepper => phrase!("nao.a_pepper_cannot_sit", "a Pepper cannot sit"),
            Control::WakeUp | Control::Stand | Control::Sit if self.condition.life == Some(Life::Safeguard) => {
                phrase!("nao.it_protects_itself_give_it", "it protects itself; give it a moment")
            }
            Control::ForgetFaces | Control::ForgetFace(_) if !self.devices.contains(&"RememberFace") => {
                phrase!("nao.it_cannot_remember_faces", "it cannot remember faces")
            }
            Control::ForgetFace(name) if !self.faces.contains(name) => {
                phrase!("nao.it_remembers_nobody_of_that", "it remembers nobody of that name")
            }
            _ => return Ok(()),
        };
        Err(RobotFault::NotNow(why))
    }

    /// Nobody rests on the floor, or on the way to it.
    pub(crate) fn may_rest(&self) -> bool {
        self.condition.fallen != Some(true) && self.falling.is_none_or(|at| at.elapsed() > FALL)
    }

    /// The robot time of the coming step.
    pub(crate) fn tell_time(&mut self, now_ms: u64) {
        self.clock = (Instant::now(), now_ms);
    }

    /// Robot time at a moment, in milliseconds.
    pub(crate) fn time_at(&self, at: Instant) -> u64 {
        let (then, ms) = self.clock;
        let since = at.saturating_duration_since(then).as_millis();
        let before = then.saturating_duration_since(at).as_millis();
        let ahead = ms.saturating_add(u64::try_from(since).unwrap_or(u64::MAX));
        ahead.saturating_sub(u64::try_from(before).unwrap_or(u64::MAX))
    }

    /// A sense does not work, for this reason; without one it ended, and that does not matter any more.
    pub(crate) fn note_silent(&mut self, user: &Use, why: Option<Phrase>) {
        match why {
            Some(why) => drop(self.silent.insert(user.clone(), why)),
            None => drop(self.silent.remove(user)),
        }
        self.settle_health();
    }

    /// The link is slow, or is no more.
    pub(crate) fn note_slow(&mut self, is_slow: bool) {
        self.is_slow = is_slow;
        self.settle_health();
    }

    /// The legs did not answer to a Stop, or did.
    pub(crate) fn note_legs(&mut self, silent: bool) {
        self.legs_silent = silent;
        self.settle_health();
    }

    /// Nothing of the link that is gone is a reason any more.
    pub(crate) fn forget_reasons(&mut self) {
        (self.is_slow, self.legs_silent) = (false, false);
        self.silent.clear();
    }

    /// Health is as its reasons are now, the gravest first.
    fn settle_health(&mut self) {
        if !self.is_linked() {
            return;
        }
        let why = match () {
            () if self.legs_silent => Some(legs()),
            () if self.is_slow => Some(slow()),
            () => self.silent.values().next().cloned(),
        };
        match (why, &self.health) {
            (Some(why), _) => self.health = Health::Degraded(why),
            (None, Health::Degraded(_)) => self.health = Health::Ready,
            (None, _) => {}
        }
    }

    /// An action did not come about.
    pub(crate) fn refuse(&mut self, user: &Use, fault: &RobotFault) {
        if self.refused.len() >= REFUSED_MAX {
            self.refused.pop_front();
        }
        self.refused.push_back((user.clone(), fault.clone()));
    }

    pub(crate) fn take_refused(&mut self) -> VecDeque<(Use, RobotFault)> {
        std::mem::take(&mut self.refused)
    }

    fn put_reading(&mut self, user: &Use, value: Value) {
        if self.readings.len() >= READINGS_MAX {
            self.readings.pop_front();
        }
        self.readings.push_back((user.clone(), value));
    }

    pub(crate) fn take_readings(&mut self) -> VecDeque<(Use, Value)> {
        std::mem::take(&mut self.readings)
    }

    pub(crate) fn forget_readings_of(&mut self, user: &Use) {
        self.readings.retain(|(of, _)| of != user);
    }

    pub(crate) fn print(&mut self, by: Use, text: String) {
        if self.printed.len() >= PRINTED_MAX {
            self.printed.pop_front();
        }
        let at_ms = self.time_at(Instant::now());
        self.printed.push_back(Printed { by, at_ms, text });
    }
}

impl NaoShared {
    pub(crate) fn state(&self) -> MutexGuard<'_, NaoState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// From now on this is rung when a sense has read something.
    pub(crate) fn wake_with(&self, wake: Wake) {
        drop(self.wake.set(wake));
    }

    /// A sense has read this.
    pub(crate) fn sensed(&self, user: &Use, value: Value) {
        self.state().put_reading(user, value);
        if let Some(wake) = self.wake.get() {
            wake();
        }
    }

    /// Returns the stop generation that counts now; a deed of another one is void.
    pub(crate) fn stop_generation(&self) -> u64 {
        self.stop_generation.load(Ordering::SeqCst)
    }

    /// Begins a new stop generation, so that all that was wanted so far is void, and wants the robot to hold.
    pub(crate) fn stop(&self) {
        self.stop_generation.fetch_add(1, Ordering::SeqCst);
        self.stop_wanted.store(true, Ordering::SeqCst);
        self.stopping.notify_one();
    }

    pub(crate) fn wants_stop(&self) -> bool {
        self.stop_wanted.load(Ordering::SeqCst)
    }

    /// A Stop that was wanted of the robot that was expected is none of the one that answers; true if there was one.
    pub(crate) fn put_off_stop(&self) -> bool {
        self.stop_wanted.swap(false, Ordering::SeqCst)
    }

    /// Holds, and then rests.
    pub(crate) fn rest(&self) {
        self.rest_wanted.store(true, Ordering::SeqCst);
        self.stop();
    }

    /// True if it is to rest now; asked once.
    pub(crate) fn take_rest(&self) -> bool {
        self.rest_wanted.swap(false, Ordering::SeqCst)
    }

    /// It was carried out, unless it is wanted anew.
    pub(crate) fn stopped(&self, stop_generation: u64) {
        if self.stop_generation() == stop_generation {
            self.stop_wanted.store(false, Ordering::SeqCst);
        }
    }

    /// Everything that runs has to end, for this reason; the first one counts until it is told.
    pub(crate) fn halt(&self, why: Phrase) {
        {
            let mut state = self.state();
            if !state.used {
                return;
            }
            state.halt.get_or_insert(why);
        }
        self.stop();
    }

    pub(crate) fn end(&self) {
        self.ended.store(true, Ordering::SeqCst);
        self.ending.notify_waiters();
        self.ending.notify_one();
    }

    pub(crate) fn is_ended(&self) -> bool {
        self.ended.load(Ordering::SeqCst)
    }
}

#[cfg(test)]
mod tests {
    use super::{NaoState, legs};
    use phrase::Phrase;
    use robot::Health;

    #[test]
    fn health_is_as_its_reasons_are_until_they_are_gone() {
        let mut state = NaoState { health: Health::Ready, ..NaoState::default() };
        let degraded = |state: &NaoState| match &state.health {
            Health::Degraded(why) => why.clone(),
            _ => Phrase::default(),
        };
        state.note_legs(true);
        state.note_slow(true);
        assert_eq!(degraded(&state), legs());
        // The next sign of life says nothing of the legs.
        state.note_slow(false);
        assert_eq!(degraded(&state), legs());
        state.note_legs(false);
        assert_eq!(state.health, Health::Ready);
    }
}
