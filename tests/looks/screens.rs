//! Walks through the screens as a person reaches them, and stops at each.

use house::{Browser, Outcome, Page, Server, Trouble};
use tempfile::TempDir;

/// The template that is looked at.
pub(crate) const TEMPLATE: &str = "Track far and close balls";
/// The connectors of the Operation dialog by their words.
const CONNECTORS: [&str; 12] = [
    "sample",
    "subscribe",
    "filter",
    "map",
    "combine",
    "merge",
    "timestamp",
    "changed",
    "remember",
    "settle",
    "delay",
    "with latest",
];

/// Connectors whose help is looked at too: with one lane and several, with times, with commands.
const HELP: [&str; 6] = ["subscribe", "map", "combine", "timestamp", "remember", "with latest"];

/// A server on a fresh folder, a browser, and a person with the page open on a desktop.
pub(crate) struct Stage {
    pub(crate) page: Page,
    pub(crate) server: Server,
    pub(crate) browser: Browser,
    _folder: TempDir,
}

impl Stage {
    pub(crate) async fn set() -> Outcome<Stage> {
        let folder = house::folder()?;
        let server = Server::start(folder.path()).await?;
        let browser = Browser::launch().await?;
        let page = browser.person("aiko").await?;
        page.size(1440, 900, false).await?;
        page.goto(&server.url()).await?;
        usable(&page).await?;
        Ok(Stage { page, server, browser, _folder: folder })
    }
}

/// Waits until the first screen can be used.
pub(crate) async fn usable(page: &Page) -> Outcome<()> {
    page.until("performance.getEntriesByName('rrp-usable').length > 0", "the page is usable").await.map(drop)
}

/// Waits until nothing moves any more.
pub(crate) async fn rests(page: &Page) -> Outcome<()> {
    let still = "document.getAnimations().every(motion => motion.playState !== 'running') \
        && new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))";
    page.until(still, "nothing moves").await.map(drop)
}

/// Visits every screen on a desktop, with its name; whoever visits may change size and theme and must put them back.
pub(crate) async fn walk(page: &Page, visit: impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    visit("empty-library").await?;
    page.press("button", "Add a program").await?;
    page.find("dialog", "Add a program").await?;
    visit("add-program").await?;
    page.press("button", "Create").await?;
    page.find("heading", "Add a sense to begin").await?;
    page.until("document.activeElement.matches('.sense-card')", "the first sense has the keyboard").await?;
    visit("empty-program").await?;
    run_template(page).await?;
    visit("running").await?;
    robots(page, &visit).await?;
    operations(page, &visit).await?;
    selected(page, "Head tracker").await?;
    edit(page).await?;
    page.find("dialog", "Edit stream actuator").await?;
    visit("edit-actuator").await?;
    leave(page).await?;
    page.press("button", "Edit helper").await?;
    page.press("menuitem", "select_arm*").await?;
    page.find("dialog", "Edit helper").await?;
    visit("helper").await?;
    leave(page).await?;
    page.press("button", "Load program").await?;
    page.press("menuitem", "All programs and templates …").await?;
    page.find("dialog", "Load program").await?;
    page.until("document.querySelectorAll('.program-line .picture path').length > 0", "its picture is there").await?;
    visit("load-program").await?;
    page.press("button", &format!("More about {TEMPLATE}")).await?;
    page.find("button", "Back to the list").await?;
    visit("load-program-details").await?;
    page.press("radio", "Templates").await?;
    visit("load-program-templates").await?;
    page.press("radio", "Bin").await?;
    page.until("document.body.innerText.includes('The bin is empty')", "the bin is empty").await?;
    visit("load-program-bin").await?;
    leave(page).await?;
    page.press("button", "Load program").await?;
    page.press("menuitem", "Save as file …").await?;
    page.find("dialog", "Save as file").await?;
    visit("save-as-file").await?;
    leave(page).await
}

/// Opens the template and starts it.
pub(crate) async fn run_template(page: &Page) -> Outcome<()> {
    page.press("button", "Load program").await?;
    page.press("menuitem", &format!("{TEMPLATE}*")).await?;
    page.until(
        &format!("document.title.includes('{TEMPLATE}') || document.body.innerText.includes('Head tracker')"),
        "the template is open",
    )
    .await?;
    page.press("button", "Start").await?;
    page.find("button", "Running").await?;
    page.until("document.body.innerText.includes('/s')", "values come").await.map(drop)
}

/// Adds a second robot and goes back to the one on which something runs.
async fn robots(page: &Page, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    page.press("button", "Robot: Simulated NAO").await?;
    page.press("menuitem", "Add a simulated robot").await?;
    page.find("dialog", "Add a simulated robot").await?;
    visit("add-robot").await?;
    page.press("button", "Create").await?;
    page.press("button", "Robot: Simulated NAO 2").await?;
    page.find("menu", "Robot: Simulated NAO 2").await?;
    visit("robots").await?;
    page.press("menuitemradio", "Simulated NAO runs *").await?;
    page.find("button", "Running").await?;
    page.until("document.body.innerText.includes('/s')", "values come again").await.map(drop)
}

async fn operations(page: &Page, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    operation(page).await?;
    for connector in CONNECTORS {
        page.press("radio", connector).await?;
        if connector == "filter" {
            page.fill("textbox", "Body", "distance < 0.5").await?;
            page.until(
                "document.body.innerText.includes('passes') || document.body.innerText.includes('stopped')",
                "the test is tried",
            )
            .await?;
        }
        let screen = connector.replace(' ', "-");
        visit(&format!("operation-{screen}")).await?;
        if HELP.contains(&connector) {
            page.press("button", "How it works").await?;
            page.until("!!document.querySelector('.how-example .marble')", "the help is open").await?;
            visit(&format!("operation-{screen}-help")).await?;
            page.press("button", "Hide how it works").await?;
        }
    }
    leave(page).await
}

/// Opens the Operation dialog for a filter out of “Distance”.
pub(crate) async fn operation(page: &Page) -> Outcome<()> {
    selected(page, "Distance").await?;
    page.press("button", "Add connector").await?;
    page.press("menuitem", "filter").await?;
    page.find("dialog", "Operation").await.map(drop)
}

/// Selects a stream on the canvas.
pub(crate) async fn selected(page: &Page, stream: &str) -> Outcome<()> {
    page.press("button", &format!("{stream}, *")).await
}

/// Presses Edit beside what is selected.
pub(crate) async fn edit(page: &Page) -> Outcome<()> {
    let press = "[...document.querySelectorAll('.right button')].find(button => button.textContent.trim() === 'Edit')";
    page.until(&format!("!!{press}"), "Edit is offered").await?;
    page.eval(&format!("{press}.click()")).await.map(drop)
}

/// Closes the dialog.
async fn leave(page: &Page) -> Outcome<()> {
    page.key("Escape").await?;
    page.until("!document.querySelector('[role=dialog]')", "the dialog is closed").await?;
    // Twice Escape within a moment would be Stop.
    tokio::time::sleep(std::time::Duration::from_millis(700)).await;
    Ok(())
}

/// Fails with one line for each thing found.
pub(crate) fn nothing(what: &str, found: &[String]) -> Outcome<()> {
    if found.is_empty() { Ok(()) } else { Err(Trouble(format!("{} {what}:\n  {}", found.len(), found.join("\n  ")))) }
}
