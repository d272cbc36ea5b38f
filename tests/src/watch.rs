//! The watch over a page behind its test's back: errors it reported and what it fetched.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::Value;

/// Errors kept for one page; later ones are only counted away.
const ERRORS_MAX: usize = 200;

/// The traffic of a page since its last `goto`.
#[derive(Clone, Default, Debug, PartialEq, Eq)]
pub struct Traffic {
    /// Requests sent, with redirects, without `data:` and `blob:`.
    pub requests: u64,
    /// Bytes received, headers included, as they travelled (compressed).
    pub bytes: u64,
    /// Addresses on other hosts than the page's own.
    pub external: BTreeSet<String>,
}

#[derive(Default)]
struct Seen {
    host: String,
    errors: Vec<String>,
    traffic: Traffic,
    /// Files that are answered here, and with what.
    answers: BTreeMap<String, Value>,
    /// Files that are held back, and the requests for them.
    held: BTreeMap<String, Option<String>>,
}

/// Collects the events of one page.
#[derive(Default)]
pub(crate) struct Watch(Mutex<Seen>);

impl Watch {
    fn seen(&self) -> MutexGuard<'_, Seen> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts counting anew for a page at `url`; errors are kept.
    pub(crate) fn begin(&self, url: &str) {
        let mut seen = self.seen();
        seen.host = host(url).to_owned();
        seen.traffic = Traffic::default();
    }

    pub(crate) fn traffic(&self) -> Traffic {
        self.seen().traffic.clone()
    }

    pub(crate) fn errors(&self) -> Vec<String> {
        self.seen().errors.clone()
    }

    pub(crate) fn forget_errors(&self) {
        self.seen().errors.clear();
    }

    pub(crate) fn answer_with(&self, name: &str, answer: Value) {
        self.seen().answers.insert(name.to_owned(), answer);
    }

    pub(crate) fn hold(&self, name: &str) {
        self.seen().held.insert(name.to_owned(), None);
    }

    /// The request for a file that is held back, once there is one.
    pub(crate) fn held(&self, name: &str) -> Option<String> {
        self.seen().held.get(name).cloned().flatten()
    }

    /// Files that the browser asks us for.
    pub(crate) fn paused(&self) -> Vec<String> {
        let seen = self.seen();
        seen.answers.keys().chain(seen.held.keys()).cloned().collect()
    }

    /// The answer to a request that the browser asks us for, unless it is held back.
    pub(crate) fn answer_to(&self, params: &Value) -> Option<Value> {
        let mut seen = self.seen();
        let (url, request) = (params["request"]["url"].as_str()?, params["requestId"].as_str()?);
        let name = url.rsplit('/').next()?;
        if let Some(held) = seen.held.get_mut(name) {
            *held = Some(request.to_owned());
            return None;
        }
        let mut answer = seen.answers.get(name)?.clone();
        answer["requestId"] = request.into();
        Some(answer)
    }

    /// Takes in one event of the DevTools protocol.
    pub(crate) fn note(&self, method: &str, params: &Value) {
        let mut seen = self.seen();
        match method {
            "Runtime.exceptionThrown" => seen.error(exception(&params["exceptionDetails"])),
            "Runtime.consoleAPICalled" if is_error(&params["type"]) => seen.error(console(params)),
            "Log.entryAdded" if is_error(&params["entry"]["level"]) => seen.error(entry(&params["entry"])),
            "Inspector.targetCrashed" => seen.error("the page crashed".to_owned()),
            "Network.requestWillBeSent" => seen.request(params),
            "Network.webSocketCreated" => seen.address(params["url"].as_str().unwrap_or_default()),
            "Network.loadingFinished" => seen.traffic.bytes += bytes(params),
            _ => {}
        }
    }
}

impl Seen {
    fn error(&mut self, sentence: String) {
        if self.errors.len() < ERRORS_MAX {
            self.errors.push(sentence);
        }
    }

    fn request(&mut self, params: &Value) {
        let url = params["request"]["url"].as_str().unwrap_or_default();
        if url.starts_with("data:") || url.starts_with("blob:") {
            return;
        }
        self.traffic.requests += 1;
        self.traffic.bytes += bytes(&params["redirectResponse"]);
        self.address(url);
    }

    fn address(&mut self, url: &str) {
        if host(url) != self.host {
            self.traffic.external.insert(url.to_owned());
        }
    }
}

/// The part of an address that names the machine and port.
fn host(url: &str) -> &str {
    let rest = url.split_once("://").map_or("", |(_, rest)| rest);
    rest.split(['/', '?', '#']).next().unwrap_or_default()
}

fn bytes(params: &Value) -> u64 {
    let length = params["encodedDataLength"].as_f64().unwrap_or(0.0);
    // Saturates for what is out of range, which a byte count is not.
    length.max(0.0) as u64
}

fn is_error(kind: &Value) -> bool {
    matches!(kind.as_str(), Some("error" | "assert"))
}

/// Returns the message of an exception, with its stack where there is one.
pub(crate) fn exception(details: &Value) -> String {
    let said = details["exception"]["description"].as_str().or(details["exception"]["value"].as_str());
    let text = said.or(details["text"].as_str()).unwrap_or("an exception without words");
    format!("exception: {text}")
}

fn console(params: &Value) -> String {
    let words = params["args"].as_array().into_iter().flatten().map(|word| {
        let text = word["value"].as_str().or(word["description"].as_str());
        text.map_or_else(|| word["value"].to_string(), str::to_owned)
    });
    format!("console: {}", words.collect::<Vec<_>>().join(" "))
}

fn entry(entry: &Value) -> String {
    let part = |name: &str| entry[name].as_str().unwrap_or_default();
    format!("{}: {} {}", part("source"), part("text"), part("url"))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn other_hosts_are_told_apart_by_machine_and_port() {
        let watch = Watch::default();
        watch.begin("http://127.0.0.1:80/x");
        for url in ["http://127.0.0.1:80/y?z", "data:text/plain,1", "https://far.example/a"] {
            watch.note("Network.requestWillBeSent", &json!({ "request": { "url": url } }));
        }
        watch.note("Network.webSocketCreated", &json!({ "url": "ws://127.0.0.1:80/link" }));
        let traffic = watch.traffic();
        assert_eq!(traffic.requests, 2);
        assert_eq!(traffic.external.into_iter().collect::<Vec<_>>(), ["https://far.example/a"]);
    }
}
