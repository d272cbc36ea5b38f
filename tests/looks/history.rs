//! How the history looks, and what differs between versions on the graph: at every size, in light and dark.

use crate::look::look;
use crate::screens::{Stage, edit, nothing, run_template, usable};
use crate::words::Words;
use house::{Outcome, Page, skip};

#[tokio::test]
async fn axe_finds_nothing_in_the_history() -> Outcome<()> {
    skip::unless!(ready("axe on the history"));
    let stage = Stage::set().await?;
    let aiko = &stage.page;
    run_template(aiko, &Words::english()).await?;
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
    aiko.within("navigation", "Find or add").press("button", "Add Head touch").await?;
    aiko.find("button", "Head touch, *").await?;
    aiko.press("button", "filter (distance < 0.5), connector*").await?;
    edit(aiko, &Words::english()).await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "distance < 0.4").await?;
    aiko.within("dialog", "Operation").press("button", "Save").await?;
    aiko.gone("dialog", "Operation").await?;
    yuki.press("button", "Head tracker, *").await?;
    yuki.within("toolbar", "Next steps for Head tracker").press("button", "Remove").await?;
    aiko.find("button", "Yuki removed Head tracker *").await.map(drop)
}
