//! A client without a page: makes programs of any size in a moment.

use futures_util::{SinkExt, StreamExt};
use house::{Outcome, Server, Trouble};
use protocol::{AnyAnswer, Message as Told};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream};

/// So many streams, with their connectors and places, fit in one message.
const AT_ONCE: usize = 200;
/// A program is drawn in columns of so many streams, one under the other.
const DEEP: usize = 20;

type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// The client. It comes and goes with every request, so that it never falls silent.
pub(crate) struct Wire {
    url: String,
}

impl Wire {
    pub(crate) fn to(server: &Server) -> Self {
        Self { url: server.url() }
    }

    async fn ask(&self, request: Value) -> Outcome<AnyAnswer> {
        let asked = shell::handshake(&self.url).await.map_err(broken)?;
        let (mut socket, _) = tokio_tungstenite::connect_async(asked).await.map_err(broken)?;
        let hello = json!({ "is": "hello", "version": protocol::VERSION, "name": "Hands" });
        ask(&mut socket, 0, hello).await?;
        ask(&mut socket, 1, request).await
    }

    /// A program from a template, or an empty one; answers with its id.
    pub(crate) async fn make(&self, name: &str, template: Option<&str>) -> Outcome<String> {
        let id = name.to_lowercase().replace(' ', "-").replace(',', "");
        let create = json!({ "is": "create", "behaviour": id, "name": name, "template": template });
        self.ask(create).await.map(|_| id)
    }

    /// A program of `count` streams in columns, each column one chain from a sense down.
    pub(crate) async fn make_large(&self, name: &str, count: usize) -> Outcome<String> {
        let id = self.make(name, None).await?;
        let all: Vec<usize> = (0..count).collect();
        for (part, some) in all.chunks(AT_ONCE).enumerate() {
            let edits: Vec<Value> = some.iter().flat_map(|at| stream(*at)).collect();
            let change = json!({
                "op": format!("{id}-{part}"), "author": "Hands", "label": "Many streams", "at_ms": 0, "edits": edits,
            });
            self.ask(json!({ "is": "propose", "behaviour": id, "change": change })).await?;
        }
        Ok(id)
    }
}

async fn ask(socket: &mut Socket, number: u32, request: Value) -> Outcome<AnyAnswer> {
    let message = json!({ "ask": number, "request": request }).to_string();
    socket.send(Message::text(message)).await.map_err(broken)?;
    while let Some(message) = socket.next().await {
        let Message::Text(text) = message.map_err(broken)? else { continue };
        let told: Told = serde_json::from_str(&text)?;
        if let Some(outcome) = told.answer_to(number) {
            return outcome.map_err(|no| format!("The server said no: {no}").into());
        }
    }
    Err("The server closed the socket.".into())
}

/// The edits that add one stream, its place and the connector that leads to it.
fn stream(at: usize) -> Vec<Value> {
    let (column, row) = (at / DEEP, at % DEEP);
    let id = format!("s{at}");
    let place = json!({ "place": { "x": column as f64 * 340.0, "y": row as f64 * 140.0 } });
    let order = at * 2;
    let kind = if row == 0 { "sensor" } else { "ordinary" };
    let mut stream = json!({ "kind": kind, "name": format!("Stream {at}"), "params": {}, "order": order });
    if row == 0 {
        stream["device"] = "RedBall".into();
    }
    let edit = |kind: &str, after: Value| json!({ "id": format!("{kind}/{id}"), "after": after });
    let mut edits = vec![edit("stream", json!({ "stream": stream })), edit("place", place)];
    if row > 0 {
        let operation = json!({ "filter": { "body": { "body": "true" } } });
        let inputs = [format!("s{}", at - 1)];
        let connector = json!({ "operation": operation, "inputs": inputs, "output": id, "order": order + 1 });
        edits.push(edit("connector", json!({ "connector": connector })));
    }
    edits
}

fn broken(why: tokio_tungstenite::tungstenite::Error) -> Trouble {
    Trouble(format!("The socket broke: {why}"))
}
