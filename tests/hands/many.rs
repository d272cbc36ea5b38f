//! Programs of many streams, and many gestures: how much work they are, and that nothing piles up.

use house::{Outcome, Page};

use crate::several::lasso;
use crate::steps::{picture, rests, say, stage, text, view};
use serde_json::json;

const MOVES: u32 = 60;
const SELECT: &str = "(face => { face.focus(); face.click(); })(document.querySelector('[aria-label^=\"Face,\"]'))";
/// A drag may be so many times the work of moving a bare box.
const WORK_MAX: f64 = 25.0;

/// Work of the page's main thread for each move of a drag by the mouse.
async fn work_per_move(page: &Page, from: (f64, f64)) -> Outcome<f64> {
    Ok(kinds_per_move(page, from).await?.0)
}

/// The same, and what of it is script, style, layout.
async fn kinds_per_move(page: &Page, from: (f64, f64)) -> Outcome<(f64, String)> {
    page.hold(from).await?;
    page.pull((from.0 + 8.0, from.1 + 2.0)).await?;
    let before = page.cpu().await?;
    for step in 0..MOVES {
        let turn = f64::from(step) / f64::from(MOVES) * std::f64::consts::TAU;
        page.pull((from.0 + 8.0 + 60.0 * turn.sin(), from.1 + 2.0 + 60.0 * (1.0 - turn.cos()))).await?;
    }
    let after = page.cpu().await?;
    page.release((from.0 + 8.0, from.1 + 2.0)).await?;
    let each = |after: f64, before: f64| (after - before) / f64::from(MOVES);
    let (script, style, layout) =
        (each(after.script, before.script), each(after.style, before.style), each(after.layout, before.layout));
    let kinds = format!("script {script:.2}, style {style:.2}, layout {layout:.2}");
    Ok((each(after.task, before.task), kinds))
}

/// The same for a bare box that follows the mouse, on a page with nothing else.
async fn bare_work(page: &Page) -> Outcome<f64> {
    page.goto("about:blank").await?;
    page.eval(
        "document.body.innerHTML = '<div style=\"position:fixed;width:100px;height:48px;background:green\">x</div>';
        const box = document.querySelector('div');
        addEventListener('pointermove', event => {
            box.style.transform = `translate(${event.clientX}px, ${event.clientY}px)`; }); 0",
    )
    .await?;
    work_per_move(page, (300.0, 300.0)).await
}

/// How many parts the edges have in the page, and how many chips there are.
async fn parts(page: &Page) -> Outcome<[u64; 2]> {
    let js = "['.edges:not(.wire) path', '.chip'].map(part => document.querySelectorAll(`#stage ${part}`).length)";
    let parts = page.eval(js).await?;
    Ok([0, 1].map(|at| parts[at].as_u64().unwrap_or_default()))
}

async fn check(count: usize, budget: f64) -> Outcome<()> {
    let stage = stage!("many streams");
    let program = stage.wire.make_large("Many", count).await?;
    let aiko = stage.person("aiko", &program).await?;
    let stream = "Stream 24, *";
    aiko.press("button", "Show everything").await?;
    let whole = format!("document.querySelectorAll('#stage .stream').length === {count}");
    aiko.until(&whole, "everything is in view").await?;
    let rest = rests(&aiko, stream).await?;
    let (zoom, drawn) = (view(&aiko).await?.2, aiko.eval("document.querySelectorAll('#stage .stream').length").await?);
    // The smaller things are, the less is drawn of them.
    let levels =
        aiko.eval("['far', 'tiny'].map(level => document.querySelector('#stage').classList.contains(level))").await?;
    assert_eq!((levels[0].as_bool(), levels[1].as_bool()), (Some(zoom < 0.35), Some(zoom < 0.12)), "at {zoom}");
    // One line for all edges at rest, and no chips: nothing is selected.
    assert_eq!(parts(&aiko).await?, [1, 0], "the parts of edges and the chips that are in the page");
    picture(&aiko, &format!("many-{count}")).await?;
    let (whole, kinds) = kinds_per_move(&aiko, rest.centre()).await?;
    aiko.eval("document.querySelector('.zoom .percent').click(), 0").await?;
    rests(&aiko, stream).await.ok();
    let near = aiko.find_all("button", "Stream *").await?;
    let paper = aiko.boxed("main", "").await?;
    let middle = paper.centre();
    let nearest = near.iter().min_by(|one, other| {
        let far = |node: &house::Node| (node.rect.centre().0 - middle.0).hypot(node.rect.centre().1 - middle.1);
        far(one).total_cmp(&far(other))
    });
    let nearest = nearest.ok_or("No stream is in view at real size.")?;
    let real = work_per_move(&aiko, nearest.rect.centre()).await?;
    aiko.no_errors()?;
    let bare = bare_work(&aiko).await?;
    say(&format!(
        "Dragging one of {count} streams: {whole:.2} ms a step ({kinds}) with {drawn} of them in view at {:.0} %, {real:.2} ms at \
         100 % (budget {budget} ms); a bare box {bare:.2} ms.",
        zoom * 100.0
    ));
    let work = whole.max(real) / bare.max(0.05);
    assert!(work < WORK_MAX, "a drag is {work:.0} times the work of moving a bare box");
    Ok(())
}

/// From far away what the hand moves and what is chosen is apart from all that rests, and comes together again.
#[tokio::test]
async fn from_far_away_what_moves_is_apart_from_what_rests() -> Outcome<()> {
    let stage = stage!("a graph from far away");
    let program = stage.wire.make_large("Many", 500).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Show everything").await?;
    aiko.until("document.querySelector('#stage').classList.contains('tiny')", "it is far away").await?;
    let rest = rests(&aiko, "Stream 24, *").await?;
    assert_eq!(parts(&aiko).await?, [1, 0]);
    let whole = "document.querySelector('#stage .edges path').getAttribute('d')";
    let before = text(&aiko.eval(whole).await?).to_owned();
    let (x, y) = rest.centre();
    aiko.hold((x, y)).await?;
    aiko.pull((x + 20.0, y + 5.0)).await?;
    aiko.pull((x + 40.0, y + 10.0)).await?;
    // What leads to it and what leads on from it.
    aiko.until("document.querySelectorAll('#stage .edges:not(.wire) path').length === 3", "its edges are apart")
        .await?;
    let now = text(&aiko.eval(whole).await?).to_owned();
    assert!(now.len() < before.len(), "all that rests is {} long, and was {}", now.len(), before.len());
    picture(&aiko, "far-drag").await?;
    aiko.release((x + 40.0, y + 10.0)).await?;
    aiko.until("document.querySelectorAll('#stage .edges:not(.wire) path').length === 1", "all rests again").await?;
    let moved = format!("{whole} !== {}", json!(before));
    aiko.until(&moved, "its edges lead to its new place").await?;
    let there = rests(&aiko, "Stream 24, *").await?.centre();
    assert!((there.0 - x - 40.0).abs() < 3.0 && (there.1 - y - 10.0).abs() < 3.0, "it was let go at {there:?}");
    aiko.press("button", "Stream 24, *").await?;
    aiko.until("document.querySelectorAll('#stage .chip').length === 2", "the keyboard finds its chips").await?;
    aiko.press("button", "Undo").await?;
    aiko.until(&format!("{whole} === {}", json!(before)), "it is back").await?;
    // Two that are chosen move together, with the edges of both: into the first, between them, out of the second.
    let (one, two) = (rests(&aiko, "Stream 24, *").await?, rests(&aiko, "Stream 25, *").await?);
    aiko.key("Escape").await?;
    lasso(&aiko, (one.x - 3.0, one.y - 2.0), (two.x + two.width + 2.0, two.y + two.height + 2.0)).await?;
    aiko.until("document.querySelectorAll('#stage .stream.selected').length === 2", "two are chosen").await?;
    aiko.hold(one.centre()).await?;
    aiko.pull((x + 20.0, y + 5.0)).await?;
    aiko.pull((x + 40.0, y + 10.0)).await?;
    aiko.until("document.querySelectorAll('#stage .edges:not(.wire) path').length === 4", "their edges move").await?;
    aiko.release((x + 40.0, y + 10.0)).await?;
    aiko.until(&format!("{whole} !== {}", json!(before)), "they are let go").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn dragging_one_of_500_streams_is_little_work() -> Outcome<()> {
    check(500, 10.0).await
}

#[tokio::test]
async fn dragging_one_of_2000_streams_is_little_work() -> Outcome<()> {
    check(2_000, 12.0).await
}

#[tokio::test]
async fn selecting_and_opening_again_and_again_leaves_nothing_behind() -> Outcome<()> {
    let stage = stage!("again and again");
    let programs =
        [stage.wire.make("One", Some("Greeter")).await?, stage.wire.make("Two", Some("Track with nearest arm")).await?];
    let aiko = stage.person("aiko", &programs[0]).await?;
    rests(&aiko, "Face,*").await?;
    aiko.until("document.querySelectorAll('.told .sentence').length === 3", "the sentences are there").await?;
    let before = elements(&aiko).await?;
    for _ in 0..50 {
        aiko.eval(SELECT).await?;
        aiko.until("document.querySelector('.strip') !== null", "the strip is there").await?;
        aiko.key("Escape").await?;
        aiko.until("document.querySelector('.strip') === null", "the strip is gone").await?;
    }
    for round in 0..20 {
        let (program, stream) = if round % 2 == 0 { (&programs[1], "Ball") } else { (&programs[0], "Face") };
        aiko.eval(&format!("location.hash = '#/b/{program}', 0")).await?;
        aiko.until(&format!("document.querySelector('[aria-label^=\"{stream},\"]') !== null"), "it is open").await?;
    }
    rests(&aiko, "Face,*").await?;
    aiko.until("document.querySelectorAll('.told .sentence').length === 3", "the sentences are there again").await?;
    let after = elements(&aiko).await?;
    assert!(after <= before + 20, "elements of the page before {before}, after {after}");
    aiko.no_errors()
}

async fn elements(page: &Page) -> Outcome<u64> {
    let count = page.eval("document.querySelectorAll('*').length").await?;
    Ok(count.as_u64().unwrap_or_default())
}
