//! Connectors told one by one.

use super::SentenceTeller;
use super::chain::ChainConnector;
use crate::carried::{CarriedKind, ValueMeasure};
use crate::does::{Calc, RememberedKind, SpokenConnector};
use crate::numbers;
use crate::pattern::{HoleFiller, PatternElement, filled, grammar, marked};
use crate::sentence::{Choosable, LiteralPlace, Piece, SentenceChoice};
use crate::test::{Asks, COMPARISONS, Comparison, ValueTest};
use crate::token::{code, quoted};
use behaviour::Procedure;

impl<'a> SentenceTeller<'a> {
    /// Links after a start, each after a comma.
    pub(super) fn steps(&mut self, links: &[ChainConnector<'a>]) {
        let mut at = 0;
        while let Some(link) = links.get(at) {
            self.text(self.words.comma);
            if is_drawn(&links[at..]) {
                let pieces = self.step_pieces("step.chance", &links[at + 2]);
                self.push(pieces, &links[at..at + DRAWN_LINKS], &[]);
                at += DRAWN_LINKS;
                continue;
            }
            if let Some(used) = self.held(&links[at..]).or_else(|| self.restricted(&links[at..])) {
                at += used;
                continue;
            }
            if link.connector.inputs.len() > 1 {
                self.join(link);
            } else {
                let pieces = self.step_pieces(self.step_rule(link), link);
                self.push(pieces, &links[at..=at], &[]);
            }
            at += 1;
        }
    }

    /// The rule by which a link with one input is told.
    fn step_rule(&self, link: &ChainConnector) -> &'static str {
        match &link.does {
            SpokenConnector::Make(calc) => self.make_rule(calc),
            SpokenConnector::Keep(test) if !self.names_field(test, &link.carried) => "step.test",
            SpokenConnector::Keep(_) => "step.testField",
            SpokenConnector::KeepBy(Calc::Helper(_)) => "step.keepHelper",
            SpokenConnector::KeepBy(_) => "step.keepCode",
            SpokenConnector::Every(_) => "step.every",
            SpokenConnector::Later(_) => "step.later",
            SpokenConnector::Quiet(_) => "step.quiet",
            SpokenConnector::Stamp => "step.stamp",
            SpokenConnector::Changed(None) => "step.changed",
            SpokenConnector::Changed(Some(Calc::Field(_))) => "step.changedField",
            SpokenConnector::Changed(Some(Calc::Helper(_))) => "step.changedHelper",
            SpokenConnector::Changed(Some(_)) => "step.changedCode",
            SpokenConnector::Remember(memory) => memory_rule(memory),
            SpokenConnector::Any => "step.any",
            SpokenConnector::Together(calc) | SpokenConnector::Latest(calc) => {
                if matches!(calc, Calc::Helper(_)) {
                    "alone.helper"
                } else {
                    "alone.code"
                }
            }
        }
    }

    fn make_rule(&self, calc: &Calc) -> &'static str {
        match calc {
            Calc::Helper(name) if self.known.knows(name) => match name.as_str() {
                "distance" => "step.distance",
                "ball_to_distance" => "step.ball_to_distance",
                "ball_x_and_distance" => "step.ball_x_and_distance",
                "distance_to_brightness" => "step.distance_to_brightness",
                _ => "step.select_arm",
            },
            Calc::Helper(_) => "step.helper",
            Calc::Field(_) => "step.field",
            Calc::Text(_) => "step.text",
            Calc::OneOf(_) => "step.oneOf",
            Calc::Number(_) => "step.number",
            Calc::Sum | Calc::Last | Calc::Written(..) => "step.code",
        }
    }

    /// Whether a test is told with the name of its field.
    fn names_field(&self, test: &ValueTest, carried: &CarriedKind) -> bool {
        let Some(field) = &test.field else { return false };
        match &test.asks {
            Asks::Truth(truth) => grammar(self.language).rule(&truth_rule(*truth, Some(field))).is_empty(),
            Asks::Numbers(_) => !(*carried == CarriedKind::Sides && field == "d"),
            Asks::Text(..) => true,
        }
    }

    /// A link with several inputs: with the others in brackets.
    fn join(&mut self, link: &ChainConnector<'a>) {
        let (kind, calc) = match &link.does {
            SpokenConnector::Latest(calc) => ("latest", calc),
            SpokenConnector::Together(calc) => ("together", calc),
            _ => ("together", &Calc::Last),
        };
        let way = match calc {
            Calc::Sum => "sum",
            Calc::Last => "last",
            Calc::Helper(_) => "helper",
            _ => "code",
        };
        let language = self.language;
        for element in grammar(language).told(&format!("{kind}.{way}")) {
            match element {
                PatternElement::Hole("others") => {
                    for (at, other) in link.connector.inputs.iter().enumerate().skip(1) {
                        if at > 1 {
                            self.text(self.words.and);
                        }
                        let chain = self.known.chain(other);
                        self.group(&chain);
                    }
                }
                element => {
                    let pieces = self.rule_pieces(std::slice::from_ref(element), link);
                    self.push(pieces, std::slice::from_ref(link), &[]);
                }
            }
        }
    }

    /// The words of a rule for a link.
    pub(super) fn step_pieces(&self, rule: &str, link: &ChainConnector) -> Vec<Piece> {
        self.rule_pieces(grammar(self.language).told(rule), link)
    }

    fn rule_pieces(&self, rule: &[PatternElement], link: &ChainConnector) -> Vec<Piece> {
        let mut fill = |hole: &str| {
            let pieces = self.step_hole(hole, link)?;
            Some(HoleFiller { pieces, is_default: false })
        };
        let mut mark = |shown: &str| Piece::Text(shown.to_owned());
        filled(rule, &mut fill, &mut mark).map_or_else(Vec::new, |filling| filling.pieces)
    }

    fn step_hole(&self, hole: &str, link: &ChainConnector) -> Option<Vec<Piece>> {
        let one = |text: String| Some(vec![Piece::Text(text)]);
        match (hole, &link.does) {
            ("d" | "every", SpokenConnector::Every(ms) | SpokenConnector::Later(ms) | SpokenConnector::Quiet(ms)) => {
                let at = LiteralPlace::Period { connector: link.id.clone() };
                Some(vec![Piece::Number(numbers::duration(*ms, at, self.language, hole == "every"))])
            }
            ("test", SpokenConnector::Keep(_)) => Some(self.test_pieces(link)),
            ("field", SpokenConnector::Keep(ValueTest { field: Some(field), .. })) => one(self.field(field)),
            (
                "field",
                SpokenConnector::Make(Calc::Field(field)) | SpokenConnector::Changed(Some(Calc::Field(field))),
            ) => one(self.field(field)),
            ("texts", SpokenConnector::Make(Calc::OneOf(texts))) => {
                let texts: Vec<String> = texts.iter().map(|text| quoted(text, self.language)).collect();
                one(texts.join(self.words.or))
            }
            ("quoted", SpokenConnector::Make(Calc::Text(text))) => one(quoted(text, self.language)),
            ("n", SpokenConnector::Make(Calc::Number(number))) => {
                Some(vec![Piece::Number(numbers::number(*number, "", whole_body(link), None))])
            }
            ("n", SpokenConnector::Remember(RememberedKind::Rounds(most))) => one(most.to_string()),
            ("d", SpokenConnector::Remember(RememberedKind::Rests(ms))) => {
                // It stands in the code and at the start: it is not changed in the sentence.
                let nowhere = LiteralPlace::Period { connector: link.id.clone() };
                one(numbers::duration(*ms, nowhere, self.language, false).text)
            }
            ("start", SpokenConnector::Remember(RememberedKind::By(_, start))) => one(code(&start.to_string())),
            ("helper", does) => match does.calc()? {
                Calc::Helper(name) => one(quoted(name, self.language)),
                _ => None,
            },
            ("code", does) => match does.calc()? {
                Calc::Written(args, body) => one(code(&Calc::quoted(args, body, before(does)))),
                _ => None,
            },
            _ => None,
        }
    }

    /// A field by its word, or as it is written.
    fn field(&self, name: &str) -> String {
        self.words.field(name).map_or_else(|| quoted(name, self.language), str::to_owned)
    }

    /// What a link asks of its values.
    pub(super) fn test_pieces(&self, link: &ChainConnector) -> Vec<Piece> {
        let SpokenConnector::Keep(test) = &link.does else { return Vec::new() };
        let grammar = grammar(self.language);
        match &test.asks {
            Asks::Truth(truth) => {
                let own = grammar.told(&truth_rule(*truth, test.field.as_deref()));
                let plain = grammar.told(if *truth { "is" } else { "isNot" });
                self.pieces(if own.is_empty() { plain } else { own }, None)
            }
            Asks::Text(is, text) => {
                let rule = grammar.told(if *is { "text.is" } else { "text.isNot" });
                self.pieces(rule, Some(&quoted(text, self.language)))
            }
            Asks::Numbers(numbers) => {
                let last = numbers.len() - 1;
                let one =
                    |(at, number): (usize, &(Comparison, f64))| self.comparison(link, test, at, *number, at < last);
                let mut all: Vec<Vec<Piece>> = numbers.iter().enumerate().map(one).collect();
                for pieces in all.iter_mut().skip(1) {
                    match pieces.first_mut() {
                        Some(Piece::Text(text)) if text == " " => text.clear(),
                        _ => pieces.insert(0, Piece::Text(" ".to_owned())),
                    }
                }
                all.concat()
            }
        }
    }

    /// The kind of words in which a link compares its values or a field of them, and their unit.
    pub(super) fn measured(&self, link: &ChainConnector, field: Option<&str>) -> (&'static str, String) {
        match link.carried.measure(field) {
            ValueMeasure::Distance(unit) => ("near", unit.to_owned()),
            ValueMeasure::Number(unit) if unit.is_empty() && field.is_none() => {
                ("plain", (self.unit)(link.from).unwrap_or_default())
            }
            ValueMeasure::Number(unit) => ("plain", unit),
        }
    }

    fn comparison(
        &self,
        link: &ChainConnector,
        test: &ValueTest,
        at: usize,
        number: (Comparison, f64),
        more: bool,
    ) -> Vec<Piece> {
        let (comparison, value) = number;
        let (class, unit) = self.measured(link, test.field.as_deref());
        let (sign, literal) = link.places.get(at).cloned().unwrap_or_default();
        let place = |range: std::ops::Range<usize>| LiteralPlace::Body {
            connector: link.id.clone(),
            start: range.start,
            end: range.end,
        };
        let and = if more { ".and" } else { "" };
        let rule = |comparison: Comparison| {
            let id = format!("{class}.{}", comparison.word());
            let then = grammar(self.language).told(&format!("{id}.then"));
            if at > 0 && !then.is_empty() { then } else { grammar(self.language).told(&(id + and)) }
        };
        let mut fill = |_: &str| {
            let piece = Piece::Number(numbers::number(value, &unit, place(literal.clone()), None));
            Some(HoleFiller { pieces: vec![piece], is_default: false })
        };
        let mut mark = |shown: &str| {
            let like = COMPARISONS.iter().filter(|(other, ..)| other.bounds() == comparison.bounds());
            let option = |(other, sign, _): &(Comparison, &str, &str)| Choosable {
                value: (*sign).to_owned(),
                words: marked(rule(*other)).unwrap_or_default().to_owned(),
            };
            let options = like.map(option).collect();
            let (text, chosen) = (shown.to_owned(), comparison.sign().to_owned());
            Piece::Choice(SentenceChoice { text, options, chosen, at: place(sign.clone()) })
        };
        filled(rule(comparison), &mut fill, &mut mark).map_or_else(Vec::new, |filling| filling.pieces)
    }
}

/// The links that choose one of several texts by chance.
const DRAWN_LINKS: usize = 3;

/// True if one of several texts is chosen by chance here.
fn is_drawn(links: &[ChainConnector]) -> bool {
    let alone = |link: &ChainConnector| link.connector.inputs.len() == 1;
    match links {
        [stamp, draws, choice, ..] => {
            stamp.does == SpokenConnector::Stamp
                && draws.does == SpokenConnector::Remember(RememberedKind::Draws)
                && matches!(choice.does, SpokenConnector::Make(Calc::OneOf(_)))
                && [stamp, draws, choice].into_iter().all(alone)
        }
        _ => false,
    }
}

/// The whole body of a link.
pub(super) fn whole_body(link: &ChainConnector) -> LiteralPlace {
    let body = match link.connector.operation.procedure() {
        Some(Procedure::Body { body, .. }) => body.as_str(),
        Some(Procedure::Helper(_)) | None => "",
    };
    let start = body.len() - body.trim_start().len();
    LiteralPlace::Body { connector: link.id.clone(), start, end: start + body.trim().len() }
}

/// The rule for something that is true, or is not.
fn truth_rule(truth: bool, field: Option<&str>) -> String {
    let is = if truth { "is" } else { "isNot" };
    field.map_or_else(|| is.to_owned(), |field| format!("{is}.{field}"))
}

fn memory_rule(memory: &RememberedKind) -> &'static str {
    match memory {
        RememberedKind::TrueOnes => "step.trueOnes",
        RememberedKind::Ones => "step.ones",
        RememberedKind::Largest => "step.largest",
        RememberedKind::Sum => "step.sum",
        RememberedKind::Turns => "step.turns",
        RememberedKind::Rounds(_) => "step.rounds",
        RememberedKind::Rests(_) => "step.rests",
        RememberedKind::Held => "step.held",
        RememberedKind::Draws => "step.draws",
        RememberedKind::By(Calc::Helper(_), _) => "step.rememberHelper",
        RememberedKind::By(..) => "step.rememberCode",
    }
}

/// The arguments that a procedure always has.
fn before(does: &SpokenConnector) -> &'static [&'static str] {
    if matches!(does, SpokenConnector::Remember(_)) { &["soFar"] } else { &[] }
}
