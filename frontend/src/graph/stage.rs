//! The state that the parts of the canvas share: the view, what is drawn, who selected what.

use super::TINY;
use super::bounds::{aside_bounds, bounds, box_bounds, chip_bounds, connector_bounds};
use super::context::ContextMenu;
use super::cull::{Cells, drawn};
use super::far::{chips_memo, moving_memo};
use super::fit;
use super::noting::NoteWriting;
use super::offer::Offering;
use super::paper::{Paper, paper_memo};
use super::room::{self, ChipSide};
use super::strip_spot::StageArea;
use super::view::{CanvasBounds, View};
use super::wire::{Wire, WireTargets, targets_memo};
use crate::browser;
use crate::desk::{Desk, Gap, OtherEditor, Selected, settled};
use crate::focus::{self, FocusPlace};
use crate::later::{SecondPiece, second_piece};
use crate::layout::VALUE_ROOM;
use behaviour::{Connector, Id, Place, Problem, ProblemKind, StreamKind};
use leptos::prelude::*;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use wasm_bindgen::JsCast;
use web_sys::{Element, FocusEvent};

/// After so long without a move a gesture rests, in milliseconds.
const REST_MS: i32 = 220;
/// Room left around what is brought into view, in pixels.
const REVEAL_MARGIN: f64 = 16.0;
/// The strip under a stream, in pixels.
const STRIP: f64 = 66.0;
/// A moment for what was opened to be in the page, and for a dialog to go, in milliseconds.
const OPENED_MS: i32 = 80;
/// The time that the view glides, in milliseconds, and a little more.
const GLIDE_MS: i32 = 200;

/// The elements where the keyboard stays when a program has been opened.
const ELSEWHERE: &str = "input, textarea, select, [role=menu], .sense-card, .tour, [data-node], [data-chip], .strip, \
    .flyout, .offer, .told, .right";

/// The stage. A clone is the same stage.
#[derive(Clone)]
pub(crate) struct Stage {
    pub(super) view: ArcRwSignal<View>,
    /// Width and height in pixels.
    pub(super) size: ArcRwSignal<(f64, f64)>,
    /// The stream that the keyboard was at, and the one that it comes to.
    pub(super) stop: ArcRwSignal<Option<Id>>,
    pub(super) stop_now: ArcMemo<Option<Id>>,
    /// The stream that follows the hand.
    pub(super) dragged: ArcRwSignal<Option<Id>>,
    /// All that follows the hand with it.
    pub(super) moving: ArcMemo<BTreeSet<Id>>,
    /// The open group that it would be in if it were dropped now.
    pub(super) joining: ArcRwSignal<Option<Id>>,
    pub(super) running: ArcMemo<bool>,
    /// True if what leads nowhere may be blamed: it runs, or nothing else is missing.
    pub(super) finished: ArcMemo<bool>,
    /// The selections of others: the thing, their colour, their name.
    pub(super) others: ArcRwSignal<Vec<(Id, u8, String)>>,
    /// The things that somebody else is editing, and where they lead to.
    pub(super) edited: ArcRwSignal<HashMap<Id, Edited>>,
    /// The view moves by itself and slowly.
    pub(super) glides: ArcRwSignal<bool>,
    /// The shapes that the strip keeps clear of: streams, in canvas units.
    pub(super) shapes: ArcMemo<Vec<(Id, CanvasBounds)>>,
    /// The wire that is being drawn.
    pub(super) wire: ArcRwSignal<Option<Wire>>,
    /// The part of it, or of what is carried, that streams and chips look at.
    pub(super) targets: ArcMemo<Option<WireTargets>>,
    /// The steps that are offered where a wire was dropped, or on an edge.
    pub(super) offering: ArcRwSignal<Option<Offering>>,
    /// The thing whose badge was pressed: its problem is told.
    pub(super) asked_about: ArcRwSignal<Option<Id>>,
    /// The menu that is open.
    pub(super) context: ArcRwSignal<Option<ContextMenu>>,
    /// The stream and the edge that a pointer is over.
    pub(super) hovered: ArcRwSignal<Option<Id>>,
    pub(super) hovered_edge: ArcRwSignal<Option<Gap>>,
    /// The stream that the keyboard is on, or of which it is on an edge.
    pub(super) focused: ArcRwSignal<Option<Id>>,
    /// The stream or group whose new name is typed.
    pub(super) renaming: ArcRwSignal<Option<Id>>,
    /// The note that is written.
    pub(super) noting: ArcRwSignal<Option<NoteWriting>>,
    /// The note or group to which the keyboard comes.
    pub(super) aside: ArcRwSignal<Option<Id>>,
    /// The thing that gets the keyboard as soon as it is drawn.
    pub(super) wanted: ArcRwSignal<Option<Id>>,
    /// The lasso that is drawn, in canvas units.
    pub(super) lasso: ArcRwSignal<Option<CanvasBounds>>,
    /// The place of the pointer over the canvas.
    pub(super) pointer: ArcRwSignal<Option<Place>>,
    /// The height of the sentences at the top, once that is known, in pixels.
    pub(super) above: ArcRwSignal<Option<f64>>,
    /// The area of the strip of what is selected, while it is there.
    pub(super) strip: ArcRwSignal<Option<StageArea>>,
    /// The view that was shown when the program was opened.
    pub(super) opened: ArcRwSignal<Option<View>>,
    /// The words about a wire that screen readers hear.
    pub(super) said: ArcRwSignal<String>,
    /// The place of the graph on paper, while it is printed.
    pub(super) paper: ArcMemo<Option<Paper>>,
    /// The width that the live value of each stream may have; nothing while there are no values.
    rooms: ArcMemo<HashMap<Id, f64>>,
    /// The cells of the canvas that are in view, and whether the view rests.
    pub(super) cells: ArcMemo<Cells>,
    pub(super) rests: ArcRwSignal<bool>,
    /// True if everything is so small that nothing can be read.
    pub(super) is_tiny: ArcRwSignal<bool>,
    drawn: ArcMemo<DrawnNow>,
    chips: ArcMemo<Vec<Id>>,
    moves: Arc<AtomicU32>,
    pub(super) piece: SecondPiece,
    pub(super) desk: Desk,
}

/// The things that are in the page now.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct DrawnNow {
    streams: Vec<Id>,
    connectors: Vec<Id>,
    /// The connectors of which the chip is seen: it is in a folded group with the stream that it leads to.
    pub(super) chips: Vec<Id>,
}

impl Stage {
    pub(super) fn new(desk: &Desk) -> Self {
        let (view, size) = (ArcRwSignal::new(View::default()), ArcRwSignal::new((1_200.0, 800.0)));
        let rests = ArcRwSignal::new(true);
        let running = {
            let desk = desk.clone();
            ArcMemo::new(move |_| desk.is_then() || desk.robots.running().is_some())
        };
        let finished = finished_memo(desk, running.clone());
        let (dragged, stop) = (ArcRwSignal::default(), ArcRwSignal::default());
        let wire: ArcRwSignal<Option<Wire>> = ArcRwSignal::default();
        let shapes = shapes_memo(desk.clone(), dragged.clone());
        let cells = {
            let (view, size) = (view.clone(), size.clone());
            ArcMemo::new(move |_| Cells::in_view(view.get(), size.get()))
        };
        let drawn = drawn_memo(desk.clone(), cells.clone(), rests.clone());
        let (others, edited) = (others_signal(desk.clone()), edited_signal(desk.clone()));
        let is_tiny = {
            let (desk, view) = (desk.clone(), view.clone());
            settled(move || view.with(|view| view.zoom < TINY) && !desk.printing.get())
        };
        Self {
            paper: paper_memo(desk, {
                let desk = desk.clone();
                move || everything(&desk).map(|everything| everything.all)
            }),
            chips: chips_memo(desk.clone(), drawn.clone(), is_tiny.clone(), (others.clone(), edited.clone())),
            moving: moving_memo(desk.clone(), dragged.clone()),
            drawn,
            is_tiny,
            cells,
            noting: ArcRwSignal::default(),
            aside: ArcRwSignal::default(),
            wanted: ArcRwSignal::default(),
            rooms: rooms_memo(desk.clone(), shapes.clone()),
            glides: ArcRwSignal::new(false),
            shapes,
            others,
            edited,
            stop_now: stop_memo(desk.clone(), stop.clone()),
            stop,
            targets: targets_memo(wire.clone(), desk.carried.clone()),
            wire,
            offering: ArcRwSignal::default(),
            context: ArcRwSignal::default(),
            asked_about: ArcRwSignal::default(),
            hovered: ArcRwSignal::default(),
            hovered_edge: ArcRwSignal::default(),
            focused: ArcRwSignal::default(),
            renaming: ArcRwSignal::default(),
            lasso: ArcRwSignal::default(),
            pointer: ArcRwSignal::default(),
            above: ArcRwSignal::default(),
            strip: ArcRwSignal::default(),
            opened: ArcRwSignal::default(),
            said: ArcRwSignal::default(),
            dragged,
            joining: ArcRwSignal::default(),
            moves: Arc::default(),
            piece: second_piece(),
            desk: desk.clone(),
            view,
            size,
            rests,
            finished,
            running,
        }
    }

    /// Puts a pasted text in if it is a part of a program, at the latest once the second piece is here; whether it was
    /// at once.
    pub(super) fn paste(&self, desk: &Desk, text: String) -> bool {
        if let Some(rest) = self.piece.now() {
            return (rest.paste)(desk, Some(self), &text);
        }
        let (desk, stage) = (desk.clone(), self.clone());
        self.piece.when_here(move |rest| {
            if let Some(rest) = rest {
                (rest.paste)(&desk, Some(&stage), &text);
            }
        });
        false
    }

    pub(super) fn streams(&self) -> Vec<Id> {
        self.drawn.with(|drawn| drawn.streams.clone())
    }

    pub(super) fn connectors(&self) -> Vec<Id> {
        self.drawn.with(|drawn| drawn.connectors.clone())
    }

    pub(super) fn chips(&self) -> Vec<Id> {
        self.chips.get()
    }

    pub(super) fn transform(&self) -> String {
        let view = self.paper.with(|paper| paper.map(|paper| paper.view)).unwrap_or_else(|| self.view.get());
        format!("translate({:.2}px,{:.2}px) scale({:.4})", view.x, view.y, view.zoom)
    }

    /// Shows another part of the canvas as the hand wants it, at once, but never none of the graph.
    pub(super) fn look_by_hand(&self, view: View) {
        let size = self.size.get_untracked();
        let kept = self.shapes.with_untracked(|shapes| view.keeping(shapes.iter().map(|(_, bounds)| bounds), size));
        self.look(kept);
    }

    /// Shows another part of the canvas at once, also in the middle of a glide.
    pub(super) fn look(&self, view: View) {
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
        let everything = everything(&self.desk);
        self.in_free(|size| everything.map_or_else(|| View::home(size), |everything| everything.whole(size)))
    }

    pub(super) fn opening(&self) -> View {
        let everything = everything(&self.desk);
        self.in_free(|size| {
            everything.map_or_else(
                || View::home(size),
                |everything| View::opening(everything.whole(size), everything.all, everything.first, size),
            )
        })
    }

    /// Zooms around the middle.
    pub(super) fn zoom_by(&self, factor: f64) {
        let size = self.size.get_untracked();
        let view = self.view.get_untracked().zoomed((size.0 / 2.0, size.1 / 2.0), factor);
        self.glide(self.shapes.with_untracked(|shapes| view.keeping(shapes.iter().map(|(_, bounds)| bounds), size)));
    }

    /// Pans just so far that a stream with the chips that lead to it, its value and the strip under it are seen.
    pub(crate) fn reveal(&self, id: &Id) {
        let Some(own) = bounds(&self.desk, id) else { return };
        if self.desk.document.stream(id).is_none() {
            return self.glide(self.revealing(own, REVEAL_MARGIN));
        }
        let view = self.view.get_untracked();
        let room = CanvasBounds { right: own.right + VALUE_ROOM, bottom: own.bottom + STRIP / view.zoom, ..own };
        let into = self.chips_at(id, true);
        let all = CanvasBounds::around(into.into_iter().chain([room])).unwrap_or(room);
        let size = (self.size.get_untracked().0, self.size.get_untracked().1 - self.above());
        let fits = |bounds: &CanvasBounds| {
            let (width, height) = ((bounds.right - bounds.left) * view.zoom, (bounds.bottom - bounds.top) * view.zoom);
            width <= size.0 - 2.0 * REVEAL_MARGIN && height <= size.1 - 2.0 * REVEAL_MARGIN
        };
        let shown = if fits(&all) { all } else { CanvasBounds { bottom: room.bottom, ..own } };
        self.glide(self.revealing(shown, REVEAL_MARGIN));
    }

    /// Returns the bounds of a chip.
    pub(super) fn chip_bounds(&self, id: &Id) -> Option<CanvasBounds> {
        chip_bounds(&self.desk, id)
    }

    /// Pans just so far that a chip is seen.
    pub(crate) fn reveal_chip(&self, id: &Id) {
        if let Some(own) = chip_bounds(&self.desk, id) {
            self.glide(self.revealing(own, REVEAL_MARGIN));
        }
    }

    /// Returns the bounds of the chips that lead to a stream or, unless `into`, that touch it at all.
    pub(super) fn chips_at(&self, id: &Id, into: bool) -> Vec<CanvasBounds> {
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

    /// Returns the width that the live value of a stream may have.
    pub(super) fn room(&self, id: &Id) -> ArcMemo<f64> {
        let (rooms, id) = (self.rooms.clone(), id.clone());
        ArcMemo::new(move |_| rooms.with(|rooms| rooms.get(&id).copied().unwrap_or(VALUE_ROOM)))
    }

    /// Returns the side on which a chip can say something without covering anything, and how wide that may be.
    pub(super) fn side_of_chip(&self, id: &Id) -> ArcMemo<Option<(ChipSide, f64)>> {
        let (desk, shapes, id) = (self.desk.clone(), self.shapes.clone(), id.clone());
        ArcMemo::new(move |_| {
            desk.document.revision.track();
            let chip = chip_bounds(&desk, &id)?;
            let chips = desk.document.connector_ids.get().into_iter().filter(|other| *other != id);
            let mut others: Vec<CanvasBounds> = chips.filter_map(|other| chip_bounds(&desk, &other)).collect();
            shapes.with(|shapes| others.extend(shapes.iter().map(|(_, bounds)| *bounds)));
            room::beside_chip(&chip, &others)
        })
    }

    /// Gives a stream, note or group the keyboard, once it is in the page.
    pub(super) fn focus(&self, id: &Id) {
        self.focus_if(id, || true);
    }

    /// Like `focus`, if `free` still says so at that moment.
    fn focus_if(&self, id: &Id, free: impl Fn() -> bool + 'static) {
        self.came_to(id);
        self.reveal(id);
        focus::when_there(FocusPlace::Shape(id.clone()), free, focus::focus_in_place);
    }

    /// A stream that got the keyboard by Tab comes into view.
    pub(super) fn focused_on(&self, event: &FocusEvent) {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let on_edge = target.as_ref().is_some_and(|target| target.closest(".plus").ok().flatten().is_some());
        let mark = |mark: &str| target.as_ref()?.get_attribute(mark).and_then(|id| Id::new(&id).ok());
        let id = mark("data-node").or_else(|| mark("data-note")).or_else(|| mark("data-group"));
        let node = mark("data-node");
        self.desk.document.keyboard_at(target.as_ref().and_then(selected_at));
        if !on_edge && self.focused.with_untracked(|now| *now != node) {
            self.focused.set(node);
        }
        if let Some(id) = id {
            self.wanted.set(None);
            self.desk.document.unfollow();
            self.came_to(&id);
            self.reveal(&id);
        }
    }

    /// Tab comes back to this one.
    fn came_to(&self, id: &Id) {
        let stop = if self.desk.document.stream(id).is_some() { &self.stop } else { &self.aside };
        stop.set(Some(id.clone()));
    }

    /// The keyboard goes elsewhere in the page.
    pub(super) fn focus_left(&self, event: &FocusEvent) {
        let next = event.related_target().and_then(|next| next.dyn_into::<Element>().ok());
        let stays = next.as_ref().is_some_and(|next| next.closest("#stage").ok().flatten().is_some());
        if next.is_some() && !stays {
            self.desk.document.keyboard_at(None);
            self.wanted.set(None);
        }
        if !stays && self.focused.with_untracked(Option::is_some) {
            self.focused.set(None);
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
            browser::watch_size(&root, measure);
        });
    }

    fn measured(&self, size: (f64, f64)) {
        if size.0 > 0.0 && size.1 > 0.0 && self.size.get_untracked() != size {
            self.size.set(size);
            self.desk.document.tell_stage(View::free(size));
        }
    }

    /// Shows whole what is opened, if it can be read then; so it does with what was empty or became empty.
    pub(super) fn follow_open(&self, desk: &Desk) {
        let (stage, desk) = (self.clone(), desk.clone());
        let ids = desk.document.stream_ids.clone();
        let empty = ArcMemo::new(move |_| ids.with(Vec::is_empty));
        Effect::new(move |before: Option<Option<Id>>| {
            desk.document.laid_out.track();
            let (open, _) = (desk.document.open.get(), empty.get());
            if open.is_some() || desk.is_then() {
                if before.is_some_and(|before| before != open) {
                    stage.stop.set(None);
                }
                let (stage, desk) = (stage.clone(), desk.clone());
                let _ = request_animation_frame(move || {
                    stage.open_view();
                    browser::after(OPENED_MS, move || stage.take_keyboard(&desk));
                });
            }
            open
        });
    }

    /// After somebody here opened a program the keyboard is at its first stream, unless they are somewhere else by then.
    fn take_keyboard(&self, desk: &Desk) {
        if !desk.to_graph.get_untracked() {
            return;
        }
        desk.to_graph.set(false);
        let first = desk.document.stream_ids.with_untracked(|ids| ids.first().cloned());
        let free = {
            let (desk, first) = (desk.clone(), first.clone());
            move || {
                let other = desk
                    .document
                    .selected
                    .with_untracked(|at| at.as_ref().is_some_and(|at| Some(at.id()) != first.as_ref()));
                !other && !is_elsewhere() && desk.dialog.with_untracked(Option::is_none)
            }
        };
        if !free() {
            return;
        }
        match first {
            Some(first) => self.focus_if(&first, free),
            None => drop(FocusPlace::Graph.take()),
        }
    }

    /// Brings what is selected into view; a lost keyboard comes along.
    pub(super) fn follow_selection(&self, desk: &Desk) {
        let (stage, desk) = (self.clone(), desk.clone());
        Effect::new(move |_| {
            let selected = desk.document.selected.get();
            let Some(selected) = selected else { return };
            let id = match selected {
                Selected::Connector(_) => return,
                Selected::Stream(id) | Selected::Note(id) | Selected::Group(id) => id,
            };
            stage.came_to(&id);
            let (stage, desk) = (stage.clone(), desk.clone());
            browser::after(40, move || stage.arrive(&desk, &id));
        });
    }

    fn arrive(&self, desk: &Desk, id: &Id) {
        if !is_selected(desk, id) || self.dragged.with_untracked(Option::is_some) {
            return;
        }
        self.reveal(id);
        let free = {
            let (desk, id) = (desk.clone(), id.clone());
            move || is_lost() && is_selected(&desk, &id) && desk.dialog.with_untracked(Option::is_none)
        };
        if free() {
            self.focus_if(id, free);
        }
    }
}

fn is_selected(desk: &Desk, id: &Id) -> bool {
    desk.document.selected.with_untracked(|selected| selected.as_ref().map(Selected::id) == Some(id))
}

/// True if the keyboard is nowhere that anything could be done with it.
fn is_lost() -> bool {
    focus::is_nowhere() || focus::active().is_some_and(|active| active.id() == "stage")
}

/// True if the keyboard is where somebody does something by now.
fn is_elsewhere() -> bool {
    document().active_element().is_some_and(|active| active.closest(ELSEWHERE).ok().flatten().is_some())
}

/// All that there is of a graph.
struct WholeGraph {
    /// The first stream, else the first note.
    first: CanvasBounds,
    /// The bounds of all of it: streams with their values, chips, notes and groups.
    all: CanvasBounds,
    /// Each of them, without its value.
    parts: Vec<CanvasBounds>,
    streams: usize,
}

impl WholeGraph {
    /// All of it in a stage of that size.
    fn whole(&self, size: (f64, f64)) -> View {
        let high = window().inner_height().ok().and_then(|high| high.as_f64()).unwrap_or(f64::MAX);
        fit::fitting(self.all, VALUE_ROOM, size, &self.parts, &fit::corners(self.streams, high))
    }
}

fn everything(desk: &Desk) -> Option<WholeGraph> {
    let (streams, chips) = (desk.document.stream_ids.get_untracked(), desk.document.connector_ids.get_untracked());
    let seen = streams.iter().filter(|id| untrack(|| desk.document.hidden_in(id)).is_none());
    let seen: Vec<CanvasBounds> = seen.filter_map(|id| bounds(desk, id)).collect();
    let mut parts: Vec<CanvasBounds> =
        chips.iter().filter_map(|id| chip_bounds(desk, id)).chain(aside_bounds(desk)).collect();
    let first = *seen.first().or_else(|| parts.last())?;
    let values = seen.iter().map(|bounds| CanvasBounds { right: bounds.right + VALUE_ROOM, ..*bounds });
    let all = CanvasBounds::around(values.chain(parts.iter().copied()))?;
    parts.extend(seen);
    Some(WholeGraph { first, all, parts, streams: streams.len() })
}

/// The stream that the keyboard comes to: the one it was at last, if that is seen.
fn stop_memo(desk: Desk, stop: ArcRwSignal<Option<Id>>) -> ArcMemo<Option<Id>> {
    ArcMemo::new(move |_| {
        let ids = desk.document.stream_ids.get();
        desk.document.hidden.with(|hidden| {
            let seen = |id: &&Id| !hidden.contains_key(*id) && desk.document.stream(id).is_some();
            stop.get().filter(|id| seen(&id)).or_else(|| ids.iter().find(seen).cloned())
        })
    })
}

fn finished_memo(desk: &Desk, running: ArcMemo<bool>) -> ArcMemo<bool> {
    let desk = desk.clone();
    ArcMemo::new(move |_| {
        let acts = |id: &Id| {
            let signals = desk.document.stream(id);
            signals.is_some_and(|signals| signals.record.with(|stream| stream.kind == StreamKind::Actuator))
        };
        let only = |problems: &Vec<Problem>| problems.iter().all(|problem| problem.kind == ProblemKind::Unused);
        running.get()
            || (desk.document.problems.with(only) && desk.document.stream_ids.with(|ids| ids.iter().any(acts)))
    })
}

fn drawn_memo(desk: Desk, cells: ArcMemo<Cells>, rests: ArcRwSignal<bool>) -> ArcMemo<DrawnNow> {
    ArcMemo::new(move |before: Option<&DrawnNow>| {
        desk.document.revision.track();
        let (cells, rests, prints) = (cells.get(), rests.get(), desk.printing.get());
        let none = DrawnNow::default();
        let before = before.unwrap_or(&none);
        let stream_seen = |id: &Id| prints || bounds(&desk, id).is_some_and(|bounds| cells.touch(&bounds));
        let connector_seen = |id: &Id| prints || connector_bounds(&desk, id).is_some_and(|bounds| cells.touch(&bounds));
        let hidden = desk.document.hidden.get();
        let mut streams = desk.document.stream_ids.get();
        streams.retain(|id| !hidden.contains_key(id));
        let connectors = desk.document.connector_ids.get();
        let connectors = drawn(&connectors, connector_seen, &before.connectors, rests);
        let leads_in = |id: &Id| {
            let output = |connector: &Connector| hidden.contains_key(&connector.output);
            desk.document.connector(id).is_some_and(|signals| signals.record.with_untracked(output))
        };
        let chips = connectors.iter().filter(|id| hidden.is_empty() || !leads_in(id)).cloned().collect();
        DrawnNow { streams: drawn(&streams, stream_seen, &before.streams, rests), connectors, chips }
    })
}

/// Returns the bounds of streams, as of the last drop; nothing moves along with the hand.
fn shapes_memo(desk: Desk, dragged: ArcRwSignal<Option<Id>>) -> ArcMemo<Vec<(Id, CanvasBounds)>> {
    ArcMemo::new(move |before: Option<&Vec<(Id, CanvasBounds)>>| {
        desk.document.revision.track();
        if let (Some(before), true) = (before, dragged.with(Option::is_some)) {
            return before.clone();
        }
        let (ids, groups) = (desk.document.stream_ids.get(), desk.document.group_ids.get());
        desk.document.hidden.with(|hidden| {
            let streams = ids.iter().filter(|id| !hidden.contains_key(*id));
            let streams = streams.filter_map(|id| Some((id.clone(), bounds(&desk, id)?)));
            // A box stands in the place of the streams in it.
            let folded = groups.iter().filter(|id| untrack(|| desk.document.is_folded(id)));
            streams.chain(folded.filter_map(|id| Some((id.clone(), box_bounds(&desk, id)?)))).collect()
        })
    })
}

fn rooms_memo(desk: Desk, shapes: ArcMemo<Vec<(Id, CanvasBounds)>>) -> ArcMemo<HashMap<Id, f64>> {
    ArcMemo::new(move |_| {
        if !desk.robots.has_values.get() {
            return HashMap::new();
        }
        let connectors = desk.document.connector_ids.get();
        let chips: Vec<CanvasBounds> = connectors.iter().filter_map(|id| chip_bounds(&desk, id)).collect();
        shapes.with(|shapes| room::rooms(shapes, &chips))
    })
}

/// Somebody else is editing something.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Edited {
    pub(super) editor: OtherEditor,
    /// True for what is edited, false for the stream that it leads to.
    pub(super) is_it: bool,
}

fn edited_signal(desk: Desk) -> ArcRwSignal<HashMap<Id, Edited>> {
    settled(move || {
        let mut edited = HashMap::new();
        if desk.is_then() {
            return edited;
        }
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

fn others_signal(desk: Desk) -> ArcRwSignal<Vec<(Id, u8, String)>> {
    settled(move || {
        let others = desk.document.others().into_iter().filter(|_| !desk.is_then());
        others.filter_map(|(sign, person)| Some((person.selected?, sign.color, sign.name))).collect()
    })
}

/// Returns the part of the graph that an element is.
pub(super) fn selected_at(target: &Element) -> Option<Selected> {
    let id = |mark: &str| target.get_attribute(mark).and_then(|id| Id::new(&id).ok());
    let graph = id("data-node").map(Selected::Stream).or_else(|| id("data-chip").map(Selected::Connector));
    graph.or_else(|| id("data-note").map(Selected::Note)).or_else(|| id("data-group").map(Selected::Group))
}
