//! The clock on the wall of a page, which a test holds and moves: what goes by the time of day then depends on no real time.

use serde_json::json;

use crate::{Outcome, Page};

/// Takes the place of the browser's time of day, before the page begins.
const SOURCE: &str = "(() => {
    const real = Date.now.bind(Date);
    globalThis.aheadMs = 0;
    Date.now = () => globalThis.heldMs ?? real() + globalThis.aheadMs;
})();";

/// Moves the time of day of a page; timers go on as they did.
pub struct WallClock<'a>(&'a Page);

impl<'a> WallClock<'a> {
    /// Takes hold of the clock of whatever is opened next.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn install(page: &'a Page) -> Outcome<Self> {
        page.call("Page.enable", json!({})).await?;
        page.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": SOURCE })).await?;
        Ok(Self(page))
    }

    /// The clock stands from now on.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn hold(&self) -> Outcome<()> {
        self.run("globalThis.heldMs = Date.now()").await
    }

    /// The clock is so much later at once.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn forward(&self, ms: u32) -> Outcome<()> {
        self.run(&format!("globalThis.heldMs === undefined ? globalThis.aheadMs += {ms} : globalThis.heldMs += {ms}"))
            .await
    }

    async fn run(&self, js: &str) -> Outcome<()> {
        self.0.eval(&format!("{js}; 0")).await.map(drop)
    }
}
