//! Plays a part of a past again: from a moment that is kept, reading by reading.

use crate::hook::Hook;
use crate::miss::NearestMisses;
use crate::past::Past;
use crate::program::rebuild;
use crate::segment::{Begins, PastSegment};
use crate::tape::TapedReading;
use causes::{Cause, Traced};
use engine::{ConnectorIx, Emission, End, Matching, Run, StreamIx};
use protocol::NotSeen;
use robot::Millis;
use std::sync::Arc;

/// Something that plays readings.
pub(crate) trait Plays {
    /// Takes a reading.
    fn feed(&mut self, reading: TapedReading);

    /// Closes all instants up to this one.
    fn until(&mut self, at_ms: u64);

    /// Comes to the next segment, all before which is closed.
    ///
    /// # Errors
    /// If its program cannot run.
    fn enter(&mut self, past: &Past, segment: usize) -> Result<(), NotSeen>;

    /// The reason why it goes no further, if it does not.
    fn ended(&self) -> Option<End>;

    /// True if its hook says that it takes too long.
    fn is_over(&self) -> bool;
}

/// Readings between two questions to the hook. A run asks it itself only where a procedure is long.
const ASKED_READINGS: usize = 64;

/// Plays from the beginning of a segment, at which the player is, up to a moment.
///
/// # Errors
/// If a program cannot run, or if the hook ended it.
pub(crate) fn play(past: &Past, from: usize, until_ms: u64, player: &mut dyn Plays) -> Result<(), NotSeen> {
    for (at, segment) in past.segments.iter().enumerate().skip(from) {
        if at > from {
            if segment.starts_ms > until_ms {
                break;
            }
            if let Some(closed_ms) = segment.starts_ms.checked_sub(1) {
                player.until(closed_ms);
            }
            player.enter(past, at)?;
        }
        let readings = segment.tape.readings(segment.before_ms, &past.shapes);
        for (number, reading) in readings.take_while(|reading| reading.at_ms <= until_ms).enumerate() {
            if number.is_multiple_of(ASKED_READINGS) && player.is_over() {
                return Err(NotSeen::TooLong);
            }
            player.feed(reading);
        }
        if player.ended() == Some(End::Stopped) {
            return Err(NotSeen::TooLong);
        }
    }
    player.until(until_ms.min(past.closed_ms));
    if player.ended() == Some(End::Stopped) { Err(NotSeen::TooLong) } else { Ok(()) }
}

/// A value that came again.
pub(crate) struct Played<'e> {
    /// The place of the program that runs.
    pub(crate) program: usize,
    /// The value, or a fault.
    pub(crate) emission: Emission<'e>,
    /// True if somebody pretended that it was sensed.
    pub(crate) pretended: bool,
}

/// A run without its causes; `out` hears what it emits.
pub(crate) struct PlainPlayer<'p> {
    pub(crate) run: Run,
    pub(crate) program: usize,
    hook: Hook,
    /// By stream whether its last reading was pretended.
    pretended: Vec<bool>,
    out: &'p mut dyn FnMut(Played),
}

impl<'p> PlainPlayer<'p> {
    /// At the beginning of a segment.
    ///
    /// # Errors
    /// If its program cannot run.
    pub(crate) fn at(
        past: &Past,
        segment: usize,
        hook: &Hook,
        out: &'p mut dyn FnMut(Played),
    ) -> Result<Self, NotSeen> {
        let segment = &past.segments[segment];
        let (run, streams) = (begun(past, segment, hook)?, past.programs[segment.program].places.len());
        Ok(Self { run, program: segment.program, hook: hook.clone(), pretended: vec![false; streams], out })
    }
}

fn begun(past: &Past, segment: &PastSegment, hook: &Hook) -> Result<Run, NotSeen> {
    let file = &past.programs[segment.program].file;
    let mut run = rebuild(file, hook)?;
    if let Some(start) = &segment.start {
        run.resume_from((**start).clone(), &Matching::between(file, file));
    }
    Ok(run)
}

/// Hands on what a run emits.
fn hand_on(out: &mut dyn FnMut(Played), program: usize, pretended: &[bool], emission: Emission) {
    let is_reading = |stream: StreamIx| pretended.get(stream.index()) == Some(&true);
    let pretended = matches!(emission, Emission::Value { stream, by: None, .. } if is_reading(stream));
    out(Played { program, emission, pretended });
}

impl Plays for PlainPlayer<'_> {
    fn feed(&mut self, TapedReading { at_ms, stream, value, pretended }: TapedReading) {
        if let Some(last) = self.pretended.get_mut(stream.index()) {
            *last = pretended;
        }
        let Self { run, program, pretended, out, .. } = self;
        run.feed(Millis(at_ms), stream, value, &mut |emission| hand_on(*out, *program, pretended, emission));
    }

    fn until(&mut self, at_ms: u64) {
        let Self { run, program, pretended, out, .. } = self;
        run.until(Millis(at_ms), &mut |emission| hand_on(*out, *program, pretended, emission));
    }

    fn enter(&mut self, past: &Past, segment: usize) -> Result<(), NotSeen> {
        let segment = &past.segments[segment];
        if segment.begins != Begins::GoesOn {
            self.run = begun(past, segment, &self.hook)?;
            self.program = segment.program;
            self.pretended = vec![false; past.programs[segment.program].places.len()];
        }
        Ok(())
    }

    fn ended(&self) -> Option<End> {
        self.run.ended()
    }

    fn is_over(&self) -> bool {
        (self.hook)()
    }
}

/// A run with its causes; `out` hears each value. It leaves moments behind to which one can return.
pub(crate) struct TracedPlayer<'p> {
    pub(crate) traced: Traced,
    hook: Hook,
    /// The values that tests keep back, if somebody asks about them.
    misses: Option<NearestMisses>,
    out: &'p mut dyn FnMut(&Arc<Cause>),
}

impl<'p> TracedPlayer<'p> {
    /// At the newest moment of a tracer that is not after the beginning of a segment, or at the beginning; with its segment.
    ///
    /// # Errors
    /// If its program cannot run.
    pub(crate) fn before(
        past: &Past,
        segment: usize,
        hook: &Hook,
        out: &'p mut dyn FnMut(&Arc<Cause>),
    ) -> Result<(usize, Self), NotSeen> {
        let (at, traced) = match past.traces.before(segment) {
            Some((at, snapshot)) => {
                let file = past.programs[past.segments[at].program].file.clone();
                let run = rebuild(&file, hook)?;
                (at, Traced::from_snapshot(file, run, (*snapshot).clone()))
            }
            None => (0, anew(past, 0, hook)?),
        };
        Ok((at, Self { traced, hook: hook.clone(), misses: None, out }))
    }

    /// Gathers the nearest misses while it plays on from a segment.
    pub(crate) fn gather(&mut self, past: &Past, segment: usize, mut misses: NearestMisses) {
        misses.enter(past.segments[segment].program);
        self.traced.gather_kept();
        self.misses = Some(misses);
    }

    /// Takes the nearest misses until now.
    pub(crate) fn take_misses(&mut self) -> Option<NearestMisses> {
        self.hear_kept();
        self.misses.take()
    }

    fn hear_kept(&mut self) {
        if let Some(misses) = &mut self.misses {
            self.traced.kept().for_each(|kept| misses.hear(kept));
        }
    }
}

fn anew(past: &Past, segment: usize, hook: &Hook) -> Result<Traced, NotSeen> {
    let segment = &past.segments[segment];
    let file = past.programs[segment.program].file.clone();
    let run = rebuild(&file, hook)?;
    let mut traced = Traced::of(file, run);
    if let Some(start) = &segment.start {
        traced.resume((**start).clone());
    }
    Ok(traced)
}

impl Plays for TracedPlayer<'_> {
    fn feed(&mut self, TapedReading { at_ms, stream, value, .. }: TapedReading) {
        self.traced.feed(Millis(at_ms), stream, value, &mut *self.out);
        self.hear_kept();
    }

    fn until(&mut self, at_ms: u64) {
        self.traced.until(Millis(at_ms), &mut *self.out);
        self.hear_kept();
    }

    fn enter(&mut self, past: &Past, at: usize) -> Result<(), NotSeen> {
        let segment = &past.segments[at];
        match segment.begins {
            Begins::Anew => self.traced = anew(past, at, &self.hook)?,
            Begins::Applied => {
                let file = past.programs[segment.program].file.clone();
                let run = rebuild(&file, &self.hook)?;
                self.traced.follow(file, run, Millis(segment.starts_ms.saturating_sub(1)));
            }
            Begins::GoesOn => {}
        }
        if let Some(misses) = self.misses.as_mut().filter(|_| segment.begins != Begins::GoesOn) {
            misses.enter(segment.program);
            self.traced.gather_kept();
        }
        if self.ended().is_none()
            && !past.traces.has(at)
            && let Some(snapshot) = self.traced.snapshot()
        {
            past.traces.keep(at, snapshot);
        }
        Ok(())
    }

    fn ended(&self) -> Option<End> {
        self.traced.run().ended()
    }

    fn is_over(&self) -> bool {
        (self.hook)()
    }
}

/// The id of a connector of a program that ran.
pub(crate) fn connector_id(past: &Past, program: usize, connector: ConnectorIx) -> &str {
    past.programs[program].file.connectors.get(connector.index()).map_or("", |connector| &connector.id)
}
