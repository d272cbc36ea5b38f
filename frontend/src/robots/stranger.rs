//! Another body answers at the robot's address: who was expected, who answers, and which one is meant.

use crate::desk::Dialog;
use crate::parts::{hold, may_operate};
use crate::robots::words;
use leptos::prelude::*;
use protocol::Role;
use robot::{Control, Health, Stranger};

/// The question, as a view; nothing while no stranger answers.
pub(crate) fn stranger() -> AnyView {
    view! { <Question /> }.into_any()
}

#[component]
fn Question() -> impl IntoView {
    let desk = hold();
    let who = Memo::new(move |_| match desk.desk().robots.health() {
        Health::Stranger(who) => Some(*who),
        _ => None,
    });
    view! { {move || who.get().map(|who| view! { <Card who /> })} }
}

#[component]
fn Card(who: Stranger) -> impl IntoView {
    let desk = hold();
    let name = untrack(|| desk.desk().robots.name());
    let found = StoredValue::new(who.found.clone());
    let accept = move |_| desk.desk().robots.accept(found.get_value());
    let change = move |_| desk.desk().dialog.set(Some(Dialog::ChangeAddress));
    let blink = move |_| desk.desk().robots.control(Control::Blink);
    let why = move || desk.desk().may_not(Role::Host);
    let is_host = move || why().is_none();
    view! {
        <section class="stranger" aria-labelledby="stranger-title">
            <h3 id="stranger-title">{words::stranger_question(&name)}</h3>
            <dl>
                <dt>{words::expected()}</dt>
                <dd>{words::who(&who.expected)}</dd>
                <dt>{words::answers()}</dt>
                <dd>{words::who(&who.found)}</dd>
            </dl>
            <button class="button" type="button" disabled=move || !may_operate(desk) on:click=blink>{words::blink()}</button>
            <button class="button" type="button" disabled=move || !is_host() on:click=accept>{words::accept_stranger()}</button>
            <button class="button" type="button" disabled=move || !is_host() on:click=change>{words::change_address()}</button>
            {move || why().map(|why| view! { <p class="faint">{why}</p> })}
        </section>
    }
}
