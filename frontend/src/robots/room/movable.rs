//! Something in the room that a hand, a pen, a mouse or the arrow keys move.

use super::HeldThing;
use super::map::{self, RoomMap};
use crate::browser;
use crate::keys::PressedKey;
use crate::parts::{DeskHold, Soon, hold, may_operate};
use crate::robots::words;
use leptos::prelude::*;
use leptos::svg::Svg;
use protocol::Role;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent, PointerEvent};

/// How far an arrow key moves, in metres.
const STEP: f32 = 0.05;
/// How often a moving thing tells the room where it is, in milliseconds.
const TELL_MS: i32 = 33;
/// For how long it stays where it was put until the room has answered, in milliseconds.
const SETTLE_MS: i32 = 300;

/// Something that can be moved.
#[component]
pub(super) fn Movable(
    label: &'static str,
    /// Names it among the things that are held.
    key: String,
    map: Memo<RoomMap>,
    held: HeldThing,
    svg: NodeRef<Svg>,
    /// Where the room says it is.
    at: Signal<[f32; 3]>,
    /// Tells the room where it is now.
    edit: Callback<[f32; 3], String>,
    children: Children,
) -> impl IntoView {
    let desk = hold();
    let grip = RoomGrip::new(key, held, at, edit);
    let shown = {
        let grip = grip.clone();
        Memo::new(move |_| grip.shown())
    };
    let transform = move || {
        let [x, y, _] = shown.get();
        let (right, down) = map.get().at(x, y);
        format!("translate({right:.1} {down:.1})")
    };
    let (down, moved, up, keys) = (grip.clone(), grip.clone(), grip.clone(), grip.clone());
    let pressed = move |event: PointerEvent| {
        if untrack(|| !may_operate(desk)) {
            return;
        }
        event.prevent_default();
        capture(&event);
        down.hold(shown.get_untracked());
    };
    let dragged = move |event: PointerEvent| {
        if event.buttons() & 1 == 1
            && moved.is_held()
            && let Some((x, y)) = place(&event, svg, map.get_untracked())
        {
            moved.move_to([x, y, shown.get_untracked()[2]]);
        }
    };
    let let_go = move |_: PointerEvent| up.settle();
    view! {
        <g
            class="movable"
            tabindex="0"
            role="img"
            aria-label=label
            aria-description=move || desk.desk().may_not(Role::Operator).unwrap_or(words::move_hint())
            transform=transform
            data-held=move || grip.is_held().then_some("")
            on:pointerdown=pressed
            on:pointermove=dragged
            on:pointerup=let_go.clone()
            on:pointercancel=let_go
            on:keydown=move |event| if untrack(|| may_operate(desk)) { step(&event, &keys, shown.get_untracked()) }
        >
            <title>{label}</title>
            <circle class="halo" r="22" />
            {children()}
            <text y="27" aria-hidden="true">{move || distance(desk, shown.get())}</text>
        </g>
    }
}

/// What is known while something is held.
#[derive(Clone)]
struct RoomGrip {
    key: StoredValue<String>,
    held: HeldThing,
    at: Signal<[f32; 3]>,
    tell: StoredValue<Soon, LocalStorage>,
    moves: StoredValue<u32>,
}

impl RoomGrip {
    fn new(key: String, held: HeldThing, at: Signal<[f32; 3]>, edit: Callback<[f32; 3], String>) -> Self {
        let tell = Soon::new(move || {
            if let Some(Some((_, at))) = held.try_get_untracked() {
                edit.try_run(at);
            }
        });
        Self { key: StoredValue::new(key), held, at, tell: StoredValue::new_local(tell), moves: StoredValue::new(0) }
    }

    fn is_held(&self) -> bool {
        self.held.read().as_ref().is_some_and(|held| held.0 == self.key.get_value())
    }

    fn shown(&self) -> [f32; 3] {
        let held = self.held.get().filter(|held| held.0 == self.key.get_value());
        held.map_or_else(|| self.at.get(), |held| held.1)
    }

    fn hold(&self, at: [f32; 3]) {
        self.moves.update_value(|moves| *moves += 1);
        self.held.set(Some((self.key.get_value(), at)));
    }

    fn move_to(&self, at: [f32; 3]) {
        self.hold(at);
        self.tell.with_value(|tell| tell.within(TELL_MS));
    }

    /// Lets go once the room has had time to answer.
    fn settle(&self) {
        let (held, moves) = (self.held, self.moves);
        let last = moves.get_value();
        browser::after(SETTLE_MS, move || {
            if moves.try_get_value() == Some(last) {
                held.set(None);
            }
        });
    }
}

fn capture(event: &PointerEvent) {
    if let Some(target) = event.current_target().and_then(|target| target.dyn_into::<Element>().ok()) {
        let _ = target.set_pointer_capture(event.pointer_id());
    }
}

fn place(event: &PointerEvent, svg: NodeRef<Svg>, map: RoomMap) -> Option<(f32, f32)> {
    let bounds = svg.get_untracked()?.get_bounding_client_rect();
    let client = (event.client_x() as f32, event.client_y() as f32);
    let corner = (bounds.left() as f32, bounds.top() as f32);
    let (right, down) = map::point(client, corner, (bounds.width() as f32, bounds.height() as f32));
    Some(map.place(right, down))
}

fn step(event: &KeyboardEvent, grip: &RoomGrip, [x, y, z]: [f32; 3]) {
    let to = match event.pressed().as_str() {
        "ArrowUp" => [x + STEP, y, z],
        "ArrowDown" => [x - STEP, y, z],
        "ArrowLeft" => [x, y + STEP, z],
        "ArrowRight" => [x, y - STEP, z],
        "PageUp" => [x, y, z + STEP],
        "PageDown" => [x, y, z - STEP],
        _ => return,
    };
    event.prevent_default();
    event.stop_propagation();
    grip.move_to(to);
    grip.settle();
}

/// How far it is from the robot's camera.
fn distance(desk: DeskHold, [x, y, z]: [f32; 3]) -> String {
    let desk = desk.desk();
    let body = &desk.robots.scene.read().body;
    let [from_x, from_y, from_z, _, _] = body.gaze;
    let up = if z == 0.0 { 0.0 } else { z - from_z };
    let squares = (x - from_x).powi(2) + (y - from_y).powi(2) + up.powi(2);
    words::how_far(f64::from(squares.sqrt()), desk.document.in_centimetres())
}
