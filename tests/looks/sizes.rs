//! Every screen at every size and theme: pictures in `target/looks`, and what holds everywhere.

use crate::graphs::{self, Names};
use crate::look::{DESKTOP, PHONE, SIDEWAYS, TABLET, Window};
use crate::rules;
use crate::screens::{Stage, nothing, rests, usable, walk};
use crate::words::Words;
use house::{Outcome, Page, skip};
use std::cell::RefCell;

/// The windows of the design, and a desktop and a tablet at 200 %.
const SIZES: [Window; 6] =
    [DESKTOP, TABLET, PHONE, SIDEWAYS, ("desktop-200", 720, 450, false), ("tablet-200", 590, 410, false)];
/// The screens that are kept as pictures.
const KEPT: [&str; 7] = [
    "empty-library",
    "empty-program",
    "running",
    "robots",
    "operation-filter",
    "operation-map-help",
    "operation-combine-help",
];

#[tokio::test]
async fn every_screen_keeps_the_rules_at_every_size() -> Outcome<()> {
    if !skip::ready("every screen at every size") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.page;
    page.media("prefers-reduced-motion", "reduce").await?;
    let found = RefCell::new(Vec::new());
    let walked = walk(page, &Words::english(), async |screen: &str| {
        for (size, width, height, touch) in SIZES {
            page.size(width, height, touch).await?;
            page.frames().await?;
            let place = format!("{screen}, {size}");
            let mut broken = rules::broken(page, &place).await?;
            broken.extend(rules::moving(page, &place).await?);
            found.borrow_mut().extend(broken);
            keep(page, screen, size).await?;
        }
        page.size(1440, 900, false).await?;
        page.frames().await
    })
    .await;
    nothing("broken rules", &found.into_inner())?;
    walked?;
    page.no_errors()
}

/// Keeps pictures in light and dark.
async fn keep(page: &Page, screen: &str, size: &str) -> Outcome<()> {
    if !KEPT.contains(&screen) || size == "tablet-200" {
        return Ok(());
    }
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        rests(page).await?;
        page.screenshot(&house::target().join(format!("looks/{screen}-{size}-{theme}.png"))).await?;
    }
    Ok(())
}

#[tokio::test]
async fn few_and_many_streams_with_any_names_keep_the_rules() -> Outcome<()> {
    if !skip::ready("few and many streams") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.page;
    let mut found = Vec::new();
    for names in [Names::Short, Names::Long, Names::Japanese] {
        for count in [1, 12, 60] {
            let id = graphs::make(&stage.server, names, count).await?;
            page.goto(&format!("{}#/b/{id}", stage.server.url())).await?;
            page.reload().await?;
            usable(page).await?;
            for (size, width, height, touch) in SIZES {
                page.size(width, height, touch).await?;
                page.until(
                    "document.querySelector('h1').innerText.length > 8 && !document.querySelector('.library')",
                    "the program is open",
                )
                .await?;
                page.frames().await?;
                let place = format!("{count} {names:?}, {size}");
                found.extend(rules::broken(page, &place).await?);
                for (dark, theme) in [(true, "dark"), (false, "light")] {
                    page.theme(dark).await?;
                    let dark_too = size == DESKTOP.0 || size == SIDEWAYS.0;
                    if size != "tablet-200" && (dark_too || !dark) {
                        rests(page).await?;
                        let picture = format!("looks/many-{count}-{names:?}-{size}-{theme}.png");
                        page.screenshot(&house::target().join(picture)).await?;
                    }
                }
            }
            page.size(1440, 900, false).await?;
        }
    }
    nothing("broken rules", &found)?;
    page.no_errors()
}
