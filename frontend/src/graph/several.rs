//! Several things chosen together: the lasso, and what can be done with all of them.

use super::Stage;
use super::bounds::bounds;
use super::clipboard::{copy, duplicate};
use super::hand::StagePoint;
use super::view::{CanvasBounds, View};
use crate::desk::{Desk, LineUp, Selected, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::text_width;
use behaviour::{Id, Place};
use leptos::prelude::*;
use protocol::Role;
use std::collections::BTreeSet;

/// Room between what is chosen and its tools, in pixels.
const NEAR: f64 = 14.0;
/// The room that the tools keep from the edges of the stage, and how wide and high a row of them is, in pixels.
const EDGE: f64 = 8.0;
const BUTTON: f64 = 46.0;
/// The widest name before them, in pixels.
const NAME_MAX: f64 = 140.0;
const ROW: f64 = 56.0;
/// The height of the zoom buttons with their margin, in pixels.
const ZOOM: f64 = 64.0;
/// Room left around what is brought into view, in pixels.
const MARGIN: f64 = 24.0;

impl Stage {
    /// The lasso goes from there to there.
    pub(super) fn lasso_to(&self, from: StagePoint, to: StagePoint) {
        let view = self.view.get_untracked();
        let (one, other) = (view.to_canvas(from), view.to_canvas(to));
        let [left, right] = [one.x.min(other.x), one.x.max(other.x)];
        let [top, bottom] = [one.y.min(other.y), one.y.max(other.y)];
        self.lasso.set(Some(CanvasBounds { left, top, right, bottom }));
    }

    /// Ends the lasso: everything in it is chosen too.
    pub(super) fn end_lasso(&self) {
        let Some(lasso) = self.lasso.get_untracked() else { return };
        self.lasso.set(None);
        let mut chosen = self.desk.document.chosen();
        self.shapes.with_untracked(|shapes| {
            let held = shapes.iter().filter(|(_, bounds)| lasso.meets(*bounds));
            chosen.extend(held.map(|(id, _)| self.shape(id)));
        });
        let notes = self.desk.document.note_ids.get_untracked().into_iter();
        let held = |id: &Id| bounds(&self.desk, id).is_some_and(|bounds| lasso.meets(bounds));
        chosen.extend(notes.filter(held).map(Selected::Note));
        let chips = self.desk.document.connector_ids.get_untracked().into_iter();
        let held = |id: &Id| self.chip_bounds(id).is_some_and(|bounds| lasso.meets(bounds));
        chosen.extend(chips.filter(held).map(Selected::Connector));
        self.desk.document.choose(chosen);
    }

    /// Returns the bounds around these. Reactive.
    pub(super) fn around(&self, these: &BTreeSet<Selected>) -> Option<CanvasBounds> {
        self.desk.document.revision.track();
        self.shapes.with(|shapes| {
            let chosen = |id: &Id| these.contains(&self.shape(id));
            let shapes = shapes.iter().filter(|(id, _)| chosen(id)).map(|(_, bounds)| *bounds);
            let others = these.iter().filter_map(|one| match one {
                Selected::Connector(id) => self.chip_bounds(id),
                Selected::Note(id) | Selected::Group(id) => bounds(&self.desk, id),
                Selected::Stream(_) => None,
            });
            CanvasBounds::around(shapes.chain(others))
        })
    }

    /// Returns the thing that a shape is: a stream or a box.
    fn shape(&self, id: &Id) -> Selected {
        let is_stream = self.desk.document.stream(id).is_some();
        if is_stream { Selected::Stream(id.clone()) } else { Selected::Group(id.clone()) }
    }

    /// Pans just so far that what is chosen is seen, if that has room.
    pub(super) fn reveal_chosen(&self) {
        if let Some(bounds) = untrack(|| self.around(&self.desk.document.chosen())) {
            self.glide(self.revealing(bounds, MARGIN));
        }
    }
}

/// The lasso while it is drawn.
#[component]
pub(super) fn Lasso() -> impl IntoView {
    let lasso = expect_context::<Stage>().lasso;
    move || {
        lasso.get().map(|lasso| {
            let size = |style: f64| format!("{style:.1}px");
            view! {
                <div class="lasso" aria-hidden="true" style:left=size(lasso.left) style:top=size(lasso.top)
                    style:width=size(lasso.right - lasso.left) style:height=size(lasso.bottom - lasso.top)></div>
            }
        })
    }
}

/// Shows the tools for everything that is chosen, as a view.
pub(crate) fn several() -> AnyView {
    view! { <SeveralTools /> }.into_any()
}

/// One of the tools.
struct Tool {
    icon: &'static str,
    label: &'static str,
    /// True if it changes the program.
    edits: bool,
    act: fn(&Desk, &Stage),
}

const fn tool(icon: &'static str, label: &'static str, act: fn(&Desk, &Stage)) -> Tool {
    Tool { icon, label, edits: true, act }
}

/// Returns the tools for these.
fn tools(these: &BTreeSet<Selected>, desk: &Desk) -> Vec<Tool> {
    let copies = [
        Tool { edits: false, ..tool("copy", words::copy(), |desk, _| drop(copy(desk))) },
        tool("duplicate", words::duplicate(), |desk, stage| duplicate(desk, Some(stage))),
    ];
    let remove = |label| tool("trash", label, |desk, _| desk.document.remove_several(&desk.document.chosen()));
    let open = |icon, label| {
        tool(icon, label, |desk, stage| {
            if let Some(one) = desk.document.chosen().first() {
                stage.open_aside(one);
            }
        })
    };
    let mut tools = match these.first() {
        Some(Selected::Note(_)) if these.len() == 1 => vec![open("pencil", words::edit())],
        Some(Selected::Group(id)) if these.len() == 1 => {
            let rename = tool("pencil", words::rename(), |desk, stage| {
                if let Some(one) = desk.document.chosen().first() {
                    stage.rename(one.id());
                }
            });
            let folded = untrack(|| desk.document.is_folded(id));
            let fold = if folded { open("unfold", words::unfold()) } else { fold_tool() };
            let ungroup = tool("ungroup", words::ungroup(), |desk, _| desk.document.ungroup(&desk.document.chosen()));
            vec![Tool { edits: false, ..fold }, rename, ungroup]
        }
        _ => vec![
            tool("group", words::group(), |desk, _| desk.document.make_group(&desk.document.chosen())),
            tool("row", words::line_up_row(), |desk, _| line_up(desk, LineUp::Row)),
            tool("column", words::line_up_column(), |desk, _| line_up(desk, LineUp::Column)),
            tool("note", words::add_note(), |_, stage| stage.add_note_beside()),
        ],
    };
    let is_group = these.len() == 1 && matches!(these.first(), Some(Selected::Group(_)));
    tools.extend(copies);
    tools.push(remove(if is_group { words::remove_with_streams() } else { words::remove() }));
    tools
}

fn line_up(desk: &Desk, how: LineUp) {
    desk.document.line_up(&desk.document.chosen(), how);
}

fn fold_tool() -> Tool {
    tool("fold", words::fold(), |desk, stage| {
        if let Some(Selected::Group(id)) = desk.document.chosen().first() {
            stage.fold(id, true);
        }
    })
}

/// Returns what is chosen and has its tools here: several things, a note, or a group.
fn chosen_memo(desk: &Desk) -> ArcMemo<BTreeSet<Selected>> {
    let (several, selected) = (desk.document.several.clone(), desk.document.selected.clone());
    ArcMemo::new(move |_| {
        let several = several.get();
        let alone = selected.get().filter(|one| matches!(one, Selected::Note(_) | Selected::Group(_)));
        if several.is_empty() { alone.into_iter().collect() } else { several }
    })
}

/// Names these together.
fn called(desk: &Desk, these: &BTreeSet<Selected>) -> String {
    match these.first() {
        Some(Selected::Note(_)) if these.len() == 1 => words::a_note().to_owned(),
        Some(Selected::Group(id)) if these.len() == 1 => {
            desk.document.group(id).map(|signals| signals.record.with(|group| group.title.clone())).unwrap_or_default()
        }
        _ => words::selected_count(these.len()),
    }
}

/// Shows the tools for everything that is chosen: below it, above it, else at the bottom of the stage.
#[component]
fn SeveralTools() -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let chosen = chosen_memo(&desk);
    let around = {
        let (chosen, stage) = (chosen.clone(), stage.clone());
        ArcMemo::new(move |_| chosen.with(|chosen| stage.around(chosen)))
    };
    let name = {
        let (chosen, desk) = (chosen.clone(), desk.clone());
        ArcMemo::new(move |_| chosen.with(|chosen| called(&desk, chosen)))
    };
    let width = {
        let (chosen, desk, name) = (chosen.clone(), desk.clone(), name.clone());
        move || {
            let count = chosen.with(|chosen| tools(chosen, &desk).len());
            text_width(&name.get(), 13).min(NAME_MAX) + 40.0 + count as f64 * BUTTON
        }
    };
    let placed = stage.clone();
    let at = move || {
        placed.above.track();
        let (view, size) = (placed.view.get(), placed.size.get());
        let (x, y) = spot(around.get()?, (view, size), placed.above(), width());
        Some(format!("translate({x:.0}px,{y:.0}px)"))
    };
    let hidden = {
        let stage = stage.clone();
        ArcMemo::new(move |_| {
            stage.dragged.with(Option::is_some)
                || stage.noting.with(Option::is_some)
                || stage.context.with(Option::is_some)
        })
    };
    move || {
        let these = chosen.get();
        if these.is_empty() || hidden.get() {
            return ().into_any();
        }
        // Folding changes what can be done.
        desk.document.hidden.track();
        let no_edit = desk.may_not(Role::Editor).is_some();
        let button = |Tool { icon, label, edits, act }: Tool| {
            let (desk, stage) = (desk.clone(), stage.clone());
            view! {
                <button type="button" class="tool-button" aria-label=label title=label disabled=no_edit && edits
                    on:click=move |_| act(&desk, &stage)><Icon name=icon /></button>
            }
        };
        let (label, shown) = (name.clone(), name.clone());
        view! {
            <div class="strip several" role="toolbar" aria-label=move || label.get() style:transform=at.clone()>
                <span class="count cut">{move || shown.get()}</span>
                {tools(&these, &desk).into_iter().map(button).collect_view()}
            </div>
        }
        .into_any()
    }
}

/// The left top corner of the tools of what is chosen; `above` is covered at the top.
fn spot(around: CanvasBounds, (view, size): (View, (f64, f64)), above: f64, width: f64) -> (f64, f64) {
    let (left, top) = view.to_stage(Place { x: around.left, y: around.top });
    let (_, bottom) = view.to_stage(Place { x: around.right, y: around.bottom });
    // Where the stage is narrow they stand in two rows.
    let height = if width + 2.0 * EDGE > size.0 { 2.0 * ROW } else { ROW };
    let [below, over] = [bottom + NEAR, top - NEAR - height];
    let y = match () {
        () if below >= above + EDGE && below + height + EDGE <= size.1 => below,
        () if over >= above + EDGE && over + height + EDGE <= size.1 => over,
        () => size.1 - height - ZOOM,
    };
    (left.clamp(EDGE, (size.0 - width - EDGE).max(EDGE)), y.max(EDGE))
}

#[cfg(test)]
mod tests {
    use super::spot;
    use crate::graph::view::{CanvasBounds, View};

    const STAGE: (f64, f64) = (800.0, 400.0);

    fn at(top: f64, bottom: f64) -> (f64, f64) {
        let around = CanvasBounds { left: 700.0, top, right: 780.0, bottom };
        spot(around, (View::default(), STAGE), 50.0, 400.0)
    }

    #[test]
    fn the_tools_stay_on_the_stage() {
        assert_eq!(at(100.0, 200.0), (392.0, 214.0), "below, and not past the edge");
        assert_eq!(at(250.0, 380.0).1, 180.0, "above where there is no room below");
        assert_eq!(at(60.0, 390.0).1, 280.0, "over the zoom buttons where there is none at all");
        assert_eq!(at(-500.0, -300.0).1, 280.0, "what is chosen is out of view");
        let narrow = spot(
            CanvasBounds { left: 0.0, top: 0.0, right: 9.0, bottom: 90.0 },
            (View::default(), (390.0, 500.0)),
            0.0,
            480.0,
        );
        assert_eq!(narrow, (8.0, 104.0));
    }
}
