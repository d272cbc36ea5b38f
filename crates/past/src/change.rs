//! The actions that an edited program would have taken with the readings of a past: it is played beside the program that ran, and the moments
//! of both are compared.

use crate::cut::cut;
use crate::hook::Hook;
use crate::matched::{CameMoment, Found, Matched};
use crate::past::Past;
use crate::play::{PlainPlayer, Played, Plays, play};
use crate::program::build;
use crate::stretches::Stretches;
use crate::tape::TapedReading;
use behaviour::{BehaviourFile, Lookup, StreamKind, Value};
use engine::{Claim, Emission, End, Matching, Run, StreamIx};
use protocol::{CHANGED_MOMENTS_MAX, ChangedMoment, ChangedStream, LANES_MAX, MomentChange, NotSeen, PastChanges};
use robot::Millis;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// The most bytes of the streams of an answer as JSON, without their moments.
const STREAMS_MAX_BYTES: usize = 64 << 10;
/// The most bytes of all moments of an answer as JSON.
const MOMENTS_MAX_BYTES: usize = 128 << 10;
/// The parts of a robot whose actions no sense notices.
const UNSENSED: [&str; 2] = ["eyes", "memory of faces"];

/// An edited program, compiled.
pub struct EditedRun {
    file: BehaviourFile,
    run: Run,
}

impl EditedRun {
    /// Compiles an edited program, which ends once the hook says so.
    ///
    /// # Errors
    /// If it cannot run.
    pub fn of(file: BehaviourFile, hook: &Hook) -> Result<Self, NotSeen> {
        let run = build(&file, hook).map_err(NotSeen::CannotCompare)?;
        Ok(Self { file, run })
    }
}

/// The program to which another one is compared.
enum Baseline<'p> {
    /// The program that ran.
    Ran,
    Other(Box<EditedSide<'p>>),
}

impl Past {
    /// Runs the readings since `from_ms` through an edited program, and through the one that ran, or through another edited one,
    /// and compares. The moments of `streams` are told, all are counted.
    ///
    /// # Errors
    /// If more is asked than is answered, or if it cannot be played.
    pub fn compare(
        &self,
        before: Option<EditedRun>,
        now: EditedRun,
        from_ms: Option<u64>,
        streams: &[String],
        hook: &Hook,
    ) -> Result<PastChanges, NotSeen> {
        if streams.len() > LANES_MAX {
            return Err(NotSeen::TooMuch);
        }
        let from_ms = self.moment(from_ms.unwrap_or(self.from_ms))?;
        let from = self.segment_at(from_ms);
        let until_ms = self.until_ms.min(self.closed_ms.max(from_ms));
        let comparing = RefCell::new(ProgramComparison::of(
            self,
            before.as_ref().map(|run| &run.file),
            &now.file,
            (from_ms, streams),
        ));
        let (mut hear_ran, mut hear_before, mut hear_now) = (
            |played: Played| {
                let places = &self.programs[played.program].places;
                comparing.borrow_mut().ran(places, &played.emission);
            },
            |stream: usize, at_ms: u64, value: &Value| comparing.borrow_mut().edited(false, stream, at_ms, value),
            |stream: usize, at_ms: u64, value: &Value| comparing.borrow_mut().edited(true, stream, at_ms, value),
        );
        let is_ran = before.is_none();
        let mut nobody = |_: Played| {};
        let ran = PlainPlayer::at(self, from, hook, if is_ran { &mut hear_ran } else { &mut nobody })?;
        let before = match before {
            Some(before) => Baseline::Other(Box::new(EditedSide::at(self, from, before, &mut hear_before))),
            None => Baseline::Ran,
        };
        let now = EditedSide::at(self, from, now, &mut hear_now);
        let mut both = SideBySide { ran, before, now, comparing: &comparing, told_ms: 0 };
        play(self, from, until_ms, &mut both)?;
        if both.ended() == Some(End::Stopped) {
            return Err(NotSeen::TooLong);
        }
        drop(both);
        Ok(comparing.into_inner().finish(until_ms, self.differs_ms))
    }
}

/// One edited program that is played.
pub(crate) struct EditedSide<'p> {
    run: Run,
    /// By program and stream of what ran the stream that takes its readings.
    takes: Vec<Vec<Option<StreamIx>>>,
    out: &'p mut dyn FnMut(usize, u64, &Value),
}

impl<'p> EditedSide<'p> {
    /// From the beginning of a segment: what did not change keeps what it remembered then.
    pub(crate) fn at(past: &Past, from: usize, edited: EditedRun, out: &'p mut dyn FnMut(usize, u64, &Value)) -> Self {
        let EditedRun { file, mut run } = edited;
        let segment = &past.segments[from];
        if let Some(start) = &segment.start {
            let matching = Matching::between(&past.programs[segment.program].file, &file);
            run.resume_from((**start).clone(), &matching);
        }
        let takes = past.programs.iter().map(|program| takes(&program.file, &file)).collect();
        Self { run, takes, out }
    }

    pub(crate) fn feed(&mut self, program: usize, TapedReading { at_ms, stream, value, .. }: &TapedReading) {
        let Some(to) = self.takes[program].get(stream.index()).copied().flatten() else { return };
        let out = &mut *self.out;
        self.run.feed(Millis(*at_ms), to, value.clone(), &mut |emission| hear(&emission, out));
    }

    pub(crate) fn until(&mut self, at_ms: u64) {
        let out = &mut *self.out;
        self.run.until(Millis(at_ms), &mut |emission| hear(&emission, out));
    }
}

fn hear(emission: &Emission, out: &mut dyn FnMut(usize, u64, &Value)) {
    if let Emission::Value { at, stream, value, by: Some(_) } = emission {
        out(stream.index(), at.0, value);
    }
}

impl EditedSide<'_> {
    /// The reason why it goes no further, if it does not.
    pub(crate) fn ended(&self) -> Option<End> {
        self.run.ended()
    }
}

/// By stream of what ran the stream of an edited program that takes its readings: the one with its id, else the first one of the
/// same sense with the same choices.
fn takes(ran: &BehaviourFile, edited: &BehaviourFile) -> Vec<Option<StreamIx>> {
    let is_sense = |at: &usize| edited.streams[*at].kind == StreamKind::Sensor;
    let ids: Lookup<&str, usize> =
        edited.streams.iter().enumerate().map(|(at, stream)| (stream.id.as_str(), at)).collect();
    let known: BTreeSet<&str> = ran.streams.iter().map(|stream| stream.id.as_str()).collect();
    let to = |stream: &behaviour::FileStream| {
        if stream.kind != StreamKind::Sensor {
            return None;
        }
        let by_id = ids.get(stream.id.as_str()).copied().filter(is_sense);
        let is_same = |at: &usize| {
            let other = &edited.streams[*at];
            is_sense(at)
                && !known.contains(other.id.as_str())
                && (&other.device, &other.params) == (&stream.device, &stream.params)
        };
        by_id.or_else(|| (0..edited.streams.len()).find(is_same)).map(StreamIx::of)
    };
    ran.streams.iter().map(to).collect()
}

/// Both programs, moved by the same readings.
struct SideBySide<'p> {
    ran: PlainPlayer<'p>,
    before: Baseline<'p>,
    now: EditedSide<'p>,
    comparing: &'p RefCell<ProgramComparison>,
    told_ms: u64,
}

impl SideBySide<'_> {
    /// Tells what is decided by now, every now and then.
    fn came_to(&mut self, at_ms: u64) {
        if at_ms >= self.told_ms + 100 {
            self.told_ms = at_ms;
            self.comparing.borrow_mut().until(at_ms);
        }
    }
}

impl Plays for SideBySide<'_> {
    fn feed(&mut self, reading: TapedReading) {
        let (program, at_ms) = (self.ran.program, reading.at_ms);
        self.now.feed(program, &reading);
        match &mut self.before {
            Baseline::Ran => self.ran.feed(reading),
            Baseline::Other(before) => before.feed(program, &reading),
        }
        self.came_to(at_ms);
    }

    fn until(&mut self, at_ms: u64) {
        self.now.until(at_ms);
        match &mut self.before {
            Baseline::Ran => self.ran.until(at_ms),
            Baseline::Other(before) => before.until(at_ms),
        }
        self.came_to(at_ms);
    }

    fn enter(&mut self, past: &Past, segment: usize) -> Result<(), NotSeen> {
        self.ran.program = past.segments[segment].program;
        match &self.before {
            Baseline::Ran => self.ran.enter(past, segment),
            Baseline::Other(_) => Ok(()),
        }
    }

    fn ended(&self) -> Option<End> {
        // One that ended by itself is one that does nothing more; the other goes on.
        let stopped = |run: &Run| run.ended() == Some(End::Stopped);
        let before = match &self.before {
            Baseline::Ran => &self.ran.run,
            Baseline::Other(before) => &before.run,
        };
        (stopped(before) || stopped(&self.now.run)).then_some(End::Stopped)
    }

    fn is_over(&self) -> bool {
        self.ran.is_over()
    }
}

/// The comparison of all streams.
struct ProgramComparison {
    from_ms: u64,
    /// By stream of what ran, among all.
    ran: Vec<usize>,
    /// By stream of the other edited program.
    before: Vec<Option<usize>>,
    /// By stream of the edited program.
    now: Vec<Option<usize>>,
    all: Vec<ComparedStream>,
}

struct ComparedStream {
    told: ChangedStream,
    moves: bool,
    matched: Matched,
    /// The moments, where these are asked for.
    moments: Option<ComparedMoments>,
}

#[derive(Default)]
struct ComparedMoments {
    changed: Vec<ChangedMoment>,
    same_ms: Vec<u64>,
    before: Stretches,
    now: Stretches,
}

impl ProgramComparison {
    fn of(past: &Past, before: Option<&BehaviourFile>, now: &BehaviourFile, (from_ms, told): (u64, &[String])) -> Self {
        let mut comparing = Self { from_ms, ran: Vec::new(), before: Vec::new(), now: Vec::new(), all: Vec::new() };
        let mut places: Lookup<String, usize> = Lookup::new();
        for stream in &past.streams.all {
            let of = past.programs.iter().flat_map(|program| &program.file.streams);
            let claim = of.filter(|known| known.id == stream.stream).any(moves);
            let place = comparing.place(&mut places, &stream.stream, &stream.name, claim);
            comparing.ran.push(place);
        }
        if let Some(file) = before {
            comparing.before = comparing.places(&mut places, file);
        }
        comparing.now = comparing.places(&mut places, now);
        for stream in comparing.all.iter_mut().filter(|one| told.contains(&one.told.stream)) {
            stream.moments = Some(ComparedMoments::default());
        }
        comparing
    }

    /// The places of the streams of an edited program; none of its senses, which are the same.
    fn places(&mut self, places: &mut Lookup<String, usize>, file: &BehaviourFile) -> Vec<Option<usize>> {
        let of = |stream: &behaviour::FileStream| {
            let is_sense = stream.kind == StreamKind::Sensor;
            (!is_sense).then(|| self.place(places, &stream.id, &stream.name, moves(stream)))
        };
        file.streams.iter().map(of).collect()
    }

    fn place(&mut self, places: &mut Lookup<String, usize>, id: &str, name: &str, moves: bool) -> usize {
        if let Some(place) = places.get(id) {
            let known = &mut self.all[*place];
            name.clone_into(&mut known.told.name);
            known.moves |= moves;
            return *place;
        }
        let told = ChangedStream { stream: id.to_owned(), name: name.to_owned(), ..ChangedStream::default() };
        let (matched, moments) = (Matched::default(), None);
        self.all.push(ComparedStream { told, moves, matched, moments });
        places.insert(id.to_owned(), self.all.len() - 1);
        self.all.len() - 1
    }

    fn ran(&mut self, places: &[usize], emission: &Emission) {
        if let Emission::Value { at, stream, value, by: Some(_) } = emission {
            let place = self.ran[places[stream.index()]];
            self.came(place, at.0, value, false);
        }
    }

    fn edited(&mut self, is_now: bool, stream: usize, at_ms: u64, value: &Value) {
        let places = if is_now { &self.now } else { &self.before };
        if let Some(place) = places[stream] {
            self.came(place, at_ms, value, is_now);
        }
    }

    fn came(&mut self, place: usize, at_ms: u64, value: &Value, is_now: bool) {
        if at_ms < self.from_ms {
            return;
        }
        let stream = &mut self.all[place];
        let came = CameMoment { at_ms, value: value.clone() };
        let (told, moments) = (&mut stream.told, &mut stream.moments);
        if let Some(moments) = moments {
            let stretches = if is_now { &mut moments.now } else { &mut moments.before };
            stretches.came(at_ms);
        }
        if is_now {
            told.now += 1;
            stream.matched.now(came, &mut |found| note(told, moments, found));
        } else {
            told.before += 1;
            stream.matched.before(came, &mut |found| note(told, moments, found));
        }
    }

    fn until(&mut self, at_ms: u64) {
        for stream in &mut self.all {
            let (told, moments) = (&mut stream.told, &mut stream.moments);
            stream.matched.until(at_ms, &mut |found| note(told, moments, found));
        }
    }

    fn finish(mut self, until_ms: u64, differs_ms: Option<u64>) -> PastChanges {
        for stream in &mut self.all {
            let (told, moments) = (&mut stream.told, &mut stream.moments);
            std::mem::take(&mut stream.matched).finish(&mut |found| note(told, moments, found));
        }
        let changed = |stream: &ComparedStream| stream.told.same < stream.told.before.max(stream.told.now);
        let open_loop =
            self.all.iter().filter(|one| one.moves && changed(one)).map(|one| one.told.stream.clone()).collect();
        let mut all: Vec<ComparedStream> =
            self.all.into_iter().filter(|one| one.told.before + one.told.now > 0).collect();
        all.sort_by_key(|one| !changed(one));
        let (mut left, mut moments_left) = (STREAMS_MAX_BYTES, MOMENTS_MAX_BYTES);
        let told = |mut one: ComparedStream| {
            left = left.checked_sub(recording::json(&one.told).len() + 1)?;
            if let Some(moments) = one.moments {
                tell(&mut one.told, moments, &mut moments_left);
            }
            Some(one.told)
        };
        let streams = all.into_iter().map_while(told).collect();
        let differs_ms = differs_ms.filter(|differs_ms| *differs_ms <= until_ms);
        PastChanges { from_ms: self.from_ms, until_ms, streams, open_loop, differs_ms }
    }
}

/// Tells the moments of a stream as far as there is room: stretches are few, and times are short.
fn tell(told: &mut ChangedStream, mut moments: ComparedMoments, left: &mut usize) {
    let mut has_room = |bytes: usize| {
        let rest = left.checked_sub(bytes);
        *left = rest.unwrap_or(*left);
        rest.is_some()
    };
    let stretches = (moments.before.finish(), moments.now.finish());
    if has_room(recording::json(&stretches).len()) {
        (told.came_before, told.comes_now) = stretches;
    }
    moments.same_ms.sort_unstable();
    if has_room(recording::json(&moments.same_ms).len()) {
        told.same_ms = moments.same_ms;
    }
    moments.changed.sort_by_key(|moment| moment.t);
    told.moments = moments.changed;
    told.moments.retain(|moment| fits(left, moment));
    let all = told.before + told.now - 2 * told.same - told.moved;
    told.more = (told.moments.len() as u64) < all;
}

fn fits(left: &mut usize, moment: &ChangedMoment) -> bool {
    let rest = left.checked_sub(recording::json(moment).len() + 1);
    *left = rest.unwrap_or(*left);
    rest.is_some()
}

/// Counts what was found, and keeps it as far as there is room.
fn note(told: &mut ChangedStream, moments: &mut Option<ComparedMoments>, found: Found) {
    match found {
        Found::Same(t) => {
            told.same += 1;
            if let Some(moments) = moments.as_mut().filter(|all| all.same_ms.len() < CHANGED_MOMENTS_MAX) {
                moments.same_ms.push(t);
            }
        }
        Found::Other(t, value, what) => {
            told.moved += u64::from(matches!(what, MomentChange::MovedTo(_)));
            if let Some(moments) = moments.as_mut().filter(|all| all.changed.len() < CHANGED_MOMENTS_MAX) {
                moments.changed.push(ChangedMoment { t, value: cut(&value), what });
            }
        }
    }
}

/// True if a stream is of an action that moves the robot, or is heard, so that its senses notice it.
fn moves(stream: &behaviour::FileStream) -> bool {
    stream.kind == StreamKind::Actuator
        && Claim::of(stream).resources.iter().any(|part| !UNSENSED.contains(&part.as_str()))
}
