//! What people do again and again, in their own words.

use house::{Browser, Outcome, Page, Server, Switch};
use std::path::Path;
use tempfile::TempDir;

/// A number of a sentence is a field, and has the keyboard.
pub(crate) const NUMBER_IS_TYPED: &str = "!!document.activeElement.closest('.inline.open')";

/// A server on a fresh folder, and a browser. Server and browser end before the folder goes.
pub(crate) struct Stage {
    pub(crate) server: Server,
    pub(crate) browser: Browser,
    folder: TempDir,
}

impl Stage {
    pub(crate) async fn set() -> Outcome<Self> {
        let folder = house::folder()?;
        Self::set_with(folder, &[]).await
    }

    /// The same with more words for `rrp serve`.
    pub(crate) async fn set_with(folder: TempDir, words: &[&str]) -> Outcome<Self> {
        let server = Server::start_with(folder.path(), words).await?;
        Self::with(server, folder).await
    }

    /// Around a server that runs in this folder.
    pub(crate) async fn with(server: Server, folder: TempDir) -> Outcome<Self> {
        Ok(Self { server, browser: Browser::launch().await?, folder })
    }

    /// Where the data is.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A person with the page open on a desktop.
    pub(crate) async fn person(&self, name: &str) -> Outcome<Page> {
        let page = self.nobody(name).await?;
        page.goto(&self.server.url()).await?;
        usable(&page).await?;
        Ok(page)
    }

    /// Opens the page in an empty window, with a switch that cuts and mends its socket.
    pub(crate) async fn enter_with_switch<'a>(&self, page: &'a Page) -> Outcome<Switch<'a>> {
        let socket = Switch::install(page).await?;
        page.goto(&self.server.url()).await?;
        usable(page).await?;
        Ok(socket)
    }

    /// A person in front of an empty window.
    pub(crate) async fn nobody(&self, name: &str) -> Outcome<Page> {
        let page = self.browser.person(name).await?;
        page.size(1440, 900, false).await?;
        Ok(page)
    }

    /// A second person in what another has open.
    pub(crate) async fn beside(&self, other: &Page, name: &str) -> Outcome<Page> {
        let page = self.nobody(name).await?;
        page.goto(&other.address().await?).await?;
        usable(&page).await?;
        Ok(page)
    }
}

/// Gives `one`, who has a program open, the name of `other`, as two guests may have one: they are told apart all the same.
pub(crate) async fn called_alike(one: &Page, other: &Page) -> Outcome<()> {
    let name = other.eval("localStorage.getItem('rrp.name')").await?;
    one.eval(&format!("localStorage.setItem('rrp.name', {name}), 0")).await?;
    one.reload().await?;
    usable(one).await?;
    let open = format!("localStorage.getItem('rrp.name') === {name} && !!document.querySelector('#stage .stream')");
    one.until(&open, "it is open again").await.map(drop)
}

/// Waits until the first screen can be used.
pub(crate) async fn usable(page: &Page) -> Outcome<()> {
    page.until("performance.getEntriesByName('rrp-usable').length > 0", "the page is usable").await.map(drop)
}

/// Makes an empty program through the dialog.
pub(crate) async fn add_program(page: &Page, name: &str) -> Outcome<()> {
    page.within("toolbar", "Main tools").press("button", "Add a program").await?;
    let dialog = page.within("dialog", "Add a program");
    dialog.fill("textbox", "Name", name).await?;
    dialog.press("button", "Create").await?;
    page.gone("dialog", "Add a program").await?;
    page.find("heading", "Add a sense to begin").await?;
    page.find("button", name).await?;
    Ok(())
}

/// Adds a sense from the list at the left.
pub(crate) async fn add_sense(page: &Page, sense: &str) -> Outcome<()> {
    page.within("navigation", "Find or add").press("button", &format!("Add {sense}")).await?;
    page.find("button", &format!("{sense}, *")).await?;
    page.find("toolbar", &format!("Next steps for {sense}")).await?;
    saved(page).await
}

/// Gives the open program another name.
pub(crate) async fn rename_program(page: &Page, from: &str, to: &str) -> Outcome<()> {
    page.press("button", from).await?;
    let dialog = page.within("dialog", "Rename the program");
    dialog.fill("textbox", "Name", to).await?;
    dialog.press("button", "Save").await?;
    page.gone("dialog", "Rename the program").await?;
    page.find("button", to).await.map(drop)
}

/// Waits until everything is saved.
pub(crate) async fn saved(page: &Page) -> Outcome<()> {
    says(page, "All changes saved").await
}

/// Waits until these words are in the page.
pub(crate) async fn says(page: &Page, words: &str) -> Outcome<()> {
    let js = format!("document.body.innerText.includes({})", quoted(words));
    page.until(&js, &format!("the page says “{words}”")).await.map(drop)
}

/// Waits until these words are nowhere in the page.
pub(crate) async fn silent(page: &Page, words: &str) -> Outcome<()> {
    let js = format!("!document.body.innerText.includes({})", quoted(words));
    page.until(&js, &format!("the page says no more “{words}”")).await.map(drop)
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Selects a stream on the canvas by its name.
pub(crate) async fn select(page: &Page, stream: &str) -> Outcome<()> {
    page.press("button", &format!("{stream}, *")).await?;
    page.find("toolbar", &format!("Next steps for {stream}")).await.map(drop)
}

/// Presses something in the strip under the selected stream.
pub(crate) async fn next(page: &Page, stream: &str, button: &str) -> Outcome<()> {
    page.within("toolbar", &format!("Next steps for {stream}")).press("button", button).await
}

/// Opens the Operation dialog for a connector through the thunderbolt under a stream.
pub(crate) async fn thunderbolt(page: &Page, stream: &str, connector: &str) -> Outcome<()> {
    select(page, stream).await?;
    next(page, stream, "Add connector").await?;
    page.press("menuitem", connector).await?;
    page.find("dialog", "Operation").await.map(drop)
}

/// Saves the open dialog, which closes.
pub(crate) async fn save(page: &Page, dialog: &str) -> Outcome<()> {
    page.within("dialog", dialog).press("button", "Save").await?;
    page.gone("dialog", dialog).await?;
    saved(page).await
}

/// Chooses out of a list that drops down, by its first letters.
pub(crate) async fn choose(page: &Page, list: &str, letters: &str, chosen: &str) -> Outcome<()> {
    page.on("combobox", list, "function () { this.focus(); }").await?;
    page.type_text(letters).await?;
    let js = format!("function () {{ return this.value === {}; }}", quoted(chosen));
    page.until_on("combobox", list, &js, &format!("{list} is {chosen}")).await.map(drop)
}

/// Sees these streams and connectors on the canvas, by their accessible names.
pub(crate) async fn sees(page: &Page, names: &[&str]) -> Outcome<()> {
    for name in names {
        page.find("button", name).await?;
    }
    Ok(())
}

/// Waits until a value stands beside a stream.
pub(crate) async fn shows_value(page: &Page, stream: &str) -> Outcome<String> {
    let js = "function () { return this.closest('.at').querySelector('.value b')?.textContent; }";
    let value = page.until_on("button", &format!("{stream}, *"), js, &format!("{stream} shows a value")).await?;
    Ok(value.as_str().unwrap_or_default().to_owned())
}

/// Starts the open program.
pub(crate) async fn start(page: &Page) -> Outcome<()> {
    page.press("button", "Start").await?;
    page.find("button", "Running").await.map(drop)
}

/// Stops everything.
pub(crate) async fn stop(page: &Page) -> Outcome<()> {
    page.press("button", "Stop").await?;
    says(page, "Stopped. The robot holds still.").await
}

/// Waits until the open program does not run.
pub(crate) async fn at_rest(page: &Page) -> Outcome<()> {
    page.find("button", "Start").await.map(drop)
}

/// Checks that the page complained about nothing.
pub(crate) fn calm(page: &Page) -> Outcome<()> {
    page.no_errors()
}

/// As `calm`, after the server went away: then the browser itself tells that it cannot connect.
pub(crate) fn calm_but_lost(page: &Page) -> Outcome<()> {
    page.no_errors_but(&["WebSocket", "ERR_CONNECTION_REFUSED"])
}

/// The places of the tour's card and of its ring, which looks five times a second where what it is about stands.
const CARD: &str = "[...document.querySelectorAll('.tour, .tour-ring')].map(one => Object.values(one.getBoundingClientRect().toJSON())).join()";

/// Waits until the tour's card stands. While it glides it may lie over what is pressed next.
pub(crate) async fn card_stands(page: &Page) -> Outcome<()> {
    page.steady(CARD, 20, "the tour's card stands").await
}
