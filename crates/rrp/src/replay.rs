//! `rrp replay`: a recorded trace through a behaviour, faster than real time, always with the same output.

mod recording;

use behaviour::{BehaviourFile, Engine, StreamKind, Value};
use clap::{Args, ValueEnum};
use engine::{Arbiter, Claim, Emission, Limits, Run};
use robot::Millis;
use std::io::{BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The largest behaviour that is read, in bytes.
pub(crate) const BEHAVIOUR_BYTES: u64 = 16 * 1024 * 1024;
/// The largest trace that is read, in bytes.
pub(crate) const TRACE_BYTES: u64 = 512 * 1024 * 1024;
/// The length of a frame if nobody says one.
const FRAME_MS: u64 = 50;

/// Replays a trace through a behaviour and prints what its actuators are told, as JSON lines.
///
/// Exit codes: 0 done; 2 the behaviour is refused; 3 the trace is refused.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp replay --behaviour tracking.json --trace morning.jsonl --probe --errors")]
pub(crate) struct ReplayArgs {
    /// The behaviour, an rrp-behaviour/1 file.
    #[arg(long, value_name = "FILE")]
    behaviour: PathBuf,
    /// The readings, one JSON object a line, or a recording of a run; - reads standard input.
    #[arg(long, value_name = "FILE|-")]
    trace: PathBuf,
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
    mode: Option<Mode>,
    /// The length of a frame in milliseconds, in frame mode.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    frame_ms: Option<u64>,
    /// Lets actuator streams compete for the parts of the robot.
    #[arg(long)]
    arbitrate: bool,
}

/// How time runs.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Mode {
    /// Every reading at its own instant.
    Event,
    /// Readings gathered into frames.
    Frame,
}

/// Why a replay did not happen.
pub(crate) enum Refused {
    Behaviour(Vec<String>),
    Trace(String),
}

/// A reading for a stream by index.
pub(crate) type Reading = (Millis, usize, Value);

/// What is replayed.
struct Trace {
    readings: Vec<Reading>,
    /// Up to where a recorded run had closed its instants; nothing later was flushed.
    closed: Option<Millis>,
}

/// Replays, prints, and answers with the exit code.
pub(crate) fn replay(args: &ReplayArgs) -> ExitCode {
    match prepare(args) {
        Ok((file, run, trace)) => {
            // Whoever reads may have seen enough: a closed pipe ends the replay, and that is no failure.
            let _ = play(args, &file, run, trace, &mut BufWriter::new(std::io::stdout().lock()));
            ExitCode::SUCCESS
        }
        Err(reason) => refused(reason),
    }
}

/// Says why, and gives the exit code for it.
pub(crate) fn refused(reason: Refused) -> ExitCode {
    match reason {
        Refused::Behaviour(reasons) => refuse(&reasons, 2),
        Refused::Trace(reason) => refuse(&[reason], 3),
    }
}

fn refuse(reasons: &[String], code: u8) -> ExitCode {
    let mut errors = std::io::stderr().lock();
    for reason in reasons {
        let _ = writeln!(errors, "{reason}");
    }
    ExitCode::from(code)
}

fn prepare(args: &ReplayArgs) -> Result<(BehaviourFile, Run, Trace), Refused> {
    let file = read_behaviour(args).map_err(|reason| Refused::Behaviour(vec![reason]))?;
    let faults = |faults: Vec<engine::Fault>| Refused::Behaviour(faults.iter().map(ToString::to_string).collect());
    let run = Run::build(&file, Limits::default()).map_err(faults)?;
    let text = read(&args.trace, TRACE_BYTES).map_err(Refused::Trace)?;
    let trace = match recording::parse(&text, &run) {
        Some(trace) => trace,
        None => parse_trace(&text, &run).map(|readings| Trace { readings, closed: None }),
    };
    Ok((file, run, trace.map_err(Refused::Trace)?))
}

fn read_behaviour(args: &ReplayArgs) -> Result<BehaviourFile, String> {
    let text = read(&args.behaviour, BEHAVIOUR_BYTES)?;
    let file = serde_json::from_str::<BehaviourFile>(&text);
    let mut file = file.map_err(|error| format!("{}: {error}", args.behaviour.display()))?;
    file.engine = Some(chosen_engine(args, file.engine.unwrap_or_default()));
    Ok(file)
}

fn chosen_engine(args: &ReplayArgs, own: Engine) -> Engine {
    let own_ms = if let Engine::Frame { frame_ms } = own { frame_ms } else { FRAME_MS };
    match (args.mode, own) {
        (Some(Mode::Event), _) | (None, Engine::Event) => Engine::Event,
        (Some(Mode::Frame), _) | (None, Engine::Frame { .. }) => {
            Engine::Frame { frame_ms: args.frame_ms.unwrap_or(own_ms) }
        }
    }
}

/// A whole file, or standard input for `-`, up to a bound.
pub(crate) fn read(path: &Path, bound: u64) -> Result<String, String> {
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let source: Box<dyn Read> = if path == Path::new("-") {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(std::fs::File::open(path).map_err(|error| named(&error))?)
    };
    let mut text = String::new();
    source.take(bound + 1).read_to_string(&mut text).map_err(|error| named(&error))?;
    if text.len() as u64 > bound {
        return Err(named(&format!("it is larger than {bound} bytes")));
    }
    Ok(text)
}

pub(crate) fn parse_trace(text: &str, run: &Run) -> Result<Vec<Reading>, String> {
    let mut readings = Vec::new();
    let mut latest = 0;
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()) {
        let reading = parse_line(line, run, latest).map_err(|reason| format!("trace line {number}: {reason}"))?;
        latest = reading.0.0;
        readings.push(reading);
    }
    Ok(readings)
}

fn parse_line(line: &str, run: &Run, latest: u64) -> Result<Reading, String> {
    let line: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let Some(&Value::Int(t)) = line.field("t") else { return Err("t must be a whole number".to_owned()) };
    let t = u64::try_from(t).map_err(|_| "t must not be negative".to_owned())?;
    let stream = line.field("stream").and_then(Value::as_text).ok_or("stream must be a text")?;
    let value = line.field("value").cloned().ok_or("value is missing")?;
    if t < latest {
        return Err(format!("time goes back from {latest} to {t}"));
    }
    let at = run.stream_index(stream).ok_or_else(|| format!("there is no stream {stream:?}"))?;
    if run.streams()[at].kind != StreamKind::Sensor {
        return Err(format!("{stream:?} is no sensor stream"));
    }
    Ok((Millis(t), at, value))
}

fn play(
    args: &ReplayArgs,
    file: &BehaviourFile,
    mut run: Run,
    trace: Trace,
    to: &mut dyn Write,
) -> std::io::Result<()> {
    let Trace { readings, closed } = trace;
    let until = Millis(args.until.unwrap_or_else(|| readings.last().map_or(0, |(at, ..)| at.0)));
    let mut printer = Printer::new(args, file);
    for (at, stream, value) in readings.into_iter().take_while(|(at, ..)| *at <= until) {
        run.feed(at, stream, value, &mut |emission| printer.print(&emission));
        printer.write(to)?;
    }
    match closed.filter(|_| args.until.is_none()) {
        Some(closed) => run.until(closed, &mut |emission| printer.print(&emission)),
        None => run.finish(until, &mut |emission| printer.print(&emission)),
    }
    printer.write(to)?;
    to.flush()
}

/// Chooses what is printed and turns it into lines.
struct Printer<'a> {
    args: &'a ReplayArgs,
    file: &'a BehaviourFile,
    claims: Vec<Claim>,
    arbiter: Arbiter,
    lines: String,
}

impl<'a> Printer<'a> {
    fn new(args: &'a ReplayArgs, file: &'a BehaviourFile) -> Self {
        let claims = file.streams.iter().map(Claim::of).collect();
        Self { args, file, claims, arbiter: Arbiter::default(), lines: String::new() }
    }

    fn print(&mut self, emission: &Emission) {
        match *emission {
            Emission::Value { at, stream, value } => self.print_value(at, stream, value),
            Emission::Fault { at, connector, error, .. } if self.args.errors => {
                let id = quoted(&self.file.connectors[connector].id);
                self.line(&format!("{{\"t\":{},\"connector\":{id},\"error\":{}}}", at.0, quoted(error)));
            }
            Emission::Fault { .. } => {}
        }
    }

    fn print_value(&mut self, at: Millis, stream: usize, value: &Value) {
        let info = &self.file.streams[stream];
        let command = info.kind == StreamKind::Actuator;
        if !command && !self.args.probe {
            return;
        }
        let mut line = format!("{{\"t\":{},\"stream\":{},\"value\":{}", at.0, quoted(&info.id), json(value));
        if command
            && self.args.arbitrate
            && let Err(holder) = self.arbiter.command(at, stream, &self.claims[stream])
        {
            line.push_str(&format!(",\"suppressedBy\":{}", quoted(&self.file.streams[holder].id)));
        }
        line.push('}');
        self.line(&line);
    }

    fn line(&mut self, line: &str) {
        self.lines.push_str(line);
        self.lines.push('\n');
    }

    fn write(&mut self, to: &mut dyn Write) -> std::io::Result<()> {
        let written = to.write_all(self.lines.as_bytes());
        self.lines.clear();
        written
    }
}

/// A value as JSON: floats bit for bit, whole numbers without a point.
fn json(value: &Value) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// A text as JSON.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{Mode, ReplayArgs, Trace, parse_trace, play};
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
        let nowhere = std::path::PathBuf::new;
        ReplayArgs {
            behaviour: nowhere(),
            trace: nowhere(),
            until: None,
            probe: false,
            errors: false,
            mode: Some(Mode::Event),
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
        play(args, &file, run, Trace { readings, closed: None }, &mut to).unwrap();
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

    #[test]
    fn a_trace_that_makes_no_sense_is_refused_with_its_line() {
        let (_, run) = start();
        let cases = [
            ("{}", "trace line 1: t must be a whole number"),
            (r#"{"t":-1,"stream":"a","value":1}"#, "trace line 1: t must not be negative"),
            (r#"{"t":1,"stream":"z","value":1}"#, "trace line 1: \"z\" is no sensor stream"),
            (r#"{"t":1,"stream":"q","value":1}"#, "trace line 1: there is no stream \"q\""),
            (r#"{"t":1,"stream":"a"}"#, "trace line 1: value is missing"),
            (
                "\n{\"t\":2,\"stream\":\"a\",\"value\":1}\n{\"t\":1,\"stream\":\"a\",\"value\":1}",
                "trace line 3: time goes back from 2 to 1",
            ),
        ];
        for (trace, reason) in cases {
            assert_eq!(parse_trace(trace, &run).err().as_deref(), Some(reason));
        }
        assert!(parse_trace(r#"{"t":1,"stream":"a","value":1e999}"#, &run).is_err());
    }
}
