//! Every refusal in one English sentence that says what to do.

use crate::ids::ID_MAX_CHARS;
use crate::{BadId, FORMAT, Flaw, FlawKind, Refusal, StreamKind, Unit, ValueType, connectors};
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
            Self::Gone => to.write_str("This program was removed. Open another one."),
            Self::Edits(0) => to.write_str("There was nothing to change."),
            Self::Edits(many) => write!(to, "{many} edits at once are too many. Do it in smaller steps."),
            Self::Malformed(what) => write!(to, "This change is damaged ({what}). Reload the page and try again."),
            Self::Reused => {
                to.write_str("Another change was made under this id before. Reload the page and try again.")
            }
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
            Self::TooMany(what, limit) => write!(to, "A program holds at most {limit} {what}. Remove some first."),
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
            Self::Rate(_) => to.write_str("It must last from 1 millisecond to 1 hour."),
            Self::Infinite => to.write_str("A parameter is not a finite number."),
            Self::NeedsDevice(kind, name) => {
                let what = if *kind == StreamKind::Sensor { "a sense" } else { "an action" };
                write!(to, "Choose {what} for “{name}”.")
            }
            Self::NoDevice(name) => write!(to, "“{name}” has no sense or action."),
            Self::OrdinaryDevice => to.write_str("An ordinary stream has no sense or action."),
            Self::Device(reason) => write!(to, "{}.", capital(reason)),
            Self::Body(reason) => write!(to, "This procedure cannot run: {reason}."),
            Self::TakesMore(name, params) => {
                write!(to, "“{name}” is said to take more values than its {params} parameters. Leave the others out.")
            }
            Self::Identifier(name) => {
                write!(
                    to,
                    "“{name}” cannot be used as a name here. Start with a letter; use letters, digits and _ only."
                )
            }
            Self::HelperUsed(name, users) => {
                write!(to, "“{name}” is still used by {}. Change them first.", users.join(", "))
            }
            Self::UsedByMany(name, most) => {
                write!(to, "“{name}” is used by more than {most} programs. Add a helper of the new name beside it.")
            }
            Self::InGroup { stream, group } => {
                write!(to, "“{stream}” is in the group “{group}” already. Take it out there first.")
            }
            Self::NotSaved(reason) => write!(to, "This could not be saved ({reason}). Nothing was changed; try again."),
        }
    }
}

/// The most fields of an object that a sentence names.
const FIELDS_SAID_MAX: usize = 4;

impl fmt::Display for ValueType {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Any => to.write_str("anything"),
            Self::Truth => to.write_str("true or false"),
            Self::Number { unit: Some(Unit::Fraction), .. } => to.write_str(Unit::Fraction.name()),
            Self::Number { unit: Some(unit), .. } => write!(to, "a number in {}", unit.name()),
            Self::Number { unit: None, .. } => to.write_str("a number"),
            Self::Text => to.write_str("a text"),
            Self::Record(fields) => {
                let said: Vec<_> = fields.keys().take(FIELDS_SAID_MAX).map(String::as_str).collect();
                let more = if fields.len() > FIELDS_SAID_MAX { ", …" } else { "" };
                write!(to, "an object with {}{more}", said.join(", "))
            }
            Self::List(_) => to.write_str("a list"),
            Self::Nothing => to.write_str("nothing"),
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
            Self::InTwoGroups(id) => write!(to, "the stream {id:?} is in another group too"),
            Self::Tile => to.write_str("a tile has a key from 1 to 9 of its own, and is an action, a sense or a word"),
            Self::BodyAndHelper => to.write_str("it has both a body and a helper"),
        }
    }
}

/// A text with a capital letter.
pub(crate) fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

#[cfg(test)]
mod tests {
    use crate::{Unit, ValueType};

    #[test]
    fn a_kind_of_value_is_said() {
        let many = ["a", "b", "c", "d", "e"].map(|name| (name, ValueType::Truth));
        assert_eq!(ValueType::record(many).to_string(), "an object with a, b, c, d, …");
        assert_eq!(ValueType::in_unit(Unit::Fraction).to_string(), "a number from 0 to 1");
        assert_eq!(ValueType::in_unit(Unit::Metres).to_string(), "a number in m");
    }
}
