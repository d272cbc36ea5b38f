//! Connecting: each stage that can fail, both generations, and directories that lie.

use std::time::Duration;

use qi::{
    ConnectError, ConnectionStage, Credentials, Generation, LinkEnding, Malformed, QiError, Session, SessionOptions,
    Value,
};

use crate::fake::{self, Manner};

async fn connect(manner: Manner, options: SessionOptions) -> Result<Session, QiError> {
    let at = fake::start(manner).await;
    Session::connect(&format!("tcp://{at}").parse().unwrap(), options).await
}

fn nao(password: &str) -> SessionOptions {
    let credentials = Credentials { user: "nao".to_owned(), password: password.to_owned() };
    SessionOptions { credentials: Some(credentials), ..SessionOptions::default() }
}

#[tokio::test]
async fn the_generation_of_2014_is_spoken_too() {
    let session = connect(Manner { is_old: true, ..Manner::default() }, nao("unused")).await.unwrap();
    let agreed = session.link().agreed().unwrap().clone();
    assert_eq!(agreed.generation, Generation::Capabilities);
    assert!(!agreed.object_uid && !agreed.relative_endpoints);
    assert_eq!(session.services().await.unwrap().len(), 2);
    let thing = session.service("Thing").await.unwrap();
    assert_eq!(thing.call("echo", &["a".into()]).await.unwrap(), Value::dynamic("a"));
    session.link().ping(Duration::from_secs(60)).await.unwrap();
}

#[tokio::test]
async fn a_password_lets_in_and_a_wrong_one_is_refused_in_the_peers_words() {
    let manner = Manner { password: Some("secret".to_owned()), ..Manner::default() };
    let session = connect(manner.clone(), nao("secret")).await.unwrap();
    assert_eq!(session.link().agreed().unwrap().generation, Generation::Authenticate);
    let refused = connect(manner, nao("wrong")).await.unwrap_err();
    let cause = ConnectError::Refused("User is not authorized".to_owned());
    assert_eq!(refused, QiError::Connect { stage: ConnectionStage::Login, cause });
    assert!(!refused.retryable());
    assert!(!format!("{:?}", nao("secret")).contains("secret"));
}

#[tokio::test]
async fn every_stage_is_named_when_it_fails() {
    let within = Duration::from_millis(50);
    let quick = SessionOptions { stage_within: within, ..SessionOptions::default() };
    let stage = |error: QiError| match error {
        QiError::Connect { stage, cause } => (stage, cause),
        other => unreachable!("{other:?}"),
    };
    let nobody = Session::connect(&"tcp://nobody.invalid:1".parse().unwrap(), SessionOptions::default()).await;
    assert_eq!(stage(nobody.unwrap_err()).0, ConnectionStage::Name);
    let closed = Session::connect(&"tcp://127.0.0.1:1".parse().unwrap(), SessionOptions::default()).await;
    let refused = (ConnectionStage::Tcp, ConnectError::Io(std::io::ErrorKind::ConnectionRefused));
    assert_eq!(stage(closed.unwrap_err()), refused);
    let silent = connect(Manner { is_silent: true, ..Manner::default() }, quick).await;
    assert_eq!(stage(silent.unwrap_err()), (ConnectionStage::Login, ConnectError::Timeout(within)));
    let web = Manner { garbage: Some(b"HTTP/1.1 400 Bad Request\r\n\r\n".to_vec()), ..Manner::default() };
    let (at, cause) = stage(connect(web, SessionOptions::default()).await.unwrap_err());
    assert_eq!(at, ConnectionStage::Login);
    let ConnectError::Call(call) = cause else { unreachable!("{cause:?}") };
    assert!(matches!(*call, QiError::Disconnected(LinkEnding::Malformed(Malformed::Magic { .. }))));
}

#[tokio::test]
async fn a_directory_that_lies_leads_nowhere() {
    // Dialled by its name, so that 127.0.0.1 with another port could be meant; another host never is.
    let lies = ["tcp://10.255.255.1:9559", "tcp://robot.invalid:9559", "tcp://[::1]:1", "nonsense"];
    let manner = Manner { endpoints: lies.map(str::to_owned).to_vec(), ..Manner::default() };
    let session = connect(manner, SessionOptions::default()).await.unwrap();
    let error = session.service("Thing").await.unwrap_err();
    let expected = ConnectError::NoEndpoint { service: "Thing".to_owned(), offered: lies.map(str::to_owned).to_vec() };
    assert_eq!(error, QiError::Connect { stage: ConnectionStage::Service, cause: expected });
    let none = session.service("Other").await.unwrap_err();
    assert_eq!(none, QiError::NoService { name: "Other".to_owned() });
    assert_eq!(none.to_string(), "there is no service Other");
}

#[tokio::test]
async fn a_service_of_another_process_of_the_host_is_dialled() {
    let other = fake::start(Manner::default()).await;
    let manner =
        Manner { endpoints: vec!["tcp://10.255.255.1:1".to_owned(), format!("tcp://{other}")], ..Manner::default() };
    let session = connect(manner, SessionOptions::default()).await.unwrap();
    let thing = session.service("Thing").await.unwrap();
    assert_eq!(thing.call("echo", &[1.into()]).await.unwrap(), Value::dynamic(1));
    session.link().close();
    assert!(thing.call("echo", &[1.into()]).await.is_ok(), "it has a link of its own");
}
