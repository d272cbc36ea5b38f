//! Calls, events and their bounds on one link.

use std::time::Duration;

use qi::{EventChoice, IN_FLIGHT_MAX, LinkEnding, Malformed, Object, QiError, Session, SessionOptions, Value};

use crate::fake::{self, Manner};

/// Only what never answers is waited for so shortly.
const SHORT: Duration = Duration::from_millis(50);

async fn thing(manner: Manner) -> (Session, Object) {
    let at = fake::start(manner).await;
    let patient = Duration::from_secs(60);
    let options = SessionOptions { stage_within: patient, call_within: patient, ..SessionOptions::default() };
    let session = Session::connect(&format!("tcp://{at}").parse().unwrap(), options).await.unwrap();
    let thing = session.service("Thing").await.unwrap();
    (session, thing)
}

#[tokio::test]
async fn a_peer_that_sends_byte_by_byte_is_understood() {
    let (session, thing) = thing(Manner { is_slow: true, ..Manner::default() }).await;
    assert_eq!(session.services().await.unwrap().len(), 2);
    assert_eq!(thing.call("echo", &["a".into()]).await.unwrap(), Value::dynamic("a"));
}

#[tokio::test]
async fn an_answer_after_its_time_is_dropped_and_takes_no_place() {
    let (session, thing) = thing(Manner::default()).await;
    let late = thing.call_within("late", &[], SHORT).await;
    assert_eq!(late, Err(QiError::Timeout { what: "Thing.late".to_owned(), within: SHORT }));
    assert!(late.unwrap_err().retryable());
    assert_eq!(session.link().in_flight(), 0);
    assert_eq!(thing.call("echo", &[2.into()]).await.unwrap(), Value::dynamic(2));
    assert_eq!(session.link().late_answers(), 1);
}

#[tokio::test]
async fn one_call_more_than_64_is_refused_at_once() {
    let (session, thing) = thing(Manner::default()).await;
    let calls: Vec<_> = (0..IN_FLIGHT_MAX)
        .map(|_| {
            let thing = thing.clone();
            tokio::spawn(async move { thing.call("late", &[]).await })
        })
        .collect();
    while session.link().in_flight() < IN_FLIGHT_MAX {
        tokio::task::yield_now().await;
    }
    let refused = thing.call("late", &[]).await;
    assert_eq!(refused, Err(QiError::Busy { what: "calls", limit: IN_FLIGHT_MAX }));
    session.link().close();
    for call in calls {
        assert_eq!(call.await.unwrap(), Err(QiError::Disconnected(LinkEnding::Here)));
    }
    assert_eq!(thing.post("late", &[]), Err(QiError::Disconnected(LinkEnding::Here)));
}

#[tokio::test]
async fn giving_up_a_call_frees_its_place() {
    let (session, thing) = thing(Manner::default()).await;
    assert!(tokio::time::timeout(SHORT, thing.call("late", &[])).await.is_err());
    assert_eq!(session.link().in_flight(), 0);
}

#[tokio::test]
async fn a_silent_peer_is_found_by_a_ping() {
    let (session, thing) = thing(Manner::default()).await;
    session.link().ping(Duration::from_secs(60)).await.unwrap();
    thing.post("mute", &[]).unwrap();
    let silent = session.link().ping(SHORT).await;
    assert!(matches!(silent, Err(QiError::Timeout { .. })), "{silent:?}");
    assert!(session.link().silent_for() >= SHORT);
    assert_eq!(session.link().ending(), None, "that is for the supervisor to decide");
}

#[tokio::test]
async fn what_is_no_protocol_ends_the_link_and_says_so() {
    let (_, huge) = thing(Manner::default()).await;
    let too_large = huge.call("huge", &[]).await;
    assert!(
        matches!(too_large, Err(QiError::Disconnected(LinkEnding::Malformed(Malformed::TooLarge { .. })))),
        "{too_large:?}"
    );
    let (session, garbage) = thing(Manner::default()).await;
    let no_magic = garbage.call("garbage", &[]).await;
    assert!(
        matches!(no_magic, Err(QiError::Disconnected(LinkEnding::Malformed(Malformed::Magic { .. })))),
        "{no_magic:?}"
    );
    assert_eq!(Err(QiError::Disconnected(session.link().ended().await)), no_magic.map(|_| ()));
}

#[tokio::test]
async fn an_answer_that_cannot_be_read_harms_only_its_call() {
    let (_session, thing) = thing(Manner::default()).await;
    assert!(matches!(thing.call("short", &[]).await, Err(QiError::Malformed(Malformed::Short { .. }))));
    let failed = QiError::Remote { module: Some("Thing::fail".to_owned()), text: "not today".to_owned() };
    assert_eq!(thing.call("fail", &[]).await, Err(failed));
    assert_eq!(thing.call("echo", &[1.into()]).await.unwrap(), Value::dynamic(1));
}

async fn registrations(thing: &Object) -> Vec<i64> {
    let value = thing.call("registrations", &[]).await.unwrap();
    value.items().unwrap().iter().map(|number| number.as_i64().unwrap()).collect()
}

#[tokio::test]
async fn one_registration_serves_all_listeners_here() {
    let (_session, thing) = thing(Manner::default()).await;
    let before = registrations(&thing).await;
    assert_eq!(before, [2, 2], "the session listens to the directory");
    let mut first = thing.subscribe("tick", EventChoice::All(10)).await.unwrap();
    let mut second = thing.subscribe("tick", EventChoice::All(10)).await.unwrap();
    let mut newest = thing.subscribe("tick", EventChoice::Newest).await.unwrap();
    assert_eq!(registrations(&thing).await, [3, 3]);
    thing.call("raise", &[3.into()]).await.unwrap();
    for subscription in [&mut first, &mut second] {
        for number in 0..3_u32 {
            assert_eq!(subscription.next().await.unwrap().arguments, [Value::from(number)]);
        }
        assert_eq!(subscription.lost(), 0);
    }
    assert_eq!(newest.next().await.unwrap().arguments, [Value::from(2_u32)]);
    assert_eq!(newest.lost(), 2);
    drop((first, newest));
    assert_eq!(registrations(&thing).await, [3, 3]);
    drop(second);
    assert_eq!(registrations(&thing).await, [3, 2], "the last one tells the peer");
    let _again = thing.subscribe("tick", EventChoice::Newest).await.unwrap();
    assert_eq!(registrations(&thing).await, [4, 3]);
}

#[tokio::test]
async fn a_slow_listener_loses_the_oldest_and_knows_how_many() {
    let (_session, thing) = thing(Manner::default()).await;
    let mut slow = thing.subscribe("tick", EventChoice::All(100)).await.unwrap();
    thing.call("raise", &[10_000.into()]).await.unwrap();
    assert_eq!(slow.lost(), 9_900);
    assert_eq!(slow.next().await.unwrap().arguments, [Value::from(9_900_u32)]);
    assert_eq!(thing.call("echo", &[1.into()]).await.unwrap(), Value::dynamic(1));
}

#[tokio::test]
async fn listeners_are_told_of_the_end_after_what_came() {
    let (session, thing) = thing(Manner::default()).await;
    let mut listener = thing.subscribe("tick", EventChoice::All(10)).await.unwrap();
    thing.call("raise", &[1.into()]).await.unwrap();
    session.link().close();
    assert!(listener.next().await.is_ok());
    assert_eq!(listener.next().await, Err(QiError::Disconnected(LinkEnding::Here)));
    let nothing = thing.subscribe("nothing", EventChoice::Newest).await.unwrap_err();
    assert_eq!(nothing.to_string(), "Thing has no signal nothing");
}

#[tokio::test]
async fn what_a_stuck_peer_does_not_read_is_bounded_in_bytes() {
    let (here, _stuck) = tokio::io::duplex(1_024);
    let link = qi::QiLink::over(here);
    let target = qi::MemberTarget { service: 1, object: 1, action: 100 };
    let post = || link.post(target, 0, vec![0; 2 << 20]);
    let fit = (0..64).take_while(|_| post().is_ok()).count();
    assert_eq!(fit, qi::QUEUE_MAX_BYTES / (2 << 20) - 1, "with their headers");
    assert!(matches!(post(), Err(QiError::Busy { limit: qi::QUEUE_MAX_BYTES, .. })));
}
