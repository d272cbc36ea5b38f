//! The robots: the one that this tab looks at, what runs on it, what it tells, and what is asked of it.

mod choice;
mod failing;
mod order;
mod recordings;
mod runs;
mod starting;
mod theirs;
mod unused;
mod values;

use super::document::Document;
use super::library::LibraryPanel;
use super::tab::Tab;
use behaviour::Id;
pub(crate) use editor::unused::Unused;
use editor::unused::{Authors, RecordsBefore};
use leptos::prelude::*;
use protocol::{RobotState, RunState, Values};
use robot::Scene;
use std::collections::BTreeSet;
use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The robots. A clone is the same robots.
#[derive(Clone)]
pub(crate) struct RobotsPanel(Arc<RobotsFields>);

/// The state of the robots that the page shows.
pub(crate) struct RobotsFields {
    tab: Tab,
    document: Document,
    library: LibraryPanel,
    /// Every robot, oldest first.
    pub(crate) all: ArcRwSignal<Vec<RobotState>>,
    /// The one that this tab looks at.
    pub(crate) chosen: ArcRwSignal<Option<RobotState>>,
    /// The runs on all robots, with those that ended lately.
    pub(crate) runs: ArcRwSignal<Vec<RunState>>,
    /// True if the next Start is recorded.
    pub(crate) records: ArcRwSignal<bool>,
    pub(crate) scene: ArcRwSignal<Scene>,
    /// The failures in the run of the open behaviour, or in its last one; the one that began last first.
    pub(crate) failing: ArcRwSignal<Vec<failing::Failing>>,
    /// The connectors, and the streams with settings, that the robot does not use yet as they are now.
    pub(crate) unused: ArcRwSignal<BTreeSet<Id>>,
    /// True if there are values of a run, be it over or not.
    pub(crate) has_values: ArcRwSignal<bool>,
    /// `performance.now()`, renewed twice a second while the open behaviour runs; for "quiet for 3 s".
    pub(crate) clock: ArcRwSignal<f64>,
    state: Mutex<RobotsState>,
}

/// The state that is not shown itself.
#[derive(Default)]
struct RobotsState {
    /// The robot that this tab wants to look at, if somebody chose.
    wanted: Option<Id>,
    /// The robot whose room and values the server tells.
    watched: Option<Id>,
    /// The press that is put to the robot as soon as everything is saved.
    when_saved: Option<starting::WaitingPress>,
    /// The run the live values belong to.
    run: u64,
    /// Values that wait to be shown, while nothing shall change often.
    held: Option<Values>,
    /// The version of the open behaviour that runs, if it runs, and what it has of what was changed since.
    version: Option<unused::RobotVersion>,
    before: RecordsBefore,
    /// Values of now, while the graph shows those of a moment of the past.
    kept: Option<values::ValuesOfNow>,
    authors: Authors,
}

impl Deref for RobotsPanel {
    type Target = RobotsFields;
    fn deref(&self) -> &RobotsFields {
        &self.0
    }
}

impl RobotsPanel {
    /// No robot yet.
    pub(super) fn new(tab: Tab, document: Document, library: LibraryPanel) -> Self {
        Self(Arc::new(RobotsFields {
            tab,
            document,
            library,
            all: ArcRwSignal::default(),
            chosen: ArcRwSignal::default(),
            runs: ArcRwSignal::default(),
            records: ArcRwSignal::default(),
            scene: ArcRwSignal::default(),
            failing: ArcRwSignal::default(),
            unused: ArcRwSignal::default(),
            has_values: ArcRwSignal::default(),
            clock: ArcRwSignal::default(),
            state: Mutex::default(),
        }))
    }

    fn state(&self) -> MutexGuard<'_, RobotsState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
