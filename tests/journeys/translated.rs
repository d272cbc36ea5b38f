//! A browser that translates pages puts their texts into elements of its own: what the page says stays true all the same.

use house::{Outcome, skip};

use crate::steps::*;

/// Does to the page what a translation does.
const TRANSLATE: &str = include_str!("translate.js");

#[tokio::test]
async fn a_translated_page_says_what_is_so() -> Outcome<()> {
    skip::unless!(ready("journey: a translated page"));
    let mut stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    add_program(&aiko, "Translate").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Distance in cm").await?;
    aiko.find("button", "Distance, stream").await?;
    saved(&aiko).await?;
    aiko.eval(&format!("{TRANSLATE}; 0")).await?;

    start(&aiko).await?;
    says(&aiko, "Running").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    says(&aiko, "Start").await?;

    select(&aiko, "Distance").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name is a field").await?;
    aiko.type_text("Tens").await?;
    aiko.key("Enter").await?;
    says(&aiko, "Tens").await?;
    saved(&aiko).await?;

    // A change waits.
    socket.cut().await?;
    says(&aiko, "Offline").await?;
    silent(&aiko, "All changes saved").await?;
    socket.mend().await?;
    saved(&aiko).await?;
    stage.server.terminate().await
}
