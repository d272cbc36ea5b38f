//! Two programs on one robot want its head: the upper one wins, everybody sees it, and people change the order.

use house::{Outcome, Page, skip};

use crate::steps::*;

#[tokio::test]
async fn of_two_programs_the_upper_one_moves_the_head() -> Outcome<()> {
    if !skip::ready("journey: two programs on one robot") {
        return Ok(());
    }
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
    // Stopping one lets the other go on.
    aiko.press("button", "Stop “Greeting”").await?;
    silent(&aiko, "is held by").await?;
    aiko.find("button", "Running").await?;
    shows_value(&aiko, "Tracker").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

/// A program that follows the ball with the head, and runs.
async fn follower(page: &Page, name: &str) -> Outcome<()> {
    add_program(page, name).await?;
    add_sense(page, "RedBall").await?;
    next(page, "RedBall", "distance").await?;
    page.find("button", "Distance, stream").await?;
    next(page, "Distance", "Tracker").await?;
    page.find("button", "Tracker, *").await?;
    saved(page).await?;
    start(page).await?;
    shows_value(page, "Tracker").await.map(drop)
}
