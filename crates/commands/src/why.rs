//! `rrp why`: why a value came, and why an action did not.

mod no_answer;
mod tell;

use crate::LineCommand;
use crate::failure::Failure;
use crate::program::read_program;
use crate::replay::{ReplayMode, ReplayRefused, chosen_engine, parse_trace, refused};
use crate::trace::read_trace;
use behaviour::{BehaviourFile, FileStream, StreamKind};
use causes::{Cause, Stretch, Traced};
use clap::Args;
use engine::{Limits, Run, StreamIx};
use no_answer::WhyFailure;
use recording::{Different, open};
use robot::Millis;
use sentences::Language;
use server::PageFiles;
use shell::{Moment, Ran};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// The most milliseconds between a moment that people say and the value.
const NEAR_MS: u64 = 1_000;
/// The milliseconds before a moment in which nothing came, if nobody says from when.
const NOT_MS: u64 = 2_000;

/// Tells why a value came: the value that triggered it, and so on back to what was sensed.
///
/// With --not it tells why nothing came: the connectors that kept a value back, the nearest first.
///
/// Asked is a recording, which has its own program, or a program with a trace. Times are milliseconds since Start (4200),
/// minutes and seconds since Start (0:04.2), or of a recording the time of day, as its first line counts it or in another zone
/// (12:04:17.2); of a time that people wrote the nearest value within a second counts.
///
/// Exit codes: 0 told; 1 there is no such value, stream or recording; 2 the behaviour is refused; 3 the trace is refused.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp why greet.jsonl --action Say --at 12:04:17.2
  rrp why greet.jsonl --action Say --not --at 0:12.5 --language ja
  rrp why --behaviour tracking.json --trace morning.jsonl --stream close-ball --at 4200 --json
  rrp why --behaviour tracking.json --trace morning.jsonl --stream head --not --from 4000 --until 5000 --json")]
pub(crate) struct WhyArgs {
    /// The recording, as it was downloaded; - reads standard input.
    #[arg(value_name = "FILE|-", required_unless_present = "behaviour", conflicts_with_all = ["behaviour", "trace", "mode", "frame_ms"])]
    recording: Option<PathBuf>,
    /// The behaviour, rrp-behaviour/1 as JSON or XML, instead of a recording.
    #[arg(long, value_name = "FILE", requires = "trace")]
    behaviour: Option<PathBuf>,
    /// The readings for it, one JSON object a line; - reads standard input.
    #[arg(long, value_name = "FILE|-", requires = "behaviour")]
    trace: Option<PathBuf>,
    /// The way in which time runs; the one of the behaviour if absent.
    #[arg(long, value_enum)]
    mode: Option<ReplayMode>,
    /// The length of a frame in milliseconds, in frame mode.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    frame_ms: Option<u64>,
    /// The stream whose value is asked for, by its id.
    #[arg(long, value_name = "ID", required_unless_present = "action", conflicts_with = "action")]
    stream: Option<String>,
    /// The action that is asked for, by its name.
    #[arg(long, value_name = "NAME")]
    action: Option<String>,
    /// When it came; with --not, the end of the two seconds in which it did not.
    #[arg(long, value_name = "TIME", required_unless_present = "until")]
    at: Option<Moment>,
    /// Of several values at that time which one, from 0.
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with = "not")]
    nth: usize,
    /// Tells why nothing came.
    #[arg(long)]
    not: bool,
    /// From when nothing came.
    #[arg(long, value_name = "TIME", requires_all = ["until", "not"], conflicts_with = "at")]
    from: Option<Moment>,
    /// Until when nothing came.
    #[arg(long, value_name = "TIME", requires_all = ["from", "not"], conflicts_with = "at")]
    until: Option<Moment>,
    /// Prints one line of JSON.
    #[arg(long)]
    json: bool,
    /// The language of the sentences: en or ja.
    #[arg(long, value_name = "LANGUAGE", default_value = "en", conflicts_with = "json")]
    language: Language,
}

impl LineCommand for WhyArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp why greet.jsonl --action Say --at 1:04.2"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        why(&self)
    }
}

/// The run, played up to the moment that is asked about.
struct PlayedRun {
    traced: Traced,
    stretch: Stretch,
    /// Lines that are missing.
    lost: u64,
}

/// The stretch that is asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct AskedStretch {
    from_ms: u64,
    until_ms: u64,
    /// The most milliseconds between it and a value.
    near_ms: u64,
}

/// Tells, and answers with the exit code.
fn why(args: &WhyArgs) -> ExitCode {
    let outcome = match (&args.recording, &args.behaviour, &args.trace) {
        (Some(recording), ..) => of_recording(args, recording),
        (None, Some(behaviour), Some(trace)) => of_trace(args, behaviour, trace),
        (None, ..) => Err(WhyOutcome::No(WhyFailure::NoClock)),
    };
    match outcome.and_then(|(asked, played)| answer(args, asked, played)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(WhyOutcome::No(why)) => crate::failed(&[Failure::of(why)], 1),
        Err(WhyOutcome::Failed(failures, code)) => crate::failed(&failures, code),
        Err(WhyOutcome::Refused(refusal)) => refused(refusal),
    }
}

/// Why nothing was told.
enum WhyOutcome {
    No(WhyFailure),
    Failed(Vec<Failure>, u8),
    Refused(ReplayRefused),
}

impl From<WhyFailure> for WhyOutcome {
    fn from(why: WhyFailure) -> Self {
        Self::No(why)
    }
}

impl From<ReplayRefused> for WhyOutcome {
    fn from(refusal: ReplayRefused) -> Self {
        Self::Refused(refusal)
    }
}

fn of_recording(args: &WhyArgs, path: &Path) -> Result<(AskedStretch, PlayedRun), WhyOutcome> {
    let text = read_trace(path).map_err(|failure| WhyOutcome::Failed(vec![failure], 3))?;
    let unplayed = |why: Different| WhyOutcome::No(WhyFailure::Unplayed(why));
    let run = ran(&text).ok_or_else(|| unplayed(Different::NoRecording))?;
    let asked = asked(args, &run)?;
    let stretch = asked.stretch();
    let past = recording::past(&text, stretch, &|stream| is_it(args, stream)).map_err(unplayed)?;
    Ok((asked, PlayedRun { traced: past.traced, stretch: past.stretch, lost: past.lost }))
}

/// When a recording was running; none if the text is none.
fn ran(text: &str) -> Option<Ran> {
    let (header, lines) = open(text).ok()?;
    let until_ms = lines.lines().filter_map(|(_, line)| time_of(line)).max().unwrap_or(0);
    Some(Ran::of(&header.began, until_ms))
}

/// The time of a line, found without reading all of it.
fn time_of(line: &str) -> Option<u64> {
    let rest = line.strip_prefix(r#"{"t":"#)?;
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    rest[..digits].parse().ok()
}

fn of_trace(args: &WhyArgs, behaviour: &Path, trace: &Path) -> Result<(AskedStretch, PlayedRun), WhyOutcome> {
    let asked = asked(args, &Ran::default())?;
    let mut file = read_program(behaviour).map_err(|failure| ReplayRefused::Behaviour(vec![failure]))?;
    file.engine = Some(chosen_engine(args.mode, args.frame_ms, file.engine.unwrap_or_default()));
    let run = Run::build(&file, Limits::default()).map_err(ReplayRefused::engine)?;
    let text = read_trace(trace).map_err(ReplayRefused::Trace)?;
    let readings = parse_trace(&text, &run).map_err(ReplayRefused::Trace)?;
    let mut stretch = asked.stretch();
    stretch.stream = file.streams.iter().position(|stream| is_it(args, stream)).map(StreamIx::of);
    let mut traced = Traced::of(file, run);
    if stretch.stream.is_some() {
        traced.play(readings, &mut stretch);
    }
    Ok((asked, PlayedRun { traced, stretch, lost: 0 }))
}

/// The stretch that the words on the command line ask about.
fn asked(args: &WhyArgs, run: &Ran) -> Result<AskedStretch, WhyFailure> {
    let within = |moment: &Moment| moment.within(run).map_err(WhyFailure::from);
    if let (Some(from), Some(until)) = (&args.from, &args.until) {
        let ((from_ms, _), (_, until_ms)) = (within(from)?, within(until)?);
        return if from_ms <= until_ms {
            Ok(AskedStretch { from_ms, until_ms, near_ms: 0 })
        } else {
            Err(WhyFailure::Backwards)
        };
    }
    let Some(at) = &args.at else { return Err(WhyFailure::Backwards) };
    let (from_ms, until_ms) = within(at)?;
    if args.not {
        return Ok(AskedStretch { from_ms: from_ms.saturating_sub(NOT_MS), until_ms, near_ms: 0 });
    }
    Ok(AskedStretch { from_ms, until_ms, near_ms: if at.is_exact() { 0 } else { NEAR_MS } })
}

impl AskedStretch {
    fn stretch(self) -> Stretch {
        let from = Millis(self.from_ms.saturating_sub(self.near_ms));
        Stretch::of(from, Millis(self.until_ms.saturating_add(self.near_ms)))
    }

    /// The milliseconds between a time and the stretch.
    fn distance(self, at: Millis) -> u64 {
        self.from_ms.saturating_sub(at.0) + at.0.saturating_sub(self.until_ms)
    }
}

/// Tells if a stream is the one that is asked for.
fn is_it(args: &WhyArgs, stream: &FileStream) -> bool {
    match (&args.stream, &args.action) {
        (Some(id), _) => stream.id == *id,
        (None, Some(name)) => {
            stream.kind == StreamKind::Actuator && stream.name.trim().to_lowercase() == name.trim().to_lowercase()
        }
        (None, None) => false,
    }
}

fn answer(args: &WhyArgs, asked: AskedStretch, played: PlayedRun) -> Result<(), WhyOutcome> {
    let PlayedRun { mut traced, stretch, lost } = played;
    let Some(stream) = stretch.stream else { return Err(unknown(args, traced.file()).into()) };
    let fault = traced.run().fault();
    let told = if args.not {
        if let (false, Some(came)) = (args.json, stretch.values.front()) {
            return Err(WhyFailure::Came { stream: name(traced.file(), stream), at_ms: came.at().0 }.into());
        }
        tell::ToldAnswer::Not(traced.why_not(stream, Millis(asked.from_ms)))
    } else {
        let found = nth(args.nth, asked, &stretch);
        let missing = || WhyFailure::NoValue {
            stream: name(traced.file(), stream),
            at_ms: asked.from_ms,
            count: stretch.values.iter().filter(|cause| asked.distance(cause.at()) == 0).count(),
            before_ms: stretch.before.map(|at| at.0),
        };
        tell::ToldAnswer::Why(traced.tracer().tell(found.ok_or_else(missing)?))
    };
    tell::warn(lost, fault);
    tell::tell(&told, traced.file(), args.json, args.language).map_err(|failures| WhyOutcome::Failed(failures, 1))
}

/// The value of that number among those that came when it was asked; else the nearest one.
fn nth(nth: usize, asked: AskedStretch, stretch: &Stretch) -> Option<&Arc<Cause>> {
    let then: Vec<&Arc<Cause>> = stretch.values.iter().filter(|cause| asked.distance(cause.at()) == 0).collect();
    if then.is_empty() && nth == 0 {
        return stretch.values.iter().min_by_key(|cause| asked.distance(cause.at()));
    }
    then.get(nth).copied()
}

fn name(file: &BehaviourFile, stream: StreamIx) -> String {
    file.streams[stream.index()].name.clone()
}

fn unknown(args: &WhyArgs, file: &BehaviourFile) -> WhyFailure {
    let is_action = args.action.is_some();
    let known = file.streams.iter().filter(|stream| !is_action || stream.kind == StreamKind::Actuator);
    let names = known.map(|stream| if is_action { stream.name.clone() } else { stream.id.clone() }).collect();
    let wanted = args.action.clone().or(args.stream.clone()).unwrap_or_default();
    WhyFailure::NoStream { wanted, is_action, names }
}
