//! Words that somebody says. The robot listens for one list of words, which cannot be changed while it listens: it has the
//! words of all that listen, and each takes its own.

use super::{Driver, Opened, Sense, at, float, time, within};
use behaviour::Value;

pub(super) const DRIVER: Driver = Driver {
    name: "WordRecognized",
    services: &["ALMemory", "ALSpeechRecognition"],
    joints: &[],
    open: |chosen| {
        let words = chosen.text("words")?.split(',').map(|word| word.trim().to_owned());
        let words: Vec<String> = words.filter(|word| !word.is_empty()).take(WORDS_MAX).collect();
        let (language, least) = (chosen.text("language")?.to_owned(), chosen.number("confidence")?);
        if words.is_empty() { None } else { Opened::sense(Words { words, language, least }) }
    },
};

/// The most words that are listened for.
const WORDS_MAX: usize = 50;

struct Words {
    words: Vec<String>,
    language: String,
    /// The least sureness.
    least: f64,
}

impl Sense for Words {
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

    /// `[phrase, sureness, ...]`, the surest first. A spotted word comes as `<...> word <...>`, an end as an empty text.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        let heard = within(value, &[0])?.as_text()?.replace("<...>", " ").trim().to_lowercase();
        let sure = at(value, &[1])?;
        let word = self.words.iter().find(|word| word.to_lowercase() == heard)?;
        (sure >= self.least)
            .then(|| Value::object([("word", Value::text(word)), ("confidence", float(sure)), ("time", time(at_ms))]))
    }
}
