//! `rrp export`: a behaviour with its helpers as a file to carry.

use crate::LineCommand;
use crate::failure::Failure;
use crate::link::LocalServer;
use crate::store_at::{StoreArgs, StoreWay, find, library, listed, run};
use behaviour::{Behaviour, BehaviourFile, Helper, Id};
use clap::{Args, ValueEnum};
use server::PageFiles;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use store::Store;

/// Writes a behaviour with the helpers it uses as a file, to standard output or --out.
///
/// Exit codes: 0 written; 1 there is no such behaviour, or the store or the file cannot be used.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp export \"Track far and close balls\" > tracking.json
  rrp export 3f2a9c --format svg --out tracking.svg --data /srv/rrp")]
pub(crate) struct ExportArgs {
    /// The behaviour's name or id.
    #[arg(value_name = "NAME-OR-ID")]
    behaviour: String,
    /// JSON and XML can be imported again; SVG is the drawing.
    #[arg(long, value_enum, default_value_t = Format::Json)]
    format: Format,
    /// The file to write instead of standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    at: StoreArgs,
}

impl LineCommand for ExportArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp export \"Track far and close balls\" --format xml --out tracking.xml"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(export(&self))
    }
}

/// The form of the file.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// rrp-behaviour/1, what rrp replay reads.
    Json,
    /// All that the JSON says, as XML.
    Xml,
    /// The drawing.
    Svg,
}

/// Exports, or says why not.
fn export(args: &ExportArgs) -> Result<(), Failure> {
    let text = run(async {
        match args.at.way().await? {
            StoreWay::Store(store) => {
                let id = find(&listed(&*store).await?, &args.behaviour)?;
                written(&file(&*store, &id).await?, args.format)
            }
            StoreWay::Server(link) => through(&link, args).await,
        }
    })?;
    match &args.out {
        Some(path) => std::fs::write(path, text).map_err(|error| Failure::unwritten(path, &error)),
        None => std::io::stdout().lock().write_all(text.as_bytes()).map_err(Failure::unwritten_out),
    }
}

fn written(file: &BehaviourFile, format: Format) -> Result<String, Failure> {
    match format {
        Format::Json => Ok(store::files::write_json(file)),
        Format::Xml => store::files::write_xml(file).map_err(Failure::of),
        Format::Svg => Ok(store::files::write_svg(file)),
    }
}

/// The file as the server gives it that has the store.
async fn through(link: &LocalServer, args: &ExportArgs) -> Result<String, Failure> {
    let listed = link.listed().await?;
    let ending = match args.format {
        Format::Json => "json",
        Format::Xml => "xml",
        Format::Svg => "svg",
    };
    let answer = link.get(&format!("/api/behaviours/{}.{ending}", find(&listed, &args.behaviour)?)).await?;
    let fine = answer.fine;
    let text = answer.text().await?;
    if fine { Ok(text) } else { Err(Failure::of(text.trim())) }
}

/// The file of a behaviour, with its id.
async fn file(store: &dyn Store, id: &Id) -> Result<BehaviourFile, Failure> {
    let library = library()?;
    let gone = || Failure::of("The behaviour is gone. Choose another one.");
    let behaviour = store.load(id).await?.ok_or_else(gone)?.behaviour;
    let library = store.load(&library).await?.map_or_else(Behaviour::default, |loaded| loaded.behaviour);
    let helpers: Vec<&Helper> = library.helpers().map(|(_, helper)| helper).collect();
    let mut file = BehaviourFile::of(&behaviour, &helpers);
    file.id = Some(id.to_string());
    Ok(file)
}
