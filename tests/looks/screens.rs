//! Walks through the screens as a person reaches them, and stops at each.

use crate::words::Words;
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
        Self::set_in(&Words::english()).await
    }

    /// The same in one language.
    pub(crate) async fn set_in(words: &Words) -> Outcome<Stage> {
        let folder = house::folder()?;
        let server = Server::start(folder.path()).await?;
        let browser = Browser::launch().await?;
        let page = browser.person("aiko").await?;
        page.size(1440, 900, false).await?;
        // Looks are about what stands at last: nobody has to wait for it.
        page.media("prefers-reduced-motion", "reduce").await?;
        words.open(&page, &server.url()).await?;
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
    let still = "document.getAnimations().every(motion => motion.playState !== 'running')";
    page.until(still, "nothing moves").await?;
    page.frames().await
}

/// Shows everything.
pub(crate) async fn fit(page: &Page) -> Outcome<()> {
    rests(page).await?;
    page.eval("document.querySelector('.zoom button:last-child').click()").await?;
    rests(page).await?;
    page.until("document.querySelector('#stage:not(.gliding)')", "the view rests").await?;
    rests(page).await
}

/// Visits every screen on a desktop, with its name; whoever visits may change size and theme and must put them back.
pub(crate) async fn walk(page: &Page, words: &Words, visit: impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    visit("empty-library").await?;
    page.press("button", &words.say("Add a program")).await?;
    page.find("dialog", &words.say("Add a program")).await?;
    visit("add-program").await?;
    page.press("button", &words.say("Create")).await?;
    page.find("heading", &words.say("Add a sense to begin")).await?;
    page.until("document.activeElement.matches('.sense-card')", "the first sense has the keyboard").await?;
    visit("empty-program").await?;
    learning(page, words, &visit).await?;
    run_template(page, words).await?;
    visit("running").await?;
    panels(page, &visit).await?;
    robots(page, words, &visit).await?;
    operations(page, words, &visit).await?;
    selected(page, words, "Head tracker").await?;
    edit(page, words).await?;
    page.find("dialog", &words.fill("{what} settings", &[("what", &words.say("Tracker"))])).await?;
    visit("edit-actuator").await?;
    leave(page).await?;
    page.press("button", &words.say("Edit helper")).await?;
    page.press("menuitem", &words.begins("Arm on that side")).await?;
    page.find("dialog", &words.say("Edit helper")).await?;
    visit("helper").await?;
    leave(page).await?;
    programs(page, words, &visit).await?;
    page.press("button", &words.say("Load program")).await?;
    page.press("menuitem", &words.say("Save as file …")).await?;
    page.find("dialog", &words.say("Save as file")).await?;
    visit("save-as-file").await?;
    leave(page).await
}

/// The list of programs, of templates, and of what was removed.
async fn programs(page: &Page, words: &Words, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    page.press("button", &words.say("Load program")).await?;
    page.press("menuitem", &words.say("All programs and templates …")).await?;
    page.find("dialog", &words.say("Load program")).await?;
    page.until("document.querySelectorAll('.program-line .picture path').length > 0", "its picture is there").await?;
    visit("load-program").await?;
    page.press("button", &words.fill("More about {name}", &[("name", TEMPLATE)])).await?;
    page.find("button", &words.say("Back to the list")).await?;
    visit("load-program-details").await?;
    page.press("radio", &words.say("Templates")).await?;
    visit("load-program-templates").await?;
    page.press("radio", &words.say("Bin")).await?;
    says(page, &words.say("The bin is empty. What is removed stays here for 30 days.")).await?;
    visit("load-program-bin").await?;
    leave(page).await
}

/// Opens the template and starts it.
pub(crate) async fn run_template(page: &Page, words: &Words) -> Outcome<()> {
    open_template(page, words).await?;
    page.press("button", &words.say("Start")).await?;
    page.find("button", &words.say("Running")).await?;
    says(page, "/s").await
}

/// Opens the template.
pub(crate) async fn open_template(page: &Page, words: &Words) -> Outcome<()> {
    page.press("button", &words.say("Load program")).await?;
    page.press("menuitem", &words.begins(TEMPLATE)).await?;
    let open = format!("document.title.includes('{TEMPLATE}') || document.body.innerText.includes('Head tracker')");
    page.until(&open, "the template is open").await.map(drop)
}

/// Waits until these words are in the page.
pub(crate) async fn says(page: &Page, said: &str) -> Outcome<()> {
    let quoted = serde_json::Value::from(said);
    page.until(&format!("document.body.innerText.includes({quoted})"), &format!("it says “{said}”")).await.map(drop)
}

/// Does what the list of commands calls like that, in English.
pub(crate) async fn command(page: &Page, english: &str) -> Outcome<()> {
    page.key("Control+k").await?;
    let asks = "document.activeElement.type === 'search' && !!document.activeElement.closest('[role=dialog]')";
    page.until(asks, "it asks what").await?;
    page.type_text(english).await?;
    page.until("!!document.querySelector('.commands-list .menu-item')", "it is found").await?;
    page.key("Enter").await?;
    // What comes then may be this very list, empty.
    page.until("!document.querySelector('.commands-list') || !document.activeElement.value", "the list is gone")
        .await
        .map(drop)
}

/// The tour at its first two steps, and a task that is missed.
async fn learning(page: &Page, words: &Words, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    command(page, "take the tour").await?;
    page.find("complementary", &words.say("Tour")).await?;
    says(page, &words.fill("Step {at} of {of}", &[("at", "2"), ("of", "9")])).await?;
    visit("tour").await?;
    page.press("button", &words.say("Leave the tour")).await?;
    command(page, "load program").await?;
    page.press("radio", &words.say("Templates")).await?;
    page.press("button", &words.begins("Brighter when nearer")).await?;
    let named = words.fill("Task: {name}", &[("name", &words.say("Brighter when nearer"))]);
    let task = page.within("region", &named);
    task.press("button", &words.say("Try it")).await?;
    page.until("document.querySelector('.verdict') !== null", "it is tried").await?;
    visit("task").await
}

/// Every panel that opens by a command, one after the other.
async fn panels(page: &Page, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    let row = ".commands-list [data-panel]";
    page.key("Control+k").await?;
    page.until(&format!("!!document.querySelector('{row}')"), "commands that open panels are listed").await?;
    let names = page.eval(&format!("[...document.querySelectorAll('{row}')].map(row => row.dataset.panel)")).await?;
    leave(page).await?;
    for name in names.as_array().into_iter().flatten().filter_map(serde_json::Value::as_str) {
        let (row, panel) = (format!(".commands-list [data-panel={name}]"), format!(".side[data-panel={name}]"));
        page.key("Control+k").await?;
        page.until(&format!("!!document.querySelector('{row}')"), "the command is listed").await?;
        page.eval(&format!("document.querySelector('{row}').click()")).await?;
        page.until(&format!("!!document.querySelector('{panel} h2')"), &format!("the panel {name} is open")).await?;
        visit(&format!("panel-{name}")).await?;
        page.eval(&format!("document.querySelector('{panel} [data-close]').click()")).await?;
        page.until("!document.querySelector('.side')", &format!("the panel {name} is closed")).await?;
    }
    Ok(())
}

/// Adds a second robot and goes back to the one on which something runs.
async fn robots(page: &Page, words: &Words, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    let picker = words.fill("Robot: {name}", &[("name", "*")]);
    page.press("button", &picker).await?;
    page.press("menuitem", &words.say("Add a simulated robot")).await?;
    page.find("dialog", &words.say("Add a simulated robot")).await?;
    visit("add-robot").await?;
    page.press("button", &words.say("Create")).await?;
    page.find("button", &words.say("Start")).await?;
    page.press("button", &picker).await?;
    page.find("menu", &picker).await?;
    visit("robots").await?;
    page.eval("document.querySelector('.robot-picker [role=menuitemradio]').click()").await?;
    page.find("button", &words.say("Running")).await?;
    page.until("document.body.innerText.includes('/s')", "values come again").await.map(drop)
}

async fn operations(page: &Page, words: &Words, visit: &impl AsyncFn(&str) -> Outcome<()>) -> Outcome<()> {
    operation(page, words).await?;
    for connector in CONNECTORS {
        page.press("radio", &words.say(connector)).await?;
        if connector == "filter" {
            page.fill("textbox", &words.say("Procedure"), "distance < 0.5").await?;
            let [passes, left_out] = ["passes", "left out"].map(|word| words.say(word));
            let tried = format!("/{passes}|{left_out}/.test(document.querySelector('[role=dialog]').innerText)");
            page.until(&tried, "the test is tried").await?;
        }
        let screen = connector.replace(' ', "-");
        visit(&format!("operation-{screen}")).await?;
        if HELP.contains(&connector) {
            page.press("button", &words.say("How it works")).await?;
            page.until("!!document.querySelector('.how-example .marble')", "the help is open").await?;
            visit(&format!("operation-{screen}-help")).await?;
            page.press("button", &words.say("Hide how it works")).await?;
        }
    }
    leave(page).await
}

/// Opens the Operation dialog for a filter out of “Distance”.
pub(crate) async fn operation(page: &Page, words: &Words) -> Outcome<()> {
    selected(page, words, "Distance").await?;
    page.press("button", &words.say("Add connector")).await?;
    page.press("menuitem", &words.say("filter")).await?;
    page.find("dialog", &words.say("Operation")).await.map(drop)
}

/// Selects a stream on the canvas.
pub(crate) async fn selected(page: &Page, words: &Words, stream: &str) -> Outcome<()> {
    page.press("button", &words.stream(stream)).await
}

/// Presses Edit beside what is selected.
pub(crate) async fn edit(page: &Page, words: &Words) -> Outcome<()> {
    let edit = words.say("Edit");
    let press = format!(
        "[...document.querySelectorAll('.right button')].find(button => button.textContent.trim() === '{edit}')"
    );
    page.until(&format!("!!{press}"), "Edit is offered").await?;
    page.eval(&format!("{press}.click()")).await.map(drop)
}

/// Closes the dialog.
pub(crate) async fn leave(page: &Page) -> Outcome<()> {
    page.key("Escape").await?;
    page.until("!document.querySelector('[role=dialog]')", "the dialog is closed").await.map(drop)
}

/// Fails with one line for each thing found.
pub(crate) fn nothing(what: &str, found: &[String]) -> Outcome<()> {
    if found.is_empty() { Ok(()) } else { Err(Trouble(format!("{} {what}:\n  {}", found.len(), found.join("\n  ")))) }
}
