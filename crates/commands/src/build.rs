//! `rrp build`: what typed sentences say as a program, or what of them is in doubt.

use crate::failure::Failure;
use behaviour::{BehaviourFile, Helper};
use clap::Args;
use sentences::{Doubt, Language, Lexicon};
use serde_json::json;
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
    let lexicon = Lexicon::of(args.language);
    let reading = sentences::read_speech(&text, args.language, lexicon, &helpers, None);
    if reading.is_whole() {
        let file = BehaviourFile::of(&reading.draft.behaviour(), &helpers);
        return printed(&file, args.json);
    }
    let text_of = |doubt: &Doubt| text.get(doubt.range.clone()).unwrap_or_default().to_owned();
    if args.json {
        let doubts = reading
            .doubts
            .iter()
            .map(|doubt| json!({ "text": text_of(doubt), "suggestions": doubt.suggestions, "why": doubt.why }));
        told(&json!({ "doubts": doubts.collect::<Vec<_>>() }).to_string());
        return ExitCode::from(3);
    }
    let failures = reading.doubts.iter().map(|doubt| Failure::InDoubt {
        words: text_of(doubt),
        suggestions: doubt.suggestions.clone(),
        why: doubt.why.clone(),
    });
    crate::failed(&failures.collect::<Vec<_>>(), 3)
}

fn printed(file: &BehaviourFile, json: bool) -> ExitCode {
    if json {
        match serde_json::to_value(file) {
            Ok(file) => told(&json!({ "behaviour": file }).to_string()),
            Err(error) => return crate::failed(&[Failure::UnwrittenOut(error.into())], 1),
        }
    } else {
        told(store::files::write_json(file).trim_end());
    }
    ExitCode::SUCCESS
}

fn told(line: &str) {
    // Whoever reads may have seen enough.
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::{BuildArgs, build};
    use sentences::Language;
    use std::process::ExitCode;

    #[test]
    fn sentences_are_built_or_asked_about() {
        let said = |sentence: &str| {
            build(&BuildArgs { sentences: vec![sentence.to_owned()], language: Language::English, json: true })
        };
        assert_eq!(format!("{:?}", said("Wave when I press the button!")), format!("{:?}", ExitCode::SUCCESS));
        assert_eq!(format!("{:?}", said("Wave when the child cries.")), format!("{:?}", ExitCode::from(3)));
    }
}
