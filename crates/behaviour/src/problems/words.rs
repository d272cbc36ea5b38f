//! Every problem in English: what is wrong, and what to do; and what each fix does.

use super::{Problem, ProblemKind};
use crate::words::capital;
use crate::{FixKind, Unit};
use std::fmt;

impl Problem {
    /// Says the problem in one English sentence.
    #[must_use]
    pub fn what(&self) -> String {
        ProblemSubject(self).to_string()
    }

    /// Says the problem beside its element, so without the name where the sentence has none in the middle.
    #[must_use]
    pub fn what_beside(&self) -> String {
        WordsBeside(self).to_string()
    }

    /// Says how people can solve it, in one English sentence.
    #[must_use]
    pub fn advice(&self) -> String {
        Advice(&self.kind).to_string()
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let advice = self.advice();
        let gap = if advice.is_empty() { "" } else { " " };
        write!(to, "{}{gap}{advice}", ProblemSubject(self))
    }
}

struct ProblemSubject<'a>(&'a Problem);

impl fmt::Display for ProblemSubject<'_> {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Self(Problem { name, kind, blocks, .. }) = self;
        match kind {
            ProblemKind::FewInputs(least) => write!(to, "{} needs {least} input streams or more.", capital(name)),
            ProblemKind::NoInputs => write!(to, "{} has no input streams.", capital(name)),
            ProblemKind::EmptyBody => write!(to, "{} has no procedure yet.", capital(name)),
            ProblemKind::MissingHelper(helper) => write!(to, "The helper “{helper}” does not exist."),
            ProblemKind::HelperInputs { helper, takes, gets } => {
                write!(to, "The helper “{helper}” takes {takes} values, but gets {gets}.")
            }
            ProblemKind::Helper { helper, reason } => write!(to, "The helper “{helper}” cannot run: {reason}."),
            ProblemKind::EmptyHelper(helper) => {
                write!(to, "The helper “{helper}” cannot run: it has no procedure yet.")
            }
            ProblemKind::Body(reason) => write!(to, "The procedure of {name} cannot run: {reason}."),
            ProblemKind::Device(reason) => write!(to, "{}.", capital(reason)),
            ProblemKind::NoSource => write!(to, "“{name}” gets no values."),
            ProblemKind::Unused => write!(to, "Nothing happens with “{name}” yet."),
            ProblemKind::Multiplies => {
                let becomes = if *blocks { "becomes" } else { "can become" };
                write!(to, "Values multiply at “{name}”: one reading {becomes} more than 100,000 values.")
            }
            ProblemKind::WrongUnit { wants, gets } => {
                write!(to, "{} wants {}, gets {}.", capital(name), full(*wants), gets.name())
            }
            ProblemKind::WrongType { wants, gets } => write!(to, "{} wants {wants}, gets {gets}.", capital(name)),
            ProblemKind::FightingActions { with, part } => {
                write!(to, "“{name}” and “{with}” want the {part} at the same time, and the later one wins.")
            }
            ProblemKind::PressAndRelease { sense } => write!(to, "“{name}” also acts when “{sense}” is let go."),
            ProblemKind::StaleCombine { old, with } => {
                write!(to, "“{with}” is combined with the last “{old}”, however long ago that was.")
            }
            ProblemKind::FasterThanAction { sense } => {
                write!(to, "“{sense}” tells “{name}” many times a second, and it takes longer than that.")
            }
            ProblemKind::ObjectAsNumber { name } => {
                write!(to, "“{name}” is an object, and here a number is wanted.")
            }
            ProblemKind::UnknownName { name, .. } => write!(to, "No “{name}” here."),
            ProblemKind::Stores => to.write_str("“=” stores a value, and a test compares with “==”."),
            ProblemKind::NoAnswer { gives } => {
                write!(to, "A test must give true or false, and this one gives {gives}.")
            }
            ProblemKind::OtherwiseDiffers { name, test } => {
                write!(to, "“{name}” is not the other side of “{test}”: some values pass both, or neither.")
            }
            ProblemKind::WholeDivision { written, gives, .. } => {
                write!(to, "“{written}” is {gives}: of whole numbers, what is left over is lost.")
            }
        }
    }
}

struct WordsBeside<'a>(&'a Problem);

impl fmt::Display for WordsBeside<'_> {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match &self.0.kind {
            ProblemKind::WrongUnit { wants, gets } => write!(to, "Wants {}, gets {}.", full(*wants), gets.name()),
            ProblemKind::WrongType { wants, gets } => write!(to, "Wants {wants}, gets {gets}."),
            _ => write!(to, "{}", ProblemSubject(self.0)),
        }
    }
}

struct Advice<'a>(&'a ProblemKind);

impl fmt::Display for Advice<'_> {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            ProblemKind::FewInputs(_) | ProblemKind::NoInputs => to.write_str("Add one."),
            ProblemKind::EmptyBody => to.write_str("Write one or choose a helper."),
            ProblemKind::MissingHelper(_) => to.write_str("Choose another or add it."),
            ProblemKind::HelperInputs { .. } => to.write_str("Choose another."),
            ProblemKind::NoSource => to.write_str("Lead a connector to it."),
            ProblemKind::Unused => to.write_str("Add an action."),
            ProblemKind::Multiplies => {
                to.write_str("Lead fewer ways of the same stream together there, or put a sample before it.")
            }
            ProblemKind::WrongUnit { wants, gets } if wants.quantity() == gets.quantity() => {
                to.write_str("Convert it.")
            }
            ProblemKind::WrongUnit { .. } => to.write_str("Choose another value."),
            ProblemKind::WrongType { .. } => to.write_str("Put a helper between, or choose another."),
            ProblemKind::FightingActions { .. } => {
                to.write_str("Say which comes first, or tell them apart with filters.")
            }
            ProblemKind::PressAndRelease { .. } => to.write_str("Filter for touched, if that is not wanted."),
            ProblemKind::StaleCombine { .. } => to.write_str("Leave out what is too old."),
            ProblemKind::FasterThanAction { .. } => to.write_str("Put a sample before it."),
            ProblemKind::ObjectAsNumber { .. } => to.write_str("Use a part of it."),
            ProblemKind::UnknownName { near, .. } => write!(to, "Is “{near}” meant?"),
            ProblemKind::Stores => to.write_str("Write “==”."),
            ProblemKind::NoAnswer { .. } => to.write_str("Compare it with something."),
            ProblemKind::OtherwiseDiffers { .. } => to.write_str("Let it follow, or give it a name of its own."),
            ProblemKind::WholeDivision { meant, .. } => write!(to, "Write “{meant}”."),
            ProblemKind::Helper { .. }
            | ProblemKind::EmptyHelper(_)
            | ProblemKind::Body(_)
            | ProblemKind::Device(_) => Ok(()),
        }
    }
}

impl fmt::Display for FixKind {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Convert { to: Unit::Fraction, .. } => to.write_str("Convert to a fraction."),
            Self::Convert { to: wanted, .. } => write!(to, "Convert to {}.", full(*wanted)),
            Self::UseHelper(helper) => write!(to, "Use “{helper}” instead."),
            Self::PutHelper(helper) => write!(to, "Put “{helper}” between."),
            Self::Prefer(name) => write!(to, "Give “{name}” the first place."),
            Self::OnlyPressed => to.write_str("Only when touched."),
            Self::SlowDown(ms) if *ms == 1_000 => to.write_str("Once a second."),
            Self::SlowDown(ms) => write!(to, "Every {} s.", *ms as f64 / 1_000.0),
            Self::OnlyChanges => to.write_str("Only when it changes."),
            Self::LeaveOutOld(ms) => write!(to, "Leave out what is older than {} s.", *ms as f64 / 1_000.0),
            Self::Rename { to: meant, .. } => write!(to, "Use “{meant}”."),
        }
    }
}

/// A unit as the wish of an action or a helper.
fn full(unit: Unit) -> &'static str {
    match unit {
        Unit::Metres => "metres",
        Unit::Centimetres => "centimetres",
        Unit::Radians => "radians",
        Unit::Degrees => "degrees",
        Unit::Seconds => "seconds",
        Unit::Milliseconds => "milliseconds",
        Unit::Percent => "percent",
        Unit::Fraction | Unit::MetresPerSecond | Unit::RadiansPerSecond => unit.name(),
    }
}

#[cfg(test)]
mod tests {
    use crate::{FixKind, Id, Kind, Problem, ProblemKind, RecordId, Unit, ValueType};

    #[test]
    fn hints_and_fixes_are_sentences_and_go_over_the_wire() {
        let text = |text: &str| text.to_owned();
        let all = [
            ProblemKind::WrongUnit { wants: Unit::Metres, gets: Unit::Centimetres },
            ProblemKind::WrongType { wants: ValueType::NUMBER, gets: ValueType::record([("x", ValueType::NUMBER)]) },
            ProblemKind::FightingActions { with: text("Follow"), part: text("head") },
            ProblemKind::PressAndRelease { sense: text("Touch") },
            ProblemKind::StaleCombine { old: text("Ball"), with: text("Yaw") },
            ProblemKind::FasterThanAction { sense: text("Ball") },
            ProblemKind::UnknownName { name: text("bal"), near: text("ball") },
            ProblemKind::ObjectAsNumber { name: text("ball") },
            ProblemKind::Stores,
            ProblemKind::OtherwiseDiffers { name: text("Otherwise"), test: text("Near") },
            ProblemKind::NoAnswer { gives: ValueType::Text },
            ProblemKind::WholeDivision { written: text("1/2"), gives: 0, meant: text("1.0/2") },
        ];
        for kind in all {
            let at = RecordId::new(Kind::Stream, &Id::new("a").unwrap());
            let problem = Problem { at, name: text("Say"), kind, blocks: false };
            let said = problem.to_string();
            assert!(said.ends_with(['.', '?']) && !said.contains("  "), "{said}");
            assert_eq!(said, format!("{} {}", problem.what(), problem.advice()));
            let json = serde_json::to_string(&problem).unwrap();
            assert_eq!(serde_json::from_str::<Problem>(&json).unwrap(), problem);
        }
        let convert = |from, to| FixKind::Convert { from, to }.to_string();
        assert_eq!(convert(Unit::Centimetres, Unit::Metres), "Convert to metres.");
        assert_eq!(convert(Unit::Percent, Unit::Fraction), "Convert to a fraction.");
        assert_eq!(FixKind::SlowDown(500).to_string(), "Every 0.5 s.");
        let mistyped = FixKind::Rename { from: text("blo"), to: text("blob") };
        assert_eq!(mistyped.to_string(), "Use “blob”.");
    }

    #[test]
    fn beside_what_has_it_a_wish_needs_no_name() {
        let at = RecordId::new(Kind::Connector, &Id::new("a").unwrap());
        let kind = ProblemKind::WrongUnit { wants: Unit::Metres, gets: Unit::Centimetres };
        let problem = Problem { at, name: "map".to_owned(), kind, blocks: false };
        assert_eq!(problem.to_string(), "Map wants metres, gets cm. Convert it.");
        assert_eq!(problem.what_beside(), "Wants metres, gets cm.");
    }
}
