//! What is needed is in view and covers nothing: the panel of what is selected, the bubble of a problem, placeholders, Find.

use crate::floats::{FLOATS, PLACEHOLDERS};
use crate::rules::list;
use crate::screens::{Stage, nothing, open_template, rests, selected};
use crate::words::Words;
use house::{Outcome, Page, skip};

/// How many pixels of the panel of what is selected are in view.
const PANEL: &str = "(() => {
    const panel = document.querySelector('.about .panel'), about = document.querySelector('.about');
    if (!panel) return 0;
    const [own, around] = [panel.getBoundingClientRect(), about.getBoundingClientRect()];
    return Math.min(own.bottom, around.bottom, innerHeight) - Math.max(own.top, around.top);
})()";

#[tokio::test]
async fn what_is_needed_is_in_view_and_covers_nothing() -> Outcome<()> {
    skip::unless!(ready("what fits"));
    let words = Words::english();
    let stage = Stage::set_in(&words).await?;
    let page = &stage.page;
    let mut found = Vec::new();
    open_template(page, &words).await?;
    selected(page, &words, "Distance").await?;
    page.until("!!document.querySelector('.about .panel h2')", "its panel is there").await?;
    rests(page).await?;
    let panel = page.eval(PANEL).await?.as_f64().unwrap_or_default();
    if panel < 240.0 {
        found.push(format!("{panel} pixels of the panel are in view"));
    }
    found.extend(list(page, PLACEHOLDERS, "with a selection").await?);
    found.extend(list(page, FLOATS, "with a selection").await?);
    problem(page, &words, &mut found).await?;
    find(page).await?;
    stop_after_start(page).await?;
    nothing("what does not fit", &found)?;
    page.no_errors()
}

/// A badge tells of its problem at every press, and that covers neither what it is about nor the tools.
async fn problem(page: &Page, words: &Words, found: &mut Vec<String>) -> Outcome<()> {
    page.press("button", "Add Face").await?;
    page.until("document.querySelector('#stage .stream.selected')?.innerText.includes('Face')", "Face is new").await?;
    for time in 0..3 {
        // Who works on it is not blamed; once something else is selected it is.
        selected(page, words, "Distance").await?;
        page.until("!!document.querySelector('.badge.pressed')", "there is a badge").await?;
        page.eval("document.querySelector('.badge.pressed').click()").await?;
        page.until("!!document.querySelector('.trouble')", "the problem is told").await?;
        rests(page).await?;
        found.extend(list(page, FLOATS, &format!("with a bubble, press {time}")).await?);
        page.eval("document.querySelector('.trouble .tool.icon').click()").await?;
        page.until("!document.querySelector('.trouble')", "the bubble is put away").await?;
    }
    Ok(())
}

/// Enter in Find goes to the stream that is called so.
async fn find(page: &Page) -> Outcome<()> {
    page.eval("document.getElementById('find').focus()").await?;
    page.type_text("head tracker").await?;
    page.until(
        "document.querySelector('.left .list .item')?.innerText.trim() === 'Head tracker'",
        "the stream of that name comes first",
    )
    .await?;
    page.key("Enter").await?;
    page.until(
        "document.querySelector('#stage .stream.selected')?.innerText.includes('Head tracker')",
        "Enter went to it",
    )
    .await?;
    Ok(())
}

/// Tab comes from Start to Stop, and from there to what follows Start.
async fn stop_after_start(page: &Page) -> Outcome<()> {
    page.until("!document.querySelector('.start').disabled", "Start can be pressed").await?;
    page.eval("document.querySelector('.start').focus()").await?;
    page.key("Tab").await?;
    page.until("document.activeElement.id === 'stop'", "Tab comes to Stop").await?;
    page.key("Shift+Tab").await?;
    page.until("document.activeElement.matches('.start')", "and back").await?;
    page.key("Tab").await?;
    page.key("Tab").await?;
    page.until("!!document.activeElement.closest('.right') && !document.activeElement.matches('.start')", "and on")
        .await?;
    Ok(())
}
