//! Which language the page speaks, and choosing the other one: as chosen before, else as the browser is set
//! (`static/boot.js`, which fetches the words before anything is shown).

use crate::browser::{self, Drawer};
use crate::words;
use leptos::prelude::*;
use sentences::Language;

/// Where it is kept which language was chosen; `static/boot.js` reads it.
const CHOSEN: &str = "rrp.language";

/// The language of this page and of its sentences.
pub(crate) fn language() -> Language {
    if words::language::spoken().code == "ja" { Language::Japanese } else { Language::English }
}

/// Chooses it, for later too. The page opens again where it is: what is not saved yet is kept over that.
fn choose(language: &phrase::PageLanguage) {
    Drawer::Browser.put(CHOSEN, language.code);
    if let Some(window) = browser::window() {
        let _ = window.location().reload();
    }
}

fn other() -> &'static phrase::PageLanguage {
    words::language::spoken().next()
}

/// Chooses the other one.
pub(crate) fn speak_other() {
    choose(other());
}

/// Leads to the other language, by its own name: in the bar, and among the beginnings where that has no room for it.
#[component]
pub(crate) fn OtherLanguage(in_bar: bool) -> impl IntoView {
    let other = other();
    let class = if in_bar { "tool in-language not-phone" } else { "link in-language only-phone" };
    view! {
        <button type="button" class=class lang=other.code title=other.page_in
            data-stop=in_bar.then_some("") tabindex=in_bar.then_some("-1")
            on:click=move |_| choose(other)>{other.name}</button>
    }
}
