//! Programs of one stream and of sixty, with any names, at every size: what holds everywhere, and pictures in `target/looks`.

use crate::graphs::{self, Names};
use crate::look::{DESKTOP, SIDEWAYS, SIZES};
use crate::rules;
use crate::screens::{Stage, nothing, rests, usable};
use house::{Outcome, skip};

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
