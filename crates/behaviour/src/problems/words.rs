//! Every problem in English: what is wrong, and what to do; and what each fix does.

use super::{Problem, ProblemKind};
use crate::{FixKind, Kind, Unit, connectors};
use phrase::{Phrase, Phrased, phrase, shown};

shown!(Problem, FixKind);

impl Problem {
    /// Says the problem in one sentence.
    #[must_use]
    pub fn what(&self) -> Phrase {
        ProblemSubject(self).phrase()
    }

    /// Names what has the problem: a stream by its name, a connector by its word.
    fn subject(&self) -> Phrase {
        let spec = connectors::ALL.iter().find(|spec| self.at.kind == Kind::Connector && spec.word == self.name);
        spec.map_or_else(|| self.name.phrase(), |spec| spec.phrase())
    }

    /// Says the problem beside its element, so without the name where the sentence has none in the middle.
    #[must_use]
    pub fn what_beside(&self) -> Phrase {
        WordsBeside(self).phrase()
    }

    /// Says how people can solve it, in one sentence.
    #[must_use]
    pub fn advice(&self) -> Phrase {
        Advice(&self.kind).phrase()
    }
}

impl Phrased for Problem {
    fn phrase(&self) -> Phrase {
        let (what, advice) = (self.what(), self.advice());
        if advice.is_empty() { what } else { phrase!("Problem", "{what} {advice}") }
    }
}

struct ProblemSubject<'a>(&'a Problem);

impl Phrased for ProblemSubject<'_> {
    fn phrase(&self) -> Phrase {
        let Self(problem @ Problem { kind, blocks, .. }) = self;
        let name = problem.subject();
        match kind {
            ProblemKind::FewInputs(least) => {
                phrase!("Problem.FewInputs", "{^name} needs {least} input streams or more.")
            }
            ProblemKind::NoInputs => phrase!("Problem.NoInputs", "{^name} has no input streams."),
            ProblemKind::EmptyBody => phrase!("Problem.EmptyBody", "{^name} has no procedure yet."),
            ProblemKind::MissingHelper(helper) => {
                phrase!("Problem.MissingHelper", "The helper “{helper}” does not exist.")
            }
            ProblemKind::HelperInputs { helper, takes, gets } => {
                phrase!("Problem.HelperInputs", "The helper “{helper}” takes {takes} values, but gets {gets}.")
            }
            ProblemKind::Helper { helper, reason } => {
                phrase!("Problem.Helper", "The helper “{helper}” cannot run: {reason}.")
            }
            ProblemKind::EmptyHelper(helper) => {
                phrase!("Problem.EmptyHelper", "The helper “{helper}” cannot run: it has no procedure yet.")
            }
            ProblemKind::Body(reason) => phrase!("Problem.Body", "The procedure of {name} cannot run: {reason}."),
            ProblemKind::Device(reason) => phrase!("Problem.Device", "{^reason}."),
            ProblemKind::NoSource => phrase!("Problem.NoSource", "“{name}” gets no values."),
            ProblemKind::Unused => phrase!("Problem.Unused", "Nothing happens with “{name}” yet."),
            ProblemKind::Multiplies => {
                let becomes = if *blocks {
                    phrase!("Problem.becomes", "becomes")
                } else {
                    phrase!("Problem.can_become", "can become")
                };
                phrase!(
                    "Problem.Multiplies",
                    "Values multiply at “{name}”: one reading {becomes} more than 100,000 values."
                )
            }
            ProblemKind::WrongUnit { wants, gets } => {
                phrase!("Problem.WrongUnit", "{^name} wants {wants}, gets {gets}.", wants = full(*wants), gets = gets)
            }
            ProblemKind::WrongType { wants, gets } => {
                phrase!("Problem.WrongType", "{^name} wants {wants}, gets {gets}.")
            }
            ProblemKind::FightingActions { with, part } => {
                phrase!(
                    "Problem.FightingActions",
                    "“{name}” and “{with}” want the {part} at the same time, and the later one wins.",
                    part = Phrase::named(format!("part.{part}"), part.clone())
                )
            }
            ProblemKind::PressAndRelease { sense } => {
                phrase!("Problem.PressAndRelease", "“{name}” also acts when “{sense}” is let go.")
            }
            ProblemKind::StaleCombine { old, with } => {
                phrase!(
                    "Problem.StaleCombine",
                    "“{with}” is combined with the last “{old}”, however long ago that was."
                )
            }
            ProblemKind::FasterThanAction { sense } => {
                phrase!(
                    "Problem.FasterThanAction",
                    "“{sense}” tells “{name}” many times a second, and it takes longer than that."
                )
            }
            ProblemKind::ObjectAsNumber { name } => {
                phrase!("Problem.ObjectAsNumber", "“{name}” is an object, and here a number is wanted.")
            }
            ProblemKind::UnknownName { name, .. } => phrase!("Problem.UnknownName", "No “{name}” here."),
            ProblemKind::Stores => phrase!("Problem.Stores", "“=” stores a value, and a test compares with “==”."),
            ProblemKind::NoAnswer { gives } => {
                phrase!("Problem.NoAnswer", "A test must give true or false, and this one gives {gives}.")
            }
            ProblemKind::OtherwiseDiffers { name, test } => {
                phrase!(
                    "Problem.OtherwiseDiffers",
                    "“{name}” is not the other side of “{test}”: some values pass both, or neither."
                )
            }
            ProblemKind::WholeDivision { written, gives, .. } => {
                phrase!("Problem.WholeDivision", "“{written}” is {gives}: of whole numbers, what is left over is lost.")
            }
        }
    }
}

struct WordsBeside<'a>(&'a Problem);

impl Phrased for WordsBeside<'_> {
    fn phrase(&self) -> Phrase {
        match &self.0.kind {
            ProblemKind::WrongUnit { wants, gets } => {
                phrase!("Problem.BesideWrongUnit", "Wants {wants}, gets {gets}.", wants = full(*wants), gets = gets)
            }
            ProblemKind::WrongType { wants, gets } => phrase!("Problem.BesideWrongType", "Wants {wants}, gets {gets}."),
            _ => ProblemSubject(self.0).phrase(),
        }
    }
}

struct Advice<'a>(&'a ProblemKind);

impl Phrased for Advice<'_> {
    fn phrase(&self) -> Phrase {
        match self.0 {
            ProblemKind::FewInputs(_) | ProblemKind::NoInputs => phrase!("Problem.AdviceInputs", "Add one."),
            ProblemKind::EmptyBody => phrase!("Problem.AdviceEmptyBody", "Write one or choose a helper."),
            ProblemKind::MissingHelper(_) => phrase!("Problem.AdviceMissingHelper", "Choose another or add it."),
            ProblemKind::HelperInputs { .. } => phrase!("Problem.AdviceHelperInputs", "Choose another."),
            ProblemKind::NoSource => phrase!("Problem.AdviceNoSource", "Lead a connector to it."),
            ProblemKind::Unused => phrase!("Problem.AdviceUnused", "Add an action."),
            ProblemKind::Multiplies => {
                phrase!(
                    "Problem.AdviceMultiplies",
                    "Lead fewer ways of the same stream together there, or put a sample before it."
                )
            }
            ProblemKind::WrongUnit { wants, gets } if wants.quantity() == gets.quantity() => {
                phrase!("Problem.AdviceWrongUnit", "Convert it.")
            }
            ProblemKind::WrongUnit { .. } => phrase!("Problem.AdviceOtherUnit", "Choose another value."),
            ProblemKind::WrongType { .. } => {
                phrase!("Problem.AdviceWrongType", "Put a helper between, or choose another.")
            }
            ProblemKind::FightingActions { .. } => {
                phrase!("Problem.AdviceFightingActions", "Say which comes first, or tell them apart with filters.")
            }
            ProblemKind::PressAndRelease { .. } => {
                phrase!("Problem.AdvicePressAndRelease", "Filter for touched, if that is not wanted.")
            }
            ProblemKind::StaleCombine { .. } => phrase!("Problem.AdviceStaleCombine", "Leave out what is too old."),
            ProblemKind::FasterThanAction { .. } => {
                phrase!("Problem.AdviceFasterThanAction", "Put a sample before it.")
            }
            ProblemKind::ObjectAsNumber { .. } => phrase!("Problem.AdviceObjectAsNumber", "Use a part of it."),
            ProblemKind::UnknownName { near, .. } => phrase!("Problem.AdviceUnknownName", "Is “{near}” meant?"),
            ProblemKind::Stores => phrase!("Problem.AdviceStores", "Write “==”."),
            ProblemKind::NoAnswer { .. } => phrase!("Problem.AdviceNoAnswer", "Compare it with something."),
            ProblemKind::OtherwiseDiffers { .. } => {
                phrase!("Problem.AdviceOtherwiseDiffers", "Let it follow, or give it a name of its own.")
            }
            ProblemKind::WholeDivision { meant, .. } => phrase!("Problem.AdviceWholeDivision", "Write “{meant}”."),
            ProblemKind::Helper { .. }
            | ProblemKind::EmptyHelper(_)
            | ProblemKind::Body(_)
            | ProblemKind::Device(_) => Phrase::default(),
        }
    }
}

impl Phrased for FixKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Convert { to: Unit::Fraction, .. } => phrase!("FixKind.ToFraction", "Convert to a fraction."),
            Self::Convert { to: wanted, .. } => phrase!("FixKind.Convert", "Convert to {unit}.", unit = full(*wanted)),
            Self::UseHelper(helper) => phrase!("FixKind.UseHelper", "Use “{helper}” instead."),
            Self::PutHelper(helper) => phrase!("FixKind.PutHelper", "Put “{helper}” between."),
            Self::Prefer(name) => phrase!("FixKind.Prefer", "Give “{name}” the first place."),
            Self::OnlyPressed => phrase!("FixKind.OnlyPressed", "Only when touched."),
            Self::SlowDown(ms) if *ms == 1_000 => phrase!("FixKind.OnceASecond", "Once a second."),
            Self::SlowDown(ms) => phrase!("FixKind.SlowDown", "Every {seconds} s.", seconds = *ms as f64 / 1_000.0),
            Self::OnlyChanges => phrase!("FixKind.OnlyChanges", "Only when it changes."),
            Self::LeaveOutOld(ms) => phrase!(
                "FixKind.LeaveOutOld",
                "Leave out what is older than {seconds} s.",
                seconds = *ms as f64 / 1_000.0
            ),
            Self::Rename { to: meant, .. } => phrase!("FixKind.Rename", "Use “{meant}”."),
        }
    }
}

/// A unit as the wish of an action or a helper.
fn full(unit: Unit) -> Phrase {
    match unit {
        Unit::Metres => phrase!("unit.full.m", "metres"),
        Unit::Centimetres => phrase!("unit.full.cm", "centimetres"),
        Unit::Radians => phrase!("unit.full.rad", "radians"),
        Unit::Degrees => phrase!("unit.full.deg", "degrees"),
        Unit::Seconds => phrase!("unit.full.s", "seconds"),
        Unit::Milliseconds => phrase!("unit.full.ms", "milliseconds"),
        Unit::Percent => phrase!("unit.full.percent", "percent"),
        Unit::Fraction | Unit::MetresPerSecond | Unit::RadiansPerSecond => unit.phrase(),
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
        assert_eq!(problem.what_beside().to_string(), "Wants metres, gets cm.");
    }
}
