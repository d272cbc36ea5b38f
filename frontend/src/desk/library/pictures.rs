//! Pictures of graphs, asked for together as they come into sight.

use super::LibraryPanel;
use crate::browser;
use behaviour::{FillFrom, Id};
use leptos::prelude::*;
use protocol::{GraphOutline, PICTURES_MAX, PictureOf, answer, request};
use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};
use std::sync::Arc;

/// Pictures kept in the page.
const PICTURES_KEPT_MAX: usize = 600;
/// The time until pictures are asked for, together.
const PICTURES_SOON_MS: i32 = 40;

/// Pictures by program, with the revision they show.
pub(crate) type ProgramPictures = BTreeMap<String, (u64, Arc<GraphOutline>)>;

/// Pictures that are waited for.
#[derive(Default)]
pub(super) struct WantedPictures {
    /// Newest wish last; of too many the oldest are dropped, because they have scrolled away.
    waiting: VecDeque<PictureOf>,
    /// The pictures that were asked for already, so that one that is gone is not asked for again and again.
    asked: BTreeSet<(String, u64)>,
    planned: bool,
}

impl LibraryPanel {
    /// Sees to it that the picture of a program comes.
    pub(crate) fn want_picture(&self, id: &str, revision: u64) {
        let there = self.pictures.with_untracked(|pictures| pictures.get(id).is_some_and(|(at, _)| *at >= revision));
        let Ok(behaviour) = Id::new(id) else { return };
        if there || !self.state().wanted_pictures.want(PictureOf { behaviour, revision }) {
            return;
        }
        let library = self.clone();
        browser::after(PICTURES_SOON_MS, move || library.ask_pictures());
    }

    fn ask_pictures(&self) {
        let of = self.state().wanted_pictures.take();
        let (library, asked) = (self.clone(), of.clone());
        self.tab.look_up(request::Pictures { of }, move |answer| match answer {
            Ok(answer::Pictures { pictures }) => library.got_pictures(&asked, pictures),
            Err(_) => library.state().wanted_pictures.forget(&asked),
        });
    }

    fn got_pictures(&self, asked: &[PictureOf], got: Vec<(Id, GraphOutline)>) {
        let revisions: HashMap<&Id, u64> = asked.iter().map(|of| (&of.behaviour, of.revision)).filled();
        self.pictures.update(|kept| {
            if kept.len() + got.len() > PICTURES_KEPT_MAX {
                kept.clear();
                self.state().wanted_pictures.asked.clear();
            }
            for (id, picture) in got {
                let revision = revisions.get(&id).copied().unwrap_or_default();
                kept.insert(id.to_string(), (revision, Arc::new(picture)));
            }
        });
    }
}

impl WantedPictures {
    /// Puts a picture on the list of those to be asked for. Returns true if somebody has to ask soon.
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
