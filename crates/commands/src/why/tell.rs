//! The answer as it is printed: one line of JSON, or sentences.

use crate::explain::units;
use crate::failure::Failure;
use behaviour::{BehaviourFile, Helper};
use engine::RunFault;
use protocol::{Why, WhyNot};
use recording::SinceStart;
use sentences::{Answers, Language};
use serde::Serialize;
use std::io::Write;

/// An answer.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum ToldAnswer {
    Why(Why),
    Not(WhyNot),
}

/// Says on standard error what makes an answer doubtful.
pub(super) fn warn(lost: u64, fault: Option<RunFault>) {
    let mut errors = std::io::stderr().lock();
    if lost > 0 {
        let _ = writeln!(errors, "{lost} lines are missing from the recording before that, so this may be wrong.");
    }
    if let Some(fault) = fault {
        let _ = writeln!(errors, "The program ended by itself: {fault}");
    }
}

/// Prints an answer.
///
/// # Errors
/// If the program is one of which no sentences can be told.
pub(super) fn tell(
    told: &ToldAnswer,
    file: &BehaviourFile,
    json: bool,
    language: Language,
) -> Result<(), Vec<Failure>> {
    let lines =
        if json { vec![serde_json::to_string(told).unwrap_or_default()] } else { sentences(told, file, language)? };
    let mut out = std::io::stdout().lock();
    // Whoever reads may have seen enough, and that is no failure.
    let _ = lines.iter().try_for_each(|line| writeln!(out, "{line}"));
    Ok(())
}

fn sentences(told: &ToldAnswer, file: &BehaviourFile, language: Language) -> Result<Vec<String>, Vec<Failure>> {
    let behaviour = file.records(|_| None).map_err(|flaws| Failure::records(&flaws))?;
    let library = file.library();
    let helpers: Vec<&Helper> = library.iter().collect();
    let unit = units(&behaviour, &helpers);
    let clock = |ms: u64| SinceStart(ms).to_string();
    let answers = Answers::of(&behaviour, &helpers, &unit, &clock, language);
    let moments = match told {
        ToldAnswer::Why(why) => answers.why(why),
        ToldAnswer::Not(not) => answers.why_not(not),
    };
    Ok(moments.into_iter().map(|moment| moment.text).collect())
}
