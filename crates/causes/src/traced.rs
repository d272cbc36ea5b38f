//! A run with its tracer: readings go in, and what was asked comes out.

use crate::cause::Cause;
use crate::kept::KeptValue;
use crate::tracer::Tracer;
use behaviour::{BehaviourFile, Value};
use engine::{Emission, Handover, Matching, Run, StreamIx};
use protocol::WhyNot;
use robot::Millis;
use std::collections::VecDeque;
use std::sync::Arc;

/// A run that tells why.
pub struct Traced {
    file: BehaviourFile,
    run: Run,
    tracer: Tracer,
}

/// A moment of a run to which one can return: what the run and its tracer remember then.
#[derive(Clone)]
pub struct Snapshot {
    memory: Handover,
    tracer: Tracer,
}

impl Snapshot {
    /// Returns roughly how many bytes it takes, for who keeps many of them.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.memory.bytes() + self.tracer.bytes()
    }
}

/// The most values that are kept of a stretch, the newest ones.
const VALUES_MAX: usize = 10_000;

/// A stretch of time on a stream, with the values that came in it.
#[derive(Debug)]
pub struct Stretch {
    /// The stream, in the program that runs; none while that has it not.
    pub stream: Option<StreamIx>,
    /// The first instant.
    pub from: Millis,
    /// The last instant.
    pub until: Millis,
    /// The values, 10,000 at most.
    pub values: VecDeque<Arc<Cause>>,
    /// The time of the last value before it.
    pub before: Option<Millis>,
}

impl Stretch {
    /// A stretch of no stream yet.
    #[must_use]
    pub fn of(from: Millis, until: Millis) -> Self {
        Self { stream: None, from, until, values: VecDeque::new(), before: None }
    }

    /// Hears a value.
    pub fn hear(&mut self, cause: &Arc<Cause>) {
        if Some(cause.stream()) != self.stream || cause.at() > self.until {
            return;
        }
        if cause.at() < self.from {
            self.before = Some(cause.at());
            return;
        }
        if self.values.len() == VALUES_MAX {
            self.values.pop_front();
        }
        self.values.push_back(cause.clone());
    }
}

impl Traced {
    /// Traces a run of this file that begins.
    #[must_use]
    pub fn of(file: BehaviourFile, run: Run) -> Self {
        let tracer = Tracer::of(&file);
        Self { file, run, tracer }
    }

    /// Returns the run.
    #[must_use]
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// Returns the file that runs.
    #[must_use]
    pub fn file(&self) -> &BehaviourFile {
        &self.file
    }

    /// Returns the tracer.
    #[must_use]
    pub fn tracer(&self) -> &Tracer {
        &self.tracer
    }

    /// Gives a reading to a sensor stream; `out` hears each value with what caused it.
    pub fn feed(&mut self, at: Millis, stream: StreamIx, value: Value, out: &mut dyn FnMut(&Arc<Cause>)) {
        let tracer = &mut self.tracer;
        self.run.feed(at, stream, value, &mut |emission| hear(tracer, &emission, out));
    }

    /// Closes all instants up to and including `at`.
    pub fn until(&mut self, at: Millis, out: &mut dyn FnMut(&Arc<Cause>)) {
        let tracer = &mut self.tracer;
        self.run.until(at, &mut |emission| hear(tracer, &emission, out));
    }

    /// Ends a replay at `at`: a frame that has begun by then runs too.
    pub fn finish(&mut self, at: Millis, out: &mut dyn FnMut(&Arc<Cause>)) {
        let tracer = &mut self.tracer;
        self.run.finish(at, &mut |emission| hear(tracer, &emission, out));
    }

    /// An edited program goes on from here.
    pub fn follow(&mut self, file: BehaviourFile, mut run: Run, at: Millis) {
        let matching = Matching::between(&self.file, &file);
        run.resume_from(self.run.handover(), &matching);
        self.tracer.follow(&file, &matching, at);
        (self.file, self.run) = (file, run);
    }

    /// Remembers what an earlier run of the same program remembered, before it was fed anything.
    pub fn resume(&mut self, memory: Handover) {
        self.tracer.resume(&memory);
        self.run.resume_from(memory, &Matching::between(&self.file, &self.file));
    }

    /// Returns the moment as it is now. None while readings wait for the end of their frame.
    #[must_use]
    pub fn snapshot(&self) -> Option<Snapshot> {
        let (memory, mut tracer) = (self.run.handover(), self.tracer.clone());
        tracer.gather_no_more();
        self.run.is_between().then_some(Snapshot { memory, tracer })
    }

    /// Goes on from a moment of an earlier run of this file; `run` is one that begins.
    #[must_use]
    pub fn from_snapshot(file: BehaviourFile, mut run: Run, snapshot: Snapshot) -> Self {
        let Snapshot { memory, tracer } = snapshot;
        run.resume_from(memory, &Matching::between(&file, &file));
        Self { file, run, tracer }
    }

    /// From now on the values that tests keep back are gathered. Whoever asks for that takes them with [`Traced::kept`] after each
    /// reading, so that they are few.
    pub fn gather_kept(&mut self) {
        self.tracer.gather_kept();
    }

    /// Takes the values that tests of the program that runs kept back since this was asked last.
    pub fn kept(&mut self) -> impl Iterator<Item = KeptValue> {
        self.tracer.kept()
    }

    /// Tells why nothing came on a stream since `from`.
    pub fn why_not(&mut self, stream: StreamIx, from: Millis) -> WhyNot {
        if self.run.ended().is_some() {
            self.tracer.end()
        } else {
            self.tracer.settle()
        }
        self.tracer.why_not(stream, from)
    }

    /// Plays readings up to the end of a stretch, and closes it.
    pub fn play(&mut self, readings: impl IntoIterator<Item = (Millis, StreamIx, Value)>, stretch: &mut Stretch) {
        let until = stretch.until;
        for (at, stream, value) in readings.into_iter().take_while(|(at, ..)| *at <= until) {
            self.feed(at, stream, value, &mut |cause| stretch.hear(cause));
        }
        self.until(until, &mut |cause| stretch.hear(cause));
    }
}

fn hear(tracer: &mut Tracer, emission: &Emission, out: &mut dyn FnMut(&Arc<Cause>)) {
    if let Some(cause) = tracer.hear(emission) {
        out(&cause);
    }
}
