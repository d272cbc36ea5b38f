//! The language that the page speaks, and the button for the other one: as chosen before, else as the browser is set
//! (`static/boot.js`, which fetches the words before anything is shown).

use crate::commands::{other_language, speak_other};
use crate::words;
use leptos::prelude::*;
use sentences::Language;

/// The language of this page and of its sentences.
pub(crate) fn language() -> Language {
    if words::language::spoken().code == "ja" { Language::Japanese } else { Language::English }
}

/// Leads to the other language, by its own name: in the bar, and among the beginnings where that has no room for it.
#[component]
pub(crate) fn OtherLanguage(in_bar: bool) -> impl IntoView {
    let other = other_language();
    let class = if in_bar { "tool in-language not-phone" } else { "link in-language only-phone" };
    view! {
        <button type="button" class=class lang=other.code title=other.page_in
            data-stop=in_bar.then_some("") tabindex=in_bar.then_some("-1")
            on:click=|_| speak_other()>{other.name}</button>
    }
}
