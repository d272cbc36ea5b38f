//! Words that somebody says. The robot listens for one list of words, which cannot be changed while it listens: it has the
//! words of all that listen, and each takes its own.

use super::{NaoDriver, OpenDevice, Sense, at, float, time, within};
use behaviour::Value;

pub(super) const DRIVER: NaoDriver = NaoDriver {
    name: "WordRecognized",
    services: &["ALMemory", "ALSpeechRecognition"],
    joints: &[],
    open: |chosen| {
        let words = chosen.text("words")?.split(',').map(|word| word.trim().to_owned());
        let words: Vec<String> = words.filter(|word| !word.is_empty()).take(WORDS_MAX).collect();
        let (language, least) = (chosen.text("language")?.to_owned(), chosen.number("confidence")?);
        if words.is_empty() { None } else { OpenDevice::sense(HeardWords { words, language, least }) }
    },
};

/// The most words that are listened for.
const WORDS_MAX: usize = 50;
/// The most values of one event that are looked at: a word and its sureness each.
const CANDIDATES_MAX: usize = 40;

struct HeardWords {
    words: Vec<String>,
    language: String,
    /// The least sureness.
    least: f64,
}

impl Sense for HeardWords {
    fn keys(&self) -> Vec<&'static str> {
        vec!["WordRecognized"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALSpeechRecognition")
    }

    fn words(&self) -> Option<(&str, &[String])> {
        Some((&self.language, &self.words))
    }

    fn only(&self) -> Option<(&'static str, String)> {
        Some(("language", self.language.clone()))
    }

    /// `[phrase, sureness, phrase, sureness, ...]`, the surest first: all that it may have been. A spotted word comes as
    /// `<...> word <...>`, an end as an empty text.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        let count = value.items()?.len().min(CANDIDATES_MAX) / 2;
        (0..count).find_map(|candidate| {
            let heard = within(value, &[2 * candidate])?.as_text()?.replace("<...>", " ").trim().to_lowercase();
            let sure = at(value, &[2 * candidate + 1]).filter(|sure| *sure >= self.least)?;
            let word = self.words.iter().find(|word| word.to_lowercase() == heard)?;
            Some(Value::object([("word", Value::text(word)), ("confidence", float(sure)), ("time", time(at_ms))]))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{HeardWords, Sense};
    use behaviour::Value;

    #[test]
    fn what_it_may_have_been_is_heard_if_it_is_sure_enough() {
        let mut words = HeardWords { words: vec!["Yes".into(), "no".into()], language: "English".into(), least: 0.3 };
        let told = |pairs: &[(&str, f32)]| {
            let pair = |(word, sure): &(&str, f32)| [qi::Value::dynamic(*word), qi::Value::dynamic(*sure)];
            qi::Value::List(pairs.iter().flat_map(pair).collect())
        };
        let mut hear = |pairs: &[(&str, f32)]| {
            words.read("WordRecognized", &told(pairs), 1).and_then(|heard| heard.field("word").cloned())
        };
        assert_eq!(hear(&[("<...> yes <...>", 0.6)]), Some(Value::text("Yes")));
        assert_eq!(hear(&[("maybe", 0.6), ("no", 0.5)]), Some(Value::text("no")), "a candidate after the first");
        assert_eq!(hear(&[("maybe", 0.6), ("no", 0.1)]), None);
        assert_eq!(hear(&[("", -3.0)]), None);
    }
}
