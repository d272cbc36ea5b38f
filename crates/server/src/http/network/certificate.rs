//! The certificate that others see: one's own, or one that the server makes once and keeps, so that its fingerprint stays
//! the one people compared.

use crate::support::{atomic_file, now_ms};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use rcgen::{CertificateParams, DnType, ExtendedKeyUsagePurpose, KeyPair};
use ring::digest::{SHA256, digest};
use rustls::ServerConfig;
use rustls::crypto::ring as provider;
use rustls::pki_types::pem::{self, PemObject};
use rustls::pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer};
use rustls::sign::{CertifiedKey, SingleCertAndKey};
use serde::{Deserialize, Serialize};
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The file of the certificate that the server made, with its key.
const FILE: &str = "rrp.certificate.json";
/// How long such a certificate is good, in milliseconds.
const GOOD_MS: u64 = 730 * DAY_MS;
/// How long before that it is made anew, in milliseconds.
const ANEW_MS: u64 = 30 * DAY_MS;
const DAY_MS: u64 = 24 * 60 * 60 * 1_000;

/// What keeps what others say from being read on the way.
#[derive(Clone, Debug)]
pub enum Secured {
    /// A certificate that the server makes and keeps in its data folder.
    Made,
    /// One's own, both as PEM files.
    Own {
        /// The certificate, with those that vouch for it.
        certificate: PathBuf,
        /// Its key.
        key: PathBuf,
    },
    /// A proxy does it, and nobody else reaches the address.
    Proxy {
        /// What browsers reach it by: `https://rrp.example`.
        origin: String,
    },
}

/// Why there is no certificate.
#[derive(Debug)]
pub enum NoCertificate {
    /// This file of one's own cannot be used; with the reason.
    Own(PathBuf, String),
    /// Certificate and key do not go together; with the reason.
    Misfit(String),
    /// None could be made; with the reason.
    NotMade(String),
}

/// A certificate that is ready to be shown.
pub(super) struct Certificate {
    /// How TLS is spoken, by whoever it is shown to.
    pub(super) config: ServerConfig,
    pub(super) key: Arc<CertifiedKey>,
    /// What people compare, if the server made it.
    pub(super) fingerprint: Option<String>,
}

/// A certificate as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct KeptCertificate {
    /// For which names it is good.
    names: Vec<String>,
    until_ms: u64,
    certificate: String,
    key: String,
}

impl Certificate {
    /// The one that is wished, for who reaches this computer by that address.
    pub(super) fn of(secured: &Secured, data: Option<&Path>, reached: IpAddr) -> Result<Self, NoCertificate> {
        match secured {
            Secured::Own { certificate, key } => {
                let chain = CertificateDer::pem_file_iter(certificate).and_then(Iterator::collect);
                let chain: Vec<_> = chain.map_err(|error| unreadable(certificate, &error))?;
                let key_der = PrivateKeyDer::from_pem_file(key).map_err(|error| unreadable(key, &error))?;
                Self::ready(chain, key_der, None)
            }
            Secured::Made | Secured::Proxy { .. } => {
                let (certificate, key) = made(data, &names(reached))?;
                let fingerprint = Some(fingerprint(&certificate));
                Self::ready(vec![certificate], PrivatePkcs8KeyDer::from(key).into(), fingerprint)
            }
        }
    }

    fn ready(
        chain: Vec<CertificateDer<'static>>,
        key: PrivateKeyDer<'static>,
        fingerprint: Option<String>,
    ) -> Result<Self, NoCertificate> {
        let misfit = |error: rustls::Error| NoCertificate::Misfit(error.to_string());
        let provider = Arc::new(provider::default_provider());
        let key = Arc::new(CertifiedKey::from_der(chain, key, &provider).map_err(misfit)?);
        // 1.3 alone, whatever else the library may know here.
        let config = ServerConfig::builder_with_provider(provider).with_protocol_versions(&[&rustls::version::TLS13]);
        let shown = Arc::new(SingleCertAndKey::from(Arc::clone(&key)));
        let mut config = config.map_err(misfit)?.with_no_client_auth().with_cert_resolver(shown);
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        Ok(Self { config, key, fingerprint })
    }
}

fn unreadable(file: &Path, error: &pem::Error) -> NoCertificate {
    NoCertificate::Own(file.to_owned(), error.to_string())
}

/// By which names a browser may reach this computer.
fn names(reached: IpAddr) -> Vec<String> {
    vec!["localhost".to_owned(), reached.to_string()]
}

/// The kept certificate and its key, or new ones if there are none that fit.
fn made(data: Option<&Path>, names: &[String]) -> Result<(CertificateDer<'static>, Vec<u8>), NoCertificate> {
    let file = data.map(|data| data.join(FILE));
    let kept: Option<KeptCertificate> = file.as_deref().and_then(atomic_file::read);
    let fits = |kept: &KeptCertificate| kept.until_ms > now_ms().saturating_add(ANEW_MS) && kept.names == names;
    let read = kept.filter(fits).and_then(|kept| {
        Some((CertificateDer::from(STANDARD.decode(kept.certificate).ok()?), STANDARD.decode(kept.key).ok()?))
    });
    if let Some(read) = read {
        return Ok(read);
    }
    let until_ms = now_ms().saturating_add(GOOD_MS);
    let (certificate, key) = make(names, until_ms).map_err(|error| NoCertificate::NotMade(error.to_string()))?;
    if let Some(file) = file {
        let (names, certificate, key) = (names.to_vec(), STANDARD.encode(&certificate), STANDARD.encode(&key));
        let text = serde_json::to_string_pretty(&KeptCertificate { names, until_ms, certificate, key });
        let put = text.map_err(std::io::Error::other).and_then(|text| atomic_file::put(&file, &text));
        if let Err(error) = put {
            tracing::warn!(%error, "the certificate could not be kept: the next start makes another one");
        }
    }
    Ok((certificate, key))
}

fn make(names: &[String], until_ms: u64) -> Result<(CertificateDer<'static>, Vec<u8>), rcgen::Error> {
    let key = KeyPair::generate()?;
    let mut params = CertificateParams::new(names)?;
    params.distinguished_name.push(DnType::CommonName, "rrp");
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    let day = |ms: u64| time::OffsetDateTime::UNIX_EPOCH + Duration::from_millis(ms);
    // Clocks of tablets may be behind.
    params.not_before = day(now_ms().saturating_sub(DAY_MS));
    params.not_after = day(until_ms);
    Ok((params.self_signed(&key)?.der().clone(), key.serialize_der()))
}

/// As browsers show it: `AB:CD:…`.
fn fingerprint(certificate: &CertificateDer) -> String {
    let hash = digest(&SHA256, certificate);
    hash.as_ref().iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(":")
}

#[cfg(test)]
mod tests {
    use super::{Certificate, NoCertificate, Secured, fingerprint, made};

    #[test]
    fn a_made_certificate_stays_until_the_address_changes() {
        let folder = tempfile::tempdir().unwrap();
        let fingerprint = |address: &str| {
            let made = Certificate::of(&Secured::Made, Some(folder.path()), address.parse().unwrap());
            made.unwrap().fingerprint.unwrap()
        };
        let first = fingerprint("192.168.1.5");
        assert_eq!((first.len(), fingerprint("192.168.1.5")), (95, first.clone()));
        assert_ne!(fingerprint("192.168.1.6"), first);
    }

    #[cfg(unix)]
    #[test]
    fn nobody_else_on_this_computer_reads_its_key() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        made(Some(folder.path()), &["localhost".to_owned()]).unwrap();
        let mode = std::fs::metadata(folder.path().join(super::FILE)).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }

    #[test]
    fn a_file_of_ones_own_that_is_none_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let (certificate, key) = (folder.path().join("cert.pem"), folder.path().join("key.pem"));
        std::fs::write(&certificate, "nonsense").unwrap();
        let secured = Secured::Own { certificate, key: key.clone() };
        let of = || Certificate::of(&secured, None, "10.0.0.1".parse().unwrap());
        assert!(matches!(of(), Err(NoCertificate::Misfit(_) | NoCertificate::Own(..))));
        let (der, _) = made(None, &["localhost".to_owned()]).unwrap();
        assert_eq!(fingerprint(&der).len(), 95);
    }
}
