//! One client that edits its own note at a steady pace. What is not answered is sent again, under the same name, until
//! it is: nobody may lose an edit, and none may count twice.

use crate::behaviours::{due_us, note_of, op, text};
use crate::compare::Wrong;
use crate::patience::{PATIENCE, passes};
use crate::plan::LoadPlan;
use crate::times::Durations;
use crate::watch::Watch;
use behaviour::{Behaviour, Change, Id};
use protocol::{Credential, Event, answer, request};
use shell::{Client, ClientError, Mirror};
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::task::JoinHandle;
use tokio::time::Instant;

/// Before what could not be is tried again.
const AGAIN_MS: u64 = 20;
/// A link that ends without a word does so within this after an edit was sent, in microseconds.
const KILL_WITHIN_US: u64 = 4_000;

/// The state that all clients share.
pub(crate) struct Course {
    pub(crate) plan: LoadPlan,
    pub(crate) url: String,
    /// Tells this run from others on one server.
    pub(crate) run: String,
    /// The behaviours.
    pub(crate) behaviours: Vec<Id>,
    pub(crate) watch: Watch,
    /// The time when the first edit is due: known once all clients are there.
    pub(crate) began: OnceLock<Instant>,
}

impl Course {
    fn now_us(&self) -> u64 {
        self.began.get().map_or(0, |began| u64::try_from(began.elapsed().as_micros()).unwrap_or(u64::MAX))
    }
}

/// The record of what one client went through.
#[derive(Clone, Debug, Default)]
pub(crate) struct EditorTally {
    /// From when an edit was due until its sender was told that it is saved.
    pub(crate) echo: Durations,
    /// Until others were told.
    pub(crate) spread: Durations,
    /// Edits that are saved.
    pub(crate) acknowledged: u64,
    /// Edits that were sent again.
    pub(crate) again: u64,
    /// Links that were made anew.
    pub(crate) links: u64,
    pub(crate) wrong: Vec<Wrong>,
}

/// One client that edits.
pub(crate) struct LoadEditor {
    course: Arc<Course>,
    number: usize,
    link: Option<ServerLink>,
    again: Option<Credential>,
    /// The times when its link ends without a word, in microseconds.
    kills_us: VecDeque<u64>,
    pub(crate) tally: EditorTally,
}

/// A link, and who listens to what is told over it.
struct ServerLink {
    client: Client,
    listening: JoinHandle<Durations>,
}

impl LoadEditor {
    pub(crate) fn new(course: Arc<Course>, number: usize, kills_us: VecDeque<u64>) -> Self {
        Self { course, number, link: None, again: None, kills_us, tally: EditorTally::default() }
    }

    pub(crate) fn name(&self) -> String {
        format!("Client {}", self.number)
    }

    pub(crate) fn number(&self) -> usize {
        self.number
    }

    pub(crate) fn behaviour(&self) -> &Id {
        &self.course.behaviours[self.course.plan.behaviour_of(self.number)]
    }

    /// Returns its mirror of its behaviour.
    pub(crate) fn replica(&self) -> Option<Mirror> {
        self.link.as_ref()?.client.open()
    }

    /// Comes in and opens its behaviour.
    pub(crate) async fn connect(&mut self) -> Result<(), ClientError> {
        let mut client = Client::connect_again(&self.course.url, self.again.clone(), &self.name()).await?;
        self.again = Some(client.credential());
        let (course, told) = (Arc::clone(&self.course), client.take_told());
        let listening = tokio::spawn(listen(course, self.name(), told));
        let opened = client.load(self.behaviour()).await;
        self.link = Some(ServerLink { client, listening });
        opened.map(|_| ())
    }

    /// Comes in at first, again if the way there breaks or the store is away.
    pub(crate) async fn join(&mut self) -> Result<(), ClientError> {
        let until = Instant::now() + PATIENCE;
        loop {
            match self.connect().await {
                Err(error) if comes_again(&error) && Instant::now() < until => {
                    self.leave().await;
                    tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
                }
                other => return other,
            }
        }
    }

    /// Comes in again, however often it takes.
    async fn connect_until(&mut self, until: Instant) {
        self.leave().await;
        while self.connect().await.is_err() && Instant::now() < until {
            self.leave().await;
            tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
        }
        self.tally.links += 1;
    }

    /// Comes in again if its link ended.
    pub(crate) async fn be_there(&mut self, until: Instant) {
        if self.link.as_ref().is_none_or(|link| link.client.why_ended().is_some()) {
            self.connect_until(until).await;
        }
    }

    /// Ends the link without a word and keeps what was heard over it.
    async fn leave(&mut self) {
        if let Some(ServerLink { client, listening }) = self.link.take() {
            client.cut();
            if let Ok(spread) = listening.await {
                self.tally.spread.add(&spread);
            }
        }
    }

    /// Leaves for good.
    pub(crate) async fn end(mut self) -> EditorTally {
        self.leave().await;
        self.tally
    }

    /// Edits until the time is over and all is answered.
    pub(crate) async fn edit(mut self) -> Self {
        let (plan, began) = (self.course.plan.clone(), *self.course.began.get_or_init(Instant::now));
        let pause_us = plan.pause_us();
        let mut due_us = pause_us * self.number as u64 / plan.clients.max(1) as u64;
        while due_us < plan.seconds * 1_000_000 {
            tokio::select! {
                () = self.course.watch.ends.cancelled() => break,
                () = tokio::time::sleep_until(began + Duration::from_micros(due_us)) => {}
            }
            self.make(due_us).await;
            due_us += pause_us;
        }
        self
    }

    /// Makes one edit.
    async fn make(&mut self, due_us: u64) {
        let (change, until) = (self.change(due_us), Instant::now() + PATIENCE);
        while Instant::now() < until {
            match self.propose(&change).await {
                Ok(_) => {
                    self.tally.acknowledged += 1;
                    self.course.watch.one_more();
                    return self.tally.echo.note(self.course.now_us().saturating_sub(due_us));
                }
                Err(ClientError::No(no)) if passes(&no) => {
                    tokio::time::sleep(Duration::from_millis(AGAIN_MS)).await;
                }
                Err(ClientError::No(no)) => {
                    return self.tally.wrong.push(Wrong::Refused { client: self.number, no: Box::new(no) });
                }
                Err(ClientError::Link(_)) => self.connect_until(until).await,
            }
            self.tally.again += 1;
        }
        self.tally.wrong.push(Wrong::Unanswered { client: self.number });
    }

    /// The next edit of its note, as it knows it to be.
    fn change(&self, due_us: u64) -> Change {
        let (note, before) = (note_of(self.number), self.tally.acknowledged);
        let known = (before > 0).then(|| (note.clone(), text(self.number, before)));
        let now = Behaviour { records: known.into_iter().collect::<BTreeMap<_, _>>() };
        let op = op(&self.course.run, self.number, before + 1, due_us);
        Change::of(op, &self.name(), "Edit the note").put(&now, note, text(self.number, before + 1))
    }

    async fn propose(&mut self, change: &Change) -> Result<answer::Saved, ClientError> {
        let request =
            request::Propose { behaviour: self.behaviour().clone(), change: change.clone(), tokens: Vec::new() };
        let Some(ServerLink { client, .. }) = &self.link else { return Err(shell::NoLink::Closed.into()) };
        let kill_us = self.kills_us.front().copied().filter(|at_us| *at_us <= self.course.now_us());
        let Some(kill_us) = kill_us else { return client.ask(request).await };
        self.kills_us.pop_front();
        let within = Duration::from_micros(kill_us % KILL_WITHIN_US);
        match tokio::time::timeout(within, client.ask(request)).await {
            Ok(answer) => answer,
            Err(_) => Err(shell::NoLink::Closed.into()),
        }
    }
}

/// True if who could not come in may a moment later.
fn comes_again(error: &ClientError) -> bool {
    match error {
        ClientError::Link(_) => true,
        ClientError::No(no) => passes(no),
    }
}

/// Hears what is told over a link until it ends: how long the edits of others took.
async fn listen(course: Arc<Course>, own: String, mut told: mpsc::Receiver<Event>) -> Durations {
    let mut spread = Durations::default();
    while let Some(event) = told.recv().await {
        if let Event::Accepted { accepted, .. } = event
            && accepted.change.author != own
            && let Some(due_us) = due_us(&course.run, &accepted.change)
        {
            spread.note(course.now_us().saturating_sub(due_us));
        }
    }
    spread
}
