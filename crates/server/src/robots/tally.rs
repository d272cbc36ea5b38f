//! What a run's thread counts for the live view, and when it tells.

use super::beats::{Beats, SLOT_MS};
use super::live::{Changes, LiveValues};
use behaviour::Id;
use engine::{ConnectorIx, ConnectorStats, IndexVec, Matching, Run, StreamIx, StreamStats};
use phrase::{Phrase, Phrased};
use protocol::{ConnectorSample, StreamSample};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Time between two tellings, in milliseconds.
const TELL_MS: u64 = 33;

/// Counts of one run.
pub(super) struct RunTally {
    live: LiveValues,
    streams: IndexVec<StreamIx, StreamTally>,
    connectors: IndexVec<ConnectorIx, ConnectorTally>,
    changes: Changes,
    is_stale: bool,
    told: Instant,
}

struct StreamTally {
    id: Option<Id>,
    beats: Beats,
    count: u64,
    rate: f32,
}

struct ConnectorTally {
    id: Option<Id>,
    output: StreamIx,
    told: (u64, u64),
    refused: u64,
    refusal: Option<Phrase>,
}

impl RunTally {
    /// For a run that has just been built.
    pub(super) fn new(live: LiveValues, run: &Run) -> Self {
        let stream = |id: &str| StreamTally { id: Id::new(id).ok(), beats: Beats::default(), count: 0, rate: 0.0 };
        let connector =
            |id: &str, output| ConnectorTally { id: Id::new(id).ok(), output, told: (0, 0), refused: 0, refusal: None };
        Self {
            live,
            streams: run.streams().iter().map(|info| stream(&info.id)).collect(),
            connectors: run.connectors().iter().map(|info| connector(&info.id, info.output)).collect(),
            changes: Changes::default(),
            is_stale: false,
            told: Instant::now(),
        }
    }

    /// For the run that follows: rates and refusals of what stays the same go on, and everything is told once more.
    pub(super) fn succeeded(mut self, run: &Run, matching: &Matching) -> Self {
        self.live.renew(run.streams().len(), run.connectors().len());
        let mut next = Self::new(self.live.clone(), run);
        for (&from, &to) in &matching.streams {
            next.streams[to].beats = self.streams[from].beats;
        }
        for (&from, &to) in &matching.connectors {
            let before = &mut self.connectors[from];
            (next.connectors[to].refused, next.connectors[to].refusal) = (before.refused, before.refusal.take());
        }
        next.is_stale = true;
        next
    }

    /// A value was carried by a stream.
    pub(super) fn carried(&mut self, stream: StreamIx, at_ms: u64) {
        self.is_stale = true;
        self.streams[stream].beats.beat(at_ms);
    }

    /// A procedure failed.
    pub(super) fn failed(&mut self) {
        self.is_stale = true;
    }

    /// The robot dropped commands; shown on the connector that gave them.
    pub(super) fn refused(&mut self, refused: BTreeMap<Id, (u64, Phrase)>) {
        for (stream, (count, reason)) in refused {
            let index =
                self.streams.enumerate().find(|(_, tally)| tally.id.as_ref() == Some(&stream)).map(|(at, _)| at);
            if let Some(giver) = self.connectors.iter_mut().find(|tally| Some(tally.output) == index) {
                giver.refused += count;
                giver.refusal = Some(reason);
                self.is_stale = true;
            }
        }
    }

    /// When it wants to tell next, if there will be something to tell.
    pub(super) fn next_telling(&self) -> Option<Instant> {
        let fades = self.streams.iter().any(|stream| stream.rate > 0.0);
        let pause_ms = match (self.is_stale, fades) {
            (true, _) => TELL_MS,
            (false, true) => SLOT_MS,
            (false, false) => return None,
        };
        Some(self.told + Duration::from_millis(pause_ms))
    }

    /// Tells what changed if it is time to, or at once at the end.
    pub(super) fn tell(&mut self, run: &Run, at_ms: u64, is_end: bool) {
        let is_due = self.next_telling().is_some_and(|due| due <= Instant::now());
        if !is_due && !is_end {
            return;
        }
        self.collect(run, at_ms);
        if self.changes.is_empty() || self.live.tell(at_ms, &mut self.changes, is_end) {
            (self.is_stale, self.told) = (false, Instant::now());
        }
    }

    fn collect(&mut self, run: &Run, at_ms: u64) {
        let stats = run.stats();
        for (at, (tally, stats)) in self.streams.iter_mut().zip(&stats.streams).enumerate() {
            if let Some(sample) = tally.sample(stats, at_ms) {
                self.changes.streams.push((at, sample));
            }
        }
        for (at, (tally, stats)) in self.connectors.iter_mut().zip(&stats.connectors).enumerate() {
            if let Some(sample) = tally.sample(stats) {
                self.changes.connectors.push((at, sample));
            }
        }
    }
}

impl StreamTally {
    fn sample(&mut self, stats: &StreamStats, at_ms: u64) -> Option<StreamSample> {
        let (at, value) = stats.last()?;
        let rate = self.beats.per_second(at_ms);
        let is_same = self.count == stats.count && (self.rate - rate).abs() < f32::EPSILON;
        (self.count, self.rate) = (stats.count, rate);
        let sample = || {
            Some(StreamSample { stream: self.id.clone()?, count: self.count, rate, at_ms: at.0, value: value.clone() })
        };
        if is_same { None } else { sample() }
    }
}

impl ConnectorTally {
    fn sample(&mut self, stats: &ConnectorStats) -> Option<ConnectorSample> {
        let faults = stats.faults + self.refused;
        if self.told == (stats.fired, faults) {
            return None;
        }
        self.told = (stats.fired, faults);
        let own = stats.last_fault.as_ref().map(|fault| fault.error.phrase());
        let error = self.refusal.clone().or(own);
        Some(ConnectorSample { connector: self.id.clone()?, fired: stats.fired, faults, error })
    }
}
