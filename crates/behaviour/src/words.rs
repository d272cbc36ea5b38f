//! Every refusal in one English sentence that says what to do.

use crate::ids::ID_MAX_CHARS;
use crate::{BadId, FORMAT, Flaw, FlawKind, Refusal, StreamKind, Unit, ValueType, connectors};
use phrase::{Phrase, Phrased, phrase, shown};

shown!(Refusal, ValueType, BadId, Flaw, FlawKind);

impl Phrased for Refusal {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Stale(what) => {
                phrase!("Refusal.Stale", "Somebody changed {what} just now. Look at it and try again.")
            }
            Self::Locked { what, by } => {
                phrase!("Refusal.Locked", "{by} is editing {what}. Ask, or wait until it is free.")
            }
            Self::ChangedSince { what, by } => {
                phrase!(
                    "Refusal.ChangedSince",
                    "{by} changed {what} since then, so your change cannot be taken back. Change it by hand."
                )
            }
            Self::NothingToUndo => {
                phrase!("Refusal.NothingToUndo", "There is nothing more of yours to take back or to do again.")
            }
            Self::Gone => phrase!("Refusal.Gone", "This program was removed. Open another one."),
            Self::Edits(0) => phrase!("Refusal.NoEdits", "There was nothing to change."),
            Self::Edits(many) => {
                phrase!("Refusal.ManyEdits", "{many} edits at once are too many. Do it in smaller steps.")
            }
            Self::Malformed(what) => {
                phrase!("Refusal.Malformed", "This change is damaged ({what}). Reload the page and try again.")
            }
            Self::Reused => {
                phrase!(
                    "Refusal.Reused",
                    "Another change was made under this id before. Reload the page and try again."
                )
            }
            Self::Name(name) if name.is_empty() => {
                phrase!("Refusal.NoName", "A name is missing. Type at least one letter.")
            }
            Self::Name(name) => phrase!("Refusal.Name", "“{name}” cannot be a name. Use letters, digits and spaces."),
            Self::Unseen(name) => {
                phrase!(
                    "Refusal.Unseen",
                    "“{name}” cannot be a name, as it has characters that nobody sees. Type it anew."
                )
            }
            Self::NameTaken(name) => phrase!("Refusal.NameTaken", "There is already a “{name}”. Choose another name."),
            Self::TooLong(what, limit) => {
                phrase!("Refusal.TooLong", "{^what} is too long. It may have {limit} characters.")
            }
            Self::TooMany(what, limit) if what.key() == Some("many.helpers") => {
                phrase!(
                    "Refusal.ManyHelpers",
                    "The library holds at most {limit} helpers. Remove some that nobody uses first."
                )
            }
            Self::TooMany(what, limit) => {
                phrase!("Refusal.TooMany", "A program holds at most {limit} {what}. Remove some first.")
            }
            Self::Full(what, limit) => {
                let limit = limit >> 20;
                phrase!(
                    "Refusal.Full",
                    "The {what} is full: all its texts together may have {limit} MB. Shorten or remove some first."
                )
            }
            Self::TooLarge(what) => phrase!("Refusal.TooLarge", "{^what} is too large. Shorten its texts or lists."),
            other => of_parts(other),
        }
    }
}

/// The refusals of streams, connectors, devices and helpers.
fn of_parts(refusal: &Refusal) -> Phrase {
    use Refusal as R;
    match refusal {
        R::Cycle(name) => {
            phrase!("Refusal.Cycle", "Values would flow in a circle through “{name}”. Choose another stream.")
        }
        R::SecondInput(name) => {
            phrase!("Refusal.SecondInput", "“{name}” already gets its values from a connector. Use merge to join two.")
        }
        R::IntoSensor(name) => {
            phrase!("Refusal.IntoSensor", "“{name}” is a sense: it cannot take values from a connector.")
        }
        R::OutOfActuator(name) => {
            phrase!("Refusal.OutOfActuator", "“{name}” is an action: nothing can come out of it.")
        }
        R::OnlySubscribe(name) => {
            phrase!("Refusal.OnlySubscribe", "Only subscribe can lead to the action “{name}”.")
        }
        R::SubscribeEnd(name) => {
            phrase!("Refusal.SubscribeEnd", "Subscribe must lead to an action, and “{name}” is none.")
        }
        R::MissingStream => {
            phrase!(
                "Refusal.MissingStream",
                "A connector would have an end without a stream. Choose its streams again."
            )
        }
        R::OneInput(word) => {
            let many = connectors_of_many();
            phrase!("Refusal.OneInput", "{^word} takes exactly one stream. Use {many} for several.")
        }
        R::InputTwice(name) => {
            phrase!("Refusal.InputTwice", "“{name}” is chosen twice. Choose every stream once.")
        }
        R::Rate(_) => phrase!("Refusal.Rate", "It must last from 1 millisecond to 1 hour."),
        R::Infinite => phrase!("Refusal.Infinite", "A parameter is not a finite number."),
        R::NeedsDevice(kind, name) => {
            let what = one_of(*kind);
            phrase!("Refusal.NeedsDevice", "Choose {what} for “{name}”.")
        }
        R::NoDevice(name) => phrase!("Refusal.NoDevice", "“{name}” has no sense or action."),
        R::OrdinaryDevice => phrase!("Refusal.OrdinaryDevice", "An ordinary stream has no sense or action."),
        R::Device(reason) => phrase!("Refusal.Device", "{^reason}."),
        R::Body(reason) => phrase!("Refusal.Body", "This procedure cannot run: {reason}."),
        R::TakesMore(name, params) => {
            phrase!(
                "Refusal.TakesMore",
                "“{name}” is said to take more values than its {params} parameters. Leave the others out."
            )
        }
        R::Identifier(name) => {
            phrase!(
                "Refusal.Identifier",
                "“{name}” cannot be used as a name here. Start with a letter; use letters, digits and _ only."
            )
        }
        R::HelperUsed(name, users) => {
            phrase!("Refusal.HelperUsed", "“{name}” is still used by {users}. Change them first.")
        }
        R::UsedByMany(name, most) => {
            phrase!(
                "Refusal.UsedByMany",
                "“{name}” is used by more than {most} programs. Add a helper of the new name beside it."
            )
        }
        R::InGroup { stream, group } => {
            phrase!("Refusal.InGroup", "“{stream}” is in the group “{group}” already. Take it out there first.")
        }
        R::NotSaved(reason) => {
            phrase!("Refusal.NotSaved", "This could not be saved ({.reason}). Nothing was changed; try again.")
        }
        // Those are said above.
        R::Stale(_)
        | R::Locked { .. }
        | R::ChangedSince { .. }
        | R::NothingToUndo
        | R::Gone
        | R::Edits(_)
        | R::Malformed(_)
        | R::Reused
        | R::Name(_)
        | R::Unseen(_)
        | R::NameTaken(_)
        | R::TooLong(..)
        | R::TooMany(..)
        | R::Full(..)
        | R::TooLarge(_) => Phrase::default(),
    }
}

/// The connectors that take several streams.
fn connectors_of_many() -> Phrase {
    let many = connectors::ALL.iter().filter(|spec| spec.inputs.are_many());
    any_of(many.map(|spec| spec.called_by_people().phrase()).collect())
}

/// A sense or an action, in the middle of a sentence.
fn one_of(kind: StreamKind) -> Phrase {
    if kind == StreamKind::Sensor { phrase!("one.sense", "a sense") } else { phrase!("one.action", "an action") }
}

/// The most fields of an object that a sentence names.
const FIELDS_SAID_MAX: usize = 4;

impl Phrased for ValueType {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Any => phrase!("ValueType.Any", "anything"),
            Self::Truth => phrase!("ValueType.Truth", "true or false"),
            Self::Number { unit: Some(Unit::Fraction), .. } => Unit::Fraction.phrase(),
            Self::Number { unit: Some(unit), .. } => {
                phrase!("ValueType.NumberIn", "a number in {unit}", unit = unit)
            }
            Self::Number { unit: None, .. } => phrase!("ValueType.Number", "a number"),
            Self::Text => phrase!("ValueType.Text", "a text"),
            Self::Record(fields) => {
                let said = fields.keys().take(FIELDS_SAID_MAX).map(String::as_str);
                let more = (fields.len() > FIELDS_SAID_MAX).then_some("…");
                let fields: Vec<&str> = said.chain(more).collect();
                phrase!("ValueType.Record", "an object with {fields}")
            }
            Self::List(_) => phrase!("ValueType.List", "a list"),
            Self::Nothing => phrase!("ValueType.Nothing", "nothing"),
        }
    }
}

impl Phrased for BadId {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Id(text) => {
                phrase!("BadId.Id", "an id has 1 to {ID_MAX_CHARS} letters, digits, - or _; {text:?} does not")
            }
            Self::RecordId(text) => phrase!("BadId.RecordId", "{text:?} is not a record id like stream/3f2a"),
            Self::Kind(word) => phrase!("BadId.Kind", "{word:?} is no kind of record"),
        }
    }
}

impl Phrased for Flaw {
    fn phrase(&self) -> Phrase {
        phrase!("fault_at", "{id}: {reason}", id = self.at, reason = self.kind)
    }
}

impl Phrased for FlawKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Format(format) => phrase!("FlawKind.Format", "{format:?} is not {FORMAT}"),
            Self::Id(bad) => bad.phrase(),
            Self::IdTwice => phrase!("FlawKind.IdTwice", "this id is used twice"),
            Self::Order { here, above } => {
                phrase!(
                    "FlawKind.Order",
                    "its order {here} comes before {above}, the one above it; leave order out of the file"
                )
            }
            Self::OrderOfNothing => {
                phrase!("FlawKind.OrderOfNothing", "order names it, but there is no such stream or connector")
            }
            Self::NoStream(id) => phrase!("FlawKind.NoStream", "there is no stream {id:?}"),
            Self::NoConnector(word) => phrase!("FlawKind.NoConnector", "there is no connector {word:?}"),
            Self::NoPeriod(word) => phrase!("FlawKind.NoPeriod", "{word} needs a periodMs of 1 or more"),
            Self::InTwoGroups(id) => phrase!("FlawKind.InTwoGroups", "the stream {id:?} is in another group too"),
            Self::Tile => {
                phrase!("FlawKind.Tile", "a tile has a key from 1 to 9 of its own, and is an action, a sense or a word")
            }
            Self::BodyAndHelper => phrase!("FlawKind.BodyAndHelper", "it has both a body and a helper"),
        }
    }
}

/// These in a sentence: `merge, combine or zip`.
fn any_of(mut all: Vec<Phrase>) -> Phrase {
    match (all.pop(), all.is_empty()) {
        (Some(last), false) => phrase!("any_of", "{others} or {last}", others = all),
        (Some(last), true) => last,
        (None, _) => Phrase::default(),
    }
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
