//! *Use my changes*, and whose they are where they are not all one's own: what somebody else changed is said before a robot
//! does it.

use super::instead::instead_of;
use crate::desk::{Desk, Unused};
use crate::forms::words;
use crate::layout;
use crate::parts::{hold, may_operate};
use behaviour::{Kind, Record};
use editor::unused::{UnusedAuthors, whose};
use leptos::prelude::*;

/// So many changes of others are told; of the rest, how many they are.
const TOLD_MAX: usize = 2;

/// What others changed and the button, as a view.
pub(crate) fn apply() -> AnyView {
    view! { <Told /> }.into_any()
}

#[component]
fn Told() -> impl IntoView {
    let desk = hold();
    let theirs = Memo::new(move |_| theirs(&desk.desk()));
    view! {
        {move || theirs.get().into_iter().map(|sentence| view! { <span>" · "{sentence}</span> }).collect_view()}
        " · "
        <Apply />
    }
}

/// The button; it says whose changes the robot would use.
#[component]
pub(super) fn Apply() -> impl IntoView {
    let desk = hold();
    let press = move |_| desk.desk().robots.apply();
    view! {
        <button class="link" type="button" disabled=move || !may_operate(desk) on:click=press>{move || whose_words(&desk.desk())}</button>
    }
}

/// *Use my changes*, *Use Ben’s changes*, or *Use all changes*. Reactive.
fn whose_words(desk: &Desk) -> String {
    match whose(&desk.robots.unused_changes()) {
        UnusedAuthors::Me => words::apply().to_owned(),
        UnusedAuthors::One(name) => words::apply_of(&name),
        UnusedAuthors::Several => words::apply_all().to_owned(),
    }
}

/// What others changed, a sentence each, and who is still at something of it. Reactive.
fn theirs(desk: &Desk) -> Vec<String> {
    let changes = desk.robots.unused_changes();
    let mut told: Vec<String> = changes.iter().filter_map(|change| told(desk, change)).collect();
    told.dedup();
    let more = told.len().saturating_sub(TOLD_MAX);
    told.truncate(TOLD_MAX);
    told.extend((more > 0).then(|| words::and_more(more as u64)));
    told.extend(desk.robots.unfinished().map(|(name, of)| words::still_edits(&name, &of)));
    told
}

/// "Ben changed Close ball: 40 → 60 cm". Reactive.
fn told(desk: &Desk, change: &Unused) -> Option<String> {
    let by = change.by.as_ref()?;
    let mut open = desk.document.behaviour();
    if let Some(was) = change.was.clone().filter(|_| change.is.is_none()) {
        open.records.insert(change.id.clone(), was);
    }
    let of = match (&change.is, &change.was) {
        (Some(Record::Helper(helper)), _) | (None, Some(Record::Helper(helper))) => helper.name.clone(),
        _ => layout::subject(&open, &change.id),
    };
    Some(match (&change.was, &change.is) {
        (Some(Record::Connector(was)), Some(Record::Connector(is))) if change.id.kind == Kind::Connector => {
            let unit = was.inputs.first().map_or("", |input| desk.document.measure(input, &[]).0);
            let [was, is] =
                [(was, is), (is, was)].map(|(one, other)| instead_of(&one.operation, &other.operation, unit));
            match (was, is) {
                (Some(was), Some(is)) => words::changed_from(by, &of, &was, &is),
                _ => words::changed_it(by, &of),
            }
        }
        (None, _) => words::added_it(by, &of),
        (_, None) => words::removed_of(by, &of),
        _ => words::changed_it(by, &of),
    })
}
