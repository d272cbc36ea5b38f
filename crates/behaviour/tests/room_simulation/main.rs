//! Many people edit one behaviour over links that fail, with a server that dies, for many seeds: whatever is promised holds.
//!
//! A failure says its seed and writes its plan. `RRP_PLAN=FILE cargo test -p behaviour --test room_simulation` plays a plan
//! again, perhaps edited; `RRP_SEEDS=200000` plays more of them.

mod client;
mod gestures;
mod plan;
mod server;
mod witness;
mod world;

use plan::Plan;
use server::Mutant;
use std::collections::BTreeMap;
use world::World;

/// Seeds that are played when nobody says how many.
const SEEDS: u64 = 20_000;
/// Seeds within which a mutant must be noticed.
const MUTANT_SEEDS: u64 = 1_000;

type Counts = BTreeMap<&'static str, usize>;

fn play(plan: &Plan) -> Result<Counts, String> {
    World::play(plan).map_err(|failure| {
        let (step, why, path) = (failure.step, failure.why, plan.save(failure.step));
        let again = format!("RRP_PLAN={} cargo test -p behaviour --test room_simulation", path.display());
        format!("seed {}, step {step}: {why}\nits plan, to be edited and played again: {again}", plan.seed)
    })
}

/// Plays some seeds on all processors.
fn play_seeds(seeds: u64) -> Counts {
    let threads = std::thread::available_parallelism().map_or(1, |many| many.get() as u64);
    let part = |first: u64| (first..seeds).step_by(threads as usize).map(|seed| play(&Plan::of(seed, None)));
    let add = |mut all: Counts, some: Counts| {
        some.into_iter().for_each(|(what, many)| *all.entry(what).or_default() += many);
        all
    };
    let sum = |first| part(first).map(|counts| counts.unwrap_or_else(|why| panic!("{why}"))).fold(Counts::new(), add);
    std::thread::scope(|scope| {
        let parts: Vec<_> = (0..threads).map(|first| scope.spawn(move || sum(first))).collect();
        parts.into_iter().map(|part| part.join().expect("every seed holds")).fold(Counts::new(), add)
    })
}

#[test]
fn whatever_fails_nothing_is_lost_and_locks_hold() {
    if let Ok(path) = std::env::var("RRP_PLAN") {
        play(&Plan::read(&path)).unwrap_or_else(|why| panic!("{why}"));
        return;
    }
    let seeds = std::env::var("RRP_SEEDS").ok().and_then(|text| text.parse().ok()).unwrap_or(SEEDS);
    let counts = play_seeds(seeds);
    let often = |what| *counts.get(what).unwrap_or(&0) as u64;
    for (what, least) in [("made", 8), ("granted", 3)] {
        assert!(often(what) >= seeds * least, "{what}: {counts:?}");
    }
    for what in ["handed over", "taken back", "kept", "refused: locked", "refused: stale", "freed: idle", "freed: left"]
    {
        assert!(often(what) * 10 >= seeds, "{what}: {counts:?}");
    }
    assert!(often("undo needs what is gone") * 10 < seeds, "{counts:?}");
}

fn is_noticed(mutant: Mutant) {
    let mut failures = (0..MUTANT_SEEDS)
        .filter_map(|seed| World::play(&Plan::of(seed, Some(mutant))).err().map(|why| (seed, why.why)));
    let (seed, why) = failures.next().unwrap_or_else(|| panic!("nobody notices {mutant:?}"));
    eprintln!("{mutant:?} is noticed at seed {seed}: {why}");
}

#[test]
fn a_room_that_compares_nothing_is_noticed() {
    is_noticed(Mutant::NoCas);
}

#[test]
fn a_room_that_asks_no_locks_is_noticed() {
    is_noticed(Mutant::NoFencing);
}

#[test]
fn telling_before_saving_is_noticed() {
    is_noticed(Mutant::AckBeforeCommit);
}

#[test]
fn forgetting_what_was_answered_is_noticed() {
    is_noticed(Mutant::NoDedupe);
}

#[test]
fn locks_that_never_end_are_noticed() {
    is_noticed(Mutant::LocksNeverExpire);
}

#[test]
fn a_client_that_ignores_gaps_is_noticed() {
    is_noticed(Mutant::IgnoredGap);
}

#[test]
fn pings_without_the_revision_are_noticed() {
    is_noticed(Mutant::PingWithoutRevision);
}

#[test]
fn two_holders_of_one_record_are_noticed() {
    is_noticed(Mutant::DoubleGrant);
}

#[test]
fn a_lock_given_while_another_s_edit_is_being_saved_is_noticed() {
    is_noticed(Mutant::GrantWhileSaving);
}

#[test]
fn a_refusal_that_is_forgotten_is_noticed() {
    is_noticed(Mutant::ForgottenRefusal);
}

#[test]
fn a_token_of_somebody_else_that_is_taken_is_noticed() {
    is_noticed(Mutant::TokenAlone);
}

#[test]
fn a_token_of_another_server_that_is_taken_is_noticed() {
    is_noticed(Mutant::AnyEpoch);
}

#[test]
fn a_plan_is_played_again_as_it_was_written() {
    let plan = Plan::of(7, Some(Mutant::NoCas));
    let path = plan.save(plan.steps.len());
    let again = Plan::read(path.to_str().expect("a plain path"));
    assert_eq!((plan.people, plan.steps, plan.mutant), (again.people, again.steps, again.mutant));
}
