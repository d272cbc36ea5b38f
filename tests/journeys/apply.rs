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
    says(&aiko, &format!("Running version {}", before.revision)).await?;

    // Ben adds something; Aiko sees that the robot runs what it ran.
    select(&ben, "Distance").await?;
    next(&ben, "Distance", "Tracker").await?;
    ben.find("button", "Tracker, *").await?;
    saved(&ben).await?;
    for page in [&aiko, &ben] {
        says(page, &format!("Running version {}, editing ", before.revision)).await?;
    }
    assert_eq!(newest_run(&stage).await?.revision, before.revision, "an edit disturbs nothing");

    aiko.press("button", "Apply to the running robot").await?;
    says(&aiko, "The robot goes on with version").await?;
    for page in [&aiko, &ben] {
        silent(page, ", editing ").await?;
        page.gone("button", "Apply to the running robot").await?;
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

/// What runs, as somebody sees it who comes just now.
async fn newest_run(stage: &Stage) -> Outcome<RunState> {
    Visitor::enter(&stage.server).await?.newest_run().await
}
