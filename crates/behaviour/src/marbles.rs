//! What every connector does, in words and marbles: the help that people read and the test that holds it true.

mod combine_latest;
mod filter;
mod map;
mod merge;
mod sample;
mod subscribe;
mod timestamp;

/// The help of one connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Page {
    /// The connector's word, as in files.
    pub connector: &'static str,
    /// What it does.
    pub does: &'static str,
    /// When to use it.
    pub when: &'static str,
    /// Two or three examples.
    pub examples: &'static [Example],
}

/// One example. The lanes are all as long as the example.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// What it shows, in a sentence.
    pub title: &'static str,
    /// The input streams, in order.
    pub given: &'static [Lane],
    /// What the connector is given: a procedure, or nothing.
    pub body: &'static str,
    /// The beat of a sample, in milliseconds; 0 for the others.
    pub every_ms: u64,
    /// The output stream.
    pub then: Lane,
    /// How long it takes, in milliseconds.
    pub until_ms: u64,
}

/// A stream with its values: its name, and marbles such as `0:5 300:30`, each a time in milliseconds and a value.
/// `5@300` is the value 5 with the time 300 written beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lane(pub &'static str, pub &'static str);

/// A value at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marble {
    /// When, in milliseconds.
    pub at_ms: u64,
    /// The value as it is written.
    pub text: &'static str,
}

/// The help of all connectors, in the order of the thesis.
pub const PAGES: [Page; 7] =
    [sample::PAGE, subscribe::PAGE, filter::PAGE, map::PAGE, combine_latest::PAGE, merge::PAGE, timestamp::PAGE];

/// The help of a connector by its word.
#[must_use]
pub fn page(connector: &str) -> Option<&'static Page> {
    PAGES.iter().find(|page| page.connector == connector)
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
    /// The connector as the canvas labels it: `filter (distance < 20)`.
    #[must_use]
    pub fn label(&self, connector: &str) -> String {
        match (self.body, self.every_ms) {
            ("", 0) => connector.to_owned(),
            ("", every) => format!("{connector} ({every} ms)"),
            (body, _) => format!("{connector} ({body})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Lane, PAGES, page};
    use crate::{Operation, Procedure, is_identifier};

    #[test]
    fn every_connector_has_a_page() {
        let procedure = || Procedure::body("");
        let all = [
            Operation::Map(procedure()),
            Operation::Filter(procedure()),
            Operation::Timestamp,
            Operation::Sample { period_ms: 1 },
            Operation::CombineLatest(procedure()),
            Operation::Merge,
            Operation::Subscribe,
        ];
        // A new connector does not compile here until it stands above.
        let known = |operation: &Operation| match operation {
            Operation::Map(_) | Operation::Filter(_) | Operation::CombineLatest(_) | Operation::Timestamp => {}
            Operation::Sample { .. } | Operation::Merge | Operation::Subscribe => {}
        };
        all.iter().for_each(known);
        for operation in &all {
            let page = page(operation.word()).unwrap();
            assert!(page.examples.len() >= 2 && page.does.ends_with('.') && page.when.ends_with('.'), "{page:?}");
        }
        assert_eq!(PAGES.len(), all.len());
    }

    #[test]
    fn every_marble_is_one_and_in_time() {
        for example in PAGES.iter().flat_map(|page| page.examples) {
            for lane in example.given.iter().chain([&example.then]) {
                let times: Vec<u64> = lane.marbles().map(|marble| marble.at_ms).collect();
                assert_eq!(times.len(), lane.1.split_whitespace().count(), "{lane:?}");
                assert!(times.is_sorted() && times.iter().all(|at| *at <= example.until_ms), "{lane:?}");
            }
            assert!(example.title.ends_with('.') && !example.given.is_empty(), "{example:?}");
        }
    }

    #[test]
    fn names_in_examples_are_those_of_the_arguments() {
        for example in PAGES.iter().flat_map(|page| page.examples).filter(|example| !example.body.is_empty()) {
            for Lane(name, _) in example.given {
                let argument = crate::argument_names([*name]).remove(0);
                assert!(is_identifier(&argument) && example.body.contains(&argument), "{}", example.title);
            }
        }
    }
}
