//! Edits while the robot runs: they disturb nothing until somebody applies them, and then the run goes on.

use house::{Outcome, skip};
use protocol::{RunPhase, RunState};

use crate::steps::*;
use crate::stop::running_ball;
use crate::together::call_myself;
use crate::visitor::Visitor;

#[tokio::test]
async fn edits_wait_until_they_are_applied_and_the_run_goes_on() -> Outcome<()> {
    skip::unless!(ready("journey: applying edits"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
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

    // Whose it is is said before anybody lets the robot do it.
    says(&aiko, "Ben added Tracker").await?;
    ben.within("region", "Robot").find("button", "Use my changes").await?;
    aiko.within("region", "Robot").press("button", "Use Ben’s changes").await?;
    says(&aiko, "The robot goes on with version").await?;
    for page in [&aiko, &ben] {
        silent(page, ", editing ").await?;
        page.gone("button", "Use *").await?;
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
    skip::unless!(ready("journey: what is an edit to what runs"));
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

#[tokio::test]
async fn what_somebody_else_is_still_at_is_not_started_by_a_press() -> Outcome<()> {
    skip::unless!(ready("journey: an unfinished change of somebody else"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    let before = newest_run(&stage).await?;
    select(&ben, "Distance").await?;
    next(&ben, "Distance", "filter").await?;
    ben.within("dialog", "Operation").fill("textbox", "Procedure", "distance < 40").await?;
    save(&ben, "Operation").await?;
    ben.press("button", "filter (distance < 40), connector*").await?;
    next(&ben, "filter", "More…").await?;
    ben.within("dialog", "Operation").find("textbox", "Procedure").await?;
    says(&aiko, "Ben is still editing Distance < 40").await?;
    aiko.within("region", "Robot").press("button", "Use Ben’s changes").await?;
    says(&aiko, "The robot goes on as before").await?;
    assert_eq!(newest_run(&stage).await?.revision, before.revision, "the robot does what it did");
    ben.key("Escape").await?;
    ben.gone("dialog", "Operation").await?;
    silent(&aiko, "Ben is still editing Distance < 40").await?;
    aiko.within("region", "Robot").press("button", "Use Ben’s changes").await?;
    says(&aiko, "The robot goes on with version").await?;

    // A number, from what to what.
    ben.press("button", "filter (distance < 40), connector*").await?;
    ben.until("!!document.querySelector('.flyout .stepper input')", "the control is there").await?;
    ben.eval("document.querySelector('.flyout .stepper input').focus(), document.querySelector('.flyout .stepper input').select(), 0").await?;
    ben.type_text("60").await?;
    ben.key("Enter").await?;
    ben.eval("document.activeElement.blur(), 0").await?;
    says(&aiko, "Ben changed Distance < 60: 40\u{a0}cm → 60\u{a0}cm").await?;
    stop(&aiko).await?;
    calm(&ben)?;
    calm(&aiko)
}
