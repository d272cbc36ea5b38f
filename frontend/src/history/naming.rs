//! Giving a version a name, where the list begins.

use super::back_to_lines;
use crate::focus::{self, FocusPlace};
use crate::history::words;
use crate::link::NoAnswer;
use crate::parts::hold;
use behaviour::CHECKPOINT_NAME_MAX_CHARS;
use leptos::html;
use leptos::prelude::*;

/// One line to write in; Enter saves.
#[component]
pub(super) fn Naming(revision: u64, names: RwSignal<Option<u64>>) -> impl IntoView {
    let desk = hold();
    let field = NodeRef::<html::Input>::new();
    let refused: RwSignal<Option<String>> = RwSignal::new(None);
    focus::place(FocusPlace::VersionName);
    let save = move |event: leptos::ev::SubmitEvent| {
        event.prevent_default();
        let name = field.get_untracked().map(|field| field.value()).unwrap_or_default();
        desk.desk().document.name_version(revision, &name, move |answer| match answer {
            Ok(()) => {
                names.set(None);
                back_to_lines();
            }
            Err(NoAnswer::Refused(no)) => refused.set(Some(words::told_by(&no))),
            Err(NoAnswer::Unreachable) => refused.set(Some(words::unreachable().to_owned())),
        });
    };
    view! {
        <form class="naming" novalidate=true autocomplete="off" on:submit=save>
            <label class="label" for="version-name">{words::version_name()}</label>
            <div class="row">
                <input class="input" id="version-name" type="text" maxlength=CHECKPOINT_NAME_MAX_CHARS.to_string()
                    aria-describedby="version-hint" node_ref=field />
                <button class="button primary" type="submit">{words::save()}</button>
            </div>
            <p class="faint" id="version-hint">{words::version_hint()}</p>
            {move || refused.get().map(|why| view! { <p class="refusal" role="alert">{why}</p> })}
        </form>
    }
}
