//! One person's page: going places, asking it things, waiting for it, and looking at it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use base64::Engine;
use serde_json::{Value, json};

use crate::watch::{self, Traffic, Watch};
use crate::wire::Wire;
use crate::{Outcome, Trouble, host, paths};

/// Between two looks at the page.
const LOOK: Duration = Duration::from_millis(25);
/// The longest time of a page for anything, unless a test says otherwise.
const PATIENCE: Duration = Duration::from_secs(30);
/// The longest time for the picture of a failure.
const PICTURE: Duration = Duration::from_secs(20);

/// A page in the browser, with the person's name for failures.
pub struct Page {
    wire: Arc<Wire>,
    watch: Arc<Watch>,
    session: String,
    context: String,
    target: String,
    name: String,
    media: Mutex<BTreeMap<String, String>>,
    /// Width and height of the window, and whether it is a touch screen.
    window: Mutex<Option<(u32, u32, bool)>>,
    patience_ms: AtomicU64,
    /// Origins of servers of ours to which the browser is shown as the host's.
    in_already: Mutex<BTreeSet<String>>,
    /// True if Chromium's process that draws was started anew for this page.
    pub(crate) drawn_anew: AtomicBool,
}

/// Processor time of the page's main thread since it was opened, in milliseconds.
/// Counts work, not waiting, so a busy machine disturbs it little.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cpu {
    /// All of it.
    pub task: f64,
    /// In scripts and wasm.
    pub script: f64,
    /// In layout.
    pub layout: f64,
    /// In working out styles.
    pub style: f64,
}

impl Page {
    pub(crate) fn new(wire: Arc<Wire>, watch: Arc<Watch>, ids: [&str; 3], name: &str) -> Page {
        let [session, context, target] = ids.map(str::to_owned);
        let patience_ms = AtomicU64::new(u64::try_from(PATIENCE.as_millis()).unwrap_or(u64::MAX));
        let (name, media, window, drawn_anew) =
            (test_name(name), Mutex::default(), Mutex::default(), AtomicBool::default());
        let in_already = Mutex::default();
        Page { wire, watch, session, context, target, name, media, window, patience_ms, in_already, drawn_anew }
    }

    /// Turns on what the harness listens to.
    pub(crate) async fn prepare(&self) -> Outcome<()> {
        for domain in ["Runtime", "Log", "Network", "DOM", "Inspector"] {
            self.call(&format!("{domain}.enable"), json!({})).await?;
        }
        self.call("Performance.enable", json!({ "timeDomain": "threadTicks" })).await?;
        self.call("Emulation.setFocusEmulationEnabled", json!({ "enabled": true })).await?;
        self.size(1280, 800, false).await
    }

    /// Calls any method of the DevTools protocol for this page.
    pub async fn call(&self, method: &str, params: Value) -> Outcome<Value> {
        self.wire.call(Some(&self.session), method, params).await
    }

    /// Calls any method of the DevTools protocol for the whole Chromium.
    pub(crate) async fn browser(&self, method: &str, params: Value) -> Outcome<Value> {
        self.wire.call(None, method, params).await
    }

    pub(crate) fn watch(&self) -> &Watch {
        &self.watch
    }

    pub(crate) fn context(&self) -> &str {
        &self.context
    }

    /// Goes to `url`, waits until it is loaded, and starts the counters of `network` anew.
    pub async fn goto(&self, url: &str) -> Outcome<()> {
        self.join(url).await?;
        self.watch.begin(url);
        let gone = self.call("Page.navigate", json!({ "url": url })).await?;
        if let Some(why) = gone["errorText"].as_str() {
            return Err(Trouble::of(&format!("{url} cannot be opened"), why));
        }
        self.until("document.readyState === 'complete'", &format!("{url} is loaded")).await.map(drop)
    }

    /// Has the browser shown as the host's, where a server of ours is and that was not done before. `goto` does it by itself.
    pub async fn join(&self, url: &str) -> Outcome<()> {
        let origin = url.splitn(4, '/').take(3).collect::<Vec<_>>().join("/");
        if self.in_already.lock().unwrap_or_else(PoisonError::into_inner).contains(&origin) {
            return Ok(());
        }
        let Some((name, value)) = host::cookie(url).await.ok().flatten() else { return Ok(()) };
        let cookie = json!({ "name": name, "value": value, "url": url, "httpOnly": true, "sameSite": "Strict" });
        self.call("Network.setCookie", cookie).await?;
        self.in_already.lock().unwrap_or_else(PoisonError::into_inner).insert(origin);
        Ok(())
    }

    /// Loads the page again, as F5 does, and waits until it is loaded.
    pub async fn reload(&self) -> Outcome<()> {
        self.eval("globalThis.beforeReload = true").await?;
        self.watch.begin(&self.address().await?);
        self.call("Page.reload", json!({})).await?;
        self.until("!globalThis.beforeReload && document.readyState === 'complete'", "the page is loaded again")
            .await
            .map(drop)
    }

    /// Closes the page.
    pub async fn close(self) -> Outcome<()> {
        self.wire.call(None, "Target.closeTarget", json!({ "targetId": self.target })).await.map(drop)
    }

    /// The address in the address bar.
    pub async fn address(&self) -> Outcome<String> {
        Ok(self.eval("location.href").await?.as_str().unwrap_or_default().to_owned())
    }

    /// Makes the window `width` by `height` CSS pixels; `mobile` behaves as a touch screen.
    pub async fn size(&self, width: u32, height: u32, mobile: bool) -> Outcome<()> {
        let window = (width, height, mobile);
        let before = self.window.lock().unwrap_or_else(PoisonError::into_inner).replace(window);
        // Chromium lays everything out again, even for what it has already.
        if before == Some(window) {
            return Ok(());
        }
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile });
        self.call("Emulation.setDeviceMetricsOverride", metrics).await?;
        if before.is_some_and(|(_, _, touch)| touch == mobile) {
            return Ok(());
        }
        let touch = json!({ "enabled": mobile, "maxTouchPoints": 5 });
        self.call("Emulation.setTouchEmulationEnabled", touch).await.map(drop)
    }

    /// Whatever is opened next speaks this language, as if the person had chosen it in the page before.
    pub async fn speaks(&self, code: &str) -> Outcome<()> {
        let source = format!("try {{ localStorage.setItem('rrp.language', '{code}'); }} catch {{ /* about:blank */ }}");
        self.call("Page.enable", json!({})).await?;
        self.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source })).await.map(drop)
    }

    /// Prefers dark or light colours.
    pub async fn theme(&self, dark: bool) -> Outcome<()> {
        self.media("prefers-color-scheme", if dark { "dark" } else { "light" }).await
    }

    /// Prefers any media feature, such as `prefers-reduced-motion` `reduce`; earlier ones stay.
    pub async fn media(&self, feature: &str, value: &str) -> Outcome<()> {
        self.media.lock().unwrap_or_else(PoisonError::into_inner).insert(feature.to_owned(), value.to_owned());
        self.emulate("").await
    }

    /// Goes to paper as the browser does when somebody prints, or comes back from there.
    pub async fn paper(&self, on: bool) -> Outcome<()> {
        if on {
            self.eval("dispatchEvent(new Event('beforeprint'))").await?;
            self.emulate("print").await
        } else {
            self.emulate("").await?;
            self.eval("dispatchEvent(new Event('afterprint'))").await.map(drop)
        }
    }

    async fn emulate(&self, media: &str) -> Outcome<()> {
        let features: Vec<Value> = {
            let known = self.media.lock().unwrap_or_else(PoisonError::into_inner);
            known.iter().map(|(name, value)| json!({ "name": name, "value": value })).collect()
        };
        self.call("Emulation.setEmulatedMedia", json!({ "media": media, "features": features })).await.map(drop)
    }

    /// Cuts the page off from the network, or connects it again.
    /// Open WebSockets stay open in Chromium; kill the server to cut those.
    pub async fn offline(&self, offline: bool) -> Outcome<()> {
        let network = json!({ "offline": offline, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1 });
        self.call("Network.emulateNetworkConditions", network).await.map(drop)
    }

    /// The value of a JavaScript expression; a promise is awaited, an exception is the error.
    pub async fn eval(&self, js: &str) -> Outcome<Value> {
        let asked = json!({ "expression": js, "awaitPromise": true, "returnByValue": true, "userGesture": true });
        let mut answer = self.call("Runtime.evaluate", asked).await?;
        match answer.get("exceptionDetails") {
            Some(details) => Err(Trouble::of(&format!("`{}`", short(js)), watch::exception(details))),
            None => Ok(answer["result"]["value"].take()),
        }
    }

    /// Waits until the expression `js` is truthy and answers with its value.
    /// `what` says it in words, for the failure.
    pub async fn until(&self, js: &str, what: &str) -> Outcome<Value> {
        let look = async || match self.eval(js).await {
            Ok(value) if truthy(&value) => Ok(value),
            Ok(value) => Err(format!("`{}` is {value}", short(js))),
            Err(trouble) => Err(trouble.0),
        };
        self.patiently(what, look).await
    }

    /// Changes how long this page is waited for.
    pub fn patience(&self, patience: Duration) {
        let ms = u64::try_from(patience.as_millis()).unwrap_or(u64::MAX);
        self.patience_ms.store(ms, Ordering::Relaxed);
    }

    /// Looks again and again until `look` succeeds; its last reason is in the failure.
    pub(crate) async fn patiently<T>(&self, what: &str, look: impl AsyncFn() -> Result<T, String>) -> Outcome<T> {
        let patience = Duration::from_millis(self.patience_ms.load(Ordering::Relaxed));
        let began = Instant::now();
        loop {
            match look().await {
                Ok(found) => return Ok(found),
                Err(why) if began.elapsed() >= patience || self.wire.closed() => {
                    let waited = began.elapsed().as_secs_f64();
                    return Err(self.fail(&format!("{what}: not within {waited:.1} s; {why}")).await);
                }
                Err(_) => tokio::time::sleep(LOOK).await,
            }
        }
    }

    /// A trouble with the person's name, a screenshot, and what the page complained about.
    pub(crate) async fn fail(&self, sentence: &str) -> Trouble {
        let path = self.failure_path();
        let scripts = self.scripts_run().await;
        // A page whose scripts do not run gives no picture either.
        let taken = if scripts { tokio::time::timeout(PICTURE, self.screenshot(&path)).await.ok() } else { None };
        let picture = match taken {
            Some(Ok(())) => format!("see {}", path.display()),
            Some(Err(trouble)) => format!("no screenshot: {trouble}; {}", self.stuck(scripts).await),
            None => format!("no screenshot to be had; {}", self.stuck(scripts).await),
        };
        let errors = self.watch.errors();
        let complaints = if errors.is_empty() { String::new() } else { format!("\n{}", errors.join("\n")) };
        Trouble(format!("{}: {sentence} ({picture}){complaints}", self.name))
    }

    /// Returns the file of the picture of a failure: `target/journeys/<test>-<person>.png`.
    pub fn failure_path(&self) -> PathBuf {
        paths::target().join("journeys").join(format!("{}.png", self.name))
    }

    /// Writes what is in view as a PNG file.
    pub async fn screenshot(&self, path: &Path) -> Outcome<()> {
        let taken = self.call("Page.captureScreenshot", json!({ "format": "png" })).await?;
        let text = taken["data"].as_str().unwrap_or_default();
        let bytes = base64::engine::general_purpose::STANDARD.decode(text);
        let bytes = bytes.map_err(|error| Trouble::of("The screenshot is not base64", error))?;
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        Ok(std::fs::write(path, bytes)?)
    }

    /// Returns the errors that the page reported so far: exceptions, console errors, failed loads, forbidden content.
    pub fn errors(&self) -> Vec<String> {
        self.watch.errors()
    }

    /// Drops the errors so far, after a step that must cause some (a killed server).
    pub fn forget_errors(&self) {
        self.watch.forget_errors();
    }

    /// Fails with the list when the page reported any error.
    pub fn no_errors(&self) -> Outcome<()> {
        self.no_errors_but(&[])
    }

    /// Checks as `no_errors` does, but errors that contain one of the `known` words are fine.
    pub fn no_errors_but(&self, known: &[&str]) -> Outcome<()> {
        let mut errors = self.watch.errors();
        errors.retain(|error| !known.iter().any(|word| error.contains(word)));
        match errors.len() {
            0 => Ok(()),
            count => Err(Trouble::of(&format!("{}: {count} errors", self.name), errors.join("\n"))),
        }
    }

    /// Returns the traffic since the last `goto`.
    pub fn network(&self) -> Traffic {
        self.watch.traffic()
    }

    /// Processor time of the main thread so far, in milliseconds.
    pub async fn cpu_ms(&self) -> Outcome<f64> {
        Ok(self.cpu().await?.task)
    }

    /// Processor time of the main thread so far, by kind.
    pub async fn cpu(&self) -> Outcome<Cpu> {
        let answer = self.call("Performance.getMetrics", json!({})).await?;
        let metrics = answer["metrics"].as_array().cloned().unwrap_or_default();
        let ms = |name: &str| {
            let metric = metrics.iter().find(|metric| metric["name"] == name);
            metric.and_then(|metric| metric["value"].as_f64()).unwrap_or(0.0) * 1000.0
        };
        let [task, script] = [ms("TaskDuration"), ms("ScriptDuration")];
        Ok(Cpu { task, script, layout: ms("LayoutDuration"), style: ms("RecalcStyleDuration") })
    }
}

/// The name of the running test (its thread bears it) and the person's, fit for a file name.
fn test_name(person: &str) -> String {
    let thread = std::thread::current().name().unwrap_or("main").to_owned();
    let plain = |letter: char| if letter.is_alphanumeric() || letter == '_' { letter } else { '-' };
    format!("{thread}-{person}").chars().map(plain).collect()
}

/// True if JavaScript takes the value for true.
pub(crate) fn truthy(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::Bool(truth) => *truth,
        Value::Number(number) => number.as_f64() != Some(0.0),
        Value::String(text) => !text.is_empty(),
        Value::Array(_) | Value::Object(_) => true,
    }
}

/// The beginning of a script, for failures.
fn short(js: &str) -> String {
    let line = js.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(120) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line,
    }
}
