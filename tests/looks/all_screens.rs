//! Every screen at every size and theme: pictures in `target/looks`, and what holds everywhere. One walk for all of it, as most
//! of the work is to come to a screen and to be another size.

use crate::look::{DESKTOP, PHONE, SIZES, Window, colours, keeps_pictures, measures, set};
use crate::rules;
use crate::screens::{Stage, nothing, rests, walk};
use crate::words::Words;
use house::{Outcome, Page, skip};
use std::cell::RefCell;

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
async fn every_screen_keeps_the_rules_at_every_size_and_axe_finds_nothing() -> Outcome<()> {
    skip::unless!(ready("every screen at every size"));
    let stage = Stage::set().await?;
    let page = &stage.page;
    let found = RefCell::new(Vec::new());
    let walked = walk(page, &Words::english(), async |screen: &str| {
        for size in SIZES {
            set(page, &size).await?;
            let more = look(page, screen, &size).await?;
            found.borrow_mut().extend(more);
        }
        set(page, &DESKTOP).await
    })
    .await;
    let mut found = found.into_inner();
    found.sort();
    found.dedup();
    nothing("broken rules", &found)?;
    walked?;
    page.no_errors()
}

/// What breaks a rule on a screen at a size; pictures of some are kept before anything is scrolled.
async fn look(page: &Page, screen: &str, window: &Window) -> Outcome<Vec<String>> {
    let size = window.0;
    let mut found = rules::moving(page, &format!("{screen}, {size}")).await?;
    keep(page, screen, size).await?;
    if [PHONE.0, DESKTOP.0].contains(&size) {
        found.extend(colours(page, &format!("{screen}-{size}")).await?);
        page.theme(false).await?;
    }
    found.extend(measures(page, window, screen).await?);
    Ok(found)
}

/// Keeps pictures in light and dark.
async fn keep(page: &Page, screen: &str, size: &str) -> Outcome<()> {
    if !keeps_pictures() || !KEPT.contains(&screen) || size == "tablet-200" {
        return Ok(());
    }
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        rests(page).await?;
        page.screenshot(&house::target().join(format!("looks/{screen}-{size}-{theme}.png"))).await?;
    }
    Ok(())
}
