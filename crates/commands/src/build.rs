//! `rrp build`: what typed sentences say as a program, or what of them is in doubt.

use crate::failure::Failure;
use behaviour::{BehaviourFile, Helper};
use clap::Args;
use sentences::{Language, Reading};
use serde_json::{Value, json};
use std::io::Write;
use std::process::ExitCode;

/// Prints the program that typed sentences say, as a file.
///
/// Exit codes: 0 it is printed; 3 words are in doubt: each with what could stand in their place.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp build \"When the head is touched, say hello.\" > hello.json
  rrp build --language ja 頭を触ったら手を振る
  rrp build --json \"Wave when the child cries.\"    what is in doubt, for programs")]
pub(crate) struct BuildArgs {
    /// The sentences; each argument may have several.
    #[arg(value_name = "SENTENCE", required = true)]
    sentences: Vec<String>,
    /// The language of the sentences: en or ja.
    #[arg(long, value_name = "LANGUAGE", default_value = "en")]
    language: Language,
    /// Prints {"behaviour": …} or {"doubts": [{"text": …, "suggestions": […]}]}.
    #[arg(long)]
    json: bool,
}

/// Reads, prints, and answers with the exit code.
pub(crate) fn build(args: &BuildArgs) -> ExitCode {
    let text = args.sentences.join(" ");
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    let reading = sentences::read(&text, args.language, &helpers, None);
    if reading.is_whole() {
        return printed(&program(&reading, &helpers), args);
    }
    let doubts = reading.doubts_in(&text);
    let mut out = std::io::stdout().lock();
    // Whoever reads may have seen enough.
    let _ = if args.json {
        let doubts: Vec<Value> = doubts.iter().map(|(text, suggestions)| json!({"text": text, "suggestions": suggestions})).collect();
        writeln!(out, "{}", json!({ "doubts": doubts }))
    } else {
        let failures = doubts.into_iter().map(|(text, suggestions)| Failure::InDoubt(text, suggestions));
        return crate::failed(&failures.collect::<Vec<_>>(), 3);
    };
    ExitCode::from(3)
}
