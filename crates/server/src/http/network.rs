//! The way in for others: TLS, or a proxy that does it. It has threads of its own, so that nothing strangers do there slows
//! those at this computer; and those who are in have one apart from all others, so that their Stop does not wait behind
//! what strangers try.

mod certificate;
mod lane;

pub use certificate::{NoCertificate, Secured};

use super::accept::{self, HANDED_OVER_MAX, Handed, REST_MS};
use super::door::{Came, Door};
use super::known::Known;
use crate::invitations::{Invitations, Source, Way};
use crate::robots::Robots;
use crate::support::priority::{self, Priority};
use crate::support::tasks::{Work, boxed};
use certificate::Certificate;
use lane::Lane;
use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::path::Path;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

/// Connections that wait to be looked at, on each lane.
const WAITING_MAX: usize = 256;

/// How others come in.
#[derive(Clone, Debug)]
pub struct Network {
    /// Where they reach this computer; through a proxy, where that does.
    pub listen: SocketAddr,
    /// What keeps what they say from being read on the way.
    pub secured: Secured,
}

/// A network that is listened on and does not accept yet.
pub(crate) struct Opened {
    listener: std::net::TcpListener,
    /// Where it listens.
    pub(crate) address: SocketAddr,
    door: Door,
    certificate: Option<Certificate>,
    /// Where those who are in come from.
    known: Arc<Known>,
}

/// Listens, with the certificate at hand, without accepting yet.
///
/// # Errors
/// If the address cannot be used, or the certificate.
pub(crate) fn open(
    network: &Network,
    data: Option<&Path>,
    invitations: &Arc<Invitations>,
) -> Result<Opened, NotOpened> {
    let listener = accept::listen(network.listen).map_err(NotOpened::Listen)?;
    let address = listener.local_addr().map_err(NotOpened::Listen)?;
    let reached = SocketAddr::new(reached(address.ip()), address.port());
    let known = Arc::new(Known::default());
    let (door, certificate, way) = match &network.secured {
        Secured::Proxy { origin } => {
            let way = Way { origin: origin.clone(), fingerprint: None };
            (Door::proxied(origin, Arc::clone(invitations)), None, way)
        }
        secured => {
            let certificate = Certificate::of(secured, data, reached.ip()).map_err(NotOpened::Certificate)?;
            let way = Way { origin: format!("https://{reached}"), fingerprint: certificate.fingerprint.clone() };
            (Door::tls(address.port(), Arc::clone(invitations), Arc::clone(&known)), Some(certificate), way)
        }
    };
    tracing::info!(%address, origin = way.origin, "others can come in by invitation");
    invitations.open(way);
    Ok(Opened { listener, address, door, certificate, known })
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

/// The threads of a network, and where what they accept arrives: those who are in, and all others.
pub(crate) struct Started {
    /// The threads, which work until the end.
    pub(crate) threads: Vec<JoinHandle<()>>,
    /// Connections to be served.
    pub(crate) handed: [Handed; 2],
}

impl Opened {
    /// Starts accepting.
    ///
    /// # Errors
    /// If a thread cannot be made.
    pub(crate) fn start(self, robots: &Robots, ending: &CancellationToken) -> io::Result<Started> {
        let Self { listener, door, certificate, known, .. } = self;
        let acceptor = certificate.map(|certificate| certificate.acceptor);
        let mut threads = Vec::new();
        let mut lane = |name: &str, is_of_strangers: bool| {
            let (waiting, arriving) = mpsc::channel(WAITING_MAX);
            let (others, handed) = mpsc::channel(HANDED_OVER_MAX);
            let lane = Lane::new(door.clone(), robots.clone(), acceptor.clone(), others);
            let priority = is_of_strangers.then_some(Priority::Run);
            threads.push(thread(name, priority, boxed(lane.work(arriving, ending.clone())))?);
            Ok::<_, io::Error>((waiting, handed))
        };
        let (in_already, handed_known) = lane("guests", false)?;
        let (strangers, handed_others) = lane("strangers", true)?;
        let sorter = Sorter { known, in_already, strangers };
        threads.push(thread("network", None, boxed(accept_all(listener, sorter, ending.clone())))?);
        Ok(Started { threads, handed: [handed_known, handed_others] })
    }
}

/// A thread that does this.
fn thread(name: &str, priority: Option<Priority>, work: Work) -> io::Result<JoinHandle<()>> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    std::thread::Builder::new().name(name.into()).spawn(move || {
        priority.into_iter().for_each(priority::of_this_thread);
        runtime.block_on(work);
    })
}

/// Tells those who are in from strangers, by where they come from.
struct Sorter {
    known: Arc<Known>,
    in_already: mpsc::Sender<(std::net::TcpStream, IpAddr)>,
    strangers: mpsc::Sender<(std::net::TcpStream, IpAddr)>,
}

async fn accept_all(listener: std::net::TcpListener, sorter: Sorter, ending: CancellationToken) {
    let listener = match TcpListener::from_std(listener) {
        Ok(listener) => listener,
        Err(error) => return tracing::error!(%error, "nobody can come in"),
    };
    while let Some(accepted) = ending.run_until_cancelled(listener.accept()).await {
        match accepted.and_then(|(stream, peer)| Ok((stream.into_std()?, peer.ip()))) {
            Ok((stream, peer)) => {
                let is_known = sorter.known.has(Source::of(peer));
                let lane = if is_known { &sorter.in_already } else { &sorter.strangers };
                // Who finds no room is closed; whoever needs it comes again.
                drop(lane.try_send((stream, peer)));
            }
            Err(error) => {
                tracing::warn!(%error, "a connection from the network could not be accepted");
                tokio::time::sleep(Duration::from_millis(REST_MS)).await;
            }
        }
    }
}

/// What goes with a connection of this door.
fn came(door: &Door, peer: IpAddr) -> Came {
    Came { door: door.clone(), peer }
}
