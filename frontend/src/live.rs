//! Live values of streams and connectors while the behaviour runs.

mod words;

pub(crate) use words::{rate_words, short_value, sparkline};

use behaviour::Value;
use protocol::{ConnectorSample, StreamSample};

/// How many numbers a sparkline keeps.
const RECENT_MAX: usize = 32;
/// How long a connector that fired is lit, in milliseconds.
pub(crate) const LIT_MS: i32 = 150;
/// A stream without a value for so long is quiet, in milliseconds.
const QUIET_MS: f64 = 2_500.0;

/// What a stream carried last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LiveStream {
    pub(crate) value: Option<Value>,
    /// Values per second over the last two seconds.
    pub(crate) rate: f32,
    /// Values since Start.
    pub(crate) count: u64,
    /// When the newest was carried, in milliseconds since Start.
    pub(crate) at_ms: u64,
    /// When the page heard of it (`performance.now()`).
    pub(crate) received: f64,
    /// The last numbers, oldest first, at most 32; empty for other values.
    pub(crate) recent: Vec<f64>,
}

impl LiveStream {
    /// Takes in a sample heard at `now`.
    pub(crate) fn hear(&mut self, sample: StreamSample, now: f64) {
        if sample.count > self.count {
            self.received = now;
        }
        (self.rate, self.count, self.at_ms) = (sample.rate, sample.count, sample.at_ms);
        match sample.value.as_number() {
            Some(number) => self.recent.push(number),
            None => self.recent.clear(),
        }
        let many = self.recent.len().saturating_sub(RECENT_MAX);
        self.recent.drain(..many);
        self.value = Some(sample.value);
    }

    /// For how many whole seconds nothing came, if that is long; `now` is `performance.now()`.
    pub(crate) fn quiet_for(&self, now: f64) -> Option<u32> {
        let silence = now - self.received;
        (self.value.is_some() && silence >= QUIET_MS).then_some((silence / 1_000.0) as u32)
    }
}

/// How a connector is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LiveConnector {
    pub(crate) fired: u64,
    pub(crate) faults: u64,
    pub(crate) error: Option<String>,
    /// When the page first heard that it failed (`performance.now()`).
    pub(crate) failed_at: f64,
    /// When the page last heard that it fired (`performance.now()`).
    pub(crate) fired_at: f64,
    /// True for 150 ms after it fired.
    pub(crate) lit: bool,
}

impl LiveConnector {
    /// Takes in a sample heard at `now`.
    pub(crate) fn hear(&mut self, sample: ConnectorSample, now: f64) {
        if sample.fired > self.fired {
            self.fired_at = now;
            self.lit = true;
        }
        if sample.faults > 0 && self.faults == 0 {
            self.failed_at = now;
        }
        (self.fired, self.faults, self.error) = (sample.fired, sample.faults, sample.error);
    }
}

#[cfg(test)]
mod tests {
    use super::{LiveConnector, LiveStream, RECENT_MAX};
    use behaviour::{Id, Value};
    use protocol::{ConnectorSample, StreamSample};

    fn sample(count: u64, value: Value) -> StreamSample {
        StreamSample { stream: Id::new("s").unwrap(), count, rate: 10.0, at_ms: count * 100, value }
    }

    #[test]
    fn a_stream_keeps_its_last_numbers_and_knows_when_it_is_quiet() {
        let mut live = LiveStream::default();
        (1..100).for_each(|count| live.hear(sample(count, Value::Float(count as f64)), 1_000.0));
        assert_eq!((live.recent.len(), live.recent.last()), (RECENT_MAX, Some(&99.0)));
        assert_eq!((live.quiet_for(2_000.0), live.quiet_for(4_100.0)), (None, Some(3)));
        live.hear(sample(100, Value::text("x")), 5_000.0);
        assert!(live.recent.is_empty());
    }

    #[test]
    fn a_connector_lights_up_only_when_it_fires() {
        let mut live = LiveConnector::default();
        let id = Id::new("c").unwrap();
        let sample = |fired| ConnectorSample { connector: id.clone(), fired, faults: 1, error: Some("no x".into()) };
        live.hear(sample(0), 5.0);
        assert!(!live.lit && live.error.is_some());
        live.hear(sample(1), 9.0);
        assert!(live.lit && live.fired_at == 9.0);
    }
}
