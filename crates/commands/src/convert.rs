//! `rrp convert`: a recording in the form of another program, by default without names and what is about people.

mod mcap;

use crate::LineCommand;
use crate::failure::Failure;
use crate::trace::read_trace;
use clap::{Args, ValueEnum};
use recording::{Different, NoRecording, PrivateParts, Timeline};
use server::PageFiles;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The largest file of later marks that is read, in bytes.
const MARKS_MAX_BYTES: u64 = 4 << 20;

/// Writes a recording in the form of another program, to standard output or --out.
///
/// The people who pressed are called P1, P2 and so on, and texts that come of faces and recognised words are left out, unless
/// they are asked for. Marks that were made later are in it, if their file is beside the recording.
///
/// Exit codes: 0 written; 1 the file is no recording, or cannot be read or written.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp convert 2026-11-21T18-34-06Z-greet.jsonl --to csv > greet.csv
  rrp convert greet.jsonl --to eaf --out greet.eaf
  rrp convert greet.jsonl --to csv --semicolon --names --out greet.csv")]
pub(crate) struct ConvertArgs {
    /// The recording, as it was downloaded; - reads standard input.
    #[arg(value_name = "FILE|-")]
    recording: PathBuf,
    /// The form to write.
    #[arg(long, value_enum)]
    to: ConvertForm,
    /// The file to write instead of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Keeps the names of the people who pressed.
    #[arg(long)]
    names: bool,
    /// Keeps texts that come of faces and recognised words.
    #[arg(long)]
    personal: bool,
    /// Separates the columns of a CSV by semicolons, as spreadsheets expect where numbers have a decimal comma.
    #[arg(long)]
    semicolon: bool,
}

impl LineCommand for ConvertArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp convert morning.jsonl --to csv --out morning.csv"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(convert(&self))
    }
}

/// The form of another program.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ConvertForm {
    /// A table for spreadsheets: everything, a line each.
    Csv,
    /// ELAN: marks, actions and troubles as tiers.
    Eaf,
    /// BORIS: events to paste into an observation.
    Boris,
    /// WebVTT: subtitles beside a video.
    Vtt,
    /// MCAP: everything, for Lichtblick, Rerun and the like.
    Mcap,
}

/// Converts, or says why not.
fn convert(args: &ConvertArgs) -> Result<(), Failure> {
    let text = read_trace(&args.recording)?;
    let keep = PrivateParts { names: args.names, personal: args.personal };
    let timeline = recording::timeline(&text, &later_marks(&args.recording)?, keep)
        .map_err(|NoRecording| Failure::of(Different::NoRecording))?;
    let bytes = written(&timeline, args)?;
    match &args.out {
        Some(path) => std::fs::write(path, bytes).map_err(|error| Failure::unwritten(path, &error)),
        None => std::io::stdout().lock().write_all(&bytes).map_err(Failure::unwritten_out),
    }
}

fn written(timeline: &Timeline, args: &ConvertArgs) -> Result<Vec<u8>, Failure> {
    let of = |form: report::Form| form.written(timeline).map_err(Failure::unwritten_out);
    Ok(match args.to {
        ConvertForm::Csv => of(report::Form::Csv(if args.semicolon { ';' } else { ',' }))?,
        ConvertForm::Eaf => of(report::Form::Eaf)?,
        ConvertForm::Boris => of(report::Form::Boris)?,
        ConvertForm::Vtt => of(report::Form::Vtt)?,
        ConvertForm::Mcap => mcap::written(timeline).map_err(Failure::unwritten_out)?,
    })
}

/// The later marks beside a recording; nothing if there are none.
fn later_marks(recording: &Path) -> Result<String, Failure> {
    let name = recording.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let Some(stem) = name.strip_suffix(".jsonl") else { return Ok(String::new()) };
    let path = recording.with_file_name(format!("{stem}.marks.jsonl"));
    match path.metadata().map(|about| about.len()) {
        Ok(bytes) if bytes > MARKS_MAX_BYTES => Err(Failure::too_long(&path, MARKS_MAX_BYTES)),
        Ok(_) => std::fs::read_to_string(&path).map_err(|error| Failure::unopened(&path, &error)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(String::new()),
        Err(error) => Err(Failure::unopened(&path, &error)),
    }
}
