//! Everything that the real libqi does, done with it.

use std::time::Duration;

use qi::{EventChoice, Generation, LinkEnding, Object, QiError, Value};

use crate::real_peer::{Peer, everything, python};

const SHORT: Duration = Duration::from_millis(20);

#[tokio::test]
async fn libqi_chooses_the_method_that_we_chose() {
    let Some((_peer, session, object)) = everything("overloads of libqi").await else { return };
    assert_eq!(session.link().agreed().unwrap().generation, Generation::Authenticate);
    let cases: [(&[Value], &str); 6] = [
        (&[Value::from(3)], "int 3"),
        (&[Value::from(2.5)], "float 2.5"),
        (&[Value::from("a")], "text a"),
        (&[Value::from(vec![1.0, 2.0])], "list 2"),
        (&[Value::from(vec![1, 2, 3])], "list 3"),
        (&["a".into(), 7.into()], "two a 7"),
    ];
    for (arguments, expected) in cases {
        assert_eq!(object.call("pick", arguments).await.unwrap().as_text().unwrap(), expected);
    }
    let refused = object.call("pick", &[true.into()]).await.unwrap_err();
    let QiError::NoMethod { candidates, given, .. } = refused else { unreachable!("{refused:?}") };
    assert_eq!((candidates.len(), given.as_str()), (5, "(b)"));
}

#[tokio::test]
async fn values_of_all_kinds_go_there_and_back() {
    let Some((_peer, _session, object)) = everything("values of libqi").await else { return };
    object.call("setAngles", &["HeadYaw".into(), 0.5.into(), 0.1.into()]).await.unwrap();
    assert_eq!(object.call("angle", &["HeadYaw".into()]).await.unwrap(), Value::F32(0.5));
    object.post("setAngles", &["HeadYaw".into(), 1.into(), 0.1.into()]).unwrap();
    while object.call("angle", &["HeadYaw".into()]).await.unwrap() != Value::F32(1.0) {}
    let map = Value::map([("a", 1.into()), ("b", (-2).into())]);
    assert_eq!(object.call("mapped", std::slice::from_ref(&map)).await.unwrap(), map);
    let raw: Vec<u8> = (0..1000).map(|at: u32| (at % 256) as u8).collect();
    assert_eq!(object.call("raw", &[1000.into()]).await.unwrap(), Value::Raw(raw));
    let nested = object.call("nested", &[]).await.unwrap();
    let nested = nested.items().unwrap();
    assert_eq!(nested[0].items().unwrap()[1].as_i64(), Some(2));
    let inner = nested[1].get("a").unwrap().items().unwrap();
    assert_eq!(inner[0].as_f64(), Some(0.5));
    assert_eq!(inner[1].items().unwrap()[1].as_text().unwrap(), "hé你");
    assert_eq!(nested[2].seen(), &Value::Unit);
    let echo = object.call("echo", &[Value::Tuple(vec![1.into(), "a".into(), vec![true].into()])]).await.unwrap();
    assert_eq!(echo.items().unwrap()[1].as_text().unwrap(), "a");
    let anyone = object.call("anyone", &[1.into(), "b".into(), 2.5.into()]).await.unwrap();
    assert_eq!(anyone.as_i64(), Some(3));
}

#[tokio::test]
async fn texts_that_are_no_utf8_harm_nobody() {
    let Some((_peer, session, object)) = everything("bytes of libqi").await else { return };
    let bytes = Value::Str(vec![0xFF, 0, b'a']);
    // Python itself cannot read them: an error of that call, and the link goes on.
    let _either = object.call("echo", &[bytes]).await;
    // Where a service is, is told with a uid of 20 bytes in a text.
    assert!(session.services().await.unwrap().iter().any(|service| service.name == "Everything"));
}

#[tokio::test]
async fn failures_are_in_the_words_of_the_peer() {
    let Some((_peer, session, object)) = everything("failures of libqi").await else { return };
    let failed = object.call("fail", &[]).await.unwrap_err();
    assert!(matches!(&failed, QiError::Remote { .. }) && failed.to_string().contains("not today"), "{failed:?}");
    assert!(!failed.retryable());
    assert_eq!(session.service("Nobody").await.unwrap_err(), QiError::NoService { name: "Nobody".to_owned() });
}

#[tokio::test]
async fn a_slow_call_is_given_up_and_holds_nothing_back() {
    let Some((_peer, session, object)) = everything("slow calls of libqi").await else { return };
    let slow = object.call_within("slow", &[0.3.into()], SHORT).await;
    assert!(matches!(slow, Err(QiError::Timeout { .. })), "{slow:?}");
    assert_eq!(object.call("pick", &[1.into()]).await.unwrap().as_text().unwrap(), "int 1");
    assert!(object.call("slow", &[0.0.into()]).await.is_ok());
    while session.link().late_answers() == 0 {
        session.link().ping(Duration::from_secs(60)).await.unwrap();
    }
    assert_eq!(session.link().in_flight(), 0);
}

#[tokio::test]
async fn signals_carry_what_they_say() {
    let Some((_peer, _session, object)) = everything("signals of libqi").await else { return };
    let mut told = object.subscribe("told", EventChoice::All(8)).await.unwrap();
    let mut twice = object.subscribe("told", EventChoice::All(8)).await.unwrap();
    let mut measured = object.subscribe("measured", EventChoice::Newest).await.unwrap();
    let mut anything = object.subscribe("anything", EventChoice::Newest).await.unwrap();
    for method in ["measure", "any"] {
        object.call(method, &[]).await.unwrap();
    }
    for text in ["a", "b"] {
        object.call("tell", &[text.into()]).await.unwrap();
        for listener in [&mut told, &mut twice] {
            assert_eq!(listener.next().await.unwrap().arguments, [Value::from(text)], "one copy each");
        }
    }
    let expected = [0.5_f32.into(), 7.into(), vec![1_f32, 2.0].into()];
    assert_eq!(measured.next().await.unwrap().arguments, expected);
    let map = anything.next().await.unwrap().arguments;
    assert_eq!(map[0].get("a").unwrap().items().unwrap()[1].as_text().unwrap(), "b");
}

#[tokio::test]
async fn the_peer_knows_when_nobody_listens_any_more() {
    let Some((_peer, _session, object)) = everything("subscribers of libqi").await else { return };
    let is_listened = async || object.call("is_listened", &[]).await.unwrap().as_bool().unwrap();
    assert!(!is_listened().await);
    let (first, second) = (
        object.subscribe("listened", EventChoice::Newest).await,
        object.subscribe("listened", EventChoice::Newest).await,
    );
    assert!(is_listened().await);
    drop(first);
    assert!(is_listened().await);
    drop(second);
    while is_listened().await {}
}

#[tokio::test]
async fn a_thousand_events_a_second_all_arrive() {
    let Some((_peer, _session, object)) = everything("many events of libqi").await else { return };
    let mut told = object.subscribe("told", EventChoice::All(4096)).await.unwrap();
    object.call("burst", &[1000.into()]).await.unwrap();
    let mut seen = Vec::new();
    while seen.len() < 1000 {
        seen.push(told.next().await.unwrap().arguments[0].as_text().unwrap().parse::<u32>().unwrap());
    }
    // libqi does not keep the order strictly.
    seen.sort_unstable();
    assert_eq!(seen, (0..1000).collect::<Vec<_>>());
    assert_eq!(told.lost(), 0);
}

#[tokio::test]
async fn properties_are_read_set_and_listened_to() {
    let Some((_peer, _session, object)) = everything("properties of libqi").await else { return };
    assert_eq!(object.property("level").await.unwrap().as_i64(), Some(3));
    let mut changes = object.subscribe("level", EventChoice::All(4)).await.unwrap();
    object.set_property("level", 8.into()).await.unwrap();
    assert_eq!(object.property("level").await.unwrap().as_i64(), Some(8));
    assert_eq!(changes.next().await.unwrap().arguments[0].as_i64(), Some(8));
    assert!(object.set_property("level", "high".into()).await.is_err());
    assert!(matches!(object.property("none").await, Err(QiError::NoMember { .. })));
}

#[tokio::test]
async fn an_object_that_a_method_gives_out_can_be_listened_to_and_ends() {
    let Some((_peer, session, object)) = everything("objects of libqi").await else { return };
    let key = object.call_object("subscriber", &["Touch".into()]).await.unwrap();
    assert_eq!(key.call("name", &[]).await.unwrap().as_text().unwrap(), "Touch");
    let mut signal = key.subscribe("signal", EventChoice::All(4)).await.unwrap();
    key.call("raise_it", &[1.5.into()]).await.unwrap();
    assert_eq!(signal.next().await.unwrap().arguments[0].as_f64(), Some(1.5));
    let not_one = object.call_object("nested", &[]).await.unwrap_err();
    assert!(matches!(not_one, QiError::Unexpected { wanted: "an object", .. }));
    drop((signal, key));
    // Two who hold the same one: with the first it ends.
    let value = object.call("subscriber", &["Touch".into()]).await.unwrap();
    let held = || Object::from_value(session.link(), &value, Duration::from_secs(60)).unwrap();
    let (first, second) = (held(), held());
    drop(first);
    while second.call("name", &[]).await.is_ok() {}
}

#[tokio::test]
async fn a_service_that_comes_back_has_another_number_and_is_found() {
    let Some((_peer, session, _object)) = everything("services of libqi").await else { return };
    let comings = session.service("Comings").await.unwrap();
    let (mut added, mut removed) = (session.added().await.unwrap(), session.removed().await.unwrap());
    let mut numbers = Vec::new();
    for _ in 0..2 {
        comings.call("come", &[]).await.unwrap();
        assert_eq!(added.next().await.unwrap().arguments[1].as_text().unwrap(), "Guest");
        let guest = session.service("Guest").await.unwrap();
        numbers.push(guest.service_id());
        assert_eq!(guest.call("pick", &[1.into()]).await.unwrap().as_text().unwrap(), "int 1");
        comings.call("go", &[]).await.unwrap();
        assert_eq!(removed.next().await.unwrap().arguments[1].as_text().unwrap(), "Guest");
        assert!(guest.call("pick", &[1.into()]).await.is_err());
        // Ours has heard of it before or soon.
        while session.service("Guest").await.is_ok() {
            tokio::task::yield_now().await;
        }
    }
    assert_ne!(numbers[0], numbers[1]);
}

#[tokio::test]
async fn a_service_of_another_process_has_its_own_link() {
    let Some(python) = python("two processes of libqi") else { return };
    let host = Peer::start(&python, &["host"]);
    let _neighbour = Peer::start(&python, &["join", &host.address]);
    let session = host.connect().await;
    let neighbour = session.service("Neighbour").await.unwrap();
    assert_eq!(neighbour.call("pick", &[1.into()]).await.unwrap().as_text().unwrap(), "int 1");
    session.link().close();
    assert!(neighbour.call("pick", &[1.into()]).await.is_ok());
}

#[tokio::test]
async fn the_end_of_the_peer_ends_everything_that_waits() {
    let Some((peer, session, object)) = everything("the end of libqi").await else { return };
    let mut told = object.subscribe("told", EventChoice::Newest).await.unwrap();
    let slow = tokio::spawn(async move { object.call("slow", &[60.0.into()]).await });
    while session.link().in_flight() == 0 {
        tokio::task::yield_now().await;
    }
    drop(peer);
    assert!(matches!(slow.await.unwrap(), Err(QiError::Disconnected(_))));
    assert!(matches!(told.next().await, Err(QiError::Disconnected(_))));
    assert_ne!(session.link().ended().await, LinkEnding::Here);
}
