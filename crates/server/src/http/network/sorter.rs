//! Accepts connections of others and reads the first bytes of each, on a thread that does nothing else: a ticket or a
//! cookie in them proves who comes, and where from says who may. Each goes on to the lane of its kind. While it says
//! nothing it has a place among those of its kind; who is unknown takes none from who may be known.

use super::agreement::Proof;
use super::arrivals::{Arrival, Arrivals, Newcomer};
use super::hello::Hello;
use super::tickets::{TicketHolder, Tickets};
use crate::http::accept::{REST_MS, SILENT_MS};
use crate::http::door::EntryDoor;
use crate::http::known::{KnownBy, KnownPeople};
use crate::http::line::{BegunConnection, WakingSocket};
use crate::invitations::GuessSource;
use crate::support::digest::Digest;
use crate::support::fair_places::FairPlaces;
use crate::support::tasks::boxed;
use std::io;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;
use tokio::io::AsyncReadExt;
use tokio::net::{TcpListener, TcpStream};
use tokio_util::sync::CancellationToken;

/// Connections of each kind that have not said yet what they want.
const SILENT_MAX: usize = 512;
/// What is read at once, in bytes: as much as most hellos have.
const FIRST_BYTES: usize = 2 << 10;
/// The longest head of a request that is looked at, in bytes.
const HEAD_MAX_BYTES: usize = 8 << 10;
/// Header lines in it.
const LINES_MAX: usize = 64;

/// Tells who comes, and knows the lane of each kind.
pub(super) struct Sorter {
    door: EntryDoor,
    known: Arc<KnownPeople>,
    /// None where a proxy agrees on TLS.
    tickets: Option<Arc<Tickets>>,
    may_be_known: Arc<FairPlaces<Newcomer>>,
    unknown: Arc<FairPlaces<Newcomer>>,
    lanes: Lanes,
}

/// The queues in which each kind waits for its lane.
pub(super) struct Lanes {
    pub(super) proven: Arc<Arrivals>,
    pub(super) known: Arc<Arrivals>,
    pub(super) strangers: Arc<Arrivals>,
}

impl Sorter {
    pub(super) fn new(
        door: EntryDoor,
        known: Arc<KnownPeople>,
        tickets: Option<Arc<Tickets>>,
        lanes: Lanes,
    ) -> Arc<Self> {
        let (may_be_known, unknown) = (FairPlaces::of(SILENT_MAX), FairPlaces::of(SILENT_MAX));
        Arc::new(Self { door, known, tickets, may_be_known, unknown, lanes })
    }

    /// Accepts connections until `ending`.
    pub(super) async fn accept(self: Arc<Self>, listener: std::net::TcpListener, ending: CancellationToken) {
        let listener = match TcpListener::from_std(listener) {
            Ok(listener) => listener,
            Err(error) => return tracing::error!(%error, "nobody can come in"),
        };
        while let Some(accepted) = ending.run_until_cancelled(listener.accept()).await {
            match accepted {
                Ok((stream, peer)) => drop(tokio::spawn(boxed(Arc::clone(&self).admit(stream, peer.ip())))),
                Err(error) => {
                    tracing::warn!(%error, "a connection from the network could not be accepted");
                    // Strangers have some places less, so that the next one finds room.
                    self.unknown.give_way();
                    self.lanes.strangers.give_way();
                    tokio::time::sleep(Duration::from_millis(REST_MS)).await;
                }
            }
        }
    }

    async fn admit(self: Arc<Self>, stream: TcpStream, peer: IpAddr) {
        let is_known = self.known.pass(KnownBy::Address(peer)).is_some();
        let (from, places) = if is_known {
            (Newcomer::Known(peer.to_canonical()), &self.may_be_known)
        } else {
            (Newcomer::Stranger(GuessSource::of(peer)), &self.unknown)
        };
        let place = places.take(from);
        let read = tokio::time::timeout(Duration::from_millis(SILENT_MS), self.read(WakingSocket::new(stream)));
        let (mut begun, who, proof) = match place.hold(read).await {
            Some(Ok(Ok((begun, Some(IdentityProof::Ticket(proof)))))) => {
                (begun, Newcomer::Proven(proof.pass), Some(proof))
            }
            Some(Ok(Ok((begun, Some(IdentityProof::Cookie(pass)))))) => (begun, Newcomer::Proven(pass), None),
            Some(Ok(Ok((begun, None)))) => (begun, from, None),
            Some(Ok(Err(_)) | Err(_)) | None => return,
        };
        drop(place);
        begun.leave();
        self.lanes.of(who).push(who, Arrival { begun, peer, proof });
    }

    /// Reads so much that it can be told who it is.
    async fn read(
        &self,
        mut socket: WakingSocket,
    ) -> io::Result<(BegunConnection<WakingSocket>, Option<IdentityProof>)> {
        let mut first = Vec::with_capacity(FIRST_BYTES);
        loop {
            if socket.read_buf(&mut first).await? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            let shown = match &self.tickets {
                Some(tickets) => self.ticket(tickets, &first),
                None => self.cookie(&first),
            };
            if let Some(shown) = shown {
                return Ok((BegunConnection::new(socket, first), shown));
            }
        }
    }

    /// What the ticket in a hello proves, once enough came to tell.
    fn ticket(&self, tickets: &Tickets, hello: &[u8]) -> Option<Option<IdentityProof>> {
        match Hello::of(hello) {
            Hello::Begun => None,
            Hello::Unknown => Some(None),
            Hello::Again(ticket) => Some(self.proof(tickets, &ticket).map(IdentityProof::Ticket)),
        }
    }

    fn proof(&self, tickets: &Tickets, ticket: &[u8]) -> Option<Proof> {
        let (holder, _) = tickets.open(ticket)?;
        let pass = match holder {
            TicketHolder::Device(pass) => Some(pass).filter(|pass| self.known.holds(pass)),
            TicketHolder::Connection(id) => self.known.pass(KnownBy::Tickets(id)),
        }?;
        tickets.is_fresh(ticket).then_some(Proof { holder, pass })
    }

    /// What the cookies in a head prove, once all of it came.
    fn cookie(&self, first: &[u8]) -> Option<Option<IdentityProof>> {
        let mut lines = [httparse::EMPTY_HEADER; LINES_MAX];
        let mut request = httparse::Request::new(&mut lines);
        match request.parse(first) {
            Ok(httparse::Status::Partial) if first.len() < HEAD_MAX_BYTES => None,
            Ok(httparse::Status::Partial) | Err(_) => Some(None),
            Ok(httparse::Status::Complete(_)) => {
                let cookies = request.headers.iter().filter(|line| line.name.eq_ignore_ascii_case("cookie"));
                let pass = self.door.pass(cookies.filter_map(|line| std::str::from_utf8(line.value).ok()));
                Some(pass.map(IdentityProof::Cookie))
            }
        }
    }
}

/// A proof of who somebody is.
enum IdentityProof {
    Ticket(Proof),
    /// The digest of a cookie that holds.
    Cookie(Digest),
}

impl Lanes {
    fn of(&self, who: Newcomer) -> &Arrivals {
        match who {
            Newcomer::Proven(_) => &self.proven,
            Newcomer::Known(_) => &self.known,
            Newcomer::Stranger(_) => &self.strangers,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{
        Arrivals, Digest, EntryDoor, IdentityProof, KnownBy, KnownPeople, Lanes, Proof, Sorter, TicketHolder, Tickets,
    };
    use crate::http::known::tests::invited;
    use std::sync::Arc;
    use uuid::Uuid;

    #[test]
    fn a_ticket_or_a_cookie_that_holds_proves_who_comes_and_nothing_else_does() {
        let folder = tempfile::tempdir().unwrap();
        let (invitations, invitation, cookie) = invited(folder.path());
        let (pass, door) = (Digest::of(&cookie), EntryDoor::proxied("https://rrp.example", Arc::clone(&invitations)));
        let known = KnownPeople::within(None, Arc::clone(&invitations));
        let lanes = Lanes { proven: Arrivals::new(), known: Arrivals::new(), strangers: Arrivals::new() };
        let (sorter, tickets) = (Sorter::new(door, Arc::clone(&known), None, lanes), Tickets::within(None).unwrap());
        let proof = |holder| sorter.proof(&tickets, &tickets.seal(holder, b"said").unwrap());
        let [of_device, of_connection] = [TicketHolder::Device(pass), TicketHolder::Connection(Uuid::from_u128(7))];
        assert_eq!(proof(of_device), Some(Proof { holder: of_device, pass }));
        assert_eq!(proof(of_connection), None, "nobody showed a cookie on it");
        known.note(KnownBy::Tickets(Uuid::from_u128(7)), pass);
        assert_eq!(proof(of_connection), Some(Proof { holder: of_connection, pass }));
        assert_eq!(proof(TicketHolder::Device(Digest::of("a guess"))), None);
        let copied = tickets.seal(of_device, b"said").unwrap();
        let proven = (0..50).filter(|_| sorter.proof(&tickets, &copied).is_some()).count();
        assert!((1..10).contains(&proven), "a copy that is shown again and again: {proven}");

        let head =
            |cookie: &str| format!("POST /stop HTTP/1.1\r\nCookie: a=b; __Host-rrp={cookie}\r\n\r\n").into_bytes();
        let shown = |head: &[u8]| {
            sorter.cookie(head).map(|shown| matches!(shown, Some(IdentityProof::Cookie(of)) if of == pass))
        };
        assert_eq!(shown(&head(&cookie)), Some(true));
        for cut in [0, 10, head(&cookie).len() - 1] {
            assert_eq!(shown(&head(&cookie)[..cut]), None, "more may come");
        }
        let long = [&b"POST /stop HTTP/1.1\r\na: "[..], &[b'a'; 9_000]].concat();
        for other in [head("guess"), b"\x16\x03\x01 what is this".to_vec(), long] {
            assert_eq!(shown(&other), Some(false));
        }
        invitations.revoke(&invitation).unwrap();
        assert_eq!((proof(of_device), proof(of_connection), shown(&head(&cookie))), (None, None, Some(false)));
    }
}
