//! Load program as a dialog: the programs with search and order, the templates, and the bin.

mod bar;
mod details;
mod line;
mod list;
mod shelf;
mod window;

use crate::desk::Dialog;
use crate::dialogs::{Feet, Frame};
use crate::library::empty::{Exercises, TemplateCard};
use crate::library::words;
use crate::parts::hold;
use bar::Bar;
use details::Details;
use leptos::prelude::*;
use list::List;
use shelf::{ShelfPlace, ShownShelf};

/// Programs, templates and the bin.
#[component]
pub(crate) fn Programs() -> impl IntoView {
    let desk = hold();
    let shown = ShownShelf::of(desk);
    let add = Callback::new(move |()| desk.desk().dialog.set(Some(Dialog::AddProgram)));
    let templates = move || shown.place.get() == ShelfPlace::Templates;
    let details = move || shown.details.get().filter(|_| shown.place.get() == ShelfPlace::Programs);
    let body = move || match details() {
        Some(program) => view! { <Details shown program /> }.into_any(),
        None if templates() => view! { <Templates /> }.into_any(),
        None => view! { <List shown /> }.into_any(),
    };
    view! {
        <Frame title=words::load_program() wide=true save=add>
            <Bar shown />
            {body}
            <Feet save=words::add_program()>
                <span class="faint apart" role="status">{move || (!templates()).then(|| shown.count_words())}</span>
            </Feet>
        </Frame>
    }
}

/// The templates, each with its picture.
#[component]
fn Templates() -> impl IntoView {
    let desk = hold();
    let cards = move || {
        desk.desk().library.templates.get().into_iter().map(|summary| view! { <TemplateCard summary /> }).collect_view()
    };
    view! { <div class="shelf templates" tabindex="-1"><ul class="gallery">{cards}</ul><Exercises /></div> }
}
