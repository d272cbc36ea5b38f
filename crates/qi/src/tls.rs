//! TLS with trust on first use: certificates of peers are signed by nobody, so each is known again by its fingerprint.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::{CryptoProvider, ring, verify_tls12_signature, verify_tls13_signature};
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::{CertificateError, ClientConfig, DigitallySignedStruct, Error, SignatureScheme};
use tokio::net::TcpStream;
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;

use crate::error::ConnectError;
use crate::fingerprint::Fingerprint;
use crate::locked::locked;

/// The certificates that are accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Trust {
    /// Whichever is shown: the first time. Keep its fingerprint and trust only that one later.
    #[default]
    First,
    /// This one only.
    Only(Fingerprint),
}

/// Agrees on TLS with a peer; answers with what its certificate is known by.
pub(crate) async fn agree(
    stream: TcpStream,
    host: &str,
    trust: Trust,
    within: Duration,
) -> Result<(TlsStream<TcpStream>, Fingerprint), ConnectError> {
    let seen =
        Arc::new(SeenCertificate { trust, found: Mutex::new(None), provider: Arc::new(ring::default_provider()) });
    let name = ServerName::try_from(host.to_owned()).or_else(|_| ServerName::try_from("peer"));
    let name = name.map_err(|error| ConnectError::Tls(error.to_string()))?;
    let connector = TlsConnector::from(Arc::new(config(&seen).map_err(|error| ConnectError::Tls(error.to_string()))?));
    let agreed = tokio::time::timeout(within, connector.connect(name, stream)).await;
    let found = *locked(&seen.found);
    match (agreed, found) {
        (Err(_), _) => Err(ConnectError::Timeout(within)),
        (Ok(Ok(stream)), Some(found)) => Ok((stream, found)),
        (Ok(Ok(_)), None) => Err(ConnectError::Tls("no certificate was shown".to_owned())),
        (Ok(Err(error)), found) => Err(match (trust, found) {
            (Trust::Only(expected), Some(found)) if found != expected => {
                ConnectError::CertificateChanged { expected, found }
            }
            _ => ConnectError::Tls(error.to_string()),
        }),
    }
}

fn config(seen: &Arc<SeenCertificate>) -> Result<ClientConfig, Error> {
    let config =
        ClientConfig::builder_with_provider(Arc::clone(&seen.provider)).with_safe_default_protocol_versions()?;
    let verifier: Arc<dyn ServerCertVerifier> = Arc::clone(seen) as Arc<dyn ServerCertVerifier>;
    let mut config = config.dangerous().with_custom_certificate_verifier(verifier).with_no_client_auth();
    // Each link looks at the certificate itself.
    config.resumption = rustls::client::Resumption::disabled();
    Ok(config)
}

/// Notes the certificate that is shown. Who shows it must also prove that it has its key.
#[derive(Debug)]
struct SeenCertificate {
    trust: Trust,
    found: Mutex<Option<Fingerprint>>,
    provider: Arc<CryptoProvider>,
}

impl ServerCertVerifier for SeenCertificate {
    fn verify_server_cert(
        &self,
        certificate: &CertificateDer<'_>,
        _others: &[CertificateDer<'_>],
        _name: &ServerName<'_>,
        _ocsp: &[u8],
        _now: UnixTime,
    ) -> Result<ServerCertVerified, Error> {
        let found = Fingerprint::of(certificate);
        *locked(&self.found) = Some(found);
        match self.trust {
            Trust::Only(expected) if found != expected => {
                Err(Error::InvalidCertificate(CertificateError::ApplicationVerificationFailure))
            }
            Trust::Only(_) | Trust::First => Ok(ServerCertVerified::assertion()),
        }
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls12_signature(message, certificate, signed, &self.provider.signature_verification_algorithms)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls13_signature(message, certificate, signed, &self.provider.signature_verification_algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.provider.signature_verification_algorithms.supported_schemes()
    }
}
