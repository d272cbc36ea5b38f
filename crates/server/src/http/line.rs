//! A connection that goes from the thread that accepted it to those that carry messages, with what was read of it.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio_rustls::server::TlsStream;

/// What HTTP is spoken over.
pub(crate) trait Io: AsyncRead + AsyncWrite + Send + Unpin {}

impl<T: AsyncRead + AsyncWrite + Send + Unpin> Io for T {}

/// A connection on its way, which belongs to no thread.
pub(crate) struct ServedConnection(Transport);

enum Transport {
    Plain(std::net::TcpStream),
    Read(Box<BegunConnection<BegunConnection<WakingSocket>>>),
    Tls(Box<BegunConnection<TlsStream<BegunConnection<WakingSocket>>>>),
}

impl ServedConnection {
    /// One of which nothing was read.
    pub(super) fn plain(stream: std::net::TcpStream) -> Self {
        Self(Transport::Plain(stream))
    }

    /// One of which this was read.
    pub(super) fn read(mut begun: BegunConnection<BegunConnection<WakingSocket>>) -> Self {
        begun.stream.leave();
        Self(Transport::Read(Box::new(begun)))
    }

    /// One whose TLS was agreed on.
    pub(super) fn tls(mut begun: BegunConnection<TlsStream<BegunConnection<WakingSocket>>>) -> Self {
        begun.stream.get_mut().0.leave();
        Self(Transport::Tls(Box::new(begun)))
    }

    /// The connection, from now on carried by the thread that calls this.
    ///
    /// # Errors
    /// If it was lost on the way.
    pub(super) fn arrive(self) -> io::Result<Box<dyn Io>> {
        Ok(match self.0 {
            Transport::Plain(stream) => {
                let stream = TcpStream::from_std(stream)?;
                stream.set_nodelay(true)?;
                Box::new(stream)
            }
            Transport::Read(mut begun) => {
                begun.stream.arrive()?;
                begun
            }
            Transport::Tls(mut begun) => {
                begun.stream.get_mut().0.arrive()?;
                begun
            }
        })
    }
}

/// A connection that can change the thread that waits for it, under whatever is spoken over it.
pub(super) struct WakingSocket(LinePlace);

enum LinePlace {
    Here(TcpStream),
    Away(std::net::TcpStream),
    Lost,
}

impl WakingSocket {
    /// One that this thread waits for.
    pub(super) fn new(stream: TcpStream) -> Self {
        Self(LinePlace::Here(stream))
    }

    fn leave(&mut self) {
        self.0 = match std::mem::replace(&mut self.0, LinePlace::Lost) {
            LinePlace::Here(stream) => stream.into_std().map_or(LinePlace::Lost, LinePlace::Away),
            other => other,
        };
    }

    fn arrive(&mut self) -> io::Result<()> {
        if let LinePlace::Away(stream) = std::mem::replace(&mut self.0, LinePlace::Lost) {
            let stream = TcpStream::from_std(stream)?;
            stream.set_nodelay(true)?;
            self.0 = LinePlace::Here(stream);
        }
        Ok(())
    }

    fn here(&mut self) -> io::Result<Pin<&mut TcpStream>> {
        match &mut self.0 {
            LinePlace::Here(stream) => Ok(Pin::new(stream)),
            LinePlace::Away(_) | LinePlace::Lost => Err(io::ErrorKind::NotConnected.into()),
        }
    }
}

impl AsyncRead for WakingSocket {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context, into: &mut ReadBuf) -> Poll<io::Result<()>> {
        self.here()?.poll_read(context, into)
    }
}

impl AsyncWrite for WakingSocket {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context, bytes: &[u8]) -> Poll<io::Result<usize>> {
        self.here()?.poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        self.here()?.poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        self.here()?.poll_shutdown(context)
    }
}

/// A connection whose first bytes were read already; whoever reads it gets them first.
pub(super) struct BegunConnection<S> {
    stream: S,
    first: Vec<u8>,
}

impl<S> BegunConnection<S> {
    /// Of which this was read.
    pub(super) fn new(stream: S, first: Vec<u8>) -> Self {
        Self { stream, first }
    }
}

impl BegunConnection<WakingSocket> {
    /// Nobody waits for it from now on, until it arrives.
    pub(super) fn leave(&mut self) {
        self.stream.leave();
    }

    /// The thread that calls this waits for it.
    ///
    /// # Errors
    /// If it was lost on the way.
    pub(super) fn arrive(&mut self) -> io::Result<()> {
        self.stream.arrive()
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for BegunConnection<S> {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context, into: &mut ReadBuf) -> Poll<io::Result<()>> {
        if self.first.is_empty() {
            return Pin::new(&mut self.stream).poll_read(context, into);
        }
        let count = self.first.len().min(into.remaining());
        into.put_slice(&self.first[..count]);
        self.first.drain(..count);
        Poll::Ready(Ok(()))
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for BegunConnection<S> {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context, bytes: &[u8]) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
