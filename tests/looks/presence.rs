//! How it looks when others are here: their signs and pointers, the field for one's name, following, the list of people.

use crate::look::look;
use crate::rules;
use crate::screens::{Stage, nothing, run_template, usable};
use crate::words::Words;
use house::{Outcome, Page, skip};

#[tokio::test]
async fn axe_finds_nothing_while_others_are_here() -> Outcome<()> {
    skip::unless!(ready("axe on people"));
    let stage = Stage::set().await?;
    let aiko = &stage.page;
    run_template(aiko, &Words::english()).await?;
    let yuki = beside(&stage, "yuki", "Yuki").await?;
    let _guest = beside(&stage, "guest", "Guest 42").await?;
    yuki.press("button", "Distance, *").await?;
    yuki.move_to((760.0, 420.0)).await?;
    let mut found = Vec::new();
    aiko.until(
        "!!document.querySelector('.people-pointer') && !!document.querySelector('.ring .tag')",
        "Yuki is there",
    )
    .await?;
    aiko.find("textbox", "Others see you as").await?;
    found.extend(look(aiko, "name-asked").await?);
    aiko.press("button", "Not now").await?;
    aiko.press("button", "Follow Yuki").await?;
    aiko.find("button", "End").await?;
    found.extend(look(aiko, "following").await?);
    for (at, name) in ["Ren", "Mio", "Ben"].into_iter().enumerate() {
        let _stays = beside(&stage, &format!("other-{at}"), name).await?;
    }
    for width in [900, 1000, 1199, 1200, 1280, 1366] {
        aiko.size(width, 800, false).await?;
        aiko.frames().await?;
        found.extend(rules::broken(aiko, &format!("six people in {width}")).await?);
    }
    aiko.size(1440, 900, false).await?;
    aiko.press("button", "1 more person").await?;
    aiko.find("dialog", "People here").await?;
    found.extend(look(aiko, "people").await?);
    nothing("findings about people", &found)
}

/// Somebody else with this name, in what is open.
async fn beside(stage: &Stage, window: &str, name: &str) -> Outcome<Page> {
    let page = stage.browser.person(window).await?;
    page.size(1440, 900, false).await?;
    page.goto(&stage.server.url()).await?;
    page.eval(&format!("localStorage.setItem('rrp.name', '{name}')")).await?;
    page.goto(&stage.page.address().await?).await?;
    page.reload().await?;
    usable(&page).await?;
    Ok(page)
}
