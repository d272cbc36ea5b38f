//! How the history looks, and what differs between versions on the graph: at every size, in light and dark.

use crate::axe::check;
use crate::rules::list;
use crate::screens::{Stage, edit, nothing, rests, run_template, usable};
use crate::targets::SMALL;
use house::{Outcome, Page, skip};
use std::path::PathBuf;

#[tokio::test]
async fn axe_finds_nothing_in_the_history() -> Outcome<()> {
    if !skip::ready("axe on the history") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let aiko = &stage.page;
    run_template(aiko).await?;
    let yuki = stage.browser.person("yuki").await?;
    yuki.size(1440, 900, false).await?;
    yuki.goto(&stage.server.url()).await?;
    yuki.eval("localStorage.setItem('rrp.name', 'Yuki')").await?;
    yuki.goto(&aiko.address().await?).await?;
    yuki.reload().await?;
    usable(&yuki).await?;

    aiko.press("button", "History").await?;
    aiko.until("!!document.querySelector('.history .gesture')", "the history is there").await?;
    aiko.key("n").await?;
    aiko.fill("textbox", "Name of this version", "Before group B").await?;
    let mut found = look(aiko, "naming").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Before group B *").await?;
    changes(aiko, &yuki).await?;
    found.extend(look(aiko, "history").await?);
    aiko.press("button", "Before group B *").await?;
    aiko.until("document.querySelectorAll('.differs.on-graph').length > 2", "the graph is marked").await?;
    found.extend(look(aiko, "compared").await?);
    aiko.eval("document.querySelector('.differences').open = true; 0").await?;
    aiko.press("button", "Go back to it …").await?;
    found.extend(look(aiko, "go-back").await?);
    nothing("findings about the history", &found)
}

/// Aiko adds a sense and another test, Yuki removes an action.
async fn changes(aiko: &Page, yuki: &Page) -> Outcome<()> {
    aiko.within("navigation", "Find or add").press("button", "Add HeadTouch").await?;
    aiko.find("button", "HeadTouch, *").await?;
    aiko.press("button", "filter (distance < 0.5), connector*").await?;
    edit(aiko).await?;
    aiko.within("dialog", "Operation").fill("textbox", "Body", "distance < 0.4").await?;
    aiko.within("dialog", "Operation").press("button", "Save").await?;
    aiko.gone("dialog", "Operation").await?;
    yuki.press("button", "Head tracker, *").await?;
    yuki.within("toolbar", "Next steps for Head tracker").press("button", "Remove").await?;
    aiko.find("button", "Yuki removed Head tracker *").await.map(drop)
}

/// Looks at a state in light and dark, on a desktop, a tablet and a phone.
async fn look(page: &Page, state: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for (size, width, height, touch) in
        [("desktop", 1440, 900, false), ("tablet", 1180, 820, true), ("phone", 390, 844, true)]
    {
        page.size(width, height, touch).await?;
        for dark in [false, true] {
            page.theme(dark).await?;
            rests(page).await?;
            let place = format!("{state}-{size}-{}", if dark { "dark" } else { "light" });
            found.extend(check(page, &place).await?);
            picture(page, &place).await?;
        }
        let least = if touch { 44 } else { 24 };
        found.extend(list(page, &format!("{SMALL}({least})"), &format!("{state}, {size}")).await?);
    }
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
