//! Who was thrown out while the disk was full stays out after a restart: space for that is kept from the start.

use crate::shares::{Door, ORIGIN, door_of, invite};
use house::{Outcome, Server, skip};
use protocol::{Refused, Reply, Request, Role};
use shell::{Client, Trouble};
use std::path::{Path, PathBuf};
use std::process::Command;

const PART: &str = "a revocation on a full disk";
/// The file that fills the disk while it is there.
const MARK: &str = "full";

/// A command that starts the server on a disk that is full while [`MARK`] is in its folder.
fn server_on(folder: &Path) -> Outcome<PathBuf> {
    let (library, command) = (folder.join("disk_full.so"), folder.join("rrp-on-this-disk"));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("journeys/disk_full.c");
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).arg("-ldl").status()?;
    assert!(built.success(), "a C compiler that built the database builds this too");
    let (library, mark, rrp) = (library.display(), folder.join("data").join(MARK), house::optimised());
    let start = format!("LD_PRELOAD='{library}' RRP_FULL='{}' exec '{}' \"$@\"\n", mark.display(), rrp.display());
    std::fs::write(&command, format!("#!/bin/sh\n{start}"))?;
    assert!(Command::new("chmod").arg("+x").arg(&command).status()?.success());
    Ok(command)
}

#[test]
fn a_revocation_on_a_full_disk_holds_after_a_restart() -> Outcome<()> {
    if !skip::optimised(PART) || !skip::linux(PART) {
        return Ok(());
    }
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(revoked())
}

async fn revoked() -> Outcome<()> {
    let folder = house::folder()?;
    let data = folder.path().join("data");
    let words = ["--listen", "127.0.0.1:0", "--behind-proxy", ORIGIN];
    let mut server = Server::start_binary(&server_on(folder.path())?, &data, &words).await?;
    let host = Client::connect(&server.url(), "Host").await?;
    let (invitation, link) = invite(&host, Role::Viewer).await?;
    let guest = Door::by(door_of(&server, 0).await?, &link).await?;
    assert!(guest.get("/api/behaviours").await?.starts_with("HTTP/1.1 200"));

    std::fs::write(data.join(MARK), "")?;
    let more = Request::Invite { role: Role::Viewer, lasts: protocol::Lasts::Day, label: String::new() };
    let no = host.ask(more).await;
    assert!(matches!(no, Err(Trouble::No(Refused::InvitationsNotKept(_)))), "the disk is full: {no:?}");
    assert_eq!(host.ask(Request::Revoke { invitation: invitation.clone() }).await, Ok(Reply::Done));
    server.kill9().await?;
    server.restart().await?;
    let guest = Door { address: door_of(&server, 1).await?, ..guest };
    let answer = guest.get("/api/behaviours").await?;
    assert!(answer.starts_with("HTTP/1.1 401"), "thrown out, and in again: {answer}");
    let host = Client::connect(&server.url(), "Host").await?;
    let Reply::Invitations { invitations } = host.ask(Request::Invitations).await? else {
        return Err("No list.".into());
    };
    assert!(invitations.iter().any(|one| one.id == invitation && one.revoked && !one.unwritten));
    Ok(())
}
