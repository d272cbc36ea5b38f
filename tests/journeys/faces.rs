//! Faces that a robot remembers are forgotten, all or one: after a question about the robot that it is asked of, whatever
//! happens meanwhile.

use house::{Outcome, Page, StandIn, skip};

use crate::identity::{add, keep};
use crate::steps::*;

/// Opens the question about a robot that this page looks at.
async fn asks(page: &Page, robot: &str) -> Outcome<()> {
    page.press("button", &format!("Robot: {robot}")).await?;
    page.press("menuitem", "Forget faces").await?;
    page.find("dialog", "Forget faces").await.map(drop)
}

#[tokio::test]
async fn faces_are_forgotten_by_the_robot_that_the_question_is_about() -> Outcome<()> {
    skip::unless!(ready("journey: faces"));
    let Some(momo) = StandIn::start("journey: faces", &["--name", "Momo"])? else { return Ok(()) };
    momo.world(r#"{"learned": {"1": "Hana", "2": "Ken", "3": "Sora"}}"#).await?;
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add(&aiko, momo.address(), "Blue").await?;
    aiko.find("button", "Robot: Blue").await?;

    // Kept, if nobody wants it.
    asks(&aiko, "Blue").await?;
    says(&aiko, "“Blue” forgets the 3 faces that it remembers. This cannot be undone.").await?;
    keep(&aiko, "faces").await?;
    aiko.press("button", "Keep").await?;
    aiko.gone("dialog", "Forget faces").await?;
    assert!(momo.state().await?.contains("Hana"));

    // One of them.
    asks(&aiko, "Blue").await?;
    choose(&aiko, "Whose face", "Ke", "Ken").await?;
    says(&aiko, "“Blue” forgets the face that it remembers as “Ken”. This cannot be undone.").await?;
    keep(&aiko, "one-face").await?;
    aiko.press("button", "Forget").await?;
    says(&aiko, "“Blue” forgets “Ken”.").await?;
    momo.until("Ken is forgotten", |state| !state.contains("Ken") && state.contains("Hana")).await?;

    // Another robot is looked at meanwhile, as somebody has removed this one: nothing happens without a word.
    let ben = stage.beside(&aiko, "ben").await?;
    asks(&aiko, "Blue").await?;
    ben.press("button", "Robot: *").await?;
    ben.press("menuitemradio", "Blue*").await?;
    ben.press("button", "Robot: Blue").await?;
    ben.press("menuitem", "Remove “Blue”").await?;
    ben.press("button", "Remove").await?;
    says(&aiko, "Somebody has removed “Blue” meanwhile. Nothing was forgotten.").await?;
    aiko.find("dialog", "Forget faces").await?;
    aiko.press("button", "Keep").await?;
    assert!(momo.state().await?.contains("Hana"));

    // All of them.
    add(&aiko, momo.address(), "Green").await?;
    asks(&aiko, "Green").await?;
    says(&aiko, "“Green” forgets the 2 faces that it remembers. This cannot be undone.").await?;
    aiko.press("button", "Forget").await?;
    says(&aiko, "“Green” forgets the faces that it knew.").await?;
    momo.until("all are forgotten", |state| !state.contains("Hana") && !state.contains("Sora")).await?;
    calm(&aiko)
}
