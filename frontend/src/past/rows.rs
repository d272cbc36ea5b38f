//! The lanes: a label for each, and the canvases on which overview, ruler and lanes are drawn.

use super::compare_changes::lane_counts;
use super::media::{DARK, when_changed};
use super::painting::{LaneTheme, Painter, TEXT_PX, tokens};
use super::signs::{FORM, Sign};
use super::{PastShared, clock, filling, hands};
use crate::browser;
use crate::icons::Icon;
use crate::past::words;
use lanes::{Align, Dot, DrawnForm, Ink, LaneAct, LaneFilling, LaneKind, Row};
use leptos::html;
use leptos::prelude::*;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

/// The height of the number of a limit.
const LIMIT: f64 = 17.0;
/// The height of the ruler.
pub(super) const RULER: f64 = 26.0;

/// Overview, ruler, labels and lanes.
#[component]
pub(super) fn Lanes(past: PastShared) -> impl IntoView {
    let (over, under) = (NodeRef::<html::Canvas>::new(), NodeRef::<html::Canvas>::new());
    let density = Memo::new(move |_| past.viewer.read().density());
    let rows = Memo::new(move |_| past.viewer.read().rows());
    let height = Memo::new(move |_| {
        let (_, marks) = &*rows.read();
        marks.y + marks.height
    });
    let shown = Memo::new(move |_| {
        let viewer = past.viewer.read();
        viewer.lanes().iter().map(|lane| (lane.key.clone(), lane.kind)).collect::<ShownKeys>()
    });
    let chosen = Memo::new(move |_| past.viewer.read().chosen_index());
    let count = Memo::new(move |_| shown.read().len());
    let marks = Memo::new(move |_| rows.read().1);
    let overview = move || density.get().overview() + RULER;
    watch_width(past, under);
    paint_when_changed(past, over, under);
    let hands = [hands::LaneHands::new(past), hands::LaneHands::new(past)];
    let [(od, om, ou), (ld, lm, lu)] = hands.map(|hands| (hands.clone(), hands.clone(), hands));
    let (lost_over, lost_lanes) = (ou.clone(), lu.clone());
    let aside = move || format!("{}px", density.get().label_width());
    view! {
        <div class="past-lanes" style:--past-labels=aside>
            <Inks />
            <div class="past-over" style:height=move || format!("{}px", overview())>
                <span class="past-all">{move || words::all_of_it(&clock::length(past.viewer.read().axis().length()))}</span>
                <canvas
                    node_ref=over
                    aria-hidden="true"
                    on:pointerdown=move |event| od.down_over(&event)
                    on:pointermove=move |event| om.moved_over(&event)
                    on:pointerup=move |_| ou.up_over()
                    on:pointercancel=move |_| lost_over.up_over()
                ></canvas>
            </div>
            <div class="past-rows">
                <div class="past-high" style:height=move || format!("{}px", height.get())>
                    <ul class="past-labels" aria-label=words::lanes_name()>
                        {move || (0..count.get()).map(|at| view! { <Label past at rows shown chosen /> }).collect_view()}
                        <MarksLabel past row=marks />
                    </ul>
                    <div class="past-canvas" role="slider" tabindex="0" aria-label=words::moment_name()
                        aria-valuemin="0"
                        aria-valuemax=move || (past.viewer.read().axis().length() / 1_000.0).round().to_string()
                        aria-valuenow=move || (past.viewer.read().cursor() / 1_000.0).round().to_string()
                        aria-valuetext=move || told(past)
                        data-begin=move || past.viewer.read().axis().begin().round().to_string()
                        data-cursor=move || past.viewer.read().cursor().round().to_string()
                    >
                        <canvas
                            node_ref=under
                            on:pointerdown=move |event| ld.down(&event)
                            on:pointermove=move |event| lm.moved(&event)
                            on:pointerup=move |event| lu.up(&event)
                            on:pointercancel=move |_| lost_lanes.lost()
                            on:wheel=move |event| hands::wheel(past, &event)
                        ></canvas>
                    </div>
                </div>
            </div>
        </div>
    }
}

/// One sign for each colour, from which the canvases take it.
#[component]
fn Inks() -> impl IntoView {
    let ink = |token| view! { <i data-ink=token style:color=format!("var(--{token})")></i> };
    view! { <span class="sr" aria-hidden="true">{tokens().map(ink).collect_view()}</span> }
}

/// The label of a lane, which chooses it.
#[component]
fn Label(
    past: PastShared,
    at: usize,
    rows: Memo<(Vec<Row>, Row)>,
    shown: Memo<ShownKeys>,
    chosen: Memo<usize>,
) -> impl IntoView {
    let place = Memo::new(move |_| rows.read().0.get(at).copied());
    let key = Memo::new(move |_| shown.read().get(at).map(|(key, _)| key.clone()));
    let name = Memo::new(move |_| {
        let (opened, key) = (past.opened.get()?, key.get()?);
        Some(filling::label(&opened, &filling::name(&key)))
    });
    let name = move || name.get().unwrap_or_default();
    let kind = move || {
        let kind = shown.read().get(at).map(|(_, kind)| *kind);
        match kind {
            Some(LaneKind::Sense) => "sensor",
            Some(LaneKind::Action) => "actuator",
            Some(LaneKind::Stream) | None => "ordinary",
        }
    };
    let is_chosen = move || chosen.get() == at;
    let counts = Memo::new(move |_| lane_counts(past, &key.get()?));
    // Telling a value takes longer than finding it: it is told anew only if it is another one.
    let here = Memo::new(move |_| at_cursor(past, at));
    let value = Memo::new(move |_| {
        past.desk.desk().document.types.track();
        let told = |_| value_words(past, &key.get().unwrap_or_default(), &here.get());
        counts.get().map_or_else(|| told(()), |(short, _)| short)
    });
    let (top, height) =
        (move || pixels(place.get().map(|row| row.y)), move || pixels(place.get().map(|row| row.height)));
    let folded = move || place.get().is_some_and(|row| row.is_folded);
    let limits = Memo::new(move |_| limits(past, at));
    view! {
        <li class="past-row" class:has-limits=move || !limits.read().is_empty() class:chosen=is_chosen style:top=top style:height=height data-kind=kind>
            <button class="past-label" type="button" aria-pressed=move || is_chosen().to_string()
                on:click=move |_| past.act(LaneAct::Choose(at))>
                <i aria-hidden="true"></i>
                <span class="cut" title=name>{name}</span>
                <b class="cut" title=value>{value}</b>
                {move || {
                    let words = counts.get()?.1;
                    let title = words.clone();
                    Some(view! { <span class="past-words" title=title>{words}</span> })
                }}
                {move || limits.get().into_iter().map(|(top, text, is_now)| {
                    let says = if is_now { words::now_version() } else { words::before_name() };
                    view! { <span class="past-limit" class:now=is_now style:top=top>{text}<span class="sr">" "{says}</span></span> }
                }).collect_view()}
            </button>
            <Show when=is_chosen>
                <span class="past-row-tools">
                    <button class="past-tool" type="button" aria-label=move || words::other_form(&name()) title=words::form()
                        on:click=move |_| past.act(LaneAct::Reshape(at))><Sign strokes=FORM /></button>
                    <button class="past-tool" type="button"
                        aria-label=move || if folded() { words::unfold_lane(&name()) } else { words::fold_lane(&name()) }
                        on:click=move |_| past.act(LaneAct::Fold(at))><Icon name="fold" /></button>
                    <button class="past-tool" type="button" aria-label=move || words::remove_lane(&name())
                        on:click=move |_| past.viewer.update(|viewer| viewer.remove_lane(at))><Icon name="close" /></button>
                </span>
            </Show>
        </li>
    }
}

/// The numbers of conditions that are others, each with its place and with true if it is that of now. Reactive.
fn limits(past: PastShared, at: usize) -> Vec<(String, String, bool)> {
    let viewer = past.viewer.read();
    let Some(lane) = viewer.lanes().get(at) else { return Vec::new() };
    let kind = filling::kind_of(past, &filling::name(&lane.key));
    let place = |place: lanes::LimitPlace| {
        (pixels(Some(place.y)), filling::number_words(place.number, kind.as_ref()), place.is_now)
    };
    viewer.limit_places(at, LIMIT).into_iter().map(place).collect()
}

/// A length for the stylesheet.
fn pixels(length: Option<f64>) -> String {
    format!("{}px", length.unwrap_or_default())
}

/// The label of the row of marks.
#[component]
fn MarksLabel(past: PastShared, row: Memo<Row>) -> impl IntoView {
    let count = Memo::new(move |_| past.viewer.read().marks().len());
    let (top, height) = (move || pixels(Some(row.get().y)), move || pixels(Some(row.get().height)));
    view! {
        <li class="past-row" style:top=top style:height=height>
            <span class="past-label"><Icon name="flag" /><span>{words::marks_name()}</span>
                <b>{move || count.get().to_string()}</b></span>
        </li>
    }
}

/// The lanes by their keys, with their sorts.
type ShownKeys = Vec<(String, LaneKind)>;

/// The value of a lane at the cursor.
#[derive(Clone, Debug, PartialEq)]
enum AtCursor {
    /// Nothing came by then.
    Nothing,
    /// It had been quiet for so many seconds.
    Earlier(u64),
    Text(Arc<str>),
    /// One of several numbers that are told together.
    Number(f64),
    /// Something without a number.
    Came,
}

fn at_cursor(past: PastShared, at: usize) -> AtCursor {
    let viewer = past.viewer.read();
    let (Some(lane), cursor) = (viewer.lanes().get(at), viewer.cursor()) else { return AtCursor::Nothing };
    let Some(newest) = lane.until(cursor).checked_sub(1) else { return AtCursor::Nothing };
    let found = match &lane.filling {
        LaneFilling::Values(dots) => dots
            .get(newest)
            .map(|dot| (dot.t, if dot.text.is_empty() { AtCursor::Came } else { AtCursor::Text(dot.text.clone()) })),
        LaneFilling::Spans(spans) => spans.get(newest).map(|span| {
            let number = Some(span.ends.1).filter(|number| number.is_finite());
            (span.until, number.map_or(AtCursor::Came, AtCursor::Number))
        }),
    };
    let Some((until, value)) = found else { return AtCursor::Nothing };
    let quiet = cursor - until;
    if quiet > lane.gap_ms && quiet >= 1_000.0 { AtCursor::Earlier((quiet / 1_000.0) as u64) } else { value }
}

fn value_words(past: PastShared, key: &str, here: &AtCursor) -> String {
    match here {
        AtCursor::Nothing => String::new(),
        AtCursor::Earlier(seconds) => words::seconds_earlier(*seconds),
        AtCursor::Text(text) => text.to_string(),
        AtCursor::Number(number) => {
            filling::number_words(*number, filling::kind_of(past, &filling::name(key)).as_ref())
        }
        AtCursor::Came => words::value_came().to_owned(),
    }
}

/// The words of a screen reader for the moment: the time, and the chosen lane. Reactive.
fn told(past: PastShared) -> String {
    let Some(opened) = past.opened.get() else { return String::new() };
    let viewer = past.viewer.read();
    let time = clock::time(&opened, viewer.cursor(), false);
    let name = viewer.chosen().map(|lane| filling::label(&opened, &filling::name(&lane.key)));
    let (at, key) = (viewer.chosen_index(), viewer.chosen().map(|lane| lane.key.clone()).unwrap_or_default());
    drop(viewer);
    words::moment_told(&time, &name.unwrap_or_default(), &value_words(past, &key, &at_cursor(past, at)))
}

/// The text of a value in the table: its number with its unit, or its words.
pub(super) fn dot_words(dot: &Dot) -> String {
    if dot.text.is_empty() { words::value_came().to_owned() } else { dot.text.to_string() }
}

/// Follows the width of the canvas of the lanes.
fn watch_width(past: PastShared, canvas: NodeRef<html::Canvas>) {
    let observer = StoredValue::new_local(None);
    Effect::new(move |_| {
        let Some(canvas) = canvas.get() else { return };
        let element = canvas.clone();
        let seen = move || {
            let width = element.get_bounding_client_rect().width();
            if !past.is_gone() && (past.width.get_untracked() - width).abs() >= 0.5 {
                past.width.set(width);
            }
        };
        observer.set_value(browser::watch_size(&canvas, seen));
    });
    on_cleanup(move || {
        observer.try_update_value(|observer| {
            if let Some(observer) = observer.take() {
                observer.disconnect();
            }
        });
    });
}

/// Draws both canvases anew with the next picture of the browser, once for all changes until then.
fn paint_when_changed(past: PastShared, over: NodeRef<html::Canvas>, under: NodeRef<html::Canvas>) {
    let waits = Rc::new(Cell::new(false));
    let theme: Rc<RefCell<Option<LaneTheme>>> = Rc::default();
    let kept = theme.clone();
    let paint = move || {
        if waits.replace(true) {
            return;
        }
        let (waits, theme) = (waits.clone(), theme.clone());
        browser::next_frame(move || {
            waits.set(false);
            if !past.is_gone() {
                paint(past, over, under, &mut theme.borrow_mut());
            }
        });
    };
    let again = paint.clone();
    // The drawing is lost with the process that draws, and made anew once there is another one.
    Effect::new(move |_| {
        for canvas in [over.get(), under.get()].into_iter().flatten() {
            let again = again.clone();
            browser::hear(&canvas, "contextrestored", move |_| again());
        }
    });
    for query in [DARK, "(prefers-contrast: more)", "(forced-colors: active)"] {
        let (kept, again) = (kept.clone(), paint.clone());
        when_changed(query, move || {
            kept.take();
            again();
        });
    }
    // Another language has other letters, and comes with what is opened anew.
    let opened = kept;
    Effect::new(move |_| {
        past.opened.track();
        opened.take();
    });
    Effect::new(move |_| {
        past.viewer.track();
        past.width.track();
        past.opened.track();
        over.track();
        under.track();
        paint();
    });
}

fn paint(past: PastShared, over: NodeRef<html::Canvas>, under: NodeRef<html::Canvas>, theme: &mut Option<LaneTheme>) {
    let (Some(over), Some(under)) = (over.get_untracked(), under.get_untracked()) else { return };
    let Some(opened) = past.opened.get_untracked() else { return };
    let width = past.width.get_untracked();
    if width < 1.0 {
        return;
    }
    if theme.is_none() {
        *theme = LaneTheme::of(&under);
    }
    let Some(theme) = theme else { return };
    let measure = |text: &str| browser::text_width(text, 400, TEXT_PX).unwrap_or(0.0);
    past.viewer.with_untracked(|viewer| {
        let (_, marks) = viewer.rows();
        if let Some(painter) = Painter::new(&under, (width, marks.y + marks.height), theme) {
            painter.draw(&viewer.draw(width, &measure));
        }
        let overview = viewer.density().overview();
        if let Some(painter) = Painter::new(&over, (width, overview + RULER), theme) {
            painter.draw(&viewer.draw_overview(width));
            let mut ruler = Vec::new();
            let tick_words = |t: f64, tenths| clock::time(&opened, t, tenths);
            for tick in viewer.ticks(width) {
                ruler.push(ruler_text(tick.x, overview, tick_words(tick.t, tick.has_tenths), Ink::Ink2));
            }
            let (x, at) = (viewer.axis().x(viewer.cursor(), width), viewer.cursor());
            if (0.0..=width).contains(&x) {
                let text = if viewer.follows() { words::happens_now().to_owned() } else { tick_words(at, false) };
                ruler.extend(tag(x, width, overview, text, &measure));
            }
            painter.draw(&ruler);
        }
    });
}

fn ruler_text(x: f64, overview: f64, text: String, ink: Ink) -> DrawnForm {
    DrawnForm::Text { x, y: overview + RULER / 2.0 + 1.0, text, ink, align: Align::Middle }
}

/// The tag of the cursor on the ruler, with its time.
fn tag(x: f64, width: f64, overview: f64, text: String, measure: &dyn Fn(&str) -> f64) -> [DrawnForm; 2] {
    let (wide, height) = (measure(&text) + 14.0, 20.0);
    let left = (x - wide / 2.0).min(width - wide).max(0.0);
    let ground = DrawnForm::Bar { x: left, y: overview + 4.0, width: wide, height, radius: 5.0, ink: Ink::Ink };
    [ground, ruler_text(left + wide / 2.0, overview, text, Ink::OnInk)]
}
