//! The data cannot be reached for a while: everyone is told, what people do waits, and nothing is lost.

use crate::steps::*;
use house::{Outcome, skip};

const FILE: &str = "rrp.sqlite";

#[tokio::test]
async fn what_is_done_while_the_data_is_away_is_saved_later() -> Outcome<()> {
    skip::unless!(ready("journey: the data is away"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    let (here, away) = (stage.folder().join(FILE), stage.folder().join("away.sqlite"));
    std::fs::rename(&here, &away)?;
    for person in [&aiko, &ben] {
        says(person, "Nothing can be saved now").await?;
    }
    rename_program(&aiko, "Ours", "Ours, later").await?;
    says(&aiko, "Not saved: 1 change waits here").await?;
    aiko.find("button", "Ours, later").await?;
    ben.find("button", "Ours").await?;
    aiko.press("button", "Stop").await?;
    says(&aiko, "Stopped.").await?;
    std::fs::rename(&away, &here)?;
    saved(&aiko).await?;
    for person in [&aiko, &ben] {
        person.find("button", "Ours, later").await?;
        silent(person, "be saved now").await?;
    }
    calm(&ben)?;
    calm(&aiko)
}
