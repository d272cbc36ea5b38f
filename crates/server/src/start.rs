//! Starting a behaviour: its problems first, then the robot gets the file of the revision that is saved.

use crate::hub::Hub;
use crate::robots::Start;
use crate::rooms::Look;
use behaviour::{BehaviourFile, Id, Problem};
use protocol::{Reply, SaidNo};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Runs a behaviour. A Stop that comes meanwhile wins.
pub(crate) async fn start(hub: &Arc<Hub>, behaviour: Id, record: bool, by: String) -> Result<Reply, SaidNo> {
    let stops = hub.stops.load(Ordering::SeqCst);
    let stopped = |hub: &Hub| hub.stops.load(Ordering::SeqCst) != stops;
    let look = hub.look(&behaviour).await?;
    let revision = look.revision;
    let file = ready(hub, look).await?;
    if stopped(hub) || hub.ends() {
        return Err(SaidNo::CannotStart("Stop was pressed".to_owned()));
    }
    let start = Start { behaviour: behaviour.clone(), revision, file: file.into(), record, by: by.clone() };
    hub.robots.start(start).await.map_err(SaidNo::CannotStart)?;
    if stopped(hub) {
        hub.robots.stop(Some(&behaviour), &by);
        return Err(SaidNo::CannotStart("Stop was pressed".to_owned()));
    }
    tracing::info!(%behaviour, revision, by, "a behaviour starts");
    Ok(Reply::Done)
}

/// Lets the running behaviour go on with the revision that is saved. If it is refused, what runs goes on as it is.
pub(crate) async fn apply(hub: &Arc<Hub>, behaviour: Id, by: String) -> Result<Reply, SaidNo> {
    if !hub.robots.is_running(&behaviour) {
        return Err(SaidNo::NotRunning);
    }
    let look = hub.look(&behaviour).await?;
    let revision = look.revision;
    let file = ready(hub, look).await.map_err(|no| match no {
        SaidNo::Problems(problems) => not_applied(problems.first().map(ToString::to_string).unwrap_or_default()),
        other => other,
    })?;
    let start = Start { behaviour: behaviour.clone(), revision, file: file.into(), record: false, by: by.clone() };
    hub.robots.apply(start).await.map_err(not_applied)?;
    tracing::info!(%behaviour, revision, by, "an edited behaviour goes on");
    Ok(Reply::Done)
}

fn not_applied(reason: String) -> SaidNo {
    SaidNo::NotApplied(reason.trim_end_matches('.').to_owned())
}

/// Stops one behaviour, or all. Never waits. True if something ran.
pub(crate) fn stop(hub: &Hub, behaviour: Option<&Id>, by: &str) -> bool {
    hub.stops.fetch_add(1, Ordering::SeqCst);
    let ran = hub.robots.stop(behaviour, by);
    tracing::info!(behaviour = behaviour.map_or("all", Id::as_str), by, ran, "Stop");
    ran
}

/// The file to run, if no problem stops it.
async fn ready(hub: &Arc<Hub>, look: Look) -> Result<BehaviourFile, SaidNo> {
    let (shelf, knowing) = (hub.shelf(), Arc::clone(&hub.knowing));
    let judge = move || {
        let helpers = shelf.helpers();
        let mut problems = behaviour::problems(&look.behaviour, &helpers, &*knowing);
        problems.retain(|problem: &Problem| problem.blocks);
        if problems.is_empty() { Ok(BehaviourFile::of(&look.behaviour, &helpers)) } else { Err(problems) }
    };
    let judged = tokio::task::spawn_blocking(judge).await;
    judged.map_err(|error| SaidNo::CannotStart(error.to_string()))?.map_err(SaidNo::Problems)
}
