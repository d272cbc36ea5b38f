//! Two or three people edit one program, each with an editor, over links that are slow, break and lose things, while the
//! server stalls, dies and starts again: everything by a seed. No edit is lost or doubled, and all end with one program.
//!
//! `RRP_EDITOR_SEEDS=10000` plays so many seeds, `RRP_EDITOR_SEED=7` plays one.

mod dice;
mod finding;
mod graph;
mod keeping;
mod keyboard;
mod known;
mod link;
mod page;
mod presence;
mod problems;
mod running;
mod scenes;
mod sentences;
mod server;
mod sketch;
mod table;
mod turning;
mod world;

use std::collections::BTreeMap;
use world::World;

/// Seeds of a usual run.
const SEEDS: u64 = 1_000;

fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok().and_then(|text| text.parse().ok())
}

#[test]
fn no_edit_is_lost_or_doubled_on_bad_links() {
    let seeds = number("RRP_EDITOR_SEED").map_or(0..number("RRP_EDITOR_SEEDS").unwrap_or(SEEDS), |seed| seed..seed + 1);
    let many = seeds.end - seeds.start;
    let mut counts: BTreeMap<&'static str, usize> = BTreeMap::new();
    let mut failed = Vec::new();
    for seed in seeds {
        let mut world = World::new(seed);
        if let Err(why) = world.play() {
            failed.push((seed, why));
        }
        world.counts.into_iter().for_each(|(what, times)| *counts.entry(what).or_default() += times);
    }
    let first = failed.iter().take(8).map(|(seed, why)| format!("\n{seed}: {why}")).collect::<String>();
    assert!(failed.is_empty(), "{} of {many} seeds failed:{first}", failed.len());
    if many >= SEEDS {
        let often = [
            "cut",
            "reload",
            "restart",
            "saved",
            "refused",
            "kept",
            "withdrawn",
            "dropped",
            "taken back",
            "gesture",
            "keyboard led on",
        ];
        let seldom = ["reload while it is found out who was first"];
        for (what, least) in often.into_iter().map(|what| (what, 100)).chain(seldom.into_iter().map(|what| (what, 3))) {
            let times = counts.get(what).copied().unwrap_or_default();
            assert!(times > least, "{what} happened only {times} times: {counts:?}");
        }
    }
}
