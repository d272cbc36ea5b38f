//! What the library knows: pages of programs, pictures of graphs, and what programs have to do with each other.

use super::{Desk, set_if_new};
use crate::{browser, link};
use behaviour::Id;
use leptos::prelude::*;
use protocol::{Cursor, ListQuery, PICTURES_MAX, Picture, PictureOf, Reply, Request, Summary};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

/// How many of the newest programs the menu and the first screen show.
const NEWEST_MAX: u32 = 12;
/// Pictures kept in the page.
const PICTURES_KEPT_MAX: usize = 600;
/// How soon pictures are asked for, together.
const PICTURES_SOON_MS: i32 = 40;

/// A page of programs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shelf {
    pub(crate) lines: Vec<Summary>,
    pub(crate) next: Option<Cursor>,
    pub(crate) total: u64,
}

/// Pictures by program, with the revision they show.
pub(crate) type Pictures = BTreeMap<String, (u64, Arc<Picture>)>;

/// Pictures that are waited for.
#[derive(Default)]
pub(super) struct WantedPictures {
    /// Newest wish last; of too many the oldest are dropped, because they have scrolled away.
    waiting: VecDeque<PictureOf>,
    /// What was asked for already, so that what is gone is not asked for again and again.
    asked: BTreeSet<(String, u64)>,
    planned: bool,
}

impl Desk {
    /// Asks for the newest programs afresh.
    pub(crate) fn list_programs(&self) {
        let desk = self.clone();
        let query = ListQuery { most: NEWEST_MAX, ..ListQuery::default() };
        self.ask_page(query, move |page| {
            if let Ok(page) = page {
                set_if_new(&desk.programs_total, page.total);
                set_if_new(&desk.programs, page.lines);
            }
        });
    }

    /// The list of programs changed somewhere.
    pub(super) fn programs_changed(&self) {
        self.library_news.update(|news| *news = news.wrapping_add(1));
        if self.open.with_untracked(Option::is_none) {
            self.list_programs();
        }
    }

    /// Asks for a page of the list; with a sentence if none comes.
    pub(crate) fn ask_page(&self, query: ListQuery, then: impl FnOnce(Result<Shelf, String>) + 'static) {
        self.look_up(Request::List { query }, move |answer| match answer {
            Ok(Reply::Programs { programs, next, total }) => {
                then(Ok(Shelf { lines: programs.clone(), next: next.clone(), total: *total }));
            }
            Ok(_) => {}
            Err(sentence) => then(Err(sentence)),
        });
    }

    /// Asks something that changes nothing; a no or a missing link is answered with a sentence.
    pub(crate) fn look_up(&self, request: Request, then: impl FnOnce(Result<&Reply, String>) + 'static) {
        link::ask_even_down(request, move |reply| match reply {
            Some(Reply::No { no }) => then(Err(no.to_string())),
            Some(reply) => then(Ok(reply)),
            None => then(Err(crate::words::unreachable().to_owned())),
        });
    }

    /// Takes a program out of the bin.
    pub(crate) fn restore_program(&self, program: &Summary) {
        let (desk, name) = (self.clone(), program.name.clone());
        let Ok(behaviour) = Id::new(&program.id) else { return };
        self.ask_or_say(Request::Restore { behaviour }, move |_| desk.say(&crate::words::is_back(&name), false));
    }

    /// Sees to it that the picture of a program comes.
    pub(crate) fn want_picture(&self, id: &str, revision: u64) {
        let there = self.pictures.with_untracked(|pictures| pictures.get(id).is_some_and(|(at, _)| *at >= revision));
        let Ok(behaviour) = Id::new(id) else { return };
        if there || !self.state().wanted_pictures.want(PictureOf { behaviour, revision }) {
            return;
        }
        let desk = self.clone();
        browser::after(PICTURES_SOON_MS, move || desk.ask_pictures());
    }

    fn ask_pictures(&self) {
        let of = self.state().wanted_pictures.take();
        let (desk, asked) = (self.clone(), of.clone());
        self.look_up(Request::Pictures { of }, move |answer| match answer {
            Ok(Reply::Pictures { pictures }) => desk.got_pictures(&asked, pictures),
            Ok(_) | Err(_) => desk.state().wanted_pictures.forget(&asked),
        });
    }

    fn got_pictures(&self, asked: &[PictureOf], got: &[(Id, Picture)]) {
        let revisions: BTreeMap<&Id, u64> = asked.iter().map(|of| (&of.behaviour, of.revision)).collect();
        self.pictures.update(|kept| {
            if kept.len() + got.len() > PICTURES_KEPT_MAX {
                kept.clear();
                self.state().wanted_pictures.asked.clear();
            }
            for (id, picture) in got {
                let revision = revisions.get(id).copied().unwrap_or_default();
                kept.insert(id.to_string(), (revision, Arc::new(picture.clone())));
            }
        });
    }
}

impl WantedPictures {
    /// True if somebody has to ask soon.
    fn want(&mut self, of: PictureOf) -> bool {
        if !self.asked.insert((of.behaviour.to_string(), of.revision)) {
            return false;
        }
        self.waiting.push_back(of);
        if self.waiting.len() > PICTURES_MAX
            && let Some(dropped) = self.waiting.pop_front()
        {
            self.forget(&[dropped]);
        }
        !std::mem::replace(&mut self.planned, true)
    }

    fn take(&mut self) -> Vec<PictureOf> {
        self.planned = false;
        self.waiting.drain(..).collect()
    }

    fn forget(&mut self, of: &[PictureOf]) {
        for of in of {
            self.asked.remove(&(of.behaviour.to_string(), of.revision));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PICTURES_MAX, WantedPictures};
    use behaviour::Id;
    use protocol::PictureOf;

    #[test]
    fn pictures_are_asked_for_once_and_the_newest_first_of_too_many() {
        let of = |number: usize| PictureOf { behaviour: Id::new(&format!("b{number}")).unwrap(), revision: 1 };
        let mut wanted = WantedPictures::default();
        assert!(wanted.want(of(0)) && !wanted.want(of(0)) && !wanted.want(of(1)));
        for number in 2..=PICTURES_MAX {
            wanted.want(of(number));
        }
        let asked = wanted.take();
        assert_eq!((asked.len(), asked.first(), asked.last()), (PICTURES_MAX, Some(&of(1)), Some(&of(PICTURES_MAX))));
        assert!(wanted.want(of(0)), "what was dropped may be wanted again");
    }
}
