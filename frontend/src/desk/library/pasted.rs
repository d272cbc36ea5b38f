//! A whole program as a text that somebody pasted.

use super::files::{FILE_MAX_BYTES, bring};
use crate::desk::LibraryPanel;
use crate::words;
use protocol::Role;
use std::sync::Arc;
use wasm_bindgen::JsValue;

/// The text of a whole program. A copy is the same text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pasted(Arc<str>);

impl Pasted {
    /// A text that says of itself that it is a program, as JSON or XML; whether it is a good one, the server says.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let text = text.trim_start_matches('\u{feff}').trim();
        let is_json = text.starts_with('{') && text.contains("\"rrp-behaviour/");
        let is_xml = || text.starts_with('<') && root(text).is_some_and(|root| root == "behaviour");
        let is_one = text.len() as f64 <= FILE_MAX_BYTES && (is_json || is_xml());
        is_one.then(|| Self(text.into()))
    }
}

/// The name of the first element of an XML text.
fn root(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        let inside = rest.trim_start().strip_prefix('<')?;
        rest = match inside.strip_prefix("!--") {
            Some(comment) => comment.split_once("-->")?.1,
            None if inside.starts_with('?') => inside.split_once("?>")?.1,
            None => return inside.split(|c: char| c.is_whitespace() || "/>".contains(c)).next(),
        };
    }
}

impl LibraryPanel {
    /// Makes a program out of a pasted one and opens it, or says why not.
    pub(crate) fn open_pasted(&self, pasted: &Pasted) {
        if self.tab.refuses(Role::Editor) {
            return;
        }
        let (library, me, text) = (self.clone(), self.tab.my_name(), JsValue::from_str(&pasted.0));
        wasm_bindgen_futures::spawn_local(async move {
            match bring(&text, &me).await {
                Ok(brought) => {
                    library.document.open_program(&brought.id);
                    library.tab.say(&words::pasted_opened(&brought.name, &brought.renamed_helpers), false);
                }
                Err(why) => library.tab.say(&words::not_brought(&why), true),
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::Pasted;

    #[test]
    fn a_whole_program_is_told_from_any_other_text() {
        let whole = [
            "{\n  \"format\": \"rrp-behaviour/1\",\n  \"name\": \"Small\" }",
            "\u{feff} {\"name\":\"x\",\"format\":\"rrp-behaviour/2\"}\n",
            "<?xml version=\"1.0\"?>\n<!-- saved <today> -->\n<behaviour format=\"1\" name=\"Small\">",
            "<behaviour>",
        ];
        let other = [
            "",
            "{}",
            "{\"format\":\"rrp-part/1\",\"records\":{},\"helpers\":[]}",
            "When the head is touched, the robot says “rrp-behaviour/1”.",
            "<svg><behaviour/></svg>",
            "<behaviours>",
            "<!-- <behaviour> -->",
            "<Behavior xmlns=\"http://www.ald.softbank.com/schema/choregraphe/behavior.xsd\">",
        ];
        for text in whole {
            assert!(Pasted::read(text).is_some(), "{text}");
        }
        for text in other {
            assert_eq!(Pasted::read(text), None, "{text}");
        }
    }
}
