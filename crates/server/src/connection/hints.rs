//! What mends a problem, what streams carry, and whether the goal of an exercise is reached: looked for when somebody asks,
//! in the behaviour as it is saved.

use crate::connection::start::Starter;
use crate::library::exercises::{exercise, rehearse};
use crate::state::ServerState;
use behaviour::{Behaviour, BehaviourFile, Helper, Id, Knowledge, Problem, SeenKinds};
use protocol::{Refused, answer, request};
use std::sync::Arc;
use uuid::Uuid;

/// What mends a problem.
pub(super) async fn fixes(
    state: Arc<ServerState>,
    who: Starter,
    request::Fixes { behaviour, problem, seen }: request::Fixes,
) -> Result<answer::Fixes, Refused> {
    let look = state.rooms.look(&behaviour).await?;
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let find = move || {
        let mut new_id = || Id::from_uuid(Uuid::new_v4());
        let helpers = snapshot.helpers();
        ::behaviour::fixes_seeing(&problem, look.behaviour(), (&helpers, &seen), &*knowing, &mut new_id)
    };
    Ok(answer::Fixes { fixes: state.workers.run(who.sender, move |_| find()).await? })
}

/// What every stream carries, and the hints that only what was seen gives.
pub(super) async fn types(
    state: Arc<ServerState>,
    who: Starter,
    request::Types { behaviour, seen }: request::Types,
) -> Result<answer::Types, Refused> {
    let look = state.rooms.look(&behaviour).await?;
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let infer = move || {
        let helpers = snapshot.helpers();
        let types = ::behaviour::infer_seeing(look.behaviour(), &helpers, &*knowing, &seen);
        let hints =
            if seen.is_empty() { Vec::new() } else { by_what_was_seen(look.behaviour(), &helpers, &*knowing, &seen) };
        answer::Types { types, hints }
    };
    Ok(state.workers.run(who.sender, move |_| infer()).await?)
}

fn by_what_was_seen(of: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge, seen: &SeenKinds) -> Vec<Problem> {
    let known = ::behaviour::problems(of, helpers, knowledge);
    let all = ::behaviour::problems_seeing(of, helpers, knowledge, seen);
    all.into_iter().filter(|problem| !known.contains(problem)).collect()
}

/// Whether the goal of an exercise is reached.
pub(super) async fn try_exercise(
    state: Arc<ServerState>,
    who: Starter,
    request::TryExercise { behaviour, exercise: name, answers }: request::TryExercise,
) -> Result<answer::Tried, Refused> {
    let exercise = exercise(&name).ok_or_else(|| Refused::NoTemplate(name.chars().take(40).collect()))?;
    let (look, snapshot) = (state.rooms.look(&behaviour).await?, state.rooms.snapshot());
    let tried = state.workers.run(who.sender, move |token| {
        let file = BehaviourFile::of(look.behaviour(), &snapshot.helpers());
        rehearse(&file, &exercise.goal(), &answers, token)
    });
    Ok(answer::Tried { tried: tried.await? })
}
