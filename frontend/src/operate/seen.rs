//! The others and the room as they are seen: their presses and faces, the room from above, the camera.

use super::OperateShared;
use crate::desk::{Sign, initials};
use crate::operate::words;
use crate::people::in_color;
use crate::robots::{CameraPicture, RoomPicture};
use behaviour::Id;
use leptos::prelude::*;

/// Presses are kept for so long, in milliseconds, and at most so many.
pub(super) const KEPT_MS: f64 = 120_000.0;
const KEPT_MAX: usize = 240;

/// A press of somebody.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SeenPress {
    pub(super) at: f64,
    pub(super) client: Id,
    pub(super) by: String,
    /// False if nothing came of it.
    pub(super) done: bool,
}

impl OperateShared {
    /// Keeps what somebody pressed.
    pub(super) fn saw(self, seen: SeenPress) {
        self.seen.try_update(|all| {
            let now = seen.at;
            all.push_back(seen);
            while all.len() > KEPT_MAX || all.front().is_some_and(|first| now - first.at > KEPT_MS) {
                all.pop_front();
            }
        });
    }

    /// The sign of a person who is here. Reactive.
    pub(super) fn sign(self, client: &Id) -> Option<Sign> {
        self.desk.desk().document.signs().into_iter().find(|sign| sign.client == *client)
    }

    /// The sign of a person who is here, by their name. Reactive.
    pub(super) fn sign_of(self, name: &str) -> Option<Sign> {
        self.desk.desk().document.signs().into_iter().find(|sign| sign.name == name)
    }

    /// The colour of a person; grey for who left. Reactive.
    pub(super) fn color_of(self, client: &Id) -> String {
        self.sign(client).map_or_else(|| "var(--line-strong)".to_owned(), |sign| in_color(&sign))
    }
}

/// Somebody's avatar.
#[component]
pub(super) fn Face(op: OperateShared, client: Id, name: String) -> impl IntoView {
    let sign = op.sign(&client).or_else(|| op.sign_of(&name));
    let color = sign.as_ref().map_or_else(|| "var(--line-strong)".to_owned(), in_color);
    let letters = sign.map_or_else(|| initials(&name), |sign| sign.letters);
    view! { <span class="avatar face" style=("--person", color) aria-hidden="true" data-letters=letters></span> }
}

/// The room from above, or what the camera sees.
#[component]
pub(super) fn Room(op: OperateShared) -> impl IntoView {
    let camera = Memo::new(move |_| op.desk.desk().robots.with_camera().filter(|_| op.may()));
    let looks = RwSignal::new(false);
    let shown = Memo::new(move |_| camera.get().filter(|_| looks.get()));
    let tab = move |which: bool, label: &'static str| {
        view! {
            <button class="op-tab" type="button" aria-pressed=move || (looks.get() == which).to_string()
                on:click=move |_| looks.set(which)>{label}</button>
        }
    };
    view! {
        <div class="op-room">
            <Show when=move || camera.read().is_some()>
                <div class="op-tabs" role="group" aria-label=words::room_or_camera()>{tab(false, words::room())}{tab(true, words::camera())}</div>
            </Show>
            {move || match shown.get() {
                Some(robot) => view! { <div class="op-camera"><CameraPicture robot /></div> }.into_any(),
                // It is looked at here: nothing in it is moved by a hand that only passes over it.
                None => view! { <div class="op-still" inert=true><RoomPicture /></div> }.into_any(),
            }}
        </div>
    }
}
