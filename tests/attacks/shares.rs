//! One person against all others: a hundred links of one viewer, in a process of its own, ask one thing after the other as
//! fast as they can, while a colleague edits and the host lists, looks at the past and revokes. What these wait is bounded.

use crate::stops::said;
use crate::target::{Target, fresh, made, note, note_id, nothing};
use behaviour::{Change, Id, Kind, Record, RecordId, Stream, StreamKind};
use futures_util::{SinkExt, StreamExt};
use house::{Outcome, Server, skip};
use protocol::{AnyAnswer, AnyRequest, Lasts, ListQuery, Message as Told, Role, VERSION, request};
use serde_json::{Value, json};
use shell::Client;
use std::net::SocketAddr;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;

/// Links that one person tries to have.
const LINKS: usize = 100;
/// Streams of the program that is drawn and looked at, in so many changes.
const STREAMS: usize = 2_000;
const CHANGES: usize = 100;
/// Where browsers think that they are.
pub(crate) const ORIGIN: &str = "https://rrp.example";
/// How long each flood is measured, unless it is said by a variable.
const SECONDS: u64 = 2;
const SECONDS_SAID: &str = "RRP_ATTACK_SECONDS";
/// What 99 of 100 edits of a colleague may take: so many times what they take at rest, or this.
const TIMES: u128 = 5;
/// What is promised, where it is measured, in microseconds.
const MEASURED: Bars = Bars { edit_us: 50_000, revoke_us: 100_000 };
/// In a run of all tests: links that are no person's take seconds, of an edit and of a revocation.
const AMONG_ALL: Bars = Bars { edit_us: 500_000, revoke_us: 1_000_000 };
/// Threads that the server may have.
const THREADS: u64 = 96;
/// A flood is measured again so often if the computer was busy with something else.
const TRIES: usize = 3;
/// Between two times that the same is asked by those who are measured.
const PAUSE: Duration = Duration::from_millis(20);
/// What the attacking process is told.
const WISH: &str = "RRP_ATTACK_WISH";

/// What 99 of 100 may take.
struct Bars {
    edit_us: u128,
    revoke_us: u128,
}

/// Those of this run.
fn bars() -> Bars {
    if std::env::var_os(SECONDS_SAID).is_some() { MEASURED } else { AMONG_ALL }
}

/// What is asked without end: over sockets, or a file.
fn floods() -> Vec<(&'static str, Value)> {
    let large = "large";
    vec![
        ("another name", json!([{"is": "callMe", "name": "Ben 1"}, {"is": "callMe", "name": "Ben 2"}])),
        (
            "check",
            json!([{"is": "check", "arguments": ["d"], "body": "loop {}", "inputs": [[1.0], [2.0], [3.0], [4.0]]}]),
        ),
        ("at", json!([{"is": "at", "behaviour": large, "revision": CHANGES / 2}])),
        ("history", json!([{"is": "history", "behaviour": large}])),
        ("since", json!([{"is": "since", "behaviour": large, "revision": 1}])),
        ("list", json!([{"is": "list"}])),
        ("types", json!([{"is": "types", "behaviour": large}])),
        ("similar and contested", json!([{"is": "similar", "behaviour": large}, {"is": "contested"}])),
        ("open and leave", json!([{"is": "open", "behaviour": large}, {"is": "leave"}])),
        (
            "pointers",
            json!([{"is": "open", "behaviour": "shared"}, {"is": "present", "pointer": {"x": 1.0, "y": 2.0}, "selected": null}]),
        ),
        ("recordings and runs", json!([{"is": "recordings"}, {"is": "runs"}])),
        ("drawings", json!("/api/behaviours/large.svg")),
        ("the list as a file", json!("/api/behaviours")),
    ]
}

#[test]
fn a_hundred_links_of_one_viewer_take_nothing_from_others() -> Outcome<()> {
    skip::unless!(optimised("a hundred links of one viewer"));
    let _alone = crate::alone();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        let scene = Scene::open().await?;
        let rest = scene.measured(Duration::from_secs(seconds().max(3))).await?;
        println!("at rest: {rest}");
        for (name, wish) in floods() {
            scene.under(name, &wish, &rest).await?;
        }
        Ok(())
    })
}

/// The attacking process, which goes on until it is killed.
#[test]
#[ignore = "it attacks what another test names"]
fn attacker() -> Outcome<()> {
    let Ok(wish) = std::env::var(WISH) else { return Ok(()) };
    let wish: Value = serde_json::from_str(&wish)?;
    let door = Door { address: serde_json::from_value(wish["address"].clone())?, cookie: text(&wish["cookie"]) };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async move {
        for _ in 0..LINKS {
            tokio::spawn(attack(door.clone(), wish["asks"].clone()));
        }
        std::future::pending().await
    })
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// Whoever is cut off or refused comes again.
async fn attack(door: Door, asks: Value) {
    loop {
        drop(match &asks {
            Value::String(path) => door.get(path).await.map(drop),
            asks => flood(&door, asks).await,
        });
        tokio::time::sleep(PAUSE).await;
    }
}

async fn flood(door: &Door, asks: &Value) -> Outcome<()> {
    let link = door.link("Ben").await?;
    let (mut to, from) = link.split();
    let reading = tokio::spawn(from.for_each(|_| std::future::ready(())));
    for ask in 2_u32.. {
        let all = asks.as_array().ok_or("There is nothing to ask.")?;
        let one = &all[ask as usize % all.len()];
        let sent = to.send(Message::text(json!({ "ask": ask, "request": one }).to_string()));
        if reading.is_finished() || tokio::time::timeout(Duration::from_secs(5), sent).await.is_err() {
            break;
        }
        // Ten times what a person is let do, so that most of it is refused.
        if ask % 16 == 0 {
            tokio::time::sleep(Duration::from_millis(30)).await;
        }
    }
    reading.abort();
    Ok(())
}

/// The way in for others, as a proxy speaks to it, with somebody's cookie.
#[derive(Clone, Debug)]
pub(crate) struct Door {
    pub(crate) address: SocketAddr,
    pub(crate) cookie: String,
}

type Link = WebSocketStream<TcpStream>;

impl Door {
    /// Comes in by a link.
    pub(crate) async fn by(address: SocketAddr, link: &str) -> Outcome<Door> {
        let token = link.split_once('#').ok_or("This link has no token.")?.1;
        let body = format!("token={token}");
        let more = format!("Content-Type: application/x-www-form-urlencoded\r\nContent-Length: {}\r\n", body.len());
        let door = Door { address, cookie: String::new() };
        let answer = door
            .raw(&format!("POST /come-in HTTP/1.1\r\nHost: {address}\r\nOrigin: {ORIGIN}\r\n{more}\r\n{body}"))
            .await?;
        let cookie = answer.lines().find_map(|line| line.strip_prefix("set-cookie: ")).ok_or_else(|| answer.clone())?;
        Ok(Door { cookie: cookie.split(';').next().unwrap_or_default().to_owned(), ..door })
    }

    async fn raw(&self, request: &str) -> Outcome<String> {
        let mut stream = TcpStream::connect(self.address).await?;
        stream.write_all(request.as_bytes()).await?;
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).await?;
        Ok(String::from_utf8_lossy(&answer).into_owned())
    }

    pub(crate) async fn get(&self, path: &str) -> Outcome<String> {
        self.raw(&format!("GET {path} HTTP/1.1\r\nHost: {}\r\nCookie: {}\r\n\r\n", self.address, self.cookie)).await
    }

    /// A link that was let in and asks for no pictures.
    async fn link(&self, name: &str) -> Outcome<Link> {
        let mut request = format!("ws://{}/socket", self.address).into_client_request()?;
        let value = |text: &str| text.parse().map_err(|_| format!("{text:?} is no header."));
        request.headers_mut().insert("origin", value(ORIGIN)?);
        request.headers_mut().insert("cookie", value(&self.cookie)?);
        let stream = TcpStream::connect(self.address).await?;
        stream.set_nodelay(true)?;
        let (mut link, _) = tokio_tungstenite::client_async(request, stream).await?;
        ask(&mut link, 0, request::Hello { version: VERSION, name: name.to_owned(), again: None }).await?;
        ask(&mut link, 1, request::Watch { robot: None, scene: false, values: false }).await?;
        Ok(link)
    }
}

async fn ask(link: &mut Link, number: u32, request: impl Into<AnyRequest>) -> Outcome<AnyAnswer> {
    link.send(said(number, request)?).await?;
    while let Some(message) = link.next().await {
        let Message::Text(text) = message? else { continue };
        let told: Told = serde_json::from_str(&text)?;
        if let Some(outcome) = told.answer_to(number) {
            return outcome.map_err(|no| no.to_string().into());
        }
    }
    Err("The link ended.".into())
}

/// The server with a host, a colleague and the viewer who attacks.
struct Scene {
    target: Target,
    colleague: Door,
    viewer: Door,
    _server: Server,
    _folder: tempfile::TempDir,
}

impl Scene {
    async fn open() -> Outcome<Scene> {
        let folder = house::folder()?;
        let words = ["--listen", "127.0.0.1:0", "--behind-proxy", ORIGIN];
        let server = Server::start_binary(&house::optimised(), folder.path(), &words).await?;
        let target = Target::of(&server)?;
        let address = door_of(&server, 0).await?;
        let host = Client::connect(&target.url(), "Host").await?;
        fill(&host).await?;
        let colleague = Door::by(address, &invite(&host, Role::Editor).await?.1).await?;
        let viewer = Door::by(address, &invite(&host, Role::Viewer).await?.1).await?;
        Ok(Scene { target, colleague, viewer, _server: server, _folder: folder })
    }

    /// Measures under a flood, at most so often until what was promised is seen.
    async fn under(&self, name: &str, asks: &Value, rest: &Figures) -> Outcome<()> {
        let mut told = String::new();
        for _ in 0..TRIES {
            let attacker = Attacker::start(&self.viewer, asks)?;
            // So that the flood is under way.
            self.measured(Duration::from_millis(500)).await?;
            let figures = self.measured(Duration::from_secs(seconds())).await?;
            drop(attacker);
            told = format!("{name}: {figures}");
            println!("{told}");
            let Bars { edit_us, revoke_us } = bars();
            let most = edit_us.max(TIMES * rest.edit.at(99));
            if figures.edit.at(99) <= most && figures.revoke.at(99) <= revoke_us && figures.threads <= THREADS {
                return Ok(());
            }
        }
        let Bars { edit_us, revoke_us } = bars();
        Err(format!("Under {told}; promised are {edit_us} us, {revoke_us} us and {THREADS} threads.").into())
    }

    /// A colleague edits; the host lists, looks at the past and revokes; each by a link of their own, for so long.
    async fn measured(&self, long: Duration) -> Outcome<Figures> {
        let until = Instant::now() + long;
        let [lists, looks, revokes] = [
            Client::connect(&self.target.url(), "Lists").await?,
            Client::connect(&self.target.url(), "Looks").await?,
            Client::connect(&self.target.url(), "Revokes").await?,
        ];
        let edits = async {
            let mut link = self.colleague.link("Chie").await?;
            let (mut all, shared) = (Waits::default(), Id::new("shared")?);
            ask(&mut link, 2, request::Open { behaviour: shared.clone() }).await?;
            for number in 3.. {
                if Instant::now() >= until {
                    break;
                }
                let id = fresh("n");
                let change = Change::of(fresh("o"), "Chie", "Note").put(&nothing(), note_id(&id), note("Here"));
                let back = change.swapped(fresh("o"), "Note");
                for (number, change) in [(number, change), (number + 1_000_000, back)] {
                    let propose = request::Propose { behaviour: shared.clone(), change, tokens: Vec::new() };
                    all.wait(ask(&mut link, number, propose)).await?;
                }
                tokio::time::sleep(3 * PAUSE).await;
            }
            Outcome::Ok(all)
        };
        let listing = async {
            let mut all = Waits::default();
            while Instant::now() < until {
                all.wait(async { Ok(lists.ask(request::List { query: ListQuery::default() }).await?) }).await?;
                tokio::time::sleep(PAUSE).await;
            }
            Outcome::Ok(all)
        };
        let looking = async {
            let (mut all, behaviour) = (Waits::default(), Id::new("large")?);
            while Instant::now() < until {
                let at = request::History { behaviour: behaviour.clone(), before: None };
                all.wait(async { Ok(looks.ask(at).await?) }).await?;
                tokio::time::sleep(PAUSE).await;
            }
            Outcome::Ok(all)
        };
        let revoking = async {
            let mut all = Waits::default();
            while Instant::now() < until {
                let (invitation, _) = invite(&revokes, Role::Viewer).await?;
                all.wait(async { Ok(revokes.ask(request::Revoke { invitation }).await?) }).await?;
                tokio::time::sleep(4 * PAUSE).await;
            }
            Outcome::Ok(all)
        };
        let (edit, list, look, revoke) = tokio::try_join!(edits, listing, looking, revoking)?;
        Ok(Figures { edit, list, look, revoke, threads: self.target.threads()? })
    }
}

/// Where others come in, as the server said at this of its starts.
pub(crate) async fn door_of(server: &Server, start: usize) -> Outcome<SocketAddr> {
    server.said("others can come in").await?;
    let log = server.log();
    let lines = log.lines().filter(|line| line.contains("others can come in"));
    let line = lines.skip(start).last().ok_or("The server did not say where others come in.")?;
    let words = line.split(|letter: char| !letter.is_ascii_digit() && !".:".contains(letter));
    words.filter_map(|word| word.parse().ok()).next().ok_or_else(|| line.into())
}

/// A large program with a past, one that is edited, and some more.
async fn fill(host: &Client) -> Outcome<()> {
    for name in ["large", "shared"] {
        let create = request::Create { behaviour: Id::new(name)?, name: name.to_owned(), template: None };
        host.ask(create).await?;
    }
    for number in 0..CHANGES {
        let streams = (0..STREAMS / CHANGES).map(|_| stream()).collect();
        let (change, behaviour) = (host.change(&format!("Add {number}"), &nothing(), streams), Id::new("large")?);
        host.ask(request::Propose { behaviour, change, tokens: Vec::new() }).await?;
    }
    for _ in 0..50 {
        made(host, "One of many").await?;
    }
    Ok(())
}

fn stream() -> (RecordId, Option<Record>) {
    let id = fresh("s");
    let stream = Stream {
        kind: StreamKind::Ordinary,
        name: id.to_string(),
        device: None,
        params: behaviour::Params::new(),
        order: 0,
        resources: None,
        priority: None,
        hold_ms: None,
    };
    (RecordId::new(Kind::Stream, &id), Some(Record::Stream(stream)))
}

pub(crate) async fn invite(host: &Client, role: Role) -> Outcome<(Id, String)> {
    let invited = host.ask(request::Invite { role, lasts: Lasts::UntilRevoked, label: String::new() }).await?;
    Ok((invited.invitation.id, invited.link))
}

fn seconds() -> u64 {
    std::env::var(SECONDS_SAID).ok().and_then(|text| text.parse().ok()).unwrap_or(SECONDS)
}

/// The attacking process; it ends with this.
struct Attacker(Child);

impl Attacker {
    fn start(viewer: &Door, asks: &Value) -> Outcome<Attacker> {
        let wish = json!({ "address": viewer.address, "cookie": viewer.cookie, "asks": asks });
        let mut command = Command::new("nice");
        command.args(["-n", "19"]).arg(std::env::current_exe()?);
        command.args(["--exact", "shares::attacker", "--ignored"]).env(WISH, wish.to_string());
        Ok(Attacker(command.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?))
    }
}

impl Drop for Attacker {
    fn drop(&mut self) {
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

/// How long answers took, in microseconds.
#[derive(Default)]
struct Waits(Vec<u128>);

impl Waits {
    async fn wait<A>(&mut self, answer: impl Future<Output = Outcome<A>>) -> Outcome<()> {
        let began = Instant::now();
        answer.await?;
        self.0.push(began.elapsed().as_micros());
        Ok(())
    }

    /// What so many of a hundred were at most.
    fn at(&self, percent: usize) -> u128 {
        let mut all = self.0.clone();
        all.sort_unstable();
        all.get((all.len() * percent / 100).min(all.len().saturating_sub(1))).copied().unwrap_or_default()
    }
}

struct Figures {
    edit: Waits,
    list: Waits,
    look: Waits,
    revoke: Waits,
    threads: u64,
}

impl std::fmt::Display for Figures {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        for (name, waits) in
            [("edit", &self.edit), ("list", &self.list), ("past", &self.look), ("revoke", &self.revoke)]
        {
            let [p50, p99] = [50, 99].map(|percent| waits.at(percent) as f64 / 1_000.0);
            write!(to, "{name} p50 {p50:.1} p99 {p99:.1} ms ({}), ", waits.0.len())?;
        }
        write!(to, "{} threads", self.threads)
    }
}
