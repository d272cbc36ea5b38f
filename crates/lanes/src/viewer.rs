//! The viewer holds a past as somebody looks at it, and does what their hands and keys do with it.

use crate::around::{around, around_of};
use crate::axis::Axis;
use crate::compared::{ComparedLane, ComparedLanes, ComparedLimit, DotChange, LimitPlace, compared_dots, limit_places};
use crate::dots::{Dot, LaneFilling};
use crate::draw::{DrawnForm, Ink, LaneArea, Measure, under_cursor, upright};
use crate::hit::{Hit, nearest, nearest_mark};
use crate::lane::{LaneMark, LaneShape, ShownLane};
use crate::layout::{Density, Row, row_at, rows};
use crate::overview::{Grip, Overview, grip};
use crate::play::Play;
use crate::question::question;
use crate::ruler::{RulerMark, ticks};
use crate::walk::{dot_from, mark_from, value_from};
use std::cell::Cell;
use std::collections::BTreeSet;

/// The most lanes.
pub const LANES_MAX: usize = 24;
/// The most marks that are shown.
pub const MARKS_MAX: usize = 1_000;
/// The stretch that is seen first, in milliseconds.
const FIRST_SPAN_MS: f64 = 60_000.0;
/// The step of the keys that go by time, in milliseconds.
const SECOND_MS: f64 = 1_000.0;

/// The deed of a hand or a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LaneAct {
    /// Moves what is seen by so many pixels of a width: what lies under the finger stays under it. Following ends.
    Pan {
        /// The way that the finger went to the right.
        by: f64,
        /// The width of the lanes.
        width: f64,
    },
    /// Shows more or less around the moment at a place. Following goes on.
    Zoom {
        /// The place.
        x: f64,
        /// The width of the lanes.
        width: f64,
        /// The factor by which more is seen; less below 1.
        factor: f64,
    },
    /// Shows more or less around the cursor.
    ZoomHere(f64),
    /// The cursor goes to the moment at a place of the lanes.
    Scrub {
        /// The place.
        x: f64,
        /// The width of the lanes.
        width: f64,
    },
    /// A hand comes down on the overview: it takes an end of the brush, or scrubs.
    OverviewDown {
        /// The place.
        x: f64,
        /// The width of the overview.
        width: f64,
        /// The farthest from an end of the brush that it may be.
        reach: f64,
    },
    /// The hand on the overview moves.
    OverviewMove {
        /// The place.
        x: f64,
        /// The width of the overview.
        width: f64,
    },
    /// A hand holds the cursor, or lets it go. Playing rests meanwhile.
    Hold(bool),
    /// A finger or a pointer chooses what it is on.
    Tap {
        /// The place.
        x: f64,
        /// The height, from the upper edge of the first lane.
        y: f64,
        /// The width of the lanes.
        width: f64,
        /// The farthest from a value that it may be.
        reach: f64,
    },
    /// Chooses a lane.
    Choose(usize),
    /// Chooses the next lane, or the one above.
    NextLane(bool),
    /// Folds a lane to its label, or unfolds it.
    Fold(usize),
    /// Draws a lane in its next form.
    Reshape(usize),
    /// The cursor goes to the next value of the chosen lane, or to the one before.
    Value(bool),
    /// The cursor goes a second on, or back.
    Second(bool),
    /// The cursor goes to the next mark, or to the one before.
    NextMark(bool),
    /// The cursor goes to the beginning.
    Home,
    /// The cursor goes to the end.
    End,
    /// The cursor goes to a moment.
    Seek(f64),
    /// Playing begins, or rests.
    Play,
    /// Plays at the next speed.
    Faster,
    /// So many milliseconds of the watching person went by.
    Pass(f64),
    /// The newest is followed again.
    Now,
}

/// The values of a lane around the cursor, one by one.
#[derive(Clone, Debug)]
struct NearValues {
    key: String,
    from: f64,
    until: f64,
    dots: Vec<Dot>,
}

/// A past as somebody looks at it.
#[derive(Clone, Debug)]
pub struct Viewer {
    axis: Axis,
    lanes: Vec<ShownLane>,
    marks: Vec<LaneMark>,
    /// The lane, by its key, and the moment at which somebody asks why nothing came.
    question: Option<(String, f64)>,
    folded: BTreeSet<String>,
    chosen: usize,
    near: Option<NearValues>,
    compared: Option<ComparedLanes>,
    cursor: f64,
    play: Play,
    overview: Overview,
    grip: Option<Grip>,
    /// True if it goes on: there is a now.
    is_live: bool,
    follows: bool,
    density: Density,
    /// The time of day at Start, in milliseconds, for round ticks.
    began: f64,
}

impl Viewer {
    /// Makes the viewer of a recording of so many milliseconds that began at a time of day. It begins at the end.
    #[must_use]
    pub fn recorded(length: f64, began: f64) -> Self {
        let mut viewer = Self::of(length, began);
        viewer.act(LaneAct::End);
        viewer
    }

    /// Makes the viewer of what goes on now, so many milliseconds after its Start at a time of day. It follows.
    #[must_use]
    pub fn live(length: f64, began: f64) -> Self {
        let mut viewer = Self { is_live: true, ..Self::of(length, began) };
        viewer.act(LaneAct::Now);
        viewer
    }

    fn of(length: f64, began: f64) -> Self {
        Self {
            axis: Axis::new(length, FIRST_SPAN_MS),
            lanes: Vec::new(),
            marks: Vec::new(),
            question: None,
            folded: BTreeSet::new(),
            chosen: 0,
            near: None,
            compared: None,
            cursor: 0.0,
            play: Play::default(),
            overview: Overview::default(),
            grip: None,
            is_live: false,
            follows: false,
            density: Density::Fine,
            began,
        }
    }

    /// The stretch that is seen.
    #[must_use]
    pub fn axis(&self) -> &Axis {
        &self.axis
    }

    /// The lanes, from the top.
    #[must_use]
    pub fn lanes(&self) -> &[ShownLane] {
        &self.lanes
    }

    /// The marks.
    #[must_use]
    pub fn marks(&self) -> &[LaneMark] {
        &self.marks
    }

    /// The moment that is looked at, in milliseconds since Start.
    #[must_use]
    pub fn cursor(&self) -> f64 {
        self.cursor
    }

    /// The chosen lane, if there is one.
    #[must_use]
    pub fn chosen(&self) -> Option<&ShownLane> {
        self.lanes.get(self.chosen)
    }

    /// Which lane is chosen, counted from the top.
    #[must_use]
    pub fn chosen_index(&self) -> usize {
        self.chosen
    }

    /// True while the cursor moves by itself.
    #[must_use]
    pub fn plays(&self) -> bool {
        self.play.goes
    }

    /// The factor by which it is faster than the robot was.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.play.speed()
    }

    /// True if it goes on: there is a now.
    #[must_use]
    pub fn is_live(&self) -> bool {
        self.is_live
    }

    /// True while the newest is followed.
    #[must_use]
    pub fn follows(&self) -> bool {
        self.follows
    }

    /// Takes other lanes, at most [`LANES_MAX`]; the same lane stays chosen, and a form that somebody chose stays.
    pub fn set_lanes(&mut self, mut lanes: Vec<ShownLane>) {
        lanes.truncate(LANES_MAX);
        let key = self.chosen().map(|lane| lane.key.clone());
        self.lanes = lanes;
        self.chosen = key.and_then(|key| self.lanes.iter().position(|lane| lane.key == key)).unwrap_or(0);
    }

    /// Adds a lane at the end and chooses it; one that is there already is only chosen. False if there is no room.
    pub fn add_lane(&mut self, lane: ShownLane) -> bool {
        if let Some(there) = self.lanes.iter().position(|one| one.key == lane.key) {
            self.chosen = there;
            return true;
        }
        let has_room = self.lanes.len() < LANES_MAX;
        if has_room {
            self.lanes.push(lane);
            self.chosen = self.lanes.len() - 1;
        }
        has_room
    }

    /// Removes a lane; its neighbour is chosen in its place.
    pub fn remove_lane(&mut self, index: usize) {
        if index < self.lanes.len() {
            self.lanes.remove(index);
            self.chosen = if self.chosen > index { self.chosen - 1 } else { self.chosen };
            self.chosen = self.chosen.min(self.lanes.len().saturating_sub(1));
        }
    }

    /// Gives a lane other values. Nothing for a lane that is not there any more.
    pub fn fill(&mut self, key: &str, filling: LaneFilling) {
        if let Some(lane) = self.lanes.iter_mut().find(|lane| lane.key == key) {
            lane.fill(filling);
        }
    }

    /// Takes the overview from the lanes, which hold the whole just now.
    pub fn keep_overview(&mut self) {
        self.overview = Overview::of(&self.lanes, self.axis.length());
    }

    /// Takes other marks, at most [`MARKS_MAX`].
    pub fn set_marks(&mut self, mut marks: Vec<LaneMark>) {
        marks.truncate(MARKS_MAX);
        self.marks = marks;
    }

    /// Shows in a lane, by its key, that somebody asks why nothing came there at a moment; none takes that away.
    pub fn set_question(&mut self, question: Option<(String, f64)>) {
        self.question = question;
    }

    /// Takes the room that lanes have.
    pub fn set_density(&mut self, density: Density) {
        self.density = density;
    }

    /// The room that lanes have.
    #[must_use]
    pub fn density(&self) -> Density {
        self.density
    }

    /// It has gone on until now; who follows sees the newest.
    pub fn grow(&mut self, length: f64) {
        self.axis.grow(length);
        if self.follows {
            self.cursor = self.axis.length();
            self.axis.follow_end();
        }
    }

    /// The places of the lanes, and of the row of marks below them.
    #[must_use]
    pub fn rows(&self) -> (Vec<Row>, Row) {
        let folded = |index: usize| self.lanes.get(index).is_some_and(|lane| self.folded.contains(&lane.key));
        rows(&self.lanes, &folded, self.density)
    }

    /// The thing at a place of the lanes.
    #[must_use]
    pub fn hit(&self, x: f64, y: f64, width: f64, reach: f64) -> Option<Hit> {
        let (rows, marks) = self.rows();
        if let Some(lane) = row_at(&rows, y) {
            let nearest = nearest(&self.lanes[lane], &self.axis, width, x, reach).filter(|_| !rows[lane].is_folded);
            let beside = Hit::ShownLane { lane, t: self.axis.t(x, width) };
            return Some(nearest.map_or(beside, |t| Hit::Value { lane, t }));
        }
        row_at(&[marks], y)?;
        nearest_mark(&self.marks, &self.axis, width, x, reach).map(|t| Hit::LaneMark { t })
    }

    /// Takes the values of a lane between two moments, one by one, in the order of time.
    pub fn set_near(&mut self, key: &str, (from, until): (f64, f64), dots: Vec<Dot>) {
        self.near = Some(NearValues { key: key.to_owned(), from, until, dots });
    }

    /// The moments between which the chosen lane's values are known one by one.
    #[must_use]
    pub fn near(&self) -> Option<(f64, f64)> {
        self.near_chosen().map(|near| (near.from, near.until))
    }

    fn near_chosen(&self) -> Option<&NearValues> {
        let key = &self.chosen()?.key;
        self.near.as_ref().filter(|near| near.key == *key)
    }

    /// The chosen lane's values, as far as they are known one by one.
    fn single(&self) -> &[Dot] {
        match self.chosen().map(|lane| &lane.filling) {
            _ if self.near_chosen().is_some() => self.near_chosen().map_or(&[], |near| &near.dots),
            Some(LaneFilling::Values(dots)) => dots,
            Some(LaneFilling::Spans(_)) | None => &[],
        }
    }

    /// The chosen lane's values around the cursor, the earliest first, and the place of the newest until it.
    #[must_use]
    pub fn around(&self) -> (&[Dot], Option<usize>) {
        around(self.single(), self.cursor)
    }

    /// Takes the comparison with another program; none ends it.
    pub fn set_compared(&mut self, compared: Option<ComparedLanes>) {
        self.compared = compared;
    }

    /// True while lanes are compared.
    #[must_use]
    pub fn is_compared(&self) -> bool {
        self.compared.is_some()
    }

    /// The places of the limits of a lane that are others now, with `line` pixels for each at least. None while nothing is
    /// compared.
    #[must_use]
    pub fn limit_places(&self, lane: usize, line: f64) -> Vec<LimitPlace> {
        let Some((lane, row)) = self.lanes.get(lane).zip(self.rows().0.get(lane).copied()) else { return Vec::new() };
        limit_places(lane, self.compared_limits(&lane.key), &row, line)
    }

    fn compared_limits(&self, key: &str) -> &[ComparedLimit] {
        let limits = self.compared.as_ref().and_then(|compared| compared.limits.get(key));
        limits.map_or(&[], Vec::as_slice)
    }

    fn compared_lane(&self, key: &str) -> Option<(&ComparedLane, f64)> {
        let compared = self.compared.as_ref()?;
        compared.lanes.get(key).map(|lane| (lane, compared.from))
    }

    /// The chosen lane's values around the cursor as [`Viewer::around`] tells them, each with its change, if that is known.
    #[must_use]
    pub fn around_compared(&self) -> (Vec<(Dot, Option<DotChange>)>, Option<usize>) {
        let compared = self.chosen().and_then(|lane| self.compared_lane(&lane.key));
        match compared {
            Some((compared, _)) => {
                let all = compared_dots(compared, self.single());
                let (all, newest) = around_of(&all, self.cursor, |(dot, _)| dot.t);
                (all.to_vec(), newest)
            }
            None => {
                let (all, newest) = self.around();
                (all.iter().map(|dot| (dot.clone(), None)).collect(), newest)
            }
        }
    }

    /// Puts lanes first, in the order of `keys`; the others follow as they stood.
    pub fn put_first(&mut self, keys: &[String]) {
        let place = |lane: &ShownLane| keys.iter().position(|key| *key == lane.key).unwrap_or(keys.len());
        let mut lanes = self.lanes.clone();
        lanes.sort_by_key(place);
        self.set_lanes(lanes);
    }

    fn value_from(&self, forward: bool) -> Option<f64> {
        let near = self.near_chosen().filter(|near| near.from <= self.cursor && self.cursor <= near.until);
        let single = near.and_then(|near| dot_from(&near.dots, self.cursor, forward));
        single.or_else(|| value_from(self.chosen()?, self.cursor, forward))
    }

    /// The ticks of the ruler.
    #[must_use]
    pub fn ticks(&self, width: f64) -> Vec<RulerMark> {
        ticks(&self.axis, width, self.began)
    }

    /// The number of a lane under the cursor; none in a silence.
    #[must_use]
    pub fn number_at_cursor(&self, lane: usize) -> Option<f64> {
        under_cursor(self.lanes.get(lane)?, self.cursor)
    }

    /// Draws the lanes and the marks. The list is bounded by the width and the number of lanes.
    #[must_use]
    pub fn draw(&self, width: f64, measure: Measure<'_>) -> Vec<DrawnForm> {
        self.draw_counted(width, measure).0
    }

    /// Draws as [`Viewer::draw`] does, and says how many values it read for that.
    #[must_use]
    pub fn draw_counted(&self, width: f64, measure: Measure<'_>) -> (Vec<DrawnForm>, usize) {
        let read = Cell::new(0);
        let (cursor, before) = (self.cursor, f64::INFINITY);
        let sheet = LaneArea { axis: &self.axis, width, cursor, measure, before, read: &read };
        let (rows, marks) = self.rows();
        let mut to = Vec::new();
        for (lane, row) in self.lanes.iter().zip(&rows) {
            sheet.compared_limits(lane, self.compared_limits(&lane.key), row, &mut to);
            match self.compared_lane(&lane.key) {
                Some(compared) => sheet.compared_lane(lane, compared, row, &mut to),
                None => sheet.lane(lane, row, &mut to),
            }
        }
        if let Some((key, t)) = &self.question {
            let asked = self.lanes.iter().zip(&rows).find(|(lane, row)| lane.key == *key && !row.is_folded);
            to.extend(asked.into_iter().flat_map(|(_, row)| question(self.axis.x(*t, width), row.middle)));
        }
        sheet.marks(&self.marks, &marks, &mut to);
        let ink = if self.follows { Ink::Pulse } else { Ink::Ink };
        to.push(upright(self.axis.x(self.cursor, width), 0.0, marks.y + marks.height, ink));
        (to, read.get())
    }

    /// Draws the overview.
    #[must_use]
    pub fn draw_overview(&self, width: f64) -> Vec<DrawnForm> {
        self.overview.draw(&self.axis, &self.marks, self.cursor, (width, self.density.overview()))
    }

    /// Does what a hand or a key does.
    pub fn act(&mut self, act: LaneAct) {
        match act {
            LaneAct::Pan { by, width } => {
                self.follows = false;
                self.axis.pan(-by * self.axis.span() / width.max(1.0));
            }
            LaneAct::Zoom { x, width, factor } => self.zoom(self.axis.t(x, width), factor),
            LaneAct::ZoomHere(factor) => self.zoom(self.cursor, factor),
            LaneAct::Scrub { x, width } => self.look_at(self.axis.t(x.clamp(0.0, width.max(0.0)), width)),
            LaneAct::OverviewDown { x, width, reach } => {
                self.grip = grip(&self.axis, x, width, reach);
                if self.grip.is_none() {
                    self.scrub_all(x, width);
                }
            }
            LaneAct::OverviewMove { x, width } => self.move_overview(x, width),
            LaneAct::Hold(is_held) => self.play.is_held = is_held,
            LaneAct::Tap { x, y, width, reach } => self.tap(x, y, width, reach),
            LaneAct::Choose(lane) => self.chosen = lane.min(self.lanes.len().saturating_sub(1)),
            LaneAct::NextLane(down) => {
                let next = if down { self.chosen + 1 } else { self.chosen.saturating_sub(1) };
                self.act(LaneAct::Choose(next));
            }
            LaneAct::Fold(lane) => self.fold(lane),
            LaneAct::Reshape(lane) => self.reshape(lane),
            LaneAct::Value(forward) => {
                let to = self.value_from(forward);
                self.step_to(to);
            }
            LaneAct::Second(forward) => {
                let by = if forward { SECOND_MS } else { -SECOND_MS };
                self.step_to(Some(self.cursor + by));
            }
            LaneAct::NextMark(forward) => self.step_to(mark_from(&self.marks, self.cursor, forward)),
            LaneAct::Home => self.step_to(Some(0.0)),
            LaneAct::End => self.step_to(Some(self.axis.length())),
            LaneAct::Seek(t) => self.step_to(Some(t)),
            LaneAct::Play => self.play_or_rest(),
            LaneAct::Faster => self.play.faster(),
            LaneAct::Pass(passed) => self.tick(passed),
            LaneAct::Now => {
                self.follows = self.is_live;
                self.play.goes = false;
                self.cursor = self.axis.length();
                self.axis.follow_end();
            }
        }
    }

    fn zoom(&mut self, around: f64, factor: f64) {
        self.axis.zoom(around, factor);
        if self.follows {
            self.axis.follow_end();
        }
    }

    /// The cursor goes to a moment, and whoever followed stays there.
    fn look_at(&mut self, t: f64) {
        self.follows = false;
        self.cursor = self.axis.within(t);
    }

    fn step_to(&mut self, to: Option<f64>) {
        if let Some(t) = to {
            self.look_at(t);
            self.axis.reveal(self.cursor);
        }
    }

    fn scrub_all(&mut self, x: f64, width: f64) {
        self.look_at(x / width.max(1.0) * self.axis.length());
        self.axis.reveal(self.cursor);
    }

    fn move_overview(&mut self, x: f64, width: f64) {
        let t = self.axis.within(x / width.max(1.0) * self.axis.length());
        match self.grip {
            Some(Grip::Begin) => self.axis.show(t.min(self.axis.end()), self.axis.end()),
            Some(Grip::End) => self.axis.show(self.axis.begin(), t.max(self.axis.begin())),
            None => self.scrub_all(x, width),
        }
        self.follows = self.follows && self.grip == Some(Grip::Begin);
    }

    fn tap(&mut self, x: f64, y: f64, width: f64, reach: f64) {
        match self.hit(x, y, width, reach) {
            Some(Hit::Value { lane, t } | Hit::ShownLane { lane, t }) => {
                self.chosen = lane;
                self.look_at(t);
            }
            Some(Hit::LaneMark { t }) => self.look_at(t),
            None => {}
        }
    }

    fn fold(&mut self, lane: usize) {
        let Some(key) = self.lanes.get(lane).map(|lane| lane.key.clone()) else { return };
        if !self.folded.remove(&key) {
            self.folded.insert(key);
        }
    }

    fn reshape(&mut self, lane: usize) {
        let Some(lane) = self.lanes.get_mut(lane) else { return };
        lane.shape = match lane.shape {
            LaneShape::Marbles => LaneShape::Bars,
            LaneShape::Bars if lane.has_numbers() => LaneShape::Plot,
            LaneShape::Bars | LaneShape::Plot => LaneShape::Marbles,
        };
    }

    fn play_or_rest(&mut self) {
        self.play.goes = !self.play.goes;
        if self.play.goes {
            let is_over = self.cursor >= self.axis.length();
            self.look_at(if is_over && !self.is_live { 0.0 } else { self.cursor });
            self.axis.reveal(self.cursor);
        }
    }

    fn tick(&mut self, passed: f64) {
        let before = self.cursor;
        self.cursor = self.play.tick(self.cursor, passed, self.axis.length());
        // A view that lies elsewhere while it plays stays there; one that has the cursor follows it.
        if self.cursor != before && before <= self.axis.end() {
            self.axis.reveal(self.cursor);
        }
    }
}
