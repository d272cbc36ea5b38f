//! Starting a behaviour: its problems first, then the robot gets the file of the revision that is saved.

use crate::hub::Hub;
use crate::robots::{Host, Start};
use crate::rooms::Look;
use behaviour::{BehaviourFile, Id, Problem};
use protocol::{Reply, SaidNo};
use std::sync::Arc;

/// Runs a behaviour on a robot, on the first one if none is named. A Stop of that robot that comes meanwhile wins.
pub(crate) async fn start(
    hub: &Arc<Hub>,
    behaviour: Id,
    robot: Option<Id>,
    record: bool,
    by: String,
) -> Result<Reply, SaidNo> {
    let host = hub.robots.meant(robot.as_ref())?;
    let stops = host.stops();
    let stopped = |host: &Host| host.stops() != stops;
    let look = hub.look(&behaviour).await?;
    let revision = look.revision;
    let file = ready(hub, look).await?;
    if stopped(&host) || hub.ends() {
        return Err(SaidNo::CannotStart("Stop was pressed".to_owned()));
    }
    let start = Start { behaviour: behaviour.clone(), revision, file: file.into(), record, by: by.clone() };
    host.start(start).await.map_err(SaidNo::CannotStart)?;
    if stopped(&host) {
        host.stop(Some(&behaviour), &by);
        return Err(SaidNo::CannotStart("Stop was pressed".to_owned()));
    }
    tracing::info!(%behaviour, robot = %host.id(), revision, by, "a behaviour starts");
    Ok(Reply::Done)
}

/// Lets the running behaviour go on with the revision that is saved. If it is refused, what runs goes on as it is.
pub(crate) async fn apply(hub: &Arc<Hub>, behaviour: Id, robot: Option<Id>, by: String) -> Result<Reply, SaidNo> {
    let hosts = hub.robots.running(&behaviour, robot.as_ref())?;
    let look = hub.look(&behaviour).await?;
    let revision = look.revision;
    let file = ready(hub, look).await.map_err(|no| match no {
        SaidNo::Problems(problems) => not_applied(problems.first().map(ToString::to_string).unwrap_or_default()),
        other => other,
    })?;
    let file = Arc::new(file);
    for host in hosts {
        let (behaviour, file, by) = (behaviour.clone(), file.clone(), by.clone());
        host.apply(Start { behaviour, revision, file, record: false, by }).await.map_err(not_applied)?;
    }
    tracing::info!(%behaviour, revision, by, "an edited behaviour goes on");
    Ok(Reply::Done)
}

fn not_applied(reason: String) -> SaidNo {
    SaidNo::NotApplied(reason.trim_end_matches('.').to_owned())
}

/// Stops one behaviour or everything, on one robot or on all. Never waits. True if something ran.
pub(crate) fn stop(hub: &Hub, behaviour: Option<&Id>, robot: Option<&Id>, by: &str) -> bool {
    let ran = hub.robots.stop(behaviour, robot, by);
    let text = |id: Option<&Id>| id.map_or("all".to_owned(), ToString::to_string);
    tracing::info!(behaviour = text(behaviour), robot = text(robot), by, ran, "Stop");
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
