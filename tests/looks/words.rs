//! What the page says, in the language of whoever looks: English, or as the page's own table has it (`static/ja.txt`).

use house::sources::Source;
use house::{Outcome, Page};
use std::collections::BTreeMap;

/// The words of one language; English needs no table.
pub(crate) struct Words {
    code: &'static str,
    table: BTreeMap<String, String>,
}

impl Words {
    pub(crate) fn english() -> Words {
        Words { code: "en", table: BTreeMap::new() }
    }

    pub(crate) fn japanese() -> Outcome<Words> {
        let text = std::fs::read_to_string(house::root().join("static/ja.txt"))?;
        let block = |block: &str| {
            let mut lines = block.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
            Some((lines.next()?.to_owned(), lines.next()?.to_owned()))
        };
        let own: BTreeMap<String, String> = text.split("\n\n").filter_map(block).collect();
        let said = |(key, english): (String, String)| Some((english, own.get(&key)?.clone()));
        let named = |key: &str| key.strip_prefix("template.").map(str::to_owned);
        let named = own.iter().filter_map(|(key, said)| Some((named(key)?, said.clone())));
        let table = named.chain(labels().into_iter().chain(english()?).filter_map(said)).collect();
        Ok(Words { code: "ja", table })
    }

    pub(crate) fn code(&self) -> &'static str {
        self.code
    }

    /// Opens the page in this language.
    pub(crate) async fn open(&self, page: &Page, url: &str) -> Outcome<()> {
        page.speaks(self.code).await?;
        page.goto(url).await
    }

    /// How an English text is said.
    pub(crate) fn say(&self, english: &str) -> String {
        self.table.get(english).map_or_else(|| english.to_owned(), Clone::clone)
    }

    /// The beginning of what is said so.
    pub(crate) fn begins(&self, english: &str) -> String {
        format!("{}*", self.say(english))
    }

    /// How an English text with holes is said: `{name}` as given, `{name*}` in this language too.
    pub(crate) fn fill(&self, english: &str, holes: &[(&str, &str)]) -> String {
        let fill = |text: String, (hole, value): &(&str, &str)| {
            text.replace(&format!("{{{hole}}}"), value).replace(&format!("{{{hole}*}}"), &self.say(value))
        };
        holes.iter().fold(self.say(english), fill)
    }

    /// The beginning of the accessible name of a stream or an action.
    pub(crate) fn stream(&self, name: &str) -> String {
        format!("{}*", self.fill("{before}, {last}", &[("before", name), ("last", "")]))
    }
}

/// The keys and the English of the words on senses, actions, helpers and connectors.
fn labels() -> Vec<(String, String)> {
    let devices = || robot::sensors().chain(robot::actuators());
    let connectors = behaviour::connectors::ALL.iter().map(|spec| spec.called_by_people());
    let labels =
        devices().flat_map(robot::Device::labels).chain(devices().map(robot::Device::called)).chain(connectors);
    let mut all: Vec<_> = labels.map(|label| (label.key, label.english.to_owned())).collect();
    for helper in robot::shipped_helpers() {
        let label = robot::helper_label(&helper).unwrap_or_default();
        all.push((format!("helper.{}", helper.name), label.to_owned()));
    }
    all
}

/// The keys of the page's sentences and of Stop's words, and the English of each, as they stand in the code.
fn english() -> Outcome<Vec<(String, String)>> {
    let mut found = Vec::new();
    let is_words = |path: &str| path.ends_with("/words.rs") || path.contains("/words/en");
    for file in Source::below("frontend/src")?.into_iter().filter(|file| is_words(&file.path)) {
        let source = file.text;
        for (at, _) in source.match_indices(": \"") {
            let key = source[..at].rsplit(|letter: char| !letter.is_alphanumeric() && letter != '_').next();
            let english = source[at + 3..].split('"').next().unwrap_or_default();
            found.extend(key.map(|key| (key.to_owned(), english.to_owned())));
        }
    }
    let stop = [
        ("stop.button", "Stop"),
        ("stop.label", "Stop the robot"),
        ("stop.title", "Stop the robot (Esc Esc)"),
        ("stop.stopped", "Stopped. The robot holds still."),
        ("stop.stopping", "Stopping …"),
        ("stop.loading", "Opening …"),
        ("stop.reload", "Open again"),
    ];
    found.extend(stop.map(|(key, english)| (key.to_owned(), english.to_owned())));
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::Words;

    #[test]
    fn words_are_those_of_the_table() -> house::Outcome<()> {
        let (english, japanese) = (Words::english(), Words::japanese()?);
        assert_eq!(english.fill("Robot: {name}", &[("name", "Blue")]), "Robot: Blue");
        assert_eq!(japanese.say("Start"), "開始");
        assert_eq!(japanese.fill("{what} settings", &[("what", "Blue")]), "Blue の設定");
        assert_eq!((english.stream("Far").as_str(), japanese.stream("Far").as_str()), ("Far, *", "Far、*"));
        Ok(())
    }
}
