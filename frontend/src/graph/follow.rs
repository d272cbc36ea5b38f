//! Following somebody: the view is theirs until a hand or a key moves it, and the page shows whose it is.

use super::Stage;
use crate::desk::{Desk, Sign, use_desk};
use crate::escape;
use crate::graph::words;
use behaviour::Id;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

impl Stage {
    /// Tells the others what part of the canvas is in view here.
    pub(super) fn tell_view(&self, desk: &Desk) {
        let (stage, document) = (self.clone(), desk.document.clone());
        Effect::new(move |_| {
            let size = stage.size.get();
            document.present_view(Some(stage.view.get().area(size)));
        });
        let document = desk.document.clone();
        on_cleanup(move || {
            document.unfollow();
            document.present_view(None);
        });
    }

    /// Shows what the followed person sees; of who sees no canvas, what they selected.
    pub(super) fn follow(&self, desk: &Desk) {
        let (stage, document) = (self.clone(), desk.document.clone());
        let followed = ArcMemo::new(move |_| document.followed());
        Effect::new(move |_| {
            let (Some(followed), size) = (followed.get(), stage.size.get()) else { return };
            match (followed.view, followed.selected) {
                (Some(area), _) => stage.glide(super::view::View::of_area(area, size)),
                (None, Some(id)) => stage.reveal(&id),
                (None, None) => {}
            }
        });
    }
}

/// The sign of the followed person. Reactive.
fn followed_sign(desk: &Desk, client: Option<Id>) -> Option<Sign> {
    let client = client?;
    desk.document.signs().into_iter().find(|sign| sign.client == client)
}

/// Whose view it is, around the stage and in words, and the way out.
#[component]
pub(super) fn Following() -> impl IntoView {
    let desk = use_desk();
    let sign = {
        let desk = desk.clone();
        ArcMemo::new(move |_| followed_sign(&desk, desk.document.following.get()))
    };
    end_on_escape(desk.clone());
    let said = sign.clone();
    let shown = move |sign: Sign| {
        let document = desk.document.clone();
        view! {
            <div class="following" style=("--person", format!("var(--people-{})", sign.color))>
                <p class="following-line">
                    <span class="avatar" aria-hidden="true">{sign.letters}</span>
                    <b class="cut">{words::following(&sign.name)}</b>
                    <span class="how-it-ends">{words::how_following_ends()}</span>
                    <button class="button small" type="button" on:click=move |_| { document.unfollow(); }>{words::end_following()}</button>
                </p>
            </div>
        }
    };
    view! {
        {move || sign.get().map(&shown)}
        <p class="sr" role="status">{move || said.get().map(|sign| words::following_said(&sign.name))}</p>
    }
}

/// Escape ends it, wherever the keyboard is but in a dialog.
fn end_on_escape(desk: Desk) {
    let handle = window_event_listener(leptos::ev::keydown, move |event: KeyboardEvent| {
        escape::may_end(&event, || desk.dialog.with_untracked(Option::is_none) && desk.document.unfollow());
    });
    on_cleanup(move || handle.remove());
}
