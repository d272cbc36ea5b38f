//! A stand-in of its own for each test, and what tests ask of it.

use house::StandIn;
use qi::{EventChoice, Object, QiError, Session, SessionOptions, SignalEvent, Subscription, Value};
use serde_json::{Value as Json, json};
use std::time::Duration;

/// How long anything may take before a test gives up.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);
/// Of everything that is asked again and again.
pub(crate) const PAUSE: Duration = Duration::from_millis(20);

/// A robot that is not one, and a session with it; it ends when this is dropped.
pub(crate) struct Nao {
    _child: StandIn,
    pub(crate) session: Session,
}

impl Nao {
    /// Starts one, unless there is no libqi, which is said by name as `part`.
    pub(crate) async fn start(part: &str, words: &[&str]) -> Option<Self> {
        let child = StandIn::start(part, words).unwrap()?;
        let address = format!("tcp://{}", child.address());
        let options = SessionOptions { stage_within: PATIENCE, call_within: PATIENCE, ..SessionOptions::default() };
        let session = Session::connect(&address.parse().unwrap(), options).await.unwrap();
        Some(Self { _child: child, session })
    }

    pub(crate) async fn service(&self, name: &str) -> Object {
        self.session.service(name).await.unwrap().within(PATIENCE)
    }

    /// Calls a method; text, numbers, truths and lists of JSON are its arguments.
    pub(crate) async fn try_call(&self, service: &str, method: &str, arguments: Json) -> Result<Value, QiError> {
        let arguments: Vec<Value> = arguments.as_array().unwrap().iter().map(value).collect();
        self.service(service).await.call(method, &arguments).await
    }

    pub(crate) async fn call(&self, service: &str, method: &str, arguments: Json) -> Value {
        self.try_call(service, method, arguments).await.unwrap()
    }

    /// Asks `StandIn` for something in JSON.
    pub(crate) async fn told(&self, method: &str) -> Json {
        serde_json::from_str(&self.call("StandIn", method, json!([])).await.as_text().unwrap()).unwrap()
    }

    pub(crate) async fn world(&self, change: Json) {
        self.call("StandIn", "world", json!([change.to_string()])).await;
    }

    pub(crate) async fn fault(&self, fault: Json) {
        self.call("StandIn", "fault", json!([fault.to_string()])).await;
    }

    /// Waits until the state is as wanted.
    pub(crate) async fn until(&self, what: &str, wanted: impl Fn(&Json) -> bool) -> Json {
        let waiting = async {
            loop {
                let state = self.told("state").await;
                if wanted(&state) {
                    return state;
                }
                tokio::time::sleep(PAUSE).await;
            }
        };
        tokio::time::timeout(PATIENCE, waiting).await.unwrap_or_else(|_| panic!("never: {what}"))
    }

    /// What is raised under a key from now on.
    pub(crate) async fn listen(&self, key: &str) -> Listening {
        let of = self.service("ALMemory").await.call_object("subscriber", &[key.into()]).await.unwrap();
        let events = of.subscribe("signal", EventChoice::All(64)).await.unwrap();
        Listening { _of: of, events }
    }

    /// Subscribes to an extractor, and gives the first value that it raises.
    pub(crate) async fn first(&self, service: &str, key: &str) -> Json {
        let mut events = self.listen(key).await;
        self.call(service, "subscribe", json!(["test", 20, 0.0])).await;
        let event = next(&mut events.events).await;
        self.call(service, "unsubscribe", json!(["test"])).await;
        event
    }
}

/// A key of the robot's memory that is listened to, for as long as its object is kept.
pub(crate) struct Listening {
    _of: Object,
    pub(crate) events: Subscription,
}

fn value(json: &Json) -> Value {
    match json {
        Json::String(text) => Value::from(text.as_str()),
        Json::Bool(truth) => Value::from(*truth),
        Json::Number(number) if number.is_i64() => Value::from(i32::try_from(number.as_i64().unwrap()).unwrap()),
        Json::Number(number) => Value::from(number.as_f64().unwrap()),
        Json::Array(items) => Value::List(items.iter().map(|item| Value::dynamic(value(item))).collect()),
        other => unreachable!("no argument: {other}"),
    }
}

/// A value with its dynamics opened, as JSON.
pub(crate) fn plain(value: &Value) -> Json {
    let value = value.seen();
    if let Some(items) = value.items() {
        return items.iter().map(plain).collect();
    }
    if let Value::F32(_) | Value::F64(_) = value {
        return value.as_f64().map_or(Json::Null, Json::from);
    }
    let number = || value.as_i64().map(Json::from);
    let text = || value.as_text().map(|text| Json::from(text.into_owned()));
    value.as_bool().map(Json::from).or_else(number).or_else(text).unwrap_or(Json::Null)
}

pub(crate) async fn next(events: &mut Subscription) -> Json {
    let event: SignalEvent = tokio::time::timeout(PATIENCE, events.next()).await.unwrap().unwrap();
    plain(&event.arguments[0])
}
