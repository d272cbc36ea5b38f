//! The nine tiles as they are seen: each says within a tenth of a second what became of a press, or why it cannot be pressed.

use super::OperateShared;
use super::pad::{PadTile, TileWork};
use super::press::TileState;
use super::seen::Face;
use super::verdict::HeldMark;
use crate::browser;
use crate::desk::TILES_QUERY;
use crate::icons::Icon;
use crate::operate::words;
use leptos::prelude::*;
use protocol::Role;

/// All of them.
#[component]
pub(super) fn Tiles(op: OperateShared) -> impl IntoView {
    let rests = Memo::new(move |_| op.rests());
    let some = Memo::new(move |_| !op.pad.read().is_empty());
    let opened = Memo::new(move |_| op.desk.desk().document.open.read().is_some());
    let tiles = move || op.pad.get().into_iter().map(|tile| view! { <One op tile /> }).collect_view();
    view! {
        <div class="op-over">
            <p class="op-rest" role="status">{move || rests.get().then(words::buttons_rest)}</p>
            <Change op />
        </div>
        <div class="op-tiles" role="group" aria-label=words::tiles_name()>{tiles}</div>
        <Show when=move || opened.get() && !some.get()>
            <p class="op-none">{words::no_tiles()}</p>
        </Show>
    }
}

/// The way to choose the tiles, on the page with the graph; not while something runs, as it leads away from here.
#[component]
fn Change(op: OperateShared) -> impl IntoView {
    let open = move || {
        let desk = op.desk.desk();
        let is_calm = op.run().is_none() && op.other_runs().is_none();
        desk.document.open.get().filter(|_| is_calm && desk.may(Role::Editor))
    };
    move || {
        let address = format!("/?graph&{TILES_QUERY}#/b/{}", open()?);
        Some(view! { <a class="link op-change" href=address>{words::change_tiles()}</a> })
    }
}

#[component]
fn One(op: OperateShared, tile: PadTile) -> impl IntoView {
    let number = tile.key;
    let (label, icon, does, asks) = (tile.label.clone(), tile.icon, tile.does.clone(), tile.asks);
    let shows = Memo::new(move |_| op.shows(&tile));
    let state = move || match &*shows.read() {
        TileState::Ready => "ready",
        TileState::Going(..) => "going",
        TileState::Next => "next",
        TileState::Asks(_) => "asks",
        TileState::Refused(_) => "refused",
        TileState::Cannot(_) => "cannot",
        TileState::By(..) => "by",
        TileState::On(_) => "on",
    };
    let disabled = Memo::new(move |_| matches!(*shows.read(), TileState::Cannot(_)));
    // The reason that all of them have stands above them.
    let all_rest = Memo::new(move |_| op.rests());
    let line = move || match shows.get() {
        TileState::Ready => asks.then(|| view! { <span>{words::asks_first()}</span> }.into_any()),
        TileState::Asks(_) => {
            Some(view! { <span>{words::asks_now()}</span><kbd aria-hidden="true">{number}</kbd> }.into_any())
        }
        TileState::Cannot(_) if all_rest.get() && op.may() => None,
        TileState::Going(words, _) => Some(view! { <span>{words}</span> }.into_any()),
        TileState::Next => {
            Some(view! { <i class="op-next" aria-hidden="true"></i><span>{words::comes_next()}</span> }.into_any())
        }
        TileState::Refused(why) | TileState::Cannot(why) => Some(view! { <span>{why}</span> }.into_any()),
        TileState::By(client, name) => {
            Some(view! { <Face op client name=name.clone() /><span>{words::just_now(&name)}</span> }.into_any())
        }
        TileState::On(ms) => Some(view! { <span>{words::again_ends_it(&super::clock::length(ms))}</span> }.into_any()),
    };
    let share = move || match *shows.read() {
        TileState::Going(_, percent) | TileState::Asks(percent) => format!("{percent}%"),
        _ => "0%".to_owned(),
    };
    let span = matches!(does, TileWork::Word { span: true, .. });
    let word = matches!(does, TileWork::Word { .. });
    let asking = Memo::new(move |_| matches!(*shows.read(), TileState::Asks(_)));
    let no_label = words::no_to(&label);
    let look = does.look();
    let no =
        move || {
            let (does, label) = (does.clone(), no_label.clone());
            asking.get().then(|| view! {
            <button class="button op-no" type="button" aria-label=label.clone() title=label aria-keyshortcuts="0"
                on:click=move |_| { op.say_no(Some(&does)); }><Icon name="close" /></button>
        })
        };
    view! {
        <div class="op-cell">
        <button class="op-tile" type="button" data-look=look data-state=state disabled=move || disabled.get()
            aria-keyshortcuts=number.to_string() style=("--share", share)
            aria-pressed=move || span.then(|| matches!(*shows.read(), TileState::On(_)).to_string())
            on:keydown=|event| if event.repeat() { event.prevent_default() }
            on:pointerdown=move |event| if word && !op.is_just_uncovered() { op.finger_down(&event, HeldMark::Tile(number)) }
            on:pointerup=move |_| if word { op.let_go() } on:pointercancel=move |_| if word { op.let_go() }
            on:pointerleave=move |_| if word { op.let_go() } on:contextmenu=|event| event.prevent_default()
            on:click=move |_| if !(op.is_just_uncovered() || word && op.ends_long_press()) { op.press(number, browser::today_ms()); }>
            <span class="op-kind"><Icon name=icon /></span>
            <span class="op-words">
                <b>{label}</b>
                <small>{line}</small>
            </span>
            <kbd class="op-key" aria-hidden="true">{number}</kbd>
        </button>
        {no}
        </div>
    }
}
