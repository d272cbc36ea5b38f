//! The left list: find or add senses, helpers and actions.

mod finding;
mod words;

use crate::desk::{CarriedItem, Dialog, ListItem, Selected};
use crate::escape;
use crate::fields::SentenceField;
use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::later::Later;
use crate::parts::{DeskHold, MayNot, hold, may_edit};
use crate::parts::{device_icon, kind_class};
use crate::steps::lead_to_action;
use behaviour::{Id, Params, Procedure, Stream, StreamKind, sort_few};
use editor::find;
pub(crate) use finding::Find;
use leptos::prelude::*;
use robot::Device;
use web_sys::PointerEvent;

/// At most so many streams of the open program are listed.
const HERE_MAX: usize = 30;

/// The left list.
#[component]
pub(crate) fn Palette() -> impl IntoView {
    let desk = hold();
    let typing = SentenceField::new();
    let search = typing.text;
    let may_be_sentence = Memo::new(move |_| is_longer(&search.read()));
    let key = move |event: web_sys::KeyboardEvent| {
        if event.pressed() == "Enter" {
            match untrack(|| goes_to(desk, typing)) {
                Some(id) => desk.desk().document.choose([Selected::Stream(id)].into()),
                None => typing.entered.update(|entered| *entered += 1),
            }
        }
        let clear = || {
            let is_typed = !search.read_untracked().is_empty();
            if is_typed {
                search.set(String::new());
            }
            is_typed
        };
        if escape::may_end(&event, clear) {
            event.stop_propagation();
        }
    };
    view! {
        <nav
            class="left"
            class:typing=move || typing.open.get()
            aria-label=words::palette_name()
            on:keydown=|event| focus::walk(&event, "ArrowDown", "ArrowUp")
            on:focusin=|event| focus::remember(&event)
        >
            <div class="find">
                <Icon name="search" />
                <input
                    class="input"
                    id="find"
                    type="search"
                    data-stop=""
                    tabindex="0"
                    placeholder=words::name_or_sentence()
                    aria-label=words::palette_name()
                    prop:value=move || search.get()
                    on:input:target=move |event| search.set(event.target().value())
                    on:keydown=key
                    on:paste=move |event| typing.paste(&event)
                    on:keyup=move |event| typing.follow(&event)
                    on:pointerup=move |event| typing.follow(&event)
                    on:blur=move |event| typing.follow(&event)
                    on:scroll=move |event| typing.follow(&event)
                />
                {move || may_be_sentence.get().then(|| view! { <Later show=move |rest| (rest.typed)(typing) /> })}
            </div>
            <MayNot />
            <div class="list" on:touchmove=move |event| keep_list(desk, &event)>
                <Here typing />
                <AlsoFound typing />
                <Senses typing />
                <Helpers typing />
                <Actions typing />
            </div>
        </nav>
    }
}

/// A pointer went down on something of the list, which may become a way to the graph. The canvas hears what comes of it.
fn take_up(desk: DeskHold, event: &PointerEvent, item: ListItem) {
    let desk = desk.desk();
    let may = untrack(|| desk.document.open.read().is_some() && desk.may(protocol::Role::Editor));
    // From a dialog nothing is carried: the graph lies behind it.
    let may = may && desk.dialog.with_untracked(Option::is_none);
    if !may || !event.is_primary() || event.button() != 0 {
        return;
    }
    let at = (f64::from(event.client_x()), f64::from(event.client_y()));
    let by_finger = event.pointer_type() == "touch";
    desk.carried.set(Some(CarriedItem::pressed(item, event.pointer_id(), at, by_finger)));
}

/// While a finger carries something the list does not scroll.
fn keep_list(desk: DeskHold, event: &web_sys::TouchEvent) {
    let held = desk.desk().carried.with_untracked(|carried| carried.as_ref().is_some_and(CarriedItem::is_held));
    if held && event.cancelable() {
        event.prevent_default();
    }
}

/// Whether what is typed may be more than a name; the second piece knows whether it is a sentence.
fn is_longer(text: &str) -> bool {
    text.split_whitespace().nth(1).is_some() || text.chars().any(|c| c as u32 > 0x3000)
}

/// Whether something is found by what is typed: a name, or a sentence in which it is named. Reactive.
fn is_found(typing: SentenceField, names: &[&str]) -> bool {
    let text = typing.text.read();
    find::is_found(&text, typing.open.get(), names)
}

/// Over the list, while a sentence is typed.
#[component]
fn AlsoFound(typing: SentenceField) -> impl IntoView {
    view! { <Show when=move || typing.open.get()><p class="also">{words::also_found()}</p></Show> }
}

/// The heading of a part of the list; while a sentence is typed, only over something.
#[component]
fn Heading(typing: SentenceField, text: &'static str, none: Signal<bool>) -> impl IntoView {
    view! { <Show when=move || !(typing.open.get() && none.get())><h2>{text}</h2></Show> }
}

/// Its name in files and in the literature, small, where that is another one. The style writes it, as it is no part of what
/// the button is called.
fn technical(plain: &str, name: &str) -> Option<impl IntoView + use<>> {
    (plain != name).then(|| view! { <code class="technical" aria-hidden="true" data-name=name.to_owned()></code> })
}

#[component]
fn Senses(typing: SentenceField) -> impl IntoView {
    let desk = hold();
    let item = move |device: &'static Device| {
        let closed = move || (desk.desk().document.open.read().is_none() || !may_edit(desk)).to_string();
        let add = move |_| {
            if desk.desk().document.open.read_untracked().is_some() && untrack(|| may_edit(desk)) {
                desk.desk().document.add_sensor(device, Params::new());
            }
        };
        let label = words::add_named(words::device(device));
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=words::device_says(device) aria-label=label
                aria-disabled=closed on:click=add on:pointerdown=move |event| take_up(desk, &event, ListItem::Sense(device))>
                <span class="kind sensor"><Icon name=device.icon /></span>
                <span class="named"><span class="cut">{words::device(device)}</span> {technical(words::device(device), device.name)}</span>
            </button>
        }
    };
    let found = Memo::new(move |_| {
        let is_found = |device: &&'static Device| is_found(typing, &[device.name, device.label, words::device(device)]);
        robot::sensors().filter(is_found).collect::<Vec<_>>()
    });
    view! {
        <Heading typing text=words::senses() none=Signal::derive(move || found.read().is_empty()) />
        {move || found.get().into_iter().map(item).collect_view()}
    }
}

#[component]
fn Helpers(typing: SentenceField) -> impl IntoView {
    let desk = hold();
    let item = move |(id, helper): (Id, behaviour::Helper)| {
        let name = helper.name.clone();
        let used = move || {
            let count = uses_of(desk, &name);
            (count > 0).then(|| view! { <span class="faint">{words::uses(count)}</span> })
        };
        let edit = move |_| desk.desk().dialog.set(Some(Dialog::Helper(Some(id.clone()))));
        let carried = helper.clone();
        let plain = words::helper_name_of(&helper);
        let technical = technical(&plain, &helper.name);
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=words::what_helper_does(&helper)
                on:click=edit on:pointerdown=move |event| take_up(desk, &event, ListItem::Helper(carried.clone()))>
                <span class="kind plain"><Icon name="fx" /></span>
                <span class="named"><span class="cut">{plain}</span> {technical}</span>
                {used}
            </button>
        }
    };
    let found = Memo::new(move |_| {
        let helpers = desk.desk().library.helpers.get();
        let is_found =
            |(_, helper): &(Id, behaviour::Helper)| is_found(typing, &[&helper.name, &words::helper_name_of(helper)]);
        helpers.into_iter().filter(is_found).collect::<Vec<_>>()
    });
    view! {
        <Heading typing text=words::helpers() none=Signal::derive(move || found.read().is_empty()) />
        {move || found.get().into_iter().map(item).collect_view()}
    }
}

/// The streams of the open program, while something is looked for.
#[component]
fn Here(typing: SentenceField) -> impl IntoView {
    let desk = hold();
    let found = move || {
        if typing.text.read().trim().is_empty() {
            return None;
        }
        let signals = |id: Id| Some((desk.desk().document.stream(&id)?.record.get(), id));
        let streams = desk.desk().document.stream_ids.get().into_iter().filter_map(signals);
        let mut rows: Vec<_> = streams.filter(|(stream, _)| is_found(typing, &[&stream.name])).collect();
        let near = |stream: &Stream| find::nearness(&typing.text.read(), &stream.name);
        sort_few(&mut rows, |(one, _), (other, _)| near(one) < near(other));
        rows.truncate(HERE_MAX);
        let none = rows.is_empty();
        if none && typing.open.get() {
            return None;
        }
        let row = move |(stream, id): (behaviour::Stream, Id)| {
            let label = words::go_to(&stream.name);
            let go = move |_| desk.desk().document.choose([Selected::Stream(id.clone())].into());
            view! {
                <button class="item" type="button" data-stop="" tabindex="-1" aria-label=label title=stream.name.clone() on:click=go>
                    <span class=format!("kind {}", kind_class(stream.kind))>{device_icon(&stream).map(|name| view! { <Icon name /> })}</span>
                    <span class="cut">{stream.name.clone()}</span>
                </button>
            }
        };
        Some(view! {
            <h2>{words::in_this_program()}</h2>
            {none.then(|| view! { <p class="hint">{words::nothing_here()}</p> })}
            {rows.into_iter().map(row).collect_view()}
        })
    };
    view! { {found} }
}

/// The stream that Enter goes to. Reactive.
fn goes_to(desk: DeskHold, typing: SentenceField) -> Option<Id> {
    let document = &desk.desk().document;
    let named = |id: Id| Some((document.stream(&id)?.record.with(|stream| stream.name.clone()), id));
    let streams = document.stream_ids.get().into_iter().filter_map(named);
    find::nearest(&typing.text.read(), typing.open.get(), streams)
}

/// How many connectors of the open program use a helper. Reactive.
pub(crate) fn uses_of(desk: DeskHold, helper: &str) -> usize {
    users_of(desk, helper).len()
}

/// The connectors of the open program that use a helper. Reactive.
pub(crate) fn users_of(desk: DeskHold, helper: &str) -> Vec<Id> {
    let desk = desk.desk();
    let ids = desk.document.connector_ids.get();
    let uses = |id: &Id| {
        let record = desk.document.connector(id).map(|signals| signals.record);
        record.is_some_and(|record| match record.read().operation.procedure() {
            Some(Procedure::Helper(name)) => name == helper,
            Some(Procedure::Body { .. }) | None => false,
        })
    };
    ids.into_iter().filter(uses).collect()
}

#[component]
fn Actions(typing: SentenceField) -> impl IntoView {
    let desk = hold();
    let source = Memo::new(move |_| selected_source(desk));
    let item = move |device: &'static Device| {
        let label = words::lead_to(words::device(device));
        view! {
            <button class="item" type="button" data-stop="" tabindex="-1" title=words::device_says(device) aria-label=label
                aria-disabled=move || source.read().is_none().to_string()
                on:click=move |_| subscribe(desk, source.get_untracked(), device)
                on:pointerdown=move |event| take_up(desk, &event, ListItem::Action(device))>
                <span class="kind actuator"><Icon name=device.icon /></span>
                <span class="named"><span class="cut">{words::device(device)}</span> {technical(words::device(device), device.name)}</span>
            </button>
        }
    };
    let found = Memo::new(move |_| {
        let is_found = |device: &&'static Device| is_found(typing, &[device.name, device.label, words::device(device)]);
        robot::actuators().filter(is_found).collect::<Vec<_>>()
    });
    let none = Signal::derive(move || found.read().is_empty());
    view! {
        <Heading typing text=words::actions() none />
        <Show when=move || source.read().is_none() && may_edit(desk) && !(typing.open.get() && none.get())>
            <p class="hint">{words::choose_stream_first()}</p>
        </Show>
        {move || found.get().into_iter().map(item).collect_view()}
    }
}

/// The selected stream, if something can come out of it. Reactive.
fn selected_source(desk: DeskHold) -> Option<Id> {
    let desk = desk.desk();
    let Some(Selected::Stream(id)) = desk.document.selected.get() else { return None };
    let record = desk.document.stream(&id)?.record;
    (record.read().kind != StreamKind::Actuator && desk.may(protocol::Role::Editor)).then_some(id)
}

fn subscribe(desk: DeskHold, source: Option<Id>, device: &'static Device) {
    if let Some(input) = source {
        lead_to_action(&desk.desk(), input, device);
    }
}
