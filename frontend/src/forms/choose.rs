//! Choosing from a list what the canvas lets the hand choose in place: what comes next, and where a stream leads to.

use crate::desk::{GraphChoice, Joining, NewSpot, WireEnd, wire_ends};
use crate::dialogs::{Frame, close};
use crate::forms::words;
use crate::icons::Icon;
use crate::layout::chip_words;
use crate::parts::{DeskHold, Finder, hold};
use crate::steps::{Offer, Step, actions, everything, take};
use behaviour::Id;
use leptos::prelude::*;

/// One wire that may be drawn: from where, to where, and what is said of it.
#[derive(Clone)]
struct WireChoice {
    from: Id,
    end: WireEnd,
    title: String,
    says: String,
}

/// A choice as a dialog.
#[component]
pub(crate) fn Choose(choice: GraphChoice) -> impl IntoView {
    let desk = hold();
    match choice {
        GraphChoice::Action(id) => {
            let offers = untrack(|| actions(&desk.desk(), &id));
            view! { <Steps title=words::add_an_action().to_owned() offers input=id spot=NewSpot::default() /> }
                .into_any()
        }
        GraphChoice::Into(gap) => {
            let offers = untrack(|| everything(&desk.desk(), &gap.input, true));
            let (input, spot) = (gap.input.clone(), NewSpot::Into(gap));
            view! { <Steps title=words::insert_here().to_owned() offers input spot /> }.into_any()
        }
        GraphChoice::Ends(id) => {
            let name = name_of(desk, &id);
            let none = words::leads_everywhere(&name);
            view! { <Ways title=words::connect_named(&name) ways=ends(desk, &id) none /> }.into_any()
        }
        GraphChoice::Sources(id) => {
            let title = words::connect_to(&name_of(desk, &id));
            view! { <Ways title ways=sources(desk, &id) none=words::no_source_yet().to_owned() /> }.into_any()
        }
    }
}

#[component]
fn Steps(title: String, offers: Vec<Offer>, input: Id, spot: NewSpot) -> impl IntoView {
    let desk = hold();
    let choose = Callback::new(move |step: Step| {
        close(desk);
        take(&desk.desk(), &input, &step, spot.clone());
    });
    view! {
        <Frame title narrow=true save=Callback::new(|()| {})>
            <div class="dialog-body"><Finder offers choose /></div>
        </Frame>
    }
}

#[component]
fn Ways(title: String, ways: Vec<WireChoice>, none: String) -> impl IntoView {
    let desk = hold();
    let is_empty = ways.is_empty();
    let item = move |way: WireChoice| {
        let icon = if matches!(way.end, WireEnd::Connector(_)) { "bolt" } else { "connect" };
        let (title, says) = (way.title.clone(), way.says.clone());
        let draw = move |_| {
            close(desk);
            desk.desk().document.wire(&way.from, &way.end);
        };
        view! {
            <li>
                <button class="menu-item" type="button" on:click=draw>
                    <span class="kind plain"><Icon name=icon /></span>
                    <span class="two"><b>{title}</b><span class="second">{says}</span></span>
                </button>
            </li>
        }
    };
    view! {
        <Frame title narrow=true save=Callback::new(|()| {})>
            {is_empty.then(|| view! { <p class="dialog-body">{none}</p> })}
            <ul class="dialog-body big-list">{ways.into_iter().map(item).collect_view()}</ul>
        </Frame>
    }
}

/// Where a stream may be led to.
fn ends(desk: DeskHold, from: &Id) -> Vec<WireChoice> {
    let all = wire_ends(&desk.desk().document.behaviour(), from);
    all.into_iter().map(|(end, joining)| way(desk, from, end, joining, None)).collect()
}

/// The streams that may be led to one.
fn sources(desk: DeskHold, to: &Id) -> Vec<WireChoice> {
    let behaviour = desk.desk().document.behaviour();
    let end = WireEnd::Stream(to.clone());
    let from = |id: &Id| {
        let (end, joining) = wire_ends(&behaviour, id).into_iter().find(|(known, _)| *known == end)?;
        Some(way(desk, id, end, joining, Some(name_of(desk, id))))
    };
    behaviour.streams_in_order().into_iter().filter_map(|(id, _)| from(id)).collect()
}

fn way(desk: DeskHold, from: &Id, end: WireEnd, joining: Joining, title: Option<String>) -> WireChoice {
    let target = match &end {
        WireEnd::Stream(id) => name_of(desk, id),
        WireEnd::Connector(id) => {
            let signals = desk.desk().document.connector(id);
            signals.map(|signals| signals.record.with_untracked(chip_words).whole()).unwrap_or_default()
        }
    };
    let says = words::joining(joining, &target);
    WireChoice { from: from.clone(), end, title: title.unwrap_or(target), says }
}

fn name_of(desk: DeskHold, id: &Id) -> String {
    let signals = desk.desk().document.stream(id);
    signals.map(|signals| signals.record.with_untracked(|stream| stream.name.clone())).unwrap_or_default()
}
