//! Looks at the panel that looks back: a recorded session at every size, light and dark, in both languages.

use crate::look::{DESKTOP, PHONE, TABLET, WINDOWS, Window, colours, keeps_pictures, measures, set};
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
        if words.code() == "en" {
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
    found.extend(why(&page, words).await?);
    nothing("findings about looking back", &found)
}

/// The past on the graph with the reasons of an action, in every window; where lanes hide the graph, once more with these folded.
async fn why(page: &Page, words: &Words) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    set(page, &DESKTOP).await?;
    page.eval("document.querySelector('.past-canvas').focus(), 0").await?;
    for _ in 0..12 {
        if page.eval("document.querySelector('.past-row.chosen').dataset.kind").await? == "actuator" {
            break;
        }
        page.key("ArrowDown").await?;
    }
    page.until("document.documentElement.hasAttribute('data-then')", "the graph shows the moment").await?;
    page.key("w").await?;
    page.until("document.querySelectorAll('.why-steps > li').length > 2", "the reasons are there").await?;
    for window in WINDOWS {
        set(page, &window).await?;
        keep(page, words, &window, "why").await?;
        if words.code() == "en" {
            found.extend(colours(page, &format!("why-{}", window.0)).await?);
            page.theme(false).await?;
        }
        found.extend(measures(page, &window, "why").await?);
        if [PHONE.0, TABLET.0].contains(&window.0) {
            let fold = "document.querySelector('.past-fold').click(), 0";
            page.eval(fold).await?;
            page.until("!!document.querySelector('.past-folded')", "the graph has the room").await?;
            keep(page, words, &window, "why-graph").await?;
            found.extend(measures(page, &window, "why on the graph").await?);
            page.eval(fold).await?;
            page.until("!document.querySelector('.past-folded')", "the lanes are back").await?;
        }
    }
    // Why not: an action that had nothing to do then.
    set(page, &DESKTOP).await?;
    page.eval("document.querySelector('.past-canvas').focus(), 0").await?;
    page.key("ArrowUp").await?;
    page.eval("document.querySelectorAll('.then-ask .button')[1].click(), 0").await?;
    page.until(
        "!!document.querySelector('.why-not .why-steps > li') || !!document.querySelector('.then-offers button')",
        "it is answered, or asked which",
    )
    .await?;
    page.eval("document.querySelector('.then-offers button')?.click(), 0").await?;
    page.until("!!document.querySelector('.why-not .why-steps > li')", "why not is told").await?;
    keep(page, words, &DESKTOP, "why-not").await?;
    found.extend(measures(page, &DESKTOP, "why not").await?);
    Ok(found)
}

async fn keep(page: &Page, words: &Words, window: &Window, state: &str) -> Outcome<()> {
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
