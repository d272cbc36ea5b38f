//! What is promised of the optimised server, measured. `cargo xtask bench rooms` runs these, and fails if a bar is missed.

use crate::process::most_memory_kib;
use crate::{chaos, check, kills, neo4j};
use behaviour::{Params, Value};
use house::{Outcome, Server, skip};
use load::chaos::Faults;
use load::{LoadPlan, Report, run};
use protocol::{Refused, request};
use shell::{Client, ClientError};
use std::time::{Duration, Instant};

/// What 99 of 100 edits of fifty people may take until their sender knows that they are saved.
const ECHO_P99: Duration = Duration::from_millis(100);
/// From a start of the server to the first welcome.
const WELCOME: Duration = Duration::from_secs(1);
/// How much slower the others may be for those who read nothing.
const SLOWER_MAX: u32 = 2;
/// Operators who press tiles at once.
const OPERATORS: usize = 4;
/// Presses of each.
const PRESSES: usize = 400;
/// The time that 95 of 100 tiles may take from the press until the robot was told.
const TILE_P95: Duration = Duration::from_millis(20);
/// On a machine that is slow itself: how many times as long as a request that does nothing.
const TILE_RATIO_MAX: u32 = 8;
/// The time that 95 of 100 Stops may take among such presses, and the longest: those of Stop under attack.
const STOP_P95: Duration = Duration::from_millis(50);
const STOP_WORST: Duration = Duration::from_millis(250);
/// What these may take of the server's memory, in KiB.
const MORE_MAX_KIB: u64 = 20 << 10;

/// The optimised server on a fresh folder.
async fn optimised(part: &str) -> Outcome<Option<(tempfile::TempDir, Server)>> {
    if !skip::optimised(part) {
        return Ok(None);
    }
    let folder = house::folder()?;
    let server = Server::start_binary(&house::optimised(), folder.path(), &[]).await?;
    Ok(Some((folder, server)))
}

fn bar(kept: bool, sentence: String) -> Outcome<()> {
    println!("{}  {sentence}\n", if kept { "kept  " } else { "MISSED" });
    if kept { Ok(()) } else { Err(sentence.into()) }
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_1_fifty_people_in_one_behaviour() -> Outcome<()> {
    let Some((_folder, mut server)) = optimised("figures: fifty people").await? else { return Ok(()) };
    let report =
        run(&server.url(), &LoadPlan { clients: 50, edits_per_10_s: 50, seconds: 120, ..LoadPlan::default() }).await?;
    check(&report, &mut server).await?;
    let p99 = report.echo.share(99.0);
    bar(p99 <= ECHO_P99, format!("50 clients, 5 edits a second each, for 120 s: echo p99 {p99:?} of {ECHO_P99:?}"))
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_2_who_reads_nothing_slows_nobody() -> Outcome<()> {
    let Some((_folder, mut server)) = optimised("figures: stalled clients").await? else { return Ok(()) };
    let alone = LoadPlan { clients: 20, edits_per_10_s: 500, seconds: 30, ..LoadPlan::default() };
    // Once to be warm, then without and with the others.
    run(&server.url(), &LoadPlan { seconds: 5, ..alone.clone() }).await?;
    most_memory_kib(&server)?;
    let without = run(&server.url(), &alone).await?;
    let without_kib = most_memory_kib(&server)?;
    let with = run(&server.url(), &LoadPlan { stalled: 5, ..alone }).await?;
    let more_kib = most_memory_kib(&server)?.saturating_sub(without_kib);
    println!("{without}\n");
    check(&with, &mut server).await?;
    let p99 = |report: &Report| report.echo.share(99.0);
    let (before, after) = (p99(&without), p99(&with));
    let fast = with.per_second();
    let kept = after <= before * SLOWER_MAX && more_kib <= MORE_MAX_KIB && with.cut_off > 0;
    let slower = format!("echo p99 {after:?}, {before:?} without them; {} MiB more", more_kib >> 10);
    bar(kept, format!("5 of 25 clients read nothing, {fast:.0} edits a second: {slower}, cut off {}", with.cut_off))
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_3_five_hundred_people_in_a_hundred_behaviours() -> Outcome<()> {
    let Some((_folder, mut server)) = optimised("figures: 500 clients").await? else { return Ok(()) };
    let plan = LoadPlan { clients: 500, behaviours: 100, edits_per_10_s: 10, seconds: 60, ..LoadPlan::default() };
    let report = run(&server.url(), &plan).await?;
    let kib = most_memory_kib(&server)?;
    check(&report, &mut server).await?;
    println!("500 clients in 100 behaviours, 1 edit a second each: {} MiB of memory at most\n", kib >> 10);
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_4_a_bad_network_loses_nothing() -> Outcome<()> {
    let Some((_folder, mut server)) = optimised("figures: a bad network").await? else { return Ok(()) };
    let faults = Faults { delays: 500, delay_max_ms: 200, cuts: 20, truncations: 10, silences: 2 };
    let plan = LoadPlan { clients: 50, behaviours: 5, kills: 50, stalled: 2, seconds: 60, ..LoadPlan::default() };
    chaos::through(&mut server, &plan, faults).await
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_5_a_hundred_kills_lose_nothing() -> Outcome<()> {
    let Some((_folder, mut server)) = optimised("figures: a hundred kills").await? else { return Ok(()) };
    let longest = kills::killed(&mut server, 100).await?;
    bar(longest <= WELCOME, format!("100 kills: the first welcome at most {longest:?} after a start, of {WELCOME:?}"))
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_6_ten_kills_on_neo4j_lose_nothing() -> Outcome<()> {
    let part = "figures: kills on Neo4j";
    let Some(parts) = neo4j::folder(part).filter(|_| skip::optimised(part)) else { return Ok(()) };
    let neo4j = neo4j::Neo4j::start(parts);
    let folder = house::folder()?;
    let mut server = Server::start_binary(&house::optimised(), folder.path(), &["--store", &neo4j.url()]).await?;
    let longest = kills::killed(&mut server, 10).await?;
    bar(longest <= WELCOME, format!("10 kills on Neo4j: the first welcome at most {longest:?} after a start"))
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "measured by `cargo xtask bench rooms`"]
async fn figure_9_a_tile_reaches_the_robot_while_four_press() -> Outcome<()> {
    let Some((_folder, server)) = optimised("figures: tiles").await? else { return Ok(()) };
    let mut pressing = Vec::new();
    for operator in 0..OPERATORS {
        let client = Client::connect(&server.url(), &format!("Operator {operator}")).await?;
        pressing.push(tokio::spawn(presses(client)));
    }
    let stopping = tokio::spawn(stops(Client::connect(&server.url(), "Stop").await?));
    let (mut tiles, mut bare) = (Vec::new(), Vec::new());
    for operator in pressing {
        let (tile, alone) = operator.await.map_err(|lost| lost.to_string())??;
        tiles.extend(tile);
        bare.extend(alone);
    }
    let stop = stopping.await.map_err(|lost| lost.to_string())??;
    let (worst, stop) = (stop.iter().max().copied().unwrap_or_default(), p95(stop));
    bar(
        stop <= STOP_P95 && worst <= STOP_WORST && tiles.len() > OPERATORS * PRESSES / 2,
        format!(
            "Stop among them: p95 {stop:?} of {STOP_P95:?}, at worst {worst:?} of {STOP_WORST:?}; {} of {} tiles counted, \
             the others came with a Stop",
            tiles.len(),
            OPERATORS * PRESSES,
        ),
    )?;
    let (tile, alone) = (p95(tiles), p95(bare));
    let ratio = tile.as_secs_f64() / alone.as_secs_f64();
    let of_machine = format!("{ratio:.1} times a request that does nothing, the machine's own part, p95 {alone:?}");
    bar(
        tile <= TILE_P95.max(TILE_RATIO_MAX * alone),
        format!("{OPERATORS} operators, 20 tiles a second each: answered p95 {tile:?} of {TILE_P95:?}; {of_machine}"),
    )
}

/// Presses a tile 20 times a second; how long each took from the request to the answer, which the robot's thread gives once it
/// told the robot. Beside each, how long a request took that no robot hears of.
async fn presses(client: Client) -> Result<(Vec<Duration>, Vec<Duration>), ClientError> {
    let (mut tiles, mut bare) = (Vec::new(), Vec::new());
    let mut beat = tokio::time::interval(Duration::from_millis(50));
    for _ in 0..PRESSES {
        beat.tick().await;
        let began = Instant::now();
        client.ask(request::Runs {}).await?;
        bare.push(began.elapsed());
        let (device, params, value) = ("Print".to_owned(), Params::default(), Value::Int(1));
        let began = Instant::now();
        match client.ask(request::Hand { robot: None, device, params, value }).await {
            Ok(()) => tiles.push(began.elapsed()),
            // Somebody stopped the robot just then.
            Err(ClientError::No(Refused::StoppedSince | Refused::RobotCannot(_))) => {}
            Err(trouble) => return Err(trouble),
        }
    }
    Ok((tiles, bare))
}

/// Presses Stop twice a second for as long; how long each took.
async fn stops(client: Client) -> Result<Vec<Duration>, ClientError> {
    let (mut taken, mut beat) = (Vec::new(), tokio::time::interval(Duration::from_millis(500)));
    for _ in 0..PRESSES / 10 {
        beat.tick().await;
        let began = Instant::now();
        client.ask(request::Stop { behaviour: None, robot: None }).await?;
        taken.push(began.elapsed());
    }
    Ok(taken)
}

fn p95(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() * 95 / 100]
}
