//! What comes later, the second piece of the page's code: the page works without it, and says so where it is missing.

use house::{Outcome, Page, skip};
use serde_json::json;

use crate::steps::*;

/// The address of the second piece.
const PIECE: &str = "*/later-*.wasm";
const NOT_LOADED: &str = "This part of the page could not be loaded. Check the connection and try again.";
/// Whether the keyboard is in the field of the open dialog.
const IN_FIELD: &str = "document.activeElement?.matches('.dialog input')";

#[tokio::test]
async fn the_page_is_used_before_the_rest_of_it_comes() -> Outcome<()> {
    skip::unless!(ready("journey: before the second piece"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.call("Fetch.enable", json!({ "patterns": [{ "urlPattern": PIECE }] })).await?;
    aiko.goto(&stage.server.url()).await?;
    usable(&aiko).await?;
    aiko.press("button", "Track far and close balls*").await?;
    aiko.find("button", "Track far and close balls").await?;
    // What belongs to a stream that is selected comes later; the stream is there.
    aiko.within("navigation", "Find or add").press("button", "Add Face").await?;
    aiko.find("button", "Face, sensor stream").await?;
    saved(&aiko).await?;
    start(&aiko).await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;

    add_a_program(&aiko).await?;
    aiko.find("dialog", "Opening …").await?;
    aiko.until("document.activeElement?.closest('.dialog') != null", "the keyboard is in the dialog").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Opening …").await?;
    add_a_program(&aiko).await?;
    aiko.find("dialog", "Opening …").await?;
    // Lets go of what was held.
    aiko.call("Fetch.disable", json!({})).await?;
    aiko.find("dialog", "Add a program").await?;
    aiko.until(IN_FIELD, "the keyboard is in the field").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_dialog_that_cannot_be_loaded_says_so_and_is_there_afterwards() -> Outcome<()> {
    skip::unless!(ready("journey: without the second piece"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.call("Network.setBlockedURLs", json!({ "urls": [PIECE] })).await?;
    aiko.goto(&stage.server.url()).await?;
    usable(&aiko).await?;
    add_a_program(&aiko).await?;
    says(&aiko, NOT_LOADED).await?;
    let dialog = aiko.within("dialog", "Opening …");
    dialog.press("button", "Try again").await?;
    says(&aiko, NOT_LOADED).await?;
    aiko.call("Network.setBlockedURLs", json!({ "urls": [] })).await?;
    dialog.press("button", "Try again").await?;
    aiko.find("dialog", "Add a program").await?;
    aiko.until(IN_FIELD, "the keyboard is in the field").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Add a program").await?;
    add_program(&aiko, "Made afterwards").await
}

async fn add_a_program(page: &Page) -> Outcome<()> {
    page.within("toolbar", "Main tools").press("button", "Add a program").await
}
