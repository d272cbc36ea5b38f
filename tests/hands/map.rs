//! The whole graph in small: from thirty streams on, led by a tap, a drag and arrow keys.

use house::{Outcome, Page};

use crate::steps::{rests, stage, view};

/// What of the view is the same when the map led elsewhere: how large things are.
async fn moves(page: &Page, before: (f64, f64, f64), what: &str) -> Outcome<(f64, f64, f64)> {
    let js = format!(
        "(() => {{ const m = new DOMMatrix(getComputedStyle(document.querySelector('.world')).transform);
        return Math.abs(m.e - {}) + Math.abs(m.f - {}) > 20; }})()",
        before.0, before.1
    );
    page.until(&js, what).await?;
    page.until("document.getAnimations().every(motion => motion.playState !== 'running')", "nothing moves").await?;
    let after = view(page).await?;
    assert!((after.2 - before.2).abs() < 1e-6, "{before:?} {after:?}");
    Ok(after)
}

#[tokio::test]
async fn a_tap_a_drag_and_arrow_keys_lead_anywhere_in_a_large_graph() -> Outcome<()> {
    let stage = stage!("minimap");
    let (few, many) = (stage.wire.make_large("Few", 29).await?, stage.wire.make_large("Many", 120).await?);
    let aiko = stage.person("aiko", &few).await?;
    rests(&aiko, "Stream 1, *").await?;
    assert_eq!(aiko.eval("document.querySelectorAll('.minimap').length").await?, 0, "29 are seen without a map");
    aiko.eval(&format!("location.hash = '#/b/{many}', 0")).await?;
    aiko.until("document.querySelector('.minimap') !== null", "120 have a map").await?;
    aiko.eval("document.querySelector('.zoom .percent').click(), 0").await?;
    aiko.settled().await?;
    let map = aiko.boxed("group", "The whole graph in small; arrow keys move what is seen").await?;
    let at = |x: f64, y: f64| (map.x + map.width * x, map.y + map.height * y);
    let before = view(&aiko).await?;
    aiko.press_at(at(0.7, 0.8)).await?;
    let tapped = moves(&aiko, before, "a tap shows that part").await?;
    aiko.drag(at(0.7, 0.8), at(0.4, 0.3), 6).await?;
    let dragged = moves(&aiko, tapped, "a drag goes on").await?;
    aiko.eval("document.querySelector('.minimap').focus(), 0").await?;
    aiko.key("ArrowDown").await?;
    let keyed = moves(&aiko, dragged, "an arrow key moves what is seen").await?;
    assert!(keyed.1 < dragged.1, "{dragged:?} {keyed:?}");
    aiko.no_errors()
}
