//! A run with its tracer: readings go in, and what was asked comes out.

use crate::cause::Cause;
use crate::tracer::Tracer;
use behaviour::{BehaviourFile, Value};
use engine::{Emission, Matching, Run, StreamIx};
use protocol::WhyNot;
use robot::Millis;
use std::sync::Arc;

/// A run that tells why.
pub struct Traced {
    file: BehaviourFile,
    run: Run,
    tracer: Tracer,
}

/// A question for a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The stream.
    pub stream: StreamIx,
    /// The instant.
    pub at: Millis,
    /// Of several values in that instant which one, from 0.
    pub nth: usize,
}

/// There is no such value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Absent {
    /// The number of values that the stream has in that instant.
    pub count: usize,
    /// The time of the last value before it.
    pub before: Option<Millis>,
    /// The time of the first value after it, among those that were played.
    pub after: Option<Millis>,
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
    pub fn resume(&mut self, memory: engine::Handover) {
        self.run.resume_from(memory, &Matching::between(&self.file, &self.file));
    }

    /// Tells why nothing came on a stream since `from`.
    pub fn why_not(&mut self, stream: StreamIx, from: Millis) -> WhyNot {
        if self.run.ended().is_some() { self.tracer.end() } else { self.tracer.settle() }
        self.tracer.why_not(stream, from)
    }

    /// Plays readings up to the instant that is asked for and finds the value.
    ///
    /// # Errors
    /// Where there is none, when there are others. The readings after that instant are played for it.
    pub fn find(
        &mut self,
        readings: impl IntoIterator<Item = (Millis, StreamIx, Value)>,
        asked: Asked,
    ) -> Result<Arc<Cause>, Absent> {
        let mut found = Found { asked, cause: None, absent: Absent::default() };
        let mut readings = readings.into_iter().peekable();
        while let Some((at, stream, value)) = readings.next_if(|(at, ..)| *at <= asked.at) {
            self.feed(at, stream, value, &mut |cause| found.hear(cause));
        }
        self.until(asked.at, &mut |cause| found.hear(cause));
        for (at, stream, value) in readings {
            if found.cause.is_some() || found.absent.after.is_some() {
                break;
            }
            self.feed(at, stream, value, &mut |cause| found.hear(cause));
        }
        found.cause.ok_or(found.absent)
    }
}

fn hear(tracer: &mut Tracer, emission: &Emission, out: &mut dyn FnMut(&Arc<Cause>)) {
    if let Some(cause) = tracer.hear(emission) {
        out(&cause);
    }
}

/// What was found so far.
struct Found {
    asked: Asked,
    cause: Option<Arc<Cause>>,
    absent: Absent,
}

impl Found {
    fn hear(&mut self, cause: &Arc<Cause>) {
        if cause.stream() != self.asked.stream {
            return;
        }
        match cause.at().cmp(&self.asked.at) {
            std::cmp::Ordering::Less => self.absent.before = Some(cause.at()),
            std::cmp::Ordering::Greater => self.absent.after = self.absent.after.or(Some(cause.at())),
            std::cmp::Ordering::Equal => {
                if self.absent.count == self.asked.nth {
                    self.cause = Some(cause.clone());
                }
                self.absent.count += 1;
            }
        }
    }
}
