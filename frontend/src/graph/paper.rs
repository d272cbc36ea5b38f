//! The graph on paper: all of it, as large as one page allows, below its name and its sentences.

use super::Stage;
use super::view::{CanvasBounds, View};
use crate::desk::{Desk, use_desk};
use leptos::prelude::*;

/// The room of a page for the graph, upright and lying, in pixels: of A4 and of Letter the smaller one, without its
/// margins and without room for the name and a few sentences.
const TALL: (f64, f64) = (690.0, 800.0);
const WIDE: (f64, f64) = (950.0, 540.0);

/// The place of the graph on a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Paper {
    pub(super) view: View,
    size: (f64, f64),
    is_wide: bool,
}

impl Paper {
    /// All of `bounds` on the kind of page on which it is larger. What is small is not enlarged and takes only its room.
    fn of(bounds: CanvasBounds) -> Self {
        let [tall, wide] = [TALL, WIDE].map(|size| View::fitting(bounds, 0.0, size));
        let is_wide = wide.zoom > tall.zoom;
        let (size, view) = if is_wide { (WIDE, wide) } else { (TALL, tall) };
        let height = (bounds.bottom - bounds.top) * view.zoom + 2.0 * MARGIN;
        Self { view: View { y: MARGIN - bounds.top * view.zoom, ..view }, size: (size.0, height.min(size.1)), is_wide }
    }

    /// The kind of page, for the style sheet.
    pub(super) fn shape(&self) -> &'static str {
        if self.is_wide { "wide" } else { "tall" }
    }
}

/// Above and below the graph, in pixels.
const MARGIN: f64 = 12.0;

/// While the page is printed, how the graph lies on it.
pub(super) fn paper_memo(
    desk: &Desk,
    all: impl Fn() -> Option<CanvasBounds> + Send + Sync + 'static,
) -> ArcMemo<Option<Paper>> {
    let printing = desk.printing.clone();
    ArcMemo::new(move |_| printing.get().then(&all).flatten().map(Paper::of))
}

impl Stage {
    /// The size of the graph on paper, for the style; nothing on the screen.
    pub(super) fn paper_size(&self) -> (String, String) {
        let size = |at: f64| format!("{at:.0}px");
        self.paper.with(|paper| paper.map_or_else(Default::default, |paper| (size(paper.size.0), size(paper.size.1))))
    }

    /// True if things are drawn smaller than that; on paper details stay.
    pub(super) fn is_below(&self, zoom: f64) -> bool {
        self.view.with(|view| view.zoom < zoom) && self.paper.with(Option::is_none)
    }
}

/// On paper the name of the program stands above everything.
#[component]
pub(crate) fn PaperTitle() -> impl IntoView {
    let desk = use_desk();
    let (printing, name) = (desk.printing.clone(), desk.document.name.clone());
    move || printing.get().then(|| view! { <h1 class="paper-title">{name.get()}</h1> })
}

#[cfg(test)]
mod tests {
    use super::{Paper, TALL, WIDE};
    use crate::graph::view::CanvasBounds;
    use behaviour::Place;

    #[test]
    fn all_of_a_graph_lies_on_the_page_that_fits_it_better() {
        for (right, bottom, shape, size) in
            [(4_000.0, 900.0, "wide", WIDE), (600.0, 3_000.0, "tall", TALL), (300.0, 200.0, "tall", TALL)]
        {
            let paper = Paper::of(CanvasBounds { left: -100.0, top: -50.0, right, bottom });
            assert_eq!(paper.shape(), shape);
            let (left, top) = paper.view.to_stage(Place { x: -100.0, y: -50.0 });
            let (right, bottom) = paper.view.to_stage(Place { x: right, y: bottom });
            assert!(left >= 0.0 && top >= 0.0 && right <= size.0 && bottom <= paper.size.1, "{paper:?}");
            assert!(paper.size.1 <= size.1 && paper.view.zoom <= 1.0);
        }
    }
}
