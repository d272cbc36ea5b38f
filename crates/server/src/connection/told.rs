//! The sentences of a behaviour as it is saved, for pages that do not make them.

use crate::connection::start::Starter;
use crate::state::ServerState;
use behaviour::{Behaviour, Helper, Id, Knowledge, Unit, ValueType};
use protocol::{ProgramSentence, Refused, TOLD_MAX, answer, request};
use sentences::{Language, Sentence};
use std::sync::Arc;

/// The sentences of a behaviour in the language of this code, English if there is none.
pub(super) async fn told(
    state: Arc<ServerState>,
    who: Starter,
    request::Told { behaviour, language }: request::Told,
) -> Result<answer::Told, Refused> {
    let language = Language::ALL.into_iter().find(|known| known.code() == language).unwrap_or_default();
    let look = state.rooms.look(&behaviour).await?;
    let (snapshot, knowing) = (state.rooms.snapshot(), Arc::clone(&state.knowing));
    let tell = move || all(look.behaviour(), &snapshot.helpers(), &*knowing, language);
    let sentences = state.workers.run(who.sender, move |_| tell()).await?;
    Ok(answer::Told { sentences })
}

fn all(of: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge, language: Language) -> Vec<ProgramSentence> {
    let types = behaviour::infer(of, helpers, knowledge);
    // That it is a share says nothing beside a number.
    let unit = |id: &Id| match types.get(id) {
        Some(ValueType::Number { unit: Some(unit), .. }) if *unit != Unit::Fraction => Some(unit.symbol().to_owned()),
        _ => None,
    };
    sentences::explain(of, helpers, &unit, language).iter().take(TOLD_MAX).map(Sentence::told).collect()
}
