//! Removing what is selected: at once, or, for a stream in the middle of a way, one of two ways.

use super::menu::{Menu, MenuItem};
use crate::desk::{Desk, Selected, use_desk};
use crate::icons::Icon;
use crate::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;
use web_sys::HtmlElement;

/// The button that removes; in the middle of a way it asks whether the way goes on.
#[component]
pub(crate) fn RemoveButton(
    what: Selected,
    class: &'static str,
    /// With its word beside the icon.
    #[prop(optional)]
    in_words: bool,
) -> impl IntoView {
    let desk = use_desk();
    let no_edit = untrack(|| desk.may_not(Role::Editor));
    let middle = {
        let (desk, what) = (desk.clone(), what.clone());
        ArcMemo::new(move |_| {
            desk.document.revision.track();
            match &what {
                Selected::Stream(id) if no_edit.is_none() => desk.document.healed_by(id).zip(Some(id.clone())),
                Selected::Stream(_) | Selected::Connector(_) | Selected::Note(_) | Selected::Group(_) => None,
            }
        })
    };
    move || match middle.get() {
        Some(((above, name), id)) => view! { <Ways what=what.clone() id above name in_words /> }.into_any(),
        None => {
            let (desk, what) = (desk.clone(), what.clone());
            view! {
                <button type="button" class=class aria-label=words::remove() title=no_edit.unwrap_or(words::remove())
                    disabled=no_edit.is_some() on:click=move |_| desk.document.remove(&what)>
                    <Icon name="trash" />
                    {in_words.then(words::remove)}
                </button>
            }
            .into_any()
        }
    }
}

/// The two ways to take a stream out of the middle of its way.
#[component]
fn Ways(what: Selected, id: Id, above: Id, name: String, in_words: bool) -> impl IntoView {
    let desk = StoredValue::new(use_desk());
    let above = StoredValue::new(above);
    // The thing above is selected then, and the keyboard goes there.
    let then = move |remove: &dyn Fn(&Desk)| {
        desk.with_value(|desk| {
            remove(desk);
            // The button that has the keyboard may stay, for what is selected next.
            let active = document().active_element().and_then(|active| active.dyn_into::<HtmlElement>().ok());
            if let Some(active) = active {
                let _ = active.blur();
            }
            desk.document.select(Some(Selected::Stream(above.get_value())));
        });
    };
    let heal = Callback::new(move |()| then(&|desk| desk.document.remove_and_heal(&id)));
    let plain = Callback::new(move |()| then(&|desk| desk.document.remove(&what)));
    view! {
        <Menu label=words::remove() icon="trash" alone=true icon_only=!in_words class="remove">
            <MenuItem label=words::remove_and_join(&name) icon="connect" choose=heal />
            <MenuItem label=words::remove_with_connectors() icon="trash" choose=plain />
        </Menu>
    }
}
