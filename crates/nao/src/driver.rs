//! The robot as its thread sees it: everything returns at once, and what takes time is done on the link's thread.

use crate::body::joint_words;
use crate::camera::NaoCamera;
use crate::deed::Action;
use crate::devices::{ALL, ChosenParams, OpenActuator, OpenDevice, Sense};
use crate::link_commands::LinkCommand;
use crate::models;
use crate::settings::RobotSettings;
use crate::shared::NaoShared;
use crate::supervisor;
use behaviour::{Params, Value};
use phrase::{Phrase, phrase};
use robot::{
    Body, Camera, Condition, Control, Health, Identity, Installed, JOINTS, Lacking, Life, Millis, Reading, Robot,
    RobotFault, Scene, Use, Wake, with_defaults,
};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::JoinHandle;
use tokio::sync::mpsc;

/// Most open devices.
const USES_MAX: usize = 512;
/// Deeds that may wait for the link's thread.
const DEEDS_MAX: usize = 1_024;

/// Says what a robot with a life of its own does beside what runs.
fn lives() -> Phrase {
    phrase!(
        "nao.lives",
        "its own life is on, so it may move its head and arms and change its lights and voice by itself; take control first"
    )
}

/// A NAO or Pepper. It connects by itself, again and again, for as long as it lasts; dropped, it ends what it does on the
/// robot and its thread.
pub struct Nao {
    shared: Arc<NaoShared>,
    orders: mpsc::UnboundedSender<LinkCommand>,
    /// Deeds on their way.
    waiting: Arc<AtomicUsize>,
    acts: BTreeMap<Use, Box<dyn OpenActuator>>,
    senses: BTreeMap<Use, OpenSense>,
    camera: NaoCamera,
    thread: Option<JoinHandle<()>>,
}

/// An open sense: what of the robot there is one of only, and its beat.
struct OpenSense {
    only: Option<(&'static str, String)>,
    beat: Option<RobotBeat>,
}

/// Beats by robot time.
struct RobotBeat {
    period_us: u64,
    since_ms: u64,
    count: u64,
}

impl Nao {
    /// A robot that is not there yet. Returns at once.
    #[must_use]
    pub fn start(settings: RobotSettings) -> Self {
        let shared = Arc::new(NaoShared::default());
        shared.state().identity.clone_from(&settings.expected);
        let (orders, told) = mpsc::unbounded_channel();
        let waiting = Arc::new(AtomicUsize::new(0));
        let (with, count) = (Arc::clone(&shared), Arc::clone(&waiting));
        let camera = NaoCamera::new(settings.clone(), Arc::clone(&shared));
        let thread = std::thread::Builder::new().name("nao".into());
        let thread = thread.spawn(move || supervisor::keep(&settings, &with, told, &count));
        if let Err(error) = &thread {
            shared.state().health =
                Health::Lost(phrase!("nao.there_is_no_thread_for", "there is no thread for it ({error})"));
        }
        Self { shared, orders, waiting, acts: BTreeMap::new(), senses: BTreeMap::new(), camera, thread: thread.ok() }
    }

    fn tell(&self, order: LinkCommand) -> Result<(), RobotFault> {
        self.orders.send(order).map_err(|_| RobotFault::NoLink)
    }

    fn note_use(&self) {
        self.shared.state().used = !self.acts.is_empty() || !self.senses.is_empty();
    }

    /// Checks that no other use wants what there is one of only in another way.
    fn check_only(&self, sense: &dyn Sense) -> Result<(), RobotFault> {
        let Some((what, how)) = sense.only() else { return Ok(()) };
        let other = self.senses.values().filter_map(|open| open.only.as_ref());
        if other.into_iter().any(|(known, wanted)| *known == what && *wanted != how) {
            return Err(RobotFault::NotNow(phrase!("nao.it_can_only_use_one", "it can only use one {what} at a time")));
        }
        Ok(())
    }

    /// Checks that the sense that an action needs is there.
    fn check_needs(&self, act: &dyn OpenActuator) -> Result<(), RobotFault> {
        let Some(sense) = act.needs() else { return Ok(()) };
        let state = self.shared.state();
        match state.lacking.iter().find(|lacking| lacking.device == sense) {
            Some(lacking) => Err(RobotFault::NotNow(lacking.why.clone())),
            None => Ok(()),
        }
    }

    fn beats(&mut self, now_ms: u64, readings: &mut Vec<Reading>) {
        for (user, open) in &mut self.senses {
            let Some(beat) = &mut open.beat else { continue };
            loop {
                let at = beat.since_ms + (beat.count + 1) * beat.period_us / 1_000;
                if at > now_ms {
                    break;
                }
                beat.count += 1;
                let value = Value::Int(beat.count.cast_signed());
                readings.push(Reading { to: user.clone(), at: Millis(at), value });
            }
        }
    }
}

impl Robot for Nao {
    fn kind(&self) -> &'static str {
        if self.shared.state().is_pepper { "pepper" } else { "nao" }
    }

    fn by_body(&self) -> Phrase {
        if self.shared.state().is_pepper {
            phrase!("nao.press_the_red_button_at", "press the red button at the back of its neck")
        } else {
            phrase!("nao.hold_it_and_press_its", "hold it and press its chest button for 3 seconds")
        }
    }

    fn devices(&self) -> Vec<&'static str> {
        self.shared.state().devices.clone()
    }

    fn lacking(&self) -> Vec<Lacking> {
        self.shared.state().lacking.clone()
    }

    fn installed(&self) -> Arc<Installed> {
        Arc::clone(&self.shared.state().installed)
    }

    fn open(&mut self, user: &Use, name: &str, params: &Params) -> Result<(), RobotFault> {
        self.close(user);
        let driver = ALL.iter().find(|driver| driver.name == name);
        let driver = driver.ok_or_else(|| RobotFault::NoDevice(name.to_owned()))?;
        let known = robot::sensors().chain(robot::actuators()).find(|known| known.name == name);
        let known = known.ok_or_else(|| RobotFault::NoDevice(name.to_owned()))?;
        known.check(params)?;
        let now_ms = {
            let state = self.shared.state();
            state.check_link()?;
            if !state.devices.contains(&name) {
                let why =
                    state.lacking.iter().find(|lacking| lacking.device == name).map(|lacking| lacking.why.clone());
                return Err(why.map_or_else(|| RobotFault::NoDevice(name.to_owned()), RobotFault::Lacks));
            }
            if let Some(why) = models::lacks(name, params, state.is_pepper) {
                return Err(RobotFault::Lacks(why));
            }
            if state.halt.is_some() {
                return Err(RobotFault::NotNow(phrase!("nao.it_has_just_halted", "it has just halted")));
            }
            known.check_installed(params, &state.installed)?;
            let joint = params.get("joint").and_then(Value::as_text);
            if let Some(joint) = joint.filter(|joint| JOINTS.contains(joint))
                && !state.joints.iter().any(|known| known == joint)
            {
                return Err(RobotFault::Lacks(phrase!(
                    "nao.its_body_has_no",
                    "its body has no {joint}",
                    joint = joint_words(joint)
                )));
            }
            state.time_at(std::time::Instant::now())
        };
        if self.acts.len() + self.senses.len() >= USES_MAX {
            return Err(RobotFault::Full(USES_MAX));
        }
        let opened = (driver.open)(&ChosenParams(with_defaults(known.params, params)));
        match opened.ok_or_else(|| RobotFault::Unusable(name.to_owned()))? {
            OpenDevice::Sense(sense) => {
                self.check_only(&*sense)?;
                let beat = sense.beat_us().map(|period_us| RobotBeat { period_us, since_ms: now_ms, count: 0 });
                self.shared.state().labels.insert(user.clone(), known.label);
                self.senses.insert(user.clone(), OpenSense { only: sense.only(), beat });
                self.tell(LinkCommand::Open(user.clone(), sense))?;
            }
            OpenDevice::Act(act) => {
                self.check_needs(&*act)?;
                act.fits(&self.shared.state())?;
                self.acts.insert(user.clone(), act);
            }
        }
        self.note_use();
        Ok(())
    }

    fn close(&mut self, user: &Use) {
        let known = self.acts.remove(user).is_some() | self.senses.remove(user).is_some();
        if known {
            let mut state = self.shared.state();
            state.forget_readings_of(user);
            state.labels.remove(user);
            drop(state);
            let _gone = self.tell(LinkCommand::Close(user.clone()));
            self.note_use();
        }
    }

    fn command(&mut self, user: &Use, value: &Value, _now: Millis) -> Result<(), RobotFault> {
        let Some(act) = self.acts.get(user) else {
            return Err(if self.senses.contains_key(user) { RobotFault::IntoSense } else { RobotFault::NotOpen });
        };
        if !value.is_finite() {
            return Err(RobotFault::Infinite);
        }
        let deed = act.deed(value)?;
        let stop_generation = {
            let mut state = self.shared.state();
            state.check_link()?;
            if state.halt.is_some() {
                return Err(RobotFault::NotNow(phrase!("nao.it_has_just_halted", "it has just halted")));
            }
            if deed.moves() {
                state.check_moves()?;
            }
            if deed.walks() {
                state.check_legs()?;
            }
            act.ready(value, &state)?;
            if let Action::Print(text) = deed {
                state.print(user.clone(), text);
                return Ok(());
            }
            self.shared.stop_generation()
        };
        if self.waiting.fetch_add(1, Ordering::SeqCst) >= DEEDS_MAX {
            self.waiting.fetch_sub(1, Ordering::SeqCst);
            return Err(RobotFault::NotNow(phrase!("nao.too_much_waits_for_it", "too much waits for it")));
        }
        self.tell(LinkCommand::Do(stop_generation, user.clone(), deed))
    }

    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>) {
        let waiting = {
            let mut state = self.shared.state();
            state.tell_time(now.0);
            state.take_readings()
        };
        let sensed = waiting.into_iter().filter(|(to, _)| self.senses.contains_key(to));
        let sensed: Vec<_> = sensed.map(|(to, value)| Reading { to, at: now, value }).collect();
        readings.extend(sensed);
        self.beats(now.0, readings);
    }

    fn sense(&mut self, readings: &mut Vec<Reading>) {
        let (waiting, at) = {
            let mut state = self.shared.state();
            (state.take_readings(), Millis(state.time_at(std::time::Instant::now())))
        };
        let sensed = waiting.into_iter().filter(|(to, _)| self.senses.contains_key(to));
        readings.extend(sensed.map(|(to, value)| Reading { to, at, value }));
    }

    fn wake_with(&mut self, wake: Wake) {
        self.shared.wake_with(wake);
    }

    fn stop(&mut self, _now: Millis) {
        self.shared.stop();
    }

    fn control(&mut self, control: Control, _now: Millis) -> Result<(), RobotFault> {
        let may_rest = {
            let state = self.shared.state();
            // A sign by lights is what a stranger is known by.
            if control != Control::Blink || !matches!(state.health, Health::Stranger(_)) {
                state.check_link()?;
                state.check_control(&control)?;
            }
            state.may_rest()
        };
        if control == Control::Blink {
            return self.tell(LinkCommand::Control(control));
        }
        if control == Control::Rest {
            if !may_rest {
                return Err(RobotFault::NotNow(phrase!(
                    "nao.it_lies_on_the_floor",
                    "it lies on the floor; help it up first"
                )));
            }
            self.shared.rest();
            return Ok(());
        }
        self.shared.take_rest();
        self.tell(LinkCommand::Control(control))
    }

    fn faces(&self) -> Arc<[String]> {
        Arc::clone(&self.shared.state().faces)
    }

    fn take_refused(&mut self) -> Vec<(Use, RobotFault)> {
        self.shared.state().take_refused().into()
    }

    fn take_halt(&mut self) -> Option<Phrase> {
        self.shared.state().halt.take()
    }

    fn health(&self) -> Health {
        let state = self.shared.state();
        // Who runs something has to know that it is not alone.
        let is_alive = state.used && matches!(state.condition.life, Some(Life::Solitary | Life::Interactive));
        if is_alive && state.health == Health::Ready { Health::Degraded(lives()) } else { state.health.clone() }
    }

    fn condition(&self) -> Condition {
        let state = self.shared.state();
        let legs = match state.check_legs() {
            Err(RobotFault::NotNow(why)) => Some(why),
            _ => None,
        };
        Condition { legs, ..state.condition.clone() }
    }

    fn identity(&self) -> Option<Identity> {
        self.shared.state().identity.clone()
    }

    fn scene(&self) -> Scene {
        let state = self.shared.state();
        let angle = |joint: &&str| state.angles.get(*joint).copied().unwrap_or_default() as f32;
        let body = Body {
            base: state.base.map(|part| part as f32),
            joints: JOINTS.iter().map(angle).collect(),
            eyes: state.eyes,
            saying: state.saying.clone(),
            tracking: state.tracking.clone(),
            printed: state.printed.iter().cloned().collect(),
            battery: state.condition.battery.unwrap_or_default(),
            plugged: state.condition.plugged.unwrap_or_default(),
            posture: state.posture.clone(),
            fallen: state.condition.fallen.unwrap_or_default(),
            playing: state.playing.iter().cloned().collect::<Vec<_>>().join(", "),
            ..Body::default()
        };
        Scene { at_ms: state.time_at(std::time::Instant::now()), body, ..Scene::default() }
    }

    fn camera(&self) -> Option<Arc<dyn Camera>> {
        Some(Arc::new(self.camera.clone()))
    }
}

impl Drop for Nao {
    fn drop(&mut self) {
        // Nothing was begun on a stranger.
        if !matches!(self.shared.state().health, Health::Stranger(_)) {
            self.shared.stop();
        }
        self.shared.end();
        // Its thread ends by itself within a bound; nobody waits for a robot that does not answer.
        drop(self.thread.take());
    }
}
