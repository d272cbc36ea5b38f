//! The live values of a run: written now and then by its thread, read by whoever watches, newest wins.

use crate::support::lock;
use protocol::{ConnectorSample, StreamSample, Values};
use std::sync::{Arc, Mutex};

/// The live values of one run; a clone shows the same run.
#[derive(Clone, Debug)]
pub(crate) struct LiveValues {
    run: u64,
    cell: Arc<Mutex<LiveCell>>,
}

/// What one subscriber has seen already; starts with nothing.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SeenLive {
    run: u64,
    version: u64,
}

#[derive(Debug, Default)]
struct LiveCell {
    version: u64,
    at_ms: u64,
    streams: Vec<ToldSample<StreamSample>>,
    connectors: Vec<ToldSample<ConnectorSample>>,
}

/// A sample and the version with which it changed last; 0 while there is nothing to tell.
#[derive(Debug)]
struct ToldSample<T> {
    version: u64,
    sample: Option<T>,
}

impl<T> Default for ToldSample<T> {
    fn default() -> Self {
        Self { version: 0, sample: None }
    }
}

impl LiveValues {
    /// For a run with that many streams and connectors.
    pub(super) fn new(run: u64, streams: usize, connectors: usize) -> Self {
        let cell = LiveCell {
            streams: std::iter::repeat_with(ToldSample::default).take(streams).collect(),
            connectors: std::iter::repeat_with(ToldSample::default).take(connectors).collect(),
            ..LiveCell::default()
        };
        Self { run, cell: Arc::new(Mutex::new(cell)) }
    }

    /// What changed since this subscriber's last question, or nothing.
    pub(crate) fn since(&self, seen: &mut SeenLive) -> Option<Values> {
        let known = if seen.run == self.run { seen.version } else { 0 };
        let cell = lock(&self.cell);
        if cell.version <= known {
            return None;
        }
        *seen = SeenLive { run: self.run, version: cell.version };
        let (streams, connectors) = (newer(&cell.streams, known), newer(&cell.connectors, known));
        Some(Values { run: self.run, at_ms: cell.at_ms, streams, connectors })
    }

    /// Begins anew with that many streams and connectors; whoever watches goes on watching.
    pub(super) fn renew(&self, streams: usize, connectors: usize) {
        let mut cell = lock(&self.cell);
        cell.streams = std::iter::repeat_with(ToldSample::default).take(streams).collect();
        cell.connectors = std::iter::repeat_with(ToldSample::default).take(connectors).collect();
    }

    /// Tells what changed, each with its index. False if somebody reads just now and `wait` is false.
    pub(super) fn tell(&self, at_ms: u64, changes: &mut Changes, wait: bool) -> bool {
        let cell = if wait { Some(lock(&self.cell)) } else { self.cell.try_lock().ok() };
        let Some(mut cell) = cell else { return false };
        cell.version += 1;
        cell.at_ms = at_ms;
        let version = cell.version;
        put(&mut cell.streams, &mut changes.streams, version);
        put(&mut cell.connectors, &mut changes.connectors, version);
        true
    }
}

/// Samples that changed, each with the index of its stream or connector.
#[derive(Debug, Default)]
pub(super) struct Changes {
    /// Of streams.
    pub(super) streams: Vec<(usize, StreamSample)>,
    /// Of connectors.
    pub(super) connectors: Vec<(usize, ConnectorSample)>,
}

impl Changes {
    /// True if there is nothing to tell.
    pub(super) fn is_empty(&self) -> bool {
        self.streams.is_empty() && self.connectors.is_empty()
    }
}

fn put<T>(told: &mut [ToldSample<T>], changes: &mut Vec<(usize, T)>, version: u64) {
    for (index, sample) in changes.drain(..) {
        if let Some(place) = told.get_mut(index) {
            *place = ToldSample { version, sample: Some(sample) };
        }
    }
}

fn newer<T: Clone>(told: &[ToldSample<T>], known: u64) -> Vec<T> {
    told.iter().filter(|told| told.version > known).filter_map(|told| told.sample.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::{Changes, LiveValues, SeenLive};
    use behaviour::{Id, Value};
    use protocol::StreamSample;

    fn ball(count: i64) -> Changes {
        let stream = Id::new("ball").unwrap();
        let sample =
            StreamSample { stream, count: count.unsigned_abs(), rate: 1.0, at_ms: 5, value: Value::Int(count) };
        Changes { streams: vec![(1, sample)], connectors: Vec::new() }
    }

    #[test]
    fn every_subscriber_hears_only_what_is_new_to_it() {
        let live = LiveValues::new(7, 3, 0);
        let (mut aiko, mut ben) = (SeenLive::default(), SeenLive::default());
        assert!(live.since(&mut aiko).is_none());
        live.tell(10, &mut ball(1), true);
        assert_eq!(live.since(&mut aiko).unwrap().streams.len(), 1);
        live.tell(20, &mut ball(2), true);
        for seen in [&mut aiko, &mut ben] {
            let values = live.since(seen).unwrap();
            assert_eq!((values.run, values.at_ms), (7, 20));
            assert_eq!(values.streams[0].value, Value::Int(2));
            assert!(live.since(seen).is_none());
        }
        assert_eq!(LiveValues::new(8, 3, 0).since(&mut aiko), None);
    }
}
