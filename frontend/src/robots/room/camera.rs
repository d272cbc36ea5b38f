//! What the robot's camera sees, while one looks through it. Each picture is asked for once the one before is there, and kept
//! nowhere; everyone is told that somebody looks.

use crate::browser;
use crate::icons::Icon;
use crate::parts::{DeskHold, hold, may_operate};
use crate::robots::words;
use behaviour::Id;
use leptos::prelude::*;

/// Pause before a picture is asked for again that did not come, in milliseconds.
const AGAIN_MS: i32 = 1_000;

/// The switch for the camera, for who may run the robot, and the picture under it, as a view.
pub(crate) fn camera() -> AnyView {
    view! { <Camera /> }.into_any()
}

#[component]
fn Camera() -> impl IntoView {
    let desk = hold();
    let robot = Memo::new(move |_| desk.desk().robots.with_camera());
    let watched = Memo::new(move |_| desk.desk().robots.chosen.read().as_ref().is_some_and(|robot| robot.watched));
    let looks = RwSignal::new(None::<Id>);
    // Another robot is another room: one asks to see it anew.
    let shows =
        Memo::new(move |_| looks.get().filter(|looked| robot.read().as_ref() == Some(looked) && may_operate(desk)));
    let press = move |_| {
        let now = if shows.get_untracked().is_some() { None } else { robot.get_untracked() };
        looks.set(now);
    };
    view! {
        <Show when=move || robot.read().is_some() && may_operate(desk)>
            <div class="camera">
                <button
                    class="button small"
                    type="button"
                    aria-pressed=move || shows.read().is_some().to_string()
                    on:click=press
                >
                    <Icon name="eye" />
                    {words::look_through_camera()}
                </button>
                {move || shows.get().map(|robot| view! { <CameraPicture robot /> })}
            </div>
        </Show>
        <div role="status">
            <Show when=move || watched.get() && shows.read().is_none()>
                <p class="camera-watched"><Icon name="eye" />{words::camera_watched()}</p>
            </Show>
        </div>
    }
}

/// The newest picture, again and again.
#[component]
pub(crate) fn CameraPicture(robot: Id) -> impl IntoView {
    let desk: DeskHold = hold();
    let (turn, comes) = (RwSignal::new(0_u32), RwSignal::new(false));
    let next = move || {
        turn.try_update(|turn| *turn = turn.wrapping_add(1));
    };
    let later = move || browser::after(AGAIN_MS, next);
    let loaded = move |_| {
        comes.set(true);
        // Nobody sees a page that is behind another one.
        if browser::is_hidden() { later() } else { next() }
    };
    let failed = move |_| {
        comes.set(false);
        later();
    };
    let source = move || format!("/api/robots/{robot}/camera?{}", turn.get());
    let says = move || {
        if comes.get() || desk.desk().unheard.read().is_some() {
            words::camera_kept_nowhere()
        } else {
            words::camera_waits()
        }
    };
    let picture = NodeRef::<leptos::html::Img>::new();
    // Below the room there may be no place for it in view.
    Effect::new(move |_| {
        if let Some(picture) = picture.get() {
            picture.scroll_into_view_with_bool(false);
        }
    });
    view! {
        <p class="camera-note">{says}</p>
        <img
            node_ref=picture
            class:waits=move || !comes.get()
            width="320"
            height="240"
            alt=words::camera_picture()
            src=source
            on:load=loaded
            on:error=failed
        />
    }
}
