//! The server is killed again and again (`kill -9`) while people edit, and started again: nothing that it acknowledged
//! is lost, and everything is there once.

use crate::{check, neo4j};
use house::{Outcome, Server, skip};
use load::{Load, LoadPlan, Watch, patiently};
use shell::Client;
use std::time::{Duration, Instant};

/// Kills in the tests; the benchmark has more.
const KILLS: usize = 20;
const KILLS_ON_NEO4J: usize = 3;
/// How long until edits are saved again.
const AGAIN: Duration = Duration::from_secs(60);

/// A load that goes on.
type Loading = tokio::task::JoinHandle<Result<load::Report, shell::ClientError>>;

/// Twenty clients that edit until they are told to end.
pub(crate) fn twenty() -> LoadPlan {
    LoadPlan { clients: 20, behaviours: 2, edits_per_10_s: 100, seconds: 3_600, seed: 3, ..LoadPlan::default() }
}

#[tokio::test]
async fn a_killed_server_loses_nothing_that_it_acknowledged() -> Outcome<()> {
    skip::unless!(served("rooms: kills of the server"));
    let folder = house::folder()?;
    let mut server = Server::start(folder.path()).await?;
    killed(&mut server, KILLS).await.map(drop)
}

#[tokio::test]
async fn nor_does_one_whose_behaviours_are_in_neo4j() -> Outcome<()> {
    let part = "rooms: kills of a server on Neo4j";
    skip::unless!(served(part));
    let Some(parts) = neo4j::folder(part) else { return Ok(()) };
    let neo4j = neo4j::Neo4j::start(parts);
    let folder = house::folder()?;
    let mut server = Server::start_with(folder.path(), &["--store", &neo4j.url()]).await?;
    killed(&mut server, KILLS_ON_NEO4J).await.map(drop)
}

/// Kills the server so often while twenty people edit. The longest time from its start to the first welcome.
pub(crate) async fn killed(server: &mut Server, kills: usize) -> Outcome<Duration> {
    let load = Load::of(&server.url(), &twenty());
    let watch = load.watch();
    let mut loading = tokio::spawn(load.run());
    let mut longest = Duration::ZERO;
    for kill in 0..kills {
        saved_by(&mut loading, &watch, 1 + kill as u64 * 7 % 40).await?;
        server.kill9().await?;
        let began = Instant::now();
        server.restart().await?;
        let url = server.url();
        patiently(|| Client::connect(&url, "First")).await?;
        longest = longest.max(began.elapsed());
    }
    saved_by(&mut loading, &watch, 100).await?;
    watch.end();
    let report = loading.await.map_err(|error| error.to_string())??;
    println!("{kills} kills; the longest from a start to the first welcome: {} ms", longest.as_millis());
    check(&report, server).await?;
    Ok(longest)
}

/// Waits until so many more edits are saved; a load that ends before says why it did.
async fn saved_by(loading: &mut Loading, watch: &Watch, more: u64) -> Outcome<()> {
    tokio::select! {
        saved = saved(watch, more) => saved,
        ended = loading => {
            let report = ended.map_err(|error| error.to_string())??;
            Err(format!("The load ended before {more} more edits were saved: {report:?}").into())
        }
    }
}

/// Waits until so many more edits are saved.
async fn saved(watch: &Watch, more: u64) -> Outcome<()> {
    let (wanted, began) = (watch.acknowledged() + more, Instant::now());
    while watch.acknowledged() < wanted {
        if began.elapsed() > AGAIN {
            return Err(format!("No {more} edits were saved within {} s.", AGAIN.as_secs()).into());
        }
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    Ok(())
}
