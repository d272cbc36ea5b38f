//! Looks at the panel that looks back: a recorded session at every size, light and dark, in both languages.

use crate::look::{DESKTOP, PHONE, WINDOWS, Window, colours, keeps_pictures, measures, set};
use crate::screens::{nothing, rests, usable};
use crate::words::Words;
use house::{Browser, Outcome, Page, SESSION, Server, keep_session, keep_session_program, skip};

#[tokio::test]
async fn the_panel_that_looks_back_keeps_the_rules_and_axe_finds_nothing() -> Outcome<()> {
    skip::unless!(ready("looking back at every size"));
    every_window(&Words::english()).await
}

#[tokio::test]
async fn the_panel_that_looks_back_keeps_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("looking back in Japanese"));
    every_window(&Words::japanese()?).await
}

#[tokio::test]
async fn what_would_change_keeps_the_rules_and_axe_finds_nothing() -> Outcome<()> {
    skip::unless!(ready("comparing at every size"));
    compared_in_every_window(&Words::english(), "Compare").await
}

#[tokio::test]
async fn what_would_change_keeps_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("comparing in Japanese"));
    compared_in_every_window(&Words::japanese()?, "比較").await
}

/// The session compared with a program in which a condition has another number.
async fn compared_in_every_window(words: &Words, button: &str) -> Outcome<()> {
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let _yuki = keep_session_program(&server.url()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.media("prefers-reduced-motion", "reduce").await?;
    page.size(1440, 900, false).await?;
    words.open(&page, &server.url()).await?;
    page.goto(&format!("{}?past={SESSION}", server.url())).await?;
    usable(&page).await?;
    page.until("document.querySelectorAll('.stream').length === 6", "the program is open").await?;
    page.until("document.querySelectorAll('.past-label').length > 4", "the lanes are there").await?;
    page.press("button", button).await?;
    page.until("document.querySelector('.past-counts')", "it is compared").await?;
    let turn = "(() => { const chip = [...document.querySelectorAll('[data-chip]')].find(one => /< 0\\.5/.test(one.innerText)); \
        if (!chip) return false; chip.click(); return !!document.querySelector('.flyout .slider input'); })()";
    page.until(turn, "the condition is open").await?;
    page.eval(
        "(() => { const slider = document.querySelector('.flyout .slider input'); slider.value = '0.4'; \
         slider.dispatchEvent(new Event('input', { bubbles: true })); })(), 0",
    )
    .await?;
    page.until("document.querySelector('.past-counts .differs')", "something changes").await?;
    page.key("Escape").await?;
    page.until("document.querySelector('.past-unsaved').hidden", "it is saved").await?;
    let mut found = Vec::new();
    for window in WINDOWS {
        set(&page, &window).await?;
        keep(&page, words, &window, "change").await?;
        if [PHONE.0, DESKTOP.0].contains(&window.0) && words.code() == "en" {
            found.extend(colours(&page, &format!("change-{}", window.0)).await?);
            page.theme(false).await?;
        }
        found.extend(measures(&page, &window, "change").await?);
    }
    nothing("findings about comparing", &found)
}

async fn every_window(words: &Words) -> Outcome<()> {
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.media("prefers-reduced-motion", "reduce").await?;
    page.size(1440, 900, false).await?;
    words.open(&page, &server.url()).await?;
    page.goto(&format!("{}?past={SESSION}", server.url())).await?;
    usable(&page).await?;
    page.until("document.querySelectorAll('.past-table tbody tr').length > 2", "the lanes are there").await?;
    page.key("[").await?;
    page.key("ArrowDown").await?;
    page.until("document.querySelectorAll('.past-table tbody tr').length > 2", "their values are there").await?;
    let mut found = Vec::new();
    for window in WINDOWS {
        set(&page, &window).await?;
        keep(&page, words, &window, "past").await?;
        if [PHONE.0, DESKTOP.0].contains(&window.0) && words.code() == "en" {
            found.extend(colours(&page, &format!("past-{}", window.0)).await?);
            page.theme(false).await?;
        }
        found.extend(measures(&page, &window, "past").await?);
    }
    nothing("findings about looking back", &found)
}

async fn keep(page: &Page, words: &Words, window: &Window, what: &str) -> Outcome<()> {
    if !keeps_pictures() {
        return Ok(());
    }
    let place = if words.code() == "en" { "looks" } else { "looks/ja" };
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        rests(page).await?;
        page.screenshot(&house::target().join(format!("{place}/{what}-{}-{theme}.png", window.0))).await?;
    }
    Ok(())
}
