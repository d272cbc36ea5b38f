//! Tiles of the operator's page that ask first, and marks that are held for their verdict: with a finger and with keys.

use house::{Outcome, Page, WallClock, skip};

use crate::operate::{DOTS, of_recording, operates_tiles, shows, starts};
use crate::steps::*;

/// The operator's page with a program that has tiles of its own, while it runs.
async fn runs(stage: &Stage, page: &Page) -> Outcome<()> {
    operates_tiles(stage, page).await?;
    starts(page, "P-07").await
}

async fn is(page: &Page, label: &str, state: &str) -> Outcome<()> {
    page.until(&format!("{} === '{state}'", shows(label)), &format!("“{label}” is {state}")).await.map(drop)
}

#[tokio::test]
async fn a_tile_that_asks_does_it_at_the_second_press_and_never_at_a_double_tap_or_in_silence() -> Outcome<()> {
    skip::unless!(ready("journey: a tile that asks first"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    let clock = WallClock::install(&aiko).await?;
    runs(&stage, &aiko).await?;
    says(&aiko, "asks first").await?;
    clock.hold().await?;
    clock.forward(1_000).await?;
    aiko.tap("button", "Wave*").await?;
    is(&aiko, "Wave", "asks").await?;
    says(&aiko, "asks: now?").await?;
    aiko.tap("button", "Wave*").await?;
    clock.forward(399).await?;
    aiko.tap("button", "Wave*").await?;
    is(&aiko, "Wave", "asks").await?;
    clock.forward(1).await?;
    aiko.tap("button", "Wave*").await?;
    is(&aiko, "Wave", "going").await?;
    aiko.until(&format!("{DOTS} === 1"), "it was done once").await?;

    // By keys: silence is no, and so is 0.
    clock.forward(5_000).await?;
    is(&aiko, "Wave", "ready").await?;
    aiko.key("4").await?;
    is(&aiko, "Wave", "asks").await?;
    clock.forward(2_000).await?;
    is(&aiko, "Wave", "ready").await?;
    aiko.key("4").await?;
    is(&aiko, "Wave", "asks").await?;
    aiko.key("0").await?;
    is(&aiko, "Wave", "ready").await?;
    // ✕ is no.
    clock.forward(1_000).await?;
    aiko.key("4").await?;
    aiko.tap("button", "Not now: Wave").await?;
    is(&aiko, "Wave", "ready").await?;
    clock.forward(1_000).await?;
    aiko.key("4").await?;
    is(&aiko, "Wave", "asks").await?;
    clock.forward(500).await?;
    aiko.key("4").await?;
    aiko.until(&format!("{DOTS} === 2"), "a second press of the key is yes").await?;
    // Another tile does it at once.
    aiko.key("1").await?;
    aiko.until(&format!("{DOTS} === 3"), "the others do not ask").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_mark_that_is_held_takes_its_verdict_and_keeps_the_moment_of_its_press() -> Outcome<()> {
    skip::unless!(ready("journey: the verdict of a mark"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    runs(&stage, &aiko).await?;
    says(&aiko, "Hold a mark to say if it was good.").await?;
    // A short touch only marks.
    aiko.tap("button", "laughs*").await?;
    aiko.until("document.querySelectorAll('.op-flag').length === 1", "it is marked").await?;
    let at = aiko.boxed("button", "looks away*").await?;
    aiko.touch_down((at.x + at.width / 2.0, at.y + at.height / 2.0)).await?;
    aiko.find("group", "looks away: How was it?").await?;
    aiko.touch_up().await?;
    aiko.tap("button", "not good").await?;
    aiko.gone("group", "looks away: How was it?").await?;
    says(&aiko, "not good").await?;
    // The span goes on: what was held neither ended it nor began a second one.
    aiko.until("document.querySelectorAll('.op-flag').length === 2", "one more mark").await?;
    assert_eq!(aiko.eval(&shows("looks away")).await?, "on");

    // By keys: M marks as it goes down, and asks as it stays there.
    let key = |what: &str| {
        format!("dispatchEvent(new KeyboardEvent('{what}', {{ key: 'm', code: 'KeyM', cancelable: true }})), 0")
    };
    aiko.eval(&key("keydown")).await?;
    aiko.find("group", "Mark: How was it?").await?;
    aiko.eval(&key("keyup")).await?;
    aiko.until("document.activeElement.closest('.op-verdict') !== null", "the keyboard is there").await?;
    aiko.key("Tab").await?;
    aiko.key("Tab").await?;
    aiko.key("Enter").await?;
    aiko.until("document.activeElement.id === 'op-note'", "what it should have done is written down").await?;
    aiko.type_text("wave back").await?;
    aiko.key("Enter").await?;
    says(&aiko, "it should have").await?;
    silent(&aiko, "waits here").await?;
    stop(&aiko).await?;
    says(&aiko, "Ready to start").await?;
    assert_eq!(of_recording(&stage, "sort").await?, ["note", "bad", "now"]);
    assert_eq!(of_recording(&stage, "note").await?, ["", "", "wave back"]);
    calm(&aiko)
}
