//! How a connector works: its help in words and marbles, opened quietly from the dialog.

mod lanes;

use super::form::Form;
use crate::words;
use behaviour::marbles::{self, Example, Page};
use lanes::{Given, Then};
use leptos::prelude::*;

/// What the button opens.
const HELP_ID: &str = "how-it-works";

/// The button, and the help once it is pressed. It stays open while another connector is chosen.
#[component]
pub(super) fn HowItWorks(form: Form) -> impl IntoView {
    let open = RwSignal::new(false);
    let page = move || marbles::page(form.kind.get());
    view! {
        <div class="how">
            <button class="link how-open" type="button" aria-expanded=move || open.get().to_string()
                aria-controls=HELP_ID on:click=move |_| open.update(|open| *open = !*open)>
                {move || if open.get() { words::how_it_works_less() } else { words::how_it_works() }}
            </button>
            <div id=HELP_ID>
                <Show when=move || open.get()>{move || page().map(|page| view! { <Help page /> })}</Show>
            </div>
        </div>
    }
}

#[component]
fn Help(page: &'static Page) -> impl IntoView {
    let examples = page.examples.iter().map(|example| view! { <Shown page example /> }).collect_view();
    view! {
        <div class="how-help">
            <p>{page.does}</p>
            <p>{page.when}</p>
            <p class="second">{words::how_to_read()}</p>
            {examples}
        </div>
    }
}

/// One example: what is given, the connector, what comes out.
#[component]
fn Shown(page: &'static Page, example: &'static Example) -> impl IntoView {
    view! {
        <figure class="how-example">
            <figcaption>{example.title}</figcaption>
            <Given example />
            <p class="how-connector"><code>{example.label(page.connector)}</code></p>
            <Then example acts=page.connector == "subscribe" />
        </figure>
    }
}
