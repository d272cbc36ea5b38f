//! The whole graph in small, from 30 streams on: where one looks, and a way to look elsewhere.

use super::Stage;
use super::hand::StagePoint;
use super::view::{CanvasBounds, View};
use crate::desk::use_desk;
use crate::graph::words;
use crate::keys::PressedKey;
use crate::layout::STREAM_HEIGHT;
use behaviour::{Place, StreamKind};
use leptos::prelude::*;
use std::fmt::Write;
use wasm_bindgen::JsCast;
use web_sys::{Element, KeyboardEvent, PointerEvent};

/// From so many streams on.
pub(super) const FROM: usize = 30;
/// The map's size, and what is left free at its sides, in pixels.
pub(super) const SIZE: (f64, f64) = (188.0, 124.0);
const FREE: f64 = 8.0;
/// The largest and the smallest size of a stream on it, in pixels, and its usual width on the canvas.
const SHAPE: (f64, f64) = (15.0, 6.0);
const SHAPE_MIN: (f64, f64) = (2.0, 1.0);
const USUAL: f64 = 130.0;
/// By which part of what is seen an arrow key moves the view.
const PART: f64 = 0.25;

/// The map, as a view.
pub(crate) fn minimap() -> AnyView {
    view! { <Minimap /> }.into_any()
}

/// The scale by which the canvas becomes the map.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    left: f64,
    top: f64,
    factor: f64,
}

impl Scale {
    /// All of the graph in the middle of the map.
    fn of(all: CanvasBounds) -> Self {
        let (width, height) = ((all.right - all.left).max(1.0), (all.bottom - all.top).max(1.0));
        let free = (SIZE.0 - 2.0 * FREE, SIZE.1 - 2.0 * FREE);
        let factor = (free.0 / width).min(free.1 / height);
        let spare = ((SIZE.0 - width * factor) / 2.0, (SIZE.1 - height * factor) / 2.0);
        Self { left: all.left - spare.0 / factor, top: all.top - spare.1 / factor, factor }
    }

    fn to_map(self, place: Place) -> StagePoint {
        ((place.x - self.left) * self.factor, (place.y - self.top) * self.factor)
    }

    fn to_canvas(self, (x, y): StagePoint) -> Place {
        Place { x: x / self.factor + self.left, y: y / self.factor + self.top }
    }
}

#[component]
fn Minimap() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let shapes = stage.shapes.clone();
    let scale = ArcMemo::new(move |_| {
        shapes.with(|shapes| CanvasBounds::around(shapes.iter().map(|(_, bounds)| *bounds))).map(Scale::of)
    });
    let kind = |kind: StreamKind, class: &'static str| {
        let (desk, shapes, scale) = (desk.clone(), stage.shapes.clone(), scale.clone());
        let path = ArcMemo::new(move |_| {
            let Some(scale) = scale.get() else { return String::new() };
            let mut path = String::new();
            let width = (USUAL * scale.factor).clamp(SHAPE_MIN.0, SHAPE.0);
            let height = (STREAM_HEIGHT * scale.factor * 1.2).clamp(SHAPE_MIN.1, SHAPE.1);
            shapes.with(|shapes| {
                for (id, bounds) in shapes {
                    // A folded group is drawn as what flows through it.
                    let signals = desk.document.stream(id);
                    let own = signals.map_or(StreamKind::Ordinary, |at| at.record.with_untracked(|stream| stream.kind));
                    if own == kind {
                        let (x, y) = scale.to_map(Place { x: (bounds.left + bounds.right) / 2.0, y: bounds.top });
                        let _ = write!(path, "M{:.1} {y:.1}h{width:.1}v{height:.1}h-{width:.1}z", x - width / 2.0);
                    }
                }
            });
            path
        });
        view! { <path class=class d=move || path.get() /> }
    };
    let streams =
        [(StreamKind::Ordinary, "ordinary"), (StreamKind::Sensor, "sensor"), (StreamKind::Actuator, "actuator")];
    let frame = {
        let (stage, scale) = (stage.clone(), scale.clone());
        ArcMemo::new(move |_| {
            let (scale, view, size) = (scale.get()?, stage.view.get(), stage.size.get());
            let corner = |at| scale.to_map(view.to_canvas(at));
            let ((left, top), (right, bottom)) = (corner((0.0, 0.0)), corner(size));
            let clip = |at: f64, end: f64| at.clamp(1.0, end - 1.0);
            let ((left, right), (top, bottom)) =
                ((clip(left, SIZE.0), clip(right, SIZE.0)), (clip(top, SIZE.1), clip(bottom, SIZE.1)));
            Some(format!("M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z"))
        })
    };
    let look = {
        let (stage, scale) = (stage.clone(), scale.clone());
        move |event: &PointerEvent| {
            let map = event.current_target().and_then(|map| map.dyn_into::<Element>().ok());
            let (Some(scale), Some(map)) = (scale.get_untracked(), map) else { return };
            let own = map.get_bounding_client_rect();
            let at = (f64::from(event.client_x()) - own.left(), f64::from(event.client_y()) - own.top());
            let _ = map.set_pointer_capture(event.pointer_id());
            let (view, size) = (stage.view.get_untracked(), stage.size.get_untracked());
            let place = scale.to_canvas(at);
            let x = size.0 / 2.0 - place.x * view.zoom;
            let y = size.1 / 2.0 - place.y * view.zoom;
            stage.look_by_hand(View { x, y, ..view });
        }
    };
    let drag = look.clone();
    let keyed = stage.clone();
    let key = move |event: KeyboardEvent| {
        let size = keyed.size.get_untracked();
        let (dx, dy) = match event.pressed().as_str() {
            "ArrowLeft" => (PART, 0.0),
            "ArrowRight" => (-PART, 0.0),
            "ArrowUp" => (0.0, PART),
            "ArrowDown" => (0.0, -PART),
            _ => return,
        };
        event.prevent_default();
        event.stop_propagation();
        keyed.look_by_hand(keyed.view.get_untracked().panned(dx * size.0, dy * size.1));
    };
    view! {
        <div class="minimap" role="group" tabindex="0" aria-label=words::minimap()
            on:pointerdown=move |event| look(&event)
            on:pointermove=move |event| if event.buttons() != 0 { drag(&event) }
            on:keydown=key>
            <svg width=SIZE.0 height=SIZE.1 aria-hidden="true" focusable="false">
                {streams.map(|(stream, class)| kind(stream, class))}
                <path class="frame" d=move || frame.get() />
            </svg>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::{SIZE, Scale};
    use crate::graph::view::CanvasBounds;
    use behaviour::Place;

    #[test]
    fn all_of_the_graph_is_on_the_map_and_the_way_back_is_the_same() {
        let all = CanvasBounds { left: -4_000.0, top: 0.0, right: 1_000.0, bottom: 9_000.0 };
        let scale = Scale::of(all);
        for (x, y) in [(all.left, all.top), (all.right, all.bottom)] {
            let at = scale.to_map(Place { x, y });
            assert!(at.0 >= 0.0 && at.1 >= 0.0 && at.0 <= SIZE.0 && at.1 <= SIZE.1, "{at:?}");
            let back = scale.to_canvas(at);
            assert!((back.x - x).abs() < 1e-6 && (back.y - y).abs() < 1e-6);
        }
    }
}
