//! Coming in, going, and what is left of it on the disk.

use super::{GuessSource, Identified, Invitations, Invited, LinkTarget, NotIn, Terms};
use crate::invitations::permissions::{AskedOperation, Route};
use protocol::{Lasts, Refused, Role, request};
use std::path::Path;
use std::sync::Arc;

fn opened(data: Option<&Path>) -> Arc<Invitations> {
    let all = Invitations::within(data);
    all.open(LinkTarget { origin: "https://10.0.0.1:7130".into(), fingerprint: None });
    all
}

fn invite(all: &Invitations, role: Role, lasts: Lasts) -> (Invited, String) {
    let invited = all.make(Terms { role, lasts, label: " for\u{202e} Ben ".into(), made_by: "Aiko".into() }).unwrap();
    let token = invited.link.strip_prefix("https://10.0.0.1:7130/come-in#").unwrap().to_owned();
    (invited, token)
}

fn here() -> GuessSource {
    GuessSource::of("10.0.0.2".parse().unwrap())
}

#[test]
fn a_restart_forgets_nobody_and_the_disk_gives_nothing_away() {
    let folder = tempfile::tempdir().unwrap();
    let all = opened(Some(folder.path()));
    let (invited, token) = invite(&all, Role::Editor, Lasts::UntilRevoked);
    let cookie = all.join(&token, here()).unwrap();
    assert_eq!(invited.invitation.label, "for Ben");
    let kept = std::fs::read_to_string(folder.path().join("rrp.invitations.json")).unwrap();
    assert!(!kept.contains(&token) && !kept.contains(&cookie), "{kept}");
    let again = opened(Some(folder.path()));
    assert_eq!(again.guest(&cookie).map(|guest| guest.role), Some(Role::Editor));
    assert!(again.join(&token, here()).is_ok_and(|another| another != cookie), "always a new cookie");
    all.revoke(&invited.invitation.id).unwrap();
    let again = opened(Some(folder.path()));
    assert!(again.guest(&cookie).is_none() && again.list()[0].revoked);
    assert_eq!(again.join(&token, here()), Err(NotIn::Unknown));
}

#[cfg(unix)]
#[test]
fn only_its_user_reads_the_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    invite(&opened(Some(folder.path())), Role::Viewer, Lasts::Day);
    let mode = std::fs::metadata(folder.path().join("rrp.invitations.json")).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
}

/// Puts a folder where a file is to be written, which then cannot be: what is there already can be written over.
fn fill(folder: &Path, file: &str) -> std::path::PathBuf {
    let path = folder.join(file);
    drop(std::fs::remove_file(&path));
    std::fs::create_dir(&path).unwrap();
    path
}

#[test]
fn a_disk_that_takes_nothing_new_lets_nobody_in_and_a_restart_lets_in_nobody_who_was_thrown_out() {
    let folder = tempfile::tempdir().unwrap();
    let all = opened(Some(folder.path()));
    let (invited, token) = invite(&all, Role::Editor, Lasts::UntilRevoked);
    let cookie = all.join(&token, here()).unwrap();
    let full = fill(folder.path(), "rrp.invitations.new");
    assert!(matches!(all.join(&token, here()), Err(NotIn::NotKept(_))));
    assert_eq!(all.revoke(&invited.invitation.id), Ok(()), "in the space that is kept for that");
    assert!(all.guest(&cookie).is_none() && !all.list()[0].unwritten);
    all.write_due();
    let again = opened(Some(folder.path()));
    assert!(again.guest(&cookie).is_none() && again.list()[0].revoked);
    assert_eq!(again.join(&token, here()), Err(NotIn::Unknown));
    std::fs::remove_dir(full).unwrap();
    again.write_due();
    std::fs::remove_file(folder.path().join("rrp.revoked.reserve")).unwrap();
    assert!(opened(Some(folder.path())).guest(&cookie).is_none(), "the book has it now");
}

#[test]
fn what_stands_nowhere_is_told_and_tried_again_until_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let all = opened(Some(folder.path()));
    let (invited, token) = invite(&all, Role::Editor, Lasts::UntilRevoked);
    let cookie = all.join(&token, here()).unwrap();
    let full = ["rrp.invitations.new", "rrp.revoked.reserve"].map(|file| fill(folder.path(), file));
    assert!(matches!(all.revoke(&invited.invitation.id), Err(Refused::InvitationsNotKept(_))));
    assert!(all.guest(&cookie).is_none() && all.list()[0].unwritten);
    all.write_due();
    assert!(all.list()[0].unwritten && *all.due.borrow(), "it goes on being tried");
    full.iter().for_each(|path| std::fs::remove_dir(path).unwrap());
    all.write_due();
    assert!(!all.list()[0].unwritten && !*all.due.borrow());
    assert!(opened(Some(folder.path())).guest(&cookie).is_none());
}

#[test]
fn revoking_waits_for_nobody_who_writes_and_is_not_lost_by_it() {
    let folder = tempfile::tempdir().unwrap();
    let all = opened(Some(folder.path()));
    let (invited, token) = invite(&all, Role::Editor, Lasts::UntilRevoked);
    let cookie = all.join(&token, here()).unwrap();
    // As if somebody wrote the book on a disk that takes very long.
    let written = all.change(|_| Ok(all.revoke(&invited.invitation.id)));
    assert_eq!(written, Ok(Ok(())));
    assert!(all.guest(&cookie).is_none() && all.list()[0].revoked, "what was being written says less");
    assert!(opened(Some(folder.path())).guest(&cookie).is_none(), "nor is it lost on the disk");
}

#[test]
fn a_name_is_known_at_once_and_written_later_with_others() {
    let folder = tempfile::tempdir().unwrap();
    let all = opened(Some(folder.path()));
    let (_, token) = invite(&all, Role::Viewer, Lasts::UntilRevoked);
    let guests = [(); 2].map(|()| all.guest(&all.join(&token, here()).unwrap()).unwrap());
    let kept = || std::fs::read_to_string(folder.path().join("rrp.invitations.json")).unwrap();
    let before = kept();
    let _here = all.arrive(&guests[0], "Ben");
    for turn in 0..1_000 {
        all.call(&guests[1], &format!("Chie {turn}"));
    }
    let names = |all: &Invitations| all.list()[0].came.iter().map(|came| came.name.clone()).collect::<Vec<_>>();
    assert_eq!((names(&all), kept()), (vec!["Chie 999".to_owned(), "Ben".to_owned()], before));
    all.write_due();
    assert_eq!(names(&opened(Some(folder.path()))), ["Chie 999", "Ben"]);
    assert!(all.names.lock().unwrap().is_empty() && names(&all) == ["Chie 999", "Ben"]);
}

#[test]
fn a_hundred_thousand_guesses_are_slowed_and_neither_who_is_in_nor_a_right_link_waits() {
    let all = opened(None);
    let (_, token) = invite(&all, Role::Viewer, Lasts::UntilRevoked);
    let cookie = all.join(&token, here()).unwrap();
    let mut told = 0;
    for guess in 0..100_000 {
        match all.join(&format!("guess {guess}"), here()) {
            Err(NotIn::Unknown) => told += 1,
            Err(NotIn::TooMany(seconds)) => assert!(seconds > 0),
            other => panic!("{other:?}"),
        }
        if guess % 1_000 == 0 {
            let entry = Identified::Guest(all.guest(&cookie).unwrap());
            assert_eq!(entry.may(AskedOperation::Http(Route::Stop)), Ok(()), "from the same place");
        }
    }
    assert!(told < 100, "{told}");
    assert!(all.join(&token, here()).is_ok(), "whatever others tried from the same place");
    let elsewhere = GuessSource::of("10.0.0.3".parse().unwrap());
    assert_eq!(all.join("a guess", elsewhere), Err(NotIn::Unknown), "another place is not slowed");
}

#[test]
fn a_link_that_ended_is_a_guess_like_any_other() {
    let all = opened(None);
    let (_, token) = invite(&all, Role::Viewer, Lasts::Once);
    all.join(&token, here()).unwrap();
    let (ended, revoked) = invite(&all, Role::Viewer, Lasts::UntilRevoked);
    all.revoke(&ended.invitation.id).unwrap();
    let tries = (0..40).map(|_| [all.join(&token, here()), all.join(&revoked, here())]);
    let told = tries.flatten().filter(|tried| *tried == Err(NotIn::Unknown)).count();
    assert!(told < 20, "{told}");
}

#[tokio::test]
async fn who_is_revoked_is_told_at_once_and_may_only_stop() {
    let all = opened(None);
    let (invited, token) = invite(&all, Role::Editor, Lasts::UntilRevoked);
    let guest = all.guest(&all.join(&token, here()).unwrap()).unwrap();
    let (entry, here) = (Identified::Guest(guest.clone()), all.arrive(&guest, "Ben"));
    assert_eq!(entry.may(AskedOperation::Socket(&request::Runs {}.into())), Ok(()));
    assert!(all.list()[0].came[0].here);
    all.revoke(&invited.invitation.id).unwrap();
    entry.until_over().await;
    assert_eq!(entry.may(AskedOperation::Socket(&request::Runs {}.into())), Err(Refused::NotInvited));
    assert_eq!(entry.may(AskedOperation::Socket(&request::Stop { behaviour: None, robot: None }.into())), Ok(()));
    drop(here);
    assert!(!all.list()[0].came[0].here);
}

#[test]
fn what_was_printed_at_a_start_and_not_used_is_void_after_the_next() {
    let all = opened(None);
    let [first, second] = [(); 2].map(|()| all.make_at_start().unwrap());
    let token = |invited: &Invited| invited.link.split_once('#').unwrap().1.to_owned();
    assert_eq!(all.join(&token(&first), here()), Err(NotIn::Unknown));
    let cookie = all.join(&token(&second), here()).unwrap();
    all.make_at_start().unwrap();
    assert!(all.guest(&cookie).is_some(), "who came by it stays");
    assert_eq!(all.list().len(), 2);
}

#[test]
fn nobody_invites_more_than_they_may_or_without_a_way() {
    let closed = Invitations::within(None);
    let terms = |role| Terms { role, lasts: Lasts::Day, label: String::new(), made_by: String::new() };
    assert_eq!(closed.make(terms(Role::Viewer)).err(), Some(Refused::NobodyComes));
    assert_eq!(opened(None).make(terms(Role::Host)).err(), Some(Refused::Role(Role::Host)));
}
