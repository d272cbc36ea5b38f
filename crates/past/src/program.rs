//! The programs that ran, and how a run of one is built.

use crate::hook::Hook;
use behaviour::{BehaviourFile, Lookup, StreamKind};
use engine::{GraphFault, Limits, Run};
use phrase::{Phrase, Phrased};
use protocol::{NotSeen, PastProgram, PastStream};

/// A program that ran.
#[derive(Debug)]
pub(crate) struct PlayedProgram {
    pub(crate) file: BehaviourFile,
    pub(crate) about: PastProgram,
    /// By place in the file the place of each stream among all that ran.
    pub(crate) places: Vec<usize>,
    /// Roughly the bytes that it takes.
    pub(crate) bytes: usize,
}

/// Roughly the bytes that a program takes, with what is known of its streams.
pub(crate) fn program_bytes(file: &BehaviourFile) -> usize {
    4_096 + recording::json(file).len() * 3
}

/// The streams of all programs.
#[derive(Debug, Default)]
pub(crate) struct KnownStreams {
    pub(crate) all: Vec<PastStream>,
    by_id: Lookup<String, usize>,
}

impl KnownStreams {
    /// The places of the streams of a program.
    pub(crate) fn places(&mut self, file: &BehaviourFile) -> Vec<usize> {
        let all = &mut self.all;
        let by_id = &mut self.by_id;
        let place = |stream: &behaviour::FileStream| {
            *by_id.entry(stream.id.clone()).or_insert_with(|| {
                all.push(PastStream {
                    stream: stream.id.clone(),
                    name: stream.name.clone(),
                    kind: stream.kind,
                    device: stream.device.clone(),
                    params: stream.params.clone().unwrap_or_default(),
                    count: 0,
                    numbers: false,
                    fields: Vec::new(),
                });
                all.len() - 1
            })
        };
        file.streams.iter().map(place).collect()
    }

    /// The place of a stream.
    pub(crate) fn place(&self, id: &str) -> Option<usize> {
        self.by_id.get(id).copied()
    }
}

/// Builds a run that ends once the hook says so.
///
/// # Errors
/// The first reason why it cannot run.
pub(crate) fn build(file: &BehaviourFile, hook: &Hook) -> Result<Run, Phrase> {
    let over = hook.clone();
    let first = |faults: Vec<GraphFault>| faults.first().map(Phrased::phrase).unwrap_or_default();
    Run::build(file, Limits::default().stopped_by(move || over())).map_err(first)
}

/// Builds a run of a program that ran.
///
/// # Errors
/// If it cannot run here.
pub(crate) fn rebuild(file: &BehaviourFile, hook: &Hook) -> Result<Run, NotSeen> {
    build(file, hook).map_err(NotSeen::CannotRun)
}

/// True for the streams whose values are actions of the robot.
pub(crate) fn is_action(file: &BehaviourFile, stream: usize) -> bool {
    file.streams.get(stream).is_some_and(|stream| stream.kind == StreamKind::Actuator)
}
