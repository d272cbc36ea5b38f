//! The actions of the robot for behaviours: the newest of each kind at the motion cycle, one voice, one walk, what it
//! follows, and what takes its time. Nothing here is waited for; what was wanted before a Stop is void; what goes on is
//! sent in pieces that end by themselves, so that a robot that hears no more of us comes to rest.

mod moving;

use crate::deed::{Action, ServiceCall};
use crate::devices::eyes::shine;
use crate::done::{Done, Slot};
use crate::lasting::{LastingWork, Lastings};
use crate::link::{CALL, call};
use crate::phrases;
use crate::shared::{NaoShared, NaoState};
use crate::speech::Speech;
use crate::targets::JointTargets;
use crate::voicing::{self, Voicing};
use futures_util::future::join_all;
use moving::Moving;
use qi::Session;
use robot::Use;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use tokio::sync::mpsc;

/// The longest that speaking a text may take, beside so much for each character.
const SAY: Duration = Duration::from_secs(15);
const SAY_CHAR: Duration = Duration::from_millis(150);

/// The beginning of the names of animations.
const ANIMATION: &str = "animations/";
/// The prefix of the name of an installed behaviour, among all that may last.
const BEHAVIOR: &str = "behaviour ";
/// The longest that an installed behaviour may take.
const BEHAVIOR_WITHIN: Duration = Duration::from_secs(600);
/// The service that has the tablet, and the kind of everything that it shows.
const TABLET: Slot = "ALTabletService";
/// The kind of everything that joints do.
const JOINTS: Slot = "joints";
/// The service that hears words, and its own voice too.
const HEARING: &str = crate::hearing::SERVICE;

/// Everything that is being done.
pub(crate) struct Acting {
    session: Session,
    shared: Arc<NaoShared>,
    done: mpsc::UnboundedSender<Done>,
    stop_generation: u64,
    slots: BTreeMap<Slot, ServiceCall>,
    targets: JointTargets,
    under_way: BTreeSet<Slot>,
    /// When one of a kind was sent, in this cycle.
    sent: BTreeMap<Slot, Instant>,
    /// The motion cycle of the robot.
    cycle: Duration,
    speech: Speech,
    moving: Moving,
    lasting: Lastings,
    /// The name by which this server subscribes.
    own_name: String,
    voicing: Voicing,
    /// Groups of lights that are not the robot's own now, and who lit them.
    lit: BTreeMap<Slot, Use>,
    /// The use that shows something on the tablet.
    shown: Option<Use>,
}

impl Acting {
    pub(crate) fn new(
        session: Session,
        shared: Arc<NaoShared>,
        done: mpsc::UnboundedSender<Done>,
        cycle: Duration,
        own_name: &str,
    ) -> Self {
        let stop_generation = shared.stop_generation();
        Self {
            session,
            shared,
            done,
            stop_generation,
            slots: BTreeMap::new(),
            targets: JointTargets::default(),
            under_way: BTreeSet::new(),
            sent: BTreeMap::new(),
            cycle,
            speech: Speech::default(),
            moving: Moving::default(),
            lasting: Lastings::default(),
            own_name: own_name.to_owned(),
            voicing: Voicing::new(own_name),
            lit: BTreeMap::new(),
            shown: None,
        }
    }

    /// Does what is wanted, if no Stop came since.
    pub(crate) fn act(&mut self, stop_generation: u64, user: Use, deed: Action) {
        self.look_at_gate();
        if stop_generation != self.stop_generation {
            return;
        }
        match deed {
            Action::Eyes(color) => self.shine(|state| state.eye_color = color),
            Action::Glow(brightness) => self.shine(|state| state.eye_brightness = brightness),
            Action::Joints { joints, angles, speed } => self.move_joints(&user, joints, angles, speed),
            Action::Lasting { what, calls, end, within, moves: _ } => {
                if what.starts_with(ANIMATION) {
                    self.shared.state().animations.insert(what.clone());
                }
                let work = LastingWork { what, calls, end, within };
                self.lasting.begin(&self.session, &self.done, user, work);
                self.show();
            }
            Action::Behavior(name) => self.run_behavior(user, name),
            Action::Voice(manner) => self.voicing.set(&self.session, &self.shared, stop_generation, user, manner),
            Action::Light { group, call } => {
                self.slots.insert(group, call);
                self.lit.insert(group, user);
            }
            Action::Tablet(call) => {
                self.slots.insert(TABLET, call);
                self.shown = Some(user);
            }
            Action::Say(text) => self.speech.say(text, &user),
            Action::Walk(speeds) => self.walk(user, speeds),
            Action::Track(track) => self.follow(user, &track),
            Action::Print(text) => self.shared.state().print(user, text),
        }
        self.speak();
        self.send_quiet();
    }

    /// Colour and brightness together are one colour.
    fn shine(&mut self, change: impl FnOnce(&mut NaoState)) {
        let mut state = self.shared.state();
        change(&mut state);
        state.eyes = state.eye_color.map(|part| part * state.eye_brightness);
        self.slots.insert("eyes", shine(state.eyes));
    }

    /// A Stop forgets everything; the stop link ends it on the robot.
    fn look_at_gate(&mut self) {
        let stop_generation = self.shared.stop_generation();
        if stop_generation != self.stop_generation {
            self.stop_generation = stop_generation;
            self.slots.clear();
            self.targets.clear();
            self.speech.clear();
            // What is still on its way by this link may come after the Stop by the other one: it is ended behind it.
            if self.speech.cut() {
                self.post(ServiceCall::new("ALTextToSpeech", "stopAll", []));
            }
            self.freeze();
            self.lasting.clear();
            self.voicing.end(&self.session, &self.shared);
            self.darken(|_| true);
            self.hide(|_| true);
            self.show();
        }
    }

    /// A use ends: what it does ends, and nobody else's.
    pub(crate) fn close(&mut self, user: &Use) {
        self.look_at_gate();
        if self.speech.end(user) {
            self.post(ServiceCall::new("ALTextToSpeech", "stopAll", []));
        }
        self.leave(user);
        self.voicing.leave(&self.session, &self.shared, user);
        self.darken(|by| by == user);
        self.hide(|by| by == user);
        self.lasting.leave(user).into_iter().for_each(|call| self.post(call));
        self.show();
    }

    /// Begins an installed behaviour, unless it runs; another one ends first.
    fn run_behavior(&mut self, user: Use, name: String) {
        let what = format!("{BEHAVIOR}{name}");
        let call = |method| ServiceCall::new("ALBehaviorManager", method, [name.as_str().into()]);
        let mut calls = self.lasting.replace(BEHAVIOR, &what);
        // Stopped at the end, should it be one of those that go on for ever.
        calls.extend([call("runBehavior"), call("stopBehavior")]);
        let work = LastingWork { what, calls, end: vec![call("stopBehavior")], within: BEHAVIOR_WITHIN };
        self.shared.state().animations.insert(name);
        self.lasting.begin(&self.session, &self.done, user, work);
        self.show();
    }

    /// These lights are the robot's own again.
    fn darken(&mut self, whose: impl Fn(&Use) -> bool) {
        let groups: Vec<Slot> = self.lit.iter().filter(|(_, by)| whose(by)).map(|(group, _)| *group).collect();
        for group in groups {
            self.lit.remove(group);
            self.slots.remove(group);
            self.post(ServiceCall::new("ALLeds", "reset", [group.into()]));
        }
    }

    /// The tablet shows what the robot wants.
    fn hide(&mut self, whose: impl Fn(&Use) -> bool) {
        if self.shown.take_if(|by| whose(by)).is_some() {
            self.slots.remove(TABLET);
            self.in_turn(["hideWebview", "hideImage"].map(|method| ServiceCall::new(TABLET, method, [])).to_vec());
        }
    }

    /// Of a kind that was quiet for a cycle the first is sent at once.
    fn send_quiet(&mut self) {
        let now = Instant::now();
        self.sent.retain(|_, at| now.duration_since(*at) < self.cycle);
        self.send_newest();
    }

    /// Sends everything that is due at the motion cycle.
    pub(crate) fn cycle(&mut self) {
        self.look_at_gate();
        let now = Instant::now();
        self.go_on(now);
        self.sent.retain(|_, at| now.duration_since(*at) < self.cycle / 4 * 3);
        self.send_newest();
    }

    /// One of a kind is on its way at a time, and one in a cycle; meanwhile the newest waits.
    fn send_newest(&mut self) {
        let is_free = |slot: &Slot| !self.under_way.contains(slot) && !self.sent.contains_key(slot);
        let free: Vec<Slot> = self.slots.keys().filter(|slot| is_free(slot)).copied().collect();
        let joints_are_free = is_free(&JOINTS);
        for slot in free {
            if let Some(wanted) = self.slots.remove(slot) {
                self.send(slot, vec![wanted]);
            }
        }
        if joints_are_free {
            let wanted = self.targets.take();
            if !wanted.is_empty() {
                self.send(JOINTS, wanted);
            }
        }
    }

    /// Calls of one kind, at once.
    fn send(&mut self, slot: Slot, calls: Vec<ServiceCall>) {
        self.under_way.insert(slot);
        self.sent.insert(slot, Instant::now());
        let (session, done) = (self.session.clone(), self.done.clone());
        tokio::spawn(async move {
            join_all(calls.iter().map(|wanted| attempt(&session, wanted, CALL))).await;
            let _over = done.send(Done::Slot(slot));
        });
    }

    /// Something came to its end.
    pub(crate) fn done(&mut self, done: Done) {
        self.look_at_gate();
        match done {
            Done::Slot(slot) => {
                self.under_way.remove(slot);
            }
            Done::Said => {
                self.speech.over();
                self.speak();
            }
            Done::Lasted(what, number, fault) => {
                let users = self.lasting.over(&what, number);
                let mut state = self.shared.state();
                state.animations.remove(what.strip_prefix(BEHAVIOR).unwrap_or(&what));
                fault.iter().for_each(|fault| users.iter().for_each(|user| state.refuse(user, fault)));
                if what == "RememberFace" {
                    self.shared.looking.notify_one();
                }
            }
            Done::Seen(target) => return self.seen(target),
        }
        self.show();
    }

    /// Calls, one after the other, unless a Stop comes between.
    fn in_turn(&self, calls: Vec<ServiceCall>) {
        let (session, shared, stop_generation) = (self.session.clone(), Arc::clone(&self.shared), self.stop_generation);
        tokio::spawn(async move { each(&session, &shared, stop_generation, calls).await });
    }

    fn post(&self, wanted: ServiceCall) {
        self.in_turn(vec![wanted]);
    }

    /// A text is said piece by piece, so that the robot is silent soon when it hears no more of us.
    fn speak(&mut self) {
        let Some((text, cut)) = self.speech.begin() else { return };
        let (session, shared, done, stop_generation) =
            (self.session.clone(), Arc::clone(&self.shared), self.done.clone(), self.stop_generation);
        // It would hear itself.
        let hears = self.shared.state().subscribed.uses(HEARING);
        let pause = move |pauses: bool| hears.then(|| ServiceCall::new(HEARING, "pause", [pauses.into()]));
        tokio::spawn(async move {
            if let Some(wanted) = pause(true) {
                attempt(&session, &wanted, CALL).await;
            }
            let speed = shared.state().voice_speed;
            for piece in phrases::pieces(&text, speed) {
                if cut.load(Ordering::SeqCst) || shared.stop_generation() != stop_generation {
                    break;
                }
                let within = SAY + SAY_CHAR * u32::try_from(piece.chars().count()).unwrap_or(u32::MAX);
                if let Err(error) = voicing::say(&session, &shared, &piece, within).await {
                    tracing::debug!(%error, "the robot did not say it");
                    break;
                }
            }
            if let Some(wanted) = pause(false) {
                attempt(&session, &wanted, CALL).await;
            }
            let _over = done.send(Done::Said);
        });
        self.show();
    }

    /// Notes what people see of it.
    fn show(&self) {
        let mut state = self.shared.state();
        self.speech.saying().clone_into(&mut state.saying);
        state.tracking = self.moving.tracking();
        state.playing = self.lasting.names();
    }
}

/// Calls, one after the other, unless a Stop comes between.
async fn each(session: &Session, shared: &NaoShared, stop_generation: u64, calls: Vec<ServiceCall>) {
    for wanted in calls {
        if shared.stop_generation() != stop_generation {
            return;
        }
        attempt(session, &wanted, CALL).await;
    }
}

/// Calls; what the robot does not do is in the log.
pub(crate) async fn attempt(session: &Session, wanted: &ServiceCall, within: Duration) {
    if let Err(error) = call(session, wanted, within).await {
        tracing::debug!(method = wanted.method, %error, "the robot did not do it");
    }
}
