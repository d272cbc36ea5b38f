//! `rrp explain`: what a behaviour does, a sentence a line.

use crate::LineCommand;
use crate::failure::Failure;
use crate::program::read_bytes;
use behaviour::{Behaviour, Helper, Id, Unit, ValueType};
use clap::Args;
use sentences::Language;
use server::{Knowing, PageFiles};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Prints what a behaviour does in plain sentences, a line each, in the order of the file.
///
/// Exit codes: 0 it is printed; 3 the file is no behaviour; 4 it cannot be opened.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp explain tracking.json
  rrp explain tracking.xml --language ja")]
pub(crate) struct ExplainArgs {
    /// The file, rrp-behaviour/1 as JSON or XML; - reads standard input.
    #[arg(value_name = "FILE|-")]
    file: PathBuf,
    /// The language of the sentences: en or ja.
    #[arg(long, value_name = "LANGUAGE", default_value = "en")]
    language: Language,
}

impl LineCommand for ExplainArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp explain tracking.json            what it does, in plain sentences"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        explain(&self)
    }
}

/// Explains, prints, and answers with the exit code.
fn explain(args: &ExplainArgs) -> ExitCode {
    let bytes = match read_bytes(&args.file) {
        Ok(bytes) => bytes,
        Err(failure) => return crate::failed(&[failure], 4),
    };
    match lines(&args.file, &bytes, args.language) {
        Ok(lines) => {
            let mut out = std::io::stdout().lock();
            // Whoever reads may have seen enough.
            let _ = lines.iter().try_for_each(|line| writeln!(out, "{line}"));
            ExitCode::SUCCESS
        }
        Err(failures) => crate::failed(&failures, 3),
    }
}

fn lines(path: &Path, bytes: &[u8], language: Language) -> Result<Vec<String>, Vec<Failure>> {
    let looked = store::files::look(bytes);
    let Some(file) = looked.file else { return Err(vec![Failure::faults(path, &looked.faults)]) };
    let behaviour = file.records(|_| None).map_err(|flaws| Failure::records(&flaws))?;
    let library = file.library();
    let helpers: Vec<&Helper> = library.iter().collect();
    let told = sentences::explain(&behaviour, &helpers, &units(&behaviour, &helpers), language);
    Ok(told.iter().map(ToString::to_string).collect())
}

/// In what the numbers of each stream are measured.
pub(crate) fn units(behaviour: &Behaviour, helpers: &[&Helper]) -> impl Fn(&Id) -> Option<String> + use<> {
    let types = behaviour::infer(behaviour, helpers, &Knowing::default());
    // That it is a share says nothing beside a number.
    move |id: &Id| match types.get(id) {
        Some(ValueType::Number { unit: Some(unit), .. }) if *unit != Unit::Fraction => Some(unit.symbol().to_owned()),
        _ => None,
    }
}
