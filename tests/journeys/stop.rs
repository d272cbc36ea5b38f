//! Stop works whatever else does not.

use house::{Outcome, Page, skip};
use protocol::request;
use serde_json::json;

use crate::steps::*;
use crate::visitor::Visitor;

#[tokio::test]
async fn stop_works_while_a_dialog_is_open_and_by_escape() -> Outcome<()> {
    skip::unless!(ready("journey: stop beside a dialog"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    thunderbolt(&aiko, "Red ball", "map").await?;
    stop(&aiko).await?;
    aiko.find("dialog", "Operation").await?;
    at_rest(&aiko).await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Operation").await?;

    start(&aiko).await?;
    thunderbolt(&aiko, "Red ball", "map").await?;
    // The first closes the dialog, so that these two are none of Stop; the next two are.
    escape_twice(&aiko).await?;
    aiko.gone("dialog", "Operation").await?;
    aiko.find("button", "Running").await?;
    escape_twice(&aiko).await?;
    says(&aiko, "Stopped. The robot holds still.").await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn stop_works_without_the_socket() -> Outcome<()> {
    skip::unless!(ready("journey: stop without the socket"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    running_ball(&aiko).await?;
    socket.cut().await?;
    says(&aiko, "Offline").await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    visitor.runs("the program runs on", 1).await?;
    stop(&aiko).await?;
    visitor.runs("the robot was stopped", 0).await?;
    socket.mend().await?;
    saved(&aiko).await?;
    at_rest(&aiko).await
}

#[tokio::test]
async fn stop_works_without_the_program() -> Outcome<()> {
    skip::unless!(ready("journey: stop without the program"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let ben = stage.nobody("ben").await?;
    ben.call("Network.setBlockedURLs", json!({ "urls": ["*app.js*"] })).await?;
    ben.goto(&aiko.address().await?).await?;
    says(&ben, "The page could not be loaded. Stop still works.").await?;
    stop(&ben).await?;
    at_rest(&aiko).await?;

    let mut visitor = Visitor::enter(&stage.server).await?;
    let program = visitor.open_newest().await?;
    let session = protocol::RecordedSession::default();
    visitor.ask(request::Start { behaviour: program.id, robot: None, record: false, session }).await?;
    aiko.find("button", "Running").await?;
    silent(&ben, "Stopped. The robot holds still.").await?;
    escape_twice(&ben).await?;
    says(&ben, "Stopped. The robot holds still.").await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

/// A program with a red ball and its distance, which runs.
pub(crate) async fn running_ball(page: &Page) -> Outcome<()> {
    add_program(page, "To be stopped").await?;
    add_sense(page, "Red ball").await?;
    next(page, "Red ball", "Distance in cm").await?;
    page.find("button", "Distance, stream").await?;
    saved(page).await?;
    start(page).await?;
    shows_value(page, "Distance").await.map(drop)
}

/// Escape twice, as fast as a frightened hand.
async fn escape_twice(page: &Page) -> Outcome<()> {
    let (one, two) = tokio::join!(page.key("Escape"), page.key("Escape"));
    one.and(two)
}
