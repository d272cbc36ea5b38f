//! Who was thrown out while the disk was full stays out after a restart: space for that is kept from the start.

use crate::shares::{Door, ORIGIN, door_of, invite};
use house::{DISK_IS_FULL, Outcome, Server, skip};
use protocol::{Refused, Role, request};
use shell::{Client, ClientError};

const PART: &str = "a revocation on a full disk";

#[test]
fn a_revocation_on_a_full_disk_holds_after_a_restart() -> Outcome<()> {
    skip::unless!(optimised(PART));
    skip::unless!(linux(PART));
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(revoked())
}

async fn revoked() -> Outcome<()> {
    let folder = house::folder()?;
    let data = folder.path().join("data");
    let words = ["--listen", "127.0.0.1:0", "--behind-proxy", ORIGIN];
    let mut server =
        Server::start_binary(&house::on_a_disk(folder.path(), &house::optimised())?, &data, &words).await?;
    let host = Client::connect(&server.url(), "Host").await?;
    let (invitation, link) = invite(&host, Role::Viewer).await?;
    let guest = Door::by(door_of(&server, 0).await?, &link).await?;
    assert!(guest.get("/api/behaviours").await?.starts_with("HTTP/1.1 200"));

    std::fs::write(data.join(DISK_IS_FULL), "")?;
    let more = request::Invite { role: Role::Viewer, lasts: protocol::Lasts::Day, label: String::new() };
    let no = host.ask(more).await;
    assert!(matches!(no, Err(ClientError::No(Refused::InvitationsNotKept(_)))), "the disk is full: {no:?}");
    assert_eq!(host.ask(request::Revoke { invitation: invitation.clone() }).await, Ok(()));
    server.kill9().await?;
    server.restart().await?;
    let guest = Door { address: door_of(&server, 1).await?, ..guest };
    let answer = guest.get("/api/behaviours").await?;
    assert!(answer.starts_with("HTTP/1.1 401"), "thrown out, and in again: {answer}");
    let host = Client::connect(&server.url(), "Host").await?;
    let invitations = host.ask(request::Invitations {}).await?.invitations;
    assert!(invitations.iter().any(|one| one.id == invitation && one.revoked && !one.unwritten));
    Ok(())
}
