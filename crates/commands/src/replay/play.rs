//! Several runs side by side in one logical time: at each instant first the readings, then the ticks.

use super::ReplayTrace;
use super::printer::Printer;
use crate::failure::Failure;
use crate::trace::TraceReading;
use behaviour::{BehaviourFile, Engine};
use engine::{End, Run};
use robot::Millis;
use std::io::Write;
use std::iter::Peekable;
use std::vec::IntoIter;

/// A run with its readings.
pub(super) struct Player {
    name: String,
    run: Run,
    readings: Peekable<IntoIter<TraceReading>>,
    /// The last instant whose readings count.
    last: Millis,
    /// The last instant whose ticks run.
    closed: Millis,
}

impl Player {
    /// A run of a file, with the readings of a trace up to `until` or to its end.
    pub(super) fn new(until: Option<u64>, file: &BehaviourFile, run: Run, trace: ReplayTrace) -> Self {
        let ReplayTrace { readings, closed } = trace;
        let last = Millis(until.unwrap_or_else(|| readings.last().map_or(0, |(at, ..)| at.0)));
        // A frame that has begun by then runs too, unless it was recorded how far instants were closed.
        let end = match file.engine.unwrap_or_default() {
            Engine::Event => last,
            Engine::Frame { frame_ms } => Millis(last.0.div_ceil(frame_ms).saturating_mul(frame_ms)),
        };
        let closed = closed.filter(|_| until.is_none()).unwrap_or(end);
        Self { name: file.name.clone(), run, readings: readings.into_iter().peekable(), last, closed }
    }

    /// The next instant in which it has something to do.
    fn next(&mut self) -> Option<Millis> {
        let reading = self.readings.peek().map(|(at, ..)| *at).filter(|at| *at <= self.last);
        let due = self.run.next_due().filter(|at| *at <= self.closed);
        reading.into_iter().chain(due).min()
    }

    /// Why it ended by itself, if it did.
    pub(super) fn fault(&self) -> Option<Failure> {
        self.run.fault().map(|reason| Failure::of(format!("{}: {reason}", self.name)))
    }
}

/// Plays them to the end. At one instant the upper one comes first.
pub(super) fn play(players: &mut [Player], mut printer: Printer, to: &mut dyn Write) -> std::io::Result<()> {
    while let Some(at) = players.iter_mut().filter_map(Player::next).min() {
        for (number, player) in players.iter_mut().enumerate() {
            let running = player.run.ended().is_none();
            while let Some((at, stream, value)) = player.readings.next_if(|(next, ..)| *next <= at) {
                player.run.feed(at, stream, value, &mut |emission| printer.print(number, &emission));
            }
            printer.tell_end(number, &player.run, running);
        }
        for (number, player) in players.iter_mut().enumerate().filter(|(_, player)| at <= player.closed) {
            let running = player.run.ended().is_none();
            player.run.until(at, &mut |emission| printer.print(number, &emission));
            printer.tell_end(number, &player.run, running);
        }
        printer.write(to)?;
    }
    to.flush()
}

impl Printer<'_> {
    /// Says that a run ended by itself, if it did just now.
    fn tell_end(&mut self, number: usize, run: &Run, was_running: bool) {
        if let (true, Some(End::Multiplied { at, stream }), Some(reason)) = (was_running, run.ended(), run.fault()) {
            self.print_end(number, at, stream, &reason.to_string());
        }
    }
}
