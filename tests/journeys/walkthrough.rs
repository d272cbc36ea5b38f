//! The thesis's walkthrough (figures 6.2 to 6.15), by its words, with somebody looking on from another browser.

use house::{Outcome, Page, skip};
use robot::{JOINTS, Scene};

use crate::steps::*;
use crate::visitor::Visitor;

/// Everything on the canvas at the end.
const ALL: [&str; 7] = [
    "Red ball, sensor stream",
    "map (Distance in cm), connector*",
    "DistanceToBall, stream",
    "filter (distanceToBall < 60), connector*",
    "Close balls, stream",
    "subscribe, connector*",
    "Tracker, *",
];

#[tokio::test]
async fn the_walkthrough_of_the_thesis() -> Outcome<()> {
    skip::unless!(ready("journey: walkthrough"));
    let mut stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Follow close balls").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.find("heading", "Add a sense to begin").await?;

    add_red_ball(&aiko).await?;
    sees(&ben, &ALL[..1]).await?;
    map_to_distance(&aiko).await?;
    sees(&ben, &ALL[..3]).await?;
    filter_close_balls(&aiko).await?;
    sees(&ben, &ALL[..5]).await?;
    lead_to_tracker(&aiko).await?;
    sees(&ben, &ALL).await?;
    edit_tracker(&aiko).await?;
    says(&ben, "left arm").await?;

    start(&aiko).await?;
    ben.find("button", "Running").await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    drag_the_ball(&aiko, &mut visitor).await?;
    for person in [&aiko, &ben] {
        for stream in ["Red ball", "DistanceToBall", "Close balls"] {
            shows_value(person, stream).await?;
        }
        calm(person)?;
    }
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    at_rest(&ben).await?;

    aiko.reload().await?;
    usable(&aiko).await?;
    sees(&aiko, &ALL).await?;
    calm(&aiko)?;
    stage.server.kill9().await?;
    for person in [&aiko, &ben] {
        says(person, "Offline").await?;
    }
    stage.server.restart().await?;
    for person in [&aiko, &ben] {
        saved(person).await?;
        silent(person, "Offline").await?;
        sees(person, &ALL).await?;
        calm_but_lost(person)?;
    }
    Ok(())
}

async fn add_red_ball(page: &Page) -> Outcome<()> {
    page.press("button", "Add sensor").await?;
    page.press("menuitem", "Red ball").await?;
    sees(page, &ALL[..1]).await
}

async fn map_to_distance(page: &Page) -> Outcome<()> {
    thunderbolt(page, "Red ball", "map").await?;
    let dialog = page.within("dialog", "Operation");
    dialog.press("radio", "Use a helper").await?;
    choose(page, "Helper", "Distance in c", "distance").await?;
    dialog.fill("textbox", "Output stream name", "DistanceToBall").await?;
    save(page, "Operation").await?;
    sees(page, &ALL[..3]).await
}

async fn filter_close_balls(page: &Page) -> Outcome<()> {
    thunderbolt(page, "DistanceToBall", "filter").await?;
    let dialog = page.within("dialog", "Operation");
    dialog.fill("textbox", "Procedure", "distancetoball < 60").await?;
    dialog.press("button", "Change distancetoball to distanceToBall").await?;
    assert_eq!(dialog.text("textbox", "Procedure").await?, "distanceToBall < 60");
    dialog.fill("textbox", "Output stream name", "Close balls").await?;
    save(page, "Operation").await?;
    sees(page, &ALL[..5]).await
}

async fn lead_to_tracker(page: &Page) -> Outcome<()> {
    thunderbolt(page, "Close balls", "subscribe").await?;
    choose(page, "Actuator", "Tracker", "new:Tracker").await?;
    save(page, "Operation").await?;
    sees(page, &ALL).await
}

async fn edit_tracker(page: &Page) -> Outcome<()> {
    select(page, "Tracker").await?;
    next(page, "Tracker", "Edit").await?;
    page.within("dialog", "Tracker settings").press("radio", "head").await?;
    choose(page, "Arm", "left", "LArm").await?;
    save(page, "Tracker settings").await?;
    says(page, "left arm").await
}

/// Drags the red ball to the robot's left, then to its right, in small steps; the head follows.
async fn drag_the_ball(page: &Page, visitor: &mut Visitor) -> Outcome<()> {
    let (x, y) = page.boxed("image", "Red ball").await?.centre();
    let before = ball(&visitor.scene("the ball is in the room", |scene| ball(scene).is_some()).await?);
    page.hold((x, y)).await?;
    for to in [x - 24.0, x + 24.0] {
        for part in 1..=8 {
            page.pull((x + (to - x) * f64::from(part) / 8.0, y)).await?;
            visitor.scene("the next picture", |_| true).await?;
        }
        let moved = |scene: &Scene| ball(scene).zip(before).is_some_and(|(now, then)| (now.1 - then.1).abs() > 0.05);
        visitor.scene("the ball moved", moved).await?;
        let follows = |scene: &Scene| moved(scene) && off(scene).is_some_and(|off| off.abs() < 0.05);
        visitor.scene("the head follows the ball", follows).await?;
    }
    page.release((x + 24.0, y)).await?;
    let held = |scene: &Scene| off(scene).is_some_and(|off| off.abs() < 0.05) && !scene.body.tracking.is_empty();
    visitor.scene("the head rests on the ball", held).await?;
    says(page, "follows red ball").await
}

/// Where the red ball is, from above.
fn ball(scene: &Scene) -> Option<(f32, f32)> {
    scene.balls.iter().find(|ball| ball.id == "red").map(|ball| (ball.at[0], ball.at[1]))
}

/// How far the head is turned away from the red ball, in radians.
fn off(scene: &Scene) -> Option<f32> {
    let (x, y) = ball(scene)?;
    let [base_x, base_y, heading] = scene.body.base;
    let at = JOINTS.iter().position(|joint| *joint == "HeadYaw")?;
    let bearing = (y - base_y).atan2(x - base_x) - heading;
    Some(scene.body.joints.get(at)? - bearing)
}
