//! Behaviours in a real Neo4j: people work as always; while it hangs or is gone they are told and nothing is lost; it is
//! found again without a restart of ours.

use crate::steps::*;
use house::{Outcome, skip};

#[expect(dead_code, reason = "a journey needs no look into the database")]
#[path = "../neo4j/server.rs"]
mod server;

const PART: &str = "journey: behaviours in Neo4j";

#[tokio::test]
async fn neo4j_hangs_dies_and_comes_back() -> Outcome<()> {
    skip::unless!(ready(PART));
    let Some(parts) = server::folder(PART) else { return Ok(()) };
    let mut neo4j = server::Neo4j::start(parts);
    let stage = Stage::set_with(house::folder()?, &["--store", &neo4j.url()]).await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.find("button", "Red ball, sensor stream").await?;

    neo4j.hold();
    says(&ben, "Nothing can be saved now").await?;
    rename_program(&aiko, "Ours", "Ours, held").await?;
    says(&aiko, "Not saved: 1 change waits here").await?;
    aiko.press("button", "Stop").await?;
    says(&aiko, "Stopped.").await?;
    neo4j.go_on();
    saved(&aiko).await?;
    ben.find("button", "Ours, held").await?;

    neo4j.kill();
    says(&ben, "Nothing can be saved now").await?;
    rename_program(&aiko, "Ours, held", "Ours, at last").await?;
    says(&aiko, "Not saved: 1 change waits here").await?;
    neo4j.start_again();
    saved(&aiko).await?;
    ben.reload().await?;
    usable(&ben).await?;
    ben.find("button", "Ours, at last").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    calm(&aiko)
}
