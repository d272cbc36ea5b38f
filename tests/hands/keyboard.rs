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
        if key == "ArrowDown" {
            aiko.key(key).await?;
            aiko.until("document.activeElement.matches('.plus')", "the keyboard is on an edge").await?;
        }
        aiko.key(key).await?;
        comes_to(&aiko, stream).await?;
    }
    aiko.key("Enter").await?;
    aiko.until("document.querySelector('dialog[open], [role=dialog]') !== null", "a dialog opens").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('dialog[open], [role=dialog]') === null", "the dialog is closed").await?;
    comes_to(&aiko, "Close ball, stream").await?;

    aiko.key("Delete").await?;
    aiko.until("document.activeElement.innerText === 'Remove it, and go on from Distance'", "it asks how").await?;
    aiko.key("ArrowDown").await?;
    aiko.key("Enter").await?;
    aiko.gone("button", "Close ball, stream").await?;
    comes_to(&aiko, "Distance, stream").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "Close ball, stream").await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    aiko.no_errors()
}

/// Presses a key on a stream and goes to the field that finds things at once, both before the page draws again.
async fn hurries(page: &Page, key: &str, stream: &str) -> Outcome<()> {
    page.press("button", stream).await?;
    comes_to(page, stream).await?;
    let now = format!(
        "document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}', bubbles: true }})), \
         document.querySelector('#find').focus(), 0"
    );
    page.eval(&now).await?;
    // Timers of a page come in their order: what was to come in some 60 ms has come after 200.
    page.eval("new Promise(done => setTimeout(() => done(0), 200))").await.map(drop)
}

#[tokio::test]
async fn who_goes_elsewhere_at_once_keeps_the_keyboard() -> Outcome<()> {
    let stage = stage!("hurry");
    let program = stage.wire.make("Hurry", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    for key in ["Escape", "Delete"] {
        hurries(&aiko, key, "Close ball, stream").await?;
        let there = aiko.eval("document.activeElement.id === 'find' && !document.querySelector('[role=menu]')").await?;
        assert_eq!(there, true, "after {key}");
    }
    aiko.type_text("far").await?;
    aiko.find("button", "Go to Far ball").await?;
    aiko.press("button", "Close ball, stream").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed").await?;
    aiko.key("Control+a").await?;
    aiko.type_text("Near ball").await?;
    aiko.press("searchbox", "Find or add").await?;
    aiko.find("button", "Near ball, stream").await?;
    aiko.eval("new Promise(done => setTimeout(() => done(0), 200))").await?;
    assert_eq!(aiko.eval("document.activeElement.id === 'find'").await?, true, "a new name is saved on the way");
    aiko.no_errors()
}

#[tokio::test]
async fn a_new_name_is_typed_where_the_stream_stands() -> Outcome<()> {
    let stage = stage!("rename");
    let program = stage.wire.make("Names", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Distance, stream").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed").await?;
    aiko.type_text("How far").await?;
    aiko.key("Enter").await?;
    comes_to(&aiko, "How far, stream").await?;
    aiko.find("button", "filter (howFar < 0.5), connector from How far to Close ball").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed again").await?;
    aiko.type_text("Nothing").await?;
    aiko.key("Escape").await?;
    comes_to(&aiko, "How far, stream").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "Distance, stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn commands_are_found_and_done_by_keys_alone() -> Outcome<()> {
    let stage = stage!("commands");
    let program = stage.wire.make("Commands", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.find("button", "Close ball, stream").await?;
    aiko.key("Control+k").await?;
    aiko.until(
        "document.activeElement.type === 'search' && !!document.activeElement.closest('[role=dialog]')",
        "it asks what",
    )
    .await?;
    aiko.type_text("close ball").await?;
    aiko.key("Enter").await?;
    comes_to(&aiko, "Close ball, stream").await?;
    aiko.key("Control+k").await?;
    aiko.until(
        "document.activeElement.type === 'search' && !!document.activeElement.closest('[role=dialog]')",
        "it asks again",
    )
    .await?;
    aiko.type_text("select all").await?;
    aiko.key("Enter").await?;
    aiko.find("toolbar", "11 selected").await?;
    aiko.key("Escape").await?;
    aiko.key("Control+f").await?;
    aiko.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
    aiko.type_text("far").await?;
    aiko.find("button", "Go to Far ball").await?;
    aiko.no_errors()
}

/// Keeps what the page would do within a tenth of a second until it is `let_go`, which says how much that was.
const SLOW_CLOCK: &str = "{
    const soon = [], real = window.setTimeout.bind(window);
    window.setTimeout = (what, ms, ...with_it) => ms > 0 && ms < 100 ? soon.push(what) : real(what, ms, ...with_it);
    window.let_go = () => { const now = soon.splice(0); now.forEach(what => what()); return now.length; };
} 0";

/// Gives a button with this text the keyboard; false while there is none.
fn keyboard_on(selector: &str, text: &str) -> String {
    format!(
        "(() => {{ const button = [...document.querySelectorAll('{selector}')].find(at => at.innerText.trim() === '{text}');
            button?.focus(); return !!button && document.activeElement === button; }})()"
    )
}

#[tokio::test]
async fn who_is_quicker_than_the_page_keeps_the_keyboard_where_they_went() -> Outcome<()> {
    let stage = stage!("keyboard");
    let (first, second) = (stage.wire.make("First", None).await?, stage.wire.make("Second", None).await?);
    let aiko = stage.person("aiko", &first).await?;
    aiko.until("document.querySelector('.sense-card') !== null", "the first program is open").await?;
    aiko.eval(SLOW_CLOCK).await?;
    aiko.eval(&format!("location.hash = '#/b/{second}'; 0")).await?;
    aiko.until("document.title.includes('Second')", "the second program is open").await?;
    aiko.until(&keyboard_on(".sense-card", "Red ball"), "the keyboard is on the first sense").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Red ball, sensor stream").await?;
    assert_ne!(aiko.eval("let_go()").await?, 0, "the keyboard is on its way to the first stream");
    aiko.until(&keyboard_on(".strip button", "Distance in cm"), "the keyboard is on a next step").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "Distance, stream").await?;
    while aiko.eval("let_go()").await? != 0 {}
    comes_to(&aiko, "Distance, stream").await?;
    aiko.no_errors()
}
