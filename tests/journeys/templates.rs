//! Every template opens without a problem and runs.

use house::{Outcome, Page, skip};

use crate::steps::*;

const TEMPLATES: usize = 12;
/// The items of the menu that are no templates.
const OTHERS: [&str; 3] = ["All programs and templates …", "Open a file …", "Save as file …"];

#[tokio::test]
async fn every_template_runs_and_shows_values() -> Outcome<()> {
    skip::unless!(ready("journey: templates"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    let names = offered(&aiko).await?;
    assert_eq!(names.len(), TEMPLATES, "{names:?}");
    aiko.key("Escape").await?;
    aiko.gone("menu", "Load program").await?;
    for name in &names {
        runs(&aiko, name).await?;
    }
    calm(&aiko)
}

/// The templates in the Load program menu, which stays open.
async fn offered(page: &Page) -> Outcome<Vec<String>> {
    page.press("button", "Load program").await?;
    page.find("menuitem", OTHERS[0]).await?;
    let items = page.within("menu", "Load program").find_all("menuitem", "").await?;
    Ok(items.into_iter().map(|item| item.name).filter(|name| !OTHERS.contains(&name.as_str())).collect())
}

/// Everything as at first, and somebody comes in: then every sense has something to notice.
async fn tidy_room(page: &Page) -> Outcome<()> {
    page.press("button", "Reset room").await?;
    page.press("button", "Person in").await?;
    page.find("button", "Person out").await.map(drop)
}

async fn runs(page: &Page, template: &str) -> Outcome<()> {
    tidy_room(page).await?;
    let before = page.address().await?;
    page.press("button", "Load program").await?;
    page.within("menu", "Load program").press("menuitem", template).await?;
    let elsewhere = format!("location.href !== '{before}' && document.querySelectorAll('[data-node]').length > 1");
    page.until(&elsewhere, &format!("“{template}” is open")).await?;
    saved(page).await?;
    let problems = page.eval("document.querySelectorAll('.badge.blocks').length").await?;
    assert_eq!(problems, 0, "“{template}” has a problem that blocks");
    start(page).await?;
    page.press("button", "Touch head").await?;
    let value = "document.querySelector('.world .value b')?.textContent";
    page.until(value, &format!("“{template}” shows a value")).await?;
    stop(page).await?;
    at_rest(page).await
}
