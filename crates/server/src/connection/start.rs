//! Starting a behaviour: its problems first, then the robot gets the file of the revision that is saved.

use crate::invitations::Identified;
use crate::robots::{StartError, StartOrder};
use crate::rooms::SavedLook;
use crate::state::ServerState;
use crate::support::identity::Sender;
use behaviour::{BehaviourFile, Problem};
use phrase::Phrased;
use protocol::{RecordedSession, Refused, request};
use std::sync::Arc;

/// Who starts something.
pub(crate) struct Starter {
    /// What they are called.
    pub(crate) name: String,
    /// Whose turn it is meanwhile.
    pub(crate) sender: Sender,
    /// As whom they are in.
    pub(crate) entry: Identified,
    /// The newest Stop of which they had heard.
    pub(crate) stops: Option<u64>,
}

/// Runs a behaviour on a robot, on the first one if none is named. A Stop of it that comes meanwhile wins.
pub(crate) async fn start(
    state: Arc<ServerState>,
    Starter { name: by, sender, entry, stops }: Starter,
    request::Start { behaviour, robot, record, session }: request::Start,
) -> Result<(), Refused> {
    let host = state.robots.meant(robot.as_ref())?;
    // Before anything is looked at, so that neither a Stop nor a removal can come between.
    let announced = host.announce(&behaviour, stops).map_err(StartError::cannot_start)?;
    let look = state.rooms.look(&behaviour).await?;
    let revision = look.revision();
    let file = ready(&state, sender, look).await?;
    if announced.is_cancelled() || state.tasks.ends() {
        return Err(StartError::StopPressed(announced.stopped_by()).cannot_start());
    }
    let (id, file, invitation) = (behaviour.clone(), file.into(), entry.invitation().cloned());
    let start = StartOrder { behaviour: id, revision, file, record, session, by: by.clone(), invitation };
    let begun = host.start_announced(&announced, start).await;
    if announced.is_cancelled() {
        return Err(begun.err().unwrap_or(StartError::StopPressed(announced.stopped_by())).cannot_start());
    }
    begun.map_err(StartError::cannot_start)?;
    // Revoked while it began, when it was not there to be told.
    if let (true, Some(invitation)) = (entry.is_over(), entry.invitation()) {
        state.robots.revoked(invitation);
    }
    tracing::info!(%behaviour, robot = %host.id(), revision, by, "a behaviour starts");
    Ok(())
}

/// Lets the running behaviour go on with the revision that is saved. If it is refused, what runs goes on as it is.
pub(crate) async fn apply(
    state: Arc<ServerState>,
    Starter { name: by, sender, stops, .. }: Starter,
    request::Apply { behaviour, robot }: request::Apply,
) -> Result<(), Refused> {
    let hosts = state.robots.running_since(&behaviour, robot.as_ref(), stops)?;
    let look = state.rooms.look(&behaviour).await?;
    let revision = look.revision();
    let file = ready(&state, sender, look).await.map_err(|no| match no {
        Refused::Problems(problems) => Refused::NotApplied(problems.first().map(Phrased::phrase).unwrap_or_default()),
        other => other,
    })?;
    let file = Arc::new(file);
    for host in hosts {
        let (behaviour, file, by) = (behaviour.clone(), file.clone(), by.clone());
        let session = RecordedSession::default();
        host.apply(StartOrder { behaviour, revision, file, record: false, session, by, invitation: None }, stops)
            .await
            .map_err(StartError::not_applied)?;
    }
    tracing::info!(%behaviour, revision, by, "an edited behaviour goes on");
    Ok(())
}

/// The file to run, if no problem stops it.
async fn ready(state: &ServerState, sender: Sender, look: SavedLook) -> Result<BehaviourFile, Refused> {
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let judge = move || {
        let helpers = snapshot.helpers();
        let mut problems = ::behaviour::problems(look.behaviour(), &helpers, &*knowing);
        problems.retain(|problem: &Problem| problem.blocks);
        if problems.is_empty() { Ok(BehaviourFile::of(look.behaviour(), &helpers)) } else { Err(problems) }
    };
    state.workers.run(sender, move |_| judge()).await?.map_err(Refused::Problems)
}
