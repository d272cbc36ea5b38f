//! Stop while somebody tries one link after the other: from the same other computer, by as many connections as it likes.

use crate::browser::{Browser, Socket, status};
use crate::{Network, OUT, invite, said};
use house::{Outcome, Server, Trouble};
use protocol::{Role, request};
use shell::Client;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Connections that guess at once.
const AT_ONCE: usize = 16;
/// Between two Stops.
const PAUSE: Duration = Duration::from_millis(5);

/// What became of the guesses.
#[derive(Default)]
struct Guesses {
    begun: AtomicUsize,
    /// The link was looked at, and is none.
    refused: AtomicUsize,
    /// Not looked at: too many came from there.
    slowed: AtomicUsize,
    /// Not even answered.
    cut_off: AtomicUsize,
    /// Anything else, which must not be.
    other: AtomicUsize,
    done: AtomicBool,
}

impl Guesses {
    /// One connection's guesses.
    async fn guess(&self, stranger: &Browser, all: usize) {
        loop {
            let number = self.begun.fetch_add(1, Ordering::Relaxed);
            if number >= all {
                return;
            }
            let body = format!("token=guess-{number}");
            let request = stranger.request("POST", "/come-in", &stranger.own_page(), &body);
            let answer = stranger.try_raw(&request).await;
            let count = match answer.as_deref().map(str::is_empty) {
                Ok(false) => match answer.map(|answer| status(&answer)).unwrap_or_default() {
                    403 => &self.refused,
                    429 => &self.slowed,
                    _ => &self.other,
                },
                Ok(true) | Err(_) => &self.cut_off,
            };
            count.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// Guesses so often while Stop is pressed by a guest, and fails if Stop is late or a guess is right.
pub(crate) async fn guessed(
    network: &Network,
    server: &Server,
    data: &Path,
    (all, stop_p99): (usize, Duration),
) -> Outcome<()> {
    let aiko = Client::connect(&server.url(), "Aiko").await.map_err(said)?;
    let (_, link) = invite(&aiko, Role::Viewer).await?;
    drop(aiko);
    let mut guest = Browser::new(data, &link);
    let stranger = guest.stranger();
    let socket = network.do_there(async move {
        assert_eq!(status(&guest.join(&link).await), 303);
        let socket = guest.socket("Ben").await.unwrap_or_else(|status| panic!("{status}"));
        (guest, socket)
    });
    let (guest, socket) = socket.await?;
    let guesses = Arc::new(Guesses::default());
    let theirs = Arc::clone(&guesses);
    let guessing = network.do_there(async move {
        // As those of another computer would, they leave this one's processors to everybody else.
        let _as_it_was = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 19);
        futures_util::future::join_all((0..AT_ONCE).map(|_| theirs.guess(&stranger, all))).await;
        theirs.done.store(true, Ordering::Release);
    });
    let (until, began) = (Arc::clone(&guesses), Instant::now());
    let stopping = network.do_there(async move { pressed(&guest, socket, &until).await });
    let ((), stops) = tokio::try_join!(guessing, stopping)?;
    let (mut by_socket, mut by_connection) = stops?;
    let count = |of: &AtomicUsize| of.load(Ordering::Relaxed);
    let (socket, connection) = (share(&mut by_socket, 99), share(&mut by_connection, 99));
    println!(
        "{all} guesses in {:.0} s: {} refused, {} slowed, {} cut off; Stop p99 {socket:?} by a socket, {connection:?} by a \
         connection of its own with TLS, of {} and {} Stops",
        began.elapsed().as_secs_f64(),
        count(&guesses.refused),
        count(&guesses.slowed),
        count(&guesses.cut_off),
        by_socket.len(),
        by_connection.len(),
    );
    if count(&guesses.other) > 0 {
        return Err(Trouble("A guess was answered as if it were something else.".into()));
    }
    if socket.max(connection) > stop_p99 {
        return Err(Trouble(format!("Stop was late: {socket:?} and {connection:?} of {stop_p99:?}")));
    }
    Ok(())
}

/// Presses Stop by both ways until nobody guesses any more, and tells how long each took.
async fn pressed(guest: &Browser, mut socket: Socket, until: &Guesses) -> Outcome<(Vec<Duration>, Vec<Duration>)> {
    let (mut by_socket, mut by_connection) = (Vec::new(), Vec::new());
    while !until.done.load(Ordering::Acquire) {
        tokio::time::sleep(PAUSE).await;
        let began = Instant::now();
        let answer = tokio::time::timeout(OUT, socket.ask(request::Stop { behaviour: None, robot: None })).await;
        by_socket.push(began.elapsed());
        let began = Instant::now();
        let stop = guest.request("POST", "/stop", &guest.own_page(), "");
        let done = guest.try_raw(&stop).await.map_err(said)?;
        by_connection.push(began.elapsed());
        if answer.map_err(said)?.is_err() || status(&done) != 200 {
            return Err(Trouble(format!("Stop was not done: {done}")));
        }
    }
    Ok((by_socket, by_connection))
}

/// The longest of so many of 100.
pub(crate) fn share(taken: &mut [Duration], of: usize) -> Duration {
    taken.sort_unstable();
    taken.get((taken.len() * of).div_ceil(100).saturating_sub(1)).copied().unwrap_or(Duration::MAX)
}
