//! Strangers who take what they can get, in a process of their own: they connect as fast as they can and say nothing, half
//! a hello, a whole one and nothing more, or a Stop without a cookie. They hold on to what they got.

use crate::browser::Browser;
use house::{Outcome, Trouble};
use std::collections::VecDeque;
use std::io::Read;
use std::net::{IpAddr, SocketAddr};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpSocket, TcpStream};
use tokio_rustls::rustls::ClientConnection;
use tokio_rustls::rustls::pki_types::ServerName;

/// Says to a process what to flood; for a test that does nothing else.
pub(crate) const TOLD: &str = "RRP_FLOOD";
/// What it prints once it is under way.
pub(crate) const BEGUN: &str = "the flood has begun";
/// Strangers who connect at once.
const AT_ONCE: usize = 64;
/// One of so many says all of a Stop and waits for the answer; the others lose no time.
const ASKS: usize = 8;
/// Connections that they hold on to; the oldest are let go of.
const HELD_MAX: usize = 2_000;
/// So many connections are a flood.
const FLOOD: usize = 300;
/// How long they wait for anything.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long one rests who got nothing.
const REST: Duration = Duration::from_millis(2);

/// A flood: of this address, from these.
#[derive(Clone, Debug)]
pub(crate) struct Flood {
    pub(crate) target: SocketAddr,
    /// Plain HTTP; else the hello of this server's certificate, in this folder.
    pub(crate) tls: Option<std::path::PathBuf>,
    pub(crate) from: Vec<IpAddr>,
}

impl Flood {
    /// In words for another process.
    pub(crate) fn told(&self) -> String {
        let tls = self.tls.as_ref().map(|data| data.display().to_string()).unwrap_or_default();
        let from: Vec<String> = self.from.iter().map(IpAddr::to_string).collect();
        format!("{}|{tls}|{}", self.target, from.join(","))
    }

    fn read(told: &str) -> Outcome<Self> {
        let [target, tls, from] = told.splitn(3, '|').collect::<Vec<_>>()[..] else { return Err("no flood".into()) };
        let from = from.split(',').map(str::parse).collect::<Result<_, _>>().map_err(|_| "an address is none")?;
        Ok(Self { target: target.parse()?, tls: (!tls.is_empty()).then(|| tls.into()), from })
    }
}

/// What the strangers share.
struct Strangers {
    flood: Flood,
    /// Who agrees on TLS, if that is spoken there.
    browser: Option<Browser>,
    /// The begin of a connection.
    hello: Vec<u8>,
    held: Mutex<VecDeque<TcpStream>>,
    connected: AtomicUsize,
    refused: AtomicUsize,
}

/// Floods what is told until nobody listens any more, and says how much that was.
pub(crate) async fn flood(told: &str) -> Outcome<()> {
    let flood = Flood::read(told)?;
    let browser = flood.tls.as_ref().map(|data| Browser::new(data, &format!("https://{}/", flood.target)));
    let stop = format!(
        "POST /stop HTTP/1.1\r\nHost: {}\r\nCookie: __Host-rrp=guess\r\nContent-Length: 0\r\n\r\n",
        flood.target
    );
    let hello = match &browser {
        Some(browser) => hello(browser)?,
        None => stop.into_bytes(),
    };
    let (connected, refused, held) = (AtomicUsize::new(0), AtomicUsize::new(0), Mutex::default());
    let all = Arc::new(Strangers { flood, browser, hello, held, connected, refused });
    for number in 0..AT_ONCE {
        let all = Arc::clone(&all);
        tokio::spawn(async move { all.press(number).await });
    }
    while all.connected.load(Ordering::Relaxed) < FLOOD {
        tokio::time::sleep(REST).await;
    }
    println!("{BEGUN}");
    let ended = tokio::task::spawn_blocking(|| std::io::stdin().read_to_end(&mut Vec::new())).await;
    ended.map_err(|error| Trouble(error.to_string()))??;
    let count = |of: &AtomicUsize| of.load(Ordering::Relaxed);
    println!("{} connections, {} refused", count(&all.connected), count(&all.refused));
    Ok(())
}

/// The first thing that a browser says.
fn hello(browser: &Browser) -> Outcome<Vec<u8>> {
    let name = ServerName::from(browser.address.ip());
    let connection = ClientConnection::new(Arc::new(browser.tls.clone()), name);
    let mut hello = Vec::new();
    connection.map_err(|error| Trouble(error.to_string()))?.write_tls(&mut hello)?;
    Ok(hello)
}

impl Strangers {
    /// One connection after the other, in each of the ways.
    async fn press(&self, number: usize) {
        for turn in number.. {
            let from = self.flood.from[turn % self.flood.from.len()];
            let way = if number.is_multiple_of(ASKS) { None } else { Some(turn / self.flood.from.len()) };
            let done = tokio::time::timeout(PATIENCE, self.once(way, from)).await;
            if !matches!(done, Ok(Ok(()))) {
                self.refused.fetch_add(1, Ordering::Relaxed);
                tokio::time::sleep(REST).await;
            }
        }
    }

    async fn once(&self, way: Option<usize>, from: IpAddr) -> Outcome<()> {
        let mut stream = self.connect(from).await?;
        self.connected.fetch_add(1, Ordering::Relaxed);
        match way.map(|way| way % 4) {
            None => return self.ask(stream).await,
            Some(0) => {}
            Some(1) => stream.write_all(&self.hello[..self.hello.len() / 2]).await?,
            Some(_) => stream.write_all(&self.hello).await?,
        }
        self.hold(stream);
        Ok(())
    }

    async fn connect(&self, from: IpAddr) -> std::io::Result<TcpStream> {
        let socket = if from.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
        socket.bind((from, 0).into())?;
        // So that the computer, which the guest shares, has ports left.
        socket.set_zero_linger()?;
        socket.connect(self.flood.target).await
    }

    /// Says all of a Stop.
    async fn ask(&self, mut stream: TcpStream) -> Outcome<()> {
        let mut answer = Vec::new();
        match &self.browser {
            Some(browser) => {
                let mut stream = browser.agree(stream).await?;
                stream.write_all(browser.request("POST", "/stop", &browser.own_page(), "").as_bytes()).await?;
                stream.read_to_end(&mut answer).await?;
            }
            None => {
                stream.write_all(&self.hello).await?;
                stream.read_to_end(&mut answer).await?;
            }
        }
        if answer.starts_with(b"HTTP/1.1 403") { Ok(()) } else { Err(Trouble("not answered".into())) }
    }

    fn hold(&self, stream: TcpStream) {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        held.push_back(stream);
        if held.len() > HELD_MAX {
            held.pop_front();
        }
    }
}
