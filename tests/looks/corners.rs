//! What no screen of the walk shows: small dialogs, menus, the tour, and what stands on the canvas for a moment.

use crate::look::{DESKTOP, DRAWN, WINDOWS, Window, look_in, set};
use crate::screens::{Stage, command, leave, nothing, open_template, says, selected};
use crate::words::Words;
use house::{Outcome, Page, skip};
use std::cell::RefCell;

/// What dialogs are called here, and in the list of commands in English.
const DIALOGS: [(&str, &str); 9] = [
    ("keys", "keys and gestures"),
    ("problems", "problems"),
    ("rename-program", "rename the program"),
    ("remove-program", "remove program"),
    ("add-sensor", "add sensor"),
    ("new-helper", "add a helper"),
    ("helpers", "edit helper"),
    ("your-name", "your name"),
    ("people", "people here"),
];

/// What is typed where things are found, with a word that nobody knows.
const TYPED: [(&str, &str); 2] =
    [("en", "When the head is toched, the eyes turn green."), ("ja", "頭をむぎむぎしたとき、目が緑に光ります。")];

#[tokio::test]
async fn axe_finds_nothing_in_small_dialogs() -> Outcome<()> {
    skip::unless!(ready("axe on small dialogs"));
    looked_at("findings about small dialogs", async |page, words, found| {
        dialogs(page, words, async |state: &str, windows: &[Window]| find(page, state, windows, found).await).await
    })
    .await
}

#[tokio::test]
async fn axe_finds_nothing_on_what_stands_on_the_canvas_for_a_moment() -> Outcome<()> {
    skip::unless!(ready("axe on menus and flyouts"));
    looked_at("findings about menus and flyouts", async |page, words, found| {
        moments(page, words, async |state: &str, windows: &[Window]| find(page, state, windows, found).await).await
    })
    .await
}

/// What was found so far.
type Found = RefCell<Vec<String>>;

/// Fails with everything that is found on a walk, and with what ended it.
async fn looked_at(what: &str, walk: impl AsyncFn(&Page, &Words, &Found) -> Outcome<()>) -> Outcome<()> {
    let words = Words::english();
    let stage = Stage::set_in(&words).await?;
    let found = Found::default();
    let walked = walk(&stage.page, &words, &found).await;
    let mut found = found.into_inner();
    found.extend(walked.err().map(|trouble| trouble.to_string()));
    nothing(what, &found)?;
    stage.page.no_errors()
}

/// Adds what is found in a state, in these windows.
async fn find(page: &Page, state: &str, windows: &[Window], found: &Found) -> Outcome<()> {
    let more = look_in(page, state, windows).await?;
    found.borrow_mut().extend(more);
    Ok(())
}

/// Visits the small dialogs, and the tour; whoever visits leaves the page on a desktop.
pub(crate) async fn dialogs(
    page: &Page,
    words: &Words,
    visit: impl AsyncFn(&str, &[Window]) -> Outcome<()>,
) -> Outcome<()> {
    open_template(page, words).await?;
    // Leads nowhere, so that there is a problem.
    page.press("button", &words.fill("Add {name}", &[("name", &words.say("Face"))])).await?;
    selected(page, words, &words.say("Face")).await?;
    says(page, &words.say("Send a value")).await?;
    page.press("button", &words.say("Send a value")).await?;
    opened(page).await?;
    visit("send-a-value", &WINDOWS).await?;
    leave(page).await?;
    for (state, english) in DIALOGS {
        command(page, english).await?;
        opened(page).await?;
        visit(state, &WINDOWS).await?;
        leave(page).await?;
    }
    command(page, "add sensor").await?;
    opened(page).await?;
    page.eval("document.querySelector('.in-dialog input').focus()").await?;
    page.type_text(typed(words)).await?;
    page.until("!!document.querySelector('.dialog .typed .doubt')", "a word is in doubt").await?;
    visit("typed-in-dialog", &WINDOWS).await?;
    // The first Escape takes back what is typed.
    escape(page).await?;
    leave(page).await?;
    tiles(page, words, &visit).await?;
    robots(page, words, &visit).await?;
    tour(page, words, &visit).await
}

/// The tiles of the operator's page, and a tile of each kind.
async fn tiles(page: &Page, words: &Words, visit: &impl AsyncFn(&str, &[Window]) -> Outcome<()>) -> Outcome<()> {
    command(page, "tiles of the operator").await?;
    opened(page).await?;
    visit("tiles", &WINDOWS).await?;
    page.eval("document.getElementById('tile-9').click()").await?;
    page.until("!!document.querySelector('.tile-top')", "its form is open").await?;
    visit("tile-by-hand", &WINDOWS).await?;
    for (state, kind) in [("tile-pretends", "pretends a sense"), ("tile-marks", "marks the moment")] {
        page.press("radio", &words.say(kind)).await?;
        visit(state, &WINDOWS).await?;
    }
    // The first Escape goes back to all tiles.
    escape(page).await?;
    page.until("!!document.querySelector('.tile-grid')", "all tiles are there").await?;
    leave(page).await
}

/// The dialogs about robots.
async fn robots(page: &Page, words: &Words, visit: &impl AsyncFn(&str, &[Window]) -> Outcome<()>) -> Outcome<()> {
    command(page, "add a simulated robot").await?;
    opened(page).await?;
    page.until("document.activeElement.matches('[role=dialog] .dialog-body input')", "its field has the keyboard")
        .await?;
    page.key("Enter").await?;
    page.until("!document.querySelector('[role=dialog]')", "the dialog is closed").await?;
    for (state, item) in
        [("add-real-robot", "Add a NAO or Pepper"), ("rename-robot", "Rename"), ("remove-robot", "Remove “{name}”")]
    {
        page.press("button", &words.fill("Robot: {name}", &[("name", "*")])).await?;
        let begins = words.say(item).split('{').next().unwrap_or_default().to_owned();
        let quoted = serde_json::Value::from(begins);
        let found = format!(
            "[...document.querySelectorAll('.robot-picker [role=menuitem]')].find(item => item.innerText.trim().startsWith({quoted}))"
        );
        page.until(&format!("!!{found}"), "it is in the menu").await?;
        page.eval(&format!("{found}.click()")).await?;
        opened(page).await?;
        visit(state, &WINDOWS).await?;
        leave(page).await?;
    }
    Ok(())
}

/// The tour, where it points at other things, and its end.
async fn tour(page: &Page, words: &Words, visit: &impl AsyncFn(&str, &[Window]) -> Outcome<()>) -> Outcome<()> {
    command(page, "take the tour").await?;
    page.find("complementary", &words.say("Tour")).await?;
    let mut at = String::new();
    while at != "end" {
        // Nothing runs, so that the step about Stop is soon done by itself.
        if !at.is_empty() && at != "9" {
            // The card looks a few times a second where it shall stand.
            let spot = "JSON.stringify(document.querySelector('.tour').getBoundingClientRect())";
            page.steady(spot, 30, "the tour's card stands").await?;
            page.press("button", &words.say("Skip")).await?;
        }
        let step = "document.querySelector('.tour p.faint')?.innerText.match(/[0-9]+/)?.[0] ?? 'end'";
        let other = page.until(&format!("({step}) !== '{at}' && ({step})"), "the tour is at another step").await?;
        at = other.as_str().unwrap_or_default().to_owned();
        if ["4", "6", "8", "end"].contains(&at.as_str()) {
            visit(&format!("tour-{at}"), &WINDOWS).await?;
        }
    }
    page.press("button", &words.say("Done")).await
}

/// Visits what stands on the canvas for a moment; whoever visits leaves the page on a desktop.
pub(crate) async fn moments(
    page: &Page,
    words: &Words,
    visit: impl AsyncFn(&str, &[Window]) -> Outcome<()>,
) -> Outcome<()> {
    open_template(page, words).await?;
    selected(page, words, "Distance").await?;
    page.until("!!document.querySelector('.strip')", "the strip is there").await?;
    visit("strip", &WINDOWS).await?;
    press_on(page, ".chip[data-tests]").await?;
    page.until("!!document.querySelector('.flyout .control, .flyout input')", "the flyout is there").await?;
    visit("flyout", &WINDOWS).await?;
    for window in &DRAWN {
        set(page, window).await?;
        escape(page).await?;
        ask_menu(page, window, &words.stream("Distance")).await?;
        visit("context-menu", std::slice::from_ref(window)).await?;
        escape(page).await?;
        set(page, window).await?;
        page.until("!!document.querySelector('button.plus')", "there is a plus").await?;
        page.eval("document.querySelector('button.plus').click()").await?;
        page.until("!!document.querySelector('.offer [role=menuitem]')", "the offer is there").await?;
        visit("offer", std::slice::from_ref(window)).await?;
        escape(page).await?;
    }
    page.eval("document.querySelector('#stage .stream.ordinary').focus()").await?;
    page.key("c").await?;
    page.until("!!document.querySelector('.edges.wire')", "there is a wire").await?;
    visit("wire", &[DESKTOP]).await?;
    escape(page).await?;
    command(page, "select all").await?;
    page.until("!!document.querySelector('.strip.several')", "several are selected").await?;
    visit("several", &DRAWN).await?;
    escape(page).await?;
    page.key("Control+f").await?;
    page.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
    page.type_text(typed(words)).await?;
    page.until("!!document.querySelector('.typed .doubt')", "a word is in doubt").await?;
    visit("typed", &[DESKTOP]).await
}

/// Opens the menu of a stream, which selects it: with the right button, or with a finger that rests on it.
async fn ask_menu(page: &Page, (_, _, _, touch): &Window, stream: &str) -> Outcome<()> {
    if *touch {
        page.touch_down(page.boxed("button", stream).await?.centre()).await?;
    } else {
        page.press_right("button", stream).await?;
    }
    page.until("!!document.querySelector('.context [role=menuitem]')", "the menu is there").await?;
    if *touch { page.touch_up().await } else { Ok(()) }
}

fn typed(words: &Words) -> &'static str {
    TYPED.iter().find(|(code, _)| *code == words.code()).map_or("", |(_, typed)| typed)
}

/// Waits until a dialog is open and filled.
async fn opened(page: &Page) -> Outcome<()> {
    page.until("!!document.querySelector('[role=dialog] :is(.dialog-body, .commands-list)')", "a dialog is open")
        .await
        .map(drop)
}

/// Clicks the middle of the first that the selector finds.
async fn press_on(page: &Page, selector: &str) -> Outcome<()> {
    let middle = format!(
        "(() => {{ const box = document.querySelector('{selector}').getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]; }})()"
    );
    let at = page.eval(&middle).await?;
    let number = |at: &serde_json::Value| at.as_f64().unwrap_or_default();
    page.press_at((number(&at[0]), number(&at[1]))).await
}

/// Escape, which something open uses: only one that nothing used is the first of the two of Stop.
async fn escape(page: &Page) -> Outcome<()> {
    page.key("Escape").await?;
    page.settled().await
}
