//! A Chromium of one's own, in which each person has a separate profile. A test takes over that of one before it, emptied.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;
use tokio::sync::oneshot;

use crate::page::Page;
use crate::watch::Watch;
use crate::wire::Wire;
use crate::{Outcome, Trouble, paths};

/// The longest time for Chromium to start.
const START: Duration = Duration::from_secs(60);
/// The longest time to close what a test had open.
const CLEAR: Duration = Duration::from_secs(10);

const FLAGS: [&str; 18] = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    // What drops down from the address bar is two pages of its own in every window, together as much work as the page
    // under test. Nobody types an address here. Nor is a renderer wanted that waits for a next page.
    "--disable-features=WebUIOmniboxAimPopup,WebUIOmniboxFullPopup,WebUIOmniboxPopup,SpareRendererForSitePerProcess",
    "--disable-dev-shm-usage",
    // Several people are in view at once: none of their pages may be slowed down as hidden.
    "--disable-backgrounding-occluded-windows",
    "--disable-background-timer-throttling",
    "--disable-renderer-backgrounding",
    "--force-device-scale-factor=1",
    "--remote-debugging-port=0",
    "about:blank",
];

/// Runs what it is given with the profile in its first argument, and ends and removes both when its own input ends: that is
/// when the tests have ended, in whatever way.
const GUARD: &str = r#"profile=$1; shift; "$@" & exec 2>&-; read -r _; kill -9 $!; rm -rf "$profile"; kill -9 0"#;

/// Those that a test has done with, emptied. To take one over is a second's work less than a start.
static SPARE: Mutex<Vec<Process>> = Mutex::new(Vec::new());

/// A running headless Chromium for one test at a time.
pub struct Browser {
    wire: Arc<Wire>,
    process: Option<Process>,
}

impl Browser {
    /// A Chromium without people or pages: one that is spare, or a new one.
    pub async fn launch() -> Outcome<Browser> {
        while let Some(process) = take_spare() {
            if let Ok(wire) = Wire::open(&process.address).await {
                return Ok(Browser { wire, process: Some(process) });
            }
        }
        let process = Process::start().await?;
        Ok(Browser { wire: Wire::open(&process.address).await?, process: Some(process) })
    }

    /// A person with a profile of their own (cookies, storage) and one page; `name` is used in failures.
    pub async fn person(&self, name: &str) -> Outcome<Page> {
        let context = self.wire.call(None, "Target.createBrowserContext", json!({})).await?;
        self.open(context["browserContextId"].as_str().unwrap_or_default(), name).await
    }

    /// Returns the number of people in it.
    pub async fn people(&self) -> Outcome<usize> {
        Ok(people(&self.wire).await?.len())
    }

    /// Another page of the same person, as a second tab; `name` is used in failures.
    pub async fn second_tab(&self, of: &Page, name: &str) -> Outcome<Page> {
        self.open(of.context(), name).await
    }

    async fn open(&self, context: &str, name: &str) -> Outcome<Page> {
        let asked = json!({ "url": "about:blank", "browserContextId": context, "newWindow": true });
        let target = self.wire.call(None, "Target.createTarget", asked).await?["targetId"].take();
        let asked = json!({ "targetId": target, "flatten": true });
        let attached = self.wire.call(None, "Target.attachToTarget", asked).await?;
        let session = attached["sessionId"].as_str().unwrap_or_default();
        let watch = Arc::new(Watch::default());
        self.wire.listen(session, Arc::clone(&watch));
        let page =
            Page::new(Arc::clone(&self.wire), watch, [session, context, target.as_str().unwrap_or_default()], name);
        page.prepare().await?;
        Ok(page)
    }
}

/// Closes what the tests before left, here and not when the next test begins: nothing of it may run beside others.
impl Drop for Browser {
    fn drop(&mut self) {
        let Some(process) = self.process.take() else { return };
        // It has a runtime of its own: that of the test may be at its end.
        let emptied = std::thread::spawn(move || process.emptied()).join();
        spare().extend(emptied.ok().flatten());
    }
}

fn take_spare() -> Option<Process> {
    spare().pop()
}

fn spare() -> MutexGuard<'static, Vec<Process>> {
    SPARE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The process, where it listens, and its profile, which go together.
struct Process {
    child: Child,
    address: String,
    _profile: TempDir,
}

impl Process {
    /// Starts Chromium with an empty profile.
    async fn start() -> Outcome<Process> {
        let path = paths::chromium().ok_or("There is no Chromium; name one in RRP_CHROMIUM.")?;
        let profile = paths::folder()?;
        let mut command = guarded(&path, profile.path());
        command.args(FLAGS).arg(format!("--user-data-dir={}", profile.path().display()));
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        let child = command.spawn().map_err(|error| Trouble::of("Chromium does not start", error))?;
        let mut process = Process { child, address: String::new(), _profile: profile };
        process.address = process.address().await?;
        Ok(process)
    }

    /// Waits for the address that Chromium prints; its other words are read and thrown away.
    async fn address(&mut self) -> Outcome<String> {
        let words = self.child.stderr.take().ok_or("Chromium has no standard error.")?;
        let (tell, told) = oneshot::channel();
        std::thread::spawn(move || drain(words, tell));
        match tokio::time::timeout(START, told).await {
            Ok(Ok(address)) => address.map_err(|words| Trouble::of("Chromium ended at its start", words)),
            Ok(Err(_)) | Err(_) => Err(format!("Chromium did not start within {} s.", START.as_secs()).into()),
        }
    }

    /// Closes the people in it and their pages; none if it does not answer any more.
    fn emptied(self) -> Option<Process> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().ok()?;
        let cleared = runtime.block_on(async { tokio::time::timeout(CLEAR, clear(&self.address)).await });
        matches!(cleared, Ok(Ok(()))).then_some(self)
    }
}

/// Ends all people with their pages, cookies and what they store.
async fn clear(address: &str) -> Outcome<()> {
    let wire = Wire::open(address).await?;
    for person in people(&wire).await? {
        wire.call(None, "Target.disposeBrowserContext", json!({ "browserContextId": person })).await?;
    }
    Ok(())
}

async fn people(wire: &Wire) -> Outcome<Vec<Value>> {
    let mut found = wire.call(None, "Target.getBrowserContexts", json!({})).await?;
    Ok(found["browserContextIds"].as_array_mut().map(std::mem::take).unwrap_or_default())
}

/// A command for `chromium` that heads a group of processes, so that all of it can be ended together, and that outlives
/// neither its profile nor us.
fn guarded(chromium: &Path, profile: &Path) -> Command {
    if cfg!(not(unix)) {
        return Command::new(chromium);
    }
    let mut command = Command::new("sh");
    command.args(["-c", GUARD, "sh"]).args([profile, chromium]);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}

/// Sends the DevTools address, or what was said instead of one, and reads on to the end.
fn drain(words: impl Read, tell: oneshot::Sender<Result<String, String>>) {
    let mut lines = BufReader::new(words).lines().map_while(Result::ok);
    let mut said = Vec::new();
    let address = lines.find_map(|line| {
        let address = line.strip_prefix("DevTools listening on ").map(str::to_owned);
        said.push(line);
        address
    });
    let _ = tell.send(address.ok_or_else(|| said.join("\n")));
    lines.for_each(drop);
}

impl Drop for Process {
    fn drop(&mut self) {
        if cfg!(unix) {
            let group = format!("-{}", self.child.id());
            let _ = Command::new("kill").args(["-9", "--", &group]).stderr(Stdio::null()).status();
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
