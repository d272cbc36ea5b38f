//! Questions as they come over the wire, each with its answer.

use crate::hook::Hook;
use crate::past::Past;
use behaviour::{Behaviour, Helper, Id, Kind, Knowledge, Record, RecordId, Unit, ValueType};
use phrase::Phrased;
use protocol::{NotSeen, PartsCursor, PastAnswer, PastProgramPart, PastQuestion, ProgramSentence, TOLD_MAX};
use sentences::{Language, Sentence};

impl Past {
    /// Answers a question, but for a comparison with an edited program, which whoever asks has to build first.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn answer(
        &self,
        question: &PastQuestion,
        knowledge: &dyn Knowledge,
        hook: &Hook,
    ) -> Result<PastAnswer, NotSeen> {
        Ok(match question {
            PastQuestion::Open => PastAnswer::Opened(Box::new(self.about())),
            PastQuestion::Program { program, part, language } => {
                PastAnswer::Program(Box::new(self.program_part(*program, *part, language, knowledge)?))
            }
            PastQuestion::Lanes { lanes, from_ms, to_ms, columns } => {
                PastAnswer::Lanes(self.lanes(lanes, (*from_ms, *to_ms), *columns, hook)?)
            }
            PastQuestion::Seek { at_ms } => PastAnswer::Moment(Box::new(self.seek(*at_ms, hook)?)),
            PastQuestion::Why { stream, at_ms, nth, language } => {
                PastAnswer::Why(Box::new(self.why((stream, *at_ms, *nth), of_code(language), knowledge, hook)?))
            }
            PastQuestion::WhyNot { stream, from_ms, until_ms, language } => {
                let asked = (stream.as_str(), *from_ms, *until_ms);
                PastAnswer::WhyNot(Box::new(self.why_not(asked, of_code(language), knowledge, hook)?))
            }
            PastQuestion::Compare { .. } => return Err(NotSeen::TooMuch),
        })
    }

    fn program_part(
        &self,
        program: usize,
        part: usize,
        language: &str,
        knowledge: &dyn Knowledge,
    ) -> Result<PastProgramPart, NotSeen> {
        let file = &self.programs.get(program).ok_or(NotSeen::NoSuchProgram)?.file;
        let flaw = |flaws: Vec<behaviour::Flaw>| flaws.first().map(Phrased::phrase).unwrap_or_default();
        let mut behaviour = file.records(|_| None).map_err(|flaws| NotSeen::CannotRun(flaw(flaws)))?;
        let library = file.library();
        let sentences = if part == 0 { told(&behaviour, &library, knowledge, of_code(language)) } else { Vec::new() };
        for helper in library {
            if let Ok(id) = Id::new(&helper.name) {
                behaviour.records.insert(RecordId::new(Kind::Helper, &id), Record::Helper(helper));
            }
        }
        let mut cursor = PartsCursor::default();
        let cut = std::iter::from_fn(|| cursor.next(&behaviour)).nth(part).ok_or(NotSeen::NoSuchProgram)?;
        Ok(PastProgramPart { program, part, records: Box::new(cut.records), more: cut.more, sentences })
    }
}

/// The language of a code, English if there is none.
fn of_code(code: &str) -> Language {
    Language::ALL.into_iter().find(|known| known.code() == code).unwrap_or_default()
}

/// The symbol of the unit of numbers. That they are a share says nothing beside a number.
pub(crate) fn unit_of(of: Option<&ValueType>) -> Option<String> {
    match of {
        Some(ValueType::Number { unit: Some(unit), .. }) if *unit != Unit::Fraction => Some(unit.symbol().to_owned()),
        _ => None,
    }
}

/// The sentences of a program.
fn told(of: &Behaviour, library: &[Helper], knowledge: &dyn Knowledge, language: Language) -> Vec<ProgramSentence> {
    let helpers: Vec<&Helper> = library.iter().collect();
    let types = behaviour::infer(of, &helpers, knowledge);
    let unit = |id: &Id| unit_of(types.get(id));
    let all = sentences::explain(of, &helpers, &unit, language);
    all.iter().take(TOLD_MAX).map(Sentence::told).collect()
}
