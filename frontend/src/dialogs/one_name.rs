//! Small dialogs about a name: one that asks for it, and a question before what has it is removed.

use super::frame::{Feet, Frame, close};
use super::held::{DialogLock, Holding};
use crate::dialogs::words;
use crate::fields::TextField;
use crate::parts::hold;
use leptos::prelude::*;

/// A dialog that asks for one name, which cannot be empty.
#[component]
pub(crate) fn OneName(
    #[prop(into)] title: String,
    /// The name at first.
    #[prop(into)]
    now: String,
    #[prop(optional, into)] hint: String,
    #[prop(default = 200)] max_chars: usize,
    #[prop(default = words::save())] save: &'static str,
    done: Callback<String>,
    /// The lock of what is named, if it has one.
    #[prop(optional)]
    held: Option<DialogLock>,
) -> impl IntoView {
    let desk = hold();
    let reads = Signal::derive(move || held.is_some_and(|held| held.reads.get()));
    let first = StoredValue::new(now.clone());
    let name = RwSignal::new(now);
    let submit = Callback::new(move |()| {
        let name = name.get_untracked().trim().to_owned();
        if !name.is_empty() && !reads.get_untracked() {
            done.run(name);
            close(desk);
        }
    });
    view! {
        <Frame title narrow=true save=submit>
            {held.map(|held| view! { <Holding held written=name /> })}
            <div class="dialog-body">
              <fieldset class="held-fields" disabled=reads>
                <TextField label=words::name() value=name hint max_chars proposed=Signal::derive(move || name.get() == first.get_value()) />
              </fieldset>
            </div>
            <Feet save nothing=reads />
        </Frame>
    }
}

/// A question before something is removed.
#[component]
pub(crate) fn RemoveQuestion(
    #[prop(into)] name: String,
    says: &'static str,
    done: Callback<()>,
    #[prop(optional)] children: Option<Children>,
) -> impl IntoView {
    view! {
        <Frame title=words::remove_question(&name) narrow=true save=done>
            <div class="dialog-body"><p>{says}</p> {children.map(|children| children())}</div>
            <Feet save=words::remove() leave=words::keep() />
        </Frame>
    }
}
