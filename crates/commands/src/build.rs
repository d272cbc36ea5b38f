//! `rrp build`: what typed sentences say as a program, or what of them is in doubt.

use crate::LineCommand;
use crate::failure::Failure;
use behaviour::{BehaviourFile, Helper};
use clap::Args;
use sentences::{Doubt, Language, Lexicon};
use serde_json::json;
use server::PageFiles;
use std::io::{self, Write};
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

impl LineCommand for BuildArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp build \"When the head is touched, wave.\" > wave.json"];
    const USES_A_SERVER: bool = false;

    fn run(self, _: PageFiles) -> ExitCode {
        build(&self)
    }
}

/// Reads, prints, and answers with the exit code.
fn build(args: &BuildArgs) -> ExitCode {
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
    let failures = reading.doubts.iter().map(|doubt| in_doubt(&text_of(doubt), doubt));
    crate::failed(&failures.collect::<Vec<_>>(), 3)
}

/// Says that these words are in doubt; without words something is missing.
fn in_doubt(words: &str, doubt: &Doubt) -> Failure {
    if words.is_empty() {
        return Failure::of("Something is missing: say what happens and what the robot does then.");
    }
    let more = match (&doubt.why, doubt.suggestions.as_slice()) {
        (Some(why), _) => why.clone(),
        (None, []) => "Say it in other words.".to_owned(),
        (None, suggestions) => {
            let quoted: Vec<_> = suggestions.iter().map(|suggestion| format!("“{suggestion}”")).collect();
            format!("Is it {}?", quoted.join(" or "))
        }
    };
    Failure::of(format!("“{words}” is not understood. {more}"))
}

fn printed(file: &BehaviourFile, json: bool) -> ExitCode {
    if json {
        match serde_json::to_value(file) {
            Ok(file) => told(&json!({ "behaviour": file }).to_string()),
            Err(error) => return crate::failed(&[Failure::unwritten_out(io::Error::from(error))], 1),
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
