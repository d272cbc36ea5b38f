//! A rehearsal: a behaviour, the simulated NAO and things that people do, on one virtual clock and without a server.

use behaviour::{BehaviourFile, Id, StreamKind, Value};
use engine::{Emission, Limits, Run, StreamIx};
use robot::{Millis, Reading, Robot, Scene, SceneEdit, Use};
use simulation::{SimulatedNao, Spoken};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::{Outcome, Trouble};

/// Length of a step in milliseconds.
const STEP_MS: u64 = 10;
/// Time between two pictures of the room in a report, in milliseconds.
const PICTURE_MS: u64 = 100;
/// The longest rehearsal, in milliseconds: ten minutes.
const UNTIL_MAX_MS: u64 = 600_000;
/// The number of the one run.
const RUN: u64 = 1;

/// The edits that people make in the scene, each with its time.
pub type Script = [(Millis, SceneEdit)];

/// The report of a rehearsal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The commands that the behaviour told its actions, in order.
    pub commands: Vec<Told>,
    /// The faults, in order: procedures that failed and commands that the robot dropped.
    pub troubles: Vec<(Millis, String)>,
    /// The sentences that the robot said.
    pub spoken: Vec<Spoken>,
    /// The room every tenth of a second, from 0 on.
    pub scenes: Vec<Scene>,
    /// A fingerprint of the robot and its room at the end.
    pub state_hash: u64,
}

/// A value for an action.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// The time of the value.
    pub at: Millis,
    /// The id of the actuator stream.
    pub stream: String,
    /// The value.
    pub value: Value,
}

/// Runs a behaviour on a simulated NAO until that time, with what people do meanwhile. The same arguments give the
/// same report.
///
/// # Errors
/// Fails if the behaviour cannot run on this robot, or if something in the script cannot be done.
pub fn rehearse(file: &BehaviourFile, seed: u64, script: &Script, until: Millis) -> Outcome<Report> {
    rehearse_blind(file, seed, script, &[], until)
}

/// Times in which a robot finds no face, though one may be in view, in milliseconds.
pub type Blind = [Range<u64>];

/// Runs a behaviour as [`rehearse`] does, with times in which the robot finds no face.
///
/// # Errors
/// Fails if the behaviour cannot run on this robot, or if something in the script cannot be done.
pub fn rehearse_blind(
    file: &BehaviourFile,
    seed: u64,
    script: &Script,
    blind: &Blind,
    until: Millis,
) -> Outcome<Report> {
    if until.0 > UNTIL_MAX_MS {
        return Err(Trouble(format!("a rehearsal takes at most {UNTIL_MAX_MS} ms")));
    }
    let mut rehearsal = Rehearsal::new(file, seed)?;
    let mut edits: Vec<_> = script.iter().collect();
    edits.sort_by_key(|edit| edit.0);
    let mut edits = edits.into_iter().peekable();
    for now in (0..=until.0).step_by(STEP_MS as usize).map(Millis) {
        while let Some((_, edit)) = edits.next_if(|edit| edit.0 <= now) {
            rehearsal.robot.edit(edit).map_err(|fault| Trouble(fault.to_string()))?;
        }
        let is_blind = blind.iter().any(|time| time.contains(&now.0));
        rehearsal.step(now, is_blind);
    }
    Ok(rehearsal.finish())
}

struct Rehearsal {
    robot: SimulatedNao,
    run: Run,
    /// The actions by their streams.
    actions: BTreeMap<StreamIx, Use>,
    /// The streams that faces come to.
    faces: BTreeSet<Id>,
    readings: Vec<Reading>,
    report: Report,
}

impl Rehearsal {
    fn new(file: &BehaviourFile, seed: u64) -> Outcome<Self> {
        let said = |faults: Vec<engine::GraphFault>| {
            let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
            Trouble(format!("{} cannot run:\n  {}", file.name, lines.join("\n  ")))
        };
        let run = Run::build(file, Limits::default()).map_err(said)?;
        let mut robot = SimulatedNao::new(seed);
        let actions = open(&mut robot, &run, StreamKind::Actuator)?;
        open(&mut robot, &run, StreamKind::Sensor)?;
        let faces = run.streams().enumerate().filter(|(_, info)| info.device.as_deref() == Some("FaceDetection"));
        let faces = faces.map(|(_, info)| Id::new(&info.id)).collect::<Result<_, _>>()?;
        Ok(Self { robot, run, actions, faces, readings: Vec::new(), report: Report::default() })
    }

    /// Senses, then the behaviour, then the actions of one step.
    fn step(&mut self, now: Millis, is_blind: bool) {
        self.robot.poll(now, &mut self.readings);
        if is_blind {
            self.readings.retain(|reading| !self.faces.contains(&reading.to.stream));
        }
        let (report, actions, mut emitted) = (&mut self.report, &self.actions, Vec::new());
        let mut note = |emission: Emission| match emission {
            Emission::Value { at, stream, value, .. } => {
                emitted.extend(actions.get(&stream).map(|user| (at, user, value.clone())));
            }
            Emission::Fault { at, error, .. } => report.troubles.push((at, error.to_string())),
        };
        for reading in self.readings.drain(..) {
            if let Some(stream) = self.run.stream_index(reading.to.stream.as_str()) {
                self.run.feed(reading.at, stream, reading.value, &mut note);
            }
        }
        self.run.until(now, &mut note);
        for (at, user, value) in emitted {
            if let Err(reason) = self.robot.command(user, &value, now) {
                report.troubles.push((at, format!("{}: {reason}", user.stream)));
            }
            report.commands.push(Told { at, stream: user.stream.to_string(), value });
        }
        if now.0.is_multiple_of(PICTURE_MS) {
            report.scenes.push(self.robot.scene());
        }
    }

    fn finish(mut self) -> Report {
        self.report.spoken = self.robot.spoken().to_vec();
        self.report.state_hash = self.robot.state_hash();
        self.report
    }
}

/// Opens the devices of all streams of a kind, in file order.
fn open(robot: &mut SimulatedNao, run: &Run, kind: StreamKind) -> Outcome<BTreeMap<StreamIx, Use>> {
    let mut uses = BTreeMap::new();
    for (index, info) in run.streams().enumerate().filter(|(_, info)| info.kind == kind) {
        let user = Use { run: RUN, stream: Id::new(&info.id)? };
        let device = info.device.as_deref().unwrap_or_default();
        let opened = robot.open(&user, device, &info.params);
        opened.map_err(|reason| Trouble(format!("“{}”: {reason}", info.name)))?;
        uses.insert(index, user);
    }
    Ok(uses)
}
