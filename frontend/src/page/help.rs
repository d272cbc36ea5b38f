//! Keys and commands: everything that can be done, to be searched and done.

use crate::browser;
use crate::commands::{CommandGroup, PageCommand, all, group_label};
use crate::desk::{Desk, Selected};
use crate::dialogs::{Frame, close};
use crate::focus::FocusPlace;
use crate::keys::PressedKey;
use crate::page::words;
use crate::parts::{DeskHold, hold};
use behaviour::Id;
use leptos::prelude::*;

/// At most so many streams are listed.
const STREAMS_MAX: usize = 12;

/// The palette of commands.
#[component]
pub(crate) fn Commands() -> impl IntoView {
    let desk = hold();
    let search = RwSignal::new(String::new());
    let commands = StoredValue::new_local(all());
    let found = Memo::new(move |_| search.with(|search| indices(desk, search, commands)));
    let streams = Memo::new(move |_| search.with(|search| streams(desk, search)));
    let first = Callback::new(move |()| {
        if search.with_untracked(|search| search.trim().is_empty()) {
            return;
        }
        match (found.get_untracked().first(), streams.get_untracked().first()) {
            (Some(at), _) => run(desk, nth(commands, *at)),
            (None, Some((id, _))) => go(desk, id),
            (None, None) => {}
        }
    });
    let groups =
        [CommandGroup::Robot, CommandGroup::Program, CommandGroup::Graph, CommandGroup::View, CommandGroup::People];
    let rows = move |group: CommandGroup| {
        let mine: Vec<usize> = found.get().into_iter().filter(|at| nth(commands, *at).group == group).collect();
        (!mine.is_empty()).then(|| {
            view! {
                <section class="commands-group">
                    <h3>{group_label(group)}</h3>
                    {mine.into_iter().map(|at| view! { <Row command=nth(commands, at) /> }).collect_view()}
                </section>
            }
        })
    };
    let here = move || {
        let streams = streams.get();
        (!streams.is_empty()).then(|| view! {
            <section class="commands-group">
                <h3>{words::in_this_program()}</h3>
                {streams.into_iter().map(|(id, name)| view! {
                    <button type="button" class="menu-item" on:click=move |_| go(desk, &id)><span class="cut">{name}</span></button>
                }).collect_view()}
            </section>
        })
    };
    view! {
        <Frame title=words::keys_and_gestures() save=first>
            <div class="dialog-body commands">
                <input class="input" type="search" data-first="" placeholder=words::search_commands()
                    aria-label=words::search_commands() prop:value=move || search.get()
                    on:keydown=|event| to_list(&event)
                    on:input:target=move |event| search.set(event.target().value()) />
                <div class="commands-list">
                    {here}
                    {groups.map(|group| view! { {move || rows(group)} }).collect_view()}
                    <Show when=move || search.with(|search| search.is_empty())>
                        <section class="commands-group">
                            <h3>{words::by_hand()}</h3>
                            <p><span>{words::help_extend_says()}</span><span class="second">{words::help_extend()}</span></p>
                            <p><span>{words::help_pan_says()}</span><span class="second">{words::help_pan()}</span></p>
                            <p><span>{words::help_lasso_says()}</span><span class="second">{words::help_lasso()}</span></p>
                            <p><span>{words::help_carry_says()}</span><span class="second">{words::help_carry()}</span></p>
                            <p><span>{words::help_lines_says()}</span><span class="second">{words::help_lines()}</span></p>
                        </section>
                    </Show>
                    <Show when=move || found.read().is_empty() && streams.read().is_empty()>
                        <p class="second">{words::no_command()}</p>
                    </Show>
                </div>
            </div>
        </Frame>
    }
}

#[component]
fn Row(command: PageCommand) -> impl IntoView {
    let desk = hold();
    let no = untrack(|| desk.desk().may_not(command.role));
    let keys = command.keys.split(' ').filter(|key| !key.is_empty());
    view! {
        <button type="button" class="menu-item" data-panel=command.panel() disabled=no.is_some() title=no
            on:click=move |_| run(desk, command)>
            <span class="cut">{command.label()}</span>
            <span class="keys">{keys.map(|key| view! { <kbd>{key}</kbd> }).collect_view()}</span>
        </button>
    }
}

/// All commands, as the dialog holds them.
type HeldCommands = StoredValue<Vec<PageCommand>, LocalStorage>;

fn nth(commands: HeldCommands, at: usize) -> PageCommand {
    commands.with_value(|commands| commands[at])
}

/// The commands that are meant, by their places.
fn indices(desk: DeskHold, search: &str, commands: HeldCommands) -> Vec<usize> {
    let host = desk.desk().role.get() == Some(protocol::Role::Host);
    let is_meant = |command: &PageCommand| {
        (host || command.role != protocol::Role::Host) && command.is_here() && command.is_meant(search)
    };
    commands.with_value(|all| (0..all.len()).filter(|at| is_meant(&all[*at])).collect())
}

/// The streams of the open program that are meant.
fn streams(desk: DeskHold, search: &str) -> Vec<(Id, String)> {
    let wanted = search.trim().to_lowercase();
    if wanted.is_empty() {
        return Vec::new();
    }
    let desk = desk.desk();
    let name = |id: Id| {
        let name = desk.document.stream(&id)?.record.with_untracked(|stream| stream.name.clone());
        name.to_lowercase().contains(&wanted).then_some((id, name))
    };
    desk.document.stream_ids.get().into_iter().filter_map(name).take(STREAMS_MAX).collect()
}

fn run(desk: DeskHold, command: PageCommand) {
    if untrack(|| desk.desk().may_not(command.role)).is_some() {
        return;
    }
    close(desk);
    let desk: Desk = desk.desk();
    // The dialog is gone then, and the keyboard is back where it was.
    browser::rendered(move || command.run(&desk));
}

fn go(desk: DeskHold, id: &Id) {
    close(desk);
    desk.desk().document.choose([Selected::Stream(id.clone())].into());
}

/// The arrow down goes from the field into the list.
fn to_list(event: &web_sys::KeyboardEvent) {
    if event.pressed() == "ArrowDown" && FocusPlace::Command.take().is_some() {
        event.prevent_default();
    }
}
