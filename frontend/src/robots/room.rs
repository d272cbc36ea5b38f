//! The robot in its room from above; balls and people are dragged or moved with arrow keys.

mod camera;
mod map;
mod movable;
mod picture;
mod speak;
mod things;
mod tools;

use crate::later::Later;
use crate::parts::hold;
use crate::robots::words;
pub(crate) use camera::{CameraPicture, camera};
pub(crate) use tools::printed;

use leptos::prelude::*;
use map::RoomMap;
use movable::Movable;
use robot::SceneEdit;

/// The smallest radius of a ball, and how far outside it the ring is that says that the robot sees it; in units of the
/// picture.
const BALL_MIN: f32 = 7.0;
const SEEN_GAP: f32 = 4.0;

/// The room, with what may happen in it and the camera.
#[component]
pub(crate) fn Room() -> impl IntoView {
    let desk = hold();
    let sees = Memo::new(move |_| desk.desk().robots.with_camera().is_some());
    let has_printed = Memo::new(move |_| desk.desk().robots.scene.with(|scene| !scene.body.printed.is_empty()));
    view! {
        <RoomPicture />
        <Show when=move || desk.desk().robots.is_simulated()>
            <Later show=|rest| (rest.room_tools)() />
        </Show>
        {move || has_printed.get().then(|| view! { <Later show=|rest| (rest.printed)() /> })}
        {move || sees.get().then(|| view! { <Later show=|rest| (rest.camera)() /> })}
    }
}

/// The room from above.
#[component]
pub(crate) fn RoomPicture() -> impl IntoView {
    let desk = hold();
    let held = RwSignal::new(None);
    let map = Memo::new(move |old: Option<&RoomMap>| match (held.read().is_some(), old) {
        (true, Some(old)) => *old,
        _ => RoomMap::of(&desk.desk().robots.scene.read()),
    });
    let svg = NodeRef::<leptos::svg::Svg>::new();
    let hint =
        move || if desk.desk().robots.is_simulated() { words::room_hint() } else { words::room_of_real() }.to_owned();
    view! {
        <section class="room" class:unheard=move || desk.desk().unheard.read().is_some() aria-label=words::room()>
            <p class="room-title">
                <span>{move || desk.desk().unheard.get().map_or_else(hint, words::room_as_it_was)}</span>
                <span class="legend">
                    <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true" focusable="false">
                        <circle class="sample" cx="8" cy="8" r="3" />
                        <circle class="seen-ring" cx="8" cy="8" r="6.5" />
                    </svg>
                    {words::room_seen()}
                </span>
            </p>
            <svg viewBox=map::VIEW_BOX node_ref=svg role="group" aria-label=words::room_picture()>
                <picture::Floor map />
                <picture::Robot map />
                <things::Obstacles map held svg />
                <things::Landmarks map held svg />
                <People map held svg />
                <Balls map held svg />
            </svg>
            <tools::Bubble />
        </section>
    }
}

/// What may happen in the simulated room, as a view.
pub(crate) fn room_tools() -> AnyView {
    view! {
        <tools::Tools />
        <speak::Speak />
    }
    .into_any()
}

/// Which thing is held and where it is shown meanwhile, in metres.
type HeldThing = RwSignal<Option<(String, [f32; 3])>>;

#[component]
fn Balls(map: Memo<RoomMap>, held: HeldThing, svg: NodeRef<leptos::svg::Svg>) -> impl IntoView {
    let desk = hold();
    let ids = Memo::new(move |_| {
        let desk = desk.desk();
        let scene = desk.robots.scene.read();
        scene.balls.iter().map(|ball| (ball.id.clone(), ball.color.clone())).collect::<Vec<_>>()
    });
    let ball = move |(id, color): (String, String)| {
        let wanted = id.clone();
        let found = move || desk.desk().robots.scene.read().balls.iter().find(|ball| ball.id == wanted).cloned();
        let ball = Memo::new(move |_| found());
        let at = Signal::derive(move || ball.get().map_or([0.0; 3], |ball| ball.at));
        let edit = Callback::new(move |at| {
            desk.desk().robots.scene_edit(SceneEdit::MoveBall { id: id.clone(), at });
            id.clone()
        });
        let radius = move || map.get().length(ball.get().map_or(0.03, |ball| ball.radius)).max(BALL_MIN);
        let seen = Memo::new(move |_| ball.get().is_some_and(|ball| ball.seen));
        let class = format!("ball-{color}");
        view! {
            <Movable label=words::ball_named(&color) key=format!("ball {color}") map held svg at edit>
                <circle class=class.clone() r=radius />
                <Show when=move || seen.get()><circle class="seen-ring" r=move || radius() + SEEN_GAP /></Show>
            </Movable>
        }
    };
    view! { <For each=move || ids.get() key=|id| id.clone() children=ball /> }
}

#[component]
fn People(map: Memo<RoomMap>, held: HeldThing, svg: NodeRef<leptos::svg::Svg>) -> impl IntoView {
    let desk = hold();
    let ids = Memo::new(move |_| {
        let desk = desk.desk();
        let scene = desk.robots.scene.read();
        let here = scene.people.iter().filter(|person| person.present);
        here.map(|person| (person.id.clone(), person.known)).collect::<Vec<_>>()
    });
    let person = move |(id, known): (String, bool)| {
        let wanted = id.clone();
        let person = Memo::new(move |_| {
            desk.desk().robots.scene.read().people.iter().find(|person| person.id == wanted).cloned()
        });
        let at = Signal::derive(move || person.get().map_or([0.0; 3], |person| [person.at[0], person.at[1], 0.0]));
        let edit = Callback::new(move |at: [f32; 3]| {
            desk.desk().robots.scene_edit(SceneEdit::MovePerson { id: id.clone(), at: [at[0], at[1]] });
            id.clone()
        });
        let label = if known { words::person_known() } else { words::person() };
        let seen = move || person.get().is_some_and(|person| person.seen);
        view! {
            <Movable label key="person".to_owned() map held svg at edit>
                <ellipse class="person" class:seen=seen rx="20" ry="11" />
                <circle class="person" class:seen=seen r="9" />
            </Movable>
        }
    };
    view! { <For each=move || ids.get() key=|id| id.clone() children=person /> }
}
