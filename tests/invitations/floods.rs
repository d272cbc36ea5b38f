//! A guest's Stop while strangers flood the way in: after a restart of the server, from the guest's own network, from the
//! guest's own address, and at the port behind a proxy.

use crate::browser::{Browser, status, token};
use crate::flood::{BEGUN, Flood, TOLD};
use crate::guesses::share;
use crate::wire::{HERE, HERE_V6, Network, THERE, THERE_V6, strangers, strangers_v6};
use crate::{invite, said};
use house::{Outcome, Server, Trouble};
use protocol::Role;
use shell::Client;
use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};
use tokio::io::{AsyncBufReadExt, AsyncReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::net::TcpSocket;
use tokio::process::{Child, ChildStdout};
use tokio_rustls::rustls::client::Resumption;

/// Where the server is reached; nobody else listens in this network.
const PORT: u16 = 7140;
/// What browsers reach the proxy by.
const ORIGIN: &str = "https://rrp.example";
/// After this a Stop counts as lost.
const PATIENCE: Duration = Duration::from_secs(10);
/// How long the server may take to keep who is known, and the flood to begin.
const SOON: Duration = Duration::from_secs(20);
/// One of so many Stops is pressed where nothing is promised.
const SOME: usize = 10;
/// Between two looks.
const LOOK: Duration = Duration::from_millis(20);

/// Where strangers come from, and what happened before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Case {
    /// From elsewhere, after the server was killed and started again.
    Restart,
    /// From other addresses of the guest's own network of IPv6.
    Network,
    /// From the guest's own address.
    Address,
    /// To the port behind the proxy, from the proxy's own address and from elsewhere.
    Proxy,
}

impl Case {
    pub(crate) const ALL: [Self; 4] = [Self::Restart, Self::Network, Self::Address, Self::Proxy];

    fn here(self) -> SocketAddr {
        let here: IpAddr = if self == Self::Network { HERE_V6.into() } else { HERE.into() };
        (here, PORT).into()
    }

    fn there(self) -> IpAddr {
        if self == Self::Network { THERE_V6.into() } else { THERE.into() }
    }

    fn strangers(self) -> Vec<IpAddr> {
        match self {
            Self::Restart => strangers().collect(),
            Self::Network => strangers_v6().collect(),
            Self::Address => vec![THERE.into()],
            Self::Proxy => strangers().chain([THERE.into()]).collect(),
        }
    }

    /// Whether somebody whose client keeps no tickets can be told from these strangers.
    fn is_told_without_tickets(self) -> bool {
        self != Self::Address
    }
}

/// A number of Stops, the longest that 99 of 100 may take, and the rest between two.
#[derive(Clone, Copy)]
pub(crate) struct Bar {
    pub(crate) stops: usize,
    pub(crate) p99: Duration,
    pub(crate) rest: Duration,
}

/// Presses Stop so often under the flood of each case, and fails if one is lost or late. All are tried before that.
pub(crate) async fn flooded(network: &Network, optimised: Option<&Path>, bar: Bar) -> Outcome<()> {
    let mut missed = Vec::new();
    for case in Case::ALL {
        missed.extend(one(network, optimised, bar, case).await?);
    }
    if missed.is_empty() { Ok(()) } else { Err(Trouble(missed.join("\n"))) }
}

async fn one(network: &Network, optimised: Option<&Path>, bar: Bar, case: Case) -> Outcome<Vec<String>> {
    let folder = house::folder()?;
    let listen = case.here().to_string();
    let mut words = vec!["--listen", &listen];
    if case == Case::Proxy {
        words.extend(["--behind-proxy", ORIGIN]);
    }
    let mut server = match optimised {
        Some(binary) => Server::start_binary(binary, folder.path(), &words).await?,
        None => Server::start_with(folder.path(), &words).await?,
    };
    let guests = guests(network, &server, folder.path(), case).await?;
    if case == Case::Restart {
        kept(folder.path(), guests.len()).await?;
        server.kill9().await?;
        server.restart().await?;
    }
    let flood = Attackers::start(network, folder.path(), case).await?;
    let mut missed = Vec::new();
    for (name, presser) in guests {
        let is_told = name == WITH || case.is_told_without_tickets();
        // Only to say what is not reached.
        let stops = if is_told { bar.stops } else { bar.stops.div_ceil(SOME) };
        let pressed = network.do_there(async move { presser.presses(Bar { stops, ..bar }).await }).await?;
        let what = format!("{case:?}, {name}: {pressed}");
        println!("{what}");
        if is_told && (pressed.lost > 0 || pressed.p99() > bar.p99) {
            missed.push(format!("{what}, of {:?}", bar.p99));
        }
    }
    println!("{case:?}, strangers: {}", flood.end().await?);
    // The next case has the same port.
    server.kill9().await?;
    Ok(missed)
}

const WITH: &str = "with tickets";
const WITHOUT: &str = "without tickets";

/// Somebody whose client keeps tickets as browsers do, and somebody whose client keeps none; behind a proxy only one.
async fn guests(network: &Network, server: &Server, data: &Path, case: Case) -> Outcome<Vec<(&'static str, Presser)>> {
    let aiko = Client::connect(&server.url(), "Aiko").await.map_err(said)?;
    let mut guests = Vec::new();
    for name in [WITH, WITHOUT] {
        let (_, link) = invite(&aiko, Role::Viewer).await?;
        let mut presser = if case == Case::Proxy {
            Presser::Proxied { to: case.here(), cookie: String::new() }
        } else {
            let mut browser = Browser::new(data, &link);
            browser.from = Some(case.there());
            if name == WITHOUT {
                browser.tls.resumption = Resumption::disabled();
            }
            Presser::Browser(Box::new(browser))
        };
        let came = network.do_there(async move {
            presser.comes_in(&link).await?;
            Ok::<_, Trouble>(presser)
        });
        guests.push((name, came.await??));
    }
    Ok(guests)
}

/// Waits until the server has kept by what so many are known; one that keeps nothing is not waited for long.
async fn kept(data: &Path, devices: usize) -> Outcome<()> {
    let began = Instant::now();
    let file = data.join("rrp.known.json");
    let is_kept = || {
        std::fs::read_to_string(&file)
            .is_ok_and(|text| text.matches("\"pass\"").count() == devices && text.contains("tickets"))
    };
    while !is_kept() && began.elapsed() < SOON {
        tokio::time::sleep(LOOK).await;
    }
    Ok(())
}

/// Somebody who presses Stop.
enum Presser {
    /// In a browser.
    Browser(Box<Browser>),
    /// Through a proxy, which speaks plain HTTP.
    Proxied { to: SocketAddr, cookie: String },
}

impl Presser {
    /// Comes in and looks around.
    async fn comes_in(&mut self, link: &str) -> Outcome<()> {
        let came = match self {
            Self::Browser(browser) => browser.join(link).await,
            Self::Proxied { to, .. } => {
                let body = format!("token={}", token(link));
                let form = "Content-Type: application/x-www-form-urlencoded\r\n";
                handed_on(*to, &head("/come-in", form, body.len()), &body).await.map_err(said)?
            }
        };
        if status(&came) != 303 {
            return Err(Trouble(came));
        }
        match self {
            Self::Browser(browser) => assert_eq!(status(&browser.get("/api/behaviours").await), 200),
            Self::Proxied { cookie, .. } => {
                let given = came.lines().find_map(|line| line.strip_prefix("set-cookie: ")).ok_or("no cookie")?;
                *cookie = format!("Cookie: {}\r\n", given.split(';').next().unwrap_or_default());
                assert_eq!(status(&self.press().await.map_err(said)?), 200);
            }
        }
        Ok(())
    }

    async fn press(&self) -> std::io::Result<String> {
        match self {
            Self::Browser(browser) => browser.try_raw(&browser.request("POST", "/stop", &browser.own_page(), "")).await,
            Self::Proxied { to, cookie } => handed_on(*to, &head("/stop", cookie, 0), "").await,
        }
    }

    async fn presses(self, bar: Bar) -> Pressed {
        let mut pressed = Pressed { taken: Vec::new(), lost: 0 };
        for _ in 0..bar.stops {
            tokio::time::sleep(bar.rest).await;
            let began = Instant::now();
            let answer = tokio::time::timeout(PATIENCE, self.press()).await;
            pressed.taken.push(began.elapsed());
            let is_done = matches!(&answer, Ok(Ok(answer)) if answer.starts_with("HTTP/1.1 200"));
            pressed.lost += usize::from(!is_done);
        }
        pressed
    }
}

fn head(path: &str, more: &str, length: usize) -> String {
    format!(
        "POST {path} HTTP/1.1\r\nHost: rrp.example\r\nOrigin: {ORIGIN}\r\nX-Forwarded-For: 198.51.100.7\r\n{more}\
         Content-Length: {length}\r\n\r\n"
    )
}

/// The answer that the proxy hears for what it hands on.
async fn handed_on(to: SocketAddr, head: &str, body: &str) -> std::io::Result<String> {
    let socket = TcpSocket::new_v4()?;
    socket.bind((THERE, 0).into())?;
    let mut stream = socket.connect(to).await?;
    stream.write_all(format!("{head}{body}").as_bytes()).await?;
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).await?;
    Ok(String::from_utf8_lossy(&answer).into_owned())
}

/// Times of Stops, and how many were lost.
struct Pressed {
    taken: Vec<Duration>,
    lost: usize,
}

impl Pressed {
    fn p99(&self) -> Duration {
        share(&mut self.taken.clone(), 99)
    }
}

impl std::fmt::Display for Pressed {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        let [p50, p99, worst] = [50, 99, 100].map(|of| share(&mut self.taken.clone(), of));
        write!(to, "{} Stops, p50 {p50:?}, p99 {p99:?}, worst {worst:?}, {} lost", self.taken.len(), self.lost)
    }
}

/// Strangers in a process of their own, at the other computer.
struct Attackers {
    process: Child,
    said: Lines<BufReader<ChildStdout>>,
}

impl Attackers {
    async fn start(network: &Network, data: &Path, case: Case) -> Outcome<Self> {
        let tls = (case != Case::Proxy).then(|| PathBuf::from(data));
        let flood = Flood { target: case.here(), tls, from: case.strangers() };
        let mut strangers = network.there(&std::env::current_exe()?);
        strangers.args(["strangers_flood", "--exact", "--include-ignored", "--nocapture"]).env(TOLD, flood.told());
        let mut process = strangers.stdin(Stdio::piped()).stdout(Stdio::piped()).kill_on_drop(true).spawn()?;
        let out = process.stdout.take().ok_or("The strangers say nothing.")?;
        let mut this = Self { process, said: BufReader::new(out).lines() };
        tokio::time::timeout(SOON, this.until(BEGUN))
            .await
            .map_err(|_| Trouble("The flood did not begin.".into()))??;
        Ok(this)
    }

    async fn until(&mut self, word: &str) -> Outcome<String> {
        while let Some(line) = self.said.next_line().await? {
            if line.contains(word) {
                return Ok(line);
            }
        }
        Err(Trouble("The strangers ended early.".into()))
    }

    /// Ends them, and says how many they were.
    async fn end(mut self) -> Outcome<String> {
        drop(self.process.stdin.take());
        self.until("connections").await
    }
}
