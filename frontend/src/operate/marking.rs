//! Marking: the button, the words, the newest mark with its note and *Undo*, and the list of all.

use super::OperateShared;
use super::clock::{length, time_of_day};
use super::marks::Mark;
use super::pad::TileWork;
use super::seen::Face;
use super::verdict::{HeldMark, Verdict};
use crate::browser;
use crate::escape;
use crate::icons::Icon;
use crate::operate::words;
use behaviour::Id;
use leptos::prelude::*;
use protocol::{MARK_MAX_CHARS, MARK_WORD_MAX_CHARS, MarkSort};
use web_sys::SubmitEvent;

/// Marks that are listed.
const LISTED_MAX: usize = 30;
/// Words that have a button beside *Mark*.
const WORDS_MAX: usize = 2;

#[component]
pub(super) fn Marking(op: OperateShared) -> impl IntoView {
    let can = Memo::new(move |_| op.can_mark());
    let types = RwSignal::new(false);
    let typed = RwSignal::new(String::new());
    let words = Memo::new(move |_| {
        let has = |word: &String| {
            op.pad.read().iter().any(|tile| matches!(&tile.does, TileWork::Word { word: known, .. } if known == word))
        };
        op.marks.words.get().into_iter().filter(|word| !has(word)).take(WORDS_MAX).collect::<Vec<_>>()
    });
    let word = move |word: String| {
        view! { <MarkButton op class="op-word" word=word.clone()>{word}</MarkButton> }
    };
    let send = move |event: SubmitEvent| {
        event.prevent_default();
        op.mark_typed(&typed.get_untracked());
        typed.set(String::new());
        types.set(false);
    };
    let why = move || match () {
        () if !op.may() => op.desk.desk().may_not(protocol::Role::Operator),
        () if op.run().is_none() => Some(words::marks_begin_with_run()),
        () => None,
    };
    view! {
        <section class="op-marks" aria-label=words::marks_name()>
            <div class="op-mark-row">
                <MarkButton op class="op-mark" word=String::new()><Icon name="flag" />{words::mark()}</MarkButton>
                {move || words.get().into_iter().map(word).collect_view()}
                <button class="button op-more" type="button" aria-label=words::mark_with_word() title=words::mark_with_word()
                    aria-expanded=move || types.get().to_string() disabled=move || !can.get() on:click=move |_| types.update(|types| *types = !*types)>
                    <Icon name="more" />
                </button>
            </div>
            <Show when=move || types.get() && can.get()>
                <form class="op-note-row" on:submit=send on:keydown=move |event| { escape::ends(&event, || types.set(false)); }>
                    <input class="input" type="text" autocomplete="off" maxlength=MARK_WORD_MAX_CHARS.to_string()
                        aria-label=words::word_of_mark() placeholder=words::word_of_mark()
                        prop:value=move || typed.get() on:input:target=move |event| typed.set(event.target().value()) />
                    <button class="button" type="submit">{words::mark()}</button>
                </form>
            </Show>
            <Newest op />
            <Verdict op />
            {move || why().map(|why| view! { <p class="op-why">{why}</p> })}
            <List op />
        </section>
    }
}

/// A button that marks; held, it asks for the verdict too.
#[component]
pub(super) fn MarkButton(op: OperateShared, class: &'static str, word: String, children: Children) -> impl IntoView {
    let (held, press) = (HeldMark::Word(word.clone()), word.clone());
    let title = (!word.is_empty()).then_some(word);
    let key = title.is_none().then_some("M");
    view! {
        <button class=format!("button {class}") type="button" title=title aria-keyshortcuts=key disabled=move || !op.can_mark()
            on:pointerdown=move |event| op.finger_down(&event, held.clone())
            on:pointerup=move |_| op.let_go() on:pointercancel=move |_| op.let_go() on:pointerleave=move |_| op.let_go()
            on:contextmenu=|event| event.prevent_default()
            on:click=move |_| if !op.ends_long_press() { op.mark(&press, browser::today_ms()) }>
            {children()}
        </button>
    }
}

/// The newest one of one's own.
#[component]
fn Newest(op: OperateShared) -> impl IntoView {
    let id = Memo::new(move |_| op.newest_mark().map(|(mark, _)| (mark.id, mark.word, mark.at)));
    let left = Memo::new(move |_| op.newest_mark().map_or(0, |(_, left)| left));
    let note = Memo::new(move |_| op.newest_mark().map(|(mark, _)| mark.note).unwrap_or_default());
    let typed = op.marks.typed;
    let save = move || {
        op.note_mark(&typed.get_untracked());
        typed.set(String::new());
    };
    let send = move |event: SubmitEvent| {
        event.prevent_default();
        save();
    };
    let row = move || {
        let (_, word, at) = id.get()?;
        Some(view! {
            <div class="op-newest">
                <b class="cut" title=words::word_or_mark(&word)>{words::word_or_mark(&word)}</b>
                <span class="op-at">{time_of_day(at)}</span>
                <Show when=move || !op.marks.writes.get()>
                    <button class="link" type="button" aria-keyshortcuts="N" on:click=move |_| { op.open_note(); }>
                        {move || if note.read().is_empty() { words::add_note_to_mark() } else { words::change_note() }}
                    </button>
                </Show>
                <Show when=move || { left.get() > 0 }>
                    <button class="button op-undo" type="button" on:click=move |_| op.undo_mark()>
                        <Icon name="undo" />{move || words::undo_for(left.get())}
                    </button>
                </Show>
            </div>
        })
    };
    view! {
        {row}
        <Show when=move || op.marks.writes.get() && id.read().is_some()>
            <form class="op-note-row" on:submit=send on:keydown=move |event| { escape::ends(&event, || op.marks.writes.set(false)); }>
                <input id="op-note" class="input" type="text" autocomplete="off" maxlength=MARK_MAX_CHARS.to_string() autofocus=true
                    aria-label=words::note_of_mark() placeholder=words::note_of_mark()
                    prop:value=move || typed.get() on:input:target=move |event| typed.set(event.target().value()) />
                <button class="button" type="submit">{words::save()}</button>
            </form>
        </Show>
    }
}

#[component]
fn List(op: OperateShared) -> impl IntoView {
    let shown = Memo::new(move |_| {
        let newest = op.marks.mine.get();
        let all = op.marks.all.read();
        // The newest of one's own stands above already, unless there is more to say of it.
        let has_more =
            |mark: &&Mark| mark.open || !mark.note.is_empty() || !mark.sort.is_note() || (mark.waits && op.rests());
        let others = all.iter().rev().filter(|mark| Some(&mark.id) != newest.as_ref() || has_more(mark));
        others.take(LISTED_MAX).cloned().collect::<Vec<_>>()
    });
    view! {
        <Show when=move || op.can_mark() && op.marks.all.read().is_empty()><p class="op-why">{words::hold_for_verdict()}</p></Show>
        <ul class="op-list">
            <For each=move || shown.get() key=|mark| (mark.id.clone(), (mark.at / 1_000.0) as u64, mark.until.map(|until| until as u64), mark.note.clone(), mark.sort as u8, mark.waits, mark.open)
                children=move |mark| view! { <Row op mark /> } />
        </ul>
    }
}

#[component]
fn Row(op: OperateShared, mark: Mark) -> impl IntoView {
    let (at, open, until) = (mark.at, mark.open, mark.until);
    let lasts = move || match until {
        Some(until) => Some(length(until - at)),
        None if open => Some(words::so_far(&length(op.now.get() - at))),
        None => None,
    };
    let text = if mark.word.is_empty() && !mark.note.is_empty() {
        words::saying(&mark.note)
    } else {
        words::word_or_mark(&mark.word)
    };
    let note = (!mark.word.is_empty() && !mark.note.is_empty()).then(|| words::saying(&mark.note));
    let waits = mark.waits;
    let sort = (mark.sort != MarkSort::Note).then(|| words::verdict(mark.sort));
    let nobody = Id::new("nobody").ok();
    view! {
        <li>
            <span class="op-at">{time_of_day(at)}</span>
            <span class="op-what">
                {text}" "{note}
                {sort.map(|sort| view! { <small class="op-sort">{sort}</small> })}
                <small>{lasts}{waits.then(|| view! { <i aria-hidden="true"></i>{words::mark_waits()} })}</small>
            </span>
            {nobody.map(|client| view! { <Face op client name=mark.by.clone() /> })}
        </li>
    }
}
