//! How it looks when two people want to edit one thing: ring, padlock, who reads, who is asked, who lost it.

use crate::axe::check;
use crate::look::{look, picture};
use crate::screens::{Stage, edit, nothing, run_template, usable};
use crate::words::Words;
use house::{Outcome, Page, skip};

/// The connector that both want.
const CHIP: &str = "filter (distance < 0.5), connector*";

#[tokio::test]
async fn axe_finds_nothing_while_somebody_else_is_editing() -> Outcome<()> {
    skip::unless!(ready("axe on locks"));
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
    let mut found = Vec::new();
    open_filter(&yuki).await?;
    aiko.until("!!document.querySelector('.ring .tag svg')", "the ring is there").await?;
    found.extend(look(aiko, "ring").await?);
    open_filter(aiko).await?;
    aiko.find("button", "Ask Yuki").await?;
    found.extend(look(aiko, "reading").await?);
    aiko.press("button", "Ask Yuki").await?;
    yuki.press("button", "Keep it").await?;
    aiko.until("document.body.innerText.includes('keeps it for now')", "Yuki keeps it").await?;
    found.extend(look(aiko, "kept").await?);
    nothing("findings about locks", &found)
}

#[tokio::test]
async fn axe_finds_nothing_when_something_is_handed_over() -> Outcome<()> {
    skip::unless!(ready("axe on handing over"));
    let stage = Stage::set().await?;
    let yuki = &stage.page;
    run_template(yuki, &Words::english()).await?;
    let aiko = stage.browser.person("aiko").await?;
    aiko.goto(&yuki.address().await?).await?;
    usable(&aiko).await?;
    open_filter(yuki).await?;
    open_filter(&aiko).await?;
    aiko.press("button", "Ask*").await?;
    yuki.find("button", "Hand over").await?;
    let mut found = check(yuki, "asked").await?;
    picture(yuki, "asked").await?;
    picture(&aiko, "waiting").await?;
    // No answer for 10 seconds means yes, and the look may have taken longer.
    let hand_over =
        "[...document.querySelectorAll('button')].find(button => button.textContent.trim() === 'Hand over')?.click()";
    yuki.eval(hand_over).await?;
    yuki.find("button", "Ask*").await?;
    found.extend(look(yuki, "handed-over").await?);
    nothing("findings about handing over", &found)
}

async fn open_filter(page: &Page) -> Outcome<()> {
    page.press("button", CHIP).await?;
    edit(page, &Words::english()).await?;
    page.find("dialog", "Operation").await.map(drop)
}
