//! The bar: the program's name and how saving goes, the thesis's tools in their order, undo, redo and the people.

use super::tools::{AddSensorMenu, EditHelperMenu, LoadMenu};
use crate::browser;
use crate::commands::On;
use crate::desk::{Dialog, LinkState, Saving};
use crate::focus;
use crate::icons::Icon;
use crate::later::Later;
use crate::page::words;
use crate::parts::{DeskHold, Menu, OtherLanguage, PanelButtons, hold, mark_usable, may_edit, title_or_why};
use crate::people::People;
use leptos::html::Div;
use leptos::prelude::*;
use protocol::Role;

/// The class of the tools while there is no room for their words.
const TIGHT: &str = "tight";

/// The bar.
#[component]
pub(crate) fn Toolbar() -> impl IntoView {
    let desk = hold();
    let no_edit = Signal::derive(move || !may_edit(desk));
    let none_open = Signal::derive(move || desk.desk().document.open.read().is_none());
    let none_to_edit = Signal::derive(move || none_open.get() || no_edit.get());
    let tools = NodeRef::new();
    mark_usable(desk);
    keep_in_window(desk, tools);
    view! {
        <header class="bar">
            <div
                class="tools"
                node_ref=tools
                role="toolbar"
                aria-label=words::skip_name()
                on:keydown=|event| focus::walk(&event, "ArrowRight", "ArrowLeft")
                on:focusin=|event| focus::remember(&event)
            >
                <HamburgerMenu />
                <Logo />
                <ProgramName />
                <span class="rule not-phone"></span>
                <ProgramMenu />
                <LoadMenu />
                <Tool class="not-tablet" icon="plus" label=words::add_program() open=Dialog::AddProgram disabled=no_edit />
                <Tool
                    class="not-tablet"
                    icon="trash"
                    label=words::remove_program()
                    open=Dialog::RemoveProgram
                    disabled=none_to_edit
                />
                <span class="rule not-phone"></span>
                <AddSensorMenu none_open=none_to_edit />
                <EditHelperMenu />
                <Tool class="not-phone" icon="plus" label=words::add_helper() open=Dialog::Helper(None) disabled=no_edit />
                <span class="rule not-phone"></span>
                <Back />
                <span class="spring"></span>
                <HelpButton />
                <InviteButton />
                <People />
                <OtherLanguage in_bar=true />
            </div>
        </header>
    }
}

/// Leaves the words of the tools away while there is no room for them: how much they need is known only where they are, by
/// the letters of the computer, the language and how many people are here.
fn keep_in_window(desk: DeskHold, tools: NodeRef<Div>) {
    let measure = move || {
        let Some(tools) = tools.try_get_untracked().flatten() else { return };
        let classes = tools.class_list();
        let _ = classes.remove_1(TIGHT);
        if tools.scroll_width() > tools.client_width() {
            let _ = classes.add_1(TIGHT);
        }
    };
    Effect::new(move |_| {
        if let Some(tools) = tools.get() {
            browser::watch_size(&tools, measure);
        }
    });
    let people = Memo::new(move |_| desk.desk().document.signs().len());
    Effect::new(move |_| {
        people.track();
        desk.desk().role.track();
        let _ = request_animation_frame(measure);
    });
}

#[component]
fn Logo() -> impl IntoView {
    view! {
        <span class="logo not-phone">
            <svg viewBox="0 0 32 32" width="26" height="26" aria-hidden="true">
                <rect x="3" y="3" width="14" height="8" rx="2" fill="var(--sensor)" />
                <rect x="8" y="12" width="16" height="8" rx="4" fill="var(--stream)" />
                <rect x="15" y="21" width="14" height="8" rx="2" fill="var(--actuator)" />
            </svg>
            "rrp"
        </span>
    }
}

#[component]
fn ProgramName() -> impl IntoView {
    let desk = hold();
    let name = move || {
        let desk = desk.desk();
        if desk.document.open.read().is_some() { desk.document.name.get() } else { words::untitled().to_owned() }
    };
    view! {
        <div class="program">
            <h1>
            <button
                class="program-name cut"
                type="button"
                data-stop=""
                tabindex="0"
                title=move || format!("{} · {}", name(), title_or_why(desk, Role::Editor, words::rename_program()))
                disabled=move || desk.desk().document.open.read().is_none() || !may_edit(desk)
                on:click=move |_| desk.desk().dialog.set(Some(Dialog::RenameProgram))
            >
                {name}
            </button>
            </h1>
            <span class="saving cut" role="status" title=move || saving_line(desk) data-offline=move || is_offline(desk).then_some("")>
                {move || saving_line(desk)}
            </span>
        </div>
    }
}

fn is_offline(desk: DeskHold) -> bool {
    let desk = desk.desk();
    desk.unheard.read().is_some()
        || desk.online.get() == LinkState::Offline
        || matches!(desk.document.saving.get(), Saving::Offline(_) | Saving::Away(..))
        || !desk.document.conflicts_here().is_empty()
}

fn saving_line(desk: DeskHold) -> String {
    let desk = desk.desk();
    match (desk.online.get(), desk.document.saving.get()) {
        (_, Saving::Offline(waiting)) => words::offline(waiting),
        (_, Saving::Away(waiting, _)) => words::not_saved(waiting),
        (LinkState::Offline, Saving::Saved | Saving::Saving) => words::offline(0),
        (LinkState::Connecting, Saving::Saved | Saving::Saving) => words::connecting().to_owned(),
        (LinkState::Online, _) if desk.unheard.read().is_some() => words::no_answer().to_owned(),
        (LinkState::Online, Saving::Saving) => words::saving().to_owned(),
        (LinkState::Online, Saving::Saved) if !desk.document.conflicts_here().is_empty() => {
            words::other_saved().to_owned()
        }
        (LinkState::Online, Saving::Saved) if desk.is_then() => words::only_to_look_at().to_owned(),
        (LinkState::Online, Saving::Saved) if !desk.may(Role::Operator) => words::you_look().to_owned(),
        (LinkState::Online, Saving::Saved) if !desk.may(Role::Editor) => words::you_operate().to_owned(),
        (LinkState::Online, Saving::Saved) if desk.document.open.read().is_some() => words::all_saved().to_owned(),
        (LinkState::Online, Saving::Saved) => String::new(),
    }
}

/// A button of the bar that opens a dialog.
#[component]
fn Tool(
    icon: &'static str,
    label: &'static str,
    open: Dialog,
    class: &'static str,
    #[prop(optional)] disabled: Option<Signal<bool>>,
) -> impl IntoView {
    let desk = hold();
    view! {
        <button
            class=format!("tool {class}")
            type="button"
            data-stop=""
            tabindex="-1"
            title=move || title_or_why(desk, Role::Editor, label)
            aria-label=label
            disabled=move || disabled.is_some_and(|disabled| disabled.get())
            on:click=move |_| desk.desk().dialog.set(Some(open.clone()))
        >
            <Icon name=icon />
            <span class="tool-word">{label}</span>
        </button>
    }
}

#[component]
fn Back() -> impl IntoView {
    let desk = hold();
    let cannot_redo = move || !may_edit(desk) || desk.desk().document.redoable.read().is_none();
    let undo_title = move || words::step_title(words::undo(), desk.desk().document.undoable.read().as_ref());
    let redo_title = move || words::step_title(words::redo(), desk.desk().document.redoable.read().as_ref());
    view! {
        <button class="tool icon not-phone" type="button" data-stop="" tabindex="-1" title=undo_title
            aria-label=words::undo() disabled=move || !can_undo(desk) on:click=move |_| desk.desk().undo()>
            <Icon name="undo" />
        </button>
        <button class="tool icon not-phone" type="button" data-stop="" tabindex="-1" title=redo_title
            aria-label=words::redo() disabled=cannot_redo on:click=move |_| desk.desk().document.redo()>
            <Icon name="redo" />
        </button>
        <PanelButtons />
    }
}

/// Whether this person can take something back. Reactive.
fn can_undo(desk: DeskHold) -> bool {
    desk.desk().may(Role::Editor) && desk.desk().can_undo()
}

#[component]
fn HelpButton() -> impl IntoView {
    let desk = hold();
    let label = words::keys_and_gestures();
    view! {
        <button class="tool icon not-phone" type="button" data-stop="" tabindex="-1" title=label aria-label=label
            on:click=move |_| desk.desk().dialog.set(Some(Dialog::Help))>
            <Icon name="help" />
        </button>
    }
}

/// Only for who may invite.
#[component]
fn InviteButton() -> impl IntoView {
    let desk = hold();
    let label = words::invite();
    view! {
        <Show when=move || may_invite(desk)>
            <button class="tool icon not-phone" type="button" data-stop="" tabindex="-1" title=label aria-label=label
                on:click=move |_| desk.desk().dialog.set(Some(Dialog::Invite))>
                <Icon name="invite" />
            </button>
        </Show>
    }
}

/// The person at the server's computer, once the server said that it is them. Reactive.
fn may_invite(desk: DeskHold) -> bool {
    desk.desk().role.get() == Some(Role::Host)
}

/// What can be done with programs, out of the list of commands.
#[component]
fn ProgramMenu() -> impl IntoView {
    view! {
        <Menu label=words::program() icon="folder" class="only-tablet">
            <Later show=|rest| (rest.row_menu)(On::Programs) />
        </Menu>
    }
}

/// What a phone's bar has no buttons for, out of the list of commands.
#[component]
fn HamburgerMenu() -> impl IntoView {
    view! {
        <Menu label=words::menu() icon="menu" icon_only=true class="only-phone">
            <Later show=|rest| (rest.row_menu)(On::Phone) />
        </Menu>
    }
}
