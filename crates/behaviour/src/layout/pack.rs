//! Parts without a connection, in rows that fit a stage.

use super::part::PlacedPart;
use super::{LaidOut, PARTS_APART, STREAM_HEIGHT};

/// The number of widths that are tried.
const WIDTHS: usize = 48;
/// The ratio of widths up to which one part stands below another; below something much narrower it would leave a hole
/// beside that.
const STACKED: f64 = 1.4;

/// The corner of a part, and how much lower its actions stand.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) lower: f64,
}

/// A part that stood somewhere.
struct Stood {
    top: f64,
    bottom: f64,
    left: f64,
    right: f64,
    part: PlacedPart,
}

impl Stood {
    fn of(part: PlacedPart, shapes: &[LaidOut]) -> Result<Self, PlacedPart> {
        let (mut top, mut bottom, mut left, mut right) = (f64::MAX, f64::MIN, f64::MAX, f64::MIN);
        for shape in part.spots.iter().map(|spot| &shapes[spot.shape]) {
            let Some(at) = shape.stood else { continue };
            (top, bottom) = (top.min(at.y), bottom.max(at.y + STREAM_HEIGHT));
            (left, right) = (left.min(at.x - shape.left), right.max(at.x + shape.right));
        }
        if top < f64::MAX { Ok(Self { top, bottom, left, right, part }) } else { Err(part) }
    }
}

/// The parts as they stood, row by row, in each from the left column by column; behind them those that nobody placed.
pub(super) fn in_order(parts: Vec<PlacedPart>, shapes: &[LaidOut]) -> Vec<PlacedPart> {
    let (mut placed, mut others) = (Vec::new(), Vec::new());
    for part in parts {
        match Stood::of(part, shapes) {
            Ok(stood) => placed.push(stood),
            Err(part) => others.push(part),
        }
    }
    others.sort_by_key(|part| part.spots.iter().map(|spot| spot.shape).min());
    let rows = bands(placed, |stood| (stood.top, stood.bottom));
    let columns = rows.into_iter().flat_map(|row| bands(row, |stood| (stood.left, stood.right)));
    let in_columns = columns.flat_map(|mut column| {
        column.sort_by(|one, other| one.top.total_cmp(&other.top));
        column
    });
    in_columns.map(|stood| stood.part).chain(others).collect()
}

/// Collects the parts that share a stretch, together and in order: rows by their heights, columns by their sides.
fn bands(mut all: Vec<Stood>, stretch: impl Fn(&Stood) -> (f64, f64)) -> Vec<Vec<Stood>> {
    all.sort_by(|one, other| stretch(one).0.total_cmp(&stretch(other).0));
    let (mut bands, mut end): (Vec<Vec<Stood>>, f64) = (Vec::new(), f64::MIN);
    for stood in all {
        let (from, to) = stretch(&stood);
        match bands.last_mut().filter(|_| from < end) {
            Some(band) => band.push(stood),
            None => bands.push(vec![stood]),
        }
        end = end.max(to);
    }
    bands
}

/// A corner for each part: in as few rows as are seen as large as possible on the stage.
pub(super) fn packed(parts: &[PlacedPart], stage: (f64, f64)) -> Vec<Corner> {
    let widest = parts.iter().map(|part| part.width).fold(1.0, f64::max);
    let whole = parts.iter().map(|part| part.width + PARTS_APART.0).sum::<f64>().max(widest);
    let step = (whole / widest).powf(1.0 / WIDTHS as f64);
    let widths = (0..=WIDTHS).map(|at| if at == 0 { whole } else { whole / step.powf(at as f64) }.max(widest));
    let mut best: Option<(f64, Vec<Corner>)> = None;
    for width in widths {
        let (corners, (wide, high)) = in_rows(parts, width, width < whole);
        let zoom = (stage.0 / wide).min(stage.1 / high).min(1.0);
        if best.as_ref().is_none_or(|(least, _)| zoom > least * 1.001) {
            best = Some((zoom, corners));
        }
    }
    best.map(|(_, corners)| corners).unwrap_or_default()
}

/// Rows no wider than this; if `stacks`, what is low stands below its neighbour where the row is high enough for both.
fn in_rows(parts: &[PlacedPart], width: f64, stacks: bool) -> (Vec<Corner>, (f64, f64)) {
    let mut corners: Vec<Corner> = Vec::with_capacity(parts.len());
    let (mut wide, mut top) = (0.0_f64, 0.0_f64);
    let mut from = 0;
    while from < parts.len() {
        let row = PackRow::of(&parts[from..], width, stacks);
        wide = wide.max(row.width);
        corners.extend(row.corners.iter().map(|corner| Corner { y: corner.y + top, ..*corner }));
        top += row.height + PARTS_APART.1;
        from += row.corners.len();
    }
    (corners, (wide.max(1.0), (top - PARTS_APART.1).max(1.0)))
}

struct PackRow {
    corners: Vec<Corner>,
    width: f64,
    height: f64,
}

impl PackRow {
    /// Takes as many of the parts as stand in a row of that width, one at least.
    fn of(parts: &[PlacedPart], most: f64, stacks: bool) -> Self {
        let mut row = Self { corners: Vec::new(), width: 0.0, height: 0.0 };
        // The column that stands last: its left edge, its width and its lower end; and who stands alone in one.
        let mut column = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut alone: Vec<bool> = Vec::new();
        for part in parts {
            let below = column.2 + PARTS_APART.1;
            let fits = stacks && below + part.height <= row.height && part.width <= column.1 * STACKED;
            if fits && !row.corners.is_empty() && column.0 + part.width <= most {
                row.corners.push(Corner { x: column.0, y: below, lower: 0.0 });
                column = (column.0, column.1.max(part.width), below + part.height);
                if let Some(before) = alone.last_mut() {
                    *before = false;
                }
                alone.push(false);
            } else {
                let left = if row.corners.is_empty() { 0.0 } else { row.width + PARTS_APART.0 };
                if left + part.width > most && !row.corners.is_empty() {
                    break;
                }
                row.corners.push(Corner { x: left, y: 0.0, lower: 0.0 });
                alone.push(true);
                column = (left, part.width, part.height);
            }
            row.height = row.height.max(part.height);
            row.width = row.width.max(column.0 + column.1);
        }
        for ((corner, part), alone) in row.corners.iter_mut().zip(parts).zip(alone) {
            if alone {
                corner.lower = row.height - part.height;
            }
        }
        row
    }
}
