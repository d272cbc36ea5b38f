//! A thread that agrees on TLS with those who come, and answers Stop before anything is handed over.

use super::came;
use crate::http::accept::{SILENT_MAX, SILENT_MS, STOPS_MAX, is_stop};
use crate::http::door::{Came, Door};
use crate::http::line::{Begun, Line, Socket};
use crate::http::stop;
use crate::invitations::Source;
use crate::robots::Robots;
use crate::support::lock;
use crate::support::places::Places;
use std::collections::BTreeMap;
use std::io;
use std::net::IpAddr;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite};
use tokio::sync::mpsc;
use tokio_rustls::TlsAcceptor;
use tokio_util::sync::CancellationToken;

/// Connections of one place that have not said yet what they want, among strangers.
const SILENT_OF_ONE_MAX: usize = 32;
/// What is read before anybody knows what somebody wants, in bytes.
const FIRST_BYTES: usize = 1_024;

/// What such a thread works with.
pub(super) struct Lane {
    door: Door,
    robots: Robots,
    /// None where a proxy does it.
    tls: Option<TlsAcceptor>,
    silent: Arc<Places>,
    stops: Arc<Places>,
    others: mpsc::Sender<(Line, Came)>,
    /// How many of one place have not said yet what they want, if that is counted.
    by_place: Option<Mutex<BTreeMap<Source, usize>>>,
}

impl Lane {
    pub(super) fn new(
        door: Door,
        robots: Robots,
        tls: Option<TlsAcceptor>,
        others: mpsc::Sender<(Line, Came)>,
        is_of_strangers: bool,
    ) -> Arc<Self> {
        // Everybody behind a proxy comes from one place.
        let by_place = (is_of_strangers && tls.is_some()).then(Mutex::default);
        let (silent, stops) = (Places::of(SILENT_MAX), Places::of(STOPS_MAX));
        Arc::new(Self { door, robots, tls, silent, stops, others, by_place })
    }

    /// Takes what arrives until `ending`.
    pub(super) async fn work(
        self: Arc<Self>,
        mut arriving: mpsc::Receiver<(std::net::TcpStream, IpAddr)>,
        ending: CancellationToken,
    ) {
        while let Some(Some((stream, peer))) = ending.run_until_cancelled(arriving.recv()).await {
            drop(tokio::spawn(Arc::clone(&self).admit(stream, peer)));
        }
    }

    async fn admit(self: Arc<Self>, stream: std::net::TcpStream, peer: IpAddr) {
        let Some(_counted) = Counted::one_more(&self, Source::of(peer)) else { return };
        let place = self.silent.take();
        let begun = tokio::time::timeout(Duration::from_millis(SILENT_MS), self.begin(stream));
        match place.hold(begun).await {
            Some(Ok(Ok(Wants::Stop(mut stream)))) => {
                drop(place);
                let place = self.stops.take();
                place.hold(stop::answer(&mut *stream, &self.door, &self.robots)).await;
            }
            // Who finds no room is closed; whoever needs it comes again.
            Some(Ok(Ok(Wants::Other(line)))) => drop(self.others.try_send((line, came(&self.door, peer)))),
            Some(Ok(Err(error))) => tracing::debug!(%error, %peer, "a connection from the network came to nothing"),
            Some(Err(_)) | None => {}
        }
    }

    /// Agrees on TLS, and reads so much that it can tell what is wanted.
    async fn begin(&self, stream: std::net::TcpStream) -> io::Result<Wants> {
        let socket = Socket::new(stream)?;
        let Some(tls) = &self.tls else {
            let (is_stop, begun) = first(socket).await?;
            return Ok(if is_stop { Wants::Stop(Box::new(begun)) } else { Wants::Other(Line::read(begun)) });
        };
        let (is_stop, begun) = first(tls.accept(socket).await?).await?;
        Ok(if is_stop { Wants::Stop(Box::new(begun)) } else { Wants::Other(Line::tls(begun)) })
    }
}

/// What somebody wants.
enum Wants {
    Stop(Box<dyn Stoppable>),
    Other(Line),
}

trait Stoppable: AsyncRead + AsyncWrite + Send + Unpin {}

impl<T: AsyncRead + AsyncWrite + Send + Unpin> Stoppable for T {}

/// Whether the first bytes are those of a Stop; they are read again by whoever goes on.
async fn first<S: AsyncRead + Unpin>(mut stream: S) -> io::Result<(bool, Begun<S>)> {
    let mut first = Vec::with_capacity(FIRST_BYTES);
    loop {
        if stream.read_buf(&mut first).await? == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        if let Some(is_stop) = is_stop(&first) {
            return Ok((is_stop, Begun::new(stream, first)));
        }
    }
}

/// One connection of a place, until it has said what it wants.
struct Counted<'a>(&'a Lane, Source);

impl<'a> Counted<'a> {
    /// None if there are too many of this place.
    fn one_more(lane: &'a Lane, from: Source) -> Option<Self> {
        if let Some(by_place) = &lane.by_place {
            let mut by_place = lock(by_place);
            let count = by_place.entry(from).or_default();
            if *count >= SILENT_OF_ONE_MAX {
                return None;
            }
            *count += 1;
        }
        Some(Self(lane, from))
    }
}

impl Drop for Counted<'_> {
    fn drop(&mut self) {
        if let Some(by_place) = &self.0.by_place {
            let mut by_place = lock(by_place);
            if let Some(count) = by_place.get_mut(&self.1) {
                *count -= 1;
                if *count == 0 {
                    by_place.remove(&self.1);
                }
            }
        }
    }
}
