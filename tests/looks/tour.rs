//! The tour in Japanese: whatever it quotes stands on the page under just that name, step by step to its end.

use crate::rules::list;
use crate::screens::{Stage, nothing, says};
use crate::words::Words;
use house::{Outcome, Page, skip};

/// What the tour quotes and nothing outside of it says, in words or in a field.
const UNSAID: &str = "(() => {
    const tour = document.querySelector('.tour');
    const quoted = [...tour.innerText.matchAll(/「([^」]+)」/g)].map(found => found[1]);
    const others = [...document.querySelectorAll('button, [role=button], label, textarea, input')].filter(one => !tour.contains(one));
    const said = others.map(one => `${one.innerText} ${one.value ?? ''} ${one.getAttribute('aria-label') ?? ''}`).join('\\n');
    return quoted.filter(words => !said.includes(words)).map(words => `nothing is called 「${words}」`);
})()";

#[tokio::test]
async fn the_tour_in_japanese_names_what_is_there() -> Outcome<()> {
    skip::unless!(ready_in_japanese("the tour in Japanese"));
    let words = Words::japanese()?;
    let stage = Stage::set_in(&words).await?;
    let page = &stage.page;
    let mut unsaid = Vec::new();
    page.press("button", &words.say("Take the tour")).await?;
    unsaid.extend(step(page, &words, 1).await?);
    page.press("button", &words.say("Start with an empty program")).await?;
    page.find("dialog", &words.say("Add a program")).await?;
    page.key("Enter").await?;
    unsaid.extend(step(page, &words, 2).await?);
    // The palette adds it too; the card for a beginning has the keyboard.
    page.until("document.activeElement.matches('.sense-card')", "the first sense has the keyboard").await?;
    page.key("Enter").await?;
    unsaid.extend(step(page, &words, 3).await?);
    take_quoted(page).await?;
    let at_filter = step(page, &words, 4).await?;
    take_quoted(page).await?;
    page.until("document.activeElement.matches('.dialog textarea')", "the test is typed").await?;
    // What is written before the number is in that field.
    unsaid.extend(list(page, UNSAID, "step 4, in its dialog").await?);
    assert!(at_filter.len() <= 1, "{at_filter:?}");
    page.type_text("40").await?;
    page.key("Enter").await?;
    unsaid.extend(step(page, &words, 5).await?);
    take_quoted(page).await?;
    unsaid.extend(step(page, &words, 6).await?);
    page.press("button", &words.fill("Change: {text}", &[("text", "40*")])).await?;
    page.key("Control+a").await?;
    page.type_text("60").await?;
    page.key("Enter").await?;
    unsaid.extend(step(page, &words, 7).await?);
    page.press("button", &words.say("Start")).await?;
    unsaid.extend(step(page, &words, 8).await?);
    let (x, y) = page.boxed("image", &words.say("Red ball")).await?.centre();
    page.drag((x, y), (x + 40.0, y), 8).await?;
    unsaid.extend(step(page, &words, 9).await?);
    page.press("button", &words.say("Stop")).await?;
    page.press("button", &words.say("Done")).await?;
    page.gone("complementary", &words.say("Tour")).await?;
    nothing("words of the tour that are nowhere", &unsaid)?;
    page.no_errors()
}

/// Waits for a step; what it quotes and nothing says.
async fn step(page: &Page, words: &Words, at: u32) -> Outcome<Vec<String>> {
    says(page, &words.fill("Step {at} of {of}", &[("at", &at.to_string()), ("of", "9")])).await?;
    list(page, UNSAID, &format!("step {at}")).await
}

/// Presses the next step that the tour quotes first.
async fn take_quoted(page: &Page) -> Outcome<()> {
    let found = "(() => {
        const quoted = document.querySelector('.tour').innerText.match(/「([^」]+)」/)?.[1];
        return [...document.querySelectorAll('.strip .next')].find(step => step.innerText.trim() === quoted);
    })()";
    page.until(&format!("!!{found}"), "what the tour quotes is a next step").await?;
    page.eval(&format!("{found}.click()")).await.map(drop)
}
