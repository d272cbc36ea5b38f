//! The marks of a past as a list: a press goes there. It stands at the left of the graph while that shows the past; in a smaller
//! window it is opened beside the lanes, or below them.

use super::media::{page_element, while_holds};
use super::{PastShared, clock, target};
use crate::browser;
use crate::desk::initials;
use crate::focus;
use crate::icons::Icon;
use crate::keys::PressedKey;
use crate::past::words;
use crate::people::in_color;
use lanes::LaneAct;
use leptos::portal::Portal;
use leptos::prelude::*;
use protocol::{MarkSort, OpenedPast, RecordingMark};
use web_sys::KeyboardEvent;

/// The most marks that are listed; typing finds the others.
const LISTED_MAX: usize = 300;
/// A mark is the current one also this far from the cursor, in milliseconds: moments are whole ones.
const NEAR_MS: f64 = 0.5;
/// There is room for the list at the left.
const WIDE: &str = "(min-width: 1200px) and (min-height: 521px)";

/// A mark as it is listed.
#[derive(Clone, Debug, PartialEq)]
struct ListedMark {
    /// The moment, and the end of a span, in milliseconds since the first moment that is known.
    t: f64,
    until: Option<f64>,
    time: String,
    text: String,
    /// Words beside its name: the verdict, a note, how long it went on.
    more: String,
    by: String,
}

impl ListedMark {
    fn of(opened: &OpenedPast, mark: &RecordingMark) -> Self {
        let at = |ms: u64| ms as f64 - opened.from_ms as f64;
        let (t, until) = (at(mark.t), mark.until.map(at));
        let has_word = !mark.word.is_empty();
        let text = match (has_word, mark.note.is_empty()) {
            (false, false) => words::saying(&mark.note),
            _ => words::word_or_mark(&mark.word),
        };
        let sort = (mark.sort != MarkSort::Note).then(|| words::verdict(mark.sort).to_owned());
        let lasts = until.map(|until| clock::length(until - t));
        let note = (has_word && !mark.note.is_empty()).then(|| words::saying(&mark.note));
        let more = [sort, lasts, note].into_iter().flatten().collect::<Vec<_>>().join(" · ");
        Self { t, until, time: clock::time(opened, t, false), text, more, by: mark.by.clone() }
    }

    /// True if what is typed is in its words.
    fn has(&self, typed: &str) -> bool {
        [&self.time, &self.text, &self.more, &self.by].iter().any(|words| words.to_lowercase().contains(typed))
    }
}

/// All marks in the order of time.
fn all(opened: &OpenedPast) -> Vec<ListedMark> {
    let there = opened.marks.iter().filter(|mark| !mark.gone);
    let mut all: Vec<ListedMark> = there.map(|mark| ListedMark::of(opened, mark)).collect();
    all.sort_by(|one, other| one.t.total_cmp(&other.t));
    all
}

/// The mark at which the cursor is: the newest one that is not over by then.
fn current(all: &[ListedMark], cursor: f64) -> Option<f64> {
    let is_on = |mark: &&ListedMark| cursor >= mark.t - NEAR_MS && cursor <= mark.until.unwrap_or(mark.t) + NEAR_MS;
    all.iter().rev().find(is_on).map(|mark| mark.t)
}

/// The list in its place at the left, for as long as the graph shows the past.
#[component]
pub(super) fn MarksAtLeft(past: PastShared) -> impl IntoView {
    let is_wide = while_holds(WIDE);
    let is_left = Memo::new(move |_| is_wide.get() && past.then.at.get().is_some());
    Effect::new(move |_| past.marks_left.set(is_left.get()));
    view! {
        <Show when=move || is_left.get()>
            {page_element("#app").map(|mount| view! { <Portal mount><div class="then-left"><Marks past /></div></Portal> })}
        </Show>
    }
}

/// The list beside the lanes, where somebody opened it.
#[component]
pub(super) fn MarksBeside(past: PastShared) -> impl IntoView {
    view! {
        <Show when=move || past.shows_marks.get() && !past.marks_left.get()>
            <div class="past-marks"><Marks past /></div>
        </Show>
    }
}

/// Opens the list beside the lanes, where it does not stand at the left.
#[component]
pub(super) fn MarksButton(past: PastShared) -> impl IntoView {
    view! {
        <Show when=move || !past.marks_left.get()>
            <button class="past-tool past-opens-marks" type="button" aria-pressed=move || past.shows_marks.get().to_string()
                on:click=move |_| past.shows_marks.update(|shows| *shows = !*shows)>
                {words::marks_name()}
            </button>
        </Show>
    }
}

#[component]
fn Marks(past: PastShared) -> impl IntoView {
    let typed = RwSignal::new(String::new());
    let marks = Memo::new(move |_| past.opened.get().map(|opened| all(&opened)).unwrap_or_default());
    let found = Memo::new(move |_| {
        let typed = typed.read().trim().to_lowercase();
        marks.read().iter().filter(|mark| mark.has(&typed)).take(LISTED_MAX + 1).cloned().collect::<Vec<_>>()
    });
    let here = Memo::new(move |_| current(&marks.read(), past.viewer.read().cursor()));
    Effect::new(move |_| {
        here.track();
        browser::rendered(reveal);
    });
    let enter = move |event: KeyboardEvent| {
        if event.pressed() == "Enter" {
            event.prevent_default();
            let time = past.opened.get_untracked().and_then(|opened| clock::typed(&opened, &typed.read_untracked()));
            if let Some(t) = time.or_else(|| found.read_untracked().first().map(|mark| mark.t)) {
                past.seek(t);
            }
        }
    };
    // The keyboard goes along at once: whoever presses keys fast is not brought back afterwards.
    let to_current = move || {
        let at = here.get_untracked().and_then(|t| found.read_untracked().iter().position(|mark| mark.t == t));
        let rows = page_element(".marks-list").map(|list| focus::all(&list, ".mark-row")).unwrap_or_default();
        if let Some(row) = at.and_then(|at| rows.get(at)) {
            focus::focus(row);
        }
    };
    let key = move |event: KeyboardEvent| {
        let in_field = target(&event).is_some_and(|target| target.tag_name() == "INPUT");
        let pressed = event.pressed();
        if !in_field && matches!(pressed.as_str(), "[" | "]") {
            event.prevent_default();
            event.stop_propagation();
            past.act(LaneAct::NextMark(pressed == "]"));
            to_current();
        } else {
            focus::walk(&event, "ArrowDown", "ArrowUp");
        }
    };
    let row = move |mark: ListedMark| view! { <li><MarkRow past mark here /></li> };
    let nothing = move || match () {
        () if marks.read().is_empty() => Some(words::no_marks_yet()),
        () if found.read().is_empty() => Some(words::no_such_mark()),
        () => None,
    };
    view! {
        <section class="marks" aria-label=words::marks_name() on:keydown=key on:focusin=|event| focus::remember(&event)>
            <div class="find">
                <Icon name="search" />
                <input class="input" type="search" data-stop="" tabindex="0" placeholder=words::find_moment() aria-label=words::find_moment()
                    prop:value=move || typed.get() on:input:target=move |event| typed.set(event.target().value()) on:keydown=enter />
            </div>
            <h2>{move || words::marks_counted(marks.read().len())}</h2>
            <ol class="marks-list">{move || found.get().into_iter().take(LISTED_MAX).map(row).collect_view()}</ol>
            {move || nothing().map(|words| view! { <p class="marks-none" role="status">{words}</p> })}
            {move || (found.read().len() > LISTED_MAX).then(|| view! { <p class="marks-none">{words::more_marks(LISTED_MAX)}</p> })}
        </section>
    }
}

#[component]
fn MarkRow(past: PastShared, mark: ListedMark, here: Memo<Option<f64>>) -> impl IntoView {
    let ListedMark { t, time, text, more, by, .. } = mark;
    let is_here = move || (here.get() == Some(t)).then_some("true");
    let person = (!by.is_empty()).then(|| {
        let (name, letters) = (by.clone(), initials(&by));
        let color = move || {
            let signs = past.desk.desk().document.signs();
            signs.iter().find(|sign| sign.name == name).map_or_else(|| "var(--ink-2)".to_owned(), in_color)
        };
        view! { <span class="avatar face" aria-hidden="true" style=("--person", color) title=by.clone()>{letters}</span><span class="sr">{by}</span> }
    });
    let more = (!more.is_empty()).then(|| view! { <small>{more}</small> });
    view! {
        <button class="mark-row" type="button" data-stop="" tabindex="-1" aria-current=is_here on:click=move |_| past.seek(t)>
            <time>{time}</time>" "<span class="mark-what">{text}" "{more}</span>" "{person}
        </button>
    }
}

/// The list, and the row of the mark at which the cursor is.
fn current_row() -> Option<(web_sys::Element, web_sys::HtmlElement)> {
    let list = page_element(".marks-list")?;
    let row = focus::all(&list, "[aria-current]").into_iter().next()?;
    Some((list, row))
}

/// Scrolls the mark at which the cursor is into view.
fn reveal() {
    let Some((list, row)) = current_row() else { return };
    let (list_at, row_at) = (list.get_bounding_client_rect(), row.get_bounding_client_rect());
    let by = (row_at.bottom() - list_at.bottom()).max(0.0) + (row_at.top() - list_at.top()).min(0.0);
    if by != 0.0 {
        list.set_scroll_top(list.scroll_top() + by.round() as i32);
    }
}

#[cfg(test)]
mod tests {
    use super::{ListedMark, current};

    fn mark(t: f64, until: Option<f64>) -> ListedMark {
        let (time, text) = ("12:04:17".to_owned(), "looks away".to_owned());
        ListedMark { t, until, time, text, more: "0:31 · “Slowly”".to_owned(), by: "Yuki".to_owned() }
    }

    #[test]
    fn the_current_mark_is_the_newest_that_is_not_over() {
        let all = [mark(1_000.0, Some(9_000.0)), mark(4_000.0, None), mark(6_000.0, Some(7_000.0))];
        let at = |cursor| current(&all, cursor);
        assert_eq!([at(999.0), at(1_000.0), at(4_000.0)], [None, Some(1_000.0), Some(4_000.0)]);
        assert_eq!([at(4_100.0), at(6_500.0), at(8_000.0)], [Some(1_000.0), Some(6_000.0), Some(1_000.0)]);
        assert_eq!(at(9_100.0), None);
    }

    #[test]
    fn a_mark_is_found_by_its_time_its_words_and_who_set_it() {
        let one = mark(0.0, None);
        assert!(["12:04", "away", "slowly", "yuki", ""].iter().all(|typed| one.has(typed)));
        assert!(!one.has("ben"));
    }
}
