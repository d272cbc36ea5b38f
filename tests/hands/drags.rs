//! Fingers and pens on the canvas.

use house::Outcome;
use serde_json::json;

use crate::steps::{rests, stage, view};

const BALL: &str = "Ball, sensor stream";

#[tokio::test]
async fn one_finger_drags_a_stream_and_another_person_sees_it() -> Outcome<()> {
    let stage = stage!("one finger");
    let program = stage.wire.make("Fingers", Some("Track far and close balls")).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    let ben = stage.person("ben", &program).await?;
    let (from, seen) = (rests(&aiko, BALL).await?, rests(&ben, BALL).await?);
    let zoom = view(&aiko).await?.2;
    let (x, y) = from.centre();
    aiko.touch_drag((x, y), (x + 100.0 * zoom, y + 40.0 * zoom), 8).await?;
    let to = rests(&aiko, BALL).await?;
    assert!((to.x - from.x - 100.0 * zoom).abs() < 12.0, "{from:?} {to:?}");
    let moved = format!(
        "Math.abs(document.querySelector('[aria-label^=\"Ball,\"]').getBoundingClientRect().x - {} - 100) < 12",
        seen.x
    );
    ben.until(&moved, "the other person sees the ball moved").await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn two_fingers_zoom_and_pan_the_canvas_and_not_the_page() -> Outcome<()> {
    let stage = stage!("two fingers");
    let program = stage.wire.make("Fingers", Some("Track far and close balls")).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    rests(&aiko, BALL).await?;
    let before = view(&aiko).await?;
    aiko.pinch((400.0, 500.0), 100.0, 180.0).await?;
    let wider = view(&aiko).await?;
    assert!((wider.2 / before.2 - 1.8).abs() < 0.05, "{before:?} {wider:?}");
    two_finger_pan(&aiko, (400.0, 500.0), (60.0, 30.0)).await?;
    let panned = view(&aiko).await?;
    let near = |one: f64, other: f64| (one - other).abs() < 4.0;
    assert!(near(panned.0 - wider.0, 60.0) && near(panned.1 - wider.1, 30.0), "{wider:?} {panned:?}");
    assert!((panned.2 / wider.2 - 1.0).abs() < 0.01);
    let page = "[visualViewport.scale, scrollX, scrollY, document.scrollingElement.scrollWidth - innerWidth].join()";
    assert_eq!(aiko.eval(page).await?, "1,0,0,0");
    aiko.no_errors()
}

async fn two_finger_pan(page: &house::Page, at: (f64, f64), by: (f64, f64)) -> Outcome<()> {
    const STEPS: u32 = 6;
    for step in 0..=STEPS {
        let part = f64::from(step) / f64::from(STEPS);
        let (x, y) = (at.0 + by.0 * part, at.1 + by.1 * part);
        let fingers = json!([{ "x": x - 60.0, "y": y, "id": 0 }, { "x": x + 60.0, "y": y, "id": 1 }]);
        let kind = if step == 0 { "touchStart" } else { "touchMove" };
        page.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": fingers })).await?;
    }
    page.call("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] })).await.map(drop)
}

#[tokio::test]
async fn a_long_press_opens_no_menu_of_the_browser() -> Outcome<()> {
    let stage = stage!("a long press");
    let program = stage.wire.make("Fingers", Some("Track far and close balls")).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    let (x, y) = rests(&aiko, BALL).await?.centre();
    aiko.eval(
        "globalThis.menus = [];
        addEventListener('contextmenu', event => menus.push(event.defaultPrevented)); 0",
    )
    .await?;
    aiko.touch_long((x, y)).await?;
    aiko.call("Input.dispatchMouseEvent", json!({ "type": "mousePressed", "x": x, "y": y, "button": "right" })).await?;
    aiko.call("Input.dispatchMouseEvent", json!({ "type": "mouseReleased", "x": x, "y": y, "button": "right" }))
        .await?;
    aiko.until("menus.length > 0", "a menu was asked for").await?;
    assert_eq!(aiko.eval("menus.every(Boolean) && String(getSelection()) === ''").await?, true);
    aiko.no_errors()
}

#[tokio::test]
async fn a_pen_drags_and_the_wheel_zooms_at_the_pointer() -> Outcome<()> {
    let stage = stage!("pen and wheel");
    let program = stage.wire.make("Pens", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    let from = rests(&aiko, BALL).await?;
    let (x, y) = from.centre();
    let zoom = view(&aiko).await?.2;
    aiko.pen_drag((x, y), (x - 60.0 * zoom, y), 6).await?;
    let to = rests(&aiko, BALL).await?;
    assert!((to.x - from.x + 60.0 * zoom).abs() < 12.0, "{from:?} {to:?}");

    let (x, y) = to.centre();
    aiko.wheel_zoom((x, y), 300.0).await?;
    let smaller = rests(&aiko, BALL).await?;
    assert!(view(&aiko).await?.2 < zoom * 0.8);
    let (nx, ny) = smaller.centre();
    assert!((nx - x).abs() < 3.0 && (ny - y).abs() < 3.0, "the canvas stays under the pointer: {to:?} {smaller:?}");
    assert_eq!(aiko.eval("visualViewport.scale").await?, 1);
    aiko.no_errors()
}
