//! How a connector works: its help in words and marbles, opened quietly from the dialog.

mod lanes;

use super::form::OperationForm;
use crate::forms::words;
use behaviour::connectors::Spec;
use behaviour::marbles::Example;
use lanes::{Given, Then};
use leptos::prelude::*;

/// What the button opens.
const HELP_ID: &str = "how-it-works";

/// The button, and the help once it is pressed. It stays open while another connector is chosen.
#[component]
pub(super) fn HowItWorks(form: OperationForm) -> impl IntoView {
    let open = RwSignal::new(false);
    view! {
        <div class="how">
            <button class="link how-open" type="button" aria-expanded=move || open.get().to_string()
                aria-controls=HELP_ID on:click=move |_| open.update(|open| *open = !*open)>
                {move || if open.get() { words::how_it_works_less() } else { words::how_it_works() }}
            </button>
            <div id=HELP_ID>
                <Show when=move || open.get()>{move || view! { <Help spec=form.kind.get() /> }}</Show>
            </div>
        </div>
    }
}

#[component]
fn Help(spec: &'static Spec) -> impl IntoView {
    let examples = spec.help.examples.iter().map(|example| view! { <Shown spec example /> }).collect_view();
    view! {
        <div class="how-help">
            <p>{words::connector_does(spec)}</p>
            <p>{words::connector_when(spec)}</p>
            <p class="second">{words::how_to_read()}</p>
            {examples}
        </div>
    }
}

/// One example: what is given, the connector, what comes out.
#[component]
fn Shown(spec: &'static Spec, example: &'static Example) -> impl IntoView {
    view! {
        <figure class="how-example">
            <figcaption>{words::connector_example(spec, example.title)}</figcaption>
            <Given example />
            <p class="how-connector"><code>{example.label(spec.word)}</code></p>
            <Then example acts=spec.acts() />
        </figure>
    }
}
