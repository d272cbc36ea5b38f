//! Lists of programs: the newest ones, and page after page of all of them.

use super::LibraryPanel;
use crate::desk::tab::set_if_new;
use crate::link::NoAnswer;
use behaviour::Id;
use leptos::prelude::*;
use protocol::{Cursor, ListQuery, Summary, answer, request};

/// The number of newest programs that the menu and the first screen show.
const NEWEST_MAX: u32 = 12;

/// A page of programs.
#[derive(Clone, Debug, Default)]
pub(crate) struct ProgramPage {
    pub(crate) lines: Vec<Summary>,
    pub(crate) next: Option<Cursor>,
    pub(crate) total: u64,
}

impl LibraryPanel {
    /// Asks for the newest programs afresh.
    pub(crate) fn list_programs(&self) {
        let library = self.clone();
        let query = ListQuery { most: NEWEST_MAX, ..ListQuery::default() };
        self.ask_page(query, move |page| {
            if let Ok(page) = page {
                set_if_new(&library.programs_total, page.total);
                set_if_new(&library.programs, page.lines);
            }
        });
    }

    /// The list of programs changed somewhere.
    pub(in crate::desk) fn programs_changed(&self) {
        self.news.update(|news| *news = news.wrapping_add(1));
        if self.document.open.with_untracked(Option::is_none) {
            self.list_programs();
        }
    }

    /// A program was moved to the bin.
    pub(in crate::desk) fn removed(&self, id: &Id) {
        self.programs.update(|programs| programs.retain(|program| program.id != id.as_str()));
    }

    /// Asks for a page of the list.
    pub(crate) fn ask_page(&self, query: ListQuery, then: impl FnOnce(Result<ProgramPage, NoAnswer>) + 'static) {
        self.tab.look_up(request::List { query }, move |answer| {
            then(answer.map(|answer::Programs { programs, next, total }| ProgramPage { lines: programs, next, total }));
        });
    }
}
