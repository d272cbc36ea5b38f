//! A whole program was pasted: it is opened as a new one, or left.

use crate::desk::Pasted;
use crate::dialogs::{Feet, Frame, close};
use crate::library::words;
use crate::parts::hold;
use leptos::prelude::*;

/// Asks before the program that one looks at gives its place to the pasted one.
#[component]
pub(crate) fn OpenPasted(pasted: Pasted) -> impl IntoView {
    let desk = hold();
    let done = Callback::new(move |()| {
        desk.desk().library.open_pasted(&pasted);
        close(desk);
    });
    view! {
        <Frame title=words::open_pasted() narrow=true save=done>
            <div class="dialog-body"><p>{words::pasted_is_whole()}</p></div>
            <Feet save=words::open_as_new() leave=words::leave_it() />
        </Frame>
    }
}
