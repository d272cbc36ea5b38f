//! A real robot, as far as libqi and a stand-in are one: added by its address, run, stopped, gone and back.

use house::{Outcome, Page, StandIn, skip};

use crate::steps::*;

/// Opens the dialog and types an address.
pub(crate) async fn add_at(page: &Page, address: &str) -> Outcome<()> {
    page.press("button", "Robot: *").await?;
    page.press("menuitem", "Add a NAO or Pepper").await?;
    let dialog = page.within("dialog", "Add a NAO or Pepper");
    dialog.fill("textbox", "Address", address).await?;
    dialog.fill("textbox", "Name", "Blue").await?;
    dialog.press("button", "Add").await
}

#[tokio::test]
async fn a_robot_is_added_by_its_address_and_runs_the_same_program() -> Outcome<()> {
    skip::unless!(ready("journey: a real robot"));
    let Some(robot) = StandIn::start("journey: a real robot", &[])? else { return Ok(()) };
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Distance in cm").await?;
    next(&aiko, "Distance", "Tracker").await?;
    aiko.find("button", "Tracker, *").await?;
    saved(&aiko).await?;

    add_at(&aiko, robot.address()).await?;
    aiko.find("button", "Robot: Blue").await?;
    says(&aiko, "is a NAO").await?;
    says(&aiko, "on “Blue”").await?;
    says(&aiko, "Lives by itself").await?;
    aiko.press("button", "Robot: Blue").await?;
    aiko.press("menuitem", "Take control").await?;
    says(&aiko, "Own life off").await?;
    says(&aiko, "Awake").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Tracker").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;

    // It goes away while a program runs: that is interrupted, says why, and does not go on by itself.
    start(&aiko).await?;
    let port = robot.address().rsplit(':').next().unwrap_or_default().to_owned();
    drop(robot);
    says(&aiko, "The robot cannot be reached").await?;
    aiko.find("button", "Continue").await?;
    let back = StandIn::start("journey: a real robot", &["--port", &port])?;
    silent(&aiko, "cannot be reached").await?;
    says(&aiko, "Interrupted: the connection to it was lost").await?;
    aiko.find("button", "Continue").await?;
    // A robot that starts has its services one by one: Aiko presses the button again until all that is needed is there.
    let again = "(() => {
        const start = document.querySelector('.start');
        if (start.getAttribute('aria-pressed') === 'true') return true;
        const now = Date.now();
        if (!start.disabled && now - (window.pressed ?? 0) > 2000) { window.pressed = now; start.click(); }
        return false;
    })()";
    aiko.until(again, "it runs again").await?;
    shows_value(&aiko, "Tracker").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    drop(back);
    calm(&aiko)
}

#[tokio::test]
async fn a_robot_that_is_not_there_says_which_step_failed() -> Outcome<()> {
    skip::unless!(ready("journey: no robot there"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    // Nobody listens there.
    add_at(&aiko, "127.0.0.1:9").await?;
    says(&aiko, "Its name: went well").await?;
    says(&aiko, "Reaching it: failed").await?;
    aiko.within("dialog", "Add a NAO or Pepper").find("button", "Add anyway").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Add a NAO or Pepper").await?;
    aiko.find("button", "Robot: Simulated NAO").await?;
    calm(&aiko)
}
