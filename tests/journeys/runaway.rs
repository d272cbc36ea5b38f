//! A procedure that never ends harms nobody but itself.

use house::{Outcome, Page, skip};

use crate::steps::*;

const ENDLESS: &str = "while true {} true";
const CHIP: &str = "filter (while true {} true), connector*";

#[tokio::test]
async fn an_endless_loop_harms_only_itself() -> Outcome<()> {
    skip::unless!(ready("journey: runaway"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Runaway").await?;
    add_sense(&aiko, "Red ball").await?;
    thunderbolt(&aiko, "Red ball", "filter").await?;
    write_endless(&aiko).await?;
    start(&aiko).await?;
    let js = "function () { return this.closest('.at').querySelector('.fault')?.textContent; }";
    let why = aiko.until_on("button", CHIP, js, "the connector says why it fails").await?;
    assert!(why.as_str().is_some_and(|why| why.contains("too many steps")), "{why}");

    let ben = stage.person("ben").await?;
    add_program(&ben, "Beside").await?;
    add_sense(&ben, "Red ball").await?;
    next(&ben, "Red ball", "Distance in cm").await?;
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
    let dialog = page.within("dialog", "Operation");
    dialog.fill("textbox", "Procedure", ENDLESS).await?;
    // A whole procedure names nothing: the name is asked for.
    dialog.press("button", "Save").await?;
    says(page, "Give the stream a name.").await?;
    page.until("document.activeElement.id === 'output-name'", "the name has the keyboard").await?;
    page.type_text("Endless").await?;
    save(page, "Operation").await?;
    page.find("button", CHIP).await.map(drop)
}

/// Selects and zooms.
async fn still_answers(page: &Page) -> Outcome<()> {
    page.press("button", CHIP).await?;
    page.find("toolbar", "Next steps for filter").await?;
    select(page, "Red ball").await?;
    let before = page.boxed("button", "Red ball, sensor stream").await?;
    page.within("group", "Zoom").press("button", "Zoom in").await?;
    let wider = format!("function () {{ return this.getBoundingClientRect().width > {}; }}", before.width * 1.1);
    page.until_on("button", "Red ball, sensor stream", &wider, "the graph is larger").await.map(drop)
}
