//! How it looks when two changed one thing, and when the link is lost: on every size, in light and dark.

use crate::axe::check;
use crate::look::{DESKTOP, WINDOWS, look_in, set};
use crate::screens::{edit, nothing, rests, run_template, usable};
use crate::words::Words;
use house::{Browser, Outcome, Page, Server, Switch, skip};

/// The connector that both change.
const CHIP: &str = "filter (distance < 0.5), connector*";

#[tokio::test]
async fn axe_finds_nothing_where_two_changes_stand_side_by_side() -> Outcome<()> {
    skip::unless!(ready("axe on two changes"));
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let aiko = browser.person("aiko").await?;
    let socket = enter(&aiko, &server.url(), "Aiko").await?;
    run_template(&aiko, &Words::english()).await?;
    let yuki = browser.person("yuki").await?;
    enter(&yuki, &aiko.address().await?, "Yuki").await?;

    socket.cut().await?;
    write(&aiko, "distance < 0.3").await?;
    let mut found = look(&aiko, "lost", "Show them").await?;
    aiko.press("button", "Show them").await?;
    aiko.find("dialog", "What waits here").await?;
    found.extend(look(&aiko, "waiting", "Close").await?);
    aiko.key("Escape").await?;
    aiko.gone("dialog", "What waits here").await?;
    write(&yuki, "distance < 0.4").await?;
    yuki.find("button", "filter (distance < 0.4), connector*").await?;
    socket.mend().await?;
    aiko.find("dialog", "Yuki changed this filter too").await?;
    aiko.until("!!document.querySelector('.compare .sum')", "both are tried on real values").await?;
    found.extend(look(&aiko, "refused", "Keep mine").await?);
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Yuki changed this filter too").await?;
    found.extend(look(&aiko, "later", "Stop").await?);
    nothing("findings about two changes", &found)
}

/// Opens the page behind a switch, under a name.
async fn enter<'a>(page: &'a Page, url: &str, name: &str) -> Outcome<Switch<'a>> {
    let socket = Switch::install(page).await?;
    page.size(1440, 900, false).await?;
    page.goto(url).await?;
    page.eval(&format!("localStorage.setItem('rrp.name', '{name}')")).await?;
    page.reload().await?;
    usable(page).await?;
    Ok(socket)
}

async fn write(page: &Page, test: &str) -> Outcome<()> {
    page.press("button", CHIP).await?;
    edit(page, &Words::english()).await?;
    let dialog = page.within("dialog", "Operation");
    dialog.fill("textbox", "Procedure", test).await?;
    dialog.press("button", "Save").await?;
    page.gone("dialog", "Operation").await
}

/// Looks at a state everywhere, also in a very low window; a button of it is there in all.
async fn look(page: &Page, state: &str, button: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in &WINDOWS {
        set(page, window).await?;
        page.find("button", button).await?;
        found.extend(look_in(page, state, std::slice::from_ref(window)).await?);
    }
    // As low as under the keyboard of a phone, where long contents must scroll by keys too.
    page.size(390, 420, true).await?;
    rests(page).await?;
    found.extend(check(page, &format!("{state}, low")).await?);
    set(page, &DESKTOP).await?;
    Ok(found)
}
