//! The canvas with the keyboard alone.

use house::{Outcome, Page};

use crate::steps::{stage, text};

async fn on(page: &Page) -> Outcome<String> {
    let name =
        page.eval("document.activeElement.getAttribute('aria-label') || document.activeElement.innerText").await?;
    Ok(text(&name).to_owned())
}

async fn comes_to(page: &Page, name: &str) -> Outcome<()> {
    let js = format!("document.activeElement.getAttribute('aria-label') === {name:?}");
    page.until(&js, &format!("the keyboard is on {name}")).await.map(drop)
}

#[tokio::test]
async fn keys_reach_walk_edit_remove_and_bring_back() -> Outcome<()> {
    let stage = stage!("keyboard");
    let program = stage.wire.make("Keys", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.find("button", "Ball, sensor stream").await?;
    aiko.eval("document.activeElement.blur(), 0").await?;
    let mut tabs = 1;
    aiko.key("Tab").await?;
    if on(&aiko).await? == "To the graph" {
        aiko.key("Enter").await?;
    } else {
        while tabs < 3 && aiko.eval("!document.activeElement.closest('#stage')").await? == true {
            aiko.key("Tab").await?;
            tabs += 1;
        }
    }
    comes_to(&aiko, "Ball, sensor stream").await?;

    for (key, stream) in [
        ("ArrowDown", "Distance, stream"),
        ("ArrowDown", "Far ball, stream"),
        ("ArrowRight", "Close ball, stream"),
        ("ArrowDown", "Head and body tracker, red ball · whole body, actuator stream"),
        ("ArrowUp", "Close ball, stream"),
    ] {
        aiko.key(key).await?;
        comes_to(&aiko, stream).await?;
    }
    aiko.key("Enter").await?;
    aiko.until("document.querySelector('dialog[open], [role=dialog]') !== null", "a dialog opens").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('dialog[open], [role=dialog]') === null", "the dialog is closed").await?;
    comes_to(&aiko, "Close ball, stream").await?;

    aiko.key("Delete").await?;
    aiko.gone("button", "Close ball, stream").await?;
    comes_to(&aiko, "Distance, stream").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "Close ball, stream").await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    aiko.no_errors()
}
