//! The connectors of the run that fail, and how often.

use super::RobotsPanel;
use crate::desk::document::ConnectorSignals;
use crate::desk::tab::set_if_new;
use crate::layout::chip_words;
use crate::live::LiveConnector;
use behaviour::sort_few;
use behaviour::{Connector, Id, Kind, Record, RecordId};
use editor::unused::RecordsBefore;
use leptos::prelude::*;

/// A connector whose procedure failed since Start.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Failing {
    pub(crate) connector: Id,
    /// The words on its chip, in the version that runs.
    pub(crate) name: String,
    pub(crate) count: u64,
    /// The reason why it failed last, in a sentence.
    pub(crate) why: phrase::Phrase,
}

impl RobotsPanel {
    /// Returns the number of failures on the robot now. Reactive.
    pub(crate) fn fails_now(&self) -> usize {
        if self.running().is_some() { self.failing.read().len() } else { 0 }
    }

    /// Counts afresh what fails, what began last first.
    pub(super) fn renew_failing(&self) {
        let connectors = self.document.connectors();
        let mut found: Vec<_> = {
            let state = self.state();
            let live = |id: &Id, signals: &ConnectorSignals| match &state.kept {
                Some(kept) => kept.connectors.get(id).cloned().unwrap_or_default(),
                None => signals.live.get_untracked(),
            };
            connectors
                .iter()
                .filter_map(|(id, signals)| failing(&state.before, id, signals, &live(id, signals)))
                .collect()
        };
        sort_few(&mut found, |one, other| one.0 > other.0);
        set_if_new(&self.failing, found.into_iter().map(|(_, failing)| failing).collect());
    }
}

/// A connector that fails, and since when; it is called what it was called in the version that runs.
fn failing(
    before: &RecordsBefore,
    id: &Id,
    signals: &ConnectorSignals,
    live: &LiveConnector,
) -> Option<(f64, Failing)> {
    let why = live.error.clone().filter(|_| live.faults > 0)?;
    let name = match before.get(&RecordId::new(Kind::Connector, id)) {
        Some(Some(Record::Connector(ran))) => whole(ran),
        _ => signals.record.with_untracked(whole),
    };
    Some((live.failed_at, Failing { connector: id.clone(), name, count: live.faults, why }))
}

fn whole(connector: &Connector) -> String {
    chip_words(connector).whole()
}
