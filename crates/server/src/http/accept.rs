//! Accepts connections on a thread of its own. It looks at the first bytes of each: Stop is answered right here, by this
//! thread and in places that nothing else takes; everything else goes on to the threads that carry messages. So nothing
//! that those threads, the robots' or the store's do can keep Stop from being heard.

use super::line::ServedConnection;
use super::stop;
use crate::http::door::{EntryDoor, RequestArrival};
use crate::robots::Robots;
use crate::support::places::Places;
use crate::support::tasks::boxed;
use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::net::{TcpListener, TcpSocket, TcpStream};
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

/// Connections that the system may keep waiting for us.
const BACKLOG: u32 = 4_096;
/// Connections that have not said yet what they want.
pub(super) const SILENT_MAX: usize = 256;
/// Stops that are answered at once.
pub(super) const STOPS_MAX: usize = 256;
/// Connections that wait to be taken over by the threads that carry messages.
pub(super) const HANDED_OVER_MAX: usize = 256;
/// How long a connection may be silent at first.
pub(super) const SILENT_MS: u64 = 5_000;
/// Between two looks at a first line of which too little has come to tell.
const LOOK_MS: u64 = 5;
/// How long to rest after accepting failed.
pub(super) const REST_MS: u64 = 10;
/// How a Stop begins.
pub(super) const STOP: &[u8] = b"POST /stop";

/// Listens, without accepting yet.
pub(crate) fn listen(address: SocketAddr) -> io::Result<std::net::TcpListener> {
    let socket = if address.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
    socket.set_reuseaddr(true)?;
    socket.bind(address)?;
    socket.listen(BACKLOG)?.into_std()
}

/// Where connections that want something else than Stop arrive.
pub(crate) type Handed = mpsc::Receiver<(ServedConnection, RequestArrival)>;

/// What the accepting thread needs.
struct Acceptor {
    door: EntryDoor,
    robots: Robots,
    silent: Arc<Places>,
    stops: Arc<Places>,
    others: mpsc::Sender<(ServedConnection, RequestArrival)>,
}

/// Starts the thread, which works until `ending`.
///
/// # Errors
/// If the thread cannot be made.
pub(crate) fn start(
    listener: std::net::TcpListener,
    door: EntryDoor,
    robots: Robots,
    ending: CancellationToken,
) -> io::Result<(JoinHandle<()>, Handed)> {
    let (others, handed) = mpsc::channel(HANDED_OVER_MAX);
    let (silent, stops) = (Places::of(SILENT_MAX), Places::of(STOPS_MAX));
    let acceptor = Arc::new(Acceptor { door, robots, silent, stops, others });
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    let thread = std::thread::Builder::new().name("accept".into());
    let thread = thread.spawn(move || runtime.block_on(boxed(accept(listener, acceptor, ending))))?;
    Ok((thread, handed))
}

async fn accept(listener: std::net::TcpListener, acceptor: Arc<Acceptor>, ending: CancellationToken) {
    let listener = match TcpListener::from_std(listener) {
        Ok(listener) => listener,
        Err(error) => return tracing::error!(%error, "no connection can be accepted"),
    };
    while let Some(accepted) = ending.run_until_cancelled(listener.accept()).await {
        match accepted {
            Ok((stream, peer)) => drop(tokio::spawn(boxed(Arc::clone(&acceptor).admit(stream, peer.ip())))),
            Err(error) => {
                tracing::warn!(%error, "a connection could not be accepted");
                // One place less, so that the next one finds room.
                drop(acceptor.silent.take());
                tokio::time::sleep(Duration::from_millis(REST_MS)).await;
            }
        }
    }
}

impl Acceptor {
    async fn admit(self: Arc<Self>, stream: TcpStream, peer: IpAddr) {
        let place = self.silent.take();
        let wants = tokio::time::timeout(Duration::from_millis(SILENT_MS), wants_stop(&stream));
        let Some(Ok(Ok(wants_stop))) = place.hold(wants).await else { return };
        drop(place);
        if wants_stop {
            let place = self.stops.take();
            drop(stream.set_nodelay(true));
            place.hold(stop::answer(stream, &self.door, &self.robots)).await;
        } else if let Ok(stream) = stream.into_std() {
            // Who finds no room is closed; whoever needs it comes again.
            drop(
                self.others
                    .try_send((ServedConnection::plain(stream), RequestArrival { door: self.door.clone(), peer })),
            );
        }
    }
}

/// Whether the first bytes are those of a Stop. They stay to be read.
async fn wants_stop(stream: &TcpStream) -> io::Result<bool> {
    let mut begun = [0; STOP.len() + 1];
    loop {
        let count = stream.peek(&mut begun).await?;
        if count == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        if let Some(is_stop) = is_stop(&begun[..count]) {
            return Ok(is_stop);
        }
        // Peeking again would see the same at once.
        tokio::time::sleep(Duration::from_millis(LOOK_MS)).await;
    }
}

/// Whether what begins like this is a Stop, once there is enough of it to tell.
pub(super) fn is_stop(begun: &[u8]) -> Option<bool> {
    let (line, after) = begun.split_at(begun.len().min(STOP.len()));
    if !STOP.starts_with(line) {
        return Some(false);
    }
    after.first().map(|after| matches!(after, b' ' | b'?'))
}
