//! The short texts on streams and connectors, and how wide they are about.

use crate::words;
use behaviour::{Connector, Procedure, Stream, Value};
use robot::{Device, Param, ParamKind};

/// The text of a connector's chip: `filter` and `(distanceToBall < 20)`, `map` and `(Distance in cm)`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ChipWords {
    pub(crate) word: String,
    pub(crate) detail: String,
    /// True if the detail is a name in words, and no code.
    pub(crate) plain: bool,
    /// True if something is compared with a number, behind which its unit may stand.
    pub(crate) compares: bool,
}

impl ChipWords {
    /// Both in one text.
    pub(crate) fn whole(&self) -> String {
        format!("{} {}", self.word, self.detail).trim_end().to_owned()
    }
}

/// Returns the words of a connector's chip.
pub(crate) fn chip_words(connector: &Connector) -> ChipWords {
    let operation = &connector.operation;
    let helper = match operation.procedure() {
        Some(Procedure::Helper(name)) => Some(name),
        Some(Procedure::Body { .. }) | None => None,
    };
    let shown = |text: &String| if Some(text) == helper { words::plain_helper(text) } else { one_line(text) };
    let mut chosen: Vec<String> = operation.chosen().iter().map(shown).collect();
    if let (Some(ms), Some(last)) = (operation.period_ms(), chosen.last_mut()) {
        *last = words::period_of(operation.spec(), ms);
    }
    let detail = if chosen.is_empty() { String::new() } else { format!("({})", chosen.join(", ")) };
    let plain = helper.is_some_and(|name| words::plain_helper(name) != *name);
    let compares = operation.spec().is_test() && helper.is_none() && compared(&detail).next().is_some();
    ChipWords { word: words::connector_word(operation.spec()).to_owned(), detail, plain, compares }
}

/// The signs with which something is compared.
const COMPARES: [&str; 6] = ["<", "<=", ">", ">=", "==", "!="];

/// Finds what is compared with a number in the text of a chip, and where that number ends in it.
fn compared(detail: &str) -> impl Iterator<Item = (&str, usize)> {
    let start = detail.as_ptr() as usize;
    let words: Vec<&str> = detail.split_whitespace().collect();
    let found: Vec<(&str, usize)> = words
        .windows(3)
        .filter_map(|three| {
            let number = three[2].trim_end_matches(')');
            let is_number = COMPARES.contains(&three[1]) && number.parse::<f64>().is_ok();
            let subject = three[0].trim_start_matches('(');
            is_number.then(|| (subject, number.as_ptr() as usize - start + number.len()))
        })
        .collect();
    found.into_iter()
}

/// The text of a chip with the unit behind each number that something is compared with; `unit` knows that of what is compared.
pub(crate) fn with_units(detail: &str, unit: impl Fn(&str) -> &'static str) -> String {
    let mut all = String::new();
    let mut from = 0;
    for (subject, end) in compared(detail) {
        all += &words::with_unit(detail[from..end].to_owned(), unit(subject));
        from = end;
    }
    all + &detail[from..]
}

fn one_line(body: &str) -> String {
    let line = body.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.is_empty() { "…".to_owned() } else { line }
}

/// The second line of a stream: its device's settings in words, "whole body · left arm".
pub(crate) fn what_it_is(stream: &Stream) -> String {
    let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
    let Some(device) = device else { return String::new() };
    let words = device.params.iter().filter_map(|param| setting(device, param, stream.params.get(param.name)));
    words.collect::<Vec<_>>().join(" · ")
}

fn setting(device: &Device, param: &Param, given: Option<&Value>) -> Option<String> {
    let default = param.default();
    let value = given.unwrap_or(&default);
    match param.kind {
        ParamKind::Choice(options) => {
            let option = options.iter().find(|option| value.as_text() == Some(option.0))?;
            (option.1 != "none").then(|| words::label_of(&device.choice_called(param, *option)).to_owned())
        }
        ParamKind::Number { unit, .. } => {
            let number = value.as_number()?;
            if *value == default && unit != "ms" {
                None
            } else {
                Some(format!("{number} {}", words::label_of(&device.unit_called(param, unit))).trim_end().to_owned())
            }
        }
        // A text that nobody chose is not told.
        ParamKind::Text { .. } => {
            value.as_text().filter(|text| !text.is_empty() || *value != default).map(words::saying)
        }
    }
}

/// Returns the width of a semibold text at a size in pixels; outside of a browser a guess, since only sizes of boxes
/// depend on it.
pub(crate) fn name_width(text: &str, size: u32) -> f64 {
    crate::browser::text_width(text, 600, size).unwrap_or_else(|| about(text, size))
}

/// Returns the width of a text in plain letters at a size in pixels; outside of a browser a guess.
pub(crate) fn text_width(text: &str, size: u32) -> f64 {
    crate::browser::text_width(text, 400, size).unwrap_or_else(|| about(text, size))
}

fn about(text: &str, size: u32) -> f64 {
    text.chars().map(char_width).sum::<f64>() * f64::from(size)
}

fn char_width(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.3,
        'f' | 'r' | 't' | ' ' | '(' | ')' | '-' | '·' | '“' | '”' => 0.4,
        'm' | 'w' | 'M' | 'W' => 0.88,
        'A'..='Z' => 0.68,
        c if (c as u32) >= 0x1100 => 1.02,
        _ => 0.57,
    }
}

#[cfg(test)]
mod tests {
    use super::{chip_words, text_width, what_it_is, with_units};
    use behaviour::{Connector, Id, Operation, Parameters, Procedure, Stream, StreamKind, Value, connectors};

    fn chip(operation: Operation) -> String {
        let id = |name: &str| Id::new(name).unwrap();
        chip_words(&Connector { operation, inputs: vec![id("a")], output: id("b"), order: 0 }).whole()
    }

    #[test]
    fn chips_say_what_they_do() {
        assert_eq!(chip(connectors::map::SPEC.with(Procedure::Helper("distance".into()))), "map (Distance in cm)");
        assert_eq!(chip(connectors::map::SPEC.with(Procedure::Helper("near_enough".into()))), "map (near_enough)");
        assert_eq!(chip(connectors::filter::SPEC.with(Procedure::body("a <\n  20"))), "filter (a < 20)");
        assert_eq!(chip(connectors::sample::SPEC.with(Parameters::period(500))), "sample (every 0.5 seconds)");
        assert_eq!(chip(connectors::delay::SPEC.with(Parameters::period(1_000))), "delay (1 second)");
        assert_eq!(chip(connectors::subscribe::SPEC.with(())), "subscribe");
        assert_eq!(chip(connectors::combine_latest::SPEC.with(Procedure::body(""))), "combine (…)");
    }

    #[test]
    fn numbers_that_something_is_compared_with_have_their_unit() {
        let unit = |subject: &str| if subject.starts_with("distance") { "m" } else { "" };
        let cases = [
            ("(distance >= 0.5)", "(distance >= 0.5\u{a0}m)"),
            ("(distance > 0.5 && distance <= 1)", "(distance > 0.5\u{a0}m && distance <= 1\u{a0}m)"),
            ("(distance.d < 20)", "(distance.d < 20\u{a0}m)"),
            ("(angle < 0.5)", "(angle < 0.5)"),
            ("(distance + 1 < other)", "(distance + 1 < other)"),
            ("(Distance in cm)", "(Distance in cm)"),
            ("(…)", "(…)"),
        ];
        for (detail, shown) in cases {
            assert_eq!(with_units(detail, unit), shown);
        }
        let compares = |body: &str| {
            let operation = connectors::filter::SPEC.with(Procedure::body(body));
            let id = |name: &str| Id::new(name).unwrap();
            chip_words(&Connector { operation, inputs: vec![id("a")], output: id("b"), order: 0 }).compares
        };
        assert!(compares("distance < 20") && !compares("true") && !compares("word == other"));
    }

    #[test]
    fn a_tracker_says_how_it_follows() {
        let mut stream = Stream {
            kind: StreamKind::Actuator,
            name: "Tracker".into(),
            device: Some("Tracker".into()),
            params: behaviour::Params::new(),
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        assert_eq!(what_it_is(&stream), "red ball · head");
        stream.params.insert("mode".into(), Value::text("WholeBody"));
        stream.params.insert("effector".into(), Value::text("LArm"));
        assert_eq!(what_it_is(&stream), "red ball · whole body · left arm");
    }

    #[test]
    fn japanese_is_wider() {
        assert!(text_width("赤いボール", 15) > text_width("Balls", 15));
    }
}
