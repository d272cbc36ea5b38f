//! The connection to Chromium: numbered calls and their answers, and events for the page they belong to.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio::sync::{mpsc, oneshot};
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::protocol::WebSocketConfig;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream};

use crate::watch::Watch;
use crate::{Outcome, Trouble};

/// The longest time of Chromium for one call.
const CALL: Duration = Duration::from_secs(60);
/// Calls that may wait to be written.
const QUEUE: usize = 64;
/// The longest answer, in bytes; screenshots are the long ones.
const ANSWER_MAX: usize = 256 << 20;

type Answer = Result<Value, String>;
type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// A connection that many pages share.
pub(crate) struct Wire {
    last: AtomicU64,
    out: mpsc::Sender<Message>,
    inside: Mutex<Inside>,
}

#[derive(Default)]
struct Inside {
    closed: bool,
    waiting: BTreeMap<u64, oneshot::Sender<Answer>>,
    watches: BTreeMap<String, Arc<Watch>>,
}

impl Wire {
    /// Connects to the DevTools address that Chromium printed.
    pub(crate) async fn open(address: &str) -> Outcome<Arc<Wire>> {
        let config = WebSocketConfig::default().max_message_size(Some(ANSWER_MAX)).max_frame_size(Some(ANSWER_MAX));
        let connected = tokio_tungstenite::connect_async_with_config(address, Some(config), true).await;
        let (socket, _) = connected.map_err(|error| Trouble::of("Chromium does not answer", error))?;
        let (out, inbox) = mpsc::channel(QUEUE);
        let wire = Arc::new(Wire { last: AtomicU64::new(0), out, inside: Mutex::default() });
        tokio::spawn(Arc::clone(&wire).carry(socket, inbox));
        Ok(wire)
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives the events of `session` to `watch`.
    pub(crate) fn listen(&self, session: &str, watch: Arc<Watch>) {
        self.inside().watches.insert(session.to_owned(), watch);
    }

    /// True if Chromium has gone.
    pub(crate) fn closed(&self) -> bool {
        self.inside().closed
    }

    /// Calls `method` of Chromium, for one page when there is a `session`.
    pub(crate) async fn call(&self, session: Option<&str>, method: &str, params: Value) -> Outcome<Value> {
        let id = self.last.fetch_add(1, Ordering::Relaxed) + 1;
        let mut message = json!({ "id": id, "method": method, "params": params });
        if let Some(session) = session {
            message["sessionId"] = session.into();
        }
        let answer = self.expect(id)?;
        let sent = self.out.send(Message::text(message.to_string())).await;
        sent.map_err(|_| Trouble::of(method, "Chromium has gone"))?;
        match tokio::time::timeout(CALL, answer).await {
            Ok(Ok(answer)) => answer.map_err(|why| Trouble::of(method, why)),
            Ok(Err(_)) => Err(Trouble::of(method, "Chromium has gone")),
            Err(_) => Err(Trouble::of(method, format!("no answer within {} s", CALL.as_secs()))),
        }
    }

    /// Answers a request of a page; nobody waits for what Chromium says to that.
    fn fulfill(&self, session: &str, answer: &Value) {
        let id = self.last.fetch_add(1, Ordering::Relaxed) + 1;
        let message = json!({ "id": id, "sessionId": session, "method": "Fetch.fulfillRequest", "params": answer });
        // A full queue leaves the page waiting, which its test notices.
        drop(self.out.try_send(Message::text(message.to_string())));
    }

    fn expect(&self, id: u64) -> Outcome<oneshot::Receiver<Answer>> {
        let mut inside = self.inside();
        if inside.closed {
            return Err("Chromium has gone.".into());
        }
        let (tell, answer) = oneshot::channel();
        inside.waiting.insert(id, tell);
        Ok(answer)
    }

    /// Carries messages both ways until Chromium goes.
    async fn carry(self: Arc<Self>, mut socket: Socket, mut inbox: mpsc::Receiver<Message>) {
        loop {
            tokio::select! {
                Some(message) = inbox.recv() => if socket.send(message).await.is_err() { break },
                message = socket.next() => match message {
                    Some(Ok(Message::Text(text))) => self.take(&text),
                    Some(Ok(_)) => {}
                    Some(Err(_)) | None => break,
                },
            }
        }
        let mut inside = self.inside();
        inside.closed = true;
        inside.waiting.clear();
    }

    /// Brings one message to the call or the page that it is for.
    fn take(&self, text: &str) {
        let Ok(message) = serde_json::from_str::<Value>(text) else { return };
        if let Some(id) = message["id"].as_u64() {
            let waiting = self.inside().waiting.remove(&id);
            if let Some(tell) = waiting {
                let _ = tell.send(answer(message));
            }
        } else if let (Some(method), Some(session)) = (message["method"].as_str(), message["sessionId"].as_str()) {
            let watch = self.inside().watches.get(session).cloned();
            let Some(watch) = watch else { return };
            watch.note(method, &message["params"]);
            if method == "Fetch.requestPaused"
                && let Some(answer) = watch.answer_to(&message["params"])
            {
                self.fulfill(session, &answer);
            }
        }
    }
}

fn answer(mut message: Value) -> Answer {
    match message.get("error") {
        Some(error) => Err(error["message"].as_str().map_or_else(|| error.to_string(), str::to_owned)),
        None => Ok(message["result"].take()),
    }
}
