//! What the tests of the canvas do again and again.

use std::io::Write;
use std::path::PathBuf;

use house::{Browser, Outcome, Page, Rect, Server};
use serde_json::Value;
use tempfile::TempDir;

use crate::wire::Wire;

/// A server on a fresh folder, a browser, and a client without a page that makes programs.
pub(crate) struct Stage {
    pub(crate) server: Server,
    pub(crate) browser: Browser,
    pub(crate) wire: Wire,
    _folder: TempDir,
}

impl Stage {
    pub(crate) async fn set() -> Outcome<Self> {
        let folder = house::folder()?;
        let server = Server::start(folder.path()).await?;
        let wire = Wire::to(&server);
        Ok(Self { server, browser: Browser::launch().await?, wire, _folder: folder })
    }

    /// A person at a desktop with a program open.
    pub(crate) async fn person(&self, name: &str, program: &str) -> Outcome<Page> {
        self.person_at(name, program, (1440, 900, false)).await
    }

    /// A person at a tablet with a program open, who has fingers.
    pub(crate) async fn fingers(&self, name: &str, program: &str) -> Outcome<Page> {
        self.person_at(name, program, (1180, 820, true)).await
    }

    /// A person at a phone with a program open.
    pub(crate) async fn phone(&self, name: &str, program: &str) -> Outcome<Page> {
        self.person_at(name, program, (390, 844, true)).await
    }

    async fn person_at(&self, name: &str, program: &str, size: (u32, u32, bool)) -> Outcome<Page> {
        let page = self.browser.person(name).await?;
        page.size(size.0, size.1, size.2).await?;
        page.goto(&format!("{}#/b/{program}", self.server.url())).await?;
        page.until("performance.getEntriesByName('rrp-usable').length > 0", "the page is usable").await?;
        Ok(page)
    }
}

/// Where a stream is once it rests; `stream` is the start of its accessible name.
pub(crate) async fn rests(page: &Page, stream: &str) -> Outcome<Rect> {
    let mut before = page.boxed("button", stream).await?;
    loop {
        page.frames().await?;
        let now = page.boxed("button", stream).await?;
        if now == before {
            return Ok(now);
        }
        before = now;
    }
}

/// What of the view changes: how the world is shifted and scaled.
pub(crate) async fn view(page: &Page) -> Outcome<(f64, f64, f64)> {
    let js = "(() => { const m = new DOMMatrix(getComputedStyle(document.querySelector('.world')).transform);
        return [m.e, m.f, m.a]; })()";
    let numbers = page.eval(js).await?;
    let number = |at: usize| numbers[at].as_f64().unwrap_or_default();
    Ok((number(0), number(1), number(2)))
}

/// Keeps a picture if someone wants to look: `HANDS_PICTURES` names the folder.
pub(crate) async fn picture(page: &Page, name: &str) -> Outcome<()> {
    match std::env::var_os("HANDS_PICTURES") {
        Some(folder) => page.screenshot(&PathBuf::from(folder).join(format!("{name}.png"))).await,
        None => Ok(()),
    }
}

/// Says a number that was measured, past the test runner, which hides what passing tests print.
pub(crate) fn say(measured: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{measured}");
}

/// The text of a JSON value that is one.
pub(crate) fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// Does something with a fresh stage, or says that the test is skipped.
macro_rules! stage {
    ($part:literal) => {{
        house::skip::unless!(ready(concat!("hands: ", $part)));
        $crate::steps::Stage::set().await?
    }};
}
pub(crate) use stage;
