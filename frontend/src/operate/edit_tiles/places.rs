//! The nine places.

use super::{TilesShared, focused, picture};
use crate::dialogs::close;
use crate::icons::Icon;
use crate::operate::words;
use behaviour::TILE_KEYS;
use leptos::prelude::*;

/// All of them, and the way back to the usual ones.
#[component]
pub(super) fn Places(shared: TilesShared) -> impl IntoView {
    let document = move || shared.desk.desk().document;
    let own = Memo::new(move |_| document().has_own_pad());
    let give_up = move |_| {
        if own.get_untracked() {
            shared.said.set(words::usual_tiles_back().to_owned());
            document().give_up_pad(move |answer| {
                if answer.is_err() {
                    let _ = shared.said.try_set(String::new());
                }
                shared.desk.desk().say_refusal(answer);
            });
        }
    };
    let says = move || if own.get() { words::tiles_says() } else { words::tiles_are_usual() };
    let reason = move || (!own.get()).then_some("true");
    view! {
        <div class="dialog-body" node_ref=focused()>
            <p class="second">{says}</p>
            <div class="tile-grid" role="group" aria-label=words::edit_tiles()>
                {TILE_KEYS.map(|key| view! { <Place shared key /> }).collect_view()}
            </div>
        </div>
        <div class="dialog-feet">
            <button class="button apart" type="button" aria-disabled=reason on:click=give_up>{words::usual_tiles()}</button>
            <button class="button" type="button" on:click=move |_| close(shared.desk)>{words::close()}</button>
        </div>
    }
}

/// One place: its tile, or that one can be added. It stays one button, so that it keeps the keyboard.
#[component]
fn Place(shared: TilesShared, key: u8) -> impl IntoView {
    let tile = Memo::new(move |_| shared.pad.with(|pad| pad.tiles.get(&key).cloned()));
    let shown = move || match tile.get() {
        Some(tile) => picture(shared.desk, &tile, key).into_any(),
        None => view! {
            <span class="tile-kind" data-look="none"><Icon name="plus" /></span>
            <span class="tile-words"><b>{words::add_tile()}</b></span>
            <kbd aria-hidden="true">{key}</kbd>
        }
        .into_any(),
    };
    let first = (shared.last.get_value() == Some(key)).then_some("");
    view! {
        <button id=format!("tile-{key}") class="tile" type="button" data-first=first class:empty=move || tile.read().is_none()
            on:click=move |_| shared.open(key)>
            {shown}
            <span class="sr">{words::tile_key(key)}</span>
        </button>
    }
}
