//! What the dialog shows of the list: what is looked for, the lines that came so far, and how loading goes.

use crate::desk::ProgramPage;
use crate::library::words;
use crate::link::NoAnswer;
use crate::parts::{DeskHold, Soon};
use leptos::html::Div;
use leptos::prelude::*;
use protocol::{Cursor, ListQuery, Sort, Summary, Tagged, answer, request};

/// How soon typing is searched for, in milliseconds.
const SOON_MS: i32 = 180;
/// Somebody who has scrolled further than this keeps what is there when the list changes elsewhere.
const NEAR_TOP_LINES: usize = 40;

/// What is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ShelfPlace {
    #[default]
    Programs,
    Templates,
    Bin,
}

/// How loading goes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Loading {
    /// Nothing came yet.
    Begins,
    Done,
    /// With the reason.
    Failed(NoAnswer),
}

/// The list as it is shown.
#[derive(Clone, Copy)]
pub(super) struct ShownShelf {
    pub(super) place: RwSignal<ShelfPlace>,
    pub(super) words: RwSignal<String>,
    /// The words to which the lines are the answer.
    pub(super) searched: RwSignal<String>,
    /// `changed` or `name`.
    pub(super) order: RwSignal<String>,
    /// `all` or `mine`.
    pub(super) whose: RwSignal<String>,
    /// The tag that is wanted; empty for all.
    pub(super) tag: RwSignal<String>,
    /// The tags that there are.
    pub(super) tags: RwSignal<Vec<Tagged>>,
    pub(super) lines: RwSignal<Vec<Summary>>,
    pub(super) loading: RwSignal<Loading>,
    pub(super) details: RwSignal<Option<Summary>>,
    /// The line that has the keyboard when the list has it.
    pub(super) active: RwSignal<usize>,
    /// The box that scrolls.
    pub(super) frame: NodeRef<Div>,
    /// The last line that is drawn.
    pub(super) drawn_to: StoredValue<usize>,
    next: RwSignal<Option<Cursor>>,
    total: RwSignal<u64>,
    /// Counts questions, so that a late answer to an old one is recognised.
    asked: StoredValue<u32>,
    asking_more: StoredValue<bool>,
    stale: StoredValue<bool>,
    desk: DeskHold,
}

impl ShownShelf {
    /// The list of the programs as it is when the dialog opens.
    pub(super) fn of(desk: DeskHold) -> Self {
        let shown = Self {
            place: RwSignal::new(ShelfPlace::default()),
            words: RwSignal::new(String::new()),
            searched: RwSignal::new(String::new()),
            order: RwSignal::new("changed".to_owned()),
            whose: RwSignal::new("all".to_owned()),
            tag: RwSignal::new(String::new()),
            tags: RwSignal::new(Vec::new()),
            lines: RwSignal::new(Vec::new()),
            loading: RwSignal::new(Loading::Begins),
            details: RwSignal::new(None),
            active: RwSignal::new(0),
            frame: NodeRef::new(),
            drawn_to: StoredValue::new(0),
            next: RwSignal::new(None),
            total: RwSignal::new(0),
            asked: StoredValue::new(0),
            asking_more: StoredValue::new(false),
            stale: StoredValue::new(false),
            desk,
        };
        shown.follow();
        shown
    }

    /// Asks again when something else is looked for, or the list changed elsewhere.
    fn follow(self) {
        let soon = Soon::new(move || self.reload());
        Effect::new(move |before: Option<String>| {
            let words = self.words.get();
            if before.is_some_and(|before| before.trim() != words.trim()) {
                soon.within(SOON_MS);
            }
            words
        });
        Effect::new(move |_| {
            self.place.track();
            self.order.track();
            self.whose.track();
            self.tag.track();
            self.details.set(None);
            self.start_over();
        });
        let (desk, first) = (self.desk.desk(), StoredValue::new(true));
        Effect::new(move |_| {
            desk.library.news.track();
            self.ask_tags();
            if first.get_value() {
                first.set_value(false);
            } else if self.drawn_to.get_value() <= NEAR_TOP_LINES {
                self.reload();
            } else {
                self.stale.set_value(true);
            }
        });
    }

    /// Asks which tags there are; a server that does not answer leaves those that were there.
    fn ask_tags(self) {
        self.desk.desk().look_up(request::Tags {}, move |answer| {
            if let Ok(answer::Tags { tags }) = answer {
                self.tags.try_set(tags);
            }
        });
    }

    fn start_over(self) {
        self.lines.set(Vec::new());
        self.next.set(None);
        self.loading.set(Loading::Begins);
        self.active.set(0);
        if self.place.get_untracked() != ShelfPlace::Templates {
            self.reload();
        }
    }

    /// Asks for the first page.
    pub(super) fn reload(self) {
        // The dialog may be closed meanwhile.
        let Some(asked) = self.asked.try_get_value().map(|asked| asked + 1) else { return };
        self.asked.set_value(asked);
        self.stale.set_value(false);
        let query = self.query(None);
        let words = query.words.clone();
        self.desk.desk().library.ask_page(query, move |page| {
            if self.asked.try_get_value() == Some(asked) {
                self.searched.set(words);
                self.take(page, false);
            }
        });
    }

    /// Asks for the page below, if there is one.
    pub(super) fn more(self) {
        let Some(after) = self.next.get_untracked() else { return };
        if self.asking_more.get_value() {
            return;
        }
        self.asking_more.set_value(true);
        let asked = self.asked.get_value();
        self.desk.desk().library.ask_page(self.query(Some(after)), move |page| {
            if self.asking_more.try_set_value(false).is_none() && self.asked.get_value() == asked {
                self.take(page, true);
            }
        });
    }

    fn take(self, page: Result<ProgramPage, NoAnswer>, below: bool) {
        match page {
            Ok(ProgramPage { lines, next, total }) => {
                self.next.set(next);
                self.total.set(total);
                self.loading.set(Loading::Done);
                self.lines.update(|all| {
                    if !below {
                        all.clear();
                    }
                    all.extend(lines);
                });
                let last = self.lines.with_untracked(Vec::len).saturating_sub(1);
                self.active.update(|active| *active = (*active).min(last));
            }
            Err(why) => self.loading.set(Loading::Failed(why)),
        }
    }

    /// Remembers how far lines are drawn; what changed elsewhere is looked at back at the top.
    pub(super) fn drawn(self, to: usize) {
        self.drawn_to.set_value(to);
        if to <= NEAR_TOP_LINES && self.stale.get_value() {
            self.reload();
        }
    }

    fn query(self, after: Option<Cursor>) -> ListQuery {
        let me = || self.desk.desk().me.with_untracked(|me| me.as_ref().map(|me| me.name.clone()));
        let bin = self.place.get_untracked() == ShelfPlace::Bin;
        ListQuery {
            place: if bin { protocol::SearchPlace::Bin } else { protocol::SearchPlace::Here },
            words: self.words.get_untracked().trim().to_owned(),
            owner: if self.is_mine() { me() } else { None },
            tag: Some(self.tag.get_untracked()).filter(|tag| !bin && !tag.is_empty()),
            sort: if self.order.get_untracked() == "name" { Sort::Name } else { Sort::Changed },
            after,
            ..ListQuery::default()
        }
    }

    pub(super) fn is_mine(self) -> bool {
        self.whose.get_untracked() == "mine"
    }

    /// How many lines there are, or that there are more; for screen readers the size of the list.
    pub(super) fn size(self) -> i64 {
        if self.next.read().is_some() { -1 } else { i64::try_from(self.lines.read().len()).unwrap_or(-1) }
    }

    /// How many programs there are in this place, or how many were found where something is looked for.
    pub(super) fn count_words(self) -> String {
        let narrowed =
            !self.searched.read().is_empty() || !self.tag.read().is_empty() || self.whose.read().as_str() == "mine";
        match self.loading.get() {
            Loading::Done if narrowed => words::programs_found(self.lines.read().len(), self.next.read().is_some()),
            Loading::Done => words::programs_in_all(self.total.get()),
            Loading::Begins | Loading::Failed(_) => String::new(),
        }
    }
}
