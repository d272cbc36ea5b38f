//! The way in for others: TLS, or a proxy that does it. It has threads of its own, so that nothing strangers do there slows
//! those at this computer; and those who prove that they are in have one apart from all others, so that their Stop does not
//! wait behind what strangers try, not even behind what is tried from their own address.

mod agreement;
mod arrivals;
mod certificate;
mod hello;
mod lane;
mod sorter;
mod tickets;

pub use certificate::{NoCertificate, Secured};

use super::accept::{self, HANDED_OVER_MAX, Handed};
use super::door::EntryDoor;
use super::known::KnownPeople;
use crate::invitations::{Invitations, LinkTarget};
use crate::robots::Robots;
use crate::support::priority::{self, Priority};
use crate::support::tasks::{TaskWork, boxed};
use agreement::Agreement;
use arrivals::Arrivals;
use certificate::Certificate;
use lane::ThreadLane;
use sorter::{Lanes, Sorter};
use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::path::Path;
use std::sync::Arc;
use std::thread::JoinHandle;
use tickets::Tickets;
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

/// How others come in.
#[derive(Clone, Debug)]
pub struct GuestNetwork {
    /// Where they reach this computer; through a proxy, where that does.
    pub listen: SocketAddr,
    /// What keeps what they say from being read on the way.
    pub secured: Secured,
}

/// A network that is listened on and does not accept yet.
pub(crate) struct BoundNetwork {
    listener: std::net::TcpListener,
    /// Where it listens.
    pub(crate) address: SocketAddr,
    door: EntryDoor,
    /// None where a proxy agrees on TLS.
    agreement: Option<Agreement>,
    /// Those who are in, by what they are known before they say so.
    known: Arc<KnownPeople>,
}

/// Listens, with the certificate at hand, without accepting yet.
///
/// # Errors
/// If the address cannot be used, or the certificate.
pub(crate) fn open(
    network: &GuestNetwork,
    data: Option<&Path>,
    invitations: &Arc<Invitations>,
) -> Result<BoundNetwork, NotOpened> {
    let listener = accept::listen(network.listen).map_err(NotOpened::Listen)?;
    let address = listener.local_addr().map_err(NotOpened::Listen)?;
    let reached = SocketAddr::new(reached(address.ip()), address.port());
    let known = KnownPeople::within(data, Arc::clone(invitations));
    let (door, agreement, way) = match &network.secured {
        Secured::Proxy { origin } => {
            let way = LinkTarget { origin: origin.clone(), fingerprint: None };
            (EntryDoor::proxied(origin, Arc::clone(invitations)), None, way)
        }
        secured => {
            let certificate = Certificate::of(secured, data, reached.ip()).map_err(NotOpened::Certificate)?;
            let way = LinkTarget { origin: format!("https://{reached}"), fingerprint: certificate.fingerprint.clone() };
            let tickets = Tickets::within(data).ok_or_else(no_random)?;
            let door = EntryDoor::tls(address.port(), Arc::clone(invitations));
            (door, Some(Agreement::of(certificate, tickets)), way)
        }
    };
    tracing::info!(%address, origin = way.origin, "others can come in by invitation");
    invitations.open(way);
    Ok(BoundNetwork { listener, address, door, agreement, known })
}

fn no_random() -> NotOpened {
    NotOpened::Certificate(NoCertificate::NotMade("this computer gives no random numbers".to_owned()))
}

/// Why a network was not opened.
#[derive(Debug)]
pub(crate) enum NotOpened {
    /// Its address cannot be listened on.
    Listen(io::Error),
    /// The certificate cannot be used.
    Certificate(NoCertificate),
}

/// By which address others reach this computer. No packet is sent: the system says which of its addresses it would use.
fn reached(listen: IpAddr) -> IpAddr {
    let from = |any: IpAddr, far: IpAddr| {
        let socket = UdpSocket::bind((any, 0)).ok()?;
        socket.connect((far, 9)).ok()?;
        Some(socket.local_addr().ok()?.ip()).filter(|ip| !ip.is_unspecified())
    };
    let v4 = || from(Ipv4Addr::UNSPECIFIED.into(), Ipv4Addr::new(192, 0, 2, 1).into());
    let v6 = || from(Ipv6Addr::UNSPECIFIED.into(), Ipv6Addr::new(0x2001, 0xdb8, 0, 0, 0, 0, 0, 1).into());
    match listen {
        IpAddr::V4(ip) if ip.is_unspecified() => v4().unwrap_or(listen),
        IpAddr::V6(ip) if ip.is_unspecified() => v4().or_else(v6).unwrap_or(listen),
        one => one,
    }
}

/// The threads of a network, and where what they accept arrives: those who prove that they are in, those who may be, and
/// all others.
pub(crate) struct Started {
    /// The threads, which work until the end.
    pub(crate) threads: Vec<JoinHandle<()>>,
    /// Connections to be served.
    pub(crate) handed: [Handed; 3],
}

impl BoundNetwork {
    /// Starts accepting.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn start(self, robots: &Robots, ending: &CancellationToken) -> io::Result<Started> {
        let Self { listener, door, agreement, known, .. } = self;
        let mut threads = Vec::new();
        let mut lane = |name: &str, priority: Option<Priority>| {
            let arrivals = Arrivals::new();
            let (others, handed) = mpsc::channel(HANDED_OVER_MAX);
            let (door, known, robots, agreement) =
                (door.clone(), Arc::clone(&known), robots.clone(), agreement.clone());
            let lane = Arc::new(ThreadLane { door, known, robots, agreement, others });
            threads.push(thread(name, priority, boxed(lane.work(Arc::clone(&arrivals), ending.clone())))?);
            Ok::<_, io::Error>((arrivals, handed))
        };
        let (proven, handed_proven) = lane("guests", None)?;
        let (may_be, handed_known) = lane("known", Some(Priority::Run))?;
        let (strangers, handed_others) = lane("strangers", Some(Priority::Work))?;
        let tickets = agreement.map(|agreement| agreement.tickets);
        let lanes = Lanes { proven, known: may_be, strangers };
        let sorter = Sorter::new(door, Arc::clone(&known), tickets, lanes);
        let (accepting, keeping) = (sorter.accept(listener, ending.clone()), ending.clone());
        let both = async move {
            tokio::join!(accepting, known.keep(keeping));
        };
        threads.push(thread("network", None, boxed(both))?);
        Ok(Started { threads, handed: [handed_proven, handed_known, handed_others] })
    }
}

/// A thread that does this.
fn thread(name: &str, priority: Option<Priority>, work: TaskWork) -> io::Result<JoinHandle<()>> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    std::thread::Builder::new().name(name.into()).spawn(move || {
        priority.into_iter().for_each(priority::of_this_thread);
        runtime.block_on(work);
    })
}
