//! Programs as files: opening one that a person chose or dropped on the page.

use super::LibraryPanel;
use crate::desk::tab::set_if_new;
use crate::reasons::NotBrought;
use crate::{browser, words};
use behaviour::Id;
use js_sys::Reflect;
use protocol::Role;
use serde::Deserialize;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;

/// The largest file that the server takes, in bytes.
pub(super) const FILE_MAX_BYTES: f64 = (behaviour::BEHAVIOUR_MAX_BYTES + behaviour::LIBRARY_MAX_BYTES) as f64;

/// The server's answer about a file that it took.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct UploadAnswer {
    pub(super) id: Id,
    pub(super) name: String,
    /// Helpers that were there already in another form: as they were called, as they are called here.
    pub(super) renamed_helpers: Vec<(String, String)>,
}

#[derive(Deserialize)]
struct RefusedFile {
    why: phrase::Phrase,
}

/// Returns the address at which a behaviour is to be had as a file.
pub(crate) fn file_address(id: &Id, ending: &str) -> String {
    format!("/api/behaviours/{id}.{ending}")
}

/// The first file out of an input or of something dropped; `of` has `files`.
pub(crate) fn first_file(of: &JsValue) -> Option<JsValue> {
    let files = Reflect::get(of, &"files".into()).ok().filter(|files| !files.is_undefined() && !files.is_null())?;
    Reflect::get_u32(&files, 0).ok().filter(|file| !file.is_undefined())
}

impl LibraryPanel {
    /// Makes a program out of a file and opens it, or says why not.
    pub(crate) fn open_file(&self, file: JsValue) {
        if self.tab.refuses(Role::Editor) {
            return;
        }
        let (library, me) = (self.clone(), self.tab.my_name());
        wasm_bindgen_futures::spawn_local(async move {
            match bring(&file, &me).await {
                Ok(brought) => {
                    library.document.open_program(&brought.id);
                    library.tab.say(&words::file_opened(&brought.name, &brought.renamed_helpers), false);
                }
                Err(why) => library.tab.say(&words::not_brought(&why), true),
            }
        });
    }

    /// Makes a copy of a program under another name and opens it, or says why not.
    pub(crate) fn copy_program(&self, id: &Id, name: &str) {
        if self.tab.refuses(Role::Editor) {
            return;
        }
        let (library, me, address, name) =
            (self.clone(), self.tab.my_name(), file_address(id, "json"), words::copy_of(name));
        wasm_bindgen_futures::spawn_local(async move {
            let copied = match browser::text_at(&address).await {
                Some(text) => bring(&JsValue::from_str(&named(&text, &name)), &me).await,
                None => Err(NotBrought::Unreachable),
            };
            match copied {
                Ok(brought) => {
                    library.document.open_program(&brought.id);
                    library.tab.say(&words::copy_made(&brought.name), false);
                }
                Err(why) => library.tab.say(&words::not_brought(&why), true),
            }
        });
    }

    /// Files that are dropped anywhere on the page are opened.
    pub(in crate::desk) fn hear_drops(&self) {
        let Some(window) = browser::window() else { return };
        let library = self.clone();
        browser::hear(&window, "dragover", move |event| {
            if carries_file(&event) {
                prevent(&event);
                set_if_new(&library.dropping, true);
            }
        });
        let library = self.clone();
        browser::hear(&window, "dragleave", move |event| {
            let outside = Reflect::get(&event, &"relatedTarget".into()).is_ok_and(|to| to.is_null());
            if outside {
                set_if_new(&library.dropping, false);
            }
        });
        let library = self.clone();
        browser::hear(&window, "drop", move |event| {
            set_if_new(&library.dropping, false);
            let file = Reflect::get(&event, &"dataTransfer".into()).ok().and_then(|dropped| first_file(&dropped));
            if let Some(file) = file {
                prevent(&event);
                library.open_file(file);
            }
        });
    }
}

fn prevent(event: &JsValue) {
    if let Some(event) = event.dyn_ref::<web_sys::Event>() {
        event.prevent_default();
    }
}

fn carries_file(event: &JsValue) -> bool {
    let types = Reflect::get(event, &"dataTransfer".into()).and_then(|dropped| Reflect::get(&dropped, &"types".into()));
    types.is_ok_and(|types| js_sys::Array::from(&types).includes(&"Files".into(), 0))
}

/// Sends the file to the server.
pub(super) async fn bring(file: &JsValue, by: &str) -> Result<UploadAnswer, NotBrought> {
    let size = Reflect::get(file, &"size".into()).ok().and_then(|size| size.as_f64()).unwrap_or(0.0);
    if size > FILE_MAX_BYTES {
        return Err(NotBrought::TooLarge);
    }
    let (good, text) = post(file, by).await.ok_or(NotBrought::Unreachable)?;
    if good {
        return crate::json::read(&text).map_err(|_| NotBrought::Unclear);
    }
    let refused = crate::json::read::<RefusedFile>(&text).map(|refused| NotBrought::Refused(refused.why));
    Err(refused.unwrap_or(NotBrought::Unclear))
}

/// A behaviour file with another name: the first string after the first key `name`, which is that of the behaviour.
fn named(text: &str, name: &str) -> String {
    const KEY: &str = "\"name\"";
    let Some(key) = text.find(KEY) else { return text.to_owned() };
    let Some(start) = text[key + KEY.len()..].find('"').map(|at| key + KEY.len() + at) else { return text.to_owned() };
    let mut is_escaped = false;
    let end = text[start + 1..].char_indices().find(|(_, c)| {
        let ends = *c == '"' && !is_escaped;
        is_escaped = *c == '\\' && !is_escaped;
        ends
    });
    let Some((end, _)) = end else { return text.to_owned() };
    let written = serde_json::to_string(name).unwrap_or_default();
    format!("{}{written}{}", &text[..start], &text[start + 1 + end + 1..])
}

async fn post(file: &JsValue, by: &str) -> Option<(bool, String)> {
    let how = web_sys::RequestInit::new();
    how.set_method("POST");
    how.set_body(file);
    let address = format!("/api/import?mode=copy&by={}", js_sys::encode_uri_component(by));
    let answer = JsFuture::from(browser::window()?.fetch_with_str_and_init(&address, &how)).await.ok()?;
    let answer: web_sys::Response = answer.dyn_into().ok()?;
    let text = JsFuture::from(answer.text().ok()?).await.ok()?.as_string()?;
    Some((answer.ok(), text))
}

#[cfg(test)]
mod tests {
    use super::{UploadAnswer, file_address, named};
    use behaviour::Id;

    #[test]
    fn a_copy_has_another_name_and_nothing_else_changes() {
        let text = r#"{"format":"rrp-behaviour/1","name":"A \"b\" \\","helpers":[{"name":"far"}]}"#;
        let wanted = r#"{"format":"rrp-behaviour/1","name":"Copy of \"b\"","helpers":[{"name":"far"}]}"#;
        assert_eq!(named(text, "Copy of \"b\""), wanted);
        assert_eq!(named("{}", "x"), "{}");
    }

    #[test]
    fn the_answer_of_the_server_is_read() {
        let text = r#"{"id":"b-1","name":"Play","renamedHelpers":[["far","far2"]]}"#;
        let brought: UploadAnswer = serde_json::from_str(text).unwrap();
        assert_eq!((brought.name.as_str(), brought.renamed_helpers.len()), ("Play", 1));
        assert_eq!(file_address(&Id::new("b-1").unwrap(), "svg"), "/api/behaviours/b-1.svg");
    }
}
