//! Edit helper as a dialog: every helper of the library with its sentence.

use crate::desk::Dialog;
use crate::dialogs::{Feet, Frame};
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::hold;
use behaviour::{Helper, Id};
use leptos::prelude::*;

/// Choosing which helper to edit.
#[component]
pub(crate) fn Helpers() -> impl IntoView {
    let desk = hold();
    let new = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::Helper(None))));
    let item = move |(id, helper): (Id, Helper)| {
        let edit = move |_| desk.desk().dialog.set(Some(Dialog::Helper(Some(id.clone()))));
        view! {
            <li>
                <button class="menu-item" type="button" on:click=edit>
                    <span class="kind plain"><Icon name="fx" /></span>
                    <span class="two">
                        <b>{words::helper_item(&helper)}</b>
                        <span class="second">{words::what_helper_does(&helper)}</span>
                    </span>
                </button>
            </li>
        }
    };
    let items = move || desk.desk().library.helpers.get().into_iter().map(item).collect_view();
    view! {
        <Frame title=words::edit_helper() narrow=true save=new>
            <ul class="dialog-body big-list">{items}</ul>
            <Feet save=words::add_helper() />
        </Frame>
    }
}
