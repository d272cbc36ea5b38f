//! Two people with a robot each: what one starts, stops and moves leaves the other's robot alone.

use house::{Outcome, Page, skip};

use crate::steps::*;

#[tokio::test]
async fn two_robots_run_the_same_program_and_each_has_its_stop() -> Outcome<()> {
    skip::unless!(ready("journey: two robots"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Distance in cm").await?;
    next(&aiko, "Distance", "Tracker").await?;
    aiko.find("button", "Tracker, *").await?;
    saved(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;

    add_robot(&ben, "Momo").await?;
    aiko.find("button", "Robot: Simulated NAO").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Tracker").await?;
    ben.find("button", "Start").await?;
    silent(&ben, "Running").await?;
    start(&ben).await?;
    shows_value(&ben, "Tracker").await?;

    // Stop stops the robot that one looks at.
    stop(&ben).await?;
    at_rest(&ben).await?;
    aiko.find("button", "Running").await?;
    shows_value(&aiko, "Tracker").await?;
    look_at(&ben, "Simulated NAO*").await?;
    ben.find("button", "Running").await?;
    shows_value(&ben, "Tracker").await?;
    aiko.press("button", "Remove program").await?;
    says(&aiko, "It runs on “Simulated NAO”; stop it there first.").await?;
    aiko.key("Escape").await?;

    // Everything on all robots, from one place.
    look_at(&ben, "Momo*").await?;
    start(&ben).await?;
    ben.press("button", "Robot: Momo").await?;
    ben.press("menuitem", "Stop all robots").await?;
    at_rest(&aiko).await?;
    at_rest(&ben).await?;

    // Who looks at a robot that somebody removes is told, and looks at another one.
    look_at(&aiko, "Momo*").await?;
    aiko.find("button", "Robot: Momo").await?;
    ben.press("button", "Robot: Momo").await?;
    ben.press("menuitem", "Remove “Momo”").await?;
    ben.within("dialog", "Remove “Momo”?").press("button", "Remove").await?;
    says(&aiko, "“Momo” is gone. This page looks at “Simulated NAO” now.").await?;
    aiko.find("button", "Robot: Simulated NAO").await?;
    calm(&aiko)?;
    calm(&ben)
}

pub(crate) async fn add_robot(page: &Page, name: &str) -> Outcome<()> {
    page.press("button", "Robot: Simulated NAO").await?;
    page.press("menuitem", "Add a simulated robot").await?;
    page.within("dialog", "Add a simulated robot").fill("textbox", "Name", name).await?;
    page.within("dialog", "Add a simulated robot").press("button", "Create").await?;
    page.find("button", &format!("Robot: {name}")).await.map(drop)
}

pub(crate) async fn look_at(page: &Page, name: &str) -> Outcome<()> {
    page.press("button", "Robot: *").await?;
    page.press("menuitemradio", name).await
}
