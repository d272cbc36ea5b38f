//! Clients that open a behaviour and read nothing of what they are told, as a page does whose computer is too slow.

use behaviour::Id;
use futures_util::SinkExt;
use protocol::{Ask, VERSION, request};
use std::net::SocketAddr;
use std::time::Duration;
use tokio::net::TcpSocket;
use tokio_tungstenite::tungstenite::{Bytes, Message};

/// The bytes that wait in such a client's own computer: few, so that the server notices soon.
const BUFFER_BYTES: u32 = 16 << 10;
/// The time between its signs of life, by which it learns that it was cut off.
const SIGN_MS: u64 = 200;

type StallEnd = Box<dyn std::error::Error + Send + Sync>;

/// Stalls, comes again when it was cut off, and counts that, until it is dropped.
pub(crate) async fn stall(address: SocketAddr, behaviour: Id, count_cut: impl Fn()) {
    loop {
        if once(address, &behaviour).await.is_ok() {
            count_cut();
        }
        tokio::time::sleep(Duration::from_millis(SIGN_MS)).await;
    }
}

/// Stalls until it is cut off; an error means that it never came in.
async fn once(address: SocketAddr, behaviour: &Id) -> Result<(), StallEnd> {
    let socket = if address.is_ipv4() { TcpSocket::new_v4() } else { TcpSocket::new_v6() }?;
    socket.set_recv_buffer_size(BUFFER_BYTES)?;
    let stream = socket.connect(address).await?;
    let (mut socket, _) =
        tokio_tungstenite::client_async(shell::handshake(&address.to_string()).await?, stream).await?;
    let hello = request::Hello { version: VERSION, name: "Asleep".to_owned(), again: None };
    let open = request::Open { behaviour: behaviour.clone() };
    for ask in [Ask::new(1, hello), Ask::new(2, open)] {
        socket.send(Message::text(serde_json::to_string(&ask)?)).await?;
    }
    while socket.send(Message::Pong(Bytes::new())).await.is_ok() {
        tokio::time::sleep(Duration::from_millis(SIGN_MS)).await;
    }
    Ok(())
}
