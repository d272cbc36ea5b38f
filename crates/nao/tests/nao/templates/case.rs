//! A template with what people do, phase by phase, and what has to become of it on both robots.

use super::log::{Call, Log, Noted, moved};
use super::play::{Newest, Play, alike};
use super::world::Change;
use crate::driver::Driver;
use crate::peer::Peer;
use behaviour::BehaviourFile;
use nao::Nao;
use robot::Robot;
use serde_json::{Value as Json, json};
use simulation::SimulatedNao;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::{Duration, Instant};

/// A step of the simulation, in milliseconds.
const SIMULATED_MS: u64 = 10;
/// Between two steps on the stand-in.
const PAUSE: Duration = Duration::from_millis(5);
/// Steps between two looks at the log.
const LOOK: u64 = 10;
/// Before a phase that never becomes as it should is given up.
const PATIENCE: Duration = Duration::from_secs(30);
/// The most values of before a change that may still be on their way.
const LATE: usize = 2;

/// The calls that have to come in a phase.
pub(crate) enum Wanted {
    /// These calls in this order.
    These(Vec<Call>),
    /// These calls, each once: they begin at the same moment at different services.
    Together(Vec<Call>),
    /// All of the first, and of the second what may come besides, in any order.
    Parts(Vec<Call>, Vec<Call>),
}

/// A change of the room and what comes of it.
pub(crate) struct Phase {
    pub(crate) changes: &'static [Change],
    /// For so long at least, in milliseconds of robot time.
    pub(crate) for_ms: u64,
    pub(crate) wanted: Wanted,
}

/// A template and how it is tried.
pub(crate) struct Case {
    /// The file's name.
    pub(crate) template: &'static str,
    /// A step on the stand-in in milliseconds of robot time, which may go some times as fast as that of the clock.
    pub(crate) step_ms: u64,
    /// True if the same call may come again and again.
    pub(crate) again: bool,
    /// Streams whose values differ on the two robots, of which only the form is compared.
    pub(crate) apart: &'static [&'static str],
    /// The service and stream of every subscription, and the events that are heard.
    pub(crate) subscribed: &'static [(&'static str, &'static str)],
    pub(crate) heard: &'static [&'static str],
    /// The colours that are looked for, in turn: red, green, blue and how far they may be off.
    pub(crate) colors: &'static [[i32; 4]],
    pub(crate) phases: Vec<Phase>,
}

pub(crate) fn phase(changes: &'static [Change], for_ms: u64, calls: Vec<Call>) -> Phase {
    Phase { changes, for_ms, wanted: Wanted::These(calls) }
}

/// Returns a phase in which these parts of the body follow something, and perhaps those.
pub(crate) fn follows(
    changes: &'static [Change],
    for_ms: u64,
    parts: &[&'static str],
    perhaps: &[&'static str],
) -> Phase {
    let calls = |parts: &[&'static str]| parts.iter().map(|part| moved(part)).collect();
    Phase { changes, for_ms, wanted: Wanted::Parts(calls(parts), calls(perhaps)) }
}

/// Both robots with the same graph.
struct Both {
    case: Case,
    peer: Peer,
    real: Play<Nao>,
    simulated: Play<SimulatedNao>,
    log: Log,
}

impl Case {
    /// A template in which nothing happens yet.
    pub(crate) fn of(template: &'static str) -> Self {
        Self {
            template,
            step_ms: 20,
            again: false,
            apart: &[],
            subscribed: &[],
            heard: &[],
            colors: &[],
            phases: Vec::new(),
        }
    }

    /// Plays it. Without libqi nothing is done, which is said.
    pub(crate) async fn hold(self) {
        let Some(peer) = Peer::start(&format!("nao: the template {}", self.template), &[]).await else { return };
        peer.world(json!({"speech_ms_per_char": 5, "face_unknown_ms": 500})).await;
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/behaviours").join(self.template);
        let file: BehaviourFile =
            serde_json::from_str(&std::fs::read_to_string(path.with_extension("json")).unwrap()).unwrap();
        let nao = Driver::at(&peer.address).await.nao;
        let mut simulated = SimulatedNao::new(7);
        change(&peer, &mut simulated, self.phases[0].changes).await;
        peer.clear().await;
        let (real, simulated) = (Play::begin(&file, nao), Play::begin(&file, simulated));
        let mut both = Both { case: self, peer, real, simulated, log: Log::default() };
        both.begin().await;
        for number in 0..both.case.phases.len() {
            both.phase(number).await;
        }
        both.end().await;
    }
}

/// The same change on both.
async fn change(peer: &Peer, simulated: &mut SimulatedNao, changes: &[Change]) {
    for one in changes {
        peer.world(one.told()).await;
        one.edit().iter().for_each(|edit| simulated.edit(edit).unwrap());
    }
}

impl Both {
    /// Waits until all senses are there.
    async fn begin(&mut self) {
        let wanted = self.subscriptions();
        let heard = self.case.heard;
        self.until("all senses are there", |log, state| {
            let listened = state["listened"].as_array().unwrap();
            as_set(&log.begun) == wanted && heard.iter().all(|key| listened.contains(&json!(key)))
        })
        .await;
    }

    fn subscriptions(&self) -> BTreeSet<(String, String)> {
        let own = |(service, stream): &(&str, &str)| ((*service).to_owned(), format!("rrp-test/1/{stream}"));
        self.case.subscribed.iter().map(own).collect()
    }

    async fn until(&mut self, what: &str, is_so: impl Fn(&Log, &Json) -> bool) {
        let end = Instant::now() + PATIENCE;
        loop {
            self.steps().await;
            let state = self.peer.state().await;
            if is_so(&self.log, &state) {
                return;
            }
            let name = self.case.template;
            assert!(Instant::now() < end, "{name}, never: {what}; {:?} {:?} {state}", self.log.begun, self.log.ended);
        }
    }

    /// Some steps of the real one, and a look at the log.
    async fn steps(&mut self) {
        for _ in 0..LOOK {
            self.real.step(self.case.step_ms);
            tokio::time::sleep(PAUSE).await;
        }
        self.log.read(&self.peer).await;
    }

    async fn phase(&mut self, number: usize) {
        if number > 0 {
            change(&self.peer, &mut self.simulated.robot, self.case.phases[number].changes).await;
            self.real.newest.clear();
            self.simulated.newest.clear();
        }
        self.log.begin();
        let (first, began_ms) = (self.log.acting.len(), self.real.now_ms);
        let first = if number == 0 { 0 } else { first };
        let for_ms = self.case.phases[number].for_ms;
        for _ in 0..for_ms / SIMULATED_MS {
            self.simulated.step(SIMULATED_MS);
        }
        let end = Instant::now() + PATIENCE;
        loop {
            self.steps().await;
            let calls = self.log.since(first, self.case.again);
            let wrong = [
                wrong_calls(&self.case.phases[number].wanted, &calls),
                wrong_values(&self.real.newest, &self.simulated.newest, self.case.apart),
            ];
            if wrong.iter().all(Option::is_none) && self.real.now_ms >= began_ms + for_ms {
                return;
            }
            let (name, said) = (self.case.template, wrong.into_iter().flatten().collect::<Vec<_>>().join("\n"));
            let begun = begins(&self.case.phases[number].wanted, &calls);
            assert!(begun && Instant::now() < end, "{name}, phase {number}:\n{said}\n{:?}", self.real.robot.health());
        }
    }

    /// The run ends, and with it all that it did and measured.
    async fn end(mut self) {
        let (name, first) = (self.case.template, self.log.acting.len());
        self.real.end();
        let (wanted, heard) = (self.subscriptions(), self.case.heard);
        self.until("nothing is done or measured", |log, state| {
            let listened = state["listened"].as_array().unwrap();
            as_set(&log.ended) == wanted
                && heard.iter().all(|key| !listened.contains(&json!(key)))
                && [&state["tracking"], &state["speaking"]].iter().all(|none| none.is_null())
                && state["registered"] == json!([])
                && state["subscribers"] == json!({})
        })
        .await;
        let mut last = self.log.since(first, self.case.again);
        last.retain(|call| call.what != "ALTextToSpeech.stopAll");
        // What moved stays where it is.
        let held = |call: &Noted| ["head", "left arm", "right arm"].iter().any(|part| call.is(&moved(part)));
        assert!(last.iter().all(held), "{name}, at its end: {last:?}");
        for list in [&self.log.begun, &self.log.ended] {
            assert_eq!(list.len(), self.case.subscribed.len(), "{name}: each once: {list:?}");
        }
        let mut colors = self.log.colors.clone();
        colors.sort_by_key(ToString::to_string);
        assert_eq!(colors, self.case.colors.iter().map(|color| json!(color)).collect::<Vec<_>>(), "{name}");
        assert_eq!(self.real.troubles, [""; 0], "{name}");
        assert_eq!(self.simulated.troubles, [""; 0], "{name}, simulated");
        assert_eq!(self.real.shapes, self.simulated.shapes, "{name}: values of the same form");
        self.same_words().await;
        self.peer.was_safe().await;
    }

    /// Both said the same.
    async fn same_words(&self) {
        let state = self.peer.state().await;
        let spoken = state["spoken"].as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_owned());
        let mut said = [spoken.collect(), self.simulated.robot.spoken().iter().map(|one| one.text.clone()).collect()];
        if self.case.again {
            said.iter_mut().for_each(Vec::dedup);
        }
        let [real, simulated] = said;
        assert_eq!(real, simulated, "{}: the same words", self.case.template);
    }
}

fn as_set(list: &[(String, String)]) -> BTreeSet<(String, String)> {
    list.iter().cloned().collect()
}

/// True if the calls so far may still become those that are wanted.
fn begins(wanted: &Wanted, calls: &[Noted]) -> bool {
    match wanted {
        Wanted::These(wanted) => calls.len() <= wanted.len() && are(&wanted[..calls.len()], calls),
        Wanted::Together(wanted) => calls.iter().all(|call| wanted.iter().any(|wanted| call.is(wanted))),
        Wanted::Parts(wanted, perhaps) => {
            calls.iter().all(|call| wanted.iter().chain(perhaps).any(|wanted| call.is(wanted)))
        }
    }
}

/// True if the calls begin with these.
fn are(group: &[Call], calls: &[Noted]) -> bool {
    group.len() <= calls.len() && group.iter().zip(calls).all(|(wanted, call)| call.is(wanted))
}

/// Returns what is wrong with the calls of a phase, if anything is.
fn wrong_calls(wanted: &Wanted, calls: &[Noted]) -> Option<String> {
    let is_right = match wanted {
        Wanted::These(wanted) => wanted.len() == calls.len() && are(wanted, calls),
        Wanted::Together(wanted) => {
            wanted.len() == calls.len() && wanted.iter().all(|wanted| calls.iter().any(|call| call.is(wanted)))
        }
        Wanted::Parts(wanted, _) => wanted.iter().all(|wanted| calls.iter().any(|call| call.is(wanted))),
    };
    let said: Vec<String> = calls.iter().map(|call| format!("{}{}", call.what, call.args)).collect();
    let wanted = match wanted {
        Wanted::These(wanted) | Wanted::Together(wanted) => format!("{wanted:?}"),
        Wanted::Parts(wanted, perhaps) => format!("{wanted:?}, perhaps {perhaps:?}"),
    };
    (!is_right).then(|| format!("called: {}\n  not: {wanted}", said.join(" ")))
}

/// Returns what is wrong with the values of a phase, if anything is.
fn wrong_values(real: &Newest, simulated: &Newest, apart: &[&str]) -> Option<String> {
    let mut wrong = Vec::new();
    for (stream, (value, _)) in simulated.iter().filter(|(stream, _)| !apart.contains(&stream.as_str())) {
        let is = real.get(stream).map(|(value, _)| value);
        if is.is_none_or(|is| !alike(is, value)) {
            wrong.push(format!("{stream}: {is:?}, simulated {value:?}"));
        }
    }
    let more = real.iter().filter(|(stream, (_, count))| !simulated.contains_key(*stream) && *count > LATE);
    wrong.extend(more.map(|(stream, (value, _))| format!("{stream}: {value:?}, simulated nothing")));
    (!wrong.is_empty()).then(|| wrong.join("\n"))
}
