//! A server whose log goes into a pipe that nobody reads.

use crate::stops;
use crate::target::Target;
use house::Outcome;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Requests that are logged: their lines are several times what a pipe takes.
const LOGGED: usize = 3_000;
/// Stops by each way.
const STOPS: usize = 100;
/// How long ending may take.
const PATIENCE: Duration = Duration::from_secs(30);

pub(crate) async fn unread() -> Outcome<()> {
    let folder = house::folder()?;
    let mut child = Command::new(house::optimised())
        .args(["serve", "--listen", "127.0.0.1:0", "--data"])
        .arg(folder.path())
        .env("RRP_LOG", "debug")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let tried = try_it(&mut child);
    drop(child.kill());
    tried
}

fn try_it(child: &mut Child) -> Outcome<()> {
    let mut line = String::new();
    BufReader::new(child.stdout.take().ok_or("no standard output")?).read_line(&mut line)?;
    let address: SocketAddr = line.trim().trim_start_matches("rrp is ready: http://").trim_end_matches('/').parse()?;
    for _ in 0..LOGGED {
        ask(address, "GET / HTTP/1.1\r\nOrigin: http://evil.example\r\n")?;
    }
    let measured = stops::measure(&Target::at(address, child.id()), STOPS)?;
    println!("A log that nobody reads: {measured}");
    if !ask(address, "GET /healthz HTTP/1.1\r\n")?.starts_with("HTTP/1.1 200") {
        return Err("The server is not healthy.".into());
    }
    for spread in measured.each() {
        if spread.worst > crate::STOP_WORST_MS * 4 {
            return Err(format!("A Stop took {} ms.", spread.worst).into());
        }
    }
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status()?;
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        if let Some(status) = child.try_wait()? {
            return if status.success() { Ok(()) } else { Err(format!("It ended with {status}.").into()) };
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    Err("SIGTERM did not end it.".into())
}

fn ask(address: SocketAddr, begin: &str) -> Outcome<String> {
    let mut stream = TcpStream::connect(address)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    write!(stream, "{begin}Host: {address}\r\n\r\n")?;
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer)?;
    Ok(String::from_utf8_lossy(&answer).into_owned())
}
