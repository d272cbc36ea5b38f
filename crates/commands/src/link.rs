//! The way to a store through the running server that uses it.

use crate::failure::Failure;
use behaviour::Id;
use http_body_util::{BodyExt, Full};
use hyper::body::{Bytes, Incoming};
use hyper::client::conn::http1;
use hyper::header::{HOST, ORIGIN};
use hyper::{Method, Request, StatusCode};
use hyper_util::rt::TokioIo;
use serde::de::DeserializeOwned;
use std::error::Error;
use std::fmt;
use std::io::Write;
use std::net::SocketAddr;
use std::time::Duration;
use tokio::net::TcpStream;

/// The longest wait for the server to take the call, in milliseconds.
const CONNECT_MS: u64 = 3_000;
/// The longest silence of the server within an answer, in milliseconds.
const SILENT_MS: u64 = 60_000;

/// An error of a library, of any type.
type BoxError = Box<dyn Error + Send + Sync>;

/// A running server on this computer.
pub(crate) struct LocalServer {
    pub(crate) address: SocketAddr,
}

/// A behaviour, as lists have it.
#[derive(Debug, serde::Deserialize)]
pub(crate) struct NamedBehaviour {
    pub(crate) id: Id,
    pub(crate) name: String,
}

/// An answer of the server.
pub(crate) struct ServerAnswer {
    /// True if it did what was asked.
    pub(crate) fine: bool,
    body: Incoming,
}

impl ServerAnswer {
    /// All of the text.
    pub(crate) async fn text(self) -> Result<String, Failure> {
        let mut text = Vec::new();
        self.copy(&mut text).await?;
        String::from_utf8(text).map_err(cut_off)
    }

    /// All of it into a file.
    pub(crate) async fn copy(mut self, to: &mut impl Write) -> Result<(), Failure> {
        while let Some(frame) = within(SILENT_MS, self.body.frame()).await.map_err(cut_off)? {
            let frame = frame.map_err(cut_off)?;
            let piece = frame.into_data().unwrap_or_default();
            to.write_all(&piece).map_err(cut_off)?;
        }
        Ok(())
    }
}

impl LocalServer {
    /// Asks for something.
    pub(crate) async fn get(&self, path: &str) -> Result<ServerAnswer, Failure> {
        self.ask(Method::GET, path, Bytes::new()).await
    }

    /// Sends something.
    pub(crate) async fn post(&self, path: &str, body: Vec<u8>) -> Result<ServerAnswer, Failure> {
        self.ask(Method::POST, path, body.into()).await
    }

    /// Id and name of everything that is not in the bin.
    pub(crate) async fn listed(&self) -> Result<Vec<NamedBehaviour>, Failure> {
        let text = self.get("/api/behaviours").await?.text().await?;
        serde_json::from_str(&text).map_err(|error| strange("a list", error))
    }

    async fn ask(&self, method: Method, path: &str, body: Bytes) -> Result<ServerAnswer, Failure> {
        let answer = self.exchange(method, path, body).await;
        answer.map_err(|error| {
            let address = self.address;
            Failure::of(format!("The rrp server at http://{address}/ does not answer ({error}). Look whether it runs."))
        })
    }

    async fn exchange(&self, method: Method, path: &str, body: Bytes) -> Result<ServerAnswer, BoxError> {
        let (address, origin) = (self.address, format!("http://{}", self.address));
        let request = Request::builder().method(method).uri(path);
        let mut request = request.header(HOST, address.to_string()).header(ORIGIN, origin);
        if let Some(key) = host_key::of_server(address) {
            request = request.header(host_key::HEADER, host_key::header(&key));
        }
        let request = request.body(Full::new(body))?;
        let stream = within(CONNECT_MS, TcpStream::connect(address)).await??;
        let (mut server, connection) = http1::handshake(TokioIo::new(stream)).await?;
        // Ends with the answer; what is wrong with it is told there.
        drop(tokio::spawn(connection));
        let answer = within(SILENT_MS, server.send_request(request)).await??;
        Ok(ServerAnswer { fine: answer.status() == StatusCode::OK, body: answer.into_body() })
    }
}

/// Waits, but not for ever.
async fn within<T>(ms: u64, work: impl Future<Output = T>) -> Result<T, tokio::time::error::Elapsed> {
    tokio::time::timeout(Duration::from_millis(ms), work).await
}

fn cut_off(error: impl fmt::Display) -> Failure {
    Failure::of(format!("The rrp server stopped in the middle of its answer ({error}). Try again."))
}

/// Reads an answer of the server.
///
/// # Errors
/// It says something else.
pub(crate) fn understood<T: DeserializeOwned>(answer: &str) -> Result<T, Failure> {
    serde_json::from_str(answer).map_err(|error| strange("an answer", error))
}

fn strange(what: &str, error: serde_json::Error) -> Failure {
    Failure::of(format!("The rrp server gave {what} that cannot be read ({error}). Is it of another version?"))
}
