//! Marble examples: streams with values at times, shown in the help of connectors and held true by the engine's tests.

/// One example. The lanes are all as long as the example.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// The sentence that says what the example shows.
    pub title: &'static str,
    /// The input streams, in order.
    pub given: &'static [Lane],
    /// The settings of the connector.
    pub setting: Setting,
    /// The output stream.
    pub then: Lane,
    /// The length of the example, in milliseconds.
    pub until_ms: u64,
}

/// The settings of a connector in an example.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// A procedure, or an empty text.
    pub body: &'static str,
    /// A duration in milliseconds, or 0.
    pub period_ms: u64,
    /// A value to start from as JSON, or an empty text.
    pub start: &'static str,
}

impl Setting {
    /// Nothing.
    pub const NOTHING: Self = Self { body: "", period_ms: 0, start: "" };

    /// A procedure.
    #[must_use]
    pub const fn body(body: &'static str) -> Self {
        Self { body, ..Self::NOTHING }
    }

    /// A duration in milliseconds.
    #[must_use]
    pub const fn period(period_ms: u64) -> Self {
        Self { period_ms, ..Self::NOTHING }
    }
}

/// A stream with its values: its name, and marbles such as `0:5 300:30`, each a time in milliseconds and a value.
/// `5@300` is the value 5 with the time 300 written beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lane(pub &'static str, pub &'static str);

/// A value at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marble {
    /// The time, in milliseconds.
    pub at_ms: u64,
    /// The value as it is written.
    pub text: &'static str,
}

impl Lane {
    /// The values of the lane, in order of time. What is not a marble is left out; a test says that nothing is.
    pub fn marbles(self) -> impl Iterator<Item = Marble> {
        self.1.split_whitespace().filter_map(|marble| {
            let (at, text) = marble.split_once(':')?;
            Some(Marble { at_ms: at.parse().ok()?, text })
        })
    }
}

impl Marble {
    /// The value, and the time beside it if there is one.
    #[must_use]
    pub fn parts(self) -> (&'static str, Option<&'static str>) {
        self.text.split_once('@').map_or((self.text, None), |(value, time)| (value, Some(time)))
    }
}

impl Example {
    /// The connector with what is chosen: `filter (distance < 20)`.
    #[must_use]
    pub fn label(&self, connector: &str) -> String {
        let Setting { body, period_ms, start } = self.setting;
        let period = if period_ms > 0 { format!("{period_ms} ms") } else { String::new() };
        let chosen: Vec<&str> = [start, body, &period].into_iter().filter(|one| !one.is_empty()).collect();
        if chosen.is_empty() { connector.to_owned() } else { format!("{connector} ({})", chosen.join(", ")) }
    }
}
