//! The report as a page: HTML without a program, for a screen and for paper.

mod compared;
mod facts;
mod links;
mod tables;
mod timeline;

use crate::clock::{Clock, Zone};
use crate::gather::Gathered;
use crate::replayed::Replayed;
use crate::sessions::SessionNumbers;
use crate::words::Words;
use behaviour::without_unseen;
use maud::{DOCTYPE, Markup, html};
use phrase::Catalogue;

/// The stylesheet of the page.
pub const STYLE: &str = include_str!("page/page.css");
/// The script of the page: times of the reader's zone, and a button that prints.
pub const SCRIPT: &str = include_str!("page/page.js");

/// The id of the button that prints, which the script knows.
pub(crate) const SCRIPT_ID: &str = "print";

/// The wishes of who reads a report.
#[derive(Clone, Debug)]
pub struct ReportWishes {
    /// True if the people who pressed stand with their names.
    pub names: bool,
    /// The zone in which moments are told.
    pub zone: Zone,
    /// The address from which the recording is downloaded, as it stands in a link.
    pub download: String,
    /// The addresses of the stylesheet and of the script.
    pub parts: [&'static str; 2],
}

/// Everything that the parts of a page draw from.
struct Sheet<'a> {
    of: &'a Gathered,
    clock: Clock,
    words: Words,
}

/// The page of what was gathered of a recording, with the sessions of the same participant.
#[must_use]
pub fn page(of: &Gathered, replayed: Replayed, sessions: &[SessionNumbers], asked: &ReportWishes) -> String {
    let sheet = Sheet { of, clock: Clock::of(&of.header.began, asked.zone), words: of.words };
    let words = sheet.words;
    let title = words.title(of.header.participant.as_deref().map(clean).as_deref());
    let [style, script] = asked.parts;
    let page = html! {
        (DOCTYPE)
        html lang=(words.tag()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="robots" content="noindex";
                title { (title) " · rrp" }
                link rel="stylesheet" href=(style);
                script src=(script) defer {}
            }
            body {
                (links::all(words, asked))
                main data-began=(clean(&of.header.began)) {
                    (facts::head(&sheet, &title))
                    (facts::lacks(&sheet))
                    (facts::program(&sheet))
                    (timeline::section(&sheet))
                    (tables::all(&sheet))
                    (compared::section(&sheet, sessions, asked.zone))
                    footer {
                        p { (words.no_name()) }
                        p { (words.replay()) ": " (words.replayed(replayed, |ms| sheet.clock.at(ms))) }
                    }
                }
            }
        }
    };
    page.into_string()
}

impl Sheet<'_> {
    /// A name of a person as it may be told.
    fn person(&self, name: &str) -> Markup {
        own(&self.of.private.name(name))
    }

    /// A text that somebody wrote, as it may be told.
    fn text(&self, text: &str) -> Markup {
        own(&self.of.private.text(text))
    }
}

/// A text of somebody's own: it cannot turn around or hide what stands beside it.
pub(crate) fn own(text: &str) -> Markup {
    html! { bdi { (clean(text)) } }
}

/// A text without what nobody sees, on one line.
pub(crate) fn clean(text: &str) -> String {
    let line: String = text.chars().map(|letter| if letter.is_whitespace() { ' ' } else { letter }).collect();
    without_unseen(&line)
}

/// The catalogue of the language in which a page is written.
#[must_use]
pub fn language_of(code: Option<&str>, otherwise: &'static Catalogue) -> &'static Catalogue {
    code.and_then(catalogues::of).unwrap_or(otherwise)
}
