//! A proxy that does to links what networks do, by a seed: it delays, cuts, cuts in the middle of a message, and falls
//! silent while both sides believe that the other is there.

use crate::dice::Dice;
use host_key::{HostKey, Published};
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio_util::sync::{CancellationToken, DropGuard};

/// The most bytes that are carried at once.
const PIECE_BYTES: usize = 16 << 10;
/// Of so many pieces some are treated badly.
const OF: u64 = 10_000;

/// The faults of a link, each as a count of ten thousand pieces that it carries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// Pieces that come late.
    pub delays: u64,
    /// By how much at most, in milliseconds.
    pub delay_max_ms: u64,
    /// Links that end.
    pub cuts: u64,
    /// Links that end in the middle of a piece.
    pub truncations: u64,
    /// Links that fall silent both ways and stay open.
    pub silences: u64,
}

/// The number of times that each fault happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Happened {
    /// Links that were made.
    pub links: u64,
    /// Pieces that came late.
    pub delays: u64,
    /// Links that ended.
    pub cuts: u64,
    /// Links that ended in the middle of a piece.
    pub truncations: u64,
    /// Links that fell silent.
    pub silences: u64,
}

#[derive(Debug, Default)]
struct ChaosCounts {
    links: AtomicU64,
    delays: AtomicU64,
    cuts: AtomicU64,
    /// Pieces that might have been hit.
    pieces: AtomicU64,
    truncations: AtomicU64,
    silences: AtomicU64,
}

/// The proxy; it ends with all of its links when it is dropped.
#[derive(Debug)]
pub struct Proxy {
    address: SocketAddr,
    counts: Arc<ChaosCounts>,
    calm: CancellationToken,
    _until: DropGuard,
}

/// The key of the server behind a proxy, under the proxy's address: who comes through it shows what the server wants.
struct KeyOfServer {
    here: SocketAddr,
    target: SocketAddr,
    published: Option<(String, Published)>,
}

impl KeyOfServer {
    fn of(target: SocketAddr, here: SocketAddr) -> Self {
        let mut this = Self { here, target, published: None };
        this.renew();
        this
    }

    /// A server that was started again has another key.
    fn renew(&mut self) {
        let Some(key) = host_key::of_server(self.target) else { return };
        if self.published.as_ref().is_none_or(|(before, _)| *before != key) {
            let told = host_key::publish(&HostKey { address: self.here, key: key.clone() }, None);
            self.published = Some((key, told));
        }
    }
}

/// The fate of a piece.
enum Fate {
    Pass,
    Late(Duration),
    Cut,
    Truncate,
    Silence,
}

/// One direction of a link.
struct LinkDirection {
    from: OwnedReadHalf,
    to: OwnedWriteHalf,
    dice: Dice,
    seed: u64,
    faults: Faults,
    counts: Arc<ChaosCounts>,
    calm: CancellationToken,
    /// Both directions of the link fall silent together.
    silent: CancellationToken,
    /// The address of the proxy and that of the server, which takes only what is meant for it.
    instead: Option<(String, String)>,
}

impl Proxy {
    /// Stands before a server, on a free port of this computer.
    ///
    /// # Errors
    /// If there is no port.
    pub async fn before(target: SocketAddr, faults: Faults, seed: u64) -> std::io::Result<Self> {
        let listener = TcpListener::bind("127.0.0.1:0").await?;
        let (address, counts) = (listener.local_addr()?, Arc::new(ChaosCounts::default()));
        let (until, calm) = (CancellationToken::new(), CancellationToken::new());
        let key = KeyOfServer::of(target, address);
        let accepting = accept(listener, key, faults, seed, Arc::clone(&counts), calm.clone());
        let ending = until.clone();
        tokio::spawn(async move {
            tokio::select! {
                () = accepting => {}
                () = ending.cancelled() => {}
            }
        });
        Ok(Self { address, counts, calm, _until: until.drop_guard() })
    }

    /// Returns the address, as that of a server.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// From now on nothing bad happens any more; what fell silent stays so.
    pub fn calm(&self) {
        self.calm.cancel();
    }

    /// Returns the faults that happened until now.
    #[must_use]
    pub fn happened(&self) -> Happened {
        let of = |count: &AtomicU64| count.load(Ordering::Relaxed);
        let ChaosCounts { links, delays, cuts, pieces: _, truncations, silences } = &*self.counts;
        Happened {
            links: of(links),
            delays: of(delays),
            cuts: of(cuts),
            truncations: of(truncations),
            silences: of(silences),
        }
    }
}

async fn accept(
    listener: TcpListener,
    mut key: KeyOfServer,
    faults: Faults,
    seed: u64,
    counts: Arc<ChaosCounts>,
    calm: CancellationToken,
) {
    let mut links = JoinSet::new();
    let (here, target) = (key.here, key.target);
    while let Ok((client, _)) = listener.accept().await {
        key.renew();
        while links.try_join_next().is_some() {}
        // A server that is not there is noticed by a link that ends at once.
        let Ok(server) = TcpStream::connect(target).await else { continue };
        let number = counts.links.fetch_add(1, Ordering::Relaxed);
        let _slower = (client.set_nodelay(true), server.set_nodelay(true));
        let ((from_client, to_client), (from_server, to_server)) = (client.into_split(), server.into_split());
        let silent = CancellationToken::new();
        let way = |from, to, direction, instead| LinkDirection {
            from,
            to,
            dice: Dice::of(seed, 2 * number + direction),
            seed,
            faults,
            counts: Arc::clone(&counts),
            calm: calm.clone(),
            silent: silent.clone(),
            instead,
        };
        let instead = Some((here.to_string(), target.to_string()));
        let (up, down) = (way(from_client, to_server, 0, instead), way(from_server, to_client, 1, None));
        links.spawn(async move {
            // Whichever way ends first, the link ends; a silent one does when a side gives it up.
            tokio::select! {
                () = up.carry() => {}
                () = down.carry() => {}
            }
        });
    }
}

impl LinkDirection {
    async fn carry(mut self) {
        let mut piece = vec![0; PIECE_BYTES];
        loop {
            let Ok(length @ 1..) = self.from.read(&mut piece).await else { return };
            let length = self.address(&mut piece, length);
            let carried = match self.fate() {
                Fate::Pass => length,
                Fate::Late(by) => {
                    tokio::time::sleep(by).await;
                    length
                }
                Fate::Cut => return,
                Fate::Truncate => {
                    let _ends = self.to.write_all(&piece[..length / 2]).await;
                    return;
                }
                Fate::Silence => {
                    self.silent.cancel();
                    0
                }
            };
            // What a side says into the silence is taken, and lost.
            let carried = if self.silent.is_cancelled() { 0 } else { carried };
            if self.to.write_all(&piece[..carried]).await.is_err() {
                return;
            }
        }
    }

    /// Names the server in the head of the first request, where the client named the proxy. The length after that.
    fn address(&mut self, piece: &mut Vec<u8>, length: usize) -> usize {
        let Some((here, target)) = self.instead.take() else { return length };
        let Some(at) = piece[..length].windows(here.len()).position(|text| text == here.as_bytes()) else {
            return length;
        };
        piece.splice(at..at + here.len(), target.bytes());
        length + target.len() - here.len()
    }

    fn fate(&mut self) -> Fate {
        if self.calm.is_cancelled() || self.silent.is_cancelled() {
            return Fate::Pass;
        }
        let piece = self.counts.pieces.fetch_add(1, Ordering::Relaxed);
        let is = |fault: u64, share: u64, count: &AtomicU64| {
            let is = is_hit(self.seed.wrapping_add(fault), share, piece);
            count.fetch_add(u64::from(is), Ordering::Relaxed);
            is
        };
        let (faults, counts) = (self.faults, &self.counts);
        if is(CUT, faults.cuts, &counts.cuts) {
            Fate::Cut
        } else if is(TRUNCATION, faults.truncations, &counts.truncations) {
            Fate::Truncate
        } else if is(SILENCE, faults.silences, &counts.silences) {
            Fate::Silence
        } else if is(DELAY, faults.delays, &counts.delays) {
            Fate::Late(Duration::from_millis(self.dice.below(faults.delay_max_ms + 1)))
        } else {
            Fate::Pass
        }
    }
}

/// The number of each kind of fault, so that two with one share do not hit the same pieces: only the first of them would come about.
const CUT: u64 = 1;
const TRUNCATION: u64 = 2;
const SILENCE: u64 = 3;
const DELAY: u64 = 4;

/// True if this piece of all that pass is hit by a fault with such a share: one, by chance, of every `OF / share` pieces. Chance for
/// each piece alone would now and then hit none in a whole run.
fn is_hit(seed: u64, share: u64, piece: u64) -> bool {
    let Some(each) = OF.checked_div(share) else { return false };
    let each = each.max(1);
    piece % each == Dice::of(seed ^ share.rotate_left(32), piece / each).below(each)
}

#[cfg(test)]
mod tests {
    use super::{CUT, Faults, OF, Proxy, TRUNCATION, is_hit};
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::net::{TcpListener, TcpStream};

    /// Returns the number of bytes that come back of a thousand through a proxy before somebody who says them again,
    /// and the proxy.
    async fn echo(faults: Faults) -> (usize, Proxy) {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let target = listener.local_addr().unwrap();
        tokio::spawn(async move {
            while let Ok((mut socket, _)) = listener.accept().await {
                let (mut from, mut to) = socket.split();
                let _ended = tokio::io::copy(&mut from, &mut to).await;
            }
        });
        let proxy = Proxy::before(target, faults, 7).await.unwrap();
        let mut link = TcpStream::connect(proxy.address).await.unwrap();
        link.write_all(&[7; 1_000]).await.unwrap();
        let (mut back, mut piece) = (0, [0; 1_000]);
        while back < 1_000 {
            match link.read(&mut piece).await {
                Ok(length @ 1..) => back += length,
                _ => break,
            }
        }
        (back, proxy)
    }

    #[test]
    fn every_fault_comes_about_in_every_run_of_enough_pieces() {
        for seed in 0..200 {
            for share in [2, 10, 20, 500] {
                let each = OF / share;
                for stretch in 0..3 {
                    let hit = (0..each).filter(|piece| is_hit(seed, share, stretch * each + piece)).count();
                    assert_eq!(hit, 1, "seed {seed}, {share} of {OF}, stretch {stretch}");
                }
            }
        }
        assert!((0..OF).all(|piece| is_hit(1, OF, piece) && !is_hit(1, 0, piece)));
    }

    #[test]
    fn faults_of_one_share_hit_other_pieces() {
        for seed in 0..20 {
            let both =
                (0..20 * OF).filter(|piece| is_hit(seed + CUT, 20, *piece) && is_hit(seed + TRUNCATION, 20, *piece));
            assert!(both.count() < 10, "of 400 each");
        }
    }

    #[tokio::test]
    async fn links_pass_come_late_and_end() {
        let late = Faults { delays: OF, delay_max_ms: 3, ..Faults::default() };
        for (faults, expected) in [(Faults::default(), 1_000), (late, 1_000)] {
            assert_eq!(echo(faults).await.0, expected, "{faults:?}");
        }
        let (back, proxy) = echo(Faults { cuts: OF, ..Faults::default() }).await;
        assert_eq!((back, proxy.happened().cuts), (0, 1));
        let (back, proxy) = echo(Faults { truncations: OF, ..Faults::default() }).await;
        let truncations = proxy.happened().truncations;
        assert!(back < 1_000 && truncations > 0, "{back}");
    }

    #[tokio::test]
    async fn the_server_hears_its_own_address() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let target = listener.local_addr().unwrap();
        let proxy = Proxy::before(target, Faults::default(), 7).await.unwrap();
        let mut client = TcpStream::connect(proxy.address).await.unwrap();
        let (mut server, _) = listener.accept().await.unwrap();
        let head = |address| format!("GET / HTTP/1.1\r\nHost: {address}\r\n\r\n");
        client.write_all(head(proxy.address).as_bytes()).await.unwrap();
        let mut heard = vec![0; head(target).len()];
        server.read_exact(&mut heard).await.unwrap();
        assert_eq!(String::from_utf8(heard).unwrap(), head(target));
    }

    #[tokio::test]
    async fn a_silent_link_stays_open_and_says_nothing_until_a_side_gives_up() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let faults = Faults { silences: OF, ..Faults::default() };
        let proxy = Proxy::before(listener.local_addr().unwrap(), faults, 7).await.unwrap();
        let mut client = TcpStream::connect(proxy.address).await.unwrap();
        let (mut server, _) = listener.accept().await.unwrap();
        client.write_all(b"lost").await.unwrap();
        while proxy.happened().silences == 0 {
            tokio::task::yield_now().await;
        }
        server.write_all(b"lost too").await.unwrap();
        drop(server);
        let mut nothing = [0; 10];
        assert_eq!(client.read(&mut nothing).await.unwrap(), 0, "not a byte before the end");
    }

    #[tokio::test]
    async fn after_the_calm_nothing_happens() {
        let (_, proxy) = echo(Faults::default()).await;
        assert_eq!(proxy.happened().links, 1);
        proxy.calm();
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let all = Faults { cuts: OF, ..Faults::default() };
        let bad = Proxy::before(listener.local_addr().unwrap(), all, 7).await.unwrap();
        bad.calm();
        let mut client = TcpStream::connect(bad.address).await.unwrap();
        let (mut server, _) = listener.accept().await.unwrap();
        client.write_all(b"here").await.unwrap();
        let mut heard = [0; 4];
        server.read_exact(&mut heard).await.unwrap();
        assert_eq!((&heard, bad.happened().cuts), (b"here", 0));
    }
}
