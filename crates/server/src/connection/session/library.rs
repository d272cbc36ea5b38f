//! The requests about all behaviours: lists, insight, making, helpers and trying procedures.

use crate::connection::start::Starter;
use crate::library::create::CreateRequest;
use crate::library::rename::RenameRequest;
use crate::library::thumbnails::{self, DrawingShare};
use crate::library::trial::{self, ProcedureTrial, helpers_of};
use crate::library::{bin, create, insight, list, rename};
use crate::state::ServerState;
use protocol::{Refused, answer, request};
use std::sync::Arc;
use tokio_util::sync::CancellationToken;

type State = Arc<ServerState>;

pub(super) async fn list(state: State, _: Starter, of: request::List) -> Result<answer::Programs, Refused> {
    list::list(&*state.store, of.query).await
}

pub(super) async fn pictures(state: State, who: Starter, of: request::Pictures) -> Result<answer::Pictures, Refused> {
    let (store, made, workers) = (&*state.store, &state.thumbnails, &state.workers);
    thumbnails::pictures(DrawingShare { store, made, workers, sender: who.sender }, of.of).await
}

pub(super) async fn where_used(state: State, _: Starter, of: request::WhereUsed) -> Result<answer::WhereUsed, Refused> {
    insight::where_used(&*state.store, &of.helper).await
}

pub(super) async fn drivers(state: State, _: Starter, of: request::Drivers) -> Result<answer::Drivers, Refused> {
    insight::drivers(&*state.store, &of.actuator).await
}

pub(super) async fn contested(state: State, _: Starter, _: request::Contested) -> Result<answer::Contested, Refused> {
    insight::contested(&*state.store).await
}

pub(super) async fn similar(state: State, _: Starter, of: request::Similar) -> Result<answer::Similar, Refused> {
    insight::similar(&*state.store, &of.behaviour).await
}

pub(super) async fn tags(state: State, _: Starter, _: request::Tags) -> Result<answer::Tags, Refused> {
    list::tags(&*state.store).await
}

pub(super) async fn create(state: State, who: Starter, of: request::Create) -> Result<answer::Created, Refused> {
    let request::Create { behaviour, name, template } = of;
    let wish = CreateRequest { behaviour, name, template, by: who.name, sender: who.sender };
    create::create(&state.library, wish).await
}

pub(super) async fn restore(state: State, _: Starter, of: request::Restore) -> Result<(), Refused> {
    bin::restore(&state.library, &of.behaviour).await
}

pub(super) async fn rename_helper(
    state: State,
    who: Starter,
    of: request::RenameHelper,
) -> Result<answer::HelperRenamed, Refused> {
    let request::RenameHelper { helper, seen, after } = of;
    let wish = RenameRequest { helper, seen: *seen, after: *after, by: who.name, sender: who.sender };
    rename::rename(&state.library, wish).await
}

/// Tries a procedure, among the other work.
pub(super) async fn check(state: State, who: Starter, of: request::Check) -> Result<answer::Checked, Refused> {
    let (snapshot, request::Check { arguments, body, inputs }) = (state.rooms.snapshot(), of);
    let check = move |_: &CancellationToken| {
        let all = snapshot.helpers();
        let known = all.iter().map(|helper| helper.name.clone()).collect();
        let helpers = helpers_of(&body, &all);
        trial::check(&ProcedureTrial { arguments, body, inputs, helpers, known })
    };
    Ok(state.workers.run(who.sender, check).await?)
}
