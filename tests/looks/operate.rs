//! Looks at the operator's page: ready, asked before Start, while it runs with tiles and marks, and without a link.

use crate::look::{DESKTOP, PHONE, WINDOWS, Window, colours, keeps_pictures, measures, set};
use crate::screens::{nothing, rests, says, usable};
use crate::words::Words;
use house::{Browser, GAME, Outcome, Page, Server, Switch, TILES, WallClock, skip};

#[tokio::test]
async fn the_operators_page_keeps_the_rules_and_axe_finds_nothing() -> Outcome<()> {
    skip::unless!(ready("the operator's page at every size"));
    every_state(&Words::english()).await
}

#[tokio::test]
async fn the_operators_page_keeps_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("the operator's page in Japanese"));
    every_state(&Words::japanese()?).await
}

async fn every_state(words: &Words) -> Outcome<()> {
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.media("prefers-reduced-motion", "reduce").await?;
    page.size(1440, 900, false).await?;
    let socket = Switch::install(&page).await?;
    words.open(&page, &server.url()).await?;
    usable(&page).await?;
    page.brings_game().await?;
    page.goto(&format!("{}operate", server.url())).await?;
    usable(&page).await?;
    let mut found = look(&page, words, "operate-choose").await?;
    page.press("button", GAME).await?;
    says(&page, &words.say("Ready to start")).await?;
    found.extend(look(&page, words, "operate-ready").await?);
    page.press("button", &words.say("Start …")).await?;
    page.fill("textbox", &words.begins("Participant code"), "P-07").await?;
    found.extend(look(&page, words, "operate-start").await?);
    page.key("Enter").await?;
    page.find("button", &words.say("Running")).await?;
    for key in ["m", "2", "3", "1"] {
        page.key(key).await?;
    }
    page.until(
        "document.querySelectorAll('.dots i').length === 3 && document.querySelectorAll('.op-lanes rect').length > 1",
        "it is seen",
    )
    .await?;
    found.extend(look(&page, words, "operate-runs").await?);
    socket.cut().await?;
    page.until("!document.querySelector('.op-trouble').hidden", "it says what to do").await?;
    page.key("m").await?;
    page.until("document.querySelectorAll('.op-flag').length === 2", "a mark waits").await?;
    found.extend(look(&page, words, "operate-lost").await?);
    nothing("findings about the operator's page", &found)
}

#[tokio::test]
async fn tiles_that_ask_and_marks_that_are_judged_keep_the_rules() -> Outcome<()> {
    skip::unless!(ready("tiles that ask at every size"));
    own_tiles(&Words::english()).await
}

#[tokio::test]
async fn tiles_that_ask_and_marks_that_are_judged_keep_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("tiles that ask in Japanese"));
    own_tiles(&Words::japanese()?).await
}

/// A program with tiles of its own: one asks, a span goes on, and the verdict of a mark is asked.
async fn own_tiles(words: &Words) -> Outcome<()> {
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.media("prefers-reduced-motion", "reduce").await?;
    page.size(1440, 900, false).await?;
    let clock = WallClock::install(&page).await?;
    words.open(&page, &server.url()).await?;
    usable(&page).await?;
    page.brings_tiles().await?;
    page.goto(&format!("{}operate", server.url())).await?;
    usable(&page).await?;
    page.press("button", TILES).await?;
    page.press("button", &words.say("Start …")).await?;
    page.fill("textbox", &words.begins("Participant code"), "P-07").await?;
    page.key("Enter").await?;
    page.find("button", &words.say("Running")).await?;
    clock.hold().await?;
    clock.forward(1_000).await?;
    page.key("9").await?;
    page.key("4").await?;
    let held = "dispatchEvent(new KeyboardEvent('keydown', { key: '7', code: 'Digit7', cancelable: true })), 0";
    page.eval(held).await?;
    page.until("document.querySelector('.op-verdict') && document.querySelector('[data-state=asks]') && document.querySelector('[data-state=on]')", "it is all there").await?;
    let found = look(&page, words, "operate-asks").await?;
    nothing("findings about tiles that ask", &found)
}

/// Looks at a state in every window, and keeps a picture of each.
async fn look(page: &Page, words: &Words, state: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in WINDOWS {
        set(page, &window).await?;
        keep(page, words, state, &window).await?;
        if [PHONE.0, DESKTOP.0].contains(&window.0) && words.code() == "en" {
            found.extend(colours(page, &format!("{state}-{}", window.0)).await?);
            page.theme(false).await?;
        }
        found.extend(measures(page, &window, state).await?);
    }
    set(page, &DESKTOP).await?;
    Ok(found)
}

async fn keep(page: &Page, words: &Words, state: &str, window: &Window) -> Outcome<()> {
    if !keeps_pictures() {
        return Ok(());
    }
    let place = if words.code() == "en" { "looks" } else { "looks/ja" };
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        rests(page).await?;
        page.screenshot(&house::target().join(format!("{place}/{state}-{}-{theme}.png", window.0))).await?;
    }
    Ok(())
}
