//! The verdict of a mark: good, not good, or that the robot should have done something. A finger or a key that stays down on
//! something that marks asks for it.

use super::OperateShared;
use super::marks::Mark;
use super::pad::TileWork;
use crate::browser;
use crate::escape;
use crate::focus::{self, FocusPlace};
use crate::icons::Icon;
use crate::operate::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::MarkSort;
use web_sys::PointerEvent;

/// A press is long from here on, in milliseconds.
const LONG_MS: i32 = 500;
/// The click that ends a long press comes within this, in milliseconds, and is none.
const CLICK_MS: f64 = 400.0;

/// The long press that there is, and the mark that it asks about.
#[derive(Clone, Copy)]
pub(super) struct VerdictAsked {
    /// The mark whose verdict is asked.
    pub(super) of: RwSignal<Option<Id>>,
    /// Which press is down; each beginning and each end is another one.
    down: StoredValue<u64>,
    /// The moment until which a click only ends a long press, by this computer's clock.
    ends: StoredValue<f64>,
}

/// Something that marks, and can be held.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HeldMark {
    /// A tile, by its number.
    Tile(usize),
    /// A word, or none.
    Word(String),
}

impl VerdictAsked {
    /// Nothing is down.
    pub(super) fn new() -> Self {
        Self { of: RwSignal::new(None), down: StoredValue::new(0), ends: StoredValue::new(0.0) }
    }

    fn next(self) -> u64 {
        self.down.update_value(|down| *down += 1);
        self.down.get_value()
    }
}

impl OperateShared {
    /// A finger or the mouse went down on something that marks: it marks that moment if it stays.
    pub(super) fn finger_down(self, event: &PointerEvent, on: HeldMark) {
        if event.button() != 0 {
            return;
        }
        let at = browser::today_ms();
        self.verdict.ends.set_value(0.0);
        self.after_a_while(move || {
            self.verdict.ends.set_value(f64::INFINITY);
            self.judge(self.mark_held(&on, at));
        });
    }

    /// A key went down that marked this.
    pub(super) fn key_down(self, mark: Option<Id>) {
        if let Some(mark) = mark {
            self.after_a_while(move || self.judge(Some(mark)));
        }
    }

    /// The finger or the key is up, or somewhere else.
    pub(super) fn let_go(self) {
        self.verdict.next();
        if self.verdict.ends.get_value() == f64::INFINITY {
            self.verdict.ends.set_value(browser::today_ms() + CLICK_MS);
        }
    }

    /// True if this click only ends a long press, once.
    pub(super) fn ends_long_press(self) -> bool {
        let ends = self.verdict.ends.get_value();
        self.verdict.ends.set_value(0.0);
        browser::today_ms() < ends
    }

    fn after_a_while(self, act: impl FnOnce() + 'static) {
        let this = self.verdict.next();
        browser::after(LONG_MS, move || {
            if self.verdict.down.try_get_value() == Some(this) {
                act();
            }
        });
    }

    /// Marks with what is held; a span that goes on is asked about and not ended.
    fn mark_held(self, on: &HeldMark, at: f64) -> Option<Id> {
        let number = match on {
            HeldMark::Word(word) => return self.made_by(|| self.mark(word, at)),
            HeldMark::Tile(number) => *number,
        };
        if let Some(open) = self.open_span_of(number) {
            return Some(open);
        }
        self.made_by(|| {
            self.press(number, at);
        })
    }

    /// The span that a tile's word began, if it goes on. Not reactive.
    pub(super) fn open_span_of(self, number: usize) -> Option<Id> {
        let does = self.pad.with_untracked(|pad| pad.iter().find(|tile| tile.key == number).map(|t| t.does.clone()));
        let Some(TileWork::Word { word, span: true }) = does else { return None };
        self.marks.open_span(&word)
    }

    /// True if a tile marks with a word, and now. Not reactive.
    pub(super) fn is_word(self, number: usize) -> bool {
        let word = |tile: &super::pad::PadTile| tile.key == number && matches!(tile.does, TileWork::Word { .. });
        self.pad.with_untracked(|pad| pad.iter().any(word)) && untrack(|| self.can_mark())
    }

    /// Asks for the verdict of a mark.
    fn judge(self, mark: Option<Id>) {
        let Some(mark) = mark else { return };
        self.verdict.of.set(Some(mark));
        self.whisper(words::how_was_it());
        focus::place(FocusPlace::Verdict);
    }

    /// The mark whose verdict is asked, while it is there. Reactive.
    fn judged(self) -> Option<Mark> {
        let id = self.verdict.of.get()?;
        self.marks.all.with(|all| all.iter().find(|mark| mark.id == id).cloned())
    }

    fn decide(self, sort: MarkSort) {
        let Some(id) = self.verdict.of.get_untracked() else { return };
        self.leave_verdict();
        self.judge_mark(&id, sort);
        self.whisper(words::verdict(sort));
        if sort == MarkSort::Now {
            self.open_note_of(&id);
            focus::place(FocusPlace::MarkNote);
        }
    }

    fn leave_verdict(self) {
        self.verdict.of.set(None);
        focus::place(FocusPlace::MarkButton);
    }
}

/// The three verdicts, beside the mark.
#[component]
pub(super) fn Verdict(op: OperateShared) -> impl IntoView {
    let shown = Memo::new(move |_| op.judged().map(|mark| (mark.id, words::word_or_mark(&mark.word))));
    let one = move |sort: MarkSort, label: &'static str| {
        view! { <button class="button" type="button" on:click=move |_| if !op.ends_long_press() { op.decide(sort) }>{label}</button> }
    };
    move || {
        let (_, word) = shown.get()?;
        Some(view! {
            <div class="op-verdict" role="group" aria-label=words::titled(&word, words::how_was_it())
                on:keydown=move |event| { escape::ends(&event, || op.leave_verdict()); }>
                <p><b class="cut" title=word.clone()>{word.clone()}</b>" "{words::how_was_it()}</p>
                {one(MarkSort::Good, words::verdict(MarkSort::Good))}
                {one(MarkSort::Bad, words::verdict(MarkSort::Bad))}
                {one(MarkSort::Now, words::it_should_now())}
                <button class="button op-more" type="button" aria-label=words::close() title=words::close() on:click=move |_| if !op.ends_long_press() { op.leave_verdict() }>
                    <Icon name="close" />
                </button>
            </div>
        })
    }
}
