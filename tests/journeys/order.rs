//! Two programs on one robot want its head: the upper one wins, everybody sees it, and people change the order.

use house::{Outcome, Page, skip};

use crate::steps::*;

#[tokio::test]
async fn of_two_programs_the_upper_one_moves_the_head() -> Outcome<()> {
    skip::unless!(ready("journey: two programs on one robot"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    follower(&aiko, "Greeting").await?;
    silent(&aiko, "Runs on the robot").await?;
    follower(&aiko, "Idle").await?;
    says(&aiko, "If they disagree, the upper one wins.").await?;
    says(&aiko, "The head is held by “Greeting”.").await?;
    says(&aiko, "Holds the head; “Idle” waits.").await?;
    aiko.press("button", "Move “Idle” up").await?;
    says(&aiko, "The head is held by “Idle”.").await?;
    silent(&aiko, "The head is held by “Greeting”.").await?;
    aiko.press("button", "Move “Idle” down").await?;
    says(&aiko, "The head is held by “Greeting”.").await?;
    silent(&aiko, "The head is held by “Idle”.").await?;
    // It stands at the connector too.
    aiko.until("document.querySelector('.fault.held')?.textContent.includes('held by “Greeting”')", "it says so")
        .await?;
    // The same by hand: with the mouse, then with a finger.
    drag_above(&aiko, "Idle", "Greeting", Page::drag).await?;
    says(&aiko, "The head is held by “Idle”.").await?;
    aiko.size(1180, 820, true).await?;
    drag_above(&aiko, "Greeting", "Idle", Page::touch_drag).await?;
    says(&aiko, "The head is held by “Greeting”.").await?;
    aiko.size(1440, 900, false).await?;
    // Stopping one lets the other go on.
    aiko.press("button", "Stop “Greeting”").await?;
    silent(&aiko, "is held by").await?;
    aiko.find("button", "Running").await?;
    shows_value(&aiko, "Tracker").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

/// Takes a program in the list by its name and lets it go over another one.
async fn drag_above(
    page: &Page,
    moved: &str,
    target: &str,
    drag: impl AsyncFn(&Page, (f64, f64), (f64, f64), u32) -> Outcome<()>,
) -> Outcome<()> {
    let (from, to) = (grip(page, moved).await?, grip(page, target).await?);
    drag(page, from, to, 8).await
}

/// Where the name of a program is in the list of what runs.
async fn grip(page: &Page, name: &str) -> Outcome<(f64, f64)> {
    let js = format!(
        "(() => {{ const grip = [...document.querySelectorAll('.running .grip')].find(one => one.innerText === '{name}'); \
         const box = grip && grip.getBoundingClientRect(); return box && [box.x + 20, box.y + box.height / 2]; }})()"
    );
    let at = page.until(&js, &format!("“{name}” is in the list")).await?;
    Ok((at[0].as_f64().unwrap_or_default(), at[1].as_f64().unwrap_or_default()))
}

/// A program that follows the ball with the head, and runs.
async fn follower(page: &Page, name: &str) -> Outcome<()> {
    add_program(page, name).await?;
    add_sense(page, "Red ball").await?;
    next(page, "Red ball", "Distance in cm").await?;
    page.find("button", "Distance, stream").await?;
    next(page, "Distance", "Tracker").await?;
    page.find("button", "Tracker, *").await?;
    saved(page).await?;
    start(page).await?;
    shows_value(page, "Tracker").await.map(drop)
}
