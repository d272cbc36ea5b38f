//! Everything that can be pressed is large enough: 24 px for a mouse, 44 px for a finger.

use crate::rules::list;
use house::{Outcome, Page};

/// What is smaller than `least` on the screen, measured by where it can be hit. What stands in a graph that is seen from
/// farther away is as small as that: two fingers make it larger.
const SMALL: &str = "(async least => {
    const wanted = 'a[href], button, input, select, textarea, [role=button], [role=menuitem], [tabindex=\"0\"]';
    const found = [];
    const frame = () => new Promise(done => requestAnimationFrame(done));
    const dialog = document.querySelector('[role=dialog]');
    const world = document.querySelector('.world');
    const far = world && new DOMMatrix(getComputedStyle(world).transform).a < 0.95;
    for (const element of document.querySelectorAll(wanted)) {
        if (element.disabled || (dialog && !dialog.contains(element) && element.id !== 'stop')) continue;
        if (far && world.contains(element)) continue;
        if (!element.getClientRects().length || getComputedStyle(element).visibility === 'hidden') continue;
        if (element.matches('.link') && getComputedStyle(element.parentElement).display !== 'grid' && element.parentElement.textContent.trim() !== element.textContent.trim()) continue;
        const target = element.closest('label') ?? element;
        let box = target.getBoundingClientRect();
        if (box.width >= least && box.height >= least) continue;
        const around = Math.max(0, least - box.height) / 2 + 1;
        if (box.top < around || box.bottom > innerHeight - around) { target.scrollIntoView({ block: 'center' }); await frame(); box = target.getBoundingClientRect(); }
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

/// What on the page is too small for a mouse, or for fingers.
pub(crate) async fn small(page: &Page, touch: bool, place: &str) -> Outcome<Vec<String>> {
    let least = if touch { 44 } else { 24 };
    list(page, &format!("{SMALL}({least})"), place).await
}
