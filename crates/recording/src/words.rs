//! The findings about a recording, said in English.

use crate::check::{CheckedRecording, Different, Ending, ToldValue};
use crate::header::Lack;
use std::fmt;

impl fmt::Display for CheckedRecording {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self { actions, readings, until_ms, ends } = self;
        let until = SinceStart(*until_ms);
        write!(to, "It gives its own actions again: {actions} from {readings} readings, until {until}.")?;
        match ends {
            Ending::Whole(end) => write!(to, " It ends there: {}.", end.why),
            Ending::Full => to.write_str(" It ends there, as it had the largest size that a recording may have."),
            Ending::CutOff => {
                to.write_str(" It is cut off there: the server or the disk ended before its last line was written.")
            }
        }
    }
}

impl fmt::Display for Different {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoRecording => {
                to.write_str("This is no recording. Give the file that ends in .jsonl, as it was downloaded.")
            }
            Self::Lacks(lack) => write!(to, "This cannot be checked: {lack}."),
            Self::NewProgram => {
                write!(to, "The program in this recording cannot run here: this rrp cannot read it; update rrp.")
            }
            Self::CannotRun(Some(fault)) => write!(to, "The program in this recording cannot run here: {fault}."),
            Self::CannotRun(None) => write!(to, "The program in this recording cannot run here."),
            Self::Stream { at_ms, stream } => write!(
                to,
                "At {} the recording has a stream “{stream}” that its own program does not have. Was it edited?",
                SinceStart(*at_ms)
            ),
            Self::Missing { lost, after_ms } => write!(
                to,
                "{lost} lines are missing after {}, as they could not be written in time. Until there it gives its own \
                 actions again; what comes after cannot be checked.",
                SinceStart(*after_ms)
            ),
            Self::Action { recorded, replayed, late } => {
                differs(recorded.as_deref(), replayed.as_deref(), to)?;
                match late {
                    0 => Ok(()),
                    late => write!(
                        to,
                        " While it was recorded {late} values were dropped, as a procedure took too long; a replay has no \
                         clock and keeps them."
                    ),
                }
            }
        }
    }
}

fn differs(recorded: Option<&ToldValue>, replayed: Option<&ToldValue>, to: &mut fmt::Formatter) -> fmt::Result {
    match (recorded, replayed) {
        (Some(was), None) => write!(to, "The replay differs: the robot was told {was}, and the replay gives nothing."),
        (None, Some(is)) => write!(to, "The replay differs: it gives {is}, and the robot was told nothing."),
        (Some(was), Some(is)) => {
            write!(to, "The replay differs: the robot was told {was}, and the replay gives {is}.")
        }
        (None, None) => Ok(()),
    }
}

impl fmt::Display for ToldValue {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "“{}” {} at {}", self.name, self.value, SinceStart(self.at_ms))
    }
}

impl fmt::Display for Lack {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(match self {
            Self::Program => {
                "it lacks the program that ran, as older recordings do; what the robot did and what was marked can be seen. \
                 To replay it, give a program with --behaviour and this file with --trace"
            }
            Self::Everything => {
                "it is cut off before it says what runs: the server or the disk ended just as it began"
            }
            Self::Readings => "it has marks and actions only, and nothing of what the robot sensed",
            Self::Memory => "what the program remembered when it was continued was too large to be recorded",
        })
    }
}

/// A time since Start, in milliseconds, for people: `1:02.350`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SinceStart(pub u64);

impl fmt::Display for SinceStart {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self(ms) = self;
        write!(to, "{}:{:02}.{:03}", ms / 60_000, ms / 1_000 % 60, ms % 1_000)
    }
}
