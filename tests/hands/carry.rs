//! Carrying things from the left list to the graph: a sense to free ground, an action or a helper to a stream.

use house::{Outcome, Page};
use serde_json::json;

use crate::steps::{picture, rests, stage};

const BALLS: Option<&str> = Some("Track far and close balls");
const FAR: &str = "Far ball, stream";

async fn streams(page: &Page) -> Outcome<u64> {
    Ok(page.eval("document.querySelectorAll('[data-node]').length").await?.as_u64().unwrap_or_default())
}

/// Looks for something in the list, so that it is in view, and says where it is. What comes later has to be here to carry it.
async fn listed(page: &Page, word: &str, name: &str) -> Outcome<(f64, f64)> {
    page.until("document.querySelector('.told .sentence') !== null", "what comes later is here").await?;
    page.fill("searchbox", "Find or add", word).await?;
    Ok(rests(page, name).await?.centre())
}

/// A place of the paper where nothing stands.
async fn free(page: &Page) -> Outcome<(f64, f64)> {
    let far = rests(page, FAR).await?;
    Ok((far.x - 60.0, far.y - 90.0))
}

/// A point a part of the way from one to another.
fn between(from: (f64, f64), to: (f64, f64), part: f64) -> (f64, f64) {
    (from.0 + (to.0 - from.0) * part, from.1 + (to.1 - from.1) * part)
}

/// Holds what is at a point with the mouse and pulls it to another, still held.
async fn pull(page: &Page, from: (f64, f64), to: (f64, f64)) -> Outcome<()> {
    page.hold(from).await?;
    for step in 1..=6 {
        page.pull(between(from, to, f64::from(step) / 6.0)).await?;
    }
    Ok(())
}

#[tokio::test]
async fn an_action_is_led_from_the_stream_it_is_dropped_on() -> Outcome<()> {
    let stage = stage!("carrying an action");
    let program = stage.wire.make("Carry", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let ben = stage.person("ben", &program).await?;
    let to = rests(&aiko, FAR).await?.centre();
    let before = streams(&aiko).await?;
    let from = listed(&aiko, "text", "Lead the selected stream to Say a text").await?;
    pull(&aiko, from, to).await?;
    aiko.until("document.querySelectorAll('.stream.target').length === 4", "all but actions are targets").await?;
    aiko.until("document.querySelector('.stream.over') !== null", "it is over one of them").await?;
    picture(&aiko, "carry-action").await?;
    aiko.release(to).await?;
    aiko.find("button", "subscribe, connector from Far ball to Say a text").await?;
    ben.find("button", "subscribe, connector from Far ball to Say a text").await?;
    aiko.until("document.querySelector('.carried') === null", "nothing hangs on the pointer any more").await?;
    assert_eq!(aiko.eval("document.querySelector('[role=dialog]')").await?, json!(null), "it was not pressed");
    aiko.key("Control+z").await?;
    aiko.gone("button", "subscribe, connector from Far ball to Say a text").await?;
    assert_eq!(streams(&aiko).await?, before);
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn escape_and_a_drop_elsewhere_put_it_back_and_a_press_is_a_press() -> Outcome<()> {
    let stage = stage!("putting back");
    let program = stage.wire.make("Carry", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let far = rests(&aiko, FAR).await?.centre();
    let (before, ground) = (streams(&aiko).await?, free(&aiko).await?);
    let action = listed(&aiko, "text", "Lead the selected stream to Say a text").await?;
    pull(&aiko, action, far).await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.carried, .wiring') === null", "Escape puts it back").await?;
    aiko.release(far).await?;
    pull(&aiko, action, ground).await?;
    aiko.release(ground).await?;
    pull(&aiko, action, (action.0 + 30.0, action.1)).await?;
    aiko.release(action).await?;
    let sense = listed(&aiko, "face", "Add Face").await?;
    pull(&aiko, sense, ground).await?;
    aiko.until("document.querySelector('.carried.fits') !== null", "it fits there and hangs on the pointer").await?;
    picture(&aiko, "carry-sense").await?;
    aiko.pull(far).await?;
    aiko.release(far).await?;
    pull(&aiko, sense, (sense.0 + 20.0, sense.1)).await?;
    aiko.release(sense).await?;
    aiko.settled().await?;
    assert_eq!(streams(&aiko).await?, before);
    assert_eq!(aiko.eval("document.querySelector('.carried')").await?, json!(null));
    aiko.press_at(sense).await?;
    aiko.find("button", "Face, sensor stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_pen_carries_at_once_and_a_finger_after_it_rested() -> Outcome<()> {
    let stage = stage!("carrying by pen and finger");
    let program = stage.wire.make("Carry", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.size(1440, 900, true).await?;
    let to = free(&aiko).await?;
    let from = listed(&aiko, "face", "Add Face").await?;
    aiko.pen_drag(from, to, 6).await?;
    let made = rests(&aiko, "Face, sensor stream").await?.centre();
    assert!((made.0 - to.0).abs() < 14.0 && (made.1 - to.1).abs() < 14.0, "{made:?} {to:?}");
    aiko.key("Control+z").await?;
    aiko.gone("button", "Face, sensor stream").await?;

    let touch = |kind: &'static str, at: Option<(f64, f64)>| {
        let fingers: Vec<_> = at.into_iter().map(|(x, y)| json!({ "x": x, "y": y, "id": 0 })).collect();
        aiko.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": fingers }))
    };
    touch("touchStart", Some(from)).await?;
    aiko.until("document.querySelector('.carried') !== null", "a finger that rests holds it").await?;
    for step in 1..=6 {
        touch("touchMove", Some(between(from, to, f64::from(step) / 6.0))).await?;
    }
    touch("touchEnd", None).await?;
    aiko.find("button", "Face, sensor stream").await?;

    // A finger that moves at once scrolls: nothing is carried.
    let before = streams(&aiko).await?;
    aiko.touch_drag(from, to, 6).await?;
    aiko.settled().await?;
    assert_eq!(streams(&aiko).await?, before);
    assert_eq!(aiko.eval("document.querySelector('.carried')").await?, json!(null));
    aiko.no_errors()
}
