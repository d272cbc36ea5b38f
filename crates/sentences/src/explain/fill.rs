//! Holes of words filled with what a graph has there.

use super::SentenceTeller;
use super::chain::ChainConnector;
use crate::clauses::usual;
use crate::does::{Calc, SpokenConnector};
use crate::fits::same;
use crate::numbers;
use crate::pattern::{HoleFiller, PatternElement, filled};
use crate::sentence::{Choosable, LiteralPlace, Piece, SentenceChoice};
use crate::test::{Asks, ValueTest};
use crate::token::quoted;
use behaviour::{Id, Stream, Value};
use robot::{Device, Param, ParamKind};

/// What the holes of a clause are filled with.
pub(super) struct Fills<'f, 'a> {
    /// The device and its stream.
    pub(super) device: Option<(&'static Device, &'a Id, &'f Stream)>,
    /// What a tracker would follow that the sentence has named already.
    pub(super) seen: Option<&'static str>,
    /// The links that the clause tells.
    pub(super) links: &'f [ChainConnector<'a>],
}

impl SentenceTeller<'_> {
    /// A clause with its holes filled; `unit` is that of its number.
    pub(super) fn filled(&self, rule: &[PatternElement], fills: &Fills, unit: &str) -> Option<Vec<Piece>> {
        let mut fill = |hole: &str| match fills.device {
            Some((device, id, stream)) if device.params.iter().any(|param| param.name == hole) => {
                let param = device.params.iter().find(|param| param.name == hole)?;
                let chosen = stream.params.get(hole).cloned().unwrap_or_else(|| param.default());
                let piece = self.param(device, param, &chosen, id, fills.seen)?;
                let is_default = same(&chosen, &usual(device, param, self.language));
                // Nothing is told of a choice without a word.
                let pieces = if piece.text().is_empty() { Vec::new() } else { vec![piece] };
                Some(HoleFiller { pieces, is_default })
            }
            _ => fills.links.iter().find_map(|link| self.of_link(hole, link, unit)),
        };
        let mut mark = |shown: &str| Piece::Text(shown.to_owned());
        filled(rule, &mut fill, &mut mark).map(|filling| filling.pieces)
    }

    /// Words without holes but one, which has one text.
    pub(super) fn pieces(&self, rule: &[PatternElement], text: Option<&str>) -> Vec<Piece> {
        let mut fill = |_: &str| {
            let pieces = text.map(|text| Piece::Text(text.to_owned())).into_iter().collect();
            Some(HoleFiller { pieces, is_default: false })
        };
        let mut mark = |shown: &str| Piece::Text(shown.to_owned());
        filled(rule, &mut fill, &mut mark).map_or_else(Vec::new, |filling| filling.pieces)
    }

    fn param(&self, device: &Device, param: &Param, value: &Value, stream: &Id, seen: Option<&str>) -> Option<Piece> {
        let at = LiteralPlace::Param { stream: stream.clone(), param: param.name.to_owned() };
        match param.kind {
            ParamKind::Choice(_) => {
                let chosen = value.as_text()?;
                let known = self.words.choices(device.name, param.name);
                let option = |(value, says): &(&str, &[&str])| Choosable {
                    value: (*value).to_owned(),
                    words: says.first().map_or("", |says| *says).to_owned(),
                };
                let options: Vec<Choosable> = known.iter().map(option).collect();
                let words = &options.iter().find(|option| option.value == chosen)?.words;
                let is_seen = param.name == "target" && seen == Some(chosen);
                let it = || self.words.rule("target.it").first().map_or("", |it| *it).to_owned();
                let text = if is_seen { it() } else { words.clone() };
                Some(Piece::Choice(SentenceChoice { text, options, chosen: chosen.to_owned(), at }))
            }
            ParamKind::Number { unit: "ms", .. } => {
                let alone = numbers::duration(value.as_number()? as u64, at, self.language, true);
                Some(Piece::Number(alone))
            }
            ParamKind::Number { min, max, step, unit, .. } => {
                Some(Piece::Number(numbers::number(value.as_number()?, unit, at, Some((min, max, step)))))
            }
            ParamKind::Text { .. } => Some(Piece::Text(quoted(value.as_text()?, self.language))),
        }
    }

    /// What a link has for a hole of a clause.
    fn of_link(&self, hole: &str, link: &ChainConnector, unit: &str) -> Option<HoleFiller> {
        let piece = match (hole, &link.does) {
            ("d" | "every", SpokenConnector::Every(ms) | SpokenConnector::Later(ms) | SpokenConnector::Quiet(ms)) => {
                let at = LiteralPlace::Period { connector: link.id.clone() };
                Piece::Number(numbers::duration(*ms, at, self.language, hole == "every"))
            }
            ("n", SpokenConnector::Make(Calc::Number(number))) => {
                Piece::Number(numbers::number(*number, unit, super::steps::whole_body(link), None))
            }
            ("text", SpokenConnector::Keep(ValueTest { asks: Asks::Text(_, text), .. }))
            | ("quoted", SpokenConnector::Make(Calc::Text(text))) => Piece::Text(quoted(text, self.language)),
            _ => return None,
        };
        Some(HoleFiller { pieces: vec![piece], is_default: false })
    }
}
