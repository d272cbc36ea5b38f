//! A Chromium of one's own, in which each person has a separate profile.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

use serde_json::json;
use tempfile::TempDir;
use tokio::sync::oneshot;

use crate::page::Page;
use crate::watch::Watch;
use crate::wire::Wire;
use crate::{Outcome, Trouble, paths};

/// How long Chromium may take to start.
const START: Duration = Duration::from_secs(60);

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

/// A running headless Chromium; it is killed when this value is dropped.
pub struct Browser {
    wire: Arc<Wire>,
    _process: Process,
}

impl Browser {
    /// Starts Chromium with an empty profile.
    pub async fn launch() -> Outcome<Browser> {
        let path = paths::chromium().ok_or("There is no Chromium; name one in RRP_CHROMIUM.")?;
        let profile = paths::folder()?;
        let mut command = Command::new(path);
        command.args(FLAGS).arg(format!("--user-data-dir={}", profile.path().display()));
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        own_group(&mut command);
        let child = command.spawn().map_err(|error| Trouble::of("Chromium does not start", error))?;
        let mut process = Process { child, _profile: profile };
        let address = process.address().await?;
        Ok(Browser { wire: Wire::open(&address).await?, _process: process })
    }

    /// A person with a profile of their own (cookies, storage) and one page; `name` is used in failures.
    pub async fn person(&self, name: &str) -> Outcome<Page> {
        let context = self.wire.call(None, "Target.createBrowserContext", json!({})).await?;
        self.open(context["browserContextId"].as_str().unwrap_or_default(), name).await
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

/// The process and its profile, which go together.
struct Process {
    child: Child,
    _profile: TempDir,
}

impl Process {
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

/// Makes `command` the head of a group of processes, so that all of Chromium can be ended together.
fn own_group(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
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
