//! A peer that does what the real one does not: old, slow in bytes, lying, silent, talking garbage.

use std::sync::Arc;

use qi::{
    FRAME_MAX_BYTES, Framer, Layout, MessageFrame, MessageHeader, MessageKind, MetaMethod, MetaObject, MetaSignal,
    Value, ValueSignature,
};
use qi::{decode, encode};
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::net::TcpListener;
use tokio_rustls::TlsAcceptor;

/// The differences of a fake peer from a plain new one.
#[derive(Clone, Default)]
pub(crate) struct Manner {
    /// Speaks as NAOqi 2.1: a message with capabilities, no service 0, six fields.
    pub(crate) is_old: bool,
    /// Every byte in a packet of its own.
    pub(crate) is_slow: bool,
    /// The addresses that it tells for `Thing`; without any its own.
    pub(crate) endpoints: Vec<String>,
    /// The password of `nao`.
    pub(crate) password: Option<String>,
    /// Says nothing at all where its log in stops.
    pub(crate) is_silent: bool,
    /// Says this instead of anything of the protocol.
    pub(crate) garbage: Option<Vec<u8>>,
    /// Speaks TLS with this certificate and key.
    pub(crate) certificate: Option<(CertificateDer<'static>, Arc<Vec<u8>>)>,
}

/// Starts it; answers with `HOST:PORT`. It ends with the test's runtime.
pub(crate) async fn start(manner: Manner) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let at = listener.local_addr().unwrap().to_string();
    let own = format!("tcp://{at}");
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            stream.set_nodelay(true).unwrap();
            let (manner, own) = (manner.clone(), own.clone());
            tokio::spawn(async move {
                let Some((certificate, key)) = manner.certificate.clone() else {
                    return serve(stream, manner, own).await;
                };
                let key = PrivateKeyDer::try_from(key.to_vec()).unwrap();
                let provider = Arc::new(rustls::crypto::ring::default_provider());
                let config = rustls::ServerConfig::builder_with_provider(provider);
                let config = config.with_safe_default_protocol_versions().unwrap().with_no_client_auth();
                let config = config.with_single_cert(vec![certificate], key).unwrap();
                if let Ok(stream) = TlsAcceptor::from(Arc::new(config)).accept(stream).await {
                    serve(stream, manner, own).await;
                }
            });
        }
    });
    at
}

async fn serve(mut stream: impl AsyncRead + AsyncWrite + Unpin, manner: Manner, own: String) {
    let mut peer =
        Peer { manner, own, registered: Vec::new(), ever: 0, kept: Vec::new(), is_in: false, is_mute: false };
    if let Some(garbage) = peer.manner.garbage.clone() {
        stream.write_all(&garbage).await.unwrap();
    }
    if peer.manner.is_old {
        let said =
            encode(&Value::map([("MetaObjectCache", Value::dynamic(true))]), &signature("{sm}"), Layout::default());
        let header = MessageHeader { kind: MessageKind::Capability, flags: 0, id: 1, service: 0, object: 0, action: 0 };
        stream.write_all(&MessageFrame { header, payload: said.unwrap() }.to_bytes().unwrap()).await.unwrap();
    }
    let (mut framer, mut chunk) = (Framer::default(), vec![0; 4096]);
    loop {
        match stream.read(&mut chunk).await {
            Ok(read) if read > 0 => framer.feed(&chunk[..read]),
            _ => return,
        }
        while let Some(frame) = framer.next_frame().unwrap() {
            let mut out = Vec::new();
            peer.answer(frame, &mut out);
            let size = if peer.manner.is_slow { 1 } else { out.len().max(1) };
            for part in out.chunks(size) {
                if stream.write_all(part).await.is_err() {
                    return;
                }
                stream.flush().await.unwrap();
            }
        }
    }
}

pub(crate) fn signature(text: &str) -> ValueSignature {
    text.parse().unwrap()
}

struct Peer {
    manner: Manner,
    own: String,
    /// Signal and number of the client.
    registered: Vec<(u32, u64)>,
    ever: u32,
    /// Calls whose answers are late.
    kept: Vec<MessageHeader>,
    is_in: bool,
    is_mute: bool,
}

impl Peer {
    fn answer(&mut self, frame: MessageFrame, out: &mut Vec<u8>) {
        let MessageFrame { header, payload } = frame;
        if self.manner.is_silent || self.is_mute || !matches!(header.kind, MessageKind::Call | MessageKind::Post) {
            return;
        }
        let mut answers = Vec::new();
        let is_hello = (header.service, header.action) == (0, 8);
        let result = if is_hello {
            self.hello(&payload)
        } else if self.is_in || self.manner.is_old {
            self.call(header, &payload, &mut answers)
        } else {
            Err("could not be handled".to_owned())
        };
        let (kind, payload) = match result {
            Ok(Some(payload)) => (MessageKind::Reply, payload),
            Ok(None) => (MessageKind::Call, Vec::new()),
            Err(text) => (MessageKind::Error, written("m", &text.as_str().into())),
        };
        // Events come before the answer to what raised them, as from the real one.
        answers.iter().for_each(|bytes: &Vec<u8>| out.extend_from_slice(bytes));
        if header.kind == MessageKind::Call && kind != MessageKind::Call {
            out.extend(
                MessageFrame { header: MessageHeader { kind, flags: 0, ..header }, payload }.to_bytes().unwrap(),
            );
        }
    }

    fn hello(&mut self, payload: &[u8]) -> Result<Option<Vec<u8>>, String> {
        if self.manner.is_old {
            return Err("can't find service, address: 0".to_owned());
        }
        let asked = decode(payload, &signature("{sm}"), Layout::default()).unwrap();
        let given = asked.get("auth_token").and_then(|token| token.as_text().map(|token| token.into_owned()));
        if self.manner.password.is_some() && self.manner.password != given {
            return Err("User is not authorized".to_owned());
        }
        self.is_in = true;
        let can = [("RelativeEndpointURI", Value::dynamic(true)), ("__qi_auth_state", Value::dynamic(3_u32))];
        Ok(Some(written("{sm}", &Value::map(can))))
    }

    fn call(
        &mut self,
        header: MessageHeader,
        payload: &[u8],
        answers: &mut Vec<Vec<u8>>,
    ) -> Result<Option<Vec<u8>>, String> {
        let number = |at: usize| u32::from_le_bytes(payload[at..at + 4].try_into().unwrap());
        match (header.service, header.action) {
            (_, 0) => {
                self.ever += 1;
                self.registered.push((number(4), u64::from(number(8))));
                Ok(Some(written("L", &77_u64.into())))
            }
            (_, 1) => {
                self.registered.retain(|(_, link)| *link != u64::from(number(8)));
                Ok(Some(Vec::new()))
            }
            (1, 2) => Ok(Some(self.directory().encode().unwrap())),
            (5, 2) => Ok(Some(thing().encode().unwrap())),
            (1, 100) => {
                let name = decode(payload, &ValueSignature::Str, Layout::default()).unwrap();
                let id = match name.as_text().unwrap().as_ref() {
                    "ServiceDirectory" => 1,
                    "Thing" => 5,
                    other => return Err(format!("Cannot find service '{other}' in index")),
                };
                Ok(Some(written(self.info_type(), &self.info(&name.as_text().unwrap(), id))))
            }
            (1, 101) => {
                let all = Value::List(vec![self.info("ServiceDirectory", 1), self.info("Thing", 5)]);
                Ok(Some(written(&format!("[{}]", self.info_type()), &all)))
            }
            (1, 108) => Ok(Some(written("s", &"machine".into()))),
            (5, action) => self.thing(action, header, payload, answers),
            (service, action) => Err(format!("no {service}.{action}")),
        }
    }

    fn thing(
        &mut self,
        action: u32,
        header: MessageHeader,
        payload: &[u8],
        answers: &mut Vec<Vec<u8>>,
    ) -> Result<Option<Vec<u8>>, String> {
        match action {
            100 => {
                // Answers that are late come with the next one.
                for header in self.kept.drain(..) {
                    let late = MessageFrame {
                        header: MessageHeader { kind: MessageKind::Reply, ..header },
                        payload: written("m", &"late".into()),
                    };
                    answers.push(late.to_bytes().unwrap());
                }
                Ok(Some(payload.to_vec()))
            }
            101 => {
                self.kept.push(header);
                Ok(None)
            }
            102 => {
                let count = u32::from_le_bytes(payload[..4].try_into().unwrap());
                for number in 0..count {
                    for _ in self.registered.iter().filter(|(signal, _)| *signal == 110) {
                        // The number of the event is the one of the call: they collide freely.
                        let event = MessageHeader { kind: MessageKind::Event, action: 110, id: header.id, ..header };
                        let frame = MessageFrame { header: event, payload: number.to_le_bytes().to_vec() };
                        answers.push(frame.to_bytes().unwrap());
                    }
                }
                Ok(Some(Vec::new()))
            }
            103 => {
                self.is_mute = true;
                Ok(None)
            }
            104 => {
                answers.push(header.to_bytes(u32::try_from(FRAME_MAX_BYTES).unwrap() + 1).to_vec());
                Ok(None)
            }
            105 => {
                answers.push(vec![0xAA; 64]);
                Ok(None)
            }
            106 => {
                Ok(Some(written("(II)", &Value::Tuple(vec![self.ever.into(), (self.registered.len() as u32).into()]))))
            }
            107 => Ok(Some(vec![0xFF; 3])),
            108 => Err("Thing::fail\n\tnot today".to_owned()),
            _ => Err("no such method".to_owned()),
        }
    }

    fn info_type(&self) -> &'static str {
        if self.manner.is_old { "(sIsI[s]s)" } else { "(sIsI[s]ss)" }
    }

    fn info(&self, name: &str, id: u32) -> Value {
        let is_lied = id != 1 && !self.manner.endpoints.is_empty();
        let endpoints = if is_lied { self.manner.endpoints.clone() } else { vec![self.own.clone()] };
        let mut fields = vec![name.into(), id.into(), "machine".into(), 9.into(), endpoints.into(), "session".into()];
        if !self.manner.is_old {
            // Bytes, not UTF-8.
            fields.push(Value::Str(vec![0xFF; 20]));
        }
        Value::Tuple(fields)
    }

    fn directory(&self) -> MetaObject {
        let methods = vec![
            method(100, "service", "(s)", self.info_type()),
            method(101, "services", "()", &format!("[{}]", self.info_type())),
        ];
        let signals = vec![signal(106, "serviceAdded", "(Is)"), signal(107, "serviceRemoved", "(Is)")];
        MetaObject { methods, signals, ..MetaObject::default() }
    }
}

fn thing() -> MetaObject {
    let methods = vec![
        method(100, "echo", "(m)", "m"),
        method(101, "late", "()", "m"),
        method(102, "raise", "(I)", "v"),
        method(103, "mute", "()", "v"),
        method(104, "huge", "()", "v"),
        method(105, "garbage", "()", "v"),
        method(106, "registrations", "()", "(II)"),
        method(107, "short", "()", "[s]"),
        method(108, "fail", "()", "v"),
    ];
    MetaObject { methods, signals: vec![signal(110, "tick", "(I)")], ..MetaObject::default() }
}

fn method(uid: u32, name: &str, parameters: &str, returns: &str) -> MetaMethod {
    MetaMethod {
        uid,
        name: name.to_owned(),
        returns: signature(returns),
        parameters: signature(parameters),
        description: String::new(),
    }
}

fn signal(uid: u32, name: &str, text: &str) -> MetaSignal {
    MetaSignal { uid, name: name.to_owned(), signature: signature(text) }
}

fn written(text: &str, value: &Value) -> Vec<u8> {
    encode(value, &signature(text), Layout::default()).unwrap()
}
