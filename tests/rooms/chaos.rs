//! Links that are late, end, end in the middle of a message or fall silent, and clients that go without a word.

use crate::check;
use house::{Outcome, Server, skip};
use load::chaos::{Faults, Proxy};
use load::{Load, LoadPlan};

/// What the network does, of ten thousand pieces.
const BAD: Faults = Faults { delays: 300, delay_max_ms: 60, cuts: 20, truncations: 20, silences: 3 };
const SEED: u64 = 11;

#[tokio::test]
async fn links_that_break_lose_nothing() -> Outcome<()> {
    skip::unless!(served("rooms: links that break"));
    let folder = house::folder()?;
    let mut server = Server::start(folder.path()).await?;
    let plan =
        LoadPlan { clients: 12, behaviours: 3, edits_per_10_s: 100, stalled: 1, kills: 12, seconds: 8, seed: SEED };
    through(&mut server, &plan, BAD).await
}

/// A load through a bad network.
pub(crate) async fn through(server: &mut Server, plan: &LoadPlan, faults: Faults) -> Outcome<()> {
    let proxy = Proxy::before(server.address().parse()?, faults, plan.seed).await?;
    let report = Load::of(&server.url(), plan).through(&proxy.url()).run().await?;
    let happened = proxy.happened();
    println!("{happened:?}");
    if happened.cuts == 0 || happened.truncations == 0 || happened.delays == 0 {
        return Err(format!("The network was not bad: {happened:?}").into());
    }
    check(&report, server).await
}
