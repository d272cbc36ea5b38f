//! A procedure that never ends harms nobody but itself.

use house::{Outcome, Page, skip};

use crate::steps::*;

const ENDLESS: &str = "while true {} true";
const CHIP: &str = "filter (while true {} true), connector*";

#[tokio::test]
async fn an_endless_loop_harms_only_itself() -> Outcome<()> {
    if !skip::ready("journey: runaway") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Runaway").await?;
    add_sense(&aiko, "RedBall").await?;
    thunderbolt(&aiko, "RedBall", "filter").await?;
    write_endless(&aiko).await?;
    start(&aiko).await?;
    let js = "function () { return this.closest('.at').querySelector('.fault')?.textContent; }";
    let why = aiko.until_on("button", CHIP, js, "the connector says why it fails").await?;
    assert!(why.as_str().is_some_and(|why| why.contains("too many steps")), "{why}");

    let ben = stage.person("ben").await?;
    add_program(&ben, "Beside").await?;
    add_sense(&ben, "RedBall").await?;
    next(&ben, "RedBall", "distance").await?;
    ben.find("button", "Distance, stream").await?;
    saved(&ben).await?;
    start(&ben).await?;
    shows_value(&ben, "Distance").await?;

    still_answers(&aiko).await?;
    aiko.find("button", "Running").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    at_rest(&ben).await?;
    calm(&ben)?;
    calm(&aiko)
}

async fn write_endless(page: &Page) -> Outcome<()> {
    page.within("dialog", "Operation").fill("textbox", "Body", ENDLESS).await?;
    save(page, "Operation").await?;
    page.find("button", CHIP).await.map(drop)
}

/// Selects and zooms.
async fn still_answers(page: &Page) -> Outcome<()> {
    page.press("button", CHIP).await?;
    page.find("toolbar", "Next steps for filter").await?;
    select(page, "RedBall").await?;
    let before = page.boxed("button", "RedBall, sensor stream").await?;
    page.within("group", "Zoom").press("button", "Zoom in").await?;
    let wider = format!("function () {{ return this.getBoundingClientRect().width > {}; }}", before.width * 1.1);
    page.until_on("button", "RedBall, sensor stream", &wider, "the graph is larger").await.map(drop)
}
