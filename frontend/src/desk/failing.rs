//! Which connectors of the run fail, and how often.

use super::{ConnectorSignals, Desk, State, set_if_new};
use crate::layout::chip_words;
use behaviour::{Connector, Id, Kind, Record, RecordId};
use leptos::prelude::*;

/// A connector whose procedure failed since Start.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Failing {
    pub(crate) connector: Id,
    /// What it says on its chip, in the version that runs.
    pub(crate) name: String,
    pub(crate) count: u64,
    /// Why it failed last, in a sentence.
    pub(crate) why: String,
}

impl Desk {
    /// What fails on the robot now. Reactive.
    pub(crate) fn fails_now(&self) -> usize {
        if self.running().is_some() { self.failing.read().len() } else { 0 }
    }

    /// Counts afresh what fails, what began last first.
    pub(super) fn renew_failing(&self) {
        let state = self.state();
        let mut found: Vec<_> =
            state.connectors.iter().filter_map(|(id, signals)| state.failing(id, signals)).collect();
        drop(state);
        found.sort_by(|one, other| other.0.total_cmp(&one.0));
        set_if_new(&self.failing, found.into_iter().map(|(_, failing)| failing).collect());
    }
}

impl State {
    fn failing(&self, id: &Id, signals: &ConnectorSignals) -> Option<(f64, Failing)> {
        let live = signals.live.read_untracked();
        let why = live.error.clone().filter(|_| live.faults > 0)?;
        let name = match self.ran.get(&RecordId::new(Kind::Connector, id)) {
            Some(Some(Record::Connector(ran))) => whole(ran),
            _ => signals.record.with_untracked(whole),
        };
        Some((live.failed_at, Failing { connector: id.clone(), name, count: live.faults, why }))
    }
}

fn whole(connector: &Connector) -> String {
    chip_words(connector).whole()
}
