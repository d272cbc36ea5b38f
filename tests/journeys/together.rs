//! Two people in one program: each sees what the other does, and nothing of anybody is lost.

use house::{Outcome, Page, skip};

use crate::steps::*;

const SETTLED: &str = "function () { return this.parentElement.style.transform; }";

#[tokio::test]
async fn what_one_does_the_other_sees() -> Outcome<()> {
    skip::unless!(ready("journey: two people"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    aiko.find("button", "Follow Ben").await?;

    rename_program(&aiko, "Ours", "Our ball").await?;
    ben.find("button", "Our ball").await?;
    rename_stream(&aiko, "Red ball", "The ball").await?;
    ben.find("button", "The ball, sensor stream").await?;
    drag_aside(&aiko, &ben, "The ball, sensor stream").await?;

    add_sense(&ben, "Head touch").await?;
    aiko.find("button", "Head touch, anywhere, sensor stream").await?;
    rename_program(&aiko, "Our ball", "My ball").await?;
    ben.find("button", "My ball").await?;
    aiko.press("button", "Undo").await?;
    for person in [&aiko, &ben] {
        person.find("button", "Our ball").await?;
        person.find("button", "Head touch, anywhere, sensor stream").await?;
    }
    calm(&ben)?;
    ben.close().await?;
    aiko.gone("button", "Follow Ben").await?;
    calm(&aiko)
}

/// Makes a program with a map whose body is 1.
pub(crate) async fn add_map(page: &Page) -> Outcome<()> {
    add_program(page, "Ours").await?;
    add_sense(page, "Red ball").await?;
    thunderbolt(page, "Red ball", "map").await?;
    page.within("dialog", "Operation").fill("textbox", "Procedure", "1").await?;
    save(page, "Operation").await
}

#[tokio::test]
async fn what_is_done_offline_is_sent_later() -> Outcome<()> {
    skip::unless!(ready("journey: offline"));
    let mut stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    stage.server.kill9().await?;
    says(&aiko, "No connection. You can go on; it is sent when the connection is back.").await?;
    rename_program(&aiko, "Ours", "Ours, later").await?;
    says(&aiko, "Offline: 1 change waits here").await?;
    aiko.press("button", "Stop").await?;
    says(&aiko, "Stop did not reach the robot.").await?;
    stage.server.restart().await?;
    saved(&aiko).await?;
    for person in [&aiko, &ben] {
        person.find("button", "Ours, later").await?;
        silent(person, "Offline").await?;
    }
    aiko.reload().await?;
    usable(&aiko).await?;
    aiko.find("button", "Ours, later").await.map(drop)
}

/// Chooses one's own name behind one's own sign in the bar.
pub(crate) async fn call_myself(page: &Page, name: &str) -> Outcome<()> {
    page.within("toolbar", "Main tools").press("button", "G*").await?;
    page.within("dialog", "Your name").fill("textbox", "Name*", name).await?;
    page.within("dialog", "Your name").press("button", "Save").await?;
    page.gone("dialog", "Your name").await?;
    saved(page).await
}

async fn rename_stream(page: &Page, from: &str, to: &str) -> Outcome<()> {
    select(page, from).await?;
    next(page, from, "Edit").await?;
    page.within("dialog", "Red ball settings").fill("textbox", "Name", to).await?;
    save(page, "Red ball settings").await
}

/// One drags a stream; it ends at the same place for the other.
async fn drag_aside(one: &Page, other: &Page, stream: &str) -> Outcome<()> {
    let before = other.on("button", stream, SETTLED).await?;
    let (x, y) = one.boxed("button", stream).await?.centre();
    one.drag((x, y), (x + 96.0, y + 64.0), 8).await?;
    saved(one).await?;
    let there = one.on("button", stream, SETTLED).await?;
    assert_ne!(there, before);
    let js = format!("function () {{ return this.parentElement.style.transform === {there}; }}");
    other.until_on("button", stream, &js, "the stream is where the other put it").await.map(drop)
}

/// Opens a connector's dialog and writes another body, without saving.
pub(crate) async fn write_body(page: &Page, chip: &str, body: &str) -> Outcome<()> {
    page.press("button", chip).await?;
    next(page, "map", "More…").await?;
    page.within("dialog", "Operation").fill("textbox", "Procedure", body).await
}
