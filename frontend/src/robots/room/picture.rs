//! The floor with its grid, and the robot: body, arms, head, eyes and what its camera sees.

use super::map::{HEIGHT, RoomMap, WIDTH};
use crate::parts::{DeskHold, hold};
use leptos::prelude::*;

/// Half the width across the shoulders and half the depth, the head's radius, and how far the view is drawn; in metres.
const SHOULDERS: f32 = 0.14;
const CHEST: f32 = 0.075;
const HEAD: f32 = 0.075;
/// An eye's radius, how far it is from the middle of the face, and how far ahead; in metres, larger than life.
const EYE: f32 = 0.024;
const EYE_ASIDE: f32 = 0.034;
const EYE_AHEAD: f32 = 0.045;
/// The smallest radius of an eye, in units of the picture.
const EYE_MIN: f32 = 3.0;
const SIGHT: f32 = 1.6;

/// The floor.
#[component]
pub(super) fn Floor(map: Memo<RoomMap>) -> impl IntoView {
    let lines = move || {
        let (across, along) = map.get().grid();
        let across = across.into_iter().map(|at| view! { <line class="grid-line" x1="0" x2=WIDTH y1=at y2=at /> });
        let along = along.into_iter().map(|at| view! { <line class="grid-line" y1="0" y2=HEIGHT x1=at x2=at /> });
        (across.collect_view(), along.collect_view())
    };
    view! { <g aria-hidden="true">{lines}</g> }
}

/// The robot.
#[component]
pub(super) fn Robot(map: Memo<RoomMap>) -> impl IntoView {
    let desk = hold();
    let length = move |metres| move || map.get().length(metres);
    let touched = move || !desk.desk().robots.scene.read().body.touched.is_empty();
    let eyes = Memo::new(move |_| {
        let [red, green, blue] =
            desk.desk().robots.scene.read().body.eyes.map(|part| (part.clamp(0.0, 1.0) * 255.0) as u8);
        format!("rgb({red} {green} {blue})")
    });
    let eye = move |side: f32| {
        let x = move || map.get().length(side * EYE_ASIDE);
        let y = move || -map.get().length(EYE_AHEAD);
        let radius = move || map.get().length(EYE).max(EYE_MIN);
        view! { <circle class="eye" r=radius cx=x cy=y fill=move || eyes.get() /> }
    };
    view! {
        <g aria-hidden="true">
            <path class="cone" d=move || cone(desk, map.get()) />
            {arm(desk, map, 0)}
            {arm(desk, map, 1)}
            <g transform=move || stands(desk, map.get())>
                <ellipse class="body" rx=length(SHOULDERS) ry=length(CHEST) />
            </g>
            <g transform=move || looks(desk, map.get())>
                <circle class="body" class:touched=touched r=length(HEAD) />
                {eye(-1.0)}
                {eye(1.0)}
            </g>
        </g>
    }
}

fn stands(desk: DeskHold, map: RoomMap) -> String {
    let [x, y, heading] = desk.desk().robots.scene.read().body.base;
    let (right, down) = map.at(x, y);
    format!("translate({right:.1} {down:.1}) rotate({:.1})", -heading.to_degrees())
}

/// Where the head is and where it looks: x, y and direction.
fn head(desk: DeskHold) -> [f32; 3] {
    let desk = desk.desk();
    let body = &desk.robots.scene.read().body;
    let [x, y, _, yaw, _] = body.gaze;
    if body.gaze == [0.0; 5] { body.base } else { [x, y, yaw] }
}

fn looks(desk: DeskHold, map: RoomMap) -> String {
    let [x, y, yaw] = head(desk);
    let (right, down) = map.at(x - 0.03 * yaw.cos(), y - 0.03 * yaw.sin());
    format!("translate({right:.1} {down:.1}) rotate({:.1})", -yaw.to_degrees())
}

fn cone(desk: DeskHold, map: RoomMap) -> String {
    let [x, y, yaw] = head(desk);
    let half = match desk.desk().robots.scene.read().body.gaze_half {
        0.0 => 0.49,
        half => half,
    };
    let from = map.at(x, y);
    let end = |angle: f32| map.at(x + SIGHT * angle.cos(), y + SIGHT * angle.sin());
    let (left, right) = (end(yaw + half), end(yaw - half));
    let round = map.length(SIGHT);
    format!(
        "M{:.1} {:.1}L{:.1} {:.1}A{round:.1} {round:.1} 0 0 1 {:.1} {:.1}Z",
        from.0, from.1, left.0, left.1, right.0, right.1
    )
}

/// One arm: 0 left, 1 right.
fn arm(desk: DeskHold, map: Memo<RoomMap>, side: usize) -> impl IntoView {
    let sign = if side == 0 { 1.0 } else { -1.0 };
    let ends = Memo::new(move |_| {
        let desk = desk.desk();
        let body = &desk.robots.scene.read().body;
        let ([x, y, heading], [hand_x, hand_y, _]) = (body.base, body.hands[side]);
        let shoulder = (x - sign * heading.sin() * SHOULDERS * 0.85, y + sign * heading.cos() * SHOULDERS * 0.85);
        let hand = if body.hands[side] == [0.0; 3] { shoulder } else { (hand_x, hand_y) };
        (map.get().at(shoulder.0, shoulder.1), map.get().at(hand.0, hand.1))
    });
    view! {
        <line
            class="arm"
            x1=move || ends.get().0.0
            y1=move || ends.get().0.1
            x2=move || ends.get().1.0
            y2=move || ends.get().1.1
        />
        <circle class="body" r="4" cx=move || ends.get().1.0 cy=move || ends.get().1.1 />
    }
}
