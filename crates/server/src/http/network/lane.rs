//! A thread that agrees on TLS with one kind of those who come, and answers Stop before anything is handed over. Each of
//! them has a share of it: they are served in turn, and where there is no place the oldest of who has most gives way.

use super::agreement::{Agreeing, Agreement};
use super::arrivals::{Arrival, Arrivals};
use crate::http::accept::{SILENT_MS, is_stop};
use crate::http::door::{EntryDoor, RequestArrival};
use crate::http::known::{KnownBy, KnownPeople};
use crate::http::line::{BegunConnection, ServedConnection};
use crate::http::stop;
use crate::robots::Robots;
use crate::support::tasks::boxed;
use std::io;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite};
use tokio::sync::mpsc;
use tokio_util::sync::CancellationToken;

/// What is read before anybody knows what somebody wants, in bytes.
const FIRST_BYTES: usize = 1_024;

/// What such a thread works with.
pub(super) struct ThreadLane {
    pub(super) door: EntryDoor,
    pub(super) known: Arc<KnownPeople>,
    pub(super) robots: Robots,
    /// None where a proxy agrees on TLS.
    pub(super) agreement: Option<Agreement>,
    pub(super) others: mpsc::Sender<(ServedConnection, RequestArrival)>,
}

impl ThreadLane {
    /// Takes what arrives until `ending`.
    pub(super) async fn work(self: Arc<Self>, arrivals: Arc<Arrivals>, ending: CancellationToken) {
        while let Some((who, arrival)) = ending.run_until_cancelled(arrivals.waiting.next()).await {
            let place = arrivals.busy.take(who);
            let lane = Arc::clone(&self);
            drop(tokio::spawn(boxed(async move {
                place.hold(lane.admit(arrival)).await;
            })));
            // Before the next one, so that turns are kept.
            tokio::task::yield_now().await;
        }
    }

    async fn admit(&self, arrival: Arrival) {
        let peer = arrival.peer;
        let begun = tokio::time::timeout(Duration::from_millis(SILENT_MS), self.begin(arrival));
        match begun.await {
            Ok(Ok((Wants::Stop(mut stream), came))) => stop::answer(&mut *stream, &came.door, &self.robots).await,
            // Who finds no room is closed; whoever needs it comes again.
            Ok(Ok((Wants::Other(line), came))) => drop(self.others.try_send((line, came))),
            Ok(Err(error)) => tracing::debug!(%error, %peer, "a connection from the network came to nothing"),
            Err(_) => {}
        }
    }

    /// Agrees on TLS, and reads so much that it can tell what is wanted.
    async fn begin(&self, Arrival { mut begun, peer, proof }: Arrival) -> io::Result<(Wants, RequestArrival)> {
        begun.arrive()?;
        let Some(agreement) = &self.agreement else {
            let (is_stop, begun) = first(begun).await?;
            let wants =
                if is_stop { Wants::Stop(Box::new(begun)) } else { Wants::Other(ServedConnection::read(begun)) };
            return Ok((wants, RequestArrival { door: self.noting(peer, None), peer }));
        };
        let (acceptor, agreeing) = agreement.with(proof);
        let (is_stop, begun) = first(acceptor.accept(begun).await?).await?;
        let wants = if is_stop { Wants::Stop(Box::new(begun)) } else { Wants::Other(ServedConnection::tls(begun)) };
        Ok((wants, RequestArrival { door: self.noting(peer, Some(agreeing)), peer }))
    }

    /// The way in for one connection: by what it is known again who shows a cookie on it.
    fn noting(&self, peer: IpAddr, agreeing: Option<Arc<Agreeing>>) -> EntryDoor {
        let known = Arc::clone(&self.known);
        self.door.noting(Arc::new(move |pass| {
            known.note(KnownBy::Address(peer), pass);
            let tickets = agreeing.as_ref().and_then(|agreeing| agreeing.unproven());
            tickets.into_iter().for_each(|id| known.note(KnownBy::Tickets(id), pass));
        }))
    }
}

/// What somebody wants.
enum Wants {
    Stop(Box<dyn Stoppable>),
    Other(ServedConnection),
}

trait Stoppable: AsyncRead + AsyncWrite + Send + Unpin {}

impl<T: AsyncRead + AsyncWrite + Send + Unpin> Stoppable for T {}

/// Whether the first bytes are those of a Stop; they are read again by whoever goes on.
async fn first<S: AsyncRead + Unpin>(mut stream: S) -> io::Result<(bool, BegunConnection<S>)> {
    let mut first = Vec::with_capacity(FIRST_BYTES);
    loop {
        if stream.read_buf(&mut first).await? == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        if let Some(is_stop) = is_stop(&first) {
            return Ok((is_stop, BegunConnection::new(stream, first)));
        }
    }
}
