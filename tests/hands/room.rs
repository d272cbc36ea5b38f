//! Nothing on the canvas gets in the way of anything else.

use house::{Outcome, Page};
use serde_json::Value;

use crate::steps::{Stage, picture, rests, stage, text};

const TEMPLATES: [&str; 12] = [
    "Count my touches",
    "Distance to brightness",
    "Goodbye",
    "Greeter",
    "Hello once",
    "Reflect ball color",
    "Say ball color",
    "Say ball color with merge",
    "Touch to tell the color",
    "Track far and close balls",
    "Track with nearest arm",
    "Track with nearest arm, in time",
];

/// Templates about what the simulated robot does not sense by itself: the sense, and what is sent there.
const SENT: [(&str, &str, &str); 4] = [
    ("Count my touches", "Touch", "touched"),
    ("Goodbye", "Face", "a new face"),
    ("Greeter", "Face detection", "a new face"),
    ("Hello once", "Face", "a new face"),
];

/// The number of values on the canvas, and the frames for which it stays the same once all are there.
const VALUES: &str = "document.querySelectorAll('#stage .value').length";
const FRAMES: u32 = 40;

/// Pairs of streams, chips and values of different streams that meet.
const MEETING: &str = "(() => {
    const all = [...document.querySelectorAll('#stage .stream, #stage .chip, #stage .value')].map(node => {
        const own = node.closest('.at');
        return { name: node.className + ' ' + own.querySelector('[aria-label]').getAttribute('aria-label'), own, at: node.getBoundingClientRect() };
    });
    const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
    return all.flatMap((one, at) => all.slice(at + 1)
        .filter(other => one.own !== other.own && meet(one.at, other.at))
        .map(other => one.name + ' / ' + other.name)).join('\\n');
})()";

/// Streams and chips whose words are cut although they are short. From so far away that texts are larger than their boxes were
/// made for, what is cut has a title.
const CUT: &str = "[...document.querySelectorAll('#stage .name, #stage .detail')]
    .filter(node => node.scrollWidth > node.clientWidth + 1 && node.parentElement.closest('[data-node], [data-chip]').offsetWidth < 258)
    .filter(node => !document.querySelector('#stage[data-text]') || !node.closest('[title]'))
    .map(node => node.textContent).join()";

/// What the page shows outside of the stage.
const OUTSIDE: &str = "(() => {
    const stage = document.querySelector('#stage').getBoundingClientRect();
    return [...document.querySelectorAll('#stage .stream, #stage .chip, #stage .value, #stage .strip')]
        .filter(node => { const at = node.getBoundingClientRect();
            return at.left < stage.left || at.right > stage.right + 1 || at.top < stage.top || at.bottom > stage.bottom + 1; })
        .map(node => node.className).join();
})()";

async fn nothing_meets(page: &Page, what: &str) -> Outcome<()> {
    let meeting = page.eval(MEETING).await?;
    assert_eq!(meeting, "", "{what}: {}", text(&meeting));
    assert_eq!(page.eval(CUT).await?, "", "{what}");
    Ok(())
}

/// Sends a value where `template` waits for one.
async fn send(page: &Page, template: &str) -> Outcome<()> {
    let Some((_, sense, what)) = SENT.iter().find(|sent| sent.0 == template) else { return Ok(()) };
    page.press("button", &format!("{sense}, *")).await?;
    page.press("button", "Send a value").await?;
    page.within("dialog", &format!("Send a value: {sense}")).press("button", what).await?;
    page.key("Escape").await?;
    page.gone("dialog", &format!("Send a value: {sense}")).await
}

/// Runs each template, as it comes and once tidied; several tests share them, as one alone would be the last to end.
async fn values_have_room(stage: Stage, templates: &[&str]) -> Outcome<()> {
    for &name in templates {
        let program = stage.wire.make(&format!("My {name}"), Some(name)).await?;
        let aiko = stage.person("aiko", &program).await?;
        aiko.press("button", "Start").await?;
        send(&aiko, name).await?;
        aiko.until("document.querySelectorAll('#stage .value').length > 0", "values come").await?;
        aiko.steady(VALUES, FRAMES, "all values are there").await?;
        picture(&aiko, &program).await?;
        nothing_meets(&aiko, name).await?;
        assert_eq!(aiko.eval(OUTSIDE).await?, "", "{name}");
        aiko.press("button", "Tidy").await?;
        aiko.settled().await?;
        picture(&aiko, &format!("{program}-tidy")).await?;
        nothing_meets(&aiko, &format!("{name}, tidied")).await?;
        aiko.no_errors()?;
        aiko.press("button", "Stop").await?;
        aiko.close().await?;
    }
    Ok(())
}

#[tokio::test]
async fn values_of_the_first_templates_have_room() -> Outcome<()> {
    values_have_room(stage!("the first templates have room"), &TEMPLATES[..4]).await
}

#[tokio::test]
async fn values_of_the_next_templates_have_room() -> Outcome<()> {
    values_have_room(stage!("the next templates have room"), &TEMPLATES[4..8]).await
}

#[tokio::test]
async fn values_of_the_last_templates_have_room() -> Outcome<()> {
    values_have_room(stage!("the last templates have room"), &TEMPLATES[8..]).await
}

#[tokio::test]
async fn values_become_shorter_where_streams_are_close() -> Outcome<()> {
    let stage = stage!("close streams");
    let program = stage.wire.make("Close", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    let (far, close) = (rests(&aiko, "Far ball, stream").await?, rests(&aiko, "Close ball, stream").await?);
    let by = far.x + far.width + 80.0 - close.x;
    let (x, y) = close.centre();
    aiko.drag((x, y), (x + by, y), 8).await?;
    aiko.press("button", "Start").await?;
    aiko.until("document.querySelectorAll('#stage .value').length > 3", "values come").await?;
    aiko.steady(VALUES, FRAMES, "all values are there").await?;
    picture(&aiko, "close-streams").await?;
    let meeting = aiko.eval(MEETING).await?;
    let values: Vec<&str> = text(&meeting).lines().filter(|pair| pair.contains("value")).collect();
    assert!(values.is_empty(), "{values:?}");
    aiko.press("button", "Stop").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_first_sense_stands_at_the_top_and_the_strip_keeps_off_values() -> Outcome<()> {
    let stage = stage!("first sense");
    let program = stage.wire.make("Empty", None).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.find("heading", "Add a sense to begin").await?;
    assert_eq!(aiko.count("button", "Tidy").await?, 0, "an empty program has nothing to zoom");
    picture(&aiko, "first-none").await?;
    aiko.press("button", "Add sensor").await?;
    aiko.press("menuitem", "Red ball*").await?;
    let ball = rests(&aiko, "Red ball, sensor stream").await?;
    let paper = aiko
        .on("main", "", "function () { const at = this.getBoundingClientRect(); return [at.x, at.y, at.width] }")
        .await?;
    let number = |at: usize| paper[at].as_f64().unwrap_or_default();
    assert!((ball.centre().0 - number(0) - number(2) / 2.0).abs() < 30.0, "{ball:?} {paper}");
    assert!(ball.y - number(1) < 120.0, "{ball:?} {paper}");
    picture(&aiko, "first-sense").await?;
    strip_is_clear(&aiko).await?;
    Ok(())
}

/// The strip is on the stage and covers no stream.
async fn strip_is_clear(page: &Page) -> Outcome<()> {
    page.find("toolbar", "Next steps for*").await?;
    let js = "(() => {
        const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        const strip = document.querySelector('.strip').getBoundingClientRect();
        return [...document.querySelectorAll('#stage .stream, #stage .value')]
            .filter(node => meet(node.getBoundingClientRect(), strip)).map(node => node.className).join();
    })()";
    assert_eq!(page.eval(js).await?, Value::from(""));
    assert_eq!(page.eval(OUTSIDE).await?, "");
    Ok(())
}

#[tokio::test]
async fn the_strip_keeps_off_streams() -> Outcome<()> {
    let stage = stage!("the strip");
    let program = stage.wire.make("Strip", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    for stream in ["Ball,*", "Distance,*", "Far ball,*", "Close ball,*", "Head tracker,*", "Head and body tracker,*"] {
        rests(&aiko, stream).await?;
        aiko.press("button", stream).await?;
        rests(&aiko, stream).await?;
        picture(&aiko, &format!("strip-{}", stream.trim_end_matches(",*").replace(' ', "-"))).await?;
        strip_is_clear(&aiko).await?;
    }
    aiko.press("button", "filter (distance < 0.5)*").await?;
    aiko.find("group", "filter (distance < 0.5)").await?;
    aiko.until("document.querySelector('.flyout .slider') !== null", "it has a slider").await?;
    picture(&aiko, "strip-chip").await?;
    let js = "(() => {
        const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        const flyout = document.querySelector('.flyout').getBoundingClientRect();
        const own = ['.chip.selected', '[aria-label^=\"Distance,\"]', '[aria-label^=\"Close ball,\"]'];
        return own.filter(one => meet(document.querySelector(`#stage ${one}`).getBoundingClientRect(), flyout)).join();
    })()";
    assert_eq!(aiko.eval(js).await?, "", "it covers neither its chip nor the streams of that");
    assert_eq!(aiko.eval(OUTSIDE).await?, "");
    aiko.no_errors()
}
