//! The open dialog. Dialogs stand beside Stop, never over it, and give the keyboard back when they close.

use super::help;
use crate::desk::{Dialog, TILES_QUERY};
use crate::dialogs::Frame;
use crate::focus::{self, FocusPlace};
use crate::later::{NotHere, second_piece};
use crate::page::words;
use crate::parts::{DeskHold, hold};
use crate::{browser, conflicts, forms, library, operate, palette, people, robots};
use leptos::prelude::*;
use protocol::Role;
use web_sys::HtmlElement;

/// The open dialog, if any.
#[component]
pub(crate) fn Dialogs() -> impl IntoView {
    let desk = hold();
    let open = Memo::new(move |_| desk.desk().dialog.get().filter(|dialog| desk.desk().may(least(dialog))));
    // However it was to be opened, by the keyboard too.
    Effect::new(move |_| {
        let refused = desk.desk().dialog.get().is_some_and(|dialog| desk.desk().refuses(least(&dialog)));
        if refused {
            desk.desk().dialog.set(None);
        }
    });
    open_asked(desk);
    give_focus_back(open);
    show_refused(desk, open);
    let piece = second_piece();
    move || {
        let dialog = open.get()?;
        Some(piece.get().map_or_else(|| view! { <Coming /> }.into_any(), |rest| (rest.dialog)(undecided(desk, dialog))))
    }
}

/// Opens the tiles of the first program that is open, where the address asks for that.
fn open_asked(desk: DeskHold) {
    let search = browser::search();
    if search.trim_start_matches('?').split('&').any(|part| part == TILES_QUERY) {
        Effect::new(move |done: Option<bool>| {
            let is_done = done == Some(true);
            let is_open = desk.desk().document.open.read().is_some();
            if is_open && !is_done {
                browser::drop_from_search(TILES_QUERY);
                desk.desk().dialog.set(Some(Dialog::Tiles));
            }
            is_open || is_done
        });
    }
}

/// In place of a dialog whose code is not here yet: it can be closed, and says so if that code does not come.
#[component]
fn Coming() -> impl IntoView {
    view! {
        <Frame title=words::opening() narrow=true save=Callback::new(|()| {})>
            <div class="dialog-body"><NotHere /></div>
        </Frame>
    }
}

/// Refused changes are shown one after the other, as soon as no other dialog is open.
fn show_refused(desk: DeskHold, open: Memo<Option<Dialog>>) {
    let next = Memo::new(move |_| desk.desk().document.next_conflict());
    Effect::new(move |_| {
        if let (None, Some(op)) = (open.get(), next.get()) {
            desk.desk().dialog.set(Some(Dialog::Conflict(op)));
        }
    });
}

/// In place of the editor of something about which one has still to decide, the comparison.
fn undecided(desk: DeskHold, dialog: Dialog) -> Dialog {
    let about = match &dialog {
        Dialog::Operation { connector: Some(id), .. } | Dialog::EditStream(id) => id,
        _ => return dialog,
    };
    let waits = untrack(|| desk.desk().document.conflict_about(about));
    waits.map_or(dialog, |conflict| Dialog::Conflict(conflict.mine.op))
}

/// What somebody must be to open a dialog at all; in the others who may not edit reads.
fn least(dialog: &Dialog) -> Role {
    match dialog {
        Dialog::Operation { connector: None, .. }
        | Dialog::Choose(_)
        | Dialog::AddSensor
        | Dialog::Helper(None)
        | Dialog::AddProgram
        | Dialog::RemoveProgram
        | Dialog::OpenPasted(_)
        | Dialog::RenameProgram
        | Dialog::Tiles => Role::Editor,
        Dialog::Stimulate(_) | Dialog::AddRobot | Dialog::RenameRobot | Dialog::RemoveRobot | Dialog::ForgetFaces => {
            Role::Operator
        }
        Dialog::Invite | Dialog::AddRealRobot | Dialog::ChangeAddress => Role::Host,
        Dialog::Operation { connector: Some(_), .. }
        | Dialog::EditStream(_)
        | Dialog::Helper(Some(_))
        | Dialog::Helpers
        | Dialog::Programs
        | Dialog::SaveFile
        | Dialog::Problems
        | Dialog::Conflict(_)
        | Dialog::Waiting
        | Dialog::MyName
        | Dialog::People
        | Dialog::Find
        | Dialog::Help => Role::Viewer,
    }
}

/// A dialog, whole.
pub(crate) fn dialog(dialog: Dialog) -> AnyView {
    match dialog {
        Dialog::Operation { input, connector, kind, spot } => {
            view! { <forms::Operation input connector kind spot /> }.into_any()
        }
        Dialog::Choose(choice) => view! { <forms::Choose choice /> }.into_any(),
        Dialog::EditStream(id) => view! { <forms::EditStream id /> }.into_any(),
        Dialog::AddSensor => view! { <palette::Find title=words::add_sensor() /> }.into_any(),
        Dialog::Find => view! { <palette::Find title=words::palette_name() /> }.into_any(),
        Dialog::Helper(id) => view! { <forms::EditHelper id /> }.into_any(),
        Dialog::Helpers => view! { <forms::Helpers /> }.into_any(),
        Dialog::Programs => view! { <library::Programs /> }.into_any(),
        Dialog::SaveFile => view! { <library::SaveFile /> }.into_any(),
        Dialog::AddProgram => view! { <library::AddProgram /> }.into_any(),
        Dialog::RemoveProgram => view! { <library::RemoveProgram /> }.into_any(),
        Dialog::RenameProgram => view! { <library::RenameProgram /> }.into_any(),
        Dialog::OpenPasted(pasted) => view! { <library::OpenPasted pasted /> }.into_any(),
        Dialog::AddRobot => view! { <robots::AddRobot /> }.into_any(),
        Dialog::AddRealRobot => view! { <robots::AddReal /> }.into_any(),
        Dialog::ChangeAddress => view! { <robots::ChangeAddress /> }.into_any(),
        Dialog::RenameRobot => view! { <robots::RenameRobot /> }.into_any(),
        Dialog::RemoveRobot => view! { <robots::RemoveRobot /> }.into_any(),
        Dialog::ForgetFaces => view! { <robots::ForgetFaces /> }.into_any(),
        Dialog::MyName => view! { <people::MyName /> }.into_any(),
        Dialog::People => view! { <people::PeopleList /> }.into_any(),
        Dialog::Invite => view! { <people::Invite /> }.into_any(),
        Dialog::Tiles => view! { <operate::EditTiles /> }.into_any(),
        Dialog::Stimulate(id) => view! { <robots::Stimulate id /> }.into_any(),
        Dialog::Conflict(op) => view! { <conflicts::Compare op /> }.into_any(),
        Dialog::Waiting => view! { <conflicts::WaitingList /> }.into_any(),
        Dialog::Problems => view! { <forms::AllProblems /> }.into_any(),
        Dialog::Help => view! { <help::Commands /> }.into_any(),
    }
}

/// Remembers who had the keyboard when a dialog opened, and gives it back when the last one has closed.
fn give_focus_back(open: Memo<Option<Dialog>>) {
    let before: StoredValue<Option<HtmlElement>, LocalStorage> = StoredValue::new_local(None);
    Effect::new(move |was_open: Option<bool>| {
        let is_open = open.read().is_some();
        match (was_open.unwrap_or_default(), is_open) {
            (false, true) => before.set_value(focus::active()),
            (true, false) => give_back(before.get_value()),
            _ => {}
        }
        is_open
    });
}

fn give_back(to: Option<HtmlElement>) {
    let there = to.filter(|element| element.is_connected() && element.tag_name() != "BODY");
    match there {
        Some(element) => focus::focus(&element),
        None => drop(FocusPlace::Graph.take()),
    }
}
