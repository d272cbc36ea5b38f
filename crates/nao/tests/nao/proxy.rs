//! A way to the robot that can be cut, in one direction too, or swallow or hold back everything that comes by one connection.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;

/// A proxy; its connections are counted from 0.
pub(crate) struct Proxy {
    pub(crate) address: String,
    how: watch::Sender<How>,
    count: Arc<AtomicUsize>,
}

/// The ways in which a line is cut for good; what is connected later leads nowhere either.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    /// Nothing gets to the robot.
    To,
    /// Nothing comes from the robot.
    From,
    Both,
    /// The robot's end is closed, and nobody tells the other one.
    HalfOpen,
}

/// The treatment of what comes.
#[derive(Clone, Copy, Default, PartialEq)]
pub(crate) struct How {
    /// The connection whose bytes lead nowhere.
    pub(crate) swallows: Option<usize>,
    /// The connection whose bytes come later.
    holds: Option<usize>,
    /// Grows with every cut of all.
    cuts: usize,
    /// One byte at a time.
    pub(crate) crumbs: bool,
    /// The way in which it is cut for good, if it is.
    line: Option<Cut>,
}

impl Proxy {
    pub(crate) async fn before(peer: &str) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let (how, peer, count) = (watch::Sender::new(How::default()), peer.to_owned(), Arc::new(AtomicUsize::new(0)));
        let (told, counted) = (how.clone(), Arc::clone(&count));
        tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let number = counted.fetch_add(1, Ordering::SeqCst);
                let Ok(server) = TcpStream::connect(&peer).await else { continue };
                let (from, to) = client.into_split();
                let (back, ahead) = server.into_split();
                tokio::spawn(pass(from, ahead, (number, Cut::To), told.subscribe()));
                tokio::spawn(pass(back, to, (number, Cut::From), told.subscribe()));
            }
        });
        Self { address, how, count }
    }

    pub(crate) fn connections(&self) -> usize {
        self.count.load(Ordering::SeqCst)
    }

    pub(crate) fn swallow(&self, number: Option<usize>) {
        self.how.send_modify(|how| how.swallows = number);
    }

    /// Holds back what comes by a connection, until this is told again.
    pub(crate) fn hold(&self, number: Option<usize>) {
        self.how.send_modify(|how| how.holds = number);
    }

    pub(crate) fn crumble(&self) {
        self.how.send_modify(|how| how.crumbs = true);
    }

    pub(crate) fn cut_line(&self, cut: Cut) {
        self.how.send_modify(|how| how.line = Some(cut));
    }

    pub(crate) fn cut(&self) {
        self.how.send_modify(|how| how.cuts += 1);
    }
}

async fn pass(
    mut from: impl AsyncReadExt + Unpin,
    mut to: impl AsyncWriteExt + Unpin,
    (number, way): (usize, Cut),
    mut how: watch::Receiver<How>,
) {
    let mut bytes = vec![0; 16_384];
    let cuts = how.borrow_and_update().cuts;
    loop {
        let read = tokio::select! {
            read = from.read(&mut bytes) => read.unwrap_or(0),
            _ = how.wait_for(|how| how.cuts > cuts || how.line == Some(Cut::HalfOpen)) => 0,
        };
        if read == 0 {
            if how.borrow().line == Some(Cut::HalfOpen) {
                // What leads to the robot is closed; the other end is held, and hears nothing.
                if way == Cut::To {
                    let _ = to.shutdown().await;
                }
                std::future::pending::<()>().await;
            }
            return;
        }
        let now = match how.wait_for(|how| how.holds != Some(number)).await {
            Ok(now) => *now,
            Err(_) => return,
        };
        if now.swallows == Some(number) || now.line == Some(Cut::Both) || now.line == Some(way) {
            continue;
        }
        let piece = if now.crumbs { 1 } else { read };
        for part in bytes[..read].chunks(piece) {
            if to.write_all(part).await.is_err() {
                return;
            }
        }
    }
}
