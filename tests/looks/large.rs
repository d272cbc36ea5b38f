//! Programs of many parts that nobody placed: they fill the stage, can be read at fit, and 100 % lands on something.

use crate::floats::COVERED;
use crate::graphs;
use crate::look::{DESKTOP, SIDEWAYS, TABLET, keeps_pictures};
use crate::rules::{self, list};
use crate::screens::{Stage, fit, nothing, rests, usable};
use house::{Outcome, Page, skip};

/// Streams that cover each other, at most a few of them.
const OVERLAPS: &str = "(() => {
    const boxes = [...document.querySelectorAll('#stage .stream')].map(stream => [stream.dataset.node, stream.getBoundingClientRect()]);
    const found = [];
    for (let one = 0; one < boxes.length; one++) for (let other = one + 1; other < boxes.length && found.length < 4; other++) {
        const [[a, at], [b, by]] = [boxes[one], boxes[other]];
        if (at.left < by.right - 1 && by.left < at.right - 1 && at.top < by.bottom - 1 && by.top < at.bottom - 1) found.push(`${a} covers ${b}`);
    }
    return found;
})()";

/// Texts on the graph of less than 9 pixels as they are seen.
const SMALL: &str = "(() => {
    const world = document.querySelector('#stage .world');
    const zoom = new DOMMatrix(getComputedStyle(world).transform).a;
    return [...world.querySelectorAll('.name, .second, .word, .detail')]
        .filter(text => text.textContent.trim() && text.getClientRects().length && parseFloat(getComputedStyle(text).fontSize) * zoom < 8.95)
        .map(text => `“${text.textContent}” is ${(parseFloat(getComputedStyle(text).fontSize) * zoom).toFixed(1)} pixels high`);
})()";

/// How the graph lies on the stage: its width and height as shares of it, and how many streams are whole in view and under
/// nothing.
const LIES: &str = "(() => {
    const stage = document.getElementById('stage').getBoundingClientRect();
    const told = document.querySelector('.told')?.getBoundingClientRect().bottom ?? stage.top;
    const boxes = [...document.querySelectorAll('#stage .stream')].map(stream => stream.getBoundingClientRect());
    const least = of => Math.min(...boxes.map(of)), most = of => Math.max(...boxes.map(of));
    const whole = boxes.filter(box => box.left >= stage.left && box.right <= stage.right && box.top >= told && box.bottom <= stage.bottom);
    return { wide: (most(box => box.right) - least(box => box.left)) / stage.width, high: (most(box => box.bottom) - least(box => box.top)) / stage.height, whole: whole.length };
})()";

#[tokio::test]
async fn many_parts_fill_the_stage_and_can_be_read() -> Outcome<()> {
    skip::unless!(ready("many parts"));
    let stage = Stage::set().await?;
    let page = &stage.page;
    let mut found = Vec::new();
    for count in [20, 60, 300, 2_000] {
        let id = graphs::make_parts(&stage.server, count).await?;
        for (size, width, height, touch) in [DESKTOP, TABLET, SIDEWAYS] {
            page.size(width, height, touch).await?;
            page.goto(&format!("{}#/b/{id}", stage.server.url())).await?;
            page.reload().await?;
            usable(page).await?;
            page.until(
                "document.querySelectorAll('#stage .stream').length > 0 && !document.querySelector('.library')",
                "there are streams",
            )
            .await?;
            page.until("!!document.querySelector('.about .panel')", "the second piece, which lays out, is here")
                .await?;
            let place = format!("{count} in {size}");
            fit(page).await?;
            let lies = page.eval(LIES).await?;
            let share = |what: &str| lies[what].as_f64().unwrap_or_default();
            if lies["whole"].as_u64() != Some(count as u64) {
                found.push(format!("{place}: {} of {count} are seen at fit", lies["whole"]));
            }
            if share("wide").max(share("high")) < 0.6 && count > 20 {
                found.push(format!(
                    "{place}: the graph takes {:.2} by {:.2} of the stage",
                    share("wide"),
                    share("high")
                ));
            }
            if share("wide").min(share("high")) < 0.35 {
                found.push(format!(
                    "{place}: the graph is a strip, {:.2} by {:.2} of the stage",
                    share("wide"),
                    share("high")
                ));
            }
            found.extend(list(page, COVERED, &place).await?);
            if count <= 300 {
                found.extend(list(page, OVERLAPS, &place).await?);
            }
            if count == 20 && size == DESKTOP.0 {
                found.extend(list(page, SMALL, &place).await?);
            }
            found.extend(rules::broken(page, &place).await?);
            keep(page, &format!("parts-{count}-{size}")).await?;
            page.eval("document.querySelector('.zoom .percent').click()").await?;
            rests(page).await?;
            page.until(
                "document.querySelector('.zoom .percent').innerText.startsWith('100')",
                "it is as large as it is",
            )
            .await?;
            rests(page).await?;
            if page.eval(LIES).await?["whole"].as_u64().is_none_or(|whole| whole == 0) {
                found.push(format!("{place}: 100 % lands on nothing"));
            }
        }
    }
    page.size(1440, 900, false).await?;
    nothing("faults of large programs", &found)?;
    page.no_errors()
}

async fn keep(page: &Page, name: &str) -> Outcome<()> {
    if !keeps_pictures() {
        return Ok(());
    }
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        page.screenshot(&house::target().join(format!("looks/{name}-{theme}.png"))).await?;
    }
    Ok(())
}
