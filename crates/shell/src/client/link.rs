//! The task behind a client: carries messages both ways, answers pings, and keeps the mirrors.

use super::NoLink;
use super::mirror::Mirrors;
use futures_util::{SinkExt, StreamExt};
use protocol::{AnyAnswer, AnyRequest, Ask, Assembly, Event, Message as Told, PATH, Refused, request};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::sync::{mpsc, oneshot};
use tokio::task::AbortHandle;
use tokio::time::Instant;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::handshake::client::Request as Handshake;
use tokio_tungstenite::tungstenite::http::{HeaderValue, StatusCode, Uri};
use tokio_tungstenite::tungstenite::protocol::{CloseFrame, WebSocketConfig};
use tokio_tungstenite::tungstenite::{self, Error, Message};
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream};

/// The largest message taken from the server, in bytes: large behaviours come in parts, a change as a whole.
const MESSAGE_MAX_BYTES: usize = 64 << 20;
/// Requests that may wait to be written.
const LINES_MAX: usize = 256;
/// Things told that may wait to be fetched.
const TOLD_MAX: usize = 4_096;
/// Of these, places that pictures and live values leave to what matters.
const TOLD_FREE: usize = 1_024;
/// The longest time to connect.
const CONNECT_MS: u64 = 10_000;
/// The longest silence of the server, though it says every half second that it is there.
const SILENT_MS: u64 = 10_000;
/// Numbers of asks that the link makes itself, apart from the client's.
const OWN_ASK: u32 = u32::MAX;

type ConsoleSocket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// The answer to a request, or why there is none.
pub(super) type AskOutcome = Result<AnyAnswer, Refused>;

/// A request and who waits for its answer.
pub(super) struct OpenRequest {
    pub(super) ask: u32,
    pub(super) stops: Option<u64>,
    pub(super) request: AnyRequest,
    pub(super) waiting: Option<oneshot::Sender<AskOutcome>>,
}

/// The state that client and task share.
pub(super) struct ConsoleLink {
    mirrors: Mutex<Mirrors>,
    ended: Mutex<Option<NoLink>>,
    /// The newest Stop that was heard of; 0 before the first time.
    stops: AtomicU64,
}

impl ConsoleLink {
    pub(super) fn mirrors(&self) -> MutexGuard<'_, Mirrors> {
        self.mirrors.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the newest Stop that was heard of.
    pub(super) fn stops(&self) -> Option<u64> {
        Some(self.stops.load(Ordering::SeqCst)).filter(|stops| *stops > 0)
    }

    /// Returns the reason why the link ended.
    pub(super) fn ended(&self) -> Option<NoLink> {
        self.ended.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

type OpenedSocket = (Arc<ConsoleLink>, mpsc::Sender<OpenRequest>, mpsc::Receiver<Event>, AbortHandle);

/// Connects and starts the task.
pub(super) async fn open(url: &str) -> Result<OpenedSocket, NoLink> {
    let config =
        WebSocketConfig::default().max_message_size(Some(MESSAGE_MAX_BYTES)).max_frame_size(Some(MESSAGE_MAX_BYTES));
    let connecting = async {
        let request = handshake(url).await?;
        tokio_tungstenite::connect_async_with_config(request, Some(config), true).await
    };
    let connected = tokio::time::timeout(Duration::from_millis(CONNECT_MS), connecting).await;
    let (socket, _) = match connected {
        Ok(Ok(connected)) => connected,
        Ok(Err(Error::Http(answer))) if answer.status() == StatusCode::UNAUTHORIZED => {
            return Err(NoLink::NotHost(url.to_owned()));
        }
        Ok(Err(error)) => return Err(NoLink::NoServer { url: url.to_owned(), error: error.to_string() }),
        Err(_) => return Err(NoLink::Silent(url.to_owned())),
    };
    let mirrors = Mutex::new(Mirrors::empty()?);
    let link = Arc::new(ConsoleLink { mirrors, ended: Mutex::new(None), stops: AtomicU64::new(0) });
    let (lines, inbox) = mpsc::channel(LINES_MAX);
    let (tell, told) = mpsc::channel(TOLD_MAX);
    let carrier =
        Carrier { link: Arc::clone(&link), socket, tell, waiting: BTreeMap::new(), assembly: Assembly::default() };
    let carrying = tokio::spawn(carrier.carry(inbox));
    Ok((link, lines, told, carrying.abort_handle()))
}

/// Makes the first request to the server at an address, `http://HOST:PORT/` or `HOST:PORT`, to get a socket. Where that
/// server is this user's own on this computer, it shows that we are its host.
///
/// # Errors
/// If this is no address.
pub async fn handshake(url: &str) -> Result<Handshake, Error> {
    let mut request = socket_address(url).into_client_request()?;
    if let Some(key) = key_for(request.uri()).await {
        let shown = HeaderValue::from_str(&host_key::header(&key)).map_err(tungstenite::http::Error::from)?;
        request.headers_mut().insert(host_key::HEADER, shown);
    }
    Ok(request)
}

/// The key of a server of this user's on this computer.
async fn key_for(uri: &Uri) -> Option<String> {
    let place = (uri.host()?.trim_matches(['[', ']']), uri.port_u16().unwrap_or(80));
    let mut addresses = tokio::net::lookup_host(place).await.ok()?.filter(|address| address.ip().is_loopback());
    addresses.find_map(host_key::of_server)
}

/// `http://HOST:PORT/` or `HOST:PORT` as the address of the socket.
fn socket_address(url: &str) -> String {
    let bare = ["http://", "ws://"].iter().find_map(|scheme| url.strip_prefix(scheme)).unwrap_or(url);
    let host = bare.split('/').next().unwrap_or(bare);
    format!("ws://{host}{PATH}")
}

struct Carrier {
    link: Arc<ConsoleLink>,
    socket: ConsoleSocket,
    tell: mpsc::Sender<Event>,
    waiting: BTreeMap<u32, oneshot::Sender<AskOutcome>>,
    assembly: Assembly,
}

impl Carrier {
    async fn carry(mut self, mut inbox: mpsc::Receiver<OpenRequest>) {
        let mut heard = Instant::now();
        let why = loop {
            tokio::select! {
                () = tokio::time::sleep_until(heard + Duration::from_millis(SILENT_MS)) => break NoLink::Unheard,
                line = inbox.recv() => match line {
                    Some(line) => if let Err(error) = self.send(line).await { break lost(&error) },
                    None => break NoLink::Closed,
                },
                message = self.socket.next() => {
                    heard = Instant::now();
                    match message {
                        Some(Ok(Message::Text(text))) => if let Err(error) = self.hear(&text).await { break lost(&error) },
                        Some(Ok(Message::Close(frame))) => break goodbye(frame),
                        Some(Ok(_)) => {}
                        Some(Err(error)) => break lost(&error),
                        None => break NoLink::EndedByServer,
                    }
                }
            }
        };
        *self.link.ended.lock().unwrap_or_else(PoisonError::into_inner) = Some(why);
        let _ = tokio::time::timeout(Duration::from_secs(1), self.socket.close(None)).await;
    }

    async fn send(&mut self, line: OpenRequest) -> Result<(), Error> {
        if let Some(waiting) = line.waiting {
            self.waiting.insert(line.ask, waiting);
        }
        let ask = Ask { ask: line.ask, stops: line.stops, request: line.request };
        let text = serde_json::to_string(&ask).map_err(|error| Error::Io(std::io::Error::other(error)))?;
        self.socket.send(Message::text(text)).await
    }

    async fn hear(&mut self, text: &str) -> Result<(), Error> {
        let broken = |error: Box<dyn std::error::Error + Send + Sync>| Error::Io(std::io::Error::other(error));
        let told = serde_json::from_str::<Told>(text).map_err(|error| broken(error.into()))?;
        let Some(told) = self.assembly.take(told).map_err(|missing| broken(missing.into()))? else { return Ok(()) };
        self.link.stops.fetch_max(told.stops().unwrap_or_default(), Ordering::SeqCst);
        let missing = {
            let mut mirrors = self.link.mirrors();
            mirrors.hear(&told);
            mirrors.missing(&told)
        };
        for (behaviour, revision) in missing {
            let request = request::Since { behaviour, revision }.into();
            self.send(OpenRequest { ask: OWN_ASK, stops: None, request, waiting: None }).await?;
        }
        self.pass_on(told);
        Ok(())
    }

    /// To who asked, else to who fetches; when that one is slow, pictures go first.
    fn pass_on(&mut self, told: Told) {
        let (ask, outcome) = match told {
            Told::Answer { ask, answer } => (Some(ask), Ok(answer)),
            Told::No { ask, no } => (ask, Err(no)),
            Told::Event(event) => {
                let picture = matches!(event, Event::Scene { .. } | Event::Values { .. } | Event::People { .. });
                if !picture || self.tell.capacity() > TOLD_FREE {
                    let _ = self.tell.try_send(event);
                }
                return;
            }
            // They were put together.
            Told::Records { .. } => return,
        };
        if let Some(waiting) = ask.and_then(|ask| self.waiting.remove(&ask)) {
            let _ = waiting.send(outcome);
        }
    }
}

fn lost(error: &Error) -> NoLink {
    NoLink::Lost(error.to_string())
}

fn goodbye(frame: Option<CloseFrame>) -> NoLink {
    match frame.as_ref().map(|frame| frame.reason.as_str()) {
        Some("restart") => NoLink::Restart,
        Some("resync") => NoLink::TooSlow,
        Some("replaced") => NoLink::Replaced,
        Some(reason) if !reason.is_empty() => NoLink::EndedBecause(reason.to_owned()),
        _ => NoLink::EndedByServer,
    }
}

#[cfg(test)]
mod tests {
    use super::socket_address;

    #[test]
    fn the_socket_is_found_from_what_people_type() {
        for url in ["http://127.0.0.1:7130/", "127.0.0.1:7130", "ws://127.0.0.1:7130/socket", "http://127.0.0.1:7130"] {
            assert_eq!(socket_address(url), "ws://127.0.0.1:7130/socket");
        }
    }
}
