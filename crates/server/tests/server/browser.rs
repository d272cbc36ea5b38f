//! Somebody at another computer: a browser's side of TLS, cookies and sockets, with every byte in hand.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use futures_util::{SinkExt, StreamExt};
use protocol::{AnyAnswer, AnyRequest, Ask, Event, Message, Refused, Request, RequestAnswer, Role, request};
use std::net::{IpAddr, SocketAddr};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpSocket, TcpStream};
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;
use tokio_rustls::rustls::client::Resumption;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::{CertificateDer, ServerName};
use tokio_rustls::rustls::{ClientConfig, RootCertStore};
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::protocol::CloseFrame;
use tokio_tungstenite::tungstenite::{Error, Message as Frame};

/// Servers of which a browser keeps tickets.
const TICKETS_OF: usize = 8;
/// How long anything may take before a test gives up.
const PATIENCE: Duration = Duration::from_secs(60);

/// A browser that trusts the certificate of one server.
#[derive(Clone)]
pub(crate) struct Browser {
    /// Keeps tickets, and shows each once.
    pub(crate) tls: ClientConfig,
    /// From which of its addresses it connects; none if it does not matter.
    pub(crate) from: Option<IpAddr>,
    /// Where the server is.
    pub(crate) address: SocketAddr,
    /// `NAME=VALUE`, as it is sent.
    pub(crate) cookie: Option<String>,
}

impl Browser {
    /// For a server with this data folder, at the place of this link.
    pub(crate) fn new(data: &Path, link: &str) -> Self {
        let kept = std::fs::read_to_string(data.join("rrp.certificate.json")).unwrap();
        let kept: serde_json::Value = serde_json::from_str(&kept).unwrap();
        let mut roots = RootCertStore::empty();
        let certificate = STANDARD.decode(kept["certificate"].as_str().unwrap()).unwrap();
        roots.add(CertificateDer::from(certificate)).unwrap();
        let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()));
        let config = config.with_safe_default_protocol_versions().unwrap();
        let tls = config.with_root_certificates(roots).with_no_client_auth();
        let place = link.strip_prefix("https://").unwrap().split('/').next().unwrap();
        Self { tls, from: None, address: place.parse().unwrap(), cookie: None }
    }

    /// Somebody else at the same computer, without our cookie and our tickets.
    pub(crate) fn stranger(&self) -> Self {
        let mut stranger = Self { cookie: None, ..self.clone() };
        stranger.tls.resumption = Resumption::in_memory_sessions(TICKETS_OF);
        stranger
    }

    async fn connect(&self) -> std::io::Result<TlsStream<TcpStream>> {
        let socket = if self.address.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
        if let Some(from) = self.from {
            socket.bind((from, 0).into())?;
        }
        self.agree(socket.connect(self.address).await?).await
    }

    /// Agrees on TLS.
    pub(crate) async fn agree(&self, stream: TcpStream) -> std::io::Result<TlsStream<TcpStream>> {
        let tls = TlsConnector::from(Arc::new(self.tls.clone()));
        tls.connect(ServerName::from(self.address.ip()), stream).await
    }

    /// Sends a request as it is, and reads nothing.
    pub(crate) async fn begin(&self, request: &str) -> std::io::Result<TlsStream<TcpStream>> {
        let mut stream = self.connect().await?;
        stream.write_all(request.as_bytes()).await?;
        Ok(stream)
    }

    /// Sends a request as it is and answers with everything that came back.
    pub(crate) async fn raw(&self, request: &str) -> String {
        self.try_raw(request).await.unwrap()
    }

    /// The same, also where the server wants no connection.
    pub(crate) async fn try_raw(&self, request: &str) -> std::io::Result<String> {
        let mut stream = self.begin(request).await?;
        let mut answer = Vec::new();
        let _ = tokio::time::timeout(PATIENCE, stream.read_to_end(&mut answer)).await?;
        Ok(String::from_utf8_lossy(&answer).into_owned())
    }

    /// A request with our cookie, and with more lines and a body, as text.
    pub(crate) fn request(&self, method: &str, path: &str, more: &str, body: &str) -> String {
        let cookie = self.cookie.as_ref().map(|cookie| format!("Cookie: {cookie}\r\n")).unwrap_or_default();
        let (host, length) = (self.address, body.len());
        format!("{method} {path} HTTP/1.1\r\nHost: {host}\r\n{cookie}Content-Length: {length}\r\n{more}\r\n{body}")
    }

    /// What a page of the server sends with a form.
    pub(crate) fn own_page(&self) -> String {
        format!("Origin: https://{}\r\nContent-Type: application/x-www-form-urlencoded\r\n", self.address)
    }

    /// The answer to a GET.
    pub(crate) async fn get(&self, path: &str) -> String {
        self.raw(&self.request("GET", path, "", "")).await
    }

    /// The answer to what a page of the server posts.
    pub(crate) async fn post(&self, path: &str, body: &str) -> String {
        self.raw(&self.request("POST", path, &self.own_page(), body)).await
    }

    /// Presses the button on the page of a link, and keeps the cookie.
    pub(crate) async fn join(&mut self, link: &str) -> String {
        let answer = self.post("/come-in", &format!("token={}", token(link))).await;
        let cookie = answer.lines().find_map(|line| line.strip_prefix("set-cookie: "));
        if let Some(cookie) = cookie {
            self.cookie = cookie.split(';').next().map(str::to_owned);
        }
        answer
    }

    /// A socket, if the server lets us have one; else the status of its answer.
    pub(crate) async fn socket(&self, name: &str) -> Result<Socket, u16> {
        let mut request = format!("wss://{}/socket", self.address).into_client_request().unwrap();
        let mut put =
            |name: &'static str, value: &str| drop(request.headers_mut().insert(name, value.parse().unwrap()));
        put("origin", &format!("https://{}", self.address));
        self.cookie.iter().for_each(|cookie| put("cookie", cookie));
        let stream = match tokio_tungstenite::client_async(request, self.connect().await.unwrap()).await {
            Ok((stream, _)) => stream,
            Err(Error::Http(answer)) => return Err(answer.status().as_u16()),
            Err(other) => panic!("{other}"),
        };
        let mut socket = Socket { stream, asks: 0, role: Role::Viewer, heard: Vec::new() };
        let hello = request::Hello { version: protocol::VERSION, name: name.into(), again: None };
        socket.role = socket.ask(hello).await.unwrap().role;
        Ok(socket)
    }
}

/// The token of a link.
pub(crate) fn token(link: &str) -> &str {
    link.split_once('#').unwrap().1
}

/// The status of an answer.
pub(crate) fn status(answer: &str) -> u16 {
    answer.split_whitespace().nth(1).unwrap_or_else(|| panic!("no answer: {answer}")).parse().unwrap()
}

/// A socket that was welcomed.
pub(crate) struct Socket {
    stream: WebSocketStream<TlsStream<TcpStream>>,
    asks: u32,
    /// The role that the welcome said.
    pub(crate) role: Role,
    /// The events that were told unasked since the last ask.
    pub(crate) heard: Vec<Event>,
}

impl Socket {
    /// Asks, without waiting.
    pub(crate) async fn send(&mut self, request: impl Into<AnyRequest>) -> u32 {
        self.asks += 1;
        let text = serde_json::to_string(&Ask::new(self.asks, request)).unwrap();
        self.stream.send(Frame::text(text)).await.unwrap();
        self.asks
    }

    /// Asks and waits for the answer.
    pub(crate) async fn ask<R: Request>(&mut self, request: R) -> Result<R::Answer, Refused> {
        self.ask_any(request).await.map(|answer| R::Answer::of(answer).unwrap())
    }

    /// Asks what is known only when it runs, and waits for the answer.
    pub(crate) async fn ask_any(&mut self, request: impl Into<AnyRequest>) -> Result<AnyAnswer, Refused> {
        let number = self.send(request).await;
        self.heard.clear();
        loop {
            match self.next().await.unwrap_or_else(|close| panic!("{close:?}")) {
                Message::Event(event) => self.heard.push(event),
                message => {
                    if let Some(outcome) = message.answer_to(number) {
                        return outcome;
                    }
                }
            }
        }
    }

    /// What comes next; with how the socket ends, if it does.
    pub(crate) async fn next(&mut self) -> Result<Message, Option<CloseFrame>> {
        loop {
            match tokio::time::timeout(PATIENCE, self.stream.next()).await.expect("something is told in time") {
                Some(Ok(Frame::Text(text))) => return Ok(serde_json::from_str(&text).unwrap()),
                Some(Ok(Frame::Close(frame))) => return Err(frame),
                Some(Ok(_)) => {}
                Some(Err(_)) | None => return Err(None),
            }
        }
    }

    /// Waits until the server ends this; with its code.
    pub(crate) async fn until_closed(&mut self) -> Option<u16> {
        loop {
            if let Err(close) = self.next().await {
                return close.map(|frame| frame.code.into());
            }
        }
    }
}
