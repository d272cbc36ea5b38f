//! What the robot does for behaviours: the newest of each kind at the motion cycle, one voice, one walk with its dead-man's
//! switch, one target, and what takes its time. Nothing here is waited for; what was wanted before a Stop is void.

use crate::deed::{Call, Deed, Track};
use crate::lasting::{Lastings, Work};
use crate::link::{CALL, call};
use crate::shared::Shared;
use crate::speech::Speech;
use crate::targets::Targets;
use crate::voicing::{self, Voicing};
use futures_util::future::join_all;
use qi::{Session, Value};
use robot::Use;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tokio::sync::mpsc;

/// It walks for so long after a value: the dead-man's switch.
const WALK_HOLD: Duration = Duration::from_millis(500);
/// It follows for so long after a value.
const TRACK_HOLD: Duration = Duration::from_millis(1_000);
/// How long speaking a text may take at most, beside so much for each character.
const SAY: Duration = Duration::from_secs(15);
const SAY_CHAR: Duration = Duration::from_millis(150);
/// How fast joints go back to where they are, as a fraction of the top speed.
const HOLD_SPEED: f64 = 0.3;

/// A kind of which only the newest counts.
type Slot = &'static str;
/// What the names of animations begin with.
const ANIMATION: &str = "animations/";
/// What stands before the name of an installed behaviour, among all that may last.
const BEHAVIOR: &str = "behaviour ";
/// The longest that an installed behaviour may take.
const BEHAVIOR_WITHIN: Duration = Duration::from_secs(600);
/// What has the tablet, and the kind of everything that it shows.
const TABLET: Slot = "ALTabletService";
/// The kind of everything that joints do.
const JOINTS: Slot = "joints";
/// What hears words, and its own voice too.
const HEARING: &str = "ALSpeechRecognition";

/// What came to its end.
pub(crate) enum Done {
    Slot(Slot),
    Said,
    Lasted(String, u64),
}

/// What the tracker was set to last, with the gate of that, for whose turn it is; and the number of the newest that wants to
/// set it.
#[derive(Default)]
struct Tracker {
    set: tokio::sync::Mutex<(u64, Vec<Call>)>,
    newest: AtomicU64,
}

/// Everything that is being done.
pub(crate) struct Acting {
    session: Session,
    shared: Arc<Shared>,
    done: mpsc::UnboundedSender<Done>,
    gate: u64,
    slots: BTreeMap<Slot, Call>,
    targets: Targets,
    under_way: BTreeSet<Slot>,
    /// When one of a kind was sent, in this cycle.
    sent: BTreeMap<Slot, Instant>,
    /// The motion cycle of the robot.
    cycle: Duration,
    speech: Speech,
    walk: Option<(Use, [f64; 3], Instant)>,
    track: Option<(Use, Track, Instant)>,
    tracker: Arc<Tracker>,
    lasting: Lastings,
    voicing: Voicing,
    /// Groups of lights that are not the robot's own now, and who lit them.
    lit: BTreeMap<Slot, Use>,
    /// Who shows something on the tablet.
    shown: Option<Use>,
    /// Where the head goes: how far it may nod depends on it.
    yaw: f64,
    /// Who moved joints last, to hold them when that ends.
    movers: BTreeMap<&'static str, Use>,
}

impl Acting {
    pub(crate) fn new(
        session: Session,
        shared: Arc<Shared>,
        done: mpsc::UnboundedSender<Done>,
        cycle: Duration,
    ) -> Self {
        let gate = shared.gate();
        Self {
            session,
            shared,
            done,
            gate,
            slots: BTreeMap::new(),
            targets: Targets::default(),
            under_way: BTreeSet::new(),
            sent: BTreeMap::new(),
            cycle,
            speech: Speech::default(),
            walk: None,
            track: None,
            tracker: Arc::default(),
            lasting: Lastings::default(),
            voicing: Voicing::default(),
            lit: BTreeMap::new(),
            shown: None,
            yaw: 0.0,
            movers: BTreeMap::new(),
        }
    }

    /// Does what is wanted, if no Stop came since.
    pub(crate) fn act(&mut self, gate: u64, user: Use, deed: Deed) {
        self.look_at_gate();
        if gate != self.gate {
            return;
        }
        match deed {
            Deed::Newest { slot, call } => drop(self.slots.insert(slot, call)),
            Deed::Eyes { color, call } => {
                self.slots.insert("eyes", call);
                self.shared.state().eyes = color;
            }
            Deed::Joints { joints, angles, speed } => self.move_joints(&user, joints, angles, speed),
            Deed::Lasting { what, calls, end, within, moves: _ } => {
                if what.starts_with(ANIMATION) {
                    self.shared.state().animations.insert(what.clone());
                }
                let work = Work { what, calls, end, within };
                self.lasting.begin(&self.session, &self.done, user, work);
                self.show();
            }
            Deed::Behavior(name) => self.run_behavior(user, name),
            Deed::Voice(manner) => self.voicing.set(&self.session, &self.shared, gate, user, manner),
            Deed::Light { group, call } => {
                self.slots.insert(group, call);
                self.lit.insert(group, user);
            }
            Deed::Tablet(call) => {
                self.slots.insert(TABLET, call);
                self.shown = Some(user);
            }
            Deed::Say(text) => self.speech.say(text, &user),
            Deed::Walk(speeds) => self.walk(user, speeds),
            Deed::Track(track) => self.follow(user, track),
            Deed::Print(text) => self.shared.state().print(user, text),
        }
        self.speak();
        self.send_quiet();
    }

    /// A Stop forgets everything; the stop link ends it on the robot.
    fn look_at_gate(&mut self) {
        let gate = self.shared.gate();
        if gate != self.gate {
            self.gate = gate;
            self.slots.clear();
            self.targets.clear();
            self.speech.clear();
            // What is still on its way by this link may come after the Stop by the other one: it is ended behind it.
            if self.walk.is_some() || self.under_way.contains("walk") {
                self.stand();
            }
            if self.track.is_some() {
                self.unfollow();
            }
            if !self.speech.saying().is_empty() {
                self.post(Call::new("ALTextToSpeech", "stopAll", []));
            }
            self.lasting.clear();
            self.voicing.end(&self.session, &self.shared);
            self.darken(|_| true);
            self.hide(|_| true);
            self.movers.clear();
            self.show();
        }
    }

    /// A use ends: what it does ends, and nobody else's.
    pub(crate) fn close(&mut self, user: &Use) {
        self.look_at_gate();
        if self.speech.end(user) {
            self.post(Call::new("ALTextToSpeech", "stopAll", []));
        }
        if self.walk.as_ref().is_some_and(|walk| walk.0 == *user) {
            self.stand();
        }
        if self.track.as_ref().is_some_and(|track| track.0 == *user) {
            self.unfollow();
        }
        self.voicing.leave(&self.session, &self.shared, user);
        self.darken(|by| by == user);
        self.hide(|by| by == user);
        self.lasting.leave(user).into_iter().for_each(|call| self.post(call));
        self.hold(user);
        self.show();
    }

    /// Begins an installed behaviour, unless it runs; another one ends first.
    fn run_behavior(&mut self, user: Use, name: String) {
        let what = format!("{BEHAVIOR}{name}");
        let call = |method| Call::new("ALBehaviorManager", method, [name.as_str().into()]);
        let mut calls = self.lasting.replace(BEHAVIOR, &what);
        // Stopped at the end, should it be one of those that go on for ever.
        calls.extend([call("runBehavior"), call("stopBehavior")]);
        let work = Work { what, calls, end: vec![call("stopBehavior")], within: BEHAVIOR_WITHIN };
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
            self.post(Call::new("ALLeds", "reset", [group.into()]));
        }
    }

    /// The tablet shows what the robot wants.
    fn hide(&mut self, whose: impl Fn(&Use) -> bool) {
        if self.shown.take_if(|by| whose(by)).is_some() {
            self.slots.remove(TABLET);
            self.in_turn(["hideWebview", "hideImage"].map(|method| Call::new(TABLET, method, [])).to_vec());
        }
    }

    /// The joints that a use moved last stay where they are.
    fn hold(&mut self, user: &Use) {
        let own: Vec<&'static str> =
            self.movers.iter().filter(|(_, mover)| *mover == user).map(|(joint, _)| *joint).collect();
        self.movers.retain(|_, mover| mover != user);
        let angles: Vec<f64> = {
            let state = self.shared.state();
            own.iter().filter_map(|joint| state.angles.get(*joint).copied()).collect()
        };
        if own.len() == angles.len() {
            own.iter().zip(angles).for_each(|(joint, angle)| self.targets.want(joint, angle, HOLD_SPEED));
        }
    }

    /// Of a kind that was quiet for a cycle the first is sent at once.
    fn send_quiet(&mut self) {
        let now = Instant::now();
        self.sent.retain(|_, at| now.duration_since(*at) < self.cycle);
        self.send_newest();
    }

    /// What is due at the motion cycle.
    pub(crate) fn cycle(&mut self) {
        self.look_at_gate();
        let now = Instant::now();
        if self.walk.as_ref().is_some_and(|walk| now.duration_since(walk.2) > WALK_HOLD) {
            self.stand();
        }
        if self.track.as_ref().is_some_and(|track| now.duration_since(track.2) > TRACK_HOLD) {
            self.unfollow();
        }
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
    fn send(&mut self, slot: Slot, calls: Vec<Call>) {
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
            Done::Lasted(what, number) => {
                self.lasting.over(&what, number);
                self.shared.state().animations.remove(what.strip_prefix(BEHAVIOR).unwrap_or(&what));
                if what == "RememberFace" {
                    self.shared.looking.notify_one();
                }
            }
        }
        self.show();
    }

    fn move_joints(&mut self, user: &Use, joints: Vec<&'static str>, angles: Vec<f64>, speed: f64) {
        if let Some(yaw) = joints.iter().zip(&angles).find(|(joint, _)| **joint == "HeadYaw") {
            self.yaw = *yaw.1;
        }
        let (angles, there): (Vec<f64>, Vec<bool>) = {
            let state = self.shared.state();
            // Where the head was sent last, unless something else has moved it since.
            let sent = joints.contains(&"HeadYaw") || self.movers.contains_key("HeadYaw");
            let yaw = if sent { self.yaw } else { state.angles.get("HeadYaw").copied().unwrap_or_default() };
            let clip = |(joint, angle): (&&str, &f64)| state.limits.clip(joint, *angle, yaw);
            let there = joints.iter().map(|joint| state.joints.iter().any(|known| known == joint)).collect();
            (joints.iter().zip(&angles).map(clip).collect(), there)
        };
        for (joint, angle) in
            joints.into_iter().zip(angles).zip(there).filter(|(_, there)| *there).map(|(wanted, _)| wanted)
        {
            self.movers.insert(joint, user.clone());
            self.targets.want(joint, angle, speed);
        }
    }

    fn walk(&mut self, user: Use, speeds: [f64; 3]) {
        if self.track.as_ref().is_some_and(|track| track.1.mode != "Head") {
            self.unfollow();
        }
        let arguments: Vec<Value> = speeds.iter().map(|speed| Value::F32(*speed as f32)).collect();
        self.slots.insert("walk", Call::new("ALMotion", "move", arguments));
        self.walk = Some((user, speeds, Instant::now()));
    }

    fn stand(&mut self) {
        self.walk = None;
        self.slots.remove("walk");
        self.post(Call::new("ALMotion", "stopMove", []));
    }

    fn follow(&mut self, user: Use, track: Track) {
        let now = Instant::now();
        if let Some((by, same, at)) = &mut self.track
            && *same == track
        {
            (*by, *at) = (user, now);
            return;
        }
        if track.mode != "Head" && self.walk.is_some() {
            self.stand();
        }
        let size = Value::dynamic(track.size as f32);
        let calls = vec![
            Call::new("ALTracker", "stopTracker", []),
            Call::new("ALTracker", "registerTarget", [track.target.into(), size]),
            Call::new("ALTracker", "setMode", [track.mode.into()]),
            Call::new("ALTracker", "setEffector", [track.effector.into()]),
            Call::new("ALTracker", "track", [track.target.into()]),
        ];
        self.turn_tracker(calls);
        self.track = Some((user, track, now));
        self.show();
    }

    fn unfollow(&mut self) {
        self.track = None;
        let calls = ["stopTracker", "unregisterAllTargets"].map(|method| Call::new("ALTracker", method, []));
        self.turn_tracker(calls.to_vec());
        self.show();
    }

    /// The tracker is set to one thing after the other, each whole; of what waits for that only the newest counts.
    fn turn_tracker(&self, calls: Vec<Call>) {
        let (session, shared, gate) = (self.session.clone(), Arc::clone(&self.shared), self.gate);
        let tracker = Arc::clone(&self.tracker);
        let number = tracker.newest.fetch_add(1, Ordering::SeqCst) + 1;
        tokio::spawn(async move {
            let mut set = tracker.set.lock().await;
            let wanted = (gate, calls);
            if tracker.newest.load(Ordering::SeqCst) == number && *set != wanted {
                each(&session, &shared, gate, wanted.1.clone()).await;
                *set = wanted;
            }
        });
    }

    /// Calls, one after the other, unless a Stop comes between.
    fn in_turn(&self, calls: Vec<Call>) {
        let (session, shared, gate) = (self.session.clone(), Arc::clone(&self.shared), self.gate);
        tokio::spawn(async move { each(&session, &shared, gate, calls).await });
    }

    fn post(&self, wanted: Call) {
        self.in_turn(vec![wanted]);
    }

    fn speak(&mut self) {
        if let Some(text) = self.speech.begin() {
            let (session, done) = (self.session.clone(), self.done.clone());
            let within = SAY + SAY_CHAR * u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
            let shared = Arc::clone(&self.shared);
            // It would hear itself.
            let hears = self.shared.state().subscribed.iter().any(|(service, _)| *service == HEARING);
            let pause = move |pauses: bool| hears.then(|| Call::new(HEARING, "pause", [pauses.into()]));
            tokio::spawn(async move {
                if let Some(wanted) = pause(true) {
                    attempt(&session, &wanted, CALL).await;
                }
                if let Err(error) = voicing::say(&session, &shared, &text, within).await {
                    tracing::debug!(%error, "the robot did not say it");
                }
                if let Some(wanted) = pause(false) {
                    attempt(&session, &wanted, CALL).await;
                }
                let _over = done.send(Done::Said);
            });
            self.show();
        }
    }

    /// What people see of it.
    fn show(&self) {
        let mut state = self.shared.state();
        self.speech.saying().clone_into(&mut state.saying);
        state.tracking = self.track.as_ref().map_or_else(String::new, |(_, track, _)| {
            let target = if track.target == "Face" { "face" } else { "red ball" };
            format!("{target} with {}", if track.mode == "Head" { "head" } else { "whole body" })
        });
        state.playing = self.lasting.names();
    }
}

/// Calls, one after the other, unless a Stop comes between.
async fn each(session: &Session, shared: &Shared, gate: u64, calls: Vec<Call>) {
    for wanted in calls {
        if shared.gate() != gate {
            return;
        }
        attempt(session, &wanted, CALL).await;
    }
}

/// Calls; what the robot does not do is in the log.
pub(crate) async fn attempt(session: &Session, wanted: &Call, within: Duration) {
    if let Err(error) = call(session, wanted, within).await {
        tracing::debug!(method = wanted.method, %error, "the robot did not do it");
    }
}
