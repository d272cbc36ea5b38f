//! Every refusal and problem in one English sentence that says what to do.

use crate::ids::ID_MAX_CHARS;
use crate::{BadId, FORMAT, Flaw, FlawKind, Problem, ProblemKind, Refusal, StreamKind, connectors};
use std::fmt;

impl fmt::Display for Refusal {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Stale(what) => write!(to, "Somebody changed {what} just now. Look at it and try again."),
            Self::Locked { what, by } => write!(to, "{by} is editing {what}. Ask, or wait until it is free."),
            Self::ChangedSince { what, by } => {
                write!(to, "{by} changed {what} since then, so your change cannot be taken back. Change it by hand.")
            }
            Self::NothingToUndo => to.write_str("There is nothing more of yours to take back or to do again."),
            Self::Gone => to.write_str("This behaviour was removed. Open another one."),
            Self::Edits(0) => to.write_str("There was nothing to change."),
            Self::Edits(many) => write!(to, "{many} edits at once are too many. Do it in smaller steps."),
            Self::Malformed(what) => write!(to, "This change is damaged ({what}). Reload the page and try again."),
            Self::Name(name) if name.is_empty() => to.write_str("A name is missing. Type at least one letter."),
            Self::Name(name) => write!(to, "“{name}” cannot be a name. Use letters, digits and spaces."),
            Self::Unseen(name) => {
                write!(to, "“{name}” cannot be a name, as it has characters that nobody sees. Type it anew.")
            }
            Self::NameTaken(name) => write!(to, "There is already a “{name}”. Choose another name."),
            Self::TooLong(what, limit) => write!(to, "{what} is too long. It may have {limit} characters."),
            Self::TooMany(what, limit) if what == "helpers" => {
                write!(to, "The library holds at most {limit} helpers. Remove some that nobody uses first.")
            }
            Self::TooMany(what, limit) => write!(to, "A behaviour holds at most {limit} {what}. Remove some first."),
            Self::Full(what, limit) => {
                let limit = limit >> 20;
                write!(
                    to,
                    "The {what} is full: all its texts together may have {limit} MB. Shorten or remove some first."
                )
            }
            Self::TooLarge(what) => write!(to, "{} is too large. Shorten its texts or lists.", capital(what)),
            Self::Cycle(name) => write!(to, "Values would flow in a circle through “{name}”. Choose another stream."),
            Self::SecondInput(name) => {
                write!(to, "“{name}” already gets its values from a connector. Use merge to join two.")
            }
            Self::IntoSensor(name) => write!(to, "“{name}” is a sense: it cannot take values from a connector."),
            Self::OutOfActuator(name) => write!(to, "“{name}” is an action: nothing can come out of it."),
            Self::OnlySubscribe(name) => write!(to, "Only subscribe can lead to the action “{name}”."),
            Self::SubscribeEnd(name) => write!(to, "Subscribe must lead to an action, and “{name}” is none."),
            Self::MissingStream => {
                to.write_str("A connector would have an end without a stream. Choose its streams again.")
            }
            Self::OneInput(word) => {
                let many = connectors::ALL.iter().filter(|spec| spec.inputs.are_many()).map(|spec| spec.name);
                let many = connectors::in_words(many);
                write!(to, "{} takes exactly one stream. Use {many} for several.", capital(word))
            }
            Self::InputTwice(name) => write!(to, "“{name}” is chosen twice. Choose every stream once."),
            Self::Rate(_) => to.write_str("The rate must be from 1 to 3,600,000 milliseconds."),
            Self::Infinite => to.write_str("A parameter is not a finite number."),
            Self::NeedsDevice(kind, name) => {
                let what = if *kind == StreamKind::Sensor { "a sense" } else { "an action" };
                write!(to, "Choose {what} for “{name}”.")
            }
            Self::NoDevice(name) => write!(to, "“{name}” has no sense or action."),
            Self::OrdinaryDevice => to.write_str("An ordinary stream has no sense or action."),
            Self::Device(reason) => write!(to, "{}.", capital(reason)),
            Self::Body(reason) => write!(to, "This procedure cannot run: {reason}."),
            Self::Identifier(name) => {
                write!(
                    to,
                    "“{name}” cannot be used as a name here. Start with a letter; use letters, digits and _ only."
                )
            }
            Self::HelperUsed(name, users) => {
                write!(to, "“{name}” is still used by {}. Change them first.", users.join(", "))
            }
            Self::NotSaved(reason) => write!(to, "This could not be saved ({reason}). Nothing was changed; try again."),
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let name = &self.name;
        match &self.kind {
            ProblemKind::FewInputs(least) => {
                write!(to, "{} needs {least} input streams or more. Add one.", capital(name))
            }
            ProblemKind::NoInputs => write!(to, "{} has no input streams. Add one.", capital(name)),
            ProblemKind::EmptyBody => {
                write!(to, "{} has no procedure yet. Write one or choose a helper.", capital(name))
            }
            ProblemKind::MissingHelper(helper) => {
                write!(to, "The helper “{helper}” does not exist. Choose another or add it.")
            }
            ProblemKind::HelperInputs { helper, takes, gets } => {
                write!(to, "The helper “{helper}” takes {takes} values, but gets {gets}. Choose another.")
            }
            ProblemKind::Helper { helper, reason } => write!(to, "The helper “{helper}” cannot run: {reason}."),
            ProblemKind::EmptyHelper(helper) => {
                write!(to, "The helper “{helper}” cannot run: it has no procedure yet.")
            }
            ProblemKind::Body(reason) => write!(to, "The procedure of {name} cannot run: {reason}."),
            ProblemKind::Device(reason) => write!(to, "{}.", capital(reason)),
            ProblemKind::NoSource => write!(to, "“{name}” gets no values. Lead a connector to it."),
            ProblemKind::Unused => write!(to, "“{name}” leads to no action."),
            ProblemKind::Multiplies => {
                let becomes = if self.blocks { "becomes" } else { "can become" };
                write!(
                    to,
                    "Values multiply at “{name}”: one reading {becomes} more than 100,000 values. Lead fewer ways of \
                     the same stream together there, or put a sample before it."
                )
            }
        }
    }
}

impl fmt::Display for BadId {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Id(text) => write!(to, "an id has 1 to {ID_MAX_CHARS} letters, digits, - or _; {text:?} does not"),
            Self::RecordId(text) => write!(to, "{text:?} is not a record id like stream/3f2a"),
            Self::Kind(word) => write!(to, "{word:?} is no kind of record"),
        }
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "{}: {}", self.at, self.kind)
    }
}

impl fmt::Display for FlawKind {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Format(format) => write!(to, "{format:?} is not {FORMAT}"),
            Self::Id(bad) => write!(to, "{bad}"),
            Self::IdTwice => to.write_str("this id is used twice"),
            Self::Order { here, above } => {
                write!(to, "its order {here} comes before {above}, the one above it; leave order out of the file")
            }
            Self::OrderOfNothing => to.write_str("order names it, but there is no such stream or connector"),
            Self::NoStream(id) => write!(to, "there is no stream {id:?}"),
            Self::NoConnector(word) => write!(to, "there is no connector {word:?}"),
            Self::NoPeriod(word) => write!(to, "{word} needs a periodMs of 1 or more"),
            Self::BodyAndHelper => to.write_str("it has both a body and a helper"),
        }
    }
}

fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}
