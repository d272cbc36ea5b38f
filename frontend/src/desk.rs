//! The open behaviour as signals, and the only writer: gestures propose changes, replies of the server change signals.
//!
//! Every field is its own `ArcRwSignal`, every record has its own signals, and nothing here lives in an owner's arena,
//! because replies arrive outside of any component.

mod accept;
mod address;
mod build;
mod failing;
mod files;
mod gestures;
mod hear;
mod kinds;
mod programs;
mod propose;
mod queue;
mod ran;
mod recordings;
mod robot_box;
mod robots;
mod running;
mod samples;
mod shelves;
mod silence;
mod undo;

pub(crate) use failing::Failing;
pub(crate) use files::{file_address, first_file};
pub(crate) use shelves::Shelf;

pub(crate) use kinds::{
    ConnectPlan, ConnectorSignals, Dialog, LinkState, Notice, Output, Saving, Selected, StreamSignals,
};

use behaviour::{Behaviour, Helper, Id, Place, Problem};
use leptos::prelude::*;
use protocol::{Person, Pointer, Recording, RobotState, RunPhase, RunState, Summary};
use robot::Scene;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Deref;
use std::sync::{Arc, Mutex};

/// The desk. A clone is the same desk.
#[derive(Clone, Default)]
pub(crate) struct Desk(Arc<Fields>);

/// What everything on the page shows.
#[derive(Default)]
pub(crate) struct Fields {
    pub(crate) online: ArcRwSignal<LinkState>,
    /// For how many seconds nothing was heard from the server, if that is too long to claim anything.
    pub(crate) unheard: ArcRwSignal<Option<u32>>,
    pub(crate) saving: ArcRwSignal<Saving>,
    /// Why the server cannot save now, if so.
    pub(crate) away: ArcRwSignal<Option<String>>,
    pub(crate) me: ArcRwSignal<Option<Person>>,
    /// Everyone in the open behaviour, this tab included.
    pub(crate) people: ArcRwSignal<Vec<Person>>,
    /// The newest programs.
    pub(crate) programs: ArcRwSignal<Vec<Summary>>,
    /// How many programs there are.
    pub(crate) programs_total: ArcRwSignal<u64>,
    /// Grows when the list of programs changed somewhere.
    pub(crate) library_news: ArcRwSignal<u32>,
    pub(crate) pictures: ArcRwSignal<shelves::Pictures>,
    /// True while a file is dragged over the page.
    pub(crate) dropping: ArcRwSignal<bool>,
    pub(crate) templates: ArcRwSignal<Vec<Summary>>,
    pub(crate) open: ArcRwSignal<Option<Id>>,
    pub(crate) name: ArcRwSignal<String>,
    pub(crate) revision: ArcRwSignal<u64>,
    /// In file order; changes only when one is added, removed or moved in order.
    pub(crate) stream_ids: ArcRwSignal<Vec<Id>>,
    pub(crate) connector_ids: ArcRwSignal<Vec<Id>>,
    /// The library, by name.
    pub(crate) helpers: ArcRwSignal<Vec<(Id, Helper)>>,
    pub(crate) problems: ArcRwSignal<Vec<Problem>>,
    /// What fails in the run of the open behaviour, or failed in its last one; what began last first.
    pub(crate) failing: ArcRwSignal<Vec<Failing>>,
    /// The connectors that the robot does not use yet as they are now.
    pub(crate) unused: ArcRwSignal<BTreeSet<Id>>,
    /// Whether there are values of a run, be it over or not.
    pub(crate) has_values: ArcRwSignal<bool>,
    /// Who removed what of the open behaviour and of the library, by its id.
    pub(crate) removed_by: ArcRwSignal<BTreeMap<Id, String>>,
    /// Tells whether what runs would run differently if it were started now.
    pub(crate) fingerprint: ArcRwSignal<u32>,
    /// Oldest first.
    pub(crate) robots: ArcRwSignal<Vec<RobotState>>,
    /// The one that this tab looks at.
    pub(crate) robot: ArcRwSignal<Option<RobotState>>,
    /// What runs on all robots and what ended lately.
    pub(crate) runs: ArcRwSignal<Vec<RunState>>,
    /// Whether the next Start is recorded.
    pub(crate) records: ArcRwSignal<bool>,
    /// The recordings that are kept, as they were when somebody looked.
    pub(crate) recordings: ArcRwSignal<Vec<Recording>>,
    pub(crate) scene: ArcRwSignal<Scene>,
    pub(crate) selected: ArcRwSignal<Option<Selected>>,
    pub(crate) dialog: ArcRwSignal<Option<Dialog>>,
    pub(crate) notice: ArcRwSignal<Option<Notice>>,
    pub(crate) can_undo: ArcRwSignal<bool>,
    pub(crate) can_redo: ArcRwSignal<bool>,
    /// `performance.now()`, renewed twice a second while the open behaviour runs; for "quiet for 3 s".
    pub(crate) clock: ArcRwSignal<f64>,
    state: Mutex<State>,
}

/// What is not shown itself.
#[derive(Default)]
struct State {
    /// The open behaviour as the server has it.
    confirmed: Behaviour,
    library: Behaviour,
    library_revision: u64,
    streams: BTreeMap<Id, StreamSignals>,
    connectors: BTreeMap<Id, ConnectorSignals>,
    /// Where streams stand that nobody placed.
    fallback: BTreeMap<Id, Place>,
    queue: queue::Queue,
    /// Changes that wait are shown before they are saved only while nothing can be saved, where the page says that they
    /// wait.
    show_waiting: bool,
    /// The server could not save the last change; it is sent again in a moment.
    stalled: bool,
    /// The server was asked too much at once; nothing is sent for a moment.
    slowed: bool,
    /// The server speaks again: how many changes that waited were sent since; none once that was said.
    back: Option<usize>,
    history: undo::History,
    /// Which behaviour this tab wants to have open.
    wanted: Option<Id>,
    /// The program that is to be made, until the server has answered.
    making: Option<programs::Making>,
    /// Which robot this tab wants to look at, if somebody chose.
    wanted_robot: Option<Id>,
    /// The robot whose room and values the server tells.
    watched: Option<Id>,
    /// What the robot is asked as soon as everything is saved.
    when_saved: Option<robot_box::Wish>,
    /// The run the live values belong to.
    run: u64,
    /// The version of the open behaviour that runs, if it runs, and what it has of what was changed since.
    version: Option<ran::Version>,
    ran: ran::Before,
    wanted_pictures: shelves::WantedPictures,
    pointer: Option<Pointer>,
    presence_planned: bool,
}

impl Deref for Desk {
    type Target = Fields;
    fn deref(&self) -> &Fields {
        &self.0
    }
}

/// The desk of this page; works in components and in everything they call while they are made.
pub(crate) fn use_desk() -> Desk {
    expect_context::<Desk>()
}

impl Desk {
    /// Connects, and opens what the address or this browser remembers.
    pub(crate) fn start_up(&self) {
        self.restore_queue();
        self.hear_drops();
        self.follow_address();
        crate::link::start(self.clone());
        let desk = self.clone();
        crate::browser::every(500, move || {
            if desk.run_of_open().is_some() {
                desk.clock.set(crate::browser::now_ms());
                desk.renew_failing();
            }
        });
    }

    /// The signals of one stream, none when it is gone.
    pub(crate) fn stream(&self, id: &Id) -> Option<StreamSignals> {
        self.state().streams.get(id).cloned()
    }

    /// The signals of one connector, none when it is gone.
    pub(crate) fn connector(&self, id: &Id) -> Option<ConnectorSignals> {
        self.state().connectors.get(id).cloned()
    }

    /// The open behaviour with what waits to be sent; not reactive (read `revision` for that).
    pub(crate) fn behaviour(&self) -> Behaviour {
        let state = self.state();
        match &state.wanted {
            Some(open) => state.queue.on_top_of(open, &state.confirmed),
            None => Behaviour::default(),
        }
    }

    /// The run of the open behaviour on the robot that this tab looks at, if it runs there. Reactive.
    pub(crate) fn running(&self) -> Option<RunState> {
        self.open.track();
        self.robot.track();
        self.runs.track();
        self.run_of_open()
    }

    fn run_of_open(&self) -> Option<RunState> {
        let open = self.open.get_untracked()?;
        let here = self.robot_id()?;
        let is_it = |run: &&RunState| run.behaviour == open && run.robot == here && run.phase == RunPhase::Running;
        self.runs.with_untracked(|runs| runs.iter().rfind(is_it).cloned())
    }

    /// Shows one sentence; `bad` for refusals and faults.
    pub(crate) fn say(&self, text: &str, bad: bool) {
        let number = self.notice.with_untracked(|now| now.as_ref().map_or(0, |notice| notice.number)) + 1;
        self.notice.set(Some(Notice { number, text: text.to_owned(), bad }));
    }

    /// Shows why something was not done.
    pub(crate) fn say_no(&self, no: &protocol::Refused) {
        self.say(&no.to_string(), true);
    }

    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// Sets a signal only if that changes something, so that nothing is drawn twice.
fn set_if_new<T: PartialEq + Send + Sync + 'static>(signal: &ArcRwSignal<T>, value: T) {
    if signal.with_untracked(|now| *now != value) {
        signal.set(value);
    }
}

fn new_id() -> Id {
    Id::from_uuid(uuid::Uuid::new_v4())
}
