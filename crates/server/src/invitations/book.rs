//! The invitations as they are kept: plain data and its rules, with the time handed in.

use super::Terms;
use crate::support::digest::Digest;
use behaviour::Id;
use protocol::{CAME_MAX, DAY_MS, INVITATIONS_MAX, Invitation, InvitedGuest, Lasts, Refused, Role};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Devices that may have come by one invitation; the one that came first gives way.
const PASSES_MAX: usize = 256;

/// What guests are called, by their cookies, and since when, in milliseconds since 1970.
pub(super) type GuestNames = HashMap<Digest, (String, u64)>;

/// All invitations, oldest first.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Book {
    kept: Vec<KeptInvitation>,
}

/// An invitation and what lets people in by it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct KeptInvitation {
    /// Without who came, which is told from the passes.
    invitation: Invitation,
    /// Of the token in its link, as long as that works.
    link: Option<Digest>,
    /// Of those who came, first one first.
    passes: Vec<Pass>,
}

/// A device that came by an invitation.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Pass {
    /// Of its cookie.
    cookie: Digest,
    name: String,
    at_ms: u64,
}

/// What a new invitation is made of, besides its terms.
pub(super) struct InvitationSeed {
    pub(super) id: Id,
    pub(super) now_ms: u64,
    /// Of the token in its link.
    pub(super) link: Digest,
}

impl Book {
    pub(super) fn make(&mut self, made: InvitationSeed, terms: Terms) -> Result<Invitation, Refused> {
        let InvitationSeed { id, now_ms, link } = made;
        if self.kept.len() >= INVITATIONS_MAX {
            let ended = self.kept.iter().position(|kept| kept.is_over(now_ms)).ok_or(Refused::TooManyInvitations)?;
            self.kept.remove(ended);
        }
        let Terms { role, lasts, label, made_by } = terms;
        let ends_ms = (lasts != Lasts::UntilRevoked).then_some(now_ms.saturating_add(DAY_MS));
        let (came, revoked) = (Vec::new(), false);
        let unwritten = false;
        let invitation =
            Invitation { id, role, lasts, label, made_by, made_ms: now_ms, ends_ms, came, revoked, unwritten };
        self.kept.push(KeptInvitation { invitation: invitation.clone(), link: Some(link), passes: Vec::new() });
        Ok(invitation)
    }

    /// Drops those of this maker that nobody used.
    pub(super) fn forget_unused(&mut self, made_by: &str) {
        self.kept.retain(|kept| kept.invitation.made_by != made_by || kept.link.is_none());
    }

    /// Somebody comes by a link and is given this cookie; says by which invitation.
    pub(super) fn come(&mut self, link: &Digest, cookie: Digest, now_ms: u64) -> Option<Id> {
        let kept = self.kept.iter_mut().find(|kept| kept.link == Some(*link))?;
        if kept.is_over(now_ms) {
            return None;
        }
        if kept.invitation.lasts == Lasts::Once {
            (kept.link, kept.invitation.ends_ms) = (None, None);
        }
        if kept.passes.len() >= PASSES_MAX {
            kept.passes.remove(0);
        }
        kept.passes.push(Pass { cookie, name: String::new(), at_ms: now_ms });
        Some(kept.invitation.id.clone())
    }

    /// Ends one; says whether it was there. Who came stays in the list.
    pub(super) fn revoke(&mut self, invitation: &Id) -> bool {
        let Some(kept) = self.kept.iter_mut().find(|kept| kept.invitation.id == *invitation) else { return false };
        (kept.invitation.revoked, kept.link) = (true, None);
        true
    }

    /// Whether this one is revoked, or not there any more.
    pub(super) fn has_revoked(&self, invitation: &Id) -> bool {
        self.kept.iter().all(|kept| kept.invitation.id != *invitation || kept.invitation.revoked)
    }

    /// What who has this cookie is called; empty if they never said so.
    pub(super) fn name_of(&self, cookie: &Digest) -> &str {
        let mut passes = self.kept.iter().flat_map(|kept| &kept.passes);
        passes.find(|pass| pass.cookie == *cookie).map_or("", |pass| &pass.name)
    }

    /// Those of another book that are revoked there and not here.
    pub(super) fn revoked(&self, there: &Self) -> Vec<Id> {
        let revoked = there.kept.iter().filter(|kept| kept.invitation.revoked).map(|kept| &kept.invitation.id);
        revoked.filter(|id| !self.has_revoked(id)).cloned().collect()
    }

    pub(super) fn is_named(&self, invitation: &Id, cookie: &Digest, name: &str) -> bool {
        let kept = self.kept.iter().filter(|kept| kept.invitation.id == *invitation);
        kept.flat_map(|kept| &kept.passes).any(|pass| pass.cookie == *cookie && pass.name == name)
    }

    /// Puts down what guests are called.
    pub(super) fn name(&mut self, names: &GuestNames) {
        for pass in self.kept.iter_mut().flat_map(|kept| &mut kept.passes) {
            if let Some((name, at_ms)) = names.get(&pass.cookie) {
                name.clone_into(&mut pass.name);
                pass.at_ms = *at_ms;
            }
        }
    }

    /// What may be told, newest first, with what is known of names besides.
    pub(super) fn list(&self, names: &GuestNames, is_here: impl Fn(&Digest) -> bool) -> Vec<Invitation> {
        let told = |kept: &KeptInvitation| {
            let came = kept.passes.iter().rev().take(CAME_MAX).map(|pass| {
                let (name, at_ms) = names.get(&pass.cookie).cloned().unwrap_or_else(|| (pass.name.clone(), pass.at_ms));
                InvitedGuest { name, at_ms, here: is_here(&pass.cookie) }
            });
            Invitation { came: came.collect(), ..kept.invitation.clone() }
        };
        self.kept.iter().rev().map(told).collect()
    }
}

impl KeptInvitation {
    fn is_over(&self, now_ms: u64) -> bool {
        self.invitation.revoked || self.invitation.ends_ms.is_some_and(|ends_ms| ends_ms <= now_ms)
    }
}

/// The book with its secrets by their digests.
pub(super) struct Indexed {
    pub(super) book: Book,
    /// Links that may work, with the place of their invitation.
    links: HashMap<Digest, usize>,
    passes: HashMap<Digest, usize>,
}

impl Indexed {
    pub(super) fn of(book: Book) -> Self {
        let at = |(at, kept): (usize, &KeptInvitation)| kept.link.map(|link| (link, at));
        let links = book.kept.iter().enumerate().filter_map(at).collect();
        let open = book.kept.iter().enumerate().filter(|(_, kept)| !kept.invitation.revoked);
        let passes = open.flat_map(|(at, kept)| kept.passes.iter().map(move |pass| (pass.cookie, at))).collect();
        Self { book, links, passes }
    }

    /// Whether somebody can come in by this link.
    pub(super) fn is_open(&self, link: &Digest, now_ms: u64) -> bool {
        self.open(link, now_ms).is_some()
    }

    /// Who made an open link, and what for.
    pub(super) fn promise(&self, link: &Digest, now_ms: u64) -> Option<(String, Role)> {
        self.open(link, now_ms).map(|invitation| (invitation.made_by.clone(), invitation.role))
    }

    fn open(&self, link: &Digest, now_ms: u64) -> Option<&Invitation> {
        let kept = &self.book.kept[*self.links.get(link)?];
        (!kept.is_over(now_ms)).then_some(&kept.invitation)
    }

    /// By which invitation somebody with this cookie is in, as what, and until when.
    pub(super) fn guest(&self, cookie: &Digest, now_ms: u64) -> Option<(Id, Role, Option<u64>)> {
        let kept = &self.book.kept[*self.passes.get(cookie)?];
        let Invitation { id, role, ends_ms, .. } = &kept.invitation;
        (!kept.is_over(now_ms)).then(|| (id.clone(), *role, *ends_ms))
    }
}

#[cfg(test)]
mod tests {
    use super::{Book, DAY_MS, Digest, GuestNames, Indexed, InvitationSeed, PASSES_MAX, Terms};
    use behaviour::Id;
    use protocol::{INVITATIONS_MAX, Lasts, Refused, Role};

    fn made(book: &mut Book, name: &str, lasts: Lasts, now_ms: u64) -> Result<Id, Refused> {
        let made = InvitationSeed { id: Id::new(name).unwrap(), now_ms, link: Digest::of(name) };
        let terms = Terms { role: Role::Viewer, lasts, label: String::new(), made_by: "Aiko".into() };
        book.make(made, terms).map(|invitation| invitation.id)
    }

    fn is_in(book: &Book, cookie: &str, now_ms: u64) -> bool {
        Indexed::of(book.clone()).guest(&Digest::of(cookie), now_ms).is_some()
    }

    #[test]
    fn a_link_for_one_works_once_within_a_day_and_its_cookie_until_revoked() {
        let mut book = Book::default();
        let id = made(&mut book, "one", Lasts::Once, 0).unwrap();
        assert_eq!(book.clone().come(&Digest::of("one"), Digest::of("late"), DAY_MS), None, "a day is over");
        assert_eq!(book.come(&Digest::of("one"), Digest::of("a"), DAY_MS - 1), Some(id.clone()));
        assert_eq!(book.come(&Digest::of("one"), Digest::of("b"), DAY_MS - 1), None, "it was used");
        assert!(is_in(&book, "a", 100 * DAY_MS) && !is_in(&book, "b", 1));
        assert!(book.revoke(&id) && !is_in(&book, "a", 1));
    }

    #[test]
    fn a_day_is_over_for_all_who_came() {
        let mut book = Book::default();
        let id = made(&mut book, "day", Lasts::Day, 7).unwrap();
        for cookie in ["a", "b"] {
            assert_eq!(book.come(&Digest::of("day"), Digest::of(cookie), 8), Some(id.clone()));
            assert_eq!((is_in(&book, cookie, DAY_MS + 6), is_in(&book, cookie, DAY_MS + 7)), (true, false));
        }
    }

    #[test]
    fn what_is_kept_lets_nobody_in_by_itself_and_says_the_same_after_a_restart() {
        let mut book = Book::default();
        made(&mut book, "link-secret", Lasts::UntilRevoked, 0).unwrap();
        book.come(&Digest::of("link-secret"), Digest::of("cookie-secret"), 1);
        book.name(&[(Digest::of("cookie-secret"), ("Ben".to_owned(), 2))].into());
        let text = serde_json::to_string(&book).unwrap().replace("\"id\":\"link-secret\"", "");
        assert!(!text.contains("link-secret") && !text.contains("cookie-secret"), "{text}");
        let read: Book = serde_json::from_str(&serde_json::to_string(&book).unwrap()).unwrap();
        assert!(is_in(&read, "cookie-secret", 5));
        assert_eq!(read.list(&GuestNames::new(), |_| true), book.list(&GuestNames::new(), |_| true));
        assert_eq!(read.list(&GuestNames::new(), |_| true)[0].came[0].name, "Ben");
    }

    #[test]
    fn all_of_it_is_bounded() {
        let mut book = Book::default();
        for number in 0..INVITATIONS_MAX {
            made(&mut book, &format!("i{number}"), Lasts::UntilRevoked, 0).unwrap();
        }
        assert_eq!(made(&mut book, "more", Lasts::Day, 1), Err(Refused::TooManyInvitations));
        assert!(book.revoke(&Id::new("i5").unwrap()));
        made(&mut book, "more", Lasts::Day, 1).unwrap();
        assert_eq!(book.list(&GuestNames::new(), |_| false).len(), INVITATIONS_MAX);
        for number in 0..=PASSES_MAX {
            book.come(&Digest::of("more"), Digest::of(&number.to_string()), 2).unwrap();
        }
        assert!(!is_in(&book, "0", 3) && is_in(&book, "1", 3), "the first gives way");
    }
}
