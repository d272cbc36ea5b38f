//! How a connector works is read in its dialog, by keyboard too.

use house::{Outcome, skip};

use crate::steps::*;

#[tokio::test]
async fn a_connector_explains_itself_with_marbles() -> Outcome<()> {
    skip::unless!(ready("journey: help of connectors"));
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    add_program(page, "Help").await?;
    page.within("navigation", "Find or add").press("button", "Add Red ball").await?;
    page.within("toolbar", "Next steps for Red ball").press("button", "Distance in cm").await?;
    page.within("toolbar", "Next steps for Distance").press("button", "filter").await?;
    let dialog = page.within("dialog", "Operation");
    dialog.find("button", "How it works").await?;
    assert!(
        page.eval("!document.querySelector('.how-help')").await?.as_bool().unwrap_or_default(),
        "it is quiet at first"
    );
    // With the keyboard, as with the hand.
    page.eval("document.querySelector('.how-open').focus()").await?;
    page.key("Enter").await?;
    dialog.find("button", "Hide how it works").await?;
    dialog.find("image", "Distance: 5 at 0 s, 30 at 0.3 s, 7 at 0.6 s").await?;
    dialog.find("image", "Out comes Near: 5 at 0 s, 7 at 0.6 s").await?;
    says(page, "filter (distance < 20)").await?;
    // It follows the choice, and nothing that was typed is lost.
    dialog.press("radio", "merge").await?;
    dialog.find("image", "Out comes Any ball: red at 0 s, green at 0.3 s, red at 0.6 s").await?;
    dialog.press("radio", "filter").await?;
    dialog.press("button", "Hide how it works").await?;
    assert!(
        page.eval("!document.querySelector('.how-help')").await?.as_bool().unwrap_or_default(),
        "it is closed again"
    );
    page.key("Escape").await?;
    page.gone("dialog", "Operation").await?;
    calm(page)
}
