//! A small picture of a graph: its streams by shape and colour, and which lead to which.

use behaviour::StreamKind;
use leptos::prelude::*;
use protocol::{GraphOutline, PictureStream};

/// A stream in the picture, in canvas units.
const WIDTH: f32 = 104.0;
const HEIGHT: f32 = 48.0;
/// Around the graph, and the smallest picture, so that few streams are not drawn large.
const MARGIN: f32 = 44.0;
const WIDTH_MIN: f32 = 640.0;
const HEIGHT_MIN: f32 = 380.0;

/// The picture.
#[component]
pub(super) fn Sketch(picture: GraphOutline) -> impl IntoView {
    let line = |[from, to]: &[u16; 2]| {
        let ends = (picture.streams.get(usize::from(*from))?, picture.streams.get(usize::from(*to))?);
        Some(view! { <path d=curve(ends.0, ends.1) /> })
    };
    let lines: Vec<_> = picture.lines.iter().filter_map(line).collect();
    let streams: Vec<_> = picture.streams.iter().take(GraphOutline::STREAMS_MAX).map(shape).collect();
    view! {
        <svg class="picture" viewBox=view_box(&picture.streams) aria-hidden="true" focusable="false">{lines}{streams}</svg>
    }
}

fn shape(stream: &PictureStream) -> impl IntoView + use<> {
    let (class, round) = match stream.kind {
        StreamKind::Sensor => ("s", 8.0),
        StreamKind::Ordinary => ("o", HEIGHT / 2.0),
        StreamKind::Actuator => ("a", 8.0),
    };
    view! { <rect class=class x=stream.x - WIDTH / 2.0 y=stream.y width=WIDTH height=HEIGHT rx=round /> }
}

/// From the lower edge of a stream to the upper edge of another.
fn curve(from: &PictureStream, to: &PictureStream) -> String {
    let (x, y) = (from.x, from.y + HEIGHT);
    let half = (y + to.y) / 2.0;
    format!("M{x:.0} {y:.0}C{x:.0} {half:.0} {:.0} {half:.0} {:.0} {:.0}", to.x, to.x, to.y)
}

/// All of the graph in the middle.
fn view_box(streams: &[PictureStream]) -> String {
    let spread = |places: &mut dyn Iterator<Item = f32>, length: f32, least: f32| {
        let (low, high) = places.fold((f32::MAX, f32::MIN), |(low, high), at| (low.min(at), high.max(at)));
        let (low, high) = if low > high { (0.0, 0.0) } else { (low, high + length) };
        let size = (high - low + 2.0 * MARGIN).max(least);
        ((low + high - size) / 2.0, size)
    };
    let (x, width) = spread(&mut streams.iter().map(|stream| stream.x - WIDTH / 2.0), WIDTH, WIDTH_MIN);
    let (y, height) = spread(&mut streams.iter().map(|stream| stream.y), HEIGHT, HEIGHT_MIN);
    format!("{x:.0} {y:.0} {width:.0} {height:.0}")
}

#[cfg(test)]
mod tests {
    use super::view_box;
    use behaviour::StreamKind;
    use protocol::PictureStream;

    #[test]
    fn the_graph_is_in_the_middle() {
        let stream = |x, y| PictureStream { x, y, kind: StreamKind::Ordinary };
        assert_eq!(view_box(&[]), "-320 -190 640 380");
        assert_eq!(view_box(&[stream(100.0, 0.0)]), "-220 -166 640 380");
        assert_eq!(view_box(&[stream(0.0, 0.0), stream(900.0, 800.0)]), "-96 -44 1092 936");
    }
}
