//! What the parts of the canvas share: the view, what is drawn, who selected what.

use super::chip::chip_of;
use super::cull::{Cells, drawn};
use super::room::{self, Side};
use super::view::{Bounds, View};
use crate::browser;
use crate::desk::{Desk, Editor, Selected};
use crate::layout::{CHIP_HEIGHT, LEVEL, STREAM_HEIGHT, VALUE_ROOM, chip_width, chip_words, stream_width};
use behaviour::{Id, Place};
use leptos::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use wasm_bindgen::{JsCast, closure::Closure};
use web_sys::{Element, FocusEvent, FocusOptions, HtmlElement, ResizeObserver};

/// After so long without a move a gesture rests, in milliseconds.
const REST_MS: i32 = 220;
/// Room left around what is brought into view, in pixels.
const REVEAL_MARGIN: f64 = 16.0;
/// The strip under a stream, in pixels.
const STRIP: f64 = 66.0;
/// How long the view glides, in milliseconds, and a little more.
const GLIDE_MS: i32 = 200;

/// The stage. A clone is the same stage.
#[derive(Clone)]
pub(crate) struct Stage {
    pub(super) view: ArcRwSignal<View>,
    /// Width and height in pixels.
    pub(super) size: ArcRwSignal<(f64, f64)>,
    /// The stream that the keyboard comes to.
    pub(super) stop: ArcRwSignal<Option<Id>>,
    /// The stream that follows the hand.
    pub(super) dragged: ArcRwSignal<Option<Id>>,
    pub(super) running: ArcMemo<bool>,
    /// Who else selected what: what, their colour, their name.
    pub(super) others: ArcMemo<Vec<(Id, u8, String)>>,
    /// What somebody else is editing, and where that leads to.
    pub(super) edited: ArcMemo<BTreeMap<Id, Edited>>,
    /// The view moves by itself and slowly.
    pub(super) glides: ArcRwSignal<bool>,
    /// What the strip keeps clear of: streams, in canvas units.
    pub(super) shapes: ArcMemo<Vec<(Id, Bounds)>>,
    /// How wide the live value of a stream may be; nothing while there are no values.
    rooms: ArcMemo<BTreeMap<Id, f64>>,
    rests: ArcRwSignal<bool>,
    drawn: ArcMemo<Drawn>,
    moves: Arc<AtomicU32>,
    desk: Desk,
}

/// What is in the page now.
#[derive(Clone, Debug, Default, PartialEq)]
struct Drawn {
    streams: Vec<Id>,
    connectors: Vec<Id>,
}

impl Stage {
    pub(super) fn new(desk: &Desk) -> Self {
        let (view, size) = (ArcRwSignal::new(View::default()), ArcRwSignal::new((1_200.0, 800.0)));
        let rests = ArcRwSignal::new(true);
        let running = {
            let desk = desk.clone();
            ArcMemo::new(move |_| desk.robots.running().is_some())
        };
        let dragged = ArcRwSignal::default();
        let shapes = shapes_memo(desk.clone(), dragged.clone());
        Self {
            drawn: drawn_memo(desk.clone(), view.clone(), size.clone(), rests.clone()),
            rooms: rooms_memo(desk.clone(), shapes.clone()),
            glides: ArcRwSignal::new(false),
            shapes,
            others: others_memo(desk.clone()),
            edited: edited_memo(desk.clone()),
            stop: ArcRwSignal::default(),
            dragged,
            moves: Arc::default(),
            desk: desk.clone(),
            view,
            size,
            rests,
            running,
        }
    }

    pub(super) fn streams(&self) -> Vec<Id> {
        self.drawn.with(|drawn| drawn.streams.clone())
    }

    pub(super) fn connectors(&self) -> Vec<Id> {
        self.drawn.with(|drawn| drawn.connectors.clone())
    }

    pub(super) fn transform(&self) -> String {
        self.view.with(|view| format!("translate({:.2}px,{:.2}px) scale({:.4})", view.x, view.y, view.zoom))
    }

    /// Shows another part of the canvas as the hand wants it, at once, but never none of the graph.
    pub(super) fn look_by_hand(&self, view: View) {
        let size = self.size.get_untracked();
        let kept = self.shapes.with_untracked(|shapes| view.keeping(shapes.iter().map(|(_, bounds)| bounds), size));
        self.look(kept);
    }

    /// Shows another part of the canvas at once, also in the middle of a glide.
    fn look(&self, view: View) {
        if self.glides.get_untracked() {
            self.glides.set(false);
        }
        self.show(view);
    }

    fn show(&self, view: View) {
        if self.view.get_untracked() == view {
            return;
        }
        if self.rests.get_untracked() {
            self.rests.set(false);
        }
        self.view.set(view);
        let mine = self.moves.fetch_add(1, Ordering::Relaxed) + 1;
        let stage = self.clone();
        browser::after(REST_MS, move || {
            if stage.moves.load(Ordering::Relaxed) == mine {
                stage.rests.set(true);
            }
        });
    }

    /// Shows another part of the canvas, and moves there slowly.
    pub(super) fn glide(&self, view: View) {
        if self.view.get_untracked() == view {
            return;
        }
        self.glides.set(true);
        self.show(view);
        let mine = self.moves.load(Ordering::Relaxed);
        let stage = self.clone();
        browser::after(GLIDE_MS, move || {
            if stage.moves.load(Ordering::Relaxed) == mine {
                stage.glides.set(false);
            }
        });
    }

    /// Shows everything.
    pub(crate) fn fit(&self) {
        self.glide(self.whole());
    }

    fn whole(&self) -> View {
        let size = self.size.get_untracked();
        self.everything().map_or_else(|| View::home(size), |(_, all)| View::fitting(all, VALUE_ROOM, size))
    }

    fn opening(&self) -> View {
        let size = self.size.get_untracked();
        let opening = |(first, all)| View::opening(all, first, VALUE_ROOM, size);
        self.everything().map_or_else(|| View::home(size), opening)
    }

    /// The first stream, and what surrounds all of them with their values and the chips.
    fn everything(&self) -> Option<(Bounds, Bounds)> {
        let desk = &self.desk;
        let (streams, chips) = (desk.document.stream_ids.get_untracked(), desk.document.connector_ids.get_untracked());
        let first = streams.first().and_then(|id| bounds(desk, id))?;
        let values = |bounds: Bounds| Bounds { right: bounds.right + VALUE_ROOM, ..bounds };
        let streams = streams.iter().filter_map(|id| bounds(desk, id)).map(values);
        let all = Bounds::around(streams.chain(chips.iter().filter_map(|id| chip_bounds(desk, id))))?;
        Some((first, all))
    }

    /// Zooms around the middle.
    pub(super) fn zoom_by(&self, factor: f64) {
        let size = self.size.get_untracked();
        let view = self.view.get_untracked().zoomed((size.0 / 2.0, size.1 / 2.0), factor);
        self.glide(self.shapes.with_untracked(|shapes| view.keeping(shapes.iter().map(|(_, bounds)| bounds), size)));
    }

    /// Pans just so far that a stream with the chips that lead to it, its value and the strip under it are seen.
    pub(super) fn reveal(&self, id: &Id) {
        let Some(own) = bounds(&self.desk, id) else { return };
        let view = self.view.get_untracked();
        let room = Bounds { right: own.right + VALUE_ROOM, bottom: own.bottom + STRIP / view.zoom, ..own };
        let into = self.chips_at(id, true);
        let all = Bounds::around(into.into_iter().chain([room])).unwrap_or(room);
        let size = self.size.get_untracked();
        let fits = |bounds: &Bounds| {
            let (width, height) = ((bounds.right - bounds.left) * view.zoom, (bounds.bottom - bounds.top) * view.zoom);
            width <= size.0 - 2.0 * REVEAL_MARGIN && height <= size.1 - 2.0 * REVEAL_MARGIN
        };
        let shown = if fits(&all) { all } else { Bounds { bottom: room.bottom, ..own } };
        self.glide(view.revealing(shown, size, REVEAL_MARGIN));
    }

    /// Where the chips are that lead to a stream or, unless `into`, that touch it at all.
    pub(super) fn chips_at(&self, id: &Id, into: bool) -> Vec<Bounds> {
        let desk = &self.desk;
        let touches = |chip: &Id| {
            desk.document.connector(chip).is_some_and(|signals| {
                signals
                    .record
                    .with_untracked(|connector| connector.output == *id || (!into && connector.inputs.contains(id)))
            })
        };
        let chips = desk.document.connector_ids.get_untracked();
        chips.iter().filter(|chip| touches(chip)).filter_map(|chip| chip_bounds(desk, chip)).collect()
    }

    /// How wide the live value of a stream may be.
    pub(super) fn room(&self, id: &Id) -> ArcMemo<f64> {
        let (rooms, id) = (self.rooms.clone(), id.clone());
        ArcMemo::new(move |_| rooms.with(|rooms| rooms.get(&id).copied().unwrap_or(VALUE_ROOM)))
    }

    /// Where a chip can say something without covering anything, and how wide that may be.
    pub(super) fn side_of_chip(&self, id: &Id) -> ArcMemo<Option<(Side, f64)>> {
        let (desk, shapes, id) = (self.desk.clone(), self.shapes.clone(), id.clone());
        ArcMemo::new(move |_| {
            desk.document.revision.track();
            let chip = chip_bounds(&desk, &id)?;
            let chips = desk.document.connector_ids.get().into_iter().filter(|other| *other != id);
            let mut others: Vec<Bounds> = chips.filter_map(|other| chip_bounds(&desk, &other)).collect();
            shapes.with(|shapes| others.extend(shapes.iter().map(|(_, bounds)| *bounds)));
            room::beside_chip(&chip, &others)
        })
    }

    /// Gives a stream the keyboard, once it is in the page.
    pub(super) fn focus(&self, id: &Id) {
        self.stop.set(Some(id.clone()));
        self.reveal(id);
        let id = id.clone();
        browser::after(30, move || {
            let node = document().query_selector(&format!("[data-node='{id}']")).ok().flatten();
            if let Some(node) = node.and_then(|node| node.dyn_into::<HtmlElement>().ok()) {
                let how = FocusOptions::new();
                how.set_prevent_scroll(true);
                let _ = node.focus_with_options(&how);
            }
        });
    }

    /// A stream that got the keyboard by Tab comes into view.
    pub(super) fn focused_on(&self, event: &FocusEvent) {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let id = target.and_then(|target| target.get_attribute("data-node")).and_then(|id| Id::new(&id).ok());
        if let Some(id) = id {
            self.desk.document.unfollow();
            self.stop.set(Some(id.clone()));
            self.reveal(&id);
        }
    }

    pub(super) fn follow_size(&self, root: NodeRef<leptos::html::Main>) {
        let stage = self.clone();
        Effect::new(move |_| {
            let Some(root) = root.get() else { return };
            let (measured, stage) = (root.clone(), stage.clone());
            let measure =
                move || stage.measured((f64::from(measured.client_width()), f64::from(measured.client_height())));
            measure();
            let seen = Closure::<dyn FnMut()>::new(measure).into_js_value();
            if let Ok(observer) = ResizeObserver::new(seen.unchecked_ref()) {
                observer.observe(&root);
            }
        });
    }

    fn measured(&self, size: (f64, f64)) {
        if size.0 > 0.0 && size.1 > 0.0 && self.size.get_untracked() != size {
            self.size.set(size);
        }
    }

    /// What is opened is shown whole if it can be read then; so is what was empty or became empty.
    pub(super) fn follow_open(&self, desk: &Desk) {
        let (stage, desk) = (self.clone(), desk.clone());
        let ids = desk.document.stream_ids.clone();
        let empty = ArcMemo::new(move |_| ids.with(Vec::is_empty));
        Effect::new(move |before: Option<Option<Id>>| {
            let (open, _) = (desk.document.open.get(), empty.get());
            if open.is_some() {
                if before.is_some_and(|before| before != open) {
                    stage.stop.set(None);
                }
                let stage = stage.clone();
                let _ = request_animation_frame(move || stage.look(stage.opening()));
            }
            open
        });
    }

    /// What is selected comes into view; the others are told; a lost keyboard comes along.
    pub(super) fn follow_selection(&self, desk: &Desk) {
        let (stage, desk) = (self.clone(), desk.clone());
        Effect::new(move |_| {
            let selected = desk.document.selected.get();
            desk.document.present_selection();
            if selected.is_some() {
                desk.document.unfollow();
            }
            let Some(Selected::Stream(id)) = selected else { return };
            stage.stop.set(Some(id.clone()));
            let (stage, desk) = (stage.clone(), desk.clone());
            browser::after(40, move || stage.arrive(&desk, &id));
        });
    }

    fn arrive(&self, desk: &Desk, id: &Id) {
        let still = desk.document.selected.with_untracked(|selected| selected.as_ref().map(Selected::id) == Some(id));
        if !still || self.dragged.with_untracked(Option::is_some) {
            return;
        }
        self.reveal(id);
        let lost =
            document().active_element().is_none_or(|active| active.tag_name() == "BODY" || active.id() == "stage");
        if lost && desk.dialog.with_untracked(Option::is_none) {
            self.focus(id);
        }
    }
}

/// Where a stream is, without its live value.
fn bounds(desk: &Desk, id: &Id) -> Option<Bounds> {
    let signals = desk.document.stream(id)?;
    let width = signals.record.with_untracked(stream_width);
    Some(around(signals.place.get_untracked(), width))
}

fn around(place: Place, width: f64) -> Bounds {
    Bounds { left: place.x - width / 2.0, top: place.y, right: place.x + width / 2.0, bottom: place.y + STREAM_HEIGHT }
}

fn drawn_memo(
    desk: Desk,
    view: ArcRwSignal<View>,
    size: ArcRwSignal<(f64, f64)>,
    rests: ArcRwSignal<bool>,
) -> ArcMemo<Drawn> {
    let cells = ArcMemo::new(move |_| Cells::in_view(view.get(), size.get()));
    ArcMemo::new(move |before: Option<&Drawn>| {
        desk.document.revision.track();
        let (cells, rests) = (cells.get(), rests.get());
        let none = Drawn::default();
        let before = before.unwrap_or(&none);
        let stream_seen = |id: &Id| bounds(&desk, id).is_some_and(|bounds| cells.touch(&bounds));
        let connector_seen = |id: &Id| connector_bounds(&desk, id).is_some_and(|bounds| cells.touch(&bounds));
        Drawn {
            streams: drawn(&desk.document.stream_ids.get(), stream_seen, &before.streams, rests),
            connectors: drawn(&desk.document.connector_ids.get(), connector_seen, &before.connectors, rests),
        }
    })
}

/// Where streams stand, as of the last drop; nothing moves along with the hand.
fn shapes_memo(desk: Desk, dragged: ArcRwSignal<Option<Id>>) -> ArcMemo<Vec<(Id, Bounds)>> {
    ArcMemo::new(move |before: Option<&Vec<(Id, Bounds)>>| {
        desk.document.revision.track();
        if let (Some(before), true) = (before, dragged.with(Option::is_some)) {
            return before.clone();
        }
        let ids = desk.document.stream_ids.get();
        ids.iter().filter_map(|id| Some((id.clone(), bounds(&desk, id)?))).collect()
    })
}

fn rooms_memo(desk: Desk, shapes: ArcMemo<Vec<(Id, Bounds)>>) -> ArcMemo<BTreeMap<Id, f64>> {
    ArcMemo::new(move |_| {
        if !desk.robots.has_values.get() {
            return BTreeMap::new();
        }
        let connectors = desk.document.connector_ids.get();
        let chips: Vec<Bounds> = connectors.iter().filter_map(|id| chip_bounds(&desk, id)).collect();
        shapes.with(|shapes| room::rooms(shapes, &chips))
    })
}

fn chip_bounds(desk: &Desk, id: &Id) -> Option<Bounds> {
    let record = desk.document.connector(id)?.record.get_untracked();
    let chip = untrack(|| chip_of(desk, &record))?;
    Some(Bounds { bottom: chip.y + CHIP_HEIGHT, ..around(chip, chip_width(&chip_words(&record))) })
}

fn connector_bounds(desk: &Desk, id: &Id) -> Option<Bounds> {
    let ends = desk.document.connector(id)?.record.with_untracked(|connector| {
        let mut ends = connector.inputs.clone();
        ends.push(connector.output.clone());
        ends
    });
    let places = ends.iter().filter_map(|end| Some(desk.document.stream(end)?.place.get_untracked()));
    Bounds::around(places.map(|place| around(place, LEVEL)))
}

/// Somebody else is editing something.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Edited {
    pub(super) editor: Editor,
    /// True for what is edited, false for the stream that it leads to.
    pub(super) is_it: bool,
}

fn edited_memo(desk: Desk) -> ArcMemo<BTreeMap<Id, Edited>> {
    ArcMemo::new(move |_| {
        let mut edited = BTreeMap::new();
        for (record, editor) in desk.document.edited_by_others() {
            let output = desk.document.connector(&record.id).map(|signals| signals.record.with(|at| at.output.clone()));
            if let Some(output) = output {
                edited.entry(output).or_insert_with(|| Edited { editor: editor.clone(), is_it: false });
            }
            edited.insert(record.id, Edited { editor, is_it: true });
        }
        edited
    })
}

fn others_memo(desk: Desk) -> ArcMemo<Vec<(Id, u8, String)>> {
    ArcMemo::new(move |_| {
        let others = desk.document.others().into_iter();
        others.filter_map(|(sign, person)| Some((person.selected?, sign.color, sign.name))).collect()
    })
}
