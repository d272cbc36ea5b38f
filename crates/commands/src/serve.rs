//! `rrp serve`: the server in the foreground, until a signal or the end of its terminal.

use crate::LineCommand;
use crate::data_folder::{kept_in, store_url};
use crate::ending;
use crate::failure::Failure;
use crate::let_in::tell_host_link;
use crate::listening::{Listening, tell_invitation};
use crate::log::{self, Log};
use clap::Args;
use server::{Config, PageFiles, ReadyServer};
use std::io::{IsTerminal, StdoutLock, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// Files and connections that the server may have open, if the system allows it.
const FILES: u64 = 8_192;
/// Threads that may wait for the store's disk at once: four that read, and what is prepared for saving. All else that waits
/// for something has threads of its own.
const BLOCKING_THREADS: usize = 32;
/// How long what still works in the background may take at the end.
const ENDING_MS: u64 = 2_000;

/// Serves the page, the robot and the behaviours in a folder, on this computer, and to whom you invite.
///
/// You are its host: a link is printed on the terminal that opens the page in a browser of this computer, once; the
/// browser stays in. `rrp open` prints another one. Who else uses this computer, or comes through a proxy that was not
/// declared with --behind-proxy, can only press Stop.
///
/// With an address of this computer in the network in --listen, others come in by invitation: their browsers speak TLS,
/// and a link for the first of them is printed with its QR code. The page and `rrp invite` make more; the page lists and
/// revokes them. Links are printed on a terminal only, never into a journal.
///
/// Prints one line on standard output once it accepts connections; logs go to standard error (RRP_LOG=debug for more).
/// Ctrl-C, SIGTERM, SIGQUIT and the end of the terminal (a closed window, a lost SSH session: SIGHUP) stop the robots first,
/// then finish writing, then exit with 0. With `nohup` it outlives the terminal.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  rrp serve\n  rrp serve --listen 127.0.0.1:0 --data /tmp/play
  rrp serve --listen 192.168.1.5:7130            others come in by invitation, this computer by http://127.0.0.1:7130/
  rrp serve --listen 192.168.1.5:7130 --cert cert.pem --key key.pem
  rrp serve --listen 127.0.0.1:7131 --behind-proxy https://rrp.example
  rrp serve --store bolt://neo4j@127.0.0.1:7687 --data /srv/rrp")]
pub(crate) struct ServeArgs {
    #[command(flatten)]
    at: Listening,
    /// The folder of the data, recordings, robots and orders included; $XDG_DATA_HOME/rrp or ~/.local/share/rrp if absent.
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// The address of another store for the behaviours; --data then is the folder for all the rest. Without --data that
    /// is the folder of a sqlite: store, and for any other store one of its own in the usual folder, in stores/.
    #[arg(long, value_name = "URL", env = "RRP_STORE")]
    store: Option<String>,
    /// The seed of the simulated robot's noise.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
}

impl LineCommand for ServeArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "rrp serve                            serve on this computer, on http://127.0.0.1:7130/",
        "rrp serve --listen 127.0.0.1:0       on a free port",
    ];

    fn run(self, page: PageFiles) -> ExitCode {
        let log = log::start();
        more_files();
        crate::ended(serve(self, page, &log))
    }
}

/// Allows as many open files and connections as the system lets us have; often it is few at first.
#[cfg(unix)]
fn more_files() {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let Rlimit { current, maximum } = getrlimit(Resource::Nofile);
    let wanted = maximum.map_or(FILES, |most| most.min(FILES));
    if current.is_some_and(|now| now < wanted) {
        // Where it is refused the server does with less.
        let _ = setrlimit(Resource::Nofile, Rlimit { current: Some(wanted), maximum });
    }
}

#[cfg(not(unix))]
fn more_files() {}

fn serve(args: ServeArgs, page: PageFiles, log: &Log) -> Result<(), Failure> {
    let data = kept_in(args.store.as_deref(), args.data.as_deref())?;
    let store = store_url(args.store, args.data)?;
    let (listen, network) = args.at.ways()?;
    let config = Config { listen, network, store, data, seed: args.seed, page };
    let mut threads = tokio::runtime::Builder::new_multi_thread();
    threads.max_blocking_threads(BLOCKING_THREADS).enable_all();
    let not_started = |error| Failure::of(format!("The server could not start: {error}."));
    let runtime = threads.build().map_err(not_started)?;
    let served = runtime.block_on(async {
        let asked_to_end = ending::asked().map_err(not_started)?;
        tokio::select! {
            served = server::serve(config, ready, asked_to_end) => served.map_err(Failure::of),
            () = log.tell_losses() => Ok(()),
        }
    });
    runtime.shutdown_timeout(Duration::from_millis(ENDING_MS));
    served
}

/// What stands on standard output, for people and for programs that wait for its first line. A terminal on hold keeps only
/// the thread that writes it.
fn ready(now: ReadyServer) {
    let tell = move || {
        let mut out = std::io::stdout().lock();
        let said = writeln!(out, "rrp is ready: http://{}/", now.address).and_then(|()| out.flush());
        drop(said.and_then(|()| tell_links(&mut out, &now)).and_then(|()| out.flush()));
    };
    drop(std::thread::Builder::new().name("ready".into()).spawn(tell));
}

/// Says the links that let people in, on a terminal only: what is written into a journal or a file others may read for long.
fn tell_links(out: &mut StdoutLock, now: &ReadyServer) -> std::io::Result<()> {
    if !out.is_terminal() {
        tracing::info!("`rrp open` prints a link for a browser of this computer, `rrp invite` one for others");
        return Ok(());
    }
    now.host_link.as_ref().map_or(Ok(()), |link| tell_host_link(out, link))?;
    now.invited.as_ref().map_or(Ok(()), |invited| tell_invitation(out, invited))
}
