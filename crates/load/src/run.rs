//! One load from beginning to end.

use crate::behaviours::{edits, make, note_of};
use crate::compare::{ExpectedBehaviours, Wrong, bytes, compare, differs};
use crate::dice::Dice;
use crate::editor::{Course, LoadEditor};
use crate::patience::patiently;
use crate::plan::LoadPlan;
use crate::report::Report;
use crate::stalled::stall;
use crate::watch::Watch;
use behaviour::Id;
use futures_util::{StreamExt, TryStreamExt};
use protocol::request;
use shell::{Client, ClientError, NoLink};
use std::collections::{BTreeMap, VecDeque};
use std::net::SocketAddr;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use tokio::task::JoinSet;
use tokio::time::Instant;

/// Clients that come in at once.
const COMING_MAX: usize = 32;
/// The longest time for clients, after the last edit, to know all of them.
const CALM: Duration = Duration::from_secs(30);
/// Between two looks whether they do.
const LOOK_MS: u64 = 20;

/// A load that can be watched and ended while it goes on.
pub struct Load {
    url: String,
    editors_url: String,
    plan: LoadPlan,
    watch: Watch,
}

/// Makes behaviours on the server at `url`, lets the clients of a plan edit them, and compares what all have in the end.
/// The behaviours stay there: see [`crate::Report::known`] and [`tidy`].
///
/// # Errors
/// If there is no server, or it does not let the clients in. What goes wrong later is in the report.
pub async fn run(url: &str, plan: &LoadPlan) -> Result<Report, ClientError> {
    Load::of(url, plan).run().await
}

impl Load {
    /// On the server at `url`.
    #[must_use]
    pub fn of(url: &str, plan: &LoadPlan) -> Self {
        Self { url: url.to_owned(), editors_url: url.to_owned(), plan: plan.clone(), watch: Watch::default() }
    }

    /// With the clients that edit at another address, such as that of a [`crate::chaos::Proxy`].
    #[must_use]
    pub fn through(self, editors_url: &str) -> Self {
        Self { editors_url: editors_url.to_owned(), ..self }
    }

    /// Returns the progress.
    #[must_use]
    pub fn watch(&self) -> Watch {
        self.watch.clone()
    }

    /// From beginning to end: see [`run`].
    ///
    /// # Errors
    /// If there is no server, or it does not let the clients in. What goes wrong later is in the report.
    pub async fn run(self) -> Result<Report, ClientError> {
        let Self { url, plan, .. } = &self;
        let maker = patiently(|| Client::connect(url, "Load")).await?;
        let run = maker.you().client.as_str().chars().take(8).collect::<String>();
        let mut behaviours = Vec::new();
        for number in 0..plan.behaviours.max(1) {
            behaviours.push(patiently(|| make(&maker, &run, number)).await?);
        }
        drop(maker);
        let cut_off = Arc::new(AtomicU64::new(0));
        let mut stalled = stalled(url, plan, &behaviours, &cut_off)?;
        let (mut editing, editors) = (JoinSet::new(), self.come(run, behaviours).await?);
        let began = Instant::now();
        for editor in editors {
            editing.spawn(editor.edit());
        }
        let mut editors = editing.join_all().await;
        editors.sort_by_key(LoadEditor::number);
        stalled.abort_all();
        let mut report = Report::of(plan.clone());
        report.took = began.elapsed();
        report.cut_off = cut_off.load(Ordering::Relaxed);
        judge(url, editors, &mut report).await?;
        Ok(report)
    }

    /// All clients come in, some at a time.
    async fn come(&self, run: String, behaviours: Vec<Id>) -> Result<Vec<LoadEditor>, ClientError> {
        let (plan, url, watch) = (self.plan.clone(), self.editors_url.clone(), self.watch.clone());
        let kills = kills(&plan);
        let course = Arc::new(Course { plan, url, run, behaviours, watch, began: OnceLock::new() });
        let come = kills.into_iter().enumerate().map(|(number, kills)| {
            let mut editor = LoadEditor::new(Arc::clone(&course), number, kills);
            async move { editor.join().await.map(|()| editor) }
        });
        futures_util::stream::iter(come).buffer_unordered(COMING_MAX).try_collect().await
    }
}

/// Chooses the times when the link of each client ends without a word.
fn kills(plan: &LoadPlan) -> Vec<VecDeque<u64>> {
    let mut dice = Dice::of(plan.seed, 0);
    let mut kills: Vec<VecDeque<u64>> = vec![VecDeque::new(); plan.clients];
    let mut at_us: Vec<u64> = (0..plan.kills).map(|_| dice.below(plan.seconds * 1_000_000)).collect();
    at_us.sort_unstable();
    for at_us in at_us {
        let whose = usize::try_from(dice.below(plan.clients as u64)).unwrap_or_default();
        kills.get_mut(whose).into_iter().for_each(|kills| kills.push_back(at_us));
    }
    kills
}

/// Puts the behaviours of a load into the bin.
///
/// # Errors
/// If there is no server, or it says no.
pub async fn tidy(url: &str, known: &ExpectedBehaviours) -> Result<(), ClientError> {
    let client = patiently(|| Client::connect(url, "Load")).await?;
    for behaviour in known.keys() {
        patiently(|| client.ask(request::Remove { behaviour: behaviour.clone() })).await?;
    }
    Ok(())
}

fn stalled(
    url: &str,
    plan: &LoadPlan,
    behaviours: &[Id],
    cut_off: &Arc<AtomicU64>,
) -> Result<JoinSet<()>, ClientError> {
    let mut tasks = JoinSet::new();
    if plan.stalled > 0 {
        let address = address(url)?;
        for number in 0..plan.stalled {
            let (behaviour, cut_off) = (behaviours[plan.behaviour_of(number)].clone(), Arc::clone(cut_off));
            tasks.spawn(stall(address, behaviour, move || _ = cut_off.fetch_add(1, Ordering::Relaxed)));
        }
    }
    Ok(tasks)
}

/// Reads the place of a server from its address.
fn address(url: &str) -> Result<SocketAddr, ClientError> {
    let bare = url.trim_start_matches("http://").trim_end_matches('/');
    let none = |error: std::net::AddrParseError| NoLink::NoServer { url: url.to_owned(), error: error.to_string() };
    bare.parse().map_err(|error| none(error).into())
}

/// Compares what all have: the clients, who comes anew, and who comes when nobody was there.
async fn judge(url: &str, editors: Vec<LoadEditor>, report: &mut Report) -> Result<(), ClientError> {
    let witness = patiently(|| Client::connect(url, "Witness")).await?;
    for editor in &editors {
        if !report.known.contains_key(editor.behaviour()) {
            let has = patiently(|| witness.load(editor.behaviour())).await?;
            report.known.insert(has.behaviour, (has.revision, bytes(&has.records)));
        }
    }
    drop(witness);
    let mut made = BTreeMap::<Id, u64>::new();
    for mut editor in editors {
        report.wrong.extend(settle(&mut editor, &report.known).await);
        *made.entry(editor.behaviour().clone()).or_default() += editor.tally.acknowledged;
        report.add(editor.end().await);
    }
    for (behaviour, (revision, _)) in &report.known {
        // It was made by one change.
        let wanted = 1 + made.get(behaviour).copied().unwrap_or_default();
        if *revision != wanted {
            report.wrong.push(Wrong::Changes { behaviour: behaviour.clone(), revision: *revision, wanted });
        }
    }
    report.wrong.extend(compare(url, "Who comes anew", &report.known).await?);
    Ok(())
}

/// Waits until a client knows all there is, and says what is wrong with what it has.
async fn settle(editor: &mut LoadEditor, known: &ExpectedBehaviours) -> Vec<Wrong> {
    let wanted = known.get(editor.behaviour()).map_or(0, |(revision, _)| *revision);
    let until = Instant::now() + CALM;
    while editor.replica().is_none_or(|has| has.revision < wanted) && Instant::now() < until {
        editor.be_there(until).await;
        tokio::time::sleep(Duration::from_millis(LOOK_MS)).await;
    }
    let Some(has) = editor.replica() else {
        return vec![Wrong::Unanswered { client: editor.number() }];
    };
    let acknowledged = editor.tally.acknowledged;
    let there = has.records.records.get(&note_of(editor.number())).and_then(edits).unwrap_or_default();
    let lost = (there != acknowledged).then_some(Wrong::Lost { client: editor.number(), acknowledged, there });
    differs(&editor.name(), &has, known).into_iter().chain(lost).collect()
}
