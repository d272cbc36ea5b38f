//! Another name or other tags of a program in the library, whether it is open here or not.

use super::LibraryPanel;
use super::files::file_address;
use crate::desk::tab::new_id;
use crate::link;
use crate::link::NoAnswer;
use behaviour::labels;
use behaviour::{Behaviour, Change, Engine, Id, Record, RecordId, Settings};
use phrase::Phrase;
use protocol::{Role, request};
use serde::Deserialize;

/// The changes of a program's settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Settle {
    Name(String),
    AddTag(String),
    DropTag(String),
}

/// The settings in the file of a program; it has more.
#[derive(Deserialize)]
struct Head {
    name: String,
    #[serde(default)]
    robot: Option<String>,
    #[serde(default)]
    engine: Option<Engine>,
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    exercise: Option<String>,
}

impl Settle {
    /// Returns the label of the change in the history.
    fn label(&self) -> Phrase {
        match self {
            Self::Name(_) => labels::program_renamed(),
            Self::AddTag(_) | Self::DropTag(_) => labels::tags_edited(),
        }
    }

    /// The settings with it done; what is wrong with them the rules say.
    fn done(&self, now: &Settings) -> Settings {
        let mut settings = now.clone();
        match self {
            Self::Name(name) => name.trim().clone_into(&mut settings.name),
            Self::AddTag(tag) => settings.tags.push(tag.split_whitespace().collect::<Vec<_>>().join(" ")),
            Self::DropTag(tag) => settings.tags.retain(|known| known != tag),
        }
        settings
    }

    /// The change of a program that has these settings now.
    fn change(&self, now: &Settings, author: &str) -> Change {
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(RecordId::settings(), Record::Settings(now.clone()));
        let after = Record::Settings(self.done(now));
        Change::of(new_id(), author, self.label()).put(&behaviour, RecordId::settings(), after)
    }
}

impl Head {
    /// Returns the settings as the records have them: a file leaves out what is usual.
    fn settings(self) -> Settings {
        let usual = Settings::named(&self.name);
        let (robot, engine) = (self.robot.unwrap_or(usual.robot), self.engine.unwrap_or_default());
        Settings { name: self.name, robot, engine, tags: self.tags, exercise: self.exercise }
    }
}

impl LibraryPanel {
    /// Gives a program another name or other tags, and tells how it is then. What is open here goes the way of all edits,
    /// anything else is proposed to its room; both can be undone where it is open.
    /// `seen` is the name as its author saw it when they began to type another.
    pub(crate) fn settle(
        &self,
        id: &Id,
        seen: Option<String>,
        settle: Settle,
        then: impl FnOnce(Result<Settings, NoAnswer>) + 'static,
    ) {
        if self.tab.refuses(Role::Editor) {
            return;
        }
        let me = self.tab.my_name();
        if self.document.is_open(id) {
            let Some(now) = self.document.settings() else { return };
            let seen = as_seen(now, seen);
            let after = settle.done(&seen);
            return self.document.propose_settings(settle.change(&seen, &me), move |answer| {
                then(answer.map(|()| after).map_err(NoAnswer::Refused));
            });
        }
        let id = id.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let text = crate::browser::text_at(&file_address(&id, "json")).await;
            let head = text.and_then(|text| crate::json::read::<Head>(&text).ok());
            let Some(now) = head.map(|head| as_seen(head.settings(), seen)) else {
                return then(Err(NoAnswer::Unreachable));
            };
            let (change, after) = (settle.change(&now, &me), settle.done(&now));
            if change.edits.is_empty() {
                return then(Ok(after));
            }
            let propose = request::Propose { behaviour: id, change, tokens: Vec::new() };
            link::ask_even_down(propose, |answer| then(answer.map(|_| after)));
        });
    }
}

/// The settings with the name that was seen; the server says if there is another one by now.
fn as_seen(now: Settings, seen: Option<String>) -> Settings {
    Settings { name: seen.unwrap_or(now.name), ..now }
}

#[cfg(test)]
mod tests {
    use super::{Head, Settle};
    use behaviour::{Engine, Settings};

    #[test]
    fn the_settings_of_a_file_are_those_of_its_records() {
        let text = r#"{"format":"rrp-behaviour/1","name":"Play","tags":["group b"],"exercise":"Near","helpers":[],"streams":[]}"#;
        let settings = crate::json::read::<Head>(text).unwrap().settings();
        let (tags, exercise) = (vec!["group b".to_owned()], Some("Near".to_owned()));
        assert_eq!(settings, Settings { tags, exercise, ..Settings::named("Play") });
        let text = r#"{"name":"x","robot":"pepper","engine":{"frame":{"frameMs":50}}}"#;
        let settings = crate::json::read::<Head>(text).unwrap().settings();
        assert_eq!((settings.robot.as_str(), settings.engine), ("pepper", Engine::Frame { frame_ms: 50 }));
    }

    #[test]
    fn a_name_and_tags_are_changed_and_nothing_else() {
        let now = Settings { tags: vec!["a".to_owned()], ..Settings::named("Play") };
        assert_eq!(Settle::Name(" Ball ".to_owned()).done(&now), Settings { name: "Ball".to_owned(), ..now.clone() });
        let more = Settle::AddTag("  group   b ".to_owned()).done(&now);
        assert_eq!(more.tags, ["a", "group b"]);
        assert_eq!(Settle::DropTag("a".to_owned()).done(&more).tags, ["group b"]);
        let change = Settle::DropTag("a".to_owned()).change(&now, "Aiko");
        assert_eq!((change.label.to_string().as_str(), change.edits.len()), ("Edit tags", 1));
        assert!(
            Settle::Name("Play".to_owned()).change(&now, "Aiko").edits.iter().all(|edit| edit.before == edit.after)
        );
    }
}
