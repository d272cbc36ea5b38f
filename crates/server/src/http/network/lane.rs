//! A thread that agrees on TLS with those who come, and answers Stop before anything is handed over.

use super::came;
use crate::http::accept::{SILENT_MAX, SILENT_MS, STOPS_MAX, is_stop};
use crate::http::door::{Came, Door};
use crate::http::line::{Begun, Line, Socket};
use crate::http::stop;
use crate::invitations::Source;
use crate::robots::Robots;
use crate::support::lock;
use crate::support::places::{Place, Places};
use crate::support::tasks::boxed;
use std::collections::HashMap;
use std::io;
use std::net::IpAddr;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite};
use tokio::sync::mpsc;
use tokio_rustls::TlsAcceptor;
use tokio_util::sync::CancellationToken;

/// Connections from one place that have not said yet what they want: so many may agree on TLS before a Stop from there.
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
    /// None where everybody comes from one place, a proxy.
    by_place: Option<Arc<ByPlace>>,
}

impl Lane {
    pub(super) fn new(
        door: Door,
        robots: Robots,
        tls: Option<TlsAcceptor>,
        others: mpsc::Sender<(Line, Came)>,
    ) -> Arc<Self> {
        let by_place = tls.is_some().then(Arc::default);
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
            drop(tokio::spawn(boxed(Arc::clone(&self).admit(stream, peer))));
        }
    }

    async fn admit(self: Arc<Self>, stream: std::net::TcpStream, peer: IpAddr) {
        let (place, own) = (self.silent.take(), self.by_place.as_ref().map(|places| places.take(Source::of(peer))));
        let begun = tokio::time::timeout(Duration::from_millis(SILENT_MS), self.begin(stream));
        let begun = place.hold(async {
            match &own {
                Some(own) => own.place.hold(begun).await,
                None => Some(begun.await),
            }
        });
        let begun = begun.await.flatten();
        drop((place, own));
        match begun {
            Some(Ok(Ok(Wants::Stop(mut stream)))) => {
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

/// Connections that have not said yet what they want, of each place where there are any.
#[derive(Default)]
struct ByPlace(Mutex<HashMap<Source, (Arc<Places>, usize)>>);

impl ByPlace {
    /// A place among those of where somebody comes from; the oldest of these gives way.
    fn take(self: &Arc<Self>, from: Source) -> Silent {
        let mut all = lock(&self.0);
        let (places, count) = all.entry(from).or_insert_with(|| (Places::of(SILENT_OF_ONE_MAX), 0));
        *count += 1;
        Silent { place: places.take(), from, all: Arc::clone(self) }
    }
}

/// A connection that has not said yet what it wants.
struct Silent {
    place: Place,
    from: Source,
    all: Arc<ByPlace>,
}

impl Drop for Silent {
    fn drop(&mut self) {
        let mut all = lock(&self.all.0);
        if let Some((_, count)) = all.get_mut(&self.from) {
            *count -= 1;
            if *count == 0 {
                all.remove(&self.from);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ByPlace, SILENT_OF_ONE_MAX, lock};
    use crate::invitations::Source;
    use std::future::{pending, ready};
    use std::sync::Arc;

    #[tokio::test]
    async fn who_holds_many_connections_takes_them_from_nobody_else() {
        let all = Arc::new(ByPlace::default());
        let of = |text: &str| Source::of(text.parse().unwrap());
        let other = all.take(of("10.0.0.2"));
        let many: Vec<_> = (0..=SILENT_OF_ONE_MAX).map(|_| all.take(of("10.0.0.1"))).collect();
        assert_eq!(many[0].place.hold(pending::<()>()).await, None, "their own oldest gives way");
        for silent in [&other, &many[1], &many[SILENT_OF_ONE_MAX]] {
            assert_eq!(silent.place.hold(ready(1)).await, Some(1));
        }
        drop((other, many));
        assert!(lock(&all.0).is_empty(), "and is forgotten");
    }
}
