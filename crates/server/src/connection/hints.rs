//! What mends a problem, what streams carry, and whether the goal of an exercise is reached: looked for when somebody asks,
//! in the behaviour as it is saved.

use crate::library::exercises::{exercise, rehearse};
use crate::state::ServerState;
use crate::support::identity::Sender;
use behaviour::{Behaviour, BehaviourFile, Helper, Id, Knowledge, Problem, SeenKinds};
use protocol::{Refused, Reply};
use std::sync::Arc;
use uuid::Uuid;

/// What mends a problem.
pub(super) async fn fixes(
    state: &ServerState,
    sender: Sender,
    behaviour: &Id,
    (problem, seen): (Problem, SeenKinds),
) -> Result<Reply, Refused> {
    let look = state.rooms.look(behaviour).await?;
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let find = move || {
        let mut new_id = || Id::from_uuid(Uuid::new_v4());
        let helpers = snapshot.helpers();
        ::behaviour::fixes_seeing(&problem, look.behaviour(), (&helpers, &seen), &*knowing, &mut new_id)
    };
    Ok(Reply::Fixes { fixes: state.workers.run(sender, move |_| find()).await? })
}

/// What every stream carries, and the hints that only what was seen gives.
pub(super) async fn types(
    state: &ServerState,
    sender: Sender,
    behaviour: &Id,
    seen: SeenKinds,
) -> Result<Reply, Refused> {
    let look = state.rooms.look(behaviour).await?;
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let infer = move || {
        let helpers = snapshot.helpers();
        let types = ::behaviour::infer_seeing(look.behaviour(), &helpers, &*knowing, &seen);
        let hints =
            if seen.is_empty() { Vec::new() } else { by_what_was_seen(look.behaviour(), &helpers, &*knowing, &seen) };
        Reply::Types { types, hints }
    };
    let reply = state.workers.run(sender, move |_| infer()).await?;
    Ok(reply)
}

fn by_what_was_seen(of: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge, seen: &SeenKinds) -> Vec<Problem> {
    let known = ::behaviour::problems(of, helpers, knowledge);
    let all = ::behaviour::problems_seeing(of, helpers, knowledge, seen);
    all.into_iter().filter(|problem| !known.contains(problem)).collect()
}

/// Whether the goal of an exercise is reached.
pub(super) async fn try_exercise(
    state: &ServerState,
    sender: Sender,
    behaviour: &Id,
    name: &str,
    answers: Vec<u8>,
) -> Result<Reply, Refused> {
    let exercise = exercise(name).ok_or_else(|| Refused::NoTemplate(name.chars().take(40).collect()))?;
    let (look, snapshot) = (state.rooms.look(behaviour).await?, state.rooms.snapshot());
    let tried = state.workers.run(sender, move |token| {
        let file = BehaviourFile::of(look.behaviour(), &snapshot.helpers());
        rehearse(&file, &exercise.goal(), &answers, token)
    });
    Ok(Reply::Tried { tried: tried.await? })
}
