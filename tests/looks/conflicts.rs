//! How it looks when two changed one thing, and when the link is lost: on every size, in light and dark.

use crate::axe::check;
use crate::rules::{broken, list};
use crate::screens::{edit, nothing, rests, run_template, usable};
use crate::targets::SMALL;
use house::{Browser, Outcome, Page, Server, Switch, skip};
use std::path::PathBuf;

/// The connector that both change.
const CHIP: &str = "filter (distance < 0.5), connector*";

#[tokio::test]
async fn axe_finds_nothing_where_two_changes_stand_side_by_side() -> Outcome<()> {
    if !skip::ready("axe on two changes") {
        return Ok(());
    }
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let aiko = browser.person("aiko").await?;
    let socket = enter(&aiko, &server.url(), "Aiko").await?;
    run_template(&aiko).await?;
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
    edit(page).await?;
    let dialog = page.within("dialog", "Operation");
    dialog.fill("textbox", "Body", test).await?;
    dialog.press("button", "Save").await?;
    page.gone("dialog", "Operation").await
}

/// Looks at a state in light and dark, on a desktop, a tablet and a phone, also a very low one; a button of it is there on all.
async fn look(page: &Page, state: &str, button: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for (size, width, height, touch) in
        [("desktop", 1440, 900, false), ("tablet", 1180, 820, true), ("phone", 390, 844, true)]
    {
        page.size(width, height, touch).await?;
        page.find("button", button).await?;
        for dark in [false, true] {
            page.theme(dark).await?;
            rests(page).await?;
            let place = format!("{state}-{size}-{}", if dark { "dark" } else { "light" });
            found.extend(check(page, &place).await?);
            picture(page, &place).await?;
        }
        found.extend(broken(page, &format!("{state}, {size}")).await?);
        let least = if touch { 44 } else { 24 };
        found.extend(list(page, &format!("{SMALL}({least})"), &format!("{state}, {size}")).await?);
    }
    // As low as under the keyboard of a phone, where long contents must scroll by keys too.
    page.size(390, 420, true).await?;
    rests(page).await?;
    found.extend(check(page, &format!("{state}, low")).await?);
    page.theme(false).await?;
    page.size(1440, 900, false).await?;
    Ok(found)
}

/// Keeps a picture where `LOOKS_PICTURES` says, if it says so.
async fn picture(page: &Page, name: &str) -> Outcome<()> {
    match std::env::var_os("LOOKS_PICTURES") {
        Some(folder) => page.screenshot(&PathBuf::from(folder).join(format!("{name}.png"))).await,
        None => Ok(()),
    }
}
