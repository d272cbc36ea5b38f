//! `rrp replay`: recorded traces through behaviours, faster than real time, always with the same output.

mod check;
mod play;
mod printer;
mod recording;

use crate::LineCommand;
use crate::failure::Failure;
use crate::program::read_program;
use crate::trace::{TraceReading, parse_lines, read_trace};
use behaviour::{BehaviourFile, Engine};
use clap::{Args, ValueEnum};
use engine::{Limits, Run};
use play::{Player, play};
use printer::Printer;
use robot::Millis;
use server::PageFiles;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The length of a frame if nobody says one.
const FRAME_MS: u64 = 50;

/// Replays a trace through a behaviour and prints what its actuators are told, as JSON lines.
///
/// Several behaviours run side by side from instant 0 on; with --arbitrate, the one that is named first wins the parts of
/// the robot. Each line then says by its number whose it is: "behaviour":1 is the first one.
///
/// With --check a recording is replayed alone, through the program that it has, and compared with what the robot was told.
///
/// Exit codes: 0 done; 1 a checked recording differs; 2 a behaviour is refused; 3 a trace is refused; 4 a behaviour ended by
/// itself.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ReplayArgs {
    /// The behaviour, rrp-behaviour/1 as JSON or XML; given several times, the upper one first.
    #[arg(long, value_name = "FILE", required_unless_present = "check")]
    behaviour: Vec<PathBuf>,
    /// The readings, one JSON object a line, or a recording of a run; - reads standard input. One for all behaviours, or
    /// one for each in the same order.
    #[arg(long, value_name = "FILE|-", required_unless_present = "check")]
    trace: Vec<PathBuf>,
    /// A recording to be checked: whether it alone gives its own actions again.
    #[arg(long, value_name = "FILE|-", exclusive = true)]
    check: Option<PathBuf>,
    /// The last instant, in milliseconds since Start; the last one of the trace if absent.
    #[arg(long, value_name = "MS")]
    until: Option<u64>,
    /// Also prints sensor and ordinary streams.
    #[arg(long)]
    probe: bool,
    /// Also prints faults of procedures.
    #[arg(long)]
    errors: bool,
    /// How time runs; what the behaviour says if absent.
    #[arg(long, value_enum)]
    mode: Option<ReplayMode>,
    /// The length of a frame in milliseconds, in frame mode.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    frame_ms: Option<u64>,
    /// Lets actuator streams compete for the parts of the robot, as on the robot: a stream uses what its file says, else
    /// what the catalogue says of its device.
    #[arg(long)]
    arbitrate: bool,
}

const EXAMPLES: &str = "Examples:
  rrp replay --behaviour tracking.json --trace morning.jsonl --probe --errors
  rrp replay --check 2026-11-21T18-34-06Z-greet.jsonl
  rrp replay --arbitrate --behaviour safety.json --behaviour greeting.json --trace morning.jsonl
  rrp replay --arbitrate --behaviour a.json --behaviour b.json --trace a.jsonl --trace b.jsonl";

impl LineCommand for ReplayArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp replay --behaviour tracking.json --trace morning.jsonl"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        replay(&self)
    }
}

/// How time runs.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ReplayMode {
    /// Every reading at its own instant.
    Event,
    /// Readings gathered into frames.
    Frame,
}

/// Why a replay did not happen.
pub(crate) enum ReplayRefused {
    Behaviour(Vec<Failure>),
    Trace(Failure),
}

impl ReplayRefused {
    /// A behaviour that the engine cannot run.
    pub(crate) fn engine(faults: Vec<engine::GraphFault>) -> Self {
        Self::Behaviour(Failure::records(&faults))
    }
}

/// What is replayed.
struct ReplayTrace {
    readings: Vec<TraceReading>,
    /// Up to where a recorded run had closed its instants; nothing later was flushed.
    closed: Option<Millis>,
}

/// Replays, prints, and answers with the exit code.
fn replay(args: &ReplayArgs) -> ExitCode {
    if let Some(path) = &args.check {
        return check::check(path);
    }
    match prepare(args) {
        Ok((files, mut players)) => {
            let printer = Printer::new(args, &files);
            // Whoever reads may have seen enough: a closed pipe ends the replay, and that is no failure.
            let _ = play(&mut players, printer, &mut BufWriter::new(std::io::stdout().lock()));
            let faults: Vec<Failure> = players.iter().filter_map(|player| player.fault()).collect();
            if faults.is_empty() { ExitCode::SUCCESS } else { crate::failed(&faults, 4) }
        }
        Err(reason) => refused(reason),
    }
}

/// Says why, and gives the exit code for it.
pub(crate) fn refused(reason: ReplayRefused) -> ExitCode {
    match reason {
        ReplayRefused::Behaviour(reasons) => crate::failed(&reasons, 2),
        ReplayRefused::Trace(reason) => crate::failed(&[reason], 3),
    }
}

fn prepare(args: &ReplayArgs) -> Result<(Vec<BehaviourFile>, Vec<Player>), ReplayRefused> {
    let read = |path: &PathBuf| read_behaviour(args, path).map_err(|reason| ReplayRefused::Behaviour(vec![reason]));
    let files = args.behaviour.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let build = |file: &BehaviourFile| Run::build(file, Limits::default()).map_err(ReplayRefused::engine);
    let runs = files.iter().map(build).collect::<Result<Vec<_>, _>>()?;
    let traces = traces(args, &runs).map_err(ReplayRefused::Trace)?;
    let player = |((run, trace), file): ((Run, ReplayTrace), &BehaviourFile)| Player::new(args.until, file, run, trace);
    let players = runs.into_iter().zip(traces).zip(&files).map(player).collect();
    Ok((files, players))
}

fn read_behaviour(args: &ReplayArgs, path: &Path) -> Result<BehaviourFile, Failure> {
    let mut file = read_program(path)?;
    file.engine = Some(chosen_engine(args.mode, args.frame_ms, file.engine.unwrap_or_default()));
    Ok(file)
}

/// The engine of a file, or the one that somebody chose instead.
pub(crate) fn chosen_engine(mode: Option<ReplayMode>, frame_ms: Option<u64>, own: Engine) -> Engine {
    let own_ms = if let Engine::Frame { frame_ms } = own { frame_ms } else { FRAME_MS };
    match (mode, own) {
        (Some(ReplayMode::Event), _) | (None, Engine::Event) => Engine::Event,
        (Some(ReplayMode::Frame), _) | (None, Engine::Frame { .. }) => {
            Engine::Frame { frame_ms: frame_ms.unwrap_or(own_ms) }
        }
    }
}

/// The trace of each behaviour.
fn traces(args: &ReplayArgs, runs: &[Run]) -> Result<Vec<ReplayTrace>, Failure> {
    match &args.trace[..] {
        [shared] => {
            let text = read_trace(shared)?;
            let known: Vec<&Run> = runs.iter().collect();
            runs.iter().map(|run| parse(&text, run, &known)).collect()
        }
        each if each.len() == runs.len() => {
            let own = |(path, run): (&PathBuf, &Run)| parse(&read_trace(path)?, run, &[run]);
            each.iter().zip(runs).map(own).collect()
        }
        each => {
            let (traces, behaviours) = (each.len(), runs.len());
            Err(Failure::of(format!("{traces} traces for {behaviours} behaviours; give one for all, or one for each")))
        }
    }
}

/// What a trace has for a run. A plain one may name streams of these runs only.
fn parse(text: &str, run: &Run, known: &[&Run]) -> Result<ReplayTrace, Failure> {
    recording::parse(text, run)
        .unwrap_or_else(|| parse_lines(text, run, known).map(|readings| ReplayTrace { readings, closed: None }))
}

/// The readings of a trace or a recording for the only run that it is for.
pub(crate) fn parse_trace(text: &str, run: &Run) -> Result<Vec<TraceReading>, Failure> {
    parse(text, run, &[run]).map(|trace| trace.readings)
}

#[cfg(test)]
mod tests {
    use super::{Player, Printer, ReplayArgs, ReplayMode, ReplayTrace, parse_trace, play};
    use behaviour::BehaviourFile;
    use engine::{Limits, Run};

    /// Two actuators that want the head; the first one is more important and holds it for 100 ms.
    const TWO: &str = r#"{"format":"rrp-behaviour/1","name":"two","helpers":[],
        "streams":[{"id":"a","kind":"sensor","name":"A"},{"id":"b","kind":"sensor","name":"B"},
            {"id":"y","kind":"actuator","name":"Y","resources":["head"],"priority":1,"holdMs":100},
            {"id":"z","kind":"actuator","name":"Z","resources":["head"]}],
        "connectors":[{"id":"c","type":"subscribe","inputs":["a"],"output":"y"},
            {"id":"d","type":"subscribe","inputs":["b"],"output":"z"}]}"#;
    const TRACE: &str = r#"{"t":0,"stream":"a","value":1}
        {"t":99,"stream":"b","value":2.0}

        {"t":100,"stream":"b","value":{"x":null}}"#;

    fn args() -> ReplayArgs {
        ReplayArgs {
            behaviour: Vec::new(),
            trace: Vec::new(),
            check: None,
            until: None,
            probe: false,
            errors: false,
            mode: Some(ReplayMode::Event),
            frame_ms: None,
            arbitrate: false,
        }
    }

    fn start() -> (BehaviourFile, Run) {
        let file: BehaviourFile = serde_json::from_str(TWO).unwrap();
        let run = Run::build(&file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
        (file, run)
    }

    fn printed(args: &ReplayArgs) -> Vec<String> {
        let (file, run) = start();
        let readings = parse_trace(TRACE, &run).unwrap();
        let mut to = Vec::new();
        let player = Player::new(args.until, &file, run, ReplayTrace { readings, closed: None });
        let files = [file];
        play(&mut [player], Printer::new(args, &files), &mut to).unwrap();
        String::from_utf8(to).unwrap().lines().map(str::to_owned).collect()
    }

    #[test]
    fn actuators_are_printed_and_a_refused_command_says_who_holds() {
        let lines = printed(&ReplayArgs { arbitrate: true, ..args() });
        assert_eq!(
            lines,
            [
                r#"{"t":0,"stream":"y","value":1}"#,
                r#"{"t":99,"stream":"z","value":2.0,"suppressedBy":"y"}"#,
                r#"{"t":100,"stream":"z","value":{"x":null}}"#
            ]
        );
    }

    #[test]
    fn until_ends_it_and_probe_shows_all_streams() {
        assert_eq!(printed(&ReplayArgs { until: Some(99), ..args() }).len(), 2);
        assert_eq!(printed(&ReplayArgs { until: Some(99), probe: true, ..args() }).len(), 4);
    }

    const READINGS: &str = "trace line 1: this is no reading. Write one JSON object a line, such as \
        {\"t\":500,\"stream\":\"ball\",\"value\":1}: t in milliseconds since Start, stream the id of a sensor";

    #[test]
    fn a_trace_that_makes_no_sense_is_refused_with_its_line() {
        let (_, run) = start();
        let cases = [
            ("{}", "trace line 1: t is missing; it is the time in whole milliseconds since Start, such as 500"),
            (
                r#"{"t":"0","stream":"a","value":1}"#,
                "trace line 1: t must be a whole number of milliseconds since Start, such as 500, without quotes",
            ),
            (
                r#"{"time":0,"stream":"a","value":1}"#,
                "trace line 1: t is missing; write t instead of “time”, in whole milliseconds since Start",
            ),
            (
                r#"{"t":0.5,"stream":"a","value":1}"#,
                "trace line 1: t is 0.5; it counts whole milliseconds since Start. If this is in seconds, write 500",
            ),
            (
                r#"{"t":1732761600000,"stream":"a","value":1}"#,
                "trace line 1: t is 1732761600000, a time since 1970; it counts milliseconds since Start. Take the first \
                 time off every one, so that the first t is 0",
            ),
            (
                r#"{"t":1732761600.25,"stream":"a","value":1}"#,
                "trace line 1: t is 1732761600.25, a time since 1970; it counts milliseconds since Start. Take the first \
                 time off every one, so that the first t is 0",
            ),
            (r#"{"t":-1,"stream":"a","value":1}"#, "trace line 1: t must not be negative"),
            (r#"{"t":1,"stream":"z","value":1}"#, "trace line 1: \"z\" is no sensor stream"),
            (r#"{"t":1,"stream":"q","value":1}"#, "trace line 1: there is no stream \"q\""),
            (r#"{"t":1,"stream":"a"}"#, "trace line 1: value is missing"),
            ("0,a,1", READINGS),
            (r#"[{"t":1,"stream":"a","value":1}]"#, READINGS),
            (
                "\n{\"t\":2,\"stream\":\"a\",\"value\":1}\n{\"t\":1,\"stream\":\"a\",\"value\":1}",
                "trace line 3: time goes back from 2 to 1",
            ),
        ];
        for (trace, reason) in cases {
            let refused = parse_trace(trace, &run).err().map(|why| why.to_string());
            assert_eq!(refused.as_deref(), Some(reason));
        }
        assert!(parse_trace(r#"{"t":1,"stream":"a","value":1e999}"#, &run).is_err());
    }
}
