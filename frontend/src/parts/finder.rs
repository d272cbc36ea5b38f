//! Next steps that are found by their names: each with its picture and what comes of it.

use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::steps::{Offer, Step};
use crate::words;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// A field, and below it what has what is typed in its name; Enter takes the first.
#[component]
pub(crate) fn Finder(offers: Vec<Offer>, choose: Callback<Step>) -> impl IntoView {
    let text = RwSignal::new(String::new());
    let offers = StoredValue::new_local(offers);
    let found = move || {
        let wanted = text.read().trim().to_lowercase();
        offers.with_value(|offers| offers.iter().filter(|offer| has(offer, &wanted)).cloned().collect::<Vec<_>>())
    };
    let key = move |event: KeyboardEvent| {
        if event.pressed() == "Enter" {
            event.prevent_default();
            if let Some(first) = untrack(found).into_iter().next() {
                choose.run(first.step);
            }
        }
    };
    let item = move |(at, offer): (usize, Offer)| {
        let (says, brief) = (offer.says(), offer.brief());
        let Offer { step, icon, label } = offer;
        view! {
            <li>
                <button type="button" class="menu-item" class:likely=at == 0 data-stop="" tabindex="-1" title=says
                    on:click=move |_| choose.run(step.clone())>
                    <Icon name=icon /><span class="cut">{label}</span><span class="faint brief">{brief}</span>
                </button>
            </li>
        }
    };
    view! {
        <div class="finder" on:keydown=|event| focus::walk(&event, "ArrowDown", "ArrowUp") on:focusin=|event| focus::remember(&event)>
            <div class="find">
                <Icon name="search" />
                <input class="input" type="search" data-first="" data-stop="" tabindex="0" placeholder=words::find_another()
                    aria-label=words::find_another() prop:value=move || text.get()
                    on:input:target=move |event| text.set(event.target().value()) on:keydown=key />
            </div>
            <ul class="big-list">{move || found().into_iter().enumerate().map(item).collect_view()}</ul>
            {move || found().is_empty().then(|| view! { <p class="hint" role="status">{words::nothing_like_it()}</p> })}
        </div>
    }
}

/// Returns true if its name holds what is looked for.
fn has(offer: &Offer, wanted: &str) -> bool {
    offer.label.to_lowercase().contains(wanted) || offer.says().to_lowercase().contains(wanted)
}
