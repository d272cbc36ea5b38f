//! Live values of streams and connectors while the behaviour runs.

mod words;

use words::reads_alike;
pub(crate) use words::{measured, rate_words, short_value, sparkline, unit};

use behaviour::Value;
use protocol::{ConnectorSample, StreamSample};
use std::collections::VecDeque;

/// How many numbers a sparkline keeps.
const RECENT_MAX: usize = 32;
/// How many of the last values of a stream are kept.
pub(crate) const LAST_MAX: usize = 5;
/// How large they may be together, about, in bytes.
const LAST_MAX_BYTES: usize = 16_384;
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
    /// The last values of any kind, oldest first, at most five that read differently; fewer where they are large.
    pub(crate) last: VecDeque<Value>,
    /// While a moment of the past is shown: how long before it the newest came, in milliseconds.
    pub(crate) earlier_ms: Option<f64>,
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
        self.keep(&sample.value);
        self.value = Some(sample.value);
    }

    fn keep(&mut self, value: &Value) {
        // A sense seldom measures the very same twice: the newest stands for those that look like it.
        self.last.pop_back_if(|back| reads_alike(back, value));
        self.last.push_back(value.clone());
        let large = |last: &VecDeque<Value>| last.iter().map(about_bytes).sum::<usize>() > LAST_MAX_BYTES;
        while self.last.len() > LAST_MAX || (self.last.len() > 1 && large(&self.last)) {
            self.last.pop_front();
        }
    }

    /// Tells the whole seconds by which it came before the moment of the past that is shown, if that is one at least. None for
    /// values of now.
    pub(crate) fn earlier(&self) -> Option<Option<u32>> {
        self.earlier_ms.map(|ms| (ms >= 1_000.0).then_some((ms / 1_000.0) as u32))
    }

    /// For how many whole seconds nothing came, if that is long; `now` is `performance.now()`.
    pub(crate) fn quiet_for(&self, now: f64) -> Option<u32> {
        let silence = self.earlier_ms.unwrap_or(now - self.received);
        (self.value.is_some() && silence >= QUIET_MS).then_some((silence / 1_000.0) as u32)
    }
}

/// About how large a value is, in bytes.
fn about_bytes(value: &Value) -> usize {
    match value {
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_) => 16,
        Value::Text(text) => 16 + text.len(),
        Value::List(items) => 16 + items.iter().map(about_bytes).sum::<usize>(),
        Value::Map(fields) => 16 + fields.iter().map(|(name, value)| name.len() + about_bytes(value)).sum::<usize>(),
    }
}

/// How a connector is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LiveConnector {
    pub(crate) fired: u64,
    pub(crate) faults: u64,
    pub(crate) error: Option<phrase::Phrase>,
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
    use super::{LAST_MAX, LiveConnector, LiveStream, RECENT_MAX};
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
    fn the_last_values_of_any_kind_are_kept_within_bounds() {
        let mut live = LiveStream::default();
        let kept = |live: &LiveStream| live.last.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        let ball = |x: f64| Value::object([("x", Value::Float(x))]);
        [1.0, 1.0, 2.0].into_iter().for_each(|x| live.hear(sample(1, ball(x)), 0.0));
        assert_eq!(live.last, [ball(1.0), ball(2.0)], "the same one again is no other value");
        live.hear(sample(1, ball(2.001)), 0.0);
        assert_eq!(live.last, [ball(1.0), ball(2.001)], "the newest of those that read alike");
        (0..9).for_each(|count| live.hear(sample(count, Value::Bool(count % 2 == 0)), 0.0));
        assert_eq!((live.last.len(), kept(&live).as_str()), (LAST_MAX, "true false true false true"));
        live.hear(sample(10, Value::text("x".repeat(50_000))), 0.0);
        assert_eq!(live.last.len(), 1, "the newest is kept however large it is");
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
