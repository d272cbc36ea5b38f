//! axe finds nothing, on any screen, in light and dark, on a desktop and on a phone.

use crate::screens::{Stage, nothing, rests, walk};
use house::{Outcome, Page, skip};
use std::cell::RefCell;

#[tokio::test]
async fn axe_finds_nothing_on_any_screen() -> Outcome<()> {
    if !skip::ready("axe on every screen") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.page;
    let found = RefCell::new(Vec::new());
    let walked = walk(page, async |screen: &str| {
        for dark in [false, true] {
            page.theme(dark).await?;
            rests(page).await?;
            let place = format!("{screen}, {}", if dark { "dark" } else { "light" });
            let more = check(page, &place).await?;
            found.borrow_mut().extend(more);
        }
        page.size(390, 844, true).await?;
        rests(page).await?;
        let more = check(page, &format!("{screen}, phone, dark")).await?;
        found.borrow_mut().extend(more);
        page.theme(false).await?;
        rests(page).await?;
        let more = check(page, &format!("{screen}, phone, light")).await?;
        found.borrow_mut().extend(more);
        page.size(1440, 900, false).await?;
        rests(page).await
    })
    .await;
    let mut found = found.into_inner();
    found.sort();
    found.dedup();
    nothing("findings of axe", &found)?;
    walked?;
    page.no_errors()
}

pub(crate) async fn check(page: &Page, place: &str) -> Outcome<Vec<String>> {
    let violations = page.axe("").await?;
    let line = |violation: house::Violation| {
        let nodes = violation.nodes.join("\n      ");
        format!("{place}: {} ({}): {}\n      {nodes}", violation.rule, violation.impact, violation.help)
    };
    Ok(violations.into_iter().map(line).collect())
}
