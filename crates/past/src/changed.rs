//! The streams of two programs that are played with the same readings, moment by moment and bar by bar.

use crate::bars::{ActionBar, FoundBar, GoesOn, MatchedBars};
use crate::cut::cut;
use crate::matched::{CameMoment, Found, Matched};
use crate::past::Past;
use crate::stretches::Stretches;
use behaviour::{BehaviourFile, FileStream, Lookup, StreamKind, Value};
use engine::{Claim, Emission};
use protocol::{CHANGED_MOMENTS_MAX, ChangedMoment, ChangedStream, MomentChange, PastChanges};

/// The most bytes of the streams of an answer as JSON, without their moments.
const STREAMS_MAX_BYTES: usize = 64 << 10;
/// The most bytes of all moments of an answer as JSON.
const MOMENTS_MAX_BYTES: usize = 128 << 10;
/// The parts of a robot whose actions no sense notices.
const UNSENSED: [&str; 2] = ["eyes", "memory of faces"];

/// The comparison of all streams.
pub(crate) struct ProgramComparison {
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
    matching: StreamMatching,
    /// The moments, where these are asked for.
    moments: Option<ComparedMoments>,
}

/// The bars of both runs of a stream that wait for their twins.
enum StreamMatching {
    Moments(Matched),
    /// An action that goes on for a while.
    Bars(Box<MatchedBars>),
}

struct ComparedMoments {
    changed: Vec<ChangedMoment>,
    same_ms: Vec<u64>,
    before: Stretches,
    now: Stretches,
}

impl ProgramComparison {
    /// Of a past and an edited program, or of two edited programs; the moments of the streams `told` are kept.
    pub(crate) fn of(
        past: &Past,
        before: Option<&BehaviourFile>,
        now: &BehaviourFile,
        (from_ms, told): (u64, &[String]),
    ) -> Self {
        let mut comparing = Self { from_ms, ran: Vec::new(), before: Vec::new(), now: Vec::new(), all: Vec::new() };
        let mut places: Lookup<String, usize> = Lookup::new();
        let mut files = past.programs.iter().map(|program| &program.file);
        for stream in &past.streams.all {
            let of = files.clone().flat_map(|file| &file.streams).filter(|known| known.id == stream.stream);
            let place = comparing.place(&mut places, &stream.stream, &stream.name, of);
            comparing.ran.push(place);
        }
        if let Some(file) = before {
            comparing.before = comparing.places(&mut places, file);
        }
        comparing.now = comparing.places(&mut places, now);
        let last = before.or(files.next_back());
        for stream in &mut comparing.all {
            stream.told.other_settings = last.is_some_and(|last| has_other_settings(&stream.told.stream, last, now));
            if told.contains(&stream.told.stream) {
                stream.moments = Some(ComparedMoments::of(&stream.matching));
            }
        }
        comparing
    }

    /// The places of the streams of an edited program; none of its senses, which are the same.
    fn places(&mut self, places: &mut Lookup<String, usize>, file: &BehaviourFile) -> Vec<Option<usize>> {
        let of = |stream: &FileStream| {
            let is_sense = stream.kind == StreamKind::Sensor;
            (!is_sense).then(|| self.place(places, &stream.id, &stream.name, std::iter::once(stream)))
        };
        file.streams.iter().map(of).collect()
    }

    fn place<'f>(
        &mut self,
        places: &mut Lookup<String, usize>,
        id: &str,
        name: &str,
        of: impl Iterator<Item = &'f FileStream>,
    ) -> usize {
        let (mut does, mut goes_on) = (false, None);
        for stream in of {
            (does, goes_on) = (does || moves(stream), GoesOn::of(stream));
        }
        let bars = goes_on.map(|goes_on| StreamMatching::Bars(Box::new(MatchedBars::of(goes_on))));
        let matching = bars.unwrap_or_else(|| StreamMatching::Moments(Matched::default()));
        if let Some(place) = places.get(id) {
            let known = &mut self.all[*place];
            name.clone_into(&mut known.told.name);
            known.moves |= does;
            known.matching = matching;
            return *place;
        }
        let told = ChangedStream { stream: id.to_owned(), name: name.to_owned(), ..ChangedStream::default() };
        self.all.push(ComparedStream { told, moves: does, matching, moments: None });
        places.insert(id.to_owned(), self.all.len() - 1);
        self.all.len() - 1
    }

    /// The program that ran gives something.
    pub(crate) fn ran(&mut self, places: &[usize], emission: &Emission) {
        if let Emission::Value { at, stream, value, by: Some(_) } = emission {
            let place = self.ran[places[stream.index()]];
            self.came(place, at.0, value, false);
        }
    }

    /// An edited program gives something: the new one, or the one to which that is compared.
    pub(crate) fn edited(&mut self, is_now: bool, stream: usize, at_ms: u64, value: &Value) {
        let places = if is_now { &self.now } else { &self.before };
        if let Some(place) = places[stream] {
            self.came(place, at_ms, value, is_now);
        }
    }

    fn came(&mut self, place: usize, at_ms: u64, value: &Value, is_now: bool) {
        if at_ms >= self.from_ms {
            self.all[place].came(at_ms, value, is_now);
        }
    }

    /// Both programs have come to this time: what is decided by now is told.
    pub(crate) fn until(&mut self, at_ms: u64) {
        for ComparedStream { told, matching, moments, .. } in &mut self.all {
            match matching {
                StreamMatching::Moments(all) => all.until(at_ms, &mut |found| note(told, moments, found)),
                StreamMatching::Bars(all) => all.until(at_ms, &mut |found| note_bar(told, moments, found)),
            }
        }
    }

    /// Nothing more comes.
    pub(crate) fn finish(self, until_ms: u64, differs_ms: Option<u64>) -> PastChanges {
        let mut all: Vec<ComparedStream> = self.all.into_iter().map(ComparedStream::finish).collect();
        let open_loop =
            all.iter().filter(|one| one.moves && one.changes()).map(|one| one.told.stream.clone()).collect();
        all.retain(|one| one.told.before + one.told.now > 0);
        all.sort_by_key(|one| !one.changes());
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
        PastChanges { from_ms: self.from_ms, until_ms, streams, open_loop, differs_ms, limits: Vec::new() }
    }
}

impl ComparedStream {
    fn came(&mut self, at_ms: u64, value: &Value, is_now: bool) {
        let Self { told, matching, moments, .. } = self;
        let all = match matching {
            StreamMatching::Bars(all) => return all.came(at_ms, value, is_now),
            StreamMatching::Moments(all) => all,
        };
        if let Some(moments) = moments {
            moments.of_side(is_now).came(at_ms);
        }
        let came = CameMoment { at_ms, value: value.clone() };
        if is_now {
            told.now += 1;
            all.now(came, &mut |found| note(told, moments, found));
        } else {
            told.before += 1;
            all.before(came, &mut |found| note(told, moments, found));
        }
    }

    fn finish(self) -> Self {
        let Self { mut told, moves, matching, mut moments } = self;
        match matching {
            StreamMatching::Moments(all) => all.finish(&mut |found| note(&mut told, &mut moments, found)),
            StreamMatching::Bars(all) => all.finish(&mut |found| note_bar(&mut told, &mut moments, found)),
        }
        Self { told, moves, matching: StreamMatching::Moments(Matched::default()), moments }
    }

    fn changes(&self) -> bool {
        let ChangedStream { same, before, now, other_numbers, other_settings, .. } = &self.told;
        same < before.max(now) || *other_numbers > 0 || *other_settings
    }
}

impl ComparedMoments {
    fn of(matching: &StreamMatching) -> Self {
        let stretches = || match matching {
            StreamMatching::Moments(_) => Stretches::default(),
            StreamMatching::Bars(_) => Stretches::of_bars(),
        };
        Self { changed: Vec::new(), same_ms: Vec::new(), before: stretches(), now: stretches() }
    }

    fn of_side(&mut self, is_now: bool) -> &mut Stretches {
        if is_now { &mut self.now } else { &mut self.before }
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
    let all = told.before + told.now - 2 * told.same - told.moved + told.other_numbers;
    told.more = (told.moments.len() as u64) < all;
}

fn fits(left: &mut usize, moment: &ChangedMoment) -> bool {
    let rest = left.checked_sub(recording::json(moment).len() + 1);
    *left = rest.unwrap_or(*left);
    rest.is_some()
}

/// Counts a moment that was found, and keeps it as far as there is room.
fn note(told: &mut ChangedStream, moments: &mut Option<ComparedMoments>, found: Found) {
    match found {
        Found::Same(t) => same(told, moments, t),
        Found::Other(t, value, what) => {
            other(told, moments, ChangedMoment { t, value, what, until: None, until_now: None })
        }
    }
}

/// Counts a bar that was found, and keeps it as far as there is room.
fn note_bar(told: &mut ChangedStream, moments: &mut Option<ComparedMoments>, found: FoundBar) {
    let (before, now) = match &found {
        FoundBar::Same(before, now, _) | FoundBar::Moved(before, now) => (Some(before), Some(now)),
        FoundBar::OnlyBefore(before) => (Some(before), None),
        FoundBar::OnlyNow(now) => (None, Some(now)),
    };
    for (bar, is_now) in [(before, false), (now, true)] {
        let Some(ActionBar { from_ms, until_ms, .. }) = bar else { continue };
        *(if is_now { &mut told.now } else { &mut told.before }) += 1;
        if let Some(moments) = moments {
            moments.of_side(is_now).bar((*from_ms, *until_ms));
        }
    }
    let changed = |ActionBar { from_ms: t, until_ms, value }: ActionBar, what| {
        let until = Some(until_ms).filter(|until_ms| *until_ms > t);
        ChangedMoment { t, value, what, until, until_now: None }
    };
    match found {
        FoundBar::Same(before, _, has_other_numbers) => {
            same(told, moments, before.from_ms);
            if has_other_numbers {
                told.other_numbers += 1;
                other(told, moments, changed(before, MomentChange::OtherNumbers));
            }
        }
        FoundBar::Moved(before, now) => {
            let until_now = Some(now.until_ms).filter(|until_ms| *until_ms > now.from_ms);
            let moved = changed(before, MomentChange::MovedTo(now.from_ms));
            other(told, moments, ChangedMoment { until_now, ..moved });
        }
        FoundBar::OnlyBefore(bar) => other(told, moments, changed(bar, MomentChange::OnlyBefore)),
        FoundBar::OnlyNow(bar) => other(told, moments, changed(bar, MomentChange::OnlyNow)),
    }
}

fn same(told: &mut ChangedStream, moments: &mut Option<ComparedMoments>, t: u64) {
    told.same += 1;
    if let Some(moments) = moments.as_mut().filter(|all| all.same_ms.len() < CHANGED_MOMENTS_MAX) {
        moments.same_ms.push(t);
    }
}

fn other(told: &mut ChangedStream, moments: &mut Option<ComparedMoments>, moment: ChangedMoment) {
    told.moved += u64::from(matches!(moment.what, MomentChange::MovedTo(_)));
    told.first_ms = Some(told.first_ms.map_or(moment.t, |first_ms| first_ms.min(moment.t)));
    if let Some(moments) = moments.as_mut().filter(|all| all.changed.len() < CHANGED_MOMENTS_MAX) {
        moments.changed.push(ChangedMoment { value: cut(&moment.value), ..moment });
    }
}

/// True if an action of both programs has other settings now.
fn has_other_settings(id: &str, before: &BehaviourFile, now: &BehaviourFile) -> bool {
    let find = |file: &BehaviourFile| {
        let mut actions = file.streams.iter().filter(|stream| stream.kind == StreamKind::Actuator);
        actions
            .find(|stream| stream.id == id)
            .map(|stream| (stream.device.clone(), stream.params.clone().unwrap_or_default()))
    };
    find(before).zip(find(now)).is_some_and(|(before, now)| before != now)
}

/// True if a stream is of an action that moves the robot, or is heard, so that its senses notice it.
fn moves(stream: &FileStream) -> bool {
    stream.kind == StreamKind::Actuator
        && Claim::of(stream).resources.iter().any(|part| !UNSENSED.contains(&part.as_str()))
}
