//! Every screen in Japanese, in every window: nothing cut, nothing sideways, targets as large as in English, axe; and
//! pictures in `target/looks/ja`.

use crate::axe::check_by;
use crate::corners;
use crate::look::{DESKTOP, PHONE, WINDOWS, Window, keeps_pictures, measures, set};
use crate::screens::{Stage, nothing, rests, walk};
use crate::words::Words;
use house::{Outcome, Page, Rules, skip};
use std::cell::RefCell;

#[tokio::test]
async fn every_screen_keeps_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("every screen in Japanese"));
    let words = Words::japanese()?;
    let stage = Stage::set_in(&words).await?;
    let page = &stage.page;
    page.until("document.documentElement.lang === 'ja'", "the page speaks Japanese").await?;
    let found = RefCell::new(Vec::new());
    let walked = walk(page, &words, async |screen: &str| {
        let more = look(page, screen, &WINDOWS).await?;
        found.borrow_mut().extend(more);
        Ok(())
    })
    .await;
    let mut found = found.into_inner();
    found.extend(walked.err().map(|trouble| trouble.to_string()));
    nothing("findings in Japanese", &found)?;
    page.no_errors()
}

#[tokio::test]
async fn small_dialogs_and_menus_keep_the_rules_in_japanese() -> Outcome<()> {
    skip::unless!(ready_in_japanese("small dialogs and menus in Japanese"));
    let words = Words::japanese()?;
    let found = RefCell::new(Vec::new());
    for canvas in [false, true] {
        let stage = Stage::set_in(&words).await?;
        let page = &stage.page;
        let visit = async |state: &str, windows: &[Window]| {
            let more = look(page, state, windows).await?;
            found.borrow_mut().extend(more);
            Ok(())
        };
        let walked = if canvas {
            corners::moments(page, &words, visit).await
        } else {
            corners::dialogs(page, &words, visit).await
        };
        found.borrow_mut().extend(walked.err().map(|trouble| trouble.to_string()));
        page.no_errors()?;
    }
    nothing("findings in Japanese", &found.into_inner())
}

/// Looks at a state in these windows, keeps a picture of each, and leaves the page on a desktop. Colours are as in English.
async fn look(page: &Page, state: &str, windows: &[Window]) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for window in windows {
        set(page, window).await?;
        found.extend(measures(page, window, state).await?);
        if window.0 == DESKTOP.0 || window.0 == PHONE.0 {
            found.extend(check_by(page, Rules::AllButColours, &format!("{state}, {}", window.0)).await?);
        }
        if keeps_pictures() {
            page.theme(window.0 == PHONE.0).await?;
            rests(page).await?;
            page.screenshot(&house::target().join(format!("looks/ja/{state}-{}.png", window.0))).await?;
            page.theme(false).await?;
        }
    }
    set(page, &DESKTOP).await?;
    Ok(found)
}
