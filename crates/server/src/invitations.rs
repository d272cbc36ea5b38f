//! Letting others in: invitations, who came by them, and what each of them may do. Nothing here reads a file or waits on
//! the way of a Stop: what is asked there is looked up in memory. Who is revoked may press Stop
//! until their socket is closed.

mod book;
mod entry;
mod guesses;
mod guest;
mod host;
mod keeping;
mod permissions;
mod qr;
mod reserve;
mod secret;

pub(crate) use entry::Identified;
pub(crate) use guesses::GuessSource;
pub(crate) use guest::{Guest, GuestPresence};
pub(crate) use host::HostAccess;
pub(crate) use keeping::keep;
pub(crate) use permissions::{AskedOperation, Route};

use crate::support::digest::Digest;
use crate::support::{atomic_file, lock, now_ms};
use behaviour::{Id, without_unseen};
use book::{Book, GuestNames, Indexed, InvitationSeed};
use guesses::Guesses;
use guest::Live;
use phrase::{Phrase, Phrased};
use protocol::{Invitation, JOIN_PATH, LABEL_MAX_CHARS, Lasts, Refused, Role};
use reserve::Reserve;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Instant;
use tokio::sync::watch;
use uuid::Uuid;

/// The file of the invitations in the data folder.
const FILE: &str = "rrp.invitations.json";
/// Stands for the name of who never said one.
pub(crate) const SOMEBODY: &str = "Somebody";
/// Who makes the invitation that is printed at each start.
const AT_START: &str = "rrp serve";
/// What else there is to say if there is no disk to keep it on.
const NO_RANDOM: &str = "this computer gives no random numbers";

/// All invitations.
pub(crate) struct Invitations {
    file: Option<PathBuf>,
    way: OnceLock<LinkTarget>,
    /// Held while the book is written: one writer at a time. Revoking does not wait for it.
    writing: Mutex<()>,
    /// Held while what holds is put in the place of what held, for no longer.
    replacing: Mutex<()>,
    /// What guests are called, as far as the book does not say it yet.
    names: Mutex<GuestNames>,
    /// What is revoked, as far as the book on the disk does not say it yet.
    reserve: Mutex<Reserve>,
    /// Whether the book says less than it should.
    due: watch::Sender<bool>,
    /// What holds, for those who only look.
    book: watch::Sender<Arc<Indexed>>,
    live: Mutex<Live>,
    guesses: Mutex<Guesses>,
    /// When the clock of the guesses was 0.
    began: Instant,
    /// New whenever the list is another.
    told: watch::Sender<Arc<()>>,
}

/// Where links lead.
#[derive(Clone, Debug)]
pub(crate) struct LinkTarget {
    /// `https://192.168.1.5:7130`.
    pub(crate) origin: String,
    /// The fingerprint of the certificate, if the server made it.
    pub(crate) fingerprint: Option<String>,
}

/// An invitation with what is told of it once.
#[derive(Clone, Debug)]
pub(crate) struct Invited {
    /// The invitation.
    pub(crate) invitation: Invitation,
    /// Its link.
    pub(crate) link: String,
    /// That as a QR code.
    pub(crate) qr: Vec<String>,
    /// The fingerprint of the certificate, if the server made it.
    pub(crate) fingerprint: Option<String>,
}

/// What an invitation shall be like.
#[derive(Clone, Debug)]
pub(crate) struct Terms {
    /// What who comes may do.
    pub(crate) role: Role,
    /// How long.
    pub(crate) lasts: Lasts,
    /// For whom.
    pub(crate) label: String,
    /// The name of who makes it.
    pub(crate) made_by: String,
}

/// Why somebody did not come in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NotIn {
    /// The link does not work, or not any more.
    Unknown,
    /// Too many links that do not work came from there; with the seconds to wait.
    TooMany(u64),
    /// It could not be kept; with the reason.
    NotKept(Phrase),
}

impl Invitations {
    /// Those of a data folder; without one they last as long as the server.
    pub(crate) fn within(data: Option<&Path>) -> Arc<Self> {
        let file = data.map(|data| data.join(FILE));
        let mut book: Book = file.as_deref().and_then(atomic_file::read).unwrap_or_default();
        let reserve = Reserve::within(data);
        let revoked = reserve.noted().iter().filter(|invitation| book.revoke(invitation)).count();
        Arc::new(Self {
            file,
            way: OnceLock::new(),
            writing: Mutex::default(),
            replacing: Mutex::default(),
            names: Mutex::default(),
            reserve: Mutex::new(reserve),
            due: watch::Sender::new(revoked > 0),
            book: watch::Sender::new(Arc::new(Indexed::of(book))),
            live: Mutex::default(),
            guesses: Mutex::default(),
            began: Instant::now(),
            told: watch::Sender::default(),
        })
    }

    /// From now on others can come in by this way.
    pub(crate) fn open(&self, way: LinkTarget) {
        let _once = self.way.set(way);
    }

    /// Whether others can come in at all.
    pub(crate) fn lets_in(&self) -> bool {
        self.way.get().is_some()
    }

    /// Tells when the list changed.
    pub(crate) fn told(&self) -> watch::Receiver<Arc<()>> {
        self.told.subscribe()
    }

    /// All of them, newest first.
    pub(crate) fn list(&self) -> Vec<Invitation> {
        let mut list = {
            let (names, live) = (lock(&self.names), lock(&self.live));
            self.book.borrow().book.list(&names, |pass| live.is_here(pass))
        };
        let reserve = lock(&self.reserve);
        list.iter_mut().for_each(|one| one.unwritten = reserve.is_unwritten(&one.id));
        list
    }

    /// Makes one. Waits for the disk.
    ///
    /// # Errors
    /// If nobody can come in, there are too many, or it cannot be kept.
    pub(crate) fn make(&self, terms: Terms) -> Result<Invited, Refused> {
        self.make_after(terms, |_| {})
    }

    /// The one that is printed when the server starts; that of an earlier start which nobody used is void.
    ///
    /// # Errors
    /// As [`Self::make`].
    pub(crate) fn make_at_start(&self) -> Result<Invited, Refused> {
        let (role, lasts, made_by) = (Role::Editor, Lasts::Once, AT_START.to_owned());
        self.make_after(Terms { role, lasts, label: String::new(), made_by }, |book| book.forget_unused(AT_START))
    }

    fn make_after(&self, terms: Terms, first: impl FnOnce(&mut Book)) -> Result<Invited, Refused> {
        let way = self.way.get().ok_or(Refused::NobodyComes)?;
        if terms.role == Role::Host {
            return Err(Refused::Role(Role::Host));
        }
        let token = secret::random().ok_or_else(|| Refused::InvitationsNotKept(NO_RANDOM.into()))?;
        let label = without_unseen(&terms.label).trim().chars().take(LABEL_MAX_CHARS).collect();
        let made = InvitationSeed { id: Id::from_uuid(Uuid::new_v4()), now_ms: now_ms(), link: Digest::of(&token) };
        let invitation = self.change(|book| {
            first(book);
            book.make(made, Terms { label, ..terms })
        })?;
        let link = format!("{}{JOIN_PATH}#{token}", way.origin);
        let (qr, fingerprint) = (qr::rows(&link), way.fingerprint.clone());
        tracing::info!(invitation = %invitation.id, role = ?invitation.role, "somebody is invited");
        Ok(Invited { invitation, link, qr, fingerprint })
    }

    /// Ends one: its links and cookies are dead and everyone by it is told to go before anything is written. Waits for the
    /// disk, but for nothing else that is written there.
    ///
    /// # Errors
    /// If there is none, or this cannot be written; then it holds as long as the server, and it is tried again.
    pub(crate) fn revoke(&self, invitation: &Id) -> Result<(), Refused> {
        self.replace(|book| book.revoke(invitation).then_some(())).ok_or(Refused::NoInvitation)?;
        lock(&self.live).end(invitation);
        let noted = lock(&self.reserve).note(invitation);
        self.due.send_replace(true);
        self.tell();
        tracing::info!(%invitation, kept = noted.is_ok(), "an invitation is revoked");
        noted.map_err(|error| Refused::InvitationsNotKept(error.to_string().into()))
    }

    /// Exchanges the token of a link for that of a cookie, always a new one. Waits for the disk. A link that works is never
    /// refused for what others tried: it is looked up first, which costs no more than refusing, and nobody guesses 256 bits.
    ///
    /// # Errors
    /// If it lets nobody in; then also if too many such links came from there.
    pub(crate) fn join(&self, token: &str, from: GuessSource) -> Result<String, NotIn> {
        let link = Digest::of(token);
        if !self.book.borrow().is_open(&link, now_ms()) {
            return Err(self.guessed(from));
        }
        let cookie = secret::random().ok_or_else(|| NotIn::NotKept(NO_RANDOM.into()))?;
        // Somebody else may have used it since.
        let came = self.change(|book| book.come(&link, Digest::of(&cookie), now_ms()).ok_or(Refused::NoInvitation));
        match came {
            Ok(invitation) => {
                tracing::info!(%invitation, "somebody comes in by an invitation");
                Ok(cookie)
            }
            Err(Refused::InvitationsNotKept(why)) => Err(NotIn::NotKept(why)),
            Err(_) => Err(NotIn::Unknown),
        }
    }

    /// Who invites by a link and as what, without using it.
    ///
    /// # Errors
    /// As [`Self::join`], but for the disk.
    pub(crate) fn promise(&self, token: &str, from: GuessSource) -> Result<(String, Role), NotIn> {
        let promise = self.book.borrow().promise(&Digest::of(token), now_ms());
        promise.ok_or_else(|| self.guessed(from))
    }

    /// Somebody tried a link that does not work.
    fn guessed(&self, from: GuessSource) -> NotIn {
        let tried_ms = u64::try_from(self.began.elapsed().as_millis()).unwrap_or(u64::MAX);
        let mut guesses = lock(&self.guesses);
        match guesses.check(tried_ms, from) {
            Ok(()) => {
                guesses.failed(tried_ms, from);
                NotIn::Unknown
            }
            Err(seconds) => NotIn::TooMany(seconds),
        }
    }

    /// Who shows this cookie.
    pub(crate) fn guest(&self, cookie: &str) -> Option<Guest> {
        let pass = Digest::of(cookie);
        // Looked up under the lock: what is revoked afterwards finds the guest.
        let mut live = lock(&self.live);
        let (invitation, role, ends_ms) = self.book.borrow().guest(&pass, now_ms())?;
        let over = live.over(&invitation);
        Some(Guest { role, invitation, pass, ends_ms, over })
    }

    /// Whether a cookie of this digest still lets somebody in.
    pub(crate) fn holds(&self, pass: &Digest) -> bool {
        self.book.borrow().guest(pass, now_ms()).is_some()
    }

    /// A guest is here, under this name, until what is returned is dropped.
    pub(crate) fn arrive(self: &Arc<Self>, guest: &Guest, name: &str) -> GuestPresence {
        lock(&self.live).arrive(&guest.pass);
        self.call(guest, name);
        self.tell();
        GuestPresence::of(Arc::clone(self), guest.pass)
    }

    /// A guest is called this from now on: known at once, and written later.
    pub(crate) fn call(&self, guest: &Guest, name: &str) {
        let mut names = lock(&self.names);
        if names.contains_key(&guest.pass) || !self.book.borrow().book.is_named(&guest.invitation, &guest.pass, name) {
            names.insert(guest.pass, (name.to_owned(), now_ms()));
            drop(names);
            self.due.send_replace(true);
            self.tell();
        }
    }

    /// What a guest is called, [`SOMEBODY`] until they said so. Waits for nobody, so that a Stop can ask it: while another name is
    /// being put down, what was put down before counts.
    pub(crate) fn name_of(&self, guest: &Guest) -> String {
        let names = self.names.try_lock().ok();
        let new = names.and_then(|names| names.get(&guest.pass).map(|(name, _)| name.clone()));
        let name = new.unwrap_or_else(|| self.book.borrow().book.name_of(&guest.pass).to_owned());
        if name.is_empty() { SOMEBODY.to_owned() } else { name }
    }

    fn leave(&self, pass: &Digest) {
        lock(&self.live).leave(pass);
        self.tell();
    }

    /// Changes the book: kept before it holds, with what may be written later.
    fn change<T>(&self, how: impl FnOnce(&mut Book) -> Result<T, Refused>) -> Result<T, Refused> {
        let _one = lock(&self.writing);
        // What comes meanwhile is due again.
        self.due.send_replace(false);
        let changed = self.write(how);
        if changed.is_err() {
            self.due.send_replace(true);
        }
        self.tell();
        changed
    }

    fn write<T>(&self, how: impl FnOnce(&mut Book) -> Result<T, Refused>) -> Result<T, Refused> {
        let (names, mut book) = (lock(&self.names).clone(), self.book.borrow().book.clone());
        let changed = how(&mut book)?;
        book.name(&names);
        self.put(&book).map_err(Refused::InvitationsNotKept)?;
        let is_kept = |invitation: &Id| book.has_revoked(invitation);
        lock(&self.reserve).kept(is_kept);
        self.replace(|now| {
            // It may have been revoked since, which never waits for this.
            for invitation in book.revoked(now) {
                book.revoke(&invitation);
            }
            *now = book;
        });
        lock(&self.names).retain(|pass, name| names.get(pass) != Some(name));
        Ok(changed)
    }

    /// Waits until something is to be written.
    async fn is_due(&self) {
        // It is there as long as this is.
        let _ = self.due.subscribe().wait_for(|is_due| *is_due).await;
    }

    /// Writes what is due, if anything is; what cannot be written stays due.
    fn write_due(&self) {
        if !*self.due.borrow() {
            return;
        }
        lock(&self.reserve).again();
        if let Err(why) = self.change(|_| Ok(())) {
            tracing::warn!(%why, "what is known of invitations could not be written; it is tried again");
        }
    }

    fn put(&self, book: &Book) -> Result<(), Phrase> {
        let Some(file) = &self.file else { return Ok(()) };
        let text = serde_json::to_string_pretty(book).map_err(|error| error.to_string())?;
        atomic_file::put(file, &text).map_err(|error| error.phrase())
    }

    /// Changes what holds, at once.
    fn replace<T>(&self, how: impl FnOnce(&mut Book) -> T) -> T {
        let _one = lock(&self.replacing);
        let mut book = self.book.borrow().book.clone();
        let done = how(&mut book);
        self.book.send_replace(Arc::new(Indexed::of(book)));
        done
    }

    fn tell(&self) {
        self.told.send_modify(|_| {});
    }
}

#[cfg(test)]
mod tests;
