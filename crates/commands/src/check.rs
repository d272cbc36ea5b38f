//! `rrp check`: everything that is wrong with a file, each with its place.

use crate::LineCommand;
use crate::failure::Failure;
use crate::program::read_bytes;
use behaviour::{Behaviour, BehaviourFile, Helper, Id, Problem, Room};
use clap::Args;
use phrase::{Phrase, Phrased, phrase};
use server::{Knowing, PageFiles};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use store::files::{FileFault, ImportMode, ReadFile};

/// The most lines that are printed.
const SHOWN_MAX_LINES: usize = 200;

/// Looks at a file and prints all that is wrong with it, a line each: FILE:LINE:COLUMN: sentence.
///
/// Exit codes: 0 it can be imported and started; 1 it can be imported, but not started yet; 3 it cannot be imported;
/// 4 it cannot be opened.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp check tracking.json
  rrp check tracking.xml --json | jq '.problems[].reason'")]
pub(crate) struct CheckArgs {
    /// The file, rrp-behaviour/1 as JSON or XML; - reads standard input.
    #[arg(value_name = "FILE|-")]
    file: PathBuf,
    /// Prints one JSON object: file, importable, ready and problems with line, column, blocks and reason.
    #[arg(long)]
    json: bool,
}

impl LineCommand for CheckArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp check tracking.xml               look what is wrong with a file"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        check(&self)
    }
}

/// The findings about a file.
#[derive(Debug, Default, PartialEq)]
struct CheckFindings {
    /// The faults for which it cannot be imported.
    refused: Vec<FileFault>,
    /// The faults for which it cannot be started.
    blocks: Vec<FileFault>,
    /// The hints at what could be better.
    hints: Vec<FileFault>,
}

/// Checks, prints, and answers with the exit code.
fn check(args: &CheckArgs) -> ExitCode {
    let name = args.file.display().to_string();
    let bytes = match read_bytes(&args.file) {
        Ok(bytes) => bytes,
        Err(failure) => return crate::failed(&[failure], 4),
    };
    let found = found(&store::files::look(&bytes));
    // Whoever reads may have seen enough.
    let _ = if args.json { print_json(&name, &found) } else { print(&name, &found) };
    match (found.refused.is_empty(), found.blocks.is_empty()) {
        (false, _) => ExitCode::from(3),
        (true, false) => ExitCode::from(1),
        (true, true) => ExitCode::SUCCESS,
    }
}

fn found(looked: &ReadFile) -> CheckFindings {
    let Some(mut file) = looked.file.clone() else {
        return CheckFindings { refused: looked.faults.clone(), ..CheckFindings::default() };
    };
    // As an import would.
    file.read_as_meant();
    let file = &file;
    let knowing = Knowing::default();
    match graph(file, &knowing) {
        Err(reasons) => CheckFindings { refused: looked.place(&reasons), ..CheckFindings::default() },
        Ok(behaviour) => problems(file, &behaviour, looked, &knowing),
    }
}

/// The behaviour, if it could be imported.
fn graph(file: &BehaviourFile, knowing: &Knowing) -> Result<Behaviour, Vec<Failure>> {
    let behaviour = file.records(|_| None).map_err(|flaws| Failure::records(&flaws))?;
    let mut number = 0;
    let new_id = || {
        number += 1;
        Id::from_uuid(uuid::Uuid::from_u128(number))
    };
    let brought = store::files::import(file, ImportMode::Restore, &Behaviour::default(), "", new_id);
    let brought = brought.map_err(|faults| Failure::records(&faults))?;
    let helpers = brought.library.as_slice();
    let keeps = |changes| Room::rehearse(changes, knowing);
    let refused = keeps(&brought.changes).and_then(|()| keeps(helpers)).err();
    let Some(refusal) = refused else { return Ok(behaviour) };
    // The engine knows most reasons with their place; the rule's sentence stands where it knows none.
    let placed = engine_says(file);
    Err(if placed.is_empty() { vec![Failure::of(refusal)] } else { placed })
}

/// Returns the faults for which the engine would not run it, with ids.
fn engine_says(file: &BehaviourFile) -> Vec<Failure> {
    engine::validate(file).iter().map(|fault| of_file(fault).into()).collect()
}

/// A fault of the engine in a file, whose lines are not those of a procedure.
fn of_file(fault: &engine::GraphFault) -> Phrase {
    let reason = fault.reason.phrase();
    match reason.key() {
        Some("TextPlace.Both" | "TextPlace.Line") => {
            let inside = phrase!("fault_inside", "in its procedure, {reason}");
            phrase!("fault_at", "{id}: {reason}", id = fault.id, reason = inside)
        }
        _ => fault.phrase(),
    }
}

fn problems(file: &BehaviourFile, behaviour: &Behaviour, looked: &ReadFile, knowing: &Knowing) -> CheckFindings {
    let library = file.library();
    let helpers: Vec<&Helper> = library.iter().collect();
    let all = behaviour::problems(behaviour, &helpers, knowing);
    let said = |blocks: bool| {
        let those = all.iter().filter(|problem| problem.blocks == blocks);
        let at = |problem: &Problem| phrase!("fault_at", "{id}: {reason}", id = problem.at.id, reason = problem);
        those.map(at).collect::<Vec<_>>()
    };
    let mut blocks = looked.place(&said(true));
    if blocks.is_empty() {
        blocks = looked.place(&engine_says(file));
    }
    CheckFindings { refused: Vec::new(), blocks, hints: looked.place(&said(false)) }
}

fn print(name: &str, found: &CheckFindings) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    let all: Vec<_> = [&found.refused, &found.blocks, &found.hints].into_iter().flatten().collect();
    for fault in all.iter().take(SHOWN_MAX_LINES) {
        writeln!(out, "{name}:{}:{}: {}", fault.line, fault.column, fault.reason)?;
    }
    if all.len() > SHOWN_MAX_LINES {
        writeln!(out, "{name}: and {} more.", all.len() - SHOWN_MAX_LINES)?;
    }
    let verdict = match (found.refused.is_empty(), found.blocks.is_empty()) {
        (false, _) => "cannot be imported.",
        (true, false) => "can be imported, but not started yet.",
        (true, true) => "can be imported and started.",
    };
    writeln!(out, "{name}: {verdict}")
}

fn print_json(name: &str, found: &CheckFindings) -> std::io::Result<()> {
    let lines = |faults: &[FileFault], blocks: bool| {
        let line = move |fault: &FileFault| {
            let FileFault { line, column, reason } = fault;
            serde_json::json!({"line": line, "column": column, "blocks": blocks, "reason": reason.to_string()})
        };
        faults.iter().map(line).collect::<Vec<_>>()
    };
    let problems = [lines(&found.refused, true), lines(&found.blocks, true), lines(&found.hints, false)].concat();
    let (importable, ready) = (found.refused.is_empty(), found.refused.is_empty() && found.blocks.is_empty());
    let answer = serde_json::json!({"file": name, "importable": importable, "ready": ready, "problems": problems});
    writeln!(std::io::stdout().lock(), "{answer}")
}
