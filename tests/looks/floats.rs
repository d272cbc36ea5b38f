//! What floats over the stage in every state that it has: nothing covers anything, all of it can be read, nothing is cut.

use crate::graphs;
use crate::look::{DESKTOP, DRAWN, TABLET, Window, picture, set};
use crate::rules::{self, list};
use crate::screens::{Stage, fit, nothing, open_template, rests, selected, usable};
use crate::targets::small;
use crate::words::Words;
use house::{Outcome, Page, skip};
use std::cell::RefCell;

/// Placeholders that are not read whole.
pub(crate) const PLACEHOLDERS: &str = "(() => {
    const pen = document.createElement('canvas').getContext('2d');
    return [...document.querySelectorAll('input[placeholder]')].filter(field => field.getClientRects().length && !field.value).map(field => {
        const style = getComputedStyle(field);
        pen.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
        const room = field.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
        const wide = pen.measureText(field.placeholder).width;
        return wide > room + 1 ? `“${field.placeholder}” is cut: ${wide.toFixed(0)} in ${room.toFixed(0)}` : '';
    }).filter(Boolean);
})()";

/// What floats over the stage and covers something else that floats, or what it is about.
pub(crate) const FLOATS: &str = "(() => {
    const pieces = [...document.querySelectorAll('.trouble, .strip, .flyout, .zoom, .minimap, .following-line, .offer, .offline, .name-card, .stream.selected, .told, #stop')]
        .filter(piece => piece.getClientRects().length && !piece.hidden && getComputedStyle(piece).visibility !== 'hidden');
    const found = [];
    for (const one of pieces) for (const other of pieces) {
        if (one === other || one.contains(other) || other.contains(one) || pieces.indexOf(one) > pieces.indexOf(other)) continue;
        const [a, b] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
        const shared = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (shared > 2 && high > 2) found.push(`.${one.className} covers .${other.className} by ${shared.toFixed(0)} x ${high.toFixed(0)}`);
    }
    return found;
})()";

/// Parts of the graph under the buttons that zoom, the map or the card that asks for one's name.
pub(crate) const COVERED: &str = "(() => {
    const tools = [...document.querySelectorAll('.zoom:not([hidden]), .minimap, .name-card')].filter(tool => tool.getClientRects().length);
    return [...document.querySelectorAll('#stage :is(.stream, .chip)')].flatMap(part => tools.filter(tool => {
        const [a, b] = [part.getBoundingClientRect(), tool.getBoundingClientRect()];
        return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    }).map(tool => `.${tool.className} covers ${part.getAttribute('aria-label')}`)).slice(0, 6);
})()";

/// What the bubble of a problem covers of the graph.
const BUBBLE: &str = "(() => {
    const bubble = document.querySelector('.trouble')?.getBoundingClientRect();
    if (!bubble) return ['there is no bubble'];
    return [...document.querySelectorAll('#stage .stream')].filter(part => {
        const box = part.getBoundingClientRect();
        return bubble.left < box.right - 1 && box.left < bubble.right - 1 && bubble.top < box.bottom - 1 && box.top < bubble.bottom - 1;
    }).map(part => `the bubble covers ${part.getAttribute('aria-label')}`);
})()";

/// Texts that are too small to be read: less than 12 pixels, on the graph less than 9 as it is seen. Where a window is small
/// the graph is too.
const SMALL: &str = "(() => {
    const world = document.querySelector('#stage .world');
    const zoom = new DOMMatrix(getComputedStyle(world).transform).a;
    const large = innerWidth >= 768 && innerHeight >= 521 && zoom >= 0.46;
    const found = [];
    for (const element of document.querySelectorAll('body *')) {
        if (element.closest('svg, .sr, kbd, .badge') || !element.getClientRects().length) continue;
        const own = [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
        if (!own) continue;
        const on_graph = world.contains(element);
        const high = parseFloat(getComputedStyle(element).fontSize) * (on_graph ? zoom : 1);
        if (on_graph ? large && high < 8.95 : high < 11.5)
            found.push(`“${element.textContent.trim().slice(0, 30)}” is ${high.toFixed(1)} pixels high`);
    }
    return found;
})()";

/// Two actions that want the head, told by one sense.
const FIGHT: &str = "Two trackers";

#[tokio::test]
async fn what_floats_covers_nothing_and_can_be_read() -> Outcome<()> {
    skip::unless!(ready("what floats"));
    states(&Words::english()).await
}

#[tokio::test]
async fn what_floats_covers_nothing_and_can_be_read_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("what floats in Japanese"));
    states(&Words::japanese()?).await
}

/// Goes from state to state, in every window in which there is a stage.
async fn states(words: &Words) -> Outcome<()> {
    let stage = Stage::set_in(words).await?;
    let page = &stage.page;
    let found = RefCell::new(Vec::new());
    let add = |more: Vec<String>| found.borrow_mut().extend(more);
    open_template(page, words).await?;
    add(at_fit(page, words, "sentences").await?);
    selected(page, words, "Distance").await?;
    page.until("!!document.querySelector('.strip')", "the strip is there").await?;
    add(look(page, words, "strip", &[]).await?);
    page.eval("document.querySelector('.chip[data-tests]').click()").await?;
    page.until("!!document.querySelector('.flyout .control')", "the flyout is there").await?;
    add(look(page, words, "flyout", &[]).await?);
    fight(&stage, words, &found).await?;
    others(&stage, words, &found).await?;
    let id = graphs::make_parts(&stage.server, 60).await?;
    open(&stage, &id.to_string()).await?;
    add(at_fit(page, words, "many parts").await?);
    nothing("faults of what floats", &found.into_inner())?;
    page.no_errors()
}

/// The sentences that appear move nothing, and the bubble of a problem covers no rival.
async fn fight(stage: &Stage, words: &Words, found: &RefCell<Vec<String>>) -> Outcome<()> {
    let id = graphs::make_ball(&stage.server, FIGHT).await?;
    open(stage, &id.to_string()).await?;
    let page = &stage.page;
    let place = "JSON.stringify(['x', 'y'].map(side => document.querySelector('[data-node=ball]').getBoundingClientRect()[side]))";
    let before = page.eval(place).await?;
    graphs::add_trackers(&stage.server, &id).await?;
    page.until(
        "!!document.querySelector('.told:not([hidden])') && document.querySelectorAll('#stage .stream').length === 3",
        "there are sentences",
    )
    .await?;
    rests(page).await?;
    let after = page.eval(place).await?;
    if before != after {
        found.borrow_mut().push(format!("the graph moves from {before} to {after} when sentences appear"));
    }
    for name in ["Tracker one", "Tracker two"] {
        page.until("document.querySelectorAll('#stage .badge').length > 0", "there is a badge").await?;
        selected(page, words, name).await?;
        let told = "!!document.querySelector('.trouble')";
        if page.eval(told).await? != true {
            page.frames().await?;
        }
        if page.eval(told).await? == true {
            // On a phone that is held sideways the stage has no room for it beside both.
            for window in [DESKTOP, TABLET] {
                set(page, &window).await?;
                let more = measured(page, words, &format!("bubble of {name}"), &window, &[BUBBLE]).await?;
                found.borrow_mut().extend(more);
            }
            set(page, &DESKTOP).await?;
            page.press_at((420.0, 700.0)).await?;
            return page.until("!document.querySelector('.stream.selected')", "nothing is selected").await.map(drop);
        }
    }
    found.borrow_mut().push("two actions that want the head have no bubble".to_owned());
    Ok(())
}

/// Asked for one's name, and following somebody.
async fn others(stage: &Stage, words: &Words, found: &RefCell<Vec<String>>) -> Outcome<()> {
    let page = &stage.page;
    let yuki = stage.browser.person("yuki").await?;
    yuki.size(1440, 900, false).await?;
    yuki.goto(&stage.server.url()).await?;
    yuki.eval("localStorage.setItem('rrp.name', 'Yuki')").await?;
    yuki.goto(&page.address().await?).await?;
    yuki.reload().await?;
    usable(&yuki).await?;
    page.find("textbox", &words.say("Others see you as")).await?;
    let more = at_fit(page, words, "name card").await?;
    found.borrow_mut().extend(more);
    page.press("button", &words.say("Not now")).await?;
    page.press("button", &words.fill("Follow {name}", &[("name", "Yuki")])).await?;
    page.until("!!document.querySelector('.following-line')", "it says whose view it is").await?;
    let more = look(page, words, "following", &[]).await?;
    found.borrow_mut().extend(more);
    page.key("Escape").await?;
    page.until("!document.querySelector('.following-line')", "the view is one's own again").await.map(drop)
}

/// Opens a program and waits for its streams.
async fn open(stage: &Stage, id: &str) -> Outcome<()> {
    let page = &stage.page;
    page.goto(&format!("{}#/b/{id}", stage.server.url())).await?;
    page.reload().await?;
    usable(page).await?;
    page.until("!!document.querySelector('#stage .stream') && !!document.querySelector('.about .panel')", "it is open")
        .await?;
    rests(page).await
}

/// Looks at a state in which everything is shown.
async fn at_fit(page: &Page, words: &Words, state: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in &DRAWN {
        set(page, window).await?;
        fit(page).await?;
        found.extend(measured(page, words, state, window, &[COVERED]).await?);
    }
    set(page, &DESKTOP).await?;
    Ok(found)
}

/// Looks at a state in every window in which there is a stage.
async fn look(page: &Page, words: &Words, state: &str, more: &[&str]) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in &DRAWN {
        set(page, window).await?;
        found.extend(measured(page, words, state, window, more).await?);
    }
    set(page, &DESKTOP).await?;
    Ok(found)
}

async fn measured(page: &Page, words: &Words, state: &str, window: &Window, more: &[&str]) -> Outcome<Vec<String>> {
    page.until("!document.querySelector('#stage.gliding')", "the view rests").await?;
    rests(page).await?;
    let place = format!("{state}, {}", window.0);
    let mut found = rules::broken(page, &place).await?;
    for rule in [FLOATS, PLACEHOLDERS, SMALL].iter().chain(more) {
        found.extend(list(page, rule, &place).await?);
    }
    found.extend(small(page, window.3, &place).await?);
    picture(page, &format!("floats-{state}-{}-{}", window.0, words.code())).await?;
    Ok(found)
}
