//! The timeline of a report as a drawing: senses, actions, by hand, marks, troubles, version. Each row has its word, and each kind
//! a shape of its own, so that it can be read in grey.

use super::compared::px;
use super::{Sheet, clean};
use crate::gather::StreamRow;
use crate::troubles::Trouble;
use behaviour::StreamKind;
use maud::{Markup, html};
use std::fmt::Write;

/// The width of the drawing, where the time begins and ends in it, and the height of a row.
const WIDTH: f64 = 682.0;
const FROM: f64 = 126.0;
const TO: f64 = 678.0;
const ROW: f64 = 20.0;
/// The height of the times above.
const HEAD: f64 = 24.0;
/// The most rows of a kind that are drawn.
const ROWS_MAX: usize = 16;
/// The most signs of a row's name that are drawn; those of Japanese are twice as wide.
const LABEL_MAX_SIGNS: usize = 20;
/// Times between two marks of the time, in seconds.
const STEPS: [u64; 13] = [1, 2, 5, 10, 30, 60, 120, 300, 600, 1_800, 3_600, 10_800, 43_200];
/// The most of them.
const TICKS_MAX: u64 = 7;

/// One row: its word, and what is drawn at this height.
struct DrawnRow {
    word: String,
    shapes: Markup,
}

pub(super) fn section(sheet: &Sheet) -> Markup {
    let rows = rows(sheet);
    let high = HEAD + ROW * rows.len() as f64 + 4.0;
    html! {
        section {
            h2 { (sheet.words.timeline()) }
            svg class="timeline" viewBox=(format!("0 0 {WIDTH} {high}")) role="img" aria-label=(sheet.words.timeline_label()) {
                (times(sheet))
                @for (at, row) in rows.iter().enumerate() {
                    g transform=(format!("translate(0 {})", px(HEAD + ROW * at as f64))) {
                        text x="0" y="14" { (row.word) }
                        path class="axis" d=(format!("M{FROM} 10H{TO}")) {}
                        (row.shapes)
                    }
                }
            }
        }
    }
}

fn rows(sheet: &Sheet) -> Vec<DrawnRow> {
    let (of, words) = (sheet.of, sheet.words);
    let mut rows = Vec::new();
    for (kind, class, high) in
        [(Some(StreamKind::Sensor), "sense", 9.0), (Some(StreamKind::Actuator), "action", 5.0), (None, "value", 7.0)]
    {
        let all = || of.rows.iter().filter(move |row| row.kind == kind && row.bars.count > 0);
        rows.extend(
            all()
                .take(ROWS_MAX)
                .map(|row| DrawnRow { word: label(&name(sheet, row)), shapes: bars(sheet, row, class, high) }),
        );
        let more = all().count().saturating_sub(ROWS_MAX);
        if more > 0 {
            rows.push(DrawnRow { word: label(&words.more(more as u64)), shapes: html! {} });
        }
    }
    let pretended = || of.rows.iter().flat_map(|row| row.pretended.values()).flat_map(|bars| &bars.drawn);
    if !of.presses.is_empty() || pretended().next().is_some() {
        let (pressed, as_if) = (places(sheet, of.presses.iter().copied()), places(sheet, pretended().map(|bar| bar.0)));
        let shapes = html! {
            @for x in pressed { circle class="hand" cx=(px(x)) cy="10" r="4" {} }
            @for x in as_if { circle class="as-if" cx=(px(x)) cy="10" r="4" {} }
        };
        rows.push(DrawnRow { word: words.by_hand().to_owned(), shapes });
    }
    if !of.marks.is_empty() {
        rows.push(DrawnRow { word: words.marks().to_owned(), shapes: marks(sheet) });
    }
    if !of.troubles.told.is_empty() {
        rows.push(DrawnRow { word: words.troubles().to_owned(), shapes: troubles(sheet) });
    }
    rows.push(DrawnRow { word: words.version_row().to_owned(), shapes: versions(sheet) });
    rows
}

fn name(sheet: &Sheet, row: &StreamRow) -> String {
    clean(&sheet.of.private.text(&row.name))
}

/// Bars as one path: those that touch on paper are one.
fn bars(sheet: &Sheet, row: &StreamRow, class: &str, high: f64) -> Markup {
    let mut path = String::new();
    let mut last: Option<(f64, f64)> = None;
    let y = 10.0 - high / 2.0;
    let draw = |(from, to): (f64, f64), path: &mut String| {
        let _ = write!(path, "M{} {}h{}v{high}h-{}z", px(from), px(y), px(to - from), px(to - from));
    };
    for (from_ms, until_ms) in &row.bars.drawn {
        let from = x(sheet, *from_ms);
        let to = x(sheet, *until_ms).max(from + 2.0);
        match &mut last {
            Some(open) if from <= open.1 + 0.5 => open.1 = open.1.max(to),
            _ => last.replace((from, to)).into_iter().for_each(|done| draw(done, &mut path)),
        }
    }
    last.into_iter().for_each(|done| draw(done, &mut path));
    html! { path class=(class) d=(path) {} }
}

/// Returns the places at which moments are drawn, each once.
fn places(sheet: &Sheet, moments: impl Iterator<Item = u64>) -> Vec<f64> {
    let mut places: Vec<f64> = moments.map(|ms| (x(sheet, ms) * 2.0).round() / 2.0).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}

/// Flags; one that lasts has a hollow bar behind it.
fn marks(sheet: &Sheet) -> Markup {
    let mut path = String::new();
    for mark in &sheet.of.marks {
        let at = x(sheet, mark.t);
        let _ = write!(path, "M{} 3v15m0-15h9l-3 3.5 3 3.5h-9", px(at));
        if let Some(until) = mark.until.filter(|until| *until > mark.t) {
            let wide = (x(sheet, until) - at).max(3.0);
            let _ = write!(path, "M{} 12h{}v5h-{}z", px(at), px(wide), px(wide));
        }
    }
    html! { path class="mark" d=(path) {} }
}

/// Triangles; a lost connection lasts.
fn troubles(sheet: &Sheet) -> Markup {
    let mut path = String::new();
    for (at_ms, trouble) in &sheet.of.troubles.told {
        let at = x(sheet, *at_ms);
        let _ = write!(path, "M{} 16h10l-5-11z", px(at - 5.0));
        if let Trouble::NoConnection { until_ms, .. } = trouble {
            let wide = (x(sheet, until_ms.unwrap_or(sheet.of.last_ms)) - at).max(3.0);
            let _ = write!(path, "M{} 12h{}", px(at), px(wide));
        }
    }
    html! { path class="trouble" d=(path) {} }
}

fn versions(sheet: &Sheet) -> Markup {
    let mut free = FROM - 1.0;
    let first = (0, sheet.of.header.revision);
    let later = sheet.of.programs.iter().skip(1).map(|program| (program.at_ms, program.revision));
    html! {
        @for (at_ms, revision) in std::iter::once(first).chain(later) {
            @let at = x(sheet, at_ms);
            path class="version" d=(format!("M{} 3v14", px(at))) {}
            @if at >= free {
                @let text = revision.to_string();
                ({ free = at + 12.0 + 7.0 * text.len() as f64; html! {} })
                text x=(px(at + 4.0)) y="14" class="faint" { (text) }
            }
        }
    }
}

/// The times of day above.
fn times(sheet: &Sheet) -> Markup {
    let seconds = (sheet.of.last_ms / 1_000).max(1);
    let step = STEPS.into_iter().find(|step| seconds / step < TICKS_MAX).unwrap_or(seconds.div_ceil(TICKS_MAX));
    // On whole minutes of the day.
    let first = step - (sheet.clock.seconds_of_day() + step) % step;
    let all = (0..=TICKS_MAX).map(|number| (first % step + number * step) * 1_000).filter(|ms| *ms <= sheet.of.last_ms);
    html! {
        @for ms in all {
            @let at = x(sheet, ms);
            @let time = sheet.clock.at(ms);
            @let shown = if step >= 60 { time.get(..5).unwrap_or(&time) } else { &time };
            text x=(px(at.clamp(FROM + 14.0, WIDTH - 28.0))) y="12" text-anchor="middle" class="faint" { (shown) }
            path class="tick" d=(format!("M{} 16v5", px(at))) {}
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "it is drawn")]
fn x(sheet: &Sheet, ms: u64) -> f64 {
    let share = ms as f64 / sheet.of.last_ms.max(1_000) as f64;
    FROM + share.min(1.0) * (TO - FROM)
}

/// A name that fits beside its row.
fn label(name: &str) -> String {
    let mut wide = 0;
    let fits = |letter: &char| {
        wide += if letter.is_ascii() { 1 } else { 2 };
        wide <= LABEL_MAX_SIGNS
    };
    let kept: String = name.chars().take_while(fits).collect();
    if kept.len() < name.len() { format!("{}…", kept.trim_end()) } else { kept }
}

#[cfg(test)]
mod tests {
    use super::label;

    #[test]
    fn a_long_name_is_cut_where_its_row_begins() {
        assert_eq!(label("Says “Hello”"), "Says “Hello”");
        assert_eq!(label("A name that is longer than its place"), "A name that is longe…");
        assert_eq!(label("とても近い赤いボールを見た"), "とても近い赤いボール…");
    }
}
