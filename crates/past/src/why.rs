//! Why a value came, and why another one did not, with sentences.

use crate::answer::unit_of;
use crate::cut::cut;
use crate::fix::FixTrials;
use crate::hook::Hook;
use crate::miss::{BlockedWay, NearestMisses};
use crate::past::{Past, fitting};
use crate::play::{TracedPlayer, play};
use crate::program::PlayedProgram;
use behaviour::{Helper, Id, Knowledge};
use causes::Cause;
use engine::StreamIx;
use protocol::{NotSeen, NumberFix, ToldWhy, Why, WhyNot, WhySentence, WhyWith};
use recording::SinceStart;
use robot::Millis;
use sentences::{AnswerSentence, Answers, Language};
use std::sync::Arc;

/// The most steps of an answer with all that they used, so that it fits into a message.
const STEPS_MAX: usize = 100;
/// The most other values of one step.
const WITH_MAX: usize = 8;
/// The most bytes of an answer as JSON; of a longer one the last steps are left out.
const WHY_MAX_BYTES: usize = 160 << 10;

impl Past {
    /// Keeps the moments from which causes are told quickly: plays all with a tracer.
    ///
    /// # Errors
    /// If it cannot be played, or if the hook ended it.
    pub fn trace(&self, hook: &Hook) -> Result<(), NotSeen> {
        let mut nobody = |_: &Arc<Cause>| {};
        let last = self.segments.len() - 1;
        let (at, mut player) = TracedPlayer::before(self, last, hook, &mut nobody)?;
        play(self, at, self.segments[last].starts_ms, &mut player)
    }

    /// Tells why the `nth` value came on a stream at a time.
    ///
    /// # Errors
    /// If no such value came, or if it cannot be played.
    pub fn why(
        &self,
        (stream, at_ms, nth): (&str, u64, usize),
        language: Language,
        knowledge: &dyn Knowledge,
        hook: &Hook,
    ) -> Result<ToldWhy<Why>, NotSeen> {
        if at_ms > self.until_ms || at_ms < self.from_ms {
            return Err(NotSeen::NoValue);
        }
        let (program, at) = self.stream_then(stream, at_ms)?;
        let mut came = SoughtValue { stream: at, from_ms: at_ms, until_ms: at_ms, left: nth, found: None, first: None };
        let mut hear = |cause: &Arc<Cause>| came.hear(cause);
        let (from, mut player) = TracedPlayer::before(self, self.segment_at(at_ms), hook, &mut hear)?;
        play(self, from, at_ms, &mut player)?;
        let traced = player.traced;
        let cause = came.found.ok_or(NotSeen::NoValue)?;
        let mut why = traced.tracer().tell(&cause);
        shorten(&mut why);
        let answers = &mut |answers: &Answers| answers.why(&why).into_iter().map(|said| said_of(said, None)).collect();
        let mut sentences = told(&self.programs[program], language, knowledge, answers);
        let many = fitting(&why.steps, WHY_MAX_BYTES).len().max(1);
        why.steps.truncate(many);
        sentences.truncate(many);
        Ok(ToldWhy { program, why, sentences, lost: self.lost_until(at_ms) })
    }

    /// Tells why nothing came on a stream in a time. Of all values that a test with numbers kept back in it, the one that was
    /// nearest to passing is told, and the nearest miss of all ways first.
    ///
    /// # Errors
    /// If something came, or if it cannot be played.
    pub fn why_not(
        &self,
        (stream, from_ms, until_ms): (&str, u64, u64),
        language: Language,
        knowledge: &dyn Knowledge,
        hook: &Hook,
    ) -> Result<ToldWhy<WhyNot>, NotSeen> {
        if from_ms > until_ms {
            return Err(NotSeen::NoTime);
        }
        let until_ms = self.moment(until_ms)?;
        if from_ms > until_ms {
            return Err(NotSeen::NoTime);
        }
        let (program, at) = self.stream_then(stream, until_ms)?;
        let mut came = SoughtValue { stream: at, from_ms, until_ms, left: usize::MAX, found: None, first: None };
        let mut hear = |cause: &Arc<Cause>| came.hear(cause);
        let (from, mut player) = TracedPlayer::before(self, self.segment_at(from_ms), hook, &mut hear)?;
        player.gather(self, from, NearestMisses::of(self, program, from_ms));
        play(self, from, until_ms, &mut player)?;
        let mut why = player.traced.why_not(at, Millis(from_ms));
        let misses = player.take_misses();
        drop(player);
        if let Some(at_ms) = came.first {
            return Err(NotSeen::Came(at_ms));
        }
        let file = &self.programs[program].file;
        let mut ways = misses.map(|misses| misses.ways(file, &why)).unwrap_or_default();
        ways.truncate(STEPS_MAX);
        let asked = (stream, from_ms, until_ms);
        let answers = &mut |answers: &Answers| {
            let mut trials = FixTrials::of(self, asked, hook);
            let fixes: Vec<_> = ways.iter_mut().map(|way| trials.choose(answers, way)).collect();
            why.blocked = ways.iter().filter_map(BlockedWay::told).collect();
            let fixes = fixes.into_iter().chain(std::iter::repeat(None));
            answers.why_not(&why).into_iter().zip(fixes).map(|(said, fix)| said_of(said, fix)).collect()
        };
        let sentences = told(&self.programs[program], language, knowledge, answers);
        why.blocked = ways.iter().filter_map(BlockedWay::told).collect();
        Ok(ToldWhy { program, why, sentences, lost: self.lost_until(until_ms) })
    }

    /// The program that ran at a time, and the place of a stream in it.
    fn stream_then(&self, stream: &str, at_ms: u64) -> Result<(usize, StreamIx), NotSeen> {
        let program = self.program_at(at_ms);
        let place = self.programs[program].file.streams.iter().position(|known| known.id == stream);
        let at = place.map(StreamIx::of).ok_or_else(|| NotSeen::NoStream(stream.to_owned()))?;
        Ok((program, at))
    }
}

/// The value that is asked for, among all that come.
struct SoughtValue {
    stream: StreamIx,
    from_ms: u64,
    until_ms: u64,
    left: usize,
    found: Option<Arc<Cause>>,
    /// The time at which the first one came.
    first: Option<u64>,
}

impl SoughtValue {
    fn hear(&mut self, cause: &Arc<Cause>) {
        let at_ms = cause.at().0;
        if cause.stream() != self.stream || at_ms < self.from_ms || at_ms > self.until_ms {
            return;
        }
        self.first.get_or_insert(at_ms);
        if self.found.is_none() {
            match self.left.checked_sub(1) {
                Some(left) => self.left = left,
                None => self.found = Some(Arc::clone(cause)),
            }
        }
    }
}

fn shorten(why: &mut Why) {
    why.value = cut(&why.value);
    why.steps.truncate(STEPS_MAX);
    for step in &mut why.steps {
        step.value = cut(&step.value);
        step.with.truncate(WITH_MAX);
        for with in &mut step.with {
            let (WhyWith::Value { value, .. } | WhyWith::Memory { memory: value, .. }) = with;
            *value = cut(value);
        }
    }
}

/// The sentences of an answer; none if the program is one of which none can be told.
fn told(
    program: &PlayedProgram,
    language: Language,
    knowledge: &dyn Knowledge,
    say: &mut dyn FnMut(&Answers) -> Vec<WhySentence>,
) -> Vec<WhySentence> {
    let Ok(behaviour) = program.file.records(|_| None) else { return Vec::new() };
    let library = program.file.library();
    let helpers: Vec<&Helper> = library.iter().collect();
    let clock = |ms: u64| SinceStart(ms).to_string();
    let types = behaviour::infer(&behaviour, &helpers, knowledge);
    let unit = |id: &Id| unit_of(types.get(id));
    let answers = Answers::of(&behaviour, &helpers, &unit, &clock, language);
    say(&answers)
}

fn said_of(AnswerSentence { text, stream, t }: AnswerSentence, fix: Option<NumberFix>) -> WhySentence {
    WhySentence { text, stream, t, fix }
}
