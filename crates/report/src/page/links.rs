//! The links beside a report, which are not printed: other language, names, and the recording in other forms.

use super::{ReportWishes, SCRIPT_ID};
use crate::words::Words;
use maud::{Markup, html};
use protocol::REPORTS_PATH;

/// The other forms, by what the server calls them.
const FORMS: [(&str, &str); 4] = [("csv", "CSV"), ("eaf", "ELAN"), ("boris", "BORIS"), ("vtt", "WebVTT")];

pub(super) fn all(words: Words, asked: &ReportWishes) -> Markup {
    let other = words.0.language().next();
    let names = if asked.names { "&names=1" } else { "" };
    html! {
        nav aria-label=(words.beside()) {
            a href=(back(asked, words.tag())) { (words.back_to_list()) }
            button id=(SCRIPT_ID) type="button" hidden { (words.print()) }
            a href=(address(asked, words.tag(), !asked.names)) { (words.switch_names(asked.names)) }
            a href=(address(asked, other.code, asked.names)) lang=(other.code) { (other.name) }
            span { (words.download()) ": "
                @for (form, name) in FORMS {
                    a href=(format!("{}?as={form}{names}", asked.download)) download { (name) } " "
                }
                a href=(asked.download) download { ".jsonl" }
            }
            p { (words.about_names(asked.names)) }
        }
    }
}

/// Returns the address of the list of all recordings, in this language and zone.
fn back(asked: &ReportWishes, language: &str) -> String {
    let offset = asked.zone.minutes().map(|minutes| format!("&offset={minutes}")).unwrap_or_default();
    format!("{REPORTS_PATH}?language={language}{offset}")
}

/// Returns the address of this report in a language, with or without names.
fn address(asked: &ReportWishes, language: &str, names: bool) -> String {
    let names = if names { "&names=1" } else { "" };
    let offset = asked.zone.minutes().map(|minutes| format!("&offset={minutes}")).unwrap_or_default();
    format!("?language={language}{names}{offset}")
}
