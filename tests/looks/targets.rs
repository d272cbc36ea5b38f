//! Everything that can be pressed is large enough: 24 px for a mouse, 44 px for a finger.

use crate::rules::list;
use crate::screens::{Stage, nothing, walk};
use house::{Outcome, skip};
use std::cell::RefCell;

/// What is smaller than `least` on the screen, measured by where it can be hit.
pub(crate) const SMALL: &str = "(async least => {
    const wanted = 'a[href], button, input, select, textarea, [role=button], [role=menuitem], [tabindex=\"0\"]';
    const found = [];
    const frame = () => new Promise(done => requestAnimationFrame(done));
    const dialog = document.querySelector('[role=dialog]');
    for (const element of document.querySelectorAll(wanted)) {
        if (element.disabled || (dialog && !dialog.contains(element) && element.id !== 'stop')) continue;
        if (!element.getClientRects().length || getComputedStyle(element).visibility === 'hidden') continue;
        if (element.matches('.link') && getComputedStyle(element.parentElement).display !== 'grid' && element.parentElement.textContent.trim() !== element.textContent.trim()) continue;
        const target = element.closest('label') ?? element;
        let box = target.getBoundingClientRect();
        if (box.width >= least && box.height >= least) continue;
        if (box.top < 0 || box.bottom > innerHeight) { target.scrollIntoView({ block: 'center' }); await frame(); box = target.getBoundingClientRect(); }
        const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
        const hits = (dx, dy) => { const top = document.elementFromPoint(x + dx, y + dy); return top && (target.contains(top) || top.contains(target) && top.matches('g, label')); };
        if (!hits(0, 0)) continue;
        const reach = (dx, dy) => { let far = 0; while (far < least / 2 && hits(dx * (far + 1), dy * (far + 1))) far += 1; return far; };
        const [width, height] = [reach(1, 0) + reach(-1, 0) + 1, reach(0, 1) + reach(0, -1) + 1];
        if (Math.max(width, box.width) < least - 1 || Math.max(height, box.height) < least - 1)
            found.push(`${element.tagName}.${element.getAttribute('class') ?? ''} “${(element.getAttribute('aria-label') ?? element.textContent).trim().slice(0, 30)}” is ${box.width.toFixed(0)} by ${box.height.toFixed(0)}`);
    }
    return found;
})";

#[tokio::test]
async fn whatever_can_be_pressed_is_large_enough() -> Outcome<()> {
    if !skip::ready("the size of what can be pressed") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.page;
    let found = RefCell::new(Vec::new());
    let walked = walk(page, async |screen: &str| {
        let fine = list(page, &format!("{SMALL}(24)"), &format!("{screen}, mouse")).await?;
        found.borrow_mut().extend(fine);
        for (size, width, height) in [("tablet", 1180, 820), ("phone", 390, 844)] {
            page.size(width, height, true).await?;
            page.until("matchMedia('(pointer: coarse)').matches", "fingers point").await?;
            let coarse = list(page, &format!("{SMALL}(44)"), &format!("{screen}, finger, {size}")).await?;
            found.borrow_mut().extend(coarse);
        }
        page.size(1440, 900, false).await?;
        page.until("!matchMedia('(pointer: coarse)').matches", "no fingers point").await.map(drop)
    })
    .await;
    nothing("small targets", &found.into_inner())?;
    walked
}
