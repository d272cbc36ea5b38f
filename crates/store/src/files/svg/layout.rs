//! The places in the drawing: as people placed things; what has no place stands in layers, values flowing down.

use super::shapes::{CHIP_HEIGHT, SvgArea, SvgPoint, chip_width, one_line, wide, width};
use behaviour::layout::{LEVEL, LaidOut, STREAM_HEIGHT as HEIGHT, arranged};
use behaviour::{BehaviourFile, FileConnector, FileGroup, FileNote, FileStream, Lasting, Place, StreamKind};
use std::collections::{HashMap, HashSet};

/// The proportions in which a picture is shown, about as large as a stage.
const SHOWN: (f64, f64) = (960.0, 600.0);
/// Between two streams in a layer, and around the whole drawing.
const GAP: f64 = 40.0;
/// Between the frame of a group and its streams; above them stands the title.
const FRAME: f64 = 16.0;
const FRAME_TITLE: f64 = 28.0;
/// No coordinate is further away, whatever the file says.
const FAR: f64 = 1e6;
/// The longest label of a connector, in characters.
const LABEL_MAX_CHARS: usize = 60;

/// A connector's label on its way.
pub(super) struct Chip<'f> {
    pub(super) label: String,
    pub(super) middle: SvgPoint,
    connector: &'f FileConnector,
}

/// Everything with its place: streams by the middle of their top edge, notes by their corner.
pub(super) struct SvgDrawing<'f> {
    pub(super) streams: Vec<(&'f FileStream, SvgPoint)>,
    pub(super) chips: Vec<Chip<'f>>,
    pub(super) notes: Vec<(&'f FileNote, SvgPoint)>,
    /// Those that have a stream; a folded one has its frame too.
    pub(super) groups: Vec<(&'f FileGroup, SvgArea)>,
    tops: HashMap<&'f str, SvgPoint>,
}

impl<'f> SvgDrawing<'f> {
    pub(super) fn of(file: &'f BehaviourFile) -> Self {
        let tops = tops(file);
        let top = |id: &str| tops.get(id).copied().unwrap_or_default();
        let streams: Vec<_> = file.streams.iter().map(|stream| (stream, top(&stream.id))).collect();
        let right = streams.iter().map(|(stream, top)| top.0 + width(stream) / 2.0).fold(0.0, f64::max);
        let note = |(at, note): (u16, &'f FileNote)| {
            let beside = (right + GAP, GAP + f64::from(at) * LEVEL);
            (note, file.layout.get(&note.id).map_or(beside, |place| near(*place)))
        };
        let (chips, notes) = (chips(file, &tops), (0..).zip(&file.notes).map(note).collect());
        let groups = file.groups.iter().filter_map(|group| Some((group, frame(group, &streams)?))).collect();
        Self { streams, chips, notes, groups, tops }
    }

    /// Every line, from its upper end to its lower one.
    pub(super) fn edges(&self) -> Vec<(SvgPoint, SvgPoint)> {
        let mut edges = Vec::new();
        for chip in &self.chips {
            let inputs = chip.connector.inputs.iter().filter_map(|id| self.tops.get(id.as_str()));
            edges.extend(inputs.map(|top| ((top.0, top.1 + HEIGHT), chip.middle)));
            edges.extend(self.tops.get(chip.connector.output.as_str()).map(|top| (chip.middle, *top)));
        }
        edges
    }

    /// Left, top, width and height of all there is.
    pub(super) fn bounds(&self) -> SvgArea {
        let streams = self.streams.iter().map(|(stream, top)| area(stream, *top));
        let groups = self.groups.iter().map(|(_, frame)| *frame);
        let chips = self.chips.iter().map(|chip| {
            let wide = chip_width(&chip.label);
            (chip.middle.0 - wide / 2.0, chip.middle.1 - CHIP_HEIGHT / 2.0, wide, CHIP_HEIGHT)
        });
        let notes = self.notes.iter().map(|(note, corner)| {
            let (width, height) = super::shapes::note_size(&note.text);
            (corner.0, corner.1, width, height)
        });
        let boxes: Vec<_> = streams.chain(chips).chain(notes).chain(groups).collect();
        let (left, top, width, height) = around(&boxes).unwrap_or_default();
        (left - GAP, top - GAP, width + 2.0 * GAP, height + 2.0 * GAP)
    }
}

/// Returns the area that covers all of these.
fn around(boxes: &[SvgArea]) -> Option<SvgArea> {
    let least = |of: fn(&SvgArea) -> f64| boxes.iter().map(of).reduce(f64::min);
    let most = |of: fn(&SvgArea) -> f64| boxes.iter().map(of).reduce(f64::max);
    let (left, top) = (least(|part| part.0)?, least(|part| part.1)?);
    Some((left, top, most(|part| part.0 + part.2)? - left, most(|part| part.1 + part.3)? - top))
}

fn area(stream: &FileStream, (x, y): SvgPoint) -> SvgArea {
    (x - width(stream) / 2.0, y, width(stream), HEIGHT)
}

/// The frame of a group, if one of its streams is there.
fn frame(group: &FileGroup, streams: &[(&FileStream, SvgPoint)]) -> Option<SvgArea> {
    let ids: HashSet<&str> = group.streams.iter().map(String::as_str).collect();
    let members = streams.iter().filter(|(stream, _)| ids.contains(stream.id.as_str()));
    let (left, top, width, height) = around(&members.map(|(stream, top)| area(stream, *top)).collect::<Vec<_>>())?;
    let wide = (width + 2.0 * FRAME).max(wide(&one_line(&group.title), 13.0) + 2.0 * FRAME);
    Some((left - FRAME, top - FRAME - FRAME_TITLE, wide, height + 2.0 * FRAME + FRAME_TITLE))
}

/// Names a connector: `map (distance)`, `sample (every 1 second)`.
pub(super) fn label(connector: &FileConnector) -> String {
    let body = connector.body.as_deref().map(one_line).filter(|body| !body.is_empty());
    let spec = behaviour::connectors::spec(&connector.operation);
    let lasts = |ms| spec.map_or_else(|| Lasting::of(ms).to_string(), |spec| spec.lasts(ms));
    let period = connector.period_ms.map(lasts);
    let start = connector.start.as_ref().map(|start| one_line(&start.to_string()));
    let chosen: Vec<String> = start.into_iter().chain(connector.helper.clone().or(body)).chain(period).collect();
    if chosen.is_empty() {
        return one_line(&connector.operation);
    }
    let inside = chosen.join(", ");
    let mut short: String = inside.chars().take(LABEL_MAX_CHARS).collect();
    if short.len() < inside.len() {
        short.push('…');
    }
    one_line(&format!("{} ({short})", connector.operation))
}

fn near(place: Place) -> SvgPoint {
    (place.x.clamp(-FAR, FAR), place.y.clamp(-FAR, FAR))
}

/// Every connector's label, none on another as far as there is room near its line.
fn chips<'f>(file: &'f BehaviourFile, tops: &HashMap<&str, SvgPoint>) -> Vec<Chip<'f>> {
    let mut into: HashMap<&str, usize> = HashMap::new();
    for connector in &file.connectors {
        *into.entry(&connector.output).or_default() += 1;
    }
    let mut chips: Vec<Chip> = Vec::new();
    for connector in &file.connectors {
        let alone = into.get(connector.output.as_str()).is_none_or(|many| *many == 1);
        let (label, placed) = (label(connector), file.layout.get(&connector.id).map(|place| near(*place)));
        let middle = placed.unwrap_or_else(|| free(chip_middle(connector, tops, alone), &label, &chips));
        chips.push(Chip { label, middle, connector });
    }
    chips
}

/// The first place near the wanted one where no other label is.
fn free((x, y): SvgPoint, label: &str, others: &[Chip]) -> SvgPoint {
    let taken = |y: f64| {
        others.iter().any(|other| {
            let apart = f64::midpoint(chip_width(label), chip_width(&other.label));
            (other.middle.1 - y).abs() < CHIP_HEIGHT && (other.middle.0 - x).abs() < apart
        })
    };
    let steps = [0.0, -1.0, 1.0, -2.0, 2.0].map(|step| y + step * (CHIP_HEIGHT + 2.0));
    (x, steps.into_iter().find(|y| !taken(*y)).unwrap_or(y))
}

/// Above the stream it leads to, or on the way there if others lead there too.
fn chip_middle(connector: &FileConnector, tops: &HashMap<&str, SvgPoint>, alone: bool) -> SvgPoint {
    let inputs: Vec<_> = connector.inputs.iter().filter_map(|id| tops.get(id.as_str())).collect();
    let Some((x, y)) = tops.get(connector.output.as_str()) else { return (0.0, 0.0) };
    match inputs.as_slice() {
        [(from_x, from_y)] => (if alone { *x } else { f64::midpoint(*from_x, *x) }, f64::midpoint(from_y + HEIGHT, *y)),
        _ => (*x, y - (LEVEL - HEIGHT) / 2.0),
    }
}

/// The place of every stream. Those without one stand to the right of the others, as Tidy would lay them out.
fn tops(file: &BehaviourFile) -> HashMap<&str, SvgPoint> {
    let mut tops: HashMap<&str, SvgPoint> = HashMap::new();
    let mut right = 0.0_f64;
    for stream in &file.streams {
        if let Some(place) = file.layout.get(&stream.id) {
            let top = near(*place);
            right = right.max(top.0 + width(stream) / 2.0 + GAP);
            tops.insert(&stream.id, top);
        }
    }
    let others: Vec<&FileStream> =
        file.streams.iter().filter(|stream| !tops.contains_key(stream.id.as_str())).collect();
    let number: HashMap<&str, usize> = others.iter().enumerate().map(|(at, stream)| (stream.id.as_str(), at)).collect();
    let (mut edges, mut chips) = (Vec::new(), vec![0.0_f64; others.len()]);
    for connector in &file.connectors {
        let Some(to) = number.get(connector.output.as_str()) else { continue };
        chips[*to] = chips[*to].max(chip_width(&label(connector)));
        edges.extend(connector.inputs.iter().filter_map(|from| Some((*number.get(from.as_str())?, *to))));
    }
    let shape = |(stream, chip): (&&FileStream, &f64)| {
        let half = width(stream).max(*chip) / 2.0;
        LaidOut { left: half, right: half, acts: stream.kind == StreamKind::Actuator, stood: None }
    };
    let shapes: Vec<LaidOut> = others.iter().zip(&chips).map(shape).collect();
    for (stream, place) in others.iter().zip(arranged(&shapes, &edges, SHOWN)) {
        tops.insert(&stream.id, (place.x + right, place.y + GAP));
    }
    tops
}
