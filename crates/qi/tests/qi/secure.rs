//! TLS: a certificate that nobody signed is known again by its fingerprint.

use std::sync::Arc;

use qi::{ConnectError, ConnectionStage, Credentials, Fingerprint, QiError, Session, SessionOptions, Trust, Value};
use rustls::pki_types::CertificateDer;

use crate::fake::{self, Manner};

fn certificate() -> (CertificateDer<'static>, Arc<Vec<u8>>) {
    let key = rcgen::KeyPair::generate().unwrap();
    let certificate = rcgen::CertificateParams::new(vec!["robot".to_owned()]).unwrap().self_signed(&key).unwrap();
    (certificate.der().clone(), Arc::new(key.serialize_der()))
}

async fn connect(at: &str, trust: Trust) -> Result<Session, QiError> {
    let credentials = Credentials { user: "nao".to_owned(), password: "secret".to_owned() };
    let options = SessionOptions { credentials: Some(credentials), trust, ..SessionOptions::default() };
    Session::connect(&format!("tcps://{at}").parse().unwrap(), options).await
}

fn robot() -> Manner {
    Manner { password: Some("secret".to_owned()), certificate: Some(certificate()), ..Manner::default() }
}

#[tokio::test]
async fn a_certificate_is_trusted_at_first_and_must_stay() {
    let first = fake::start(robot()).await;
    let session = connect(&first, Trust::First).await.unwrap();
    let expected = session.fingerprint().unwrap();
    let thing = session.service("Thing").await.unwrap();
    assert_eq!(thing.call("echo", &["a".into()]).await.unwrap(), Value::dynamic("a"));
    assert_eq!(connect(&first, Trust::Only(expected)).await.unwrap().fingerprint(), Some(expected));

    let other = fake::start(robot()).await;
    let changed = connect(&other, Trust::Only(expected)).await.unwrap_err();
    let QiError::Connect {
        stage: ConnectionStage::Tls,
        cause: ConnectError::CertificateChanged { expected: before, found },
    } = &changed
    else {
        unreachable!("{changed:?}")
    };
    assert!(*before == expected && *found != expected);
    assert!(changed.to_string().contains("the certificate changed"), "{changed}");
    assert!(!changed.retryable());
}

#[tokio::test]
async fn a_peer_without_tls_fails_at_that_stage() {
    let plain = fake::start(Manner { garbage: Some(b"not TLS at all".to_vec()), ..Manner::default() }).await;
    let error = connect(&plain, Trust::First).await.unwrap_err();
    assert!(
        matches!(error, QiError::Connect { stage: ConnectionStage::Tls, cause: ConnectError::Tls(_) }),
        "{error:?}"
    );
}

#[test]
fn a_fingerprint_is_written_and_read() {
    let fingerprint = Fingerprint::of(b"anything");
    assert_eq!(fingerprint.to_string().parse(), Ok(fingerprint));
    for text in ["", "AB", "zz:", &"AB:".repeat(32)] {
        assert_eq!(text.parse::<Fingerprint>(), Err(()));
    }
}
