//! Tests with a server that misbehaves: every call ends, and is made again only where that is safe.

use super::address::Neo4jAddress;
use super::link::Neo4jConnections;
use super::peer::{ConnectStage, Peer, RowValue, StatementFate};
use super::{append, bin, load};
use crate::{Append, StoreError, Unkept, json};
use behaviour::{Behaviour, Change, Committed, Id};
use std::future::Future;
use std::time::Duration;

const BUSY: &str = "Neo.TransientError.Transaction.DeadlockDetected";
const ZERO: &str = "Neo.ClientError.Statement.ArithmeticError";
/// The change of [`save`] as the database has it.
const SAVED: &str = r#"{"op":"op","author":"Aiko","label":"Edit","at_ms":0,"edits":[]}"#;
const SOON: Duration = Duration::from_millis(300);
const LONG: Duration = Duration::from_secs(30);
/// A guard: no call may take so long, however busy the machine is.
const GUARD: Duration = Duration::from_secs(60);

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

fn link(peer: &Peer, answer_max: Duration) -> Neo4jConnections {
    let url = format!("bolt://u:secret@{}", peer.place);
    Neo4jConnections::new(&Neo4jAddress::read(&url, &|_| None).expect("an address"), answer_max).expect("a link")
}

async fn ends<T>(call: impl Future<Output = T>) -> T {
    tokio::time::timeout(GUARD, call).await.expect("every call ends")
}

async fn save(link: &Neo4jConnections, revision: u64) -> Result<Append, StoreError> {
    let committed = Committed { revision, change: Change::of(id("op"), "Aiko", "Edit") };
    let json = json::checked(&committed)?;
    ends(append::append(link, &id("b"), &committed, json, &Behaviour::default())).await
}

fn outcome(head: u8, applied: u8, duplicate: RowValue) -> Vec<(&'static str, RowValue)> {
    vec![
        ("head", RowValue::Small(head)),
        ("binned", RowValue::Truth(false)),
        ("applied", RowValue::Small(applied)),
        ("duplicate", duplicate),
        ("saved", RowValue::Text(SAVED)),
    ]
}

fn saved() -> StatementFate {
    StatementFate::Row(outcome(0, 1, RowValue::Null))
}

fn said(answer: Result<Append, StoreError>) -> String {
    let error = answer.expect_err("no answer");
    assert!(error.is_open(), "{error}");
    assert!(!error.to_string().contains("secret"), "{error}");
    error.to_string()
}

#[tokio::test]
async fn a_server_that_is_silent_holds_nobody_up() {
    for door in [ConnectStage::SilentAtAccept, ConnectStage::SilentAfterHandshake] {
        let peer = Peer::start(door, [], saved()).await;
        let link = link(&peer, SOON);
        let told = said(save(&link, 1).await);
        assert!(told.contains(&peer.place), "{door:?}: {told}");
        assert!(ends(load::load(&link, &id("b"))).await.is_err(), "{door:?}");
        assert_eq!(peer.statements(), 0, "{door:?}");
    }
}

#[tokio::test]
async fn a_server_that_speaks_again_is_heard_by_the_same_handle() {
    let peer = Peer::start(ConnectStage::SilentAtAccept, [], saved()).await;
    let link = link(&peer, Duration::from_secs(2));
    said(save(&link, 1).await);
    peer.set_door(ConnectStage::Open);
    assert_eq!(save(&link, 1).await, Ok(Append::Applied));
}

#[tokio::test]
async fn a_slow_answer_is_waited_for_within_the_time_of_a_call() {
    let late = |time| StatementFate::Late(time, outcome(0, 1, RowValue::Null));
    let peer = Peer::start(ConnectStage::Open, [late(SOON)], saved()).await;
    assert_eq!(save(&link(&peer, LONG), 1).await, Ok(Append::Applied));
    let peer = Peer::start(ConnectStage::Open, [late(LONG), StatementFate::Silence], saved()).await;
    let link = link(&peer, Duration::from_secs(2));
    for _ in 0..2 {
        let told = said(save(&link, 1).await);
        assert!(told.contains("did not answer") || told.contains("broke"), "{told}");
    }
    assert_eq!(save(&link, 1).await, Ok(Append::Applied), "the next call has a connection of its own");
}

#[tokio::test]
async fn a_change_cut_off_at_its_commit_is_settled_by_its_op_id() {
    let duplicate = StatementFate::Row(outcome(1, 0, RowValue::Small(1)));
    let peer = Peer::start(ConnectStage::Open, [StatementFate::Closed], duplicate).await;
    let link = link(&peer, LONG);
    assert_eq!(save(&link, 1).await, Ok(Append::Applied), "this very call saved it");
    assert_eq!(save(&link, 1).await, Ok(Append::Duplicate { revision: 1 }), "an earlier call saved it");
    assert_eq!(peer.statements(), 3);
}

#[tokio::test]
async fn a_connection_that_always_breaks_is_told() {
    let peer = Peer::start(ConnectStage::Open, [], StatementFate::Closed).await;
    let told = said(save(&link(&peer, LONG), 1).await);
    assert!(told.contains("broke"), "{told}");
    assert!((1..=6).contains(&peer.statements()), "{}", peer.statements());
}

#[tokio::test]
async fn what_is_not_settled_by_an_op_id_is_not_done_twice() {
    let row = || StatementFate::Row(vec![("many", RowValue::Small(1))]);
    let peer = Peer::start(ConnectStage::Open, [StatementFate::Closed], row()).await;
    let link = link(&peer, LONG);
    let cut = ends(bin::next_epoch(&link)).await.expect_err("it may have been done");
    assert!(cut.is_open(), "{cut}");
    assert_eq!(peer.statements(), 1);
    assert_eq!(ends(bin::next_epoch(&link)).await, Ok(1));
}

#[tokio::test]
async fn what_neo4j_undid_is_done_again() {
    let peer = Peer::start(
        ConnectStage::Open,
        [StatementFate::Fails(BUSY), StatementFate::Refused(BUSY), StatementFate::Fails(BUSY)],
        saved(),
    )
    .await;
    assert_eq!(save(&link(&peer, LONG), 1).await, Ok(Append::Applied));
    assert_eq!(peer.statements(), 4);
    let peer = Peer::start(ConnectStage::Open, [], StatementFate::Fails(BUSY)).await;
    let told = said(save(&link(&peer, SOON), 1).await);
    assert!(told.contains("too busy") || told.contains("did not answer"), "{told}");
}

#[tokio::test]
async fn what_will_never_go_well_is_tried_once() {
    let peer = Peer::start(ConnectStage::Open, [StatementFate::Fails(ZERO)], saved()).await;
    let refused = save(&link(&peer, LONG), 1).await.expect_err("a refusal");
    assert_eq!(refused, StoreError::Refused(Unkept::NoStream));
    assert_eq!(peer.statements(), 1);
}

#[tokio::test]
async fn a_wrong_password_is_told() {
    let peer = Peer::start(ConnectStage::WrongPassword, [], saved()).await;
    let told = said(save(&link(&peer, LONG), 1).await);
    assert!(told.contains("refuses this user and password"), "{told}");
}

#[tokio::test]
async fn rows_that_cannot_be_ours_are_told() {
    let peer = Peer::start(ConnectStage::Open, [], StatementFate::Row(vec![("head", RowValue::Null)])).await;
    let damaged = save(&link(&peer, LONG), 1).await.expect_err("nonsense");
    assert!(matches!(damaged, StoreError::Damaged(_)), "{damaged}");
}
