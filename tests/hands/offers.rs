//! Wires and the plus on an edge by every hand: what is offered, where it goes, and what takes it back.

use house::{Outcome, Page};

use crate::rewire::{handle, names};
use crate::steps::{picture, rests, stage, text};

const BALLS: Option<&str> = Some("Track far and close balls");
const BODY: &str = "Head and body tracker, red ball · whole body, actuator stream";

/// The sorted names of all streams and connectors.
async fn sorted(page: &Page) -> Outcome<Vec<String>> {
    let mut all: Vec<String> = names(page).await?.split(" | ").map(str::to_owned).collect();
    all.sort();
    Ok(all)
}

/// Draws a wire out of Far ball to free ground, where the offer opens.
async fn wire_to_ground(page: &Page) -> Outcome<()> {
    page.press("button", "Far ball, stream").await?;
    let far = rests(page, "Far ball, stream").await?;
    page.drag(handle(page).await?, (far.x - 120.0, far.y + 30.0), 8).await?;
    page.find("menu", "After Far ball").await.map(drop)
}

#[tokio::test]
async fn while_an_offer_is_open_a_press_on_a_target_ends_the_wire_there() -> Outcome<()> {
    let stage = stage!("offer and target");
    let program = stage.wire.make("Offers", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, BODY).await?;
    let before = sorted(&aiko).await?;
    wire_to_ground(&aiko).await?;
    aiko.press("button", BODY).await?;
    aiko.find("button", "subscribe, connector from Far ball to Head and body tracker").await?;
    aiko.gone("menu", "After Far ball").await?;
    aiko.key("Control+z").await?;
    aiko.gone("button", "subscribe, connector from Far ball to Head and body tracker").await?;
    assert_eq!(sorted(&aiko).await?, before, "one undo takes the wire back");
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_found_by_its_name_goes_where_the_offer_is() -> Outcome<()> {
    let stage = stage!("find another");
    let program = stage.wire.make("Finding", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    wire_to_ground(&aiko).await?;
    aiko.press("menuitem", "Find another …").await?;
    let finder = aiko.within("dialog", "After Far ball");
    finder.find("searchbox", "Find another …").await?;
    aiko.until("document.activeElement.type === 'search'", "the field has the keyboard").await?;
    assert_eq!(aiko.eval("document.querySelector('.wire') !== null").await?, true, "the wire stays");
    aiko.type_text("eye bright").await?;
    picture(&aiko, "find-another").await?;
    finder.press("button", "Eye brightness*").await?;
    aiko.find("button", "subscribe, connector from Far ball to Eye brightness").await?;
    let far = rests(&aiko, "Far ball, stream").await?;
    let made = rests(&aiko, "Eye brightness, *").await?;
    assert!(made.centre().0 < far.x, "it stands where the wire was dropped: {made:?} {far:?}");
    aiko.press("button", "Distance, stream").await?;
    let at = rests(&aiko, "Distance, stream").await?;
    aiko.move_to((at.centre().0, at.y - 20.0)).await?;
    aiko.move_to((at.centre().0, at.y - 18.0)).await?;
    aiko.press("button", "Insert between Ball and map*").await?;
    aiko.press("menuitem", "Find another …").await?;
    aiko.until("document.activeElement.type === 'search'", "the field has the keyboard").await?;
    aiko.type_text("settle").await?;
    aiko.find("dialog", "After Ball").await?;
    aiko.key("Enter").await?;
    let settles = "[...document.querySelectorAll('[data-chip]')]
        .some(chip => chip.getAttribute('aria-label').startsWith('settle') && chip.getAttribute('aria-label').includes('from Ball to'))";
    aiko.until(settles, "it is in the edge").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn keys_go_from_a_stream_to_the_plus_of_its_edge_and_on() -> Outcome<()> {
    let stage = stage!("plus by keyboard");
    let program = stage.wire.make("Plus", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.key("ArrowDown").await?;
    let on = "document.activeElement.getAttribute('aria-label') === 'Insert between Far ball and subscribe'";
    aiko.until(on, "the keyboard is on the plus").await?;
    picture(&aiko, "plus-by-keyboard").await?;
    aiko.key("ArrowUp").await?;
    aiko.until("document.activeElement.getAttribute('aria-label') === 'Far ball, stream'", "and back").await?;
    aiko.key("ArrowDown").await?;
    aiko.until(on, "the keyboard is on the plus again").await?;
    aiko.key("Enter").await?;
    aiko.until("document.activeElement.getAttribute('role') === 'menuitem'", "the offer has the keyboard").await?;
    aiko.key("Escape").await?;
    aiko.gone("menu", "After Far ball").await?;
    aiko.until("document.activeElement.getAttribute('aria-label') === 'Far ball, stream'", "it goes back").await?;
    aiko.key("ArrowDown").await?;
    aiko.until(on, "the keyboard is on the plus a third time").await?;
    aiko.key("Enter").await?;
    aiko.press("menuitem", "sample every second").await?;
    aiko.find("button", "sample (every 1 second), connector from Far ball to Far ball every second").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn fingers_draw_a_wire_and_press_the_plus_beside_a_chip() -> Outcome<()> {
    let stage = stage!("wires by touch");
    let program = stage.wire.make("Fingers", BALLS).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.tap("button", "Far ball, stream").await?;
    let from = handle(&aiko).await?;
    let to = rests(&aiko, BODY).await?.centre();
    aiko.touch_drag(from, to, 8).await?;
    aiko.find("button", "subscribe, connector from Far ball to Head and body tracker").await?;
    // Where the wire ends is selected; the sentences above grow, and the graph goes down with them.
    aiko.until(
        "document.querySelector('[data-node][aria-label^=\"Head and body\"]')?.getAttribute('aria-pressed') === 'true'",
        "where the wire ends is selected",
    )
    .await?;
    rests(&aiko, "subscribe, connector from Far ball to Head tracker").await?;
    aiko.tap("button", "subscribe, connector from Far ball to Head tracker").await?;
    picture(&aiko, "plus-by-touch").await?;
    aiko.tap("button", "Insert between Far ball and subscribe").await?;
    aiko.tap("menuitem", "sample every second").await?;
    aiko.find("button", "subscribe, connector from Far ball every second to Head tracker").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_wire_feeds_a_stream_again_and_a_connector_takes_one_more() -> Outcome<()> {
    let stage = stage!("wires to streams and connectors");
    let program = stage.wire.make("Feeding", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Close ball, stream").await?;
    let before = sorted(&aiko).await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.drag(handle(&aiko).await?, rests(&aiko, "Close ball, stream").await?.centre(), 8).await?;
    aiko.find("button", "merge, connector from Close ball 2 and Far ball to Close ball").await?;
    aiko.press("button", "Ball, sensor stream").await?;
    let merge = rests(&aiko, "merge, connector from Close ball 2 and Far ball to Close ball").await?;
    aiko.drag(handle(&aiko).await?, merge.centre(), 8).await?;
    aiko.until(
        "[...document.querySelectorAll('[data-chip]')].some(chip => /^merge, connector from Close ball 2 and Far ball and Ball to/.test(chip.getAttribute('aria-label')))",
        "the connector takes one more",
    )
    .await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "merge, connector from Close ball 2 and Far ball to Close ball").await?;
    aiko.key("Control+z").await?;
    aiko.gone("button", "Close ball 2, stream").await?;
    assert_eq!(sorted(&aiko).await?, before);
    aiko.no_errors()
}

#[tokio::test]
async fn escape_lets_a_wire_go_that_hangs_on_the_hand() -> Outcome<()> {
    let stage = stage!("escape while dragging");
    let program = stage.wire.make("Escape", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, BODY).await?;
    let before = sorted(&aiko).await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.hold(handle(&aiko).await?).await?;
    let to = rests(&aiko, BODY).await?.centre();
    aiko.pull((to.0 - 30.0, to.1 - 60.0)).await?;
    aiko.pull(to).await?;
    aiko.until("document.querySelector('.wiring') !== null", "there is a wire").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.wiring') === null", "it is gone").await?;
    aiko.release(to).await?;
    assert_eq!(sorted(&aiko).await?, before, "nothing came of it");
    aiko.no_errors()
}

#[tokio::test]
async fn the_stream_that_has_the_keyboard_shows_its_handle() -> Outcome<()> {
    let stage = stage!("handle on focus");
    let program = stage.wire.make("Focus", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    assert_eq!(aiko.eval("document.querySelector('[data-handle]') === null").await?, true);
    aiko.eval("document.querySelector('#stage .stream[tabindex=\"0\"]').focus(), 0").await?;
    aiko.until("document.querySelector('[data-handle]') !== null", "there is a handle").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_panel_at_the_right_offers_to_go_on_without_a_stream_too() -> Outcome<()> {
    let stage = stage!("healing in the panel");
    let program = stage.wire.make("Panel", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.press("button", "Distance, stream").await?;
    aiko.within("region", "What is selected").press("button", "Remove").await?;
    picture(&aiko, "remove-in-panel").await?;
    aiko.press("menuitem", "Remove it, and go on from Ball").await?;
    aiko.find("button", "filter (ball < 0.5), connector from Ball to Close ball").await?;
    aiko.gone("button", "Distance, stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn keys_hear_how_many_places_a_wire_has_and_which_is_meant() -> Outcome<()> {
    let stage = stage!("what a wire says");
    let program = stage.wire.make("Saying", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.key("c").await?;
    let said = "document.querySelector('#stage > [role=status]').textContent";
    aiko.until(&format!("/^Connect Far ball: [0-9]+ places\\./.test({said})"), "how many places there are").await?;
    aiko.key("ArrowDown").await?;
    aiko.until(&format!("/^Connect Far ball: [0-9]+ places\\. .+, 1 of [0-9]+$/.test({said})"), "and the first")
        .await?;
    aiko.key("ArrowDown").await?;
    aiko.until(&format!("/, 2 of [0-9]+$/.test({said}) && !{said}.startsWith('Connect')"), "then only the next")
        .await?;
    aiko.key("Escape").await?;
    assert_eq!(text(&aiko.eval(said).await?), "");
    aiko.no_errors()
}
