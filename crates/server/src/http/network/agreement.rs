//! How TLS is agreed on with one connection, and whose tickets it leaves with.

use super::certificate::Certificate;
use super::tickets::{TicketHolder, Tickets};
use crate::support::digest::Digest;
use crate::support::lock;
use rustls::server::{ClientHello, ProducesTickets, ResolvesServerCert};
use rustls::sign::{CertifiedKey, Signer, SigningKey};
use rustls::{ServerConfig, SignatureAlgorithm, SignatureScheme};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use tokio_rustls::TlsAcceptor;
use uuid::Uuid;

/// How long browsers may keep a ticket, in seconds: as long as TLS allows.
const GOOD_SECONDS: u32 = 7 * 24 * 60 * 60;

/// A ticket that somebody showed, and who that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Proof {
    pub(super) holder: TicketHolder,
    /// The digest of a cookie that holds.
    pub(super) pass: Digest,
}

/// The certificate and the keys by which every connection agrees on TLS.
#[derive(Clone)]
pub(super) struct Agreement {
    config: Arc<ServerConfig>,
    key: Arc<CertifiedKey>,
    pub(super) tickets: Arc<Tickets>,
}

impl Agreement {
    pub(super) fn of(certificate: Certificate, tickets: Tickets) -> Self {
        let Certificate { config, key, .. } = certificate;
        Self { config: Arc::new(config), key, tickets: Arc::new(tickets) }
    }

    /// Prepares TLS with somebody who proved this of themselves; their tickets can be asked for afterwards.
    pub(super) fn with(&self, proof: Option<Proof>) -> (TlsAcceptor, Arc<Agreeing>) {
        let (id, opened, signed, gave) = (Uuid::new_v4(), Mutex::default(), Arc::default(), AtomicBool::default());
        let (tickets, key) = (Arc::clone(&self.tickets), Arc::clone(&self.key));
        let agreeing = Arc::new(Agreeing { tickets, key, proof, id, opened, signed, gave });
        let mut config = ServerConfig::clone(&self.config);
        config.ticketer = Arc::clone(&agreeing) as Arc<dyn ProducesTickets>;
        config.cert_resolver = Arc::clone(&agreeing) as Arc<dyn ResolvesServerCert>;
        (TlsAcceptor::from(Arc::new(config)), agreeing)
    }
}

/// One connection's tickets. That the hello shows a ticket proves nothing yet: it may be a copy. But whoever goes on
/// without the server having signed anything knows the secret that belongs to the ticket, and only they get new ones of
/// the same device.
pub(super) struct Agreeing {
    tickets: Arc<Tickets>,
    key: Arc<CertifiedKey>,
    proof: Option<Proof>,
    id: Uuid,
    /// Whose ticket was opened last: the one by which it goes on, if it does so by any.
    opened: Mutex<Option<TicketHolder>>,
    /// The server proved itself by its certificate: not by a ticket.
    signed: Arc<AtomicBool>,
    gave: AtomicBool,
}

impl Agreeing {
    /// The name of this connection, if it left with tickets that do not say themselves whose they are.
    pub(super) fn unproven(&self) -> Option<Uuid> {
        self.gave.load(Ordering::Acquire).then_some(self.id)
    }

    fn holder(&self) -> TicketHolder {
        let went_on = if self.signed.load(Ordering::Acquire) { None } else { *lock(&self.opened) };
        match self.proof {
            Some(proof) if went_on == Some(proof.holder) => TicketHolder::Device(proof.pass),
            Some(_) | None => TicketHolder::Connection(self.id),
        }
    }
}

impl ProducesTickets for Agreeing {
    fn enabled(&self) -> bool {
        true
    }

    fn lifetime(&self) -> u32 {
        GOOD_SECONDS
    }

    fn encrypt(&self, plain: &[u8]) -> Option<Vec<u8>> {
        let holder = self.holder();
        if matches!(holder, TicketHolder::Connection(_)) {
            self.gave.store(true, Ordering::Release);
        }
        self.tickets.seal(holder, plain)
    }

    fn decrypt(&self, ticket: &[u8]) -> Option<Vec<u8>> {
        let (holder, said) = self.tickets.open(ticket)?;
        *lock(&self.opened) = Some(holder);
        Some(said)
    }
}

impl ResolvesServerCert for Agreeing {
    fn resolve(&self, _: ClientHello) -> Option<Arc<CertifiedKey>> {
        let key = NotingKey { key: Arc::clone(&self.key.key), signed: Arc::clone(&self.signed) };
        Some(Arc::new(CertifiedKey::new(self.key.cert.clone(), Arc::new(key))))
    }
}

impl fmt::Debug for Agreeing {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.debug_struct("Agreeing").field("id", &self.id).finish_non_exhaustive()
    }
}

/// The certificate's key, which notes that it signed.
#[derive(Debug)]
struct NotingKey {
    key: Arc<dyn SigningKey>,
    signed: Arc<AtomicBool>,
}

impl SigningKey for NotingKey {
    fn choose_scheme(&self, offered: &[SignatureScheme]) -> Option<Box<dyn Signer>> {
        let signer = self.key.choose_scheme(offered)?;
        Some(Box::new(NotingSigner { signer, signed: Arc::clone(&self.signed) }))
    }

    fn algorithm(&self) -> SignatureAlgorithm {
        self.key.algorithm()
    }
}

#[derive(Debug)]
struct NotingSigner {
    signer: Box<dyn Signer>,
    signed: Arc<AtomicBool>,
}

impl Signer for NotingSigner {
    fn sign(&self, message: &[u8]) -> Result<Vec<u8>, rustls::Error> {
        self.signed.store(true, Ordering::Release);
        self.signer.sign(message)
    }

    fn scheme(&self) -> SignatureScheme {
        self.signer.scheme()
    }
}

#[cfg(test)]
mod tests {
    use super::{Agreeing, Agreement, Certificate, Digest, Proof, TicketHolder, Tickets};
    use crate::http::network::certificate::Secured;
    use crate::http::network::hello::Hello;
    use rustls::client::{ClientSessionMemoryCache, ClientSessionStore, Resumption, Tls12ClientSessionValue};
    use rustls::client::{Tls13ClientSessionValue, WebPkiServerVerifier};
    use rustls::crypto::ring;
    use rustls::pki_types::ServerName;
    use rustls::{ClientConfig, ClientConnection, NamedGroup, RootCertStore, ServerConnection};
    use std::sync::Arc;

    /// Shows every server the tickets of one.
    #[derive(Debug)]
    struct Careless(ClientSessionMemoryCache);

    impl ClientSessionStore for Careless {
        fn set_kx_hint(&self, _: ServerName<'static>, group: NamedGroup) {
            self.0.set_kx_hint(one(), group);
        }
        fn kx_hint(&self, _: &ServerName<'_>) -> Option<NamedGroup> {
            self.0.kx_hint(&one())
        }
        fn set_tls12_session(&self, _: ServerName<'static>, _: Tls12ClientSessionValue) {}
        fn tls12_session(&self, _: &ServerName<'_>) -> Option<Tls12ClientSessionValue> {
            None
        }
        fn remove_tls12_session(&self, _: &ServerName<'static>) {}
        fn insert_tls13_ticket(&self, _: ServerName<'static>, ticket: Tls13ClientSessionValue) {
            self.0.insert_tls13_ticket(one(), ticket);
        }
        fn take_tls13_ticket(&self, _: &ServerName<'static>) -> Option<Tls13ClientSessionValue> {
            self.0.take_tls13_ticket(&one())
        }
    }

    fn one() -> ServerName<'static> {
        ServerName::try_from("localhost").unwrap()
    }

    fn server_and_client() -> (Agreement, Arc<ClientConfig>) {
        let certificate = Certificate::of(&Secured::Made, None, "10.0.0.1".parse().unwrap()).unwrap();
        let (mut roots, provider) = (RootCertStore::empty(), Arc::new(ring::default_provider()));
        roots.add(certificate.key.cert[0].clone()).unwrap();
        let verifier = WebPkiServerVerifier::builder_with_provider(Arc::new(roots), Arc::clone(&provider));
        let client = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions().unwrap();
        let mut client = client.with_webpki_verifier(verifier.build().unwrap()).with_no_client_auth();
        client.resumption = Resumption::store(Arc::new(Careless(ClientSessionMemoryCache::new(8))));
        (Agreement::of(certificate, Tickets::within(None).unwrap()), Arc::new(client))
    }

    /// Agrees on TLS with a client that calls the server this.
    fn agree(agreement: &Agreement, client: &Arc<ClientConfig>, name: &str, proof: Option<Proof>) -> Arc<Agreeing> {
        let (acceptor, agreeing) = agreement.with(proof);
        let mut server = ServerConnection::new(Arc::clone(acceptor.config())).unwrap();
        let name = ServerName::try_from(name.to_owned()).unwrap();
        let mut client = ClientConnection::new(Arc::clone(client), name).unwrap();
        while client.wants_write() || server.wants_write() {
            let (mut to_server, mut to_client) = (Vec::new(), Vec::new());
            while client.wants_write() {
                client.write_tls(&mut to_server).unwrap();
            }
            server.read_tls(&mut &to_server[..]).unwrap();
            server.process_new_packets().unwrap();
            while server.wants_write() {
                server.write_tls(&mut to_client).unwrap();
            }
            client.read_tls(&mut &to_client[..]).unwrap();
            client.process_new_packets().unwrap();
        }
        assert!(!client.is_handshaking() && !server.is_handshaking());
        agreeing
    }

    /// Whose ticket the client shows next.
    fn shown(agreement: &Agreement, client: &Arc<ClientConfig>) -> TicketHolder {
        let (mut client, mut hello) = (ClientConnection::new(Arc::clone(client), one()).unwrap(), Vec::new());
        client.write_tls(&mut hello).unwrap();
        let Hello::Again(ticket) = Hello::of(&hello) else { panic!("no ticket") };
        agreement.tickets.open(&ticket).unwrap().0
    }

    #[test]
    fn who_goes_on_by_a_ticket_leaves_with_more_and_who_only_shows_it_does_not() {
        let (agreement, client) = server_and_client();
        let first = agree(&agreement, &client, "localhost", None).unproven().unwrap();
        assert_eq!(shown(&agreement, &client), TicketHolder::Connection(first));

        let pass = Digest::of("a cookie that was shown on it");
        let proof = Some(Proof { holder: TicketHolder::Connection(first), pass });
        assert_eq!(agree(&agreement, &client, "localhost", proof).unproven(), None);
        assert_eq!(shown(&agreement, &client), TicketHolder::Device(pass));

        let proof = Some(Proof { holder: TicketHolder::Device(pass), pass });
        let stolen = agree(&agreement, &client, "10.0.0.1", proof).unproven();
        assert_eq!(
            stolen.map(TicketHolder::Connection),
            Some(shown(&agreement, &client)),
            "it goes on by the certificate"
        );
    }
}
