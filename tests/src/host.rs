//! The proof to a server that a test is its host, over HTTP and in a browser.

use crate::{Outcome, Trouble};
use std::net::SocketAddr;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

/// A line of a request's head that shows it, with its end; empty where no server of ours is.
pub fn host_line(address: SocketAddr) -> String {
    let key = host_key::of_server(address).map(|key| host_key::header(&key));
    key.map(|key| format!("{}: {key}\r\n", host_key::HEADER)).unwrap_or_default()
}

/// Name and value of the cookie that a browser gets by the link of `rrp open`; none where no server of ours is.
pub(crate) async fn cookie(url: &str) -> Outcome<Option<(String, String)>> {
    let address = url.strip_prefix("http://").and_then(|rest| rest.split('/').next()?.parse().ok());
    let Some((address, line)) =
        address.map(|address| (address, host_line(address))).filter(|(_, line)| !line.is_empty())
    else {
        return Ok(None);
    };
    let made = post(address, "/api/host-link", &line, "").await?;
    let token = made.split_once('#').and_then(|(_, rest)| rest.split('"').next());
    let token = token.ok_or_else(|| Trouble(format!("There is no link: {made}")))?;
    let form = "Content-Type: application/x-www-form-urlencoded\r\n";
    let came = post(address, "/come-in", form, &format!("token={token}")).await?;
    let given = came.lines().find_map(|line| line.strip_prefix("set-cookie: "));
    let pair = given.and_then(|given| given.split(';').next()?.split_once('='));
    let (name, value) = pair.ok_or_else(|| Trouble(format!("There is no cookie: {came}")))?;
    Ok(Some((name.to_owned(), value.to_owned())))
}

async fn post(address: SocketAddr, path: &str, more: &str, body: &str) -> Outcome<String> {
    let mut stream = TcpStream::connect(address).await?;
    let head = format!("POST {path} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\n{more}");
    stream.write_all(format!("{head}Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes()).await?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).await?;
    Ok(answer)
}
