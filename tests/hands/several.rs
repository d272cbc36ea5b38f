//! Several things at once: chosen with a lasso or keys, copied, doubled, lined up, removed.

use house::{Outcome, Page};
use serde_json::json;

use crate::steps::{picture, rests, stage, text};

const BALLS: Option<&str> = Some("Track far and close balls");

pub(crate) async fn are(page: &Page, count: u64) -> Outcome<()> {
    let js = format!("document.querySelectorAll('[data-node]').length === {count}");
    page.until(&js, &format!("there are {count} streams")).await.map(drop)
}

/// Draws a lasso with the Shift key from a point to another.
pub(crate) async fn lasso(page: &Page, from: (f64, f64), to: (f64, f64)) -> Outcome<()> {
    let event = |kind: &str, (x, y): (f64, f64), buttons: u32| {
        json!({ "type": kind, "x": x, "y": y, "modifiers": 8, "buttons": buttons, "clickCount": 1,
            "button": if kind == "mouseMoved" && buttons == 0 { "none" } else { "left" } })
    };
    page.call("Input.dispatchMouseEvent", event("mouseMoved", from, 0)).await?;
    page.call("Input.dispatchMouseEvent", event("mousePressed", from, 1)).await?;
    for step in 1..=6 {
        let part = f64::from(step) / 6.0;
        let at = (from.0 + (to.0 - from.0) * part, from.1 + (to.1 - from.1) * part);
        page.call("Input.dispatchMouseEvent", event("mouseMoved", at, 1)).await?;
    }
    page.call("Input.dispatchMouseEvent", event("mouseReleased", to, 0)).await.map(drop)
}

#[tokio::test]
async fn a_lasso_chooses_several_and_one_press_doubles_them() -> Outcome<()> {
    let stage = stage!("lasso");
    let program = stage.wire.make("Several", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let (far, close) = (rests(&aiko, "Far ball, stream").await?, rests(&aiko, "Close ball, stream").await?);
    lasso(&aiko, (far.x - 70.0, far.y - 70.0), (close.x + close.width + 60.0, close.y + close.height + 6.0)).await?;
    aiko.find("toolbar", "4 selected").await?;
    picture(&aiko, "several").await?;
    aiko.press("button", "Duplicate").await?;
    are(&aiko, 8).await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Close ball 2").await?;
    aiko.key("Control+z").await?;
    are(&aiko, 6).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn all_are_copied_as_a_text_and_pasted_into_another_program() -> Outcome<()> {
    let stage = stage!("copy and paste");
    let program = stage.wire.make("Here", BALLS).await?;
    let other = stage.wire.make("There", None).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.key("Control+a").await?;
    aiko.find("toolbar", "11 selected").await?;
    aiko.eval(
        "globalThis.was = ''; document.execCommand = () => { was = document.activeElement.value; return true; }; 0",
    )
    .await?;
    aiko.key("Control+c").await?;
    let copied = text(&aiko.until("was", "a text is copied").await?).to_owned();
    assert!(copied.starts_with("{\"format\":\"rrp-part/1\""), "{copied}");
    let ben = stage.person("ben", &other).await?;
    ben.find("main", "The graph").await?;
    let paste = format!(
        "(() => {{ const data = new DataTransfer(); data.setData('text/plain', {});
        document.querySelector('#stage').dispatchEvent(new ClipboardEvent('paste', {{ clipboardData: data, bubbles: true, cancelable: true }}));
        return 0; }})()",
        json!(copied)
    );
    ben.eval(&paste).await?;
    are(&ben, 6).await?;
    ben.find("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    ben.key("Control+z").await?;
    are(&ben, 0).await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_long_press_chooses_one_thing_more() -> Outcome<()> {
    let stage = stage!("several by touch");
    let program = stage.wire.make("Touched", BALLS).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.until(
        "document.querySelector('[data-node][aria-label^=\"Far ball\"]')?.getAttribute('aria-pressed') === 'true'",
        "one is chosen",
    )
    .await?;
    let close = rests(&aiko, "Close ball, stream").await?;
    aiko.touch_down(close.centre()).await?;
    aiko.find("toolbar", "2 selected").await?;
    aiko.touch_up().await?;
    aiko.find("toolbar", "2 selected").await?;
    assert_eq!(aiko.count("menu", "*").await?, 0, "no menu opens");
    aiko.until("[...document.querySelectorAll('.chosen-list li')].length === 2", "the panel lists them").await?;
    aiko.size(844, 390, true).await?;
    let inside = "(() => { const bar = document.querySelector('.strip.several')?.getBoundingClientRect();
        return !!bar && bar.left >= 0 && bar.top >= 0 && bar.right <= innerWidth && bar.bottom <= innerHeight; })()";
    aiko.until(inside, "the tools stay on a small screen").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_copy_stands_beside_and_cutting_a_connector_alone_removes_nothing() -> Outcome<()> {
    let stage = stage!("copies beside");
    let program = stage.wire.make("Beside", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.press("button", "filter (distance < 0.5), connector*").await?;
    aiko.eval("document.querySelector('[data-chip][aria-pressed=true]').focus(), 0").await?;
    aiko.key("Control+x").await?;
    aiko.until(
        "document.body.innerText.includes('A connector is copied with the stream that it leads to')",
        "it says why",
    )
    .await?;
    aiko.find("button", "filter (distance < 0.5), connector*").await?;
    aiko.press("button", "Close ball, stream").await?;
    aiko.eval("document.querySelector('[data-node][aria-label^=Close]').focus(), 0").await?;
    aiko.key("Control+d").await?;
    are(&aiko, 7).await?;
    let apart = "(() => { const boxes = [...document.querySelectorAll('[data-node]')].map(node => node.getBoundingClientRect());
        return boxes.every((one, at) => boxes.slice(at + 1).every(other =>
            one.right <= other.left || other.right <= one.left || one.bottom <= other.top || other.bottom <= one.top)); })()";
    aiko.until(apart, "nothing covers anything").await?;
    let seen = "(() => { const at = document.querySelector('[data-node][aria-label^=\"Close ball 2\"]').getBoundingClientRect();
        const stage = document.querySelector('#stage').getBoundingClientRect();
        return at.left >= stage.left && at.right <= stage.right && at.top >= stage.top && at.bottom <= stage.bottom; })()";
    aiko.until(seen, "the copy is seen").await?;
    aiko.no_errors()
}
