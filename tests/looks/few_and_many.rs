//! Programs of one stream and of sixty, with any names, at every size: what holds everywhere, and pictures in `target/looks`.

use crate::graphs::{self, Names};
use crate::look::{DESKTOP, SIDEWAYS, SIZES, keeps_pictures};
use crate::rules;
use crate::screens::{Stage, nothing, rests, usable};
use house::{Outcome, Page, skip};

#[tokio::test]
async fn few_and_many_streams_with_any_names_keep_the_rules() -> Outcome<()> {
    skip::unless!(ready("few and many streams"));
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
                keep(page, &format!("many-{count}-{names:?}"), size).await?;
            }
            page.size(1440, 900, false).await?;
        }
    }
    nothing("broken rules", &found)?;
    page.no_errors()
}

/// Keeps a picture in light, and in the lowest and the largest window one in dark.
async fn keep(page: &Page, name: &str, size: &str) -> Outcome<()> {
    if !keeps_pictures() || size == "tablet-200" {
        return Ok(());
    }
    for (dark, theme) in [(true, "dark"), (false, "light")] {
        page.theme(dark).await?;
        if !dark || size == DESKTOP.0 || size == SIDEWAYS.0 {
            rests(page).await?;
            page.screenshot(&house::target().join(format!("looks/{name}-{size}-{theme}.png"))).await?;
        }
    }
    Ok(())
}
