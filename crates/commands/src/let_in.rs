//! `rrp open` and `rrp invite`: links of a running server, for a browser of this computer and for others.

use crate::LineCommand;
use crate::data_folder::no_home;
use crate::failure::Failure;
use crate::link::{self, LocalServer};
use crate::listening::tell_invitation;
use crate::store_at::{StoreArgs, run};
use clap::{Args, ValueEnum};
use host_key::HostKey;
use protocol::{HOST_LINK_PATH, Lasts, Role, answer, request};
use serde::Deserialize;
use server::{InvitedFrom, PageFiles};
use shell::Client;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Prints a link that opens the page in a browser of this computer.
///
/// The link works once. The browser that opens it becomes the host's: it may do everything, stays in after restarts of
/// server and browser, and needs no link any more. Only the user who runs the server can make one.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp open                             the server on the usual folder
  rrp open --data /srv/rrp             that of another folder
  sudo -u rrp rrp open --data /srv/rrp that of another user, as which it runs")]
pub(crate) struct OpenArgs {
    #[command(flatten)]
    at: StoreArgs,
}

impl LineCommand for OpenArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp open                             a link that opens the page in another browser of this computer"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(open(&self))
    }
}

/// Makes an invitation for somebody elsewhere, and prints its link and QR code.
///
/// The server has to let others in: rrp serve --listen with an address in the network, or --behind-proxy. The page lists
/// the invitations and revokes them.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp invite                           one person, who may edit
  rrp invite --role viewer --lasts day --label \"Parents\"
  rrp invite --role operator --data /srv/rrp")]
pub(crate) struct InviteArgs {
    #[command(flatten)]
    at: StoreArgs,
    /// What who comes may do.
    #[arg(long, value_enum, default_value_t = InvitedRole::Editor)]
    role: InvitedRole,
    /// How long the link works, and who came by it stays in.
    #[arg(long, value_enum, default_value_t = HowLong::Once)]
    lasts: HowLong,
    /// For whom it is, as the page lists it.
    #[arg(long, value_name = "TEXT", default_value = "")]
    label: String,
}

impl LineCommand for InviteArgs {
    const EXAMPLES: &'static [&'static str] =
        &["rrp invite --role viewer             a link that lets somebody else look on"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(invite(self))
    }
}

/// What an invitation lets somebody do.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum InvitedRole {
    /// Look, and press Stop.
    Viewer,
    /// That, and press Start and move the room.
    Operator,
    /// That, and edit programs.
    Editor,
}

/// How long an invitation lasts.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum HowLong {
    /// The link works once, within a day; who came stays in until revoked.
    Once,
    /// The link works as often as it is opened, and all is over after a day.
    Day,
    /// The link works until it is revoked.
    UntilRevoked,
}

impl StoreArgs {
    /// The running server that uses the data folder, and what shows it that we are its host.
    fn server(&self) -> Result<HostKey, Failure> {
        let folder = self.folder().ok_or_else(no_home)?;
        host_key::in_folder(&folder).ok_or_else(|| no_server(&folder))
    }
}

fn no_server(folder: &Path) -> Failure {
    Failure::of(format!(
        "No rrp server of yours runs on {}. Start one with `rrp serve`, or say with --data DIR on which folder it runs.",
        folder.display()
    ))
}

/// Prints a link for a browser of this computer.
fn open(args: &OpenArgs) -> Result<(), Failure> {
    run(async {
        let answer = LocalServer { address: args.at.server()?.address }.post(HOST_LINK_PATH, Vec::new()).await?;
        let (fine, text) = (answer.fine, answer.text().await?);
        if !fine {
            return Err(Failure::of(text.trim()));
        }
        let made: InvitationAnswer = link::understood(&text)?;
        tell_host_link(&mut io::stdout().lock(), &made.link).map_err(Failure::of)
    })
}

/// What the server answers.
#[derive(Deserialize)]
struct InvitationAnswer {
    link: String,
}

/// Says by which link a browser of this computer becomes the host's.
pub(crate) fn tell_host_link(out: &mut impl Write, link: &str) -> io::Result<()> {
    writeln!(out, "Open it in a browser of this computer by this link, which works once:\n{link}")
}

/// Makes an invitation and prints it.
fn invite(args: InviteArgs) -> Result<(), Failure> {
    run(async {
        let client = Client::connect(&format!("http://{}/", args.at.server()?.address), "rrp invite").await;
        let client = client.map_err(Failure::of)?;
        let (role, lasts) = (args.role.into(), args.lasts.into());
        match client.ask(request::Invite { role, lasts, label: args.label }).await {
            Ok(answer::Invited { link, qr, fingerprint, .. }) => {
                let invited = InvitedFrom { role, lasts, link, qr, fingerprint };
                tell_invitation(&mut io::stdout().lock(), &invited).map_err(Failure::of)
            }
            Err(why) => Err(Failure::of(why)),
        }
    })
}

impl From<InvitedRole> for Role {
    fn from(role: InvitedRole) -> Self {
        match role {
            InvitedRole::Viewer => Self::Viewer,
            InvitedRole::Operator => Self::Operator,
            InvitedRole::Editor => Self::Editor,
        }
    }
}

impl From<HowLong> for Lasts {
    fn from(lasts: HowLong) -> Self {
        match lasts {
            HowLong::Once => Self::Once,
            HowLong::Day => Self::Day,
            HowLong::UntilRevoked => Self::UntilRevoked,
        }
    }
}
