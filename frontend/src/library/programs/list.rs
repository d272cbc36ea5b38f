//! The list itself: only the lines that are seen are drawn, and arrow keys walk through all of them.

use super::line::{Line, line_id};
use super::shelf::{Loading, ShelfPlace, ShownShelf};
use super::window::{LINE_PX, drawn, is_near_end, scroll_to};
use crate::focus;
use crate::keys::PressedKey;
use crate::library::words;
use crate::link::NoAnswer;
use leptos::prelude::*;
use web_sys::{HtmlElement, KeyboardEvent};

/// The id of the search box.
pub(super) const SEARCH_ID: &str = "program-search";
/// A box that is not measured yet is taken for this high, in pixels.
const HEIGHT_PX: f64 = 600.0;

/// The lines, or a sentence and a way out.
#[component]
pub(super) fn List(shown: ShownShelf) -> impl IntoView {
    let content = move || match shown.loading.get() {
        Loading::Begins => view! { <p class="shelf-note second" role="status">{words::loading_list()}</p> }.into_any(),
        Loading::Failed(why) => view! { <Failed shown why /> }.into_any(),
        Loading::Done if shown.lines.read().is_empty() => view! { <Nothing shown /> }.into_any(),
        Loading::Done => view! { <Lines shown /> }.into_any(),
    };
    // Drawn anew only when it becomes something else, not with every page.
    let kind = Memo::new(move |_| (shown.loading.get(), shown.lines.read().is_empty()));
    move || {
        kind.get();
        untrack(content)
    }
}

#[component]
fn Failed(shown: ShownShelf, why: NoAnswer) -> impl IntoView {
    view! {
        <div class="shelf-note">
            <p class="refusal" role="alert">{words::not_answered(&why)}</p>
            <button class="button" type="button" on:click=move |_| {
                shown.loading.set(Loading::Begins);
                shown.reload();
            }>{words::try_again()}</button>
        </div>
    }
}

/// Why there is nothing to show, and what to do.
#[component]
fn Nothing(shown: ShownShelf) -> impl IntoView {
    move || {
        let searched = shown.searched.get();
        let (sentence, out) = if searched.is_empty() { nothing_here(shown) } else { nothing_fits(shown, &searched) };
        view! { <div class="shelf-note"><p class="second">{sentence}</p>{out}</div> }
    }
}

fn nothing_fits(shown: ShownShelf, searched: &str) -> (String, Option<AnyView>) {
    (words::nothing_fits(searched), Some(way_out(words::clear_search(), move || clear_search(shown))))
}

fn nothing_here(shown: ShownShelf) -> (String, Option<AnyView>) {
    if shown.place.get_untracked() == ShelfPlace::Bin {
        (words::bin_empty().to_owned(), None)
    } else if !shown.tag.read_untracked().is_empty() {
        let all = way_out(words::show_all_tags(), move || shown.tag.set(String::new()));
        (words::none_tagged(&shown.tag.get_untracked()), Some(all))
    } else if shown.is_mine() {
        let all = way_out(words::show_everyones(), move || shown.whose.set("all".to_owned()));
        (words::none_mine().to_owned(), Some(all))
    } else {
        let templates = way_out(words::show_templates(), move || shown.place.set(ShelfPlace::Templates));
        (words::no_programs().to_owned(), Some(templates))
    }
}

fn way_out(label: &'static str, act: impl Fn() + 'static) -> AnyView {
    view! { <button class="button" type="button" on:click=move |_| act()>{label}</button> }.into_any()
}

fn clear_search(shown: ShownShelf) {
    shown.words.set(String::new());
    if let Some(search) = focus::by_id(SEARCH_ID) {
        focus::focus(&search);
    }
}

#[component]
fn Lines(shown: ShownShelf) -> impl IntoView {
    let frame = shown.frame;
    let seen = RwSignal::new((0.0, HEIGHT_PX));
    let look = move || {
        if let Some(frame) = frame.get_untracked() {
            seen.set((f64::from(frame.scroll_top()), f64::from(frame.client_height())));
        }
    };
    Effect::new(move |_| {
        if frame.get().is_some() {
            look();
        }
    });
    let count = Memo::new(move |_| shown.lines.read().len());
    let range = Memo::new(move |_| {
        let (scrolled, height) = seen.get();
        drawn(scrolled, height, count.get())
    });
    Effect::new(move |_| {
        let range = range.get();
        shown.drawn(range.end);
        if is_near_end(&range, count.get()) {
            shown.more();
        }
    });
    let active = shown.active;
    let places = move || {
        let (mut places, active): (Vec<usize>, _) = (range.get().collect(), active.get());
        if active < count.get() && !places.contains(&active) {
            places.push(active);
        }
        places
    };
    view! {
        <div class="shelf lines" node_ref=frame on:scroll=move |_| look() on:keydown=move |event| walk(shown, &event)>
            <ul class="program-lines" aria-label=words::programs() style:height=move || format!("{}px", count.get() as f64 * LINE_PX)>
                <For each=places key=|place| *place children=move |place| view! { <Line shown place /> } />
            </ul>
        </div>
    }
}

/// Arrow keys, Page Up and Down, Home and End.
fn walk(shown: ShownShelf, event: &KeyboardEvent) {
    let (now, count) = (shown.active.get_untracked(), shown.lines.with_untracked(Vec::len));
    let page =
        shown.frame.get_untracked().map_or(1, |frame| (f64::from(frame.client_height()) / LINE_PX) as usize).max(1);
    let to = match event.pressed().as_str() {
        "ArrowDown" => now + 1,
        "ArrowUp" if now == 0 => {
            event.prevent_default();
            if let Some(search) = focus::by_id(SEARCH_ID) {
                focus::focus(&search);
            }
            return;
        }
        "ArrowUp" => now - 1,
        "PageDown" => now + page,
        "PageUp" => now.saturating_sub(page),
        "Home" => 0,
        "End" => count,
        _ => return,
    };
    event.prevent_default();
    go(shown, to.min(count.saturating_sub(1)));
}

/// Gives a line the keyboard, and shows it.
pub(super) fn go(shown: ShownShelf, line: usize) {
    shown.active.set(line);
    if let Some(frame) = shown.frame.get_untracked() {
        let (scrolled, height) = (f64::from(frame.scroll_top()), f64::from(frame.client_height()));
        if let Some(to) = scroll_to(line, scrolled, height) {
            frame.set_scroll_top(to as i32);
        }
    }
    let _ = request_animation_frame(move || focus_line(line));
}

fn focus_line(line: usize) {
    let button: Option<HtmlElement> = focus::by_id(&line_id(line));
    if let Some(button) = button {
        focus::focus(&button);
    }
}
