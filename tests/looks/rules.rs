//! What holds for every screen: nothing scrolls sideways, what is cut has a title, that all is saved is read whole, the bar
//! ends in the window, Stop is on top, nothing moves for who wants no motion.

use house::{Outcome, Page};

/// What would have to scroll sideways.
const SIDEWAYS: &str = "(() => {
    const found = [];
    const root = document.documentElement;
    if (root.scrollWidth > innerWidth) found.push(`the page is ${root.scrollWidth} wide in ${innerWidth}`);
    for (const element of document.querySelectorAll('body *')) {
        const scrolls = ['auto', 'scroll'].includes(getComputedStyle(element).overflowX);
        if (scrolls && element.scrollWidth > element.clientWidth + 1 && element.getClientRects().length)
            found.push(`${element.tagName}.${element.className} scrolls sideways`);
    }
    return found;
})()";

/// What is cut with an ellipsis and has no title, or is cut without one.
const CUT: &str = "(() => {
    const found = [];
    for (const element of document.querySelectorAll('body *')) {
        if (!element.getClientRects().length || element.closest('.sr, svg')) continue;
        const style = getComputedStyle(element);
        const dots = style.textOverflow === 'ellipsis' && style.overflowX !== 'visible';
        const cut = element.scrollWidth > element.clientWidth + 1;
        if (dots && cut && !element.closest('[title]') && element.tagName !== 'INPUT')
            found.push(`.${element.className} has no title: ${element.textContent.slice(0, 40)}`);
        const own = [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
        if (own && !dots && cut && style.overflowX === 'hidden' && !['TEXTAREA', 'PRE'].includes(element.tagName))
            found.push(`${element.tagName}.${element.className} is cut without dots: ${element.textContent.slice(0, 40)}`);
    }
    return found;
})()";

/// Where only a part is seen of how saving goes, as long as it goes well.
const SAVING: &str = "[...document.querySelectorAll('.saving:not([data-offline])')].filter(said => said.scrollWidth > said.clientWidth + 1)
    .map(said => `only a part of “${said.textContent}” is seen`)";

/// What of the bar is beyond the edge of the window.
const BAR: &str = "[...document.querySelectorAll('.bar .tool, .bar .avatar')]
    .filter(button => button.getClientRects().length && button.getBoundingClientRect().right > innerWidth + 1)
    .map(button => `${button.getAttribute('aria-label') ?? button.textContent} is beyond the edge`)";

/// Where something else is on top of Stop.
const STOP: &str = "(() => {
    const stop = document.getElementById('stop');
    const box = stop.getBoundingClientRect();
    const found = [];
    if (box.width < 44 || box.height < 44) found.push(`Stop is ${box.width} by ${box.height}`);
    for (const [x, y] of [[0.5, 0.5], [0.1, 0.15], [0.9, 0.15], [0.1, 0.85], [0.9, 0.85]]) {
        const top = document.elementFromPoint(box.left + box.width * x, box.top + box.height * y);
        if (!top || !stop.contains(top)) found.push(`Stop is covered at ${x}, ${y} by ${top ? top.outerHTML.slice(0, 90) : 'the edge of the window'}`);
    }
    return found;
})()";

/// What moves by itself.
const MOVES: &str = "document.getAnimations().filter(motion => motion.playState === 'running').map(motion => \
    `${motion.animationName ?? motion.transitionProperty} moves on .${motion.effect?.target?.className?.baseVal ?? motion.effect?.target?.className}`)";

/// Every broken rule, with where it was.
pub(crate) async fn broken(page: &Page, place: &str) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for rule in [SIDEWAYS, CUT, SAVING, BAR, STOP] {
        found.extend(list(page, rule, place).await?);
    }
    Ok(found)
}

/// What moves although nothing should.
pub(crate) async fn moving(page: &Page, place: &str) -> Outcome<Vec<String>> {
    list(page, MOVES, place).await
}

/// The sentences that a script finds, each once, with where it was.
pub(crate) async fn list(page: &Page, script: &str, place: &str) -> Outcome<Vec<String>> {
    let found = page.eval(script).await?;
    let mut found: Vec<String> = found
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|line| Some(format!("{place}: {}", line.as_str()?)))
        .collect();
    found.sort();
    found.dedup();
    Ok(found)
}
