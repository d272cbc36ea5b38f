//! Edits while the robot runs: they disturb nothing until somebody applies them, and then the run goes on.

use house::{Outcome, skip};
use protocol::{RunPhase, RunState};

use crate::steps::*;
use crate::stop::running_ball;
use crate::visitor::Visitor;

#[tokio::test]
async fn edits_wait_until_they_are_applied_and_the_run_goes_on() -> Outcome<()> {
    if !skip::ready("journey: applying edits") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    let before = newest_run(&stage).await?;
    says(&aiko, "The robot runs this version").await?;

    // Ben adds something; Aiko sees that the robot runs what it ran.
    select(&ben, "Distance").await?;
    next(&ben, "Distance", "Tracker").await?;
    ben.find("button", "Tracker, *").await?;
    saved(&ben).await?;
    for page in [&aiko, &ben] {
        says(page, "The robot runs your older version").await?;
    }
    assert_eq!(newest_run(&stage).await?.revision, before.revision, "an edit disturbs nothing");

    aiko.within("region", "Robot").press("button", "Use my changes").await?;
    says(&aiko, "The robot goes on with version").await?;
    for page in [&aiko, &ben] {
        silent(page, ", editing ").await?;
        page.gone("button", "Use my changes").await?;
    }
    shows_value(&aiko, "Tracker").await?;
    let after = newest_run(&stage).await?;
    assert!(after.run == before.run && after.revision > before.revision, "the same run goes on");
    assert_eq!(after.phase, RunPhase::Running);
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn only_what_would_run_differently_is_an_edit() -> Outcome<()> {
    if !skip::ready("journey: what is an edit to what runs") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let run = newest_run(&stage).await?;

    // A helper that it uses makes a difference.
    aiko.press("button", "Edit helper").await?;
    aiko.press("menuitem", "Distance in cm*").await?;
    aiko.within("dialog", "Edit helper").fill("textbox", "Procedure", "1000").await?;
    save(&aiko, "Edit helper").await?;
    says(&aiko, "The robot runs an older helper").await?;
    aiko.within("region", "Robot").press("button", "Use my changes").await?;
    silent(&aiko, "The robot runs an older helper").await?;
    aiko.until("document.body.innerText.includes('1000')", "the new helper works").await?;

    // Where a stream stands is nothing to the robot, though it is saved as the next version.
    let ball = aiko.boxed("button", "Red ball, *").await?.centre();
    aiko.drag(ball, (ball.0 - 120.0, ball.1 + 40.0), 8).await?;
    let moved = format!("{}", run.revision + 1);
    says(&aiko, "The robot runs this version").await?;
    saved(&aiko).await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    assert_eq!(visitor.open_newest().await?.revision.to_string(), moved);
    silent(&aiko, ", editing ").await?;
    aiko.gone("button", "Use my changes").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

/// What runs, as somebody sees it who comes just now.
async fn newest_run(stage: &Stage) -> Outcome<RunState> {
    Visitor::enter(&stage.server).await?.newest_run().await
}
