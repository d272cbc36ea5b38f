//! Makes programs of any size over a socket, without the page.

use behaviour::{
    Behaviour, Change, Connector, Id, Kind, Params, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
};
use futures_util::{SinkExt, StreamExt};
use house::{Outcome, Server, Trouble};
use protocol::{AnyRequest, Ask, Message, request};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream};

/// Streams in a row of the graph.
const ROW: usize = 6;

/// So many streams are added by one change, whole parts of three.
const PROPOSED_AT_ONCE: usize = 99;

/// What the streams are called.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Names {
    Short,
    /// Of 200 characters, without a place to break.
    Long,
    Japanese,
}

impl Names {
    fn name(self, number: usize) -> String {
        match self {
            Self::Short => format!("Stream {number}"),
            Self::Long => {
                let start = format!("Stream{number}");
                format!(
                    "{start}{}",
                    "WideLettersWithoutAnyBreak".repeat(8).chars().take(200 - start.len()).collect::<String>()
                )
            }
            Self::Japanese => format!("赤いボールまでの距離を測るストリーム{number}"),
        }
    }

    fn title(self, count: usize) -> String {
        match self {
            Self::Short => format!("Program of {count}"),
            Self::Long => format!("Program of {count} {}", "WideLettersWithoutAnyBreak".repeat(6)),
            Self::Japanese => format!("子どもと赤いボールで遊ぶプログラム {count}"),
        }
    }
}

/// Makes a program and answers with its id.
pub(crate) async fn make(server: &Server, names: Names, count: usize) -> Outcome<Id> {
    let mut line = Line::open(server).await?;
    let behaviour = id(&format!("looks-{names:?}-{count}"))?;
    line.ask(request::Create { behaviour: behaviour.clone(), name: names.title(count), template: None }).await?;
    line.ask(request::Open { behaviour: behaviour.clone() }).await?;
    let mut change = Change::of(id(&format!("op-{names:?}-{count}"))?, "looks", "Add streams");
    let none = Behaviour::default();
    for (record_id, record) in records(names, count)? {
        change = change.put(&none, record_id, record);
    }
    line.ask(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() }).await?;
    Ok(behaviour)
}

/// Makes a program of parts without a connection that nobody placed, of three streams each, and answers with its id.
pub(crate) async fn make_parts(server: &Server, count: usize) -> Outcome<Id> {
    let mut line = Line::open(server).await?;
    let behaviour = id(&format!("parts-{count}"))?;
    line.ask(request::Create { behaviour: behaviour.clone(), name: format!("Parts of {count}"), template: None })
        .await?;
    line.ask(request::Open { behaviour: behaviour.clone() }).await?;
    let none = Behaviour::default();
    let numbers: Vec<usize> = (0..count).collect();
    for some in numbers.chunks(PROPOSED_AT_ONCE) {
        let mut change = Change::of(id(&format!("parts-{count}-{}", some[0]))?, "looks", "Add streams");
        for at in some {
            let (stream, order) = (id(&format!("s{at}"))?, i64::try_from(*at).unwrap_or(i64::MAX) * 2);
            let is_first = at % 3 == 0;
            let kind = if is_first { StreamKind::Sensor } else { StreamKind::Ordinary };
            let (name, device, params) = (format!("Ball {at}"), is_first.then(|| "RedBall".to_owned()), Params::new());
            let record = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
            change = change.put(&none, RecordId::new(Kind::Stream, &stream), Record::Stream(record));
            if !is_first {
                let operation = connectors::filter::SPEC.with(Procedure::body("true"));
                let inputs = vec![id(&format!("s{}", at - 1))?];
                let connector = Connector { operation, inputs, output: stream, order: order + 1 };
                let key = RecordId::new(Kind::Connector, &id(&format!("c{at}"))?);
                change = change.put(&none, key, Record::Connector(connector));
            }
        }
        line.ask(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() }).await?;
    }
    Ok(behaviour)
}

/// Makes a program of one ball, and answers with its id.
pub(crate) async fn make_ball(server: &Server, name: &str) -> Outcome<Id> {
    let mut line = Line::open(server).await?;
    let behaviour = id("fight")?;
    line.ask(request::Create { behaviour: behaviour.clone(), name: name.to_owned(), template: None }).await?;
    let ball = [("ball", StreamKind::Sensor, "Ball", "RedBall", Place { x: 0.0, y: 0.0 })];
    line.add(&behaviour, &ball).await?;
    Ok(behaviour)
}

/// Adds two trackers that want the head, told by the ball.
pub(crate) async fn add_trackers(server: &Server, behaviour: &Id) -> Outcome<()> {
    let trackers = [
        ("one", StreamKind::Actuator, "Tracker one", "Tracker", Place { x: -160.0, y: 240.0 }),
        ("two", StreamKind::Actuator, "Tracker two", "Tracker", Place { x: 160.0, y: 240.0 }),
    ];
    Line::open(server).await?.add(behaviour, &trackers).await
}

/// A sensor, and streams that each come from the one above.
fn records(names: Names, count: usize) -> Outcome<Vec<(RecordId, Record)>> {
    let mut records = Vec::new();
    for at in 0..count {
        let stream = id(&format!("s{at}"))?;
        let order = i64::try_from(at).unwrap_or(i64::MAX) * 2;
        let kind = if at == 0 { StreamKind::Sensor } else { StreamKind::Ordinary };
        let device = (at == 0).then(|| "RedBall".to_owned());
        let (name, params) = (names.name(at), Params::new());
        let record = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
        records.push((RecordId::new(Kind::Stream, &stream), Record::Stream(record)));
        let place = Place { x: (at % ROW) as f64 * 420.0, y: (at / ROW) as f64 * 150.0 };
        records.push((RecordId::new(Kind::Place, &stream), Record::Place(place)));
        if at > 0 {
            let above = at.saturating_sub(ROW);
            let operation = connectors::filter::SPEC.with(Procedure::body("true"));
            let connector =
                Connector { operation, inputs: vec![id(&format!("s{above}"))?], output: stream, order: order + 1 };
            records.push((RecordId::new(Kind::Connector, &id(&format!("c{at}"))?), Record::Connector(connector)));
        }
    }
    Ok(records)
}

fn id(text: &str) -> Outcome<Id> {
    Ok(Id::new(text)?)
}

/// A greeted socket.
struct Line {
    socket: WebSocketStream<MaybeTlsStream<TcpStream>>,
    asks: u32,
}

impl Line {
    async fn open(server: &Server) -> Outcome<Line> {
        let asked = shell::handshake(&server.url()).await;
        let asked = asked.map_err(|error| Trouble(format!("There is no address: {error}")))?;
        let connected = tokio_tungstenite::connect_async(asked).await;
        let (socket, _) = connected.map_err(|error| Trouble(format!("There is no socket: {error}")))?;
        let mut line = Line { socket, asks: 0 };
        let hello = request::Hello { version: protocol::VERSION, name: "Looks".to_owned(), again: None };
        line.ask(hello).await?;
        Ok(line)
    }

    /// Adds streams of devices; what acts is told by the ball.
    async fn add(&mut self, behaviour: &Id, streams: &[(&str, StreamKind, &str, &str, Place)]) -> Outcome<()> {
        self.ask(request::Open { behaviour: behaviour.clone() }).await?;
        let none = Behaviour::default();
        let mut change = Change::of(id(&format!("add-{}", streams.len()))?, "looks", "Add streams");
        for (at, (key, kind, name, device, place)) in streams.iter().enumerate() {
            let (key, order) = (id(key)?, i64::try_from(at + streams.len()).unwrap_or(i64::MAX) * 2);
            let (name, device, params) = ((*name).to_owned(), Some((*device).to_owned()), Params::new());
            let record =
                Stream { kind: *kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
            change = change.put(&none, RecordId::new(Kind::Stream, &key), Record::Stream(record));
            change = change.put(&none, RecordId::new(Kind::Place, &key), Record::Place(*place));
            if *kind == StreamKind::Actuator {
                let operation = connectors::subscribe::SPEC.with(());
                let connector =
                    Connector { operation, inputs: vec![id("ball")?], output: key.clone(), order: order + 1 };
                change = change.put(&none, RecordId::new(Kind::Connector, &key), Record::Connector(connector));
            }
        }
        self.ask(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() }).await
    }

    /// Asks, and waits for a yes.
    async fn ask(&mut self, request: impl Into<AnyRequest>) -> Outcome<()> {
        self.asks += 1;
        let text = serde_json::to_string(&Ask::new(self.asks, request))?;
        let sent = self.socket.send(tungstenite::Message::text(text)).await;
        sent.map_err(|error| Trouble(format!("The socket takes nothing: {error}")))?;
        while let Some(Ok(told)) = self.socket.next().await {
            let Ok(text) = told.to_text() else { continue };
            let Ok(message) = serde_json::from_str::<Message>(text) else { continue };
            if let Some(outcome) = message.answer_to(self.asks) {
                return outcome.map(drop).map_err(|no| Trouble(no.to_string()));
            }
        }
        Err("The socket has ended.".into())
    }
}
