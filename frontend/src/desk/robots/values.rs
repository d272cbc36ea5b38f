//! Live values and runs, put into the signals of their streams and connectors.

use super::RobotsPanel;
use crate::browser;
use crate::desk::document::ConnectorSignals;
use crate::desk::tab::set_if_new;
use crate::live::{LIT_MS, LiveConnector, LiveStream};
use behaviour::Id;
use leptos::prelude::*;
use protocol::{ConnectorSample, RunState, StreamSample, Values};
use std::collections::HashMap;

/// Between two changes of what is shown to who wants little motion, in milliseconds.
const CALM_MS: i32 = 500;

/// Values of streams and connectors as they are now, while the graph shows others.
#[derive(Default)]
pub(super) struct ValuesOfNow {
    streams: HashMap<Id, LiveStream>,
    pub(super) connectors: HashMap<Id, LiveConnector>,
}

impl RobotsPanel {
    /// From now on the signals of values are free for those of the past; those of now are kept, and what is told goes on.
    pub(crate) fn keep_now(&self) {
        if self.state().kept.is_some() {
            return;
        }
        let ids = self.document.stream_ids.get_untracked();
        let streams =
            ids.into_iter().filter_map(|id| Some((id.clone(), self.document.stream(&id)?.live.get_untracked())));
        let connectors = self.document.connectors().into_iter().map(|(id, signals)| (id, signals.live.get_untracked()));
        let kept = ValuesOfNow { streams: streams.collect(), connectors: connectors.collect() };
        self.state().kept = Some(kept);
        set_if_new(&self.has_values, true);
    }

    /// The signals of values tell what is now again.
    pub(crate) fn show_now(&self) {
        let (kept, run) = {
            let mut state = self.state();
            (state.kept.take(), state.run)
        };
        let Some(mut kept) = kept else { return };
        for id in self.document.stream_ids.get_untracked() {
            if let Some(signals) = self.document.stream(&id) {
                set_if_new(&signals.live, kept.streams.remove(&id).unwrap_or_default());
            }
        }
        for (id, signals) in self.document.connectors() {
            let live = kept.connectors.remove(&id).unwrap_or_default();
            set_if_new(&signals.live, LiveConnector { lit: false, ..live });
        }
        set_if_new(&self.has_values, run != 0);
        self.renew_failing();
    }

    pub(in crate::desk) fn hear_runs(&self, runs: Vec<RunState>) {
        set_if_new(&self.runs, runs);
        self.clock.set(browser::now_ms());
        if let Some(run) = self.run_of_open() {
            self.belong_to(run.run);
        }
        self.follow_version();
        self.renew_failing();
    }

    /// Values still under way from a robot that this tab does not look at any more are dropped.
    pub(in crate::desk) fn hear_values(&self, values: Values) {
        let here = self.chosen_id();
        let elsewhere = |run: &RunState| run.run == values.run && Some(&run.robot) != here.as_ref();
        if self.runs.with_untracked(|runs| runs.iter().any(elsewhere)) {
            return;
        }
        if browser::is_calm() { self.hold_values(values) } else { self.show_values(values) }
    }

    /// For who wants little motion values change at most twice a second: what comes meanwhile waits, of each the newest.
    fn hold_values(&self, values: Values) {
        let begins = {
            let mut state = self.state();
            match &mut state.held {
                Some(held) if held.run == values.run => {
                    held.streams.retain(|old| values.streams.iter().all(|new| new.stream != old.stream));
                    held.connectors.retain(|old| values.connectors.iter().all(|new| new.connector != old.connector));
                    held.streams.extend(values.streams);
                    held.connectors.extend(values.connectors);
                    false
                }
                held => held.replace(values).is_none(),
            }
        };
        if begins {
            let robots = self.clone();
            browser::after(CALM_MS, move || {
                let held = robots.state().held.take();
                if let Some(values) = held {
                    robots.show_values(values);
                }
            });
        }
    }

    fn show_values(&self, values: Values) {
        self.belong_to(values.run);
        let now = browser::now_ms();
        values.streams.into_iter().for_each(|sample| self.hear_stream(sample, now));
        let fired: Vec<Id> =
            values.connectors.into_iter().filter_map(|sample| self.hear_connector(sample, now)).collect();
        if !fired.is_empty() {
            let robots = self.clone();
            browser::after(LIT_MS + 10, move || robots.dim(&fired));
        }
    }

    /// Begins anew with the run of the open program on the robot that this tab looks at.
    pub(super) fn values_of_open(&self) {
        self.belong_to(self.run_of_open().map_or(0, |run| run.run));
        self.follow_version();
    }

    /// Values of an earlier run are forgotten when another one begins.
    fn belong_to(&self, run: u64) {
        if std::mem::replace(&mut self.state().run, run) == run {
            return;
        }
        if let Some(kept) = &mut self.state().kept {
            *kept = ValuesOfNow::default();
            return;
        }
        self.document.streams().iter().for_each(|signals| set_if_new(&signals.live, LiveStream::default()));
        self.document.connectors().iter().for_each(|(_, signals)| set_if_new(&signals.live, LiveConnector::default()));
        set_if_new(&self.has_values, run != 0);
        self.renew_failing();
    }

    /// A connector does something else than before: what it did is forgotten, unless a run may still tell of it.
    pub(in crate::desk) fn rewritten(&self, connector: &ConnectorSignals) {
        if self.run_of_open().is_none() && self.state().kept.is_none() {
            set_if_new(&connector.live, LiveConnector::default());
        }
    }

    fn hear_stream(&self, sample: StreamSample, now: f64) {
        if let Some(kept) = &mut self.state().kept {
            return kept.streams.entry(sample.stream.clone()).or_default().hear(sample, now);
        }
        if let Some(signals) = self.document.stream(&sample.stream) {
            signals.live.update(|live| live.hear(sample, now));
        }
    }

    /// The connector's id if it has just passed something on.
    fn hear_connector(&self, sample: ConnectorSample, now: f64) -> Option<Id> {
        if let Some(kept) = &mut self.state().kept {
            kept.connectors.entry(sample.connector.clone()).or_default().hear(sample, now);
            return None;
        }
        let signals = self.document.connector(&sample.connector)?;
        let id = sample.connector.clone();
        let (fired, begins_to_fail) =
            signals.live.with_untracked(|live| (sample.fired > live.fired, sample.faults > 0 && live.faults == 0));
        signals.live.update(|live| live.hear(sample, now));
        if begins_to_fail {
            self.renew_failing();
        }
        fired.then_some(id)
    }

    /// Ends the light of connectors that have not fired again.
    fn dim(&self, fired: &[Id]) {
        if self.state().kept.is_some() {
            return;
        }
        let now = browser::now_ms();
        for signals in fired.iter().filter_map(|id| self.document.connector(id)) {
            let old = signals.live.with_untracked(|live| live.lit && now - live.fired_at >= f64::from(LIT_MS));
            if old {
                signals.live.update(|live| live.lit = false);
            }
        }
    }
}
