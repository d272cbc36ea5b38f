//! Files that a page asks for, held back or answered with something else.

use base64::Engine;
use serde_json::{Value, json};

use crate::Outcome;
use crate::page::Page;

impl Page {
    /// Whatever is opened next gets this text for the file `name` of the server, in place of what the server has.
    pub async fn instead(&self, name: &str, text: &str) -> Outcome<()> {
        self.watch().answer_with(name, answer(name, text));
        self.pause().await
    }

    /// Whatever is opened next does not get the file `name` of the server before it is let go.
    pub async fn hold_back(&self, name: &str) -> Outcome<()> {
        self.watch().hold(name);
        self.pause().await
    }

    /// Waits until the file that is held back is asked for, and lets the page have it.
    pub async fn let_go(&self, name: &str) -> Outcome<()> {
        let asked = async || self.watch().held(name).ok_or_else(|| format!("{name} was not asked for"));
        let request = self.patiently(&format!("{name} is asked for"), asked).await?;
        self.call("Fetch.continueRequest", json!({ "requestId": request })).await.map(drop)
    }

    /// True if the file that is held back was asked for.
    pub fn waits_for(&self, name: &str) -> bool {
        self.watch().held(name).is_some()
    }

    async fn pause(&self) -> Outcome<()> {
        let patterns: Vec<Value> =
            self.watch().paused().iter().map(|name| json!({ "urlPattern": format!("*/{name}") })).collect();
        self.call("Fetch.enable", json!({ "patterns": patterns })).await.map(drop)
    }
}

/// A file as the server would send it, but for the number of the request.
fn answer(name: &str, text: &str) -> Value {
    let kind = if name.ends_with(".js") { "text/javascript; charset=utf-8" } else { "text/html; charset=utf-8" };
    json!({
        "responseCode": 200,
        "responseHeaders": [{ "name": "content-type", "value": kind }, { "name": "cache-control", "value": "no-store" }],
        "body": base64::engine::general_purpose::STANDARD.encode(text),
    })
}
