//! What the server says on standard error. A thread of its own writes it: if nobody reads (a full pipe, a terminal on
//! hold), lines are lost and counted, and nothing else notices.

use std::io::IsTerminal;
use std::time::Duration;
use tracing_appender::non_blocking::{ErrorCounter, NonBlockingBuilder, WorkerGuard};
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

/// What is logged when RRP_LOG does not say otherwise.
const LOG: LevelFilter = LevelFilter::INFO;
/// Lines that may wait to be written.
const WAITING_MAX_LINES: usize = 8_192;
/// How often it is told how many lines were lost.
const LOST_SECONDS: u64 = 10;

/// Writes what waits with its end, as far as somebody reads.
pub(crate) struct Log {
    _writing: WorkerGuard,
    lost: ErrorCounter,
}

/// Starts to log. Panics are logged as well, since standard error may take no more.
pub(crate) fn start() -> Log {
    let (to, writing) =
        NonBlockingBuilder::default().lossy(true).buffered_lines_limit(WAITING_MAX_LINES).finish(std::io::stderr());
    let lost = to.error_counter();
    let asked = std::env::var("RRP_LOG").ok().and_then(|words| words.parse::<Targets>().ok());
    let filter = asked.unwrap_or_else(|| Targets::new().with_default(LOG));
    let ansi = std::io::stderr().is_terminal();
    let lines = tracing_subscriber::fmt::layer().with_writer(to).with_ansi(ansi);
    tracing_subscriber::registry().with(filter).with(lines).init();
    std::panic::set_hook(Box::new(|panic| tracing::error!(%panic, "a thread panicked")));
    Log { _writing: writing, lost }
}

impl Log {
    /// Tells now and then how many lines were lost, if any were.
    pub(crate) async fn tell_losses(&self) {
        let (mut told, mut beat) = (0, tokio::time::interval(Duration::from_secs(LOST_SECONDS)));
        loop {
            beat.tick().await;
            let lost = self.lost.dropped_lines();
            if lost > told {
                tracing::warn!(lines = lost - told, "nobody read this log for a while, and lines of it were lost");
                told = lost;
            }
        }
    }
}
