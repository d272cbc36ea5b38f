//! A switch in a page's link to its server: cut and mended, or silent with a clock that the test moves.

use serde_json::json;

use crate::{Outcome, Page};

/// Takes the place of the browser's sockets and of its clock, before the page begins.
const SOURCE: &str = "(() => {
    const Real = WebSocket;
    const clock = performance.now.bind(performance);
    globalThis.sockets = [];
    globalThis.heardMs = 0;
    performance.now = () => globalThis.stillMs ?? clock();
    globalThis.WebSocket = class extends Real {
        constructor(...of) {
            if (globalThis.isCut) throw new Error('cut');
            super(...of);
            // The first to hear: what it keeps for itself the page never hears.
            this.addEventListener('message', event => {
                if (globalThis.isCut) event.stopImmediatePropagation();
                else globalThis.heardMs = performance.now();
            });
            globalThis.sockets.push(this);
        }
    };
})();";

/// Cuts the socket of a page, and lets it come back; the rest of the network stays.
pub struct Switch<'a>(&'a Page);

impl<'a> Switch<'a> {
    /// Takes hold of the sockets of whatever is opened next.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn install(page: &'a Page) -> Outcome<Self> {
        page.call("Page.enable", json!({})).await?;
        page.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": SOURCE })).await?;
        Ok(Self(page))
    }

    /// The socket closes, and none opens any more.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn cut(&self) -> Outcome<()> {
        self.run("globalThis.isCut = true; globalThis.sockets.forEach(socket => socket.close())").await
    }

    /// The socket stays open, but nothing comes through it, and the clock of the page stands so long after it heard the
    /// last word. Called again, the clock moves.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn silent_for(&self, ms: u32) -> Outcome<()> {
        self.run(&format!("globalThis.isCut = true; globalThis.stillMs = globalThis.heardMs + {ms}")).await
    }

    /// Sockets open again, and the clock goes as it did.
    ///
    /// # Errors
    /// If the browser does not answer.
    pub async fn mend(&self) -> Outcome<()> {
        self.run("globalThis.isCut = false; globalThis.stillMs = undefined; dispatchEvent(new Event('online'))").await
    }

    async fn run(&self, js: &str) -> Outcome<()> {
        self.0.eval(&format!("{js}; 0")).await.map(drop)
    }
}
