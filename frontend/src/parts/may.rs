//! What one may not do is shown disabled, and beside it why.

use super::hold::{DeskHold, hold};
use leptos::prelude::*;
use protocol::Role;

/// Says why this person may not do what needs that role; nothing for who may.
#[component]
pub(crate) fn MayNot(#[prop(default = Role::Editor)] least: Role) -> impl IntoView {
    let desk = hold();
    let why = Memo::new(move |_| desk.desk().may_not(least));
    move || why.get().map(|why| view! { <p class="may-not">{why}</p> })
}

/// Returns true if this person may edit. Reactive.
pub(crate) fn may_edit(desk: DeskHold) -> bool {
    desk.desk().may(Role::Editor)
}

/// Returns true if this person may run things on robots and use their rooms. Reactive.
pub(crate) fn may_operate(desk: DeskHold) -> bool {
    desk.desk().may(Role::Operator)
}

/// The title of something that needs a role: what it does, or why one may not.
pub(crate) fn title_or_why(desk: DeskHold, least: Role, title: &str) -> String {
    desk.desk().may_not(least).unwrap_or(title).to_owned()
}
