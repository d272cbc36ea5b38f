//! `rrp load`: many people at once on a running server, what they wait for, and whether all see the same in the end.

use crate::LineCommand;
use ::load::{LoadPlan, Report, Wrong, run, tidy};
use clap::Args;
use server::PageFiles;
use shell::ClientError;
use std::io::Write;
use std::process::ExitCode;

/// The most clients; a server has places for a few more.
const CLIENTS_MAX: usize = 500;
/// The most behaviours.
const BEHAVIOURS_MAX: usize = 500;
/// The most edits of one client in a second, as a server takes no more.
const EDITS_MAX: f64 = 50.0;
/// The longest load, in seconds.
const SECONDS_MAX: u64 = 24 * 60 * 60;

/// Lets many people edit at once on a running server, and compares what each of them has in the end.
///
/// Makes behaviours of its own and puts them into the bin afterwards. Each client edits one note at a steady pace, and
/// times count from when an edit was due, so that a server that falls behind shows it. In the end all clients and
/// somebody who comes anew have to have the same, byte by byte, and every acknowledged edit exactly once.
///
/// Exit codes: 0 all is well; 1 something differs, was refused or lost, or there is no server.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp load --clients 25 --stalled 5 --edits 40 --kills 10 --seconds 60")]
pub(crate) struct LoadArgs {
    /// The server's address.
    #[arg(value_name = "URL", default_value = shell::DEFAULT_URL)]
    url: String,
    /// Clients that edit.
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = at_most::<CLIENTS_MAX>)]
    clients: usize,
    /// Behaviours among which they are spread.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = at_most::<BEHAVIOURS_MAX>)]
    behaviours: usize,
    /// Edits of each client a second, down to 0.1.
    #[arg(long, value_name = "N", default_value_t = 5.0, value_parser = pace)]
    edits: f64,
    /// Clients besides that read nothing of what they are told.
    #[arg(long, value_name = "N", default_value_t = 0)]
    stalled: usize,
    /// Links that end without a word, over the time.
    #[arg(long, value_name = "N", default_value_t = 0)]
    kills: usize,
    /// For how long.
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=SECONDS_MAX))]
    seconds: u64,
    /// What chance is made of.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Leaves the behaviours there.
    #[arg(long)]
    keep: bool,
}

impl LineCommand for LoadArgs {
    fn run(self, _: PageFiles) -> ExitCode {
        load(&self)
    }
}

fn at_most<const MOST: usize>(text: &str) -> Result<usize, String> {
    let known = text.parse().ok().filter(|number| (1..=MOST).contains(number));
    known.ok_or_else(|| format!("a number from 1 to {MOST} is needed"))
}

fn pace(text: &str) -> Result<f64, String> {
    let known = text.parse().ok().filter(|number| (0.1..=EDITS_MAX).contains(number));
    known.ok_or_else(|| format!("a number from 0.1 to {EDITS_MAX} is needed"))
}

impl LoadArgs {
    fn plan(&self) -> LoadPlan {
        let Self { clients, behaviours, stalled, kills, seconds, seed, .. } = *self;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0.1 to 50 each second")]
        let edits_per_10_s = (self.edits * 10.0).round() as u32;
        LoadPlan { clients, behaviours, edits_per_10_s, stalled, kills, seconds, seed }
    }
}

/// Loads, prints, and answers with the exit code.
fn load(args: &LoadArgs) -> ExitCode {
    let Ok(runtime) = tokio::runtime::Runtime::new() else { return ExitCode::FAILURE };
    let loaded = runtime.block_on(loaded(args));
    runtime.shutdown_background();
    match loaded {
        Ok(report) => {
            // Whoever reads may be gone, and that is no failure.
            let _ = writeln!(std::io::stdout(), "{report}");
            if report.wrong == Vec::<Wrong>::new() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(trouble) => {
            let _ = writeln!(std::io::stderr(), "{trouble}");
            ExitCode::FAILURE
        }
    }
}

async fn loaded(args: &LoadArgs) -> Result<Report, ClientError> {
    let report = run(&args.url, &args.plan()).await?;
    if !args.keep {
        tidy(&args.url, &report.known).await?;
    }
    Ok(report)
}
