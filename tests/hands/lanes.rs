//! Drawing lanes: how much a picture asks of the browser, and how long it takes with a million values.

use crate::steps::say;
use house::{Browser, Outcome, Page, SESSION, Server, keep_session, skip};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// The recording of the benchmark.
const MILLION: &str = "2026-11-24T12-00-00Z-million.jsonl";
const VALUES: u64 = 1_000_000;
const LANES: u64 = 12;
const HOUR_MS: u64 = 3_600_000;
/// The end of the recording, in milliseconds: silences may make it a little longer than an hour.
const END_MS: u64 = 2 * HOUR_MS;
/// The time that 95 of 100 pictures may take, in milliseconds.
const DRAWN_P95_MS: f64 = 8.0;
/// On a machine that is slow itself: how many times as long as a plain script that gives the browser the same orders.
const DRAWN_RATIO_MAX: f64 = 3.0;
/// The pictures that are measured: from all of the hour down to a second, then along.
const PICTURES: u32 = 240;

/// Counts what pictures ask of the browser: orders to the pen, and questions about styles.
const COUNT: &str = "(() => {
    const asked = globalThis.asked = { pictures: 0, orders: 0, most: 0, styles: 0 };
    const styles = globalThis.getComputedStyle;
    globalThis.getComputedStyle = (...of) => { asked.styles += 1; return styles.apply(globalThis, of); };
    const pen = CanvasRenderingContext2D.prototype;
    for (const name of ['moveTo', 'lineTo', 'arc', 'roundRect', 'fill', 'stroke', 'fillText', 'setLineDash']) {
        const own = pen[name];
        pen[name] = function (...with_) { asked.orders += 1; asked.most = Math.max(asked.most, asked.orders); return own.apply(this, with_); };
    }
    const clear = pen.clearRect;
    pen.clearRect = function (...with_) { asked.pictures += 1; asked.orders = 0; return clear.apply(this, with_); };
})(), 0";

/// Measures each picture of the lanes: how long the page's own code takes, with the orders to the pen.
const MEASURE: &str = "(() => {
    const took = globalThis.took = { page: [], plain: [] };
    const pen = CanvasRenderingContext2D.prototype;
    let draws = false;
    const clear = pen.clearRect;
    pen.clearRect = function (...with_) { draws = true; return clear.apply(this, with_); };
    const frame = requestAnimationFrame.bind(globalThis);
    globalThis.requestAnimationFrame = act => frame(time => {
        draws = false;
        const before = performance.now();
        act(time);
        if (draws) took.page.push(performance.now() - before);
    });
})(), 0";

/// Gives the orders of each picture once more, by a plain script to another canvas: the browser's own part.
const REPEAT: &str = "(() => {
    const pen = CanvasRenderingContext2D.prototype, own = {};
    const other = document.createElement('canvas').getContext('2d');
    let orders = [];
    for (const name of ['beginPath', 'moveTo', 'lineTo', 'arc', 'roundRect', 'rect', 'fill', 'stroke', 'fillText', 'setLineDash', 'setTransform', 'clearRect']) {
        own[name] = pen[name];
        pen[name] = function (...with_) { if (this !== other) orders.push([name, with_]); return own[name].apply(this, with_); };
    }
    for (const name of ['fillStyle', 'strokeStyle', 'lineWidth', 'font', 'textAlign', 'textBaseline', 'lineJoin']) {
        const is = Object.getOwnPropertyDescriptor(pen, name);
        Object.defineProperty(pen, name, { ...is, set(value) { if (this !== other) orders.push([name, value]); is.set.call(this, value); } });
    }
    const size = document.querySelector('.past-canvas canvas');
    const frame = globalThis.requestAnimationFrame;
    globalThis.requestAnimationFrame = act => frame(time => {
        orders = [];
        act(time);
        if (!orders.length) return;
        [other.canvas.width, other.canvas.height] = [size.width, size.height];
        const before = performance.now();
        for (const [name, with_] of orders) {
            if (own[name]) own[name].apply(other, with_); else other[name] = with_;
        }
        took.plain.push(performance.now() - before);
    });
})(), 0";

/// Zooms in from all of it and pans, a picture at a time.
fn through(pictures: u32) -> String {
    format!(
        "(async () => {{
            const canvas = document.querySelector('.past-canvas canvas');
            const box = canvas.getBoundingClientRect();
            const turn = (deltaX, deltaY) => canvas.dispatchEvent(new WheelEvent('wheel', {{
                deltaX, deltaY, clientX: box.left + box.width / 3, clientY: box.top + 40, bubbles: true, cancelable: true }}));
            const drawn = () => new Promise(done => requestAnimationFrame(() => setTimeout(done, 0)));
            turn(0, 100000);
            await drawn();
            for (let at = 0; at < {pictures}; at += 1) {{
                turn(at % 3 ? 0 : 13, at < {pictures} / 2 ? -45 : 0);
                if (at >= {pictures} / 2) turn(17, 0);
                await drawn();
            }}
            return true;
        }})()"
    )
}

/// A person who looks back at a recording.
async fn looks_back(server: &Server, browser: &Browser, recording: &str) -> Outcome<Page> {
    let page = browser.person("aiko").await?;
    page.size(1440, 900, false).await?;
    page.goto(&format!("{}?past={recording}", server.url())).await?;
    page.until("performance.getEntriesByName('rrp-usable').length > 0", "the page is usable").await?;
    page.until("document.querySelectorAll('.past-label').length > 4", "the lanes are there").await?;
    page.until("document.querySelector('.past-table [aria-current]') != null", "with their values").await?;
    page.settled().await?;
    Ok(page)
}

#[tokio::test]
async fn a_picture_of_the_lanes_asks_for_no_style_and_gives_few_orders() -> Outcome<()> {
    skip::unless!(ready("hands: how much drawing lanes asks"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = looks_back(&server, &browser, SESSION).await?;
    page.eval(COUNT).await?;
    page.eval(&through(60)).await?;
    let asked = page.eval("asked").await?;
    let of = |name: &str| asked[name].as_u64().unwrap_or(u64::MAX);
    say(&format!("{} pictures of lanes: {} orders at most, {} styles asked", of("pictures"), of("most"), of("styles")));
    // Two canvases, and pictures may join.
    assert!(of("pictures") >= 60, "{asked}");
    // The letters in which a text is measured are asked for once for each text.
    let texts = page.eval("document.querySelectorAll('.past-label').length * 40").await?.as_u64().unwrap_or_default();
    assert!(of("styles") <= texts, "{asked}");
    // Four points for each pixel of a plot, twice for its forms.
    let lanes = page.eval("document.querySelectorAll('.past-label').length").await?.as_u64().unwrap_or_default();
    let wide =
        page.eval("Math.ceil(document.querySelector('.past-canvas').clientWidth)").await?.as_u64().unwrap_or_default();
    assert!(of("most") <= lanes * (4 * wide + 600), "{asked}");
    page.no_errors()
}

#[tokio::test]
#[ignore = "measured by `cargo xtask bench lanes`"]
async fn figure_lanes_of_a_million_values() -> Outcome<()> {
    skip::unless!(optimised("the figure of drawing lanes"));
    let folder = house::folder()?;
    keep_million(folder.path())?;
    let server = Server::start_binary(&house::optimised(), folder.path(), &[]).await?;
    let browser = Browser::launch().await?;
    let page = looks_back(&server, &browser, MILLION).await?;
    for lane in 0..LANES {
        page.eval(&format!(
            "(() => {{ const list = document.getElementById('past-add'); list.value = 's{lane}'; \
             if (list.value) list.dispatchEvent(new Event('change', {{ bubbles: true }})); return true; }})()"
        ))
        .await?;
    }
    // The row of marks has a label too.
    page.until(&format!("document.querySelectorAll('.past-label').length === {}", LANES + 1), "twelve lanes").await?;
    page.settled().await?;
    page.eval(MEASURE).await?;
    page.eval(&through(PICTURES)).await?;
    let own = times(&page.eval("took.page").await?);
    page.eval(REPEAT).await?;
    page.eval(&through(PICTURES)).await?;
    let plain = times(&page.eval("took.plain").await?);
    let (p50, p95) = (part(&own, 50), part(&own, 95));
    let (plain50, plain95) = (part(&plain, 50), part(&plain, 95));
    say(&format!(
        "{VALUES} values in {LANES} lanes, {} pictures: p50 {p50:.1} ms, p95 {p95:.1} ms (bar {DRAWN_P95_MS} ms); the same orders by a \
         plain script: p50 {plain50:.1} ms, p95 {plain95:.1} ms",
        own.len()
    ));
    assert!(own.len() >= PICTURES as usize && p95 <= DRAWN_P95_MS.max(plain95 * DRAWN_RATIO_MAX), "the bar is missed");
    page.no_errors()
}

/// Times in their order.
fn times(all: &Value) -> Vec<f64> {
    let mut all: Vec<f64> = all.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The time that so many of a hundred stay below.
fn part(all: &[f64], percent: usize) -> f64 {
    all.get((all.len() * percent / 100).min(all.len().saturating_sub(1))).copied().unwrap_or(f64::INFINITY)
}

/// An hour in which twelve senses tell a million values: eight numbers that change, four that something is there.
fn keep_million(data: &Path) -> Outcome<()> {
    let folder = data.join("recordings");
    std::fs::create_dir_all(&folder)?;
    let header = json!({
        "format": "rrp-recording/2", "behaviour": "million", "name": "A million", "revision": 1, "mode": "event",
        "by": "Aiko", "began": "2026-11-24T12:00:00Z", "run": 1, "robot": "NAO",
    });
    let sense =
        |at: u64| json!({ "id": format!("s{at}"), "kind": "sensor", "name": format!("Sense {at}"), "device": "Sonar" });
    let streams: Vec<Value> = (0..LANES).map(sense).collect();
    let file = json!({ "format": "rrp-behaviour/1", "name": "A million", "helpers": [], "streams": streams, "connectors": [] });
    let mut lines = format!("{header}\n{}\n", json!({ "t": 0, "mark": "file", "revision": 1, "file": file }));
    // Each is silent for a while now and then: more than a million moments have a million values.
    let moments = VALUES * 10 / 9;
    let mut left = VALUES;
    for at in 0..moments * 2 {
        let (t, sense) = (at * HOUR_MS / moments, at % LANES);
        if (t / 60_000 + sense).is_multiple_of(10) {
            continue;
        }
        let Some(less) = left.checked_sub(1) else { break };
        left = less;
        let value = if sense < 8 { (at * 7_919 % 1_000).to_string() } else { "true".to_owned() };
        writeln!(lines, "{{\"t\":{t},\"stream\":\"s{sense}\",\"value\":{value}}}")?;
    }
    writeln!(
        lines,
        "{}",
        json!({ "t": END_MS, "mark": "end", "closed": END_MS, "late": 0, "why": "it was stopped", "by": "Aiko" })
    )?;
    std::fs::write(folder.join(MILLION), lines)?;
    Ok(())
}
