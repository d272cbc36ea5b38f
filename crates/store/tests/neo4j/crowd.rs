//! Many at once, on one behaviour and on many that share devices, through two handles as of two servers.

use crate::samples::{change, follow, id, next, now, place, save, stream};
use crate::shared;
use behaviour::{Behaviour, Committed};
use std::sync::Arc;
use store::{Append, Neo4jStore, Store};
use tokio::task::JoinSet;

const CLIENTS: usize = 50;
const EDITS_EACH: usize = 4;

async fn two_handles(neo4j: &shared::Alone) -> [Arc<Neo4jStore>; 2] {
    [Arc::new(neo4j.empty_store().await), Arc::new(neo4j.store().await)]
}

async fn all_end(mut tasks: JoinSet<()>) {
    while let Some(ended) = tasks.join_next().await {
        ended.expect("the task ends well");
    }
}

/// Sends one edit until it is saved, each time as the next one.
async fn insist(store: &Neo4jStore, to: &str, op: &str) {
    let mut head = 0;
    loop {
        let made = change(op, &Behaviour::default(), vec![place(op, head as f64, 0.5)]);
        let committed = Committed { revision: head + 1, change: made };
        match store.append(&id(to), &committed, &Behaviour::default()).await.expect("an answer") {
            Append::Applied => return,
            Append::Conflict { head: now } => head = now,
            Append::Duplicate { revision } | Append::Reused { revision } => {
                panic!("{op} was never saved, but is revision {revision}")
            }
        }
    }
}

async fn assert_contiguous(store: &Neo4jStore, of: &str, revisions: u64) {
    let history = store.history(&id(of), 0, u32::MAX).await.expect("history");
    let made: Vec<_> = history.iter().map(|made| made.revision).collect();
    assert_eq!(made, (1..=revisions).collect::<Vec<_>>(), "{of}");
    let mut replayed = Behaviour::default();
    history.iter().for_each(|made| replayed.apply(&made.change));
    assert_eq!(now(store, of).await, replayed, "{of}");
}

#[tokio::test(flavor = "multi_thread")]
async fn fifty_clients_on_one_behaviour_make_one_order() {
    let Some(neo4j) = shared::alone("fifty clients on one behaviour").await else { return };
    let handles = two_handles(&neo4j).await;
    let mut tasks = JoinSet::new();
    for client in 0..CLIENTS {
        let store = Arc::clone(&handles[client % 2]);
        tasks.spawn(async move {
            for edit in 0..EDITS_EACH {
                insist(&store, "a", &format!("op-{client}-{edit}")).await;
            }
        });
    }
    all_end(tasks).await;
    assert_contiguous(&handles[0], "a", (CLIENTS * EDITS_EACH) as u64).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn fifty_behaviours_that_share_devices_are_edited_at_once() {
    let Some(neo4j) = shared::alone("fifty behaviours that share devices").await else { return };
    let handles = two_handles(&neo4j).await;
    let devices = ["actuator:Tracker", "actuator:SayInput", "sensor:RedBall", "sensor:HeadTouch"];
    let mut tasks = JoinSet::new();
    for client in 0..CLIENTS {
        let store = Arc::clone(&handles[client % 2]);
        tasks.spawn(async move {
            let name = format!("b{client}");
            save(store.as_ref(), &name, "op0", follow(&name)).await;
            for edit in 1..=EDITS_EACH {
                let device = |more: usize| devices[(client + edit + more) % devices.len()];
                let edits = vec![stream("x", "X", device(0)), stream("y", "Y", device(1))];
                save(store.as_ref(), &name, &format!("op{edit}"), edits).await;
            }
        });
    }
    all_end(tasks).await;
    for client in 0..CLIENTS {
        assert_contiguous(&handles[1], &format!("b{client}"), EDITS_EACH as u64 + 1).await;
    }
    let devices = neo4j.rows("MATCH (d:Device) RETURN d.name AS name ORDER BY name").await;
    assert_eq!(devices.len(), 4, "each device once: {devices:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn of_two_servers_with_the_next_change_exactly_one_wins() {
    let Some(neo4j) = shared::alone("two servers").await else { return };
    let handles = two_handles(&neo4j).await;
    for round in 0..20_u64 {
        let send = |which: usize| {
            let made =
                change(&format!("op-{round}-{which}"), &Behaviour::default(), vec![place("p", which as f64, 0.0)]);
            let (store, committed) = (Arc::clone(&handles[which]), Committed { revision: round + 1, change: made });
            tokio::spawn(async move { store.append(&id("a"), &committed, &Behaviour::default()).await })
        };
        let answers = tokio::join!(send(0), send(1));
        let answers = [answers.0.expect("an end"), answers.1.expect("an end")];
        assert!(answers.contains(&Ok(Append::Applied)), "{answers:?}");
        assert!(answers.contains(&Ok(Append::Conflict { head: round + 1 })), "{answers:?}");
    }
    assert_contiguous(&handles[0], "a", 20).await;
    assert_eq!(
        next(handles[1].as_ref(), "a", change("last", &Behaviour::default(), vec![place("p", 9.0, 9.0)])).await,
        Ok(Append::Applied)
    );
}
