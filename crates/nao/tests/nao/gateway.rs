//! The gateway that NAOqi has from 2.9 on: it speaks TLS, lets in by user and password, and leads to the robot behind
//! it.

use qi::{Framer, Layout, MessageFrame, MessageHeader, MessageKind, Value, ValueSignature, decode, encode};
use rustls::pki_types::PrivateKeyDer;
use std::sync::Arc;
use tokio::io::{AsyncReadExt, AsyncWriteExt, copy_bidirectional};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;

/// The password of the user `nao`.
pub(crate) const PASSWORD: &str = "hush";

/// A gateway; it ends with the test's runtime.
pub(crate) struct Gateway {
    /// Where it is: `127.0.0.1:PORT`.
    pub(crate) address: String,
    shows: watch::Sender<TlsAcceptor>,
}

impl Gateway {
    pub(crate) async fn before(peer: &str) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let shows = watch::Sender::new(acceptor());
        let (mut shown, peer) = (shows.subscribe(), peer.to_owned());
        tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let acceptor = shown.borrow_and_update().clone();
                let (peer, mut changed) = (peer.clone(), shown.clone());
                tokio::spawn(async move {
                    // With another certificate it has started anew.
                    tokio::select! {
                        () = lead(acceptor, client, &peer) => {}
                        _ = changed.changed() => {}
                    }
                });
            }
        });
        Self { address, shows }
    }

    /// It starts anew with another certificate.
    pub(crate) fn renew(&self) {
        self.shows.send_replace(acceptor());
    }
}

fn acceptor() -> TlsAcceptor {
    let key = rcgen::KeyPair::generate().unwrap();
    let certificate = rcgen::CertificateParams::new(vec!["nao".to_owned()]).unwrap().self_signed(&key).unwrap();
    let key = PrivateKeyDer::try_from(key.serialize_der()).unwrap();
    let config = rustls::ServerConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()));
    let config = config.with_safe_default_protocol_versions().unwrap().with_no_client_auth();
    TlsAcceptor::from(Arc::new(config.with_single_cert(vec![certificate.der().clone()], key).unwrap()))
}

/// Leads a client that is let in to the robot, which is told of no password.
async fn lead(acceptor: TlsAcceptor, client: TcpStream, peer: &str) {
    let Ok(mut client) = acceptor.accept(client).await else { return };
    let (mut framer, mut bytes) = (Framer::default(), vec![0; 4_096]);
    let hello = loop {
        match client.read(&mut bytes).await {
            Ok(read) if read > 0 => framer.feed(&bytes[..read]),
            _ => return,
        }
        if let Some(frame) = framer.next_frame().unwrap() {
            break frame;
        }
    };
    let asked = decode(&hello.payload, &"{sm}".parse().unwrap(), Layout::default()).unwrap();
    let said = |name: &str| asked.get(name).and_then(|value| value.as_text().map(|text| text.into_owned()));
    if (said("auth_user").as_deref(), said("auth_token").as_deref()) != (Some("nao"), Some(PASSWORD)) {
        let no = encode(&"User is not authorized".into(), &ValueSignature::Dynamic, Layout::default()).unwrap();
        let frame =
            MessageFrame { header: MessageHeader { kind: MessageKind::Error, flags: 0, ..hello.header }, payload: no };
        let _gone = client.write_all(&frame.to_bytes().unwrap()).await;
        let _gone = client.shutdown().await;
        return;
    }
    let Ok(mut robot) = TcpStream::connect(peer).await else { return };
    robot.set_nodelay(true).unwrap();
    let plain = asked
        .entries()
        .into_iter()
        .flatten()
        .filter(|(name, _)| !name.as_text().is_some_and(|name| name.starts_with("auth_")));
    let plain = Value::Map(plain.cloned().collect());
    let payload = encode(&plain, &"{sm}".parse().unwrap(), Layout::default()).unwrap();
    robot.write_all(&MessageFrame { header: hello.header, payload }.to_bytes().unwrap()).await.unwrap();
    let _over = copy_bidirectional(&mut client, &mut robot).await;
}

/// A robot as NAOqi up to 2.1 is one: it says what it can before it is asked, and knows no log in. Answers with its address.
pub(crate) async fn old(peer: &str) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let (address, peer) = (listener.local_addr().unwrap().to_string(), peer.to_owned());
    tokio::spawn(async move {
        while let Ok((client, _)) = listener.accept().await {
            let peer = peer.clone();
            tokio::spawn(async move { drop(lead_old(client, &peer).await) });
        }
    });
    address
}

async fn lead_old(mut client: TcpStream, peer: &str) -> std::io::Result<()> {
    let can = Value::map([("MetaObjectCache", Value::dynamic(false))]);
    let said = encode(&can, &"{sm}".parse().unwrap(), Layout::default()).unwrap();
    let header = MessageHeader { kind: MessageKind::Capability, flags: 0, id: 1, service: 0, object: 0, action: 0 };
    client.write_all(&MessageFrame { header, payload: said }.to_bytes().unwrap()).await?;
    let (mut framer, mut bytes) = (Framer::default(), vec![0; 65_536]);
    let mut robot = TcpStream::connect(peer).await?;
    robot.set_nodelay(true)?;
    // What libqi wants is said for the client, and its answer is not passed on.
    let hello = MessageHeader { kind: MessageKind::Call, flags: 0, id: 7, service: 0, object: 0, action: 8 };
    let nothing = encode(
        &Value::map([("ClientServerSocket", Value::dynamic(true))]),
        &"{sm}".parse().unwrap(),
        Layout::default(),
    );
    robot.write_all(&MessageFrame { header: hello, payload: nothing.unwrap() }.to_bytes().unwrap()).await?;
    let mut answers = Framer::default();
    while answers.next_frame().unwrap().is_none_or(|frame| frame.header.kind != MessageKind::Reply) {
        let read = robot.read(&mut bytes).await?;
        answers.feed(&bytes[..read]);
    }
    loop {
        while let Some(frame) = framer.next_frame().unwrap() {
            let MessageFrame { header, .. } = frame;
            if (header.kind, header.service, header.action) == (MessageKind::Call, 0, 8) {
                let no = encode(&"can't find service, address: 0".into(), &ValueSignature::Dynamic, Layout::default())
                    .unwrap();
                let frame = MessageFrame { header: MessageHeader { kind: MessageKind::Error, ..header }, payload: no };
                client.write_all(&frame.to_bytes().unwrap()).await?;
            } else if header.kind != MessageKind::Capability {
                robot.write_all(&frame.to_bytes().unwrap()).await?;
            }
        }
        let mut back = vec![0; 65_536];
        tokio::select! {
            read = client.read(&mut bytes) => match read? {
                0 => return Ok(()),
                read => framer.feed(&bytes[..read]),
            },
            read = robot.read(&mut back) => match read? {
                0 => return Ok(()),
                read => client.write_all(&back[..read]).await?,
            },
        }
    }
}
