//! The way to a store through the running server that uses it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

/// How long to wait for the server to take the call.
const CONNECT_MS: u64 = 3_000;
/// How long the server may be silent.
const SILENT_MS: u64 = 60_000;
/// The longest head of an answer, in bytes.
const HEAD_MAX_BYTES: u64 = 64 << 10;

/// A running server on this computer.
pub(crate) struct Link {
    pub(crate) address: SocketAddr,
}

/// What the server said.
pub(crate) struct Answer {
    /// True if it did what was asked.
    pub(crate) fine: bool,
    body: BufReader<TcpStream>,
}

impl Answer {
    /// All of the text.
    pub(crate) fn text(mut self) -> Result<String, String> {
        let mut text = String::new();
        self.body.read_to_string(&mut text).map_err(|error| broken(&error))?;
        Ok(text)
    }

    /// All of it into a file.
    pub(crate) fn copy(mut self, to: &mut impl Write) -> Result<(), String> {
        std::io::copy(&mut self.body, to).map(drop).map_err(|error| broken(&error))
    }
}

impl Link {
    /// Asks for something.
    pub(crate) fn get(&self, path: &str) -> Result<Answer, String> {
        self.ask("GET", path, &[])
    }

    /// Sends something.
    pub(crate) fn post(&self, path: &str, body: &[u8]) -> Result<Answer, String> {
        self.ask("POST", path, body)
    }

    /// HTTP 1.0: the answer ends with the connection.
    fn ask(&self, method: &str, path: &str, body: &[u8]) -> Result<Answer, String> {
        let address = self.address;
        let gone =
            |error| format!("The rrp server at http://{address}/ does not answer ({error}). Look whether it runs.");
        let mut stream = TcpStream::connect_timeout(&address, Duration::from_millis(CONNECT_MS)).map_err(gone)?;
        stream.set_read_timeout(Some(Duration::from_millis(SILENT_MS))).map_err(gone)?;
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.0\r\nHost: {address}\r\nOrigin: http://{address}\r\nContent-Length: {length}\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(body)).map_err(gone)?;
        let mut body = BufReader::new(stream);
        let status = line(&mut body).map_err(gone)?;
        while !line(&mut body).map_err(gone)?.trim().is_empty() {}
        Ok(Answer { fine: status.split(' ').nth(1) == Some("200"), body })
    }
}

fn line(from: &mut BufReader<TcpStream>) -> std::io::Result<String> {
    let mut line = String::new();
    from.by_ref().take(HEAD_MAX_BYTES).read_line(&mut line)?;
    Ok(line)
}

fn broken(error: &std::io::Error) -> String {
    format!("The rrp server stopped in the middle of its answer ({error}). Try again.")
}
