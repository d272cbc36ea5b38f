//! A moment: all values as they were then, told as those of a running behaviour are.

use crate::cut::cut;
use crate::hook::Hook;
use crate::past::Past;
use crate::play::{PlainPlayer, Played, connector_id, play};
use behaviour::Id;
use engine::{Emission, Run};
use phrase::{Phrase, Phrased};
use protocol::{ConnectorSample, NotSeen, PastMoment, StreamSample, Values};

/// The time over which values are counted for their rate, in milliseconds.
const RATE_MS: u64 = 2_000;
/// The most bytes of a moment as JSON.
const MOMENT_MAX_BYTES: usize = 200 << 10;

impl Past {
    /// Returns all values at a moment: what came in its very millisecond counts.
    ///
    /// # Errors
    /// If it is before the beginning, or if it cannot be played.
    pub fn seek(&self, at_ms: u64, hook: &Hook) -> Result<PastMoment, NotSeen> {
        let at_ms = self.moment(at_ms)?;
        let since_ms = at_ms.saturating_sub(RATE_MS);
        let from = self.segment_at(since_ms);
        let mut lately = vec![0_u32; self.streams.all.len()];
        let mut hear = |played: Played| {
            if let Emission::Value { at, stream, .. } = played.emission
                && at.0 > since_ms
            {
                lately[self.programs[played.program].places[stream.index()]] += 1;
            }
        };
        let mut player = PlainPlayer::at(self, from, hook, &mut hear)?;
        play(self, from, at_ms, &mut player)?;
        let (run, program) = (player.run, player.program);
        let mut room = MomentRoom { left: MOMENT_MAX_BYTES, more: false };
        let streams = self.stream_samples(&run, program, &lately);
        let streams = streams.filter(|sample| room.take(sample)).collect();
        let connectors = self.connector_samples(&run, program, at_ms);
        let connectors = connectors.filter(|sample| room.take(sample)).collect();
        let values = Values { run: self.header.run, at_ms, streams, connectors };
        Ok(PastMoment { program, values, more: room.more })
    }

    fn stream_samples<'r>(
        &'r self,
        run: &'r Run,
        program: usize,
        lately: &'r [u32],
    ) -> impl Iterator<Item = StreamSample> + 'r {
        let places = &self.programs[program].places;
        let named = run.stats().streams.enumerate().zip(run.streams());
        named.filter_map(move |((at, stats), info)| {
            let (came, value) = stats.last()?;
            #[expect(clippy::cast_precision_loss, reason = "a rate is shown with one digit")]
            let rate = lately[places[at.index()]] as f32 / (RATE_MS as f32 / 1_000.0);
            let stream = Id::new(&info.id).ok()?;
            Some(StreamSample { stream, count: stats.count, rate, at_ms: came.0, value: cut(value) })
        })
    }

    fn connector_samples<'r>(
        &'r self,
        run: &'r Run,
        program: usize,
        at_ms: u64,
    ) -> impl Iterator<Item = ConnectorSample> + 'r {
        let stats = run.stats().connectors.enumerate();
        stats.filter_map(move |(at, stats)| {
            let output = &run.streams()[run.connectors()[at].output].id;
            let refused = self.refusals.iter().filter(|(then, stream, _)| *then <= at_ms && stream == output);
            let (mut refusals, mut last) = (0, None);
            refused.for_each(|(_, _, why)| (refusals, last) = (refusals + 1, Some(why)));
            let faults = stats.faults + refusals;
            if stats.fired == 0 && faults == 0 {
                return None;
            }
            let own = stats.last_fault.as_ref().map(|fault| fault.error.phrase());
            let connector = Id::new(connector_id(self, program, at)).ok()?;
            Some(ConnectorSample { connector, fired: stats.fired, faults, error: last.map(Phrase::from).or(own) })
        })
    }
}

/// The bytes that are left in an answer.
struct MomentRoom {
    left: usize,
    more: bool,
}

impl MomentRoom {
    /// Takes the bytes of a sample; false if it does not fit.
    fn take<T: serde::Serialize>(&mut self, sample: &T) -> bool {
        let left = self.left.checked_sub(recording::json(sample).len() + 1);
        self.more |= left.is_none();
        self.left = left.unwrap_or(self.left);
        left.is_some()
    }
}
