//! What one works on stays in sight: the strip covers no connector of its stream, the hand cannot lose the graph, everything
//! can be shown, what is added comes into view, and nothing jumps or is covered.

use house::{Outcome, Page};

use crate::steps::{picture, rests, stage, view};

/// The connectors of the selected stream that the strip covers.
const COVERED: &str = "(() => {
    const strip = document.querySelector('.strip').getBoundingClientRect();
    const name = document.querySelector('.stream.selected .name').textContent;
    const own = [...document.querySelectorAll('.chip')].filter(chip => {
        const [, from, to] = chip.getAttribute('aria-label').match(/connector from (.*) to (.*)$/);
        return to === name || from.split(' and ').includes(name);
    });
    return own.filter(chip => {
        const box = chip.getBoundingClientRect();
        return Math.min(box.right, strip.right) - Math.max(box.left, strip.left) > 1
            && Math.min(box.bottom, strip.bottom) - Math.max(box.top, strip.top) > 1;
    }).map(chip => chip.getAttribute('aria-label')).join();
})()";

/// Streams of which no part is in the stage, and how many there are at all.
const LOST: &str = "(() => {
    const stage = document.querySelector('#stage').getBoundingClientRect();
    const all = [...document.querySelectorAll('.stream')];
    const lost = all.filter(stream => {
        const box = stream.getBoundingClientRect();
        return box.right < stage.left || box.left > stage.right || box.bottom < stage.top || box.top > stage.bottom;
    });
    return [lost.length, all.length];
})()";

/// What a message lies on that can be pressed.
const UNDER: &str = "(() => {
    const notice = document.querySelector('.notice').getBoundingClientRect();
    return [...document.querySelectorAll('button, input, select, textarea')].filter(control => {
        const box = control.getBoundingClientRect();
        return !control.closest('.notice') && box.width > 0
            && Math.min(box.right, notice.right) - Math.max(box.left, notice.left) > 1
            && Math.min(box.bottom, notice.bottom) - Math.max(box.top, notice.top) > 1;
    }).map(control => control.outerHTML.slice(0, 80)).join();
})()";

/// How many streams cannot be seen at all, of how many.
async fn lost(page: &Page) -> Outcome<(u64, u64)> {
    let counts = page.eval(LOST).await?;
    let count = |at: usize| counts[at].as_u64().unwrap_or_default();
    Ok((count(0), count(1)))
}

async fn still(page: &Page) -> Outcome<()> {
    let js = "document.getAnimations().every(motion => motion.playState !== 'running')";
    page.until(js, "nothing moves").await?;
    page.frames().await
}

#[tokio::test]
async fn the_strip_covers_no_connector_of_its_stream() -> Outcome<()> {
    let stage = stage!("the strip and its connectors");
    let program = stage.wire.make("Strip", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    let names = aiko.eval("[...document.querySelectorAll('.stream .name')].map(e => e.textContent)").await?;
    let names: Vec<String> = serde_json::from_value(names)?;
    assert!(names.len() > 3);
    for name in names {
        aiko.press("button", &format!("{name}, *")).await?;
        aiko.find("toolbar", &format!("Next steps for {name}")).await?;
        still(&aiko).await?;
        aiko.until(&format!("{COVERED} === ''"), &format!("the strip of {name} covers none of its connectors")).await?;
        picture(&aiko, &format!("strip-{name}")).await?;
    }
    aiko.no_errors()
}

#[tokio::test]
async fn the_hand_cannot_lose_the_graph() -> Outcome<()> {
    let stage = stage!("losing the graph");
    let program = stage.wire.make("Lost", Some("Greeter")).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Face,*").await?;
    for (dx, dy) in [(500.0, 0.0), (0.0, 500.0), (-500.0, 0.0), (0.0, -500.0), (500.0, 500.0)] {
        let from = (700.0 - dx / 2.0, 450.0 - dy / 2.0);
        for _ in 0..5 {
            // Shift and the wheel pan wherever the pointer is, be it on a stream.
            aiko.eval(&format!(
                "document.querySelector('#stage').dispatchEvent(new WheelEvent('wheel', {{ deltaX: {dx}, deltaY: {dy}, \
                 shiftKey: true, clientX: {}, clientY: {}, bubbles: true, cancelable: true }})), 0",
                from.0, from.1
            ))
            .await?;
        }
        let (lost, all) = lost(&aiko).await?;
        assert!(all > lost, "after {dx}, {dy} none of {all} streams is in view");
    }
    aiko.no_errors()
}

#[tokio::test]
async fn a_large_program_opens_readable_and_everything_can_be_shown() -> Outcome<()> {
    let stage = stage!("show everything");
    for count in [60, 200] {
        let program = stage.wire.make_large(&format!("Large {count}"), count).await?;
        let aiko = stage.person("aiko", &program).await?;
        rests(&aiko, "Stream 0, *").await?;
        let (_, _, zoom) = view(&aiko).await?;
        assert!(zoom >= 0.4, "{count} streams open at {zoom}");
        picture(&aiko, &format!("open-{count}")).await?;
        aiko.press("button", "Show everything").await?;
        let whole = format!("document.querySelectorAll('.stream').length === {count} && {LOST}[0] === 0");
        aiko.until(&whole, &format!("all {count} streams are in view")).await?;
        still(&aiko).await?;
        assert_eq!(lost(&aiko).await?, (0, count as u64));
        picture(&aiko, &format!("everything-{count}")).await?;
        aiko.no_errors()?;
        aiko.close().await?;
    }
    Ok(())
}

#[tokio::test]
async fn start_moves_nothing_and_what_is_added_comes_into_view() -> Outcome<()> {
    let stage = stage!("start moves nothing");
    let program = stage.wire.make("Still", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    let tops =
        "['.room', '.room-tools', '.panel'].map(part => document.querySelector(part).getBoundingClientRect().top)";
    aiko.until("!!document.querySelector('.panel')", "the panel is there").await?;
    let before = aiko.eval(tops).await?;
    aiko.press("button", "Start").await?;
    aiko.find("button", "Running").await?;
    aiko.until("document.body.innerText.includes('/s')", "values come").await?;
    assert_eq!(aiko.eval(tops).await?, before, "the room and the panels stay where they are");

    let seen = "(() => {
        const stage = document.querySelector('#stage').getBoundingClientRect();
        const node = document.querySelector('.stream.selected');
        const box = node?.getBoundingClientRect();
        return box && box.left >= stage.left && box.right <= stage.right && box.top >= stage.top && box.bottom <= stage.bottom;
    })()";
    for _ in 0..4 {
        aiko.press("button", "Show everything").await?;
        still(&aiko).await?;
        aiko.press("button", "Ball, sensor stream").await?;
        aiko.find("toolbar", "Next steps for Ball").await?;
        let streams = aiko.eval("document.querySelectorAll('.stream').length").await?;
        aiko.eval("document.querySelector('.strip .next').click(), 0").await?;
        aiko.until("!document.querySelector('[role=dialog]')", "it was added at once").await?;
        aiko.until(&format!("document.querySelectorAll('.stream').length > {streams}"), "there is one more").await?;
        aiko.until("!document.querySelector('.stream.selected .name')?.textContent.match(/^Ball$/)", "it is selected")
            .await?;
        still(&aiko).await?;
        aiko.until(seen, "what was added is in view").await?;
    }
    aiko.within("region", "Robot").press("button", "Use my changes").await?;
    aiko.until("document.querySelector('.notice') !== null", "the page says that it was applied").await?;
    still(&aiko).await?;
    picture(&aiko, "notice").await?;
    aiko.until(&format!("!document.querySelector('.notice') || {UNDER} === ''"), "the message covers nothing").await?;
    aiko.no_errors()
}
