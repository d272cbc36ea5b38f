//! Letting others in: invitations, who came by them, and what each of them may do. Nothing here reads a file or waits on
//! the way of a Stop: what is asked there is looked up in memory.

mod book;
mod entry;
mod guesses;
mod guest;
mod host;
mod may;
mod qr;
mod secret;

pub(crate) use entry::Entry;
pub(crate) use guesses::Source;
pub(crate) use guest::{Guest, Here};
pub(crate) use host::HostAccess;
pub(crate) use may::{Asked, Route};
pub(crate) use secret::Digest;

use crate::support::tasks::blocking;
use crate::support::{atomic_file, lock, now_ms};
use behaviour::{Id, without_unseen};
use book::{Book, Indexed, Made};
use guesses::Guesses;
use guest::Live;
use protocol::{COME_IN_PATH, Invitation, LABEL_MAX_CHARS, Lasts, Refused, Role};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Instant;
use tokio::sync::watch;
use uuid::Uuid;

/// The file of the invitations in the data folder.
const FILE: &str = "rrp.invitations.json";
/// Who makes the invitation that is printed at each start.
const AT_START: &str = "rrp serve";
/// What else there is to say if there is no disk to keep it on.
const NO_RANDOM: &str = "this computer gives no random numbers";

/// All invitations.
pub(crate) struct Invitations {
    file: Option<PathBuf>,
    way: OnceLock<Way>,
    /// Held while something is written: one writer at a time.
    writing: Mutex<()>,
    /// What holds, for those who only look.
    book: watch::Sender<Arc<Indexed>>,
    live: Mutex<Live>,
    guesses: Mutex<Guesses>,
    /// When the clock of the guesses was 0.
    began: Instant,
    told: watch::Sender<Arc<Vec<Invitation>>>,
}

/// Where links lead.
#[derive(Clone, Debug)]
pub(crate) struct Way {
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
    NotKept(String),
}

impl Invitations {
    /// Those of a data folder; without one they last as long as the server.
    pub(crate) fn within(data: Option<&Path>) -> Arc<Self> {
        let file = data.map(|data| data.join(FILE));
        let book: Book = file.as_deref().and_then(atomic_file::read).unwrap_or_default();
        let told = watch::Sender::new(Arc::new(book.list(|_| false)));
        Arc::new(Self {
            file,
            way: OnceLock::new(),
            writing: Mutex::default(),
            book: watch::Sender::new(Arc::new(Indexed::of(book))),
            live: Mutex::default(),
            guesses: Mutex::default(),
            began: Instant::now(),
            told,
        })
    }

    /// From now on others can come in by this way.
    pub(crate) fn open(&self, way: Way) {
        let _once = self.way.set(way);
    }

    /// Whether others can come in at all.
    pub(crate) fn lets_in(&self) -> bool {
        self.way.get().is_some()
    }

    /// All of them, newest first, told anew whenever they change.
    pub(crate) fn told(&self) -> watch::Receiver<Arc<Vec<Invitation>>> {
        self.told.subscribe()
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
        let token = secret::random().ok_or_else(|| Refused::InvitationsNotKept(NO_RANDOM.to_owned()))?;
        let label = without_unseen(&terms.label).trim().chars().take(LABEL_MAX_CHARS).collect();
        let made = Made { id: Id::from_uuid(Uuid::new_v4()), now_ms: now_ms(), link: Digest::of(&token) };
        let invitation = self.change(|book| {
            first(book);
            book.make(made, Terms { label, ..terms })
        })?;
        let link = format!("{}{COME_IN_PATH}#{token}", way.origin);
        let (qr, fingerprint) = (qr::rows(&link), way.fingerprint.clone());
        tracing::info!(invitation = %invitation.id, role = ?invitation.role, "somebody is invited");
        Ok(Invited { invitation, link, qr, fingerprint })
    }

    /// Ends one: its links and cookies are dead before this returns, and everyone by it is told to go. Waits for the disk.
    ///
    /// # Errors
    /// If there is none, or this cannot be kept; then it holds as long as the server.
    pub(crate) fn revoke(&self, invitation: &Id) -> Result<(), Refused> {
        let revoked = {
            let _one = lock(&self.writing);
            let mut book = self.book.borrow().book.clone();
            if !book.revoke(invitation) {
                return Err(Refused::NoInvitation);
            }
            // In force at once, whatever the disk says.
            self.publish(book.clone());
            self.put(&book)
        };
        lock(&self.live).end(invitation);
        self.tell();
        tracing::info!(%invitation, kept = revoked.is_ok(), "an invitation is revoked");
        revoked.map_err(Refused::InvitationsNotKept)
    }

    /// Exchanges the token of a link for that of a cookie, always a new one. Waits for the disk. A link that works is never
    /// refused for what others tried: it is looked up first, which costs no more than refusing, and nobody guesses 256 bits.
    ///
    /// # Errors
    /// If it lets nobody in; then also if too many such links came from there.
    pub(crate) fn come_in(&self, token: &str, from: Source) -> Result<String, NotIn> {
        let link = Digest::of(token);
        if !self.book.borrow().is_open(&link, now_ms()) {
            return Err(self.guessed(from));
        }
        let cookie = secret::random().ok_or_else(|| NotIn::NotKept(NO_RANDOM.to_owned()))?;
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

    /// Somebody tried a link that does not work.
    fn guessed(&self, from: Source) -> NotIn {
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
        Some(Guest { role, pass, ends_ms, over })
    }

    /// Whether a cookie of this digest still lets somebody in.
    pub(crate) fn holds(&self, pass: &Digest) -> bool {
        self.book.borrow().guest(pass, now_ms()).is_some()
    }

    /// A guest is here, under this name, until what is returned is dropped.
    pub(crate) fn arrive(self: &Arc<Self>, guest: &Guest, name: &str) -> Here {
        lock(&self.live).arrive(&guest.pass);
        self.tell();
        let (all, name, named) = (Arc::clone(self), name.to_owned(), guest.clone());
        drop(blocking(move || all.call(&named, &name)));
        Here::of(Arc::clone(self), guest.pass)
    }

    /// A guest is called this from now on, which is kept.
    pub(crate) fn call(&self, guest: &Guest, name: &str) {
        if self.book.borrow().book.is_named(&guest.pass, name) {
            return;
        }
        let named = self.change(|book| {
            book.name(&guest.pass, name, now_ms());
            Ok(())
        });
        if let Err(why) = named {
            tracing::warn!(%why, "who came by an invitation could not be kept");
        }
    }

    /// What a guest is called; empty until they said so.
    pub(crate) fn name_of(&self, guest: &Guest) -> String {
        self.book.borrow().book.name_of(&guest.pass).to_owned()
    }

    fn leave(&self, pass: &Digest) {
        lock(&self.live).leave(pass);
        self.tell();
    }

    /// Changes the book: kept before it holds.
    fn change<T>(&self, how: impl FnOnce(&mut Book) -> Result<T, Refused>) -> Result<T, Refused> {
        let _one = lock(&self.writing);
        let mut book = self.book.borrow().book.clone();
        let changed = how(&mut book)?;
        self.put(&book).map_err(Refused::InvitationsNotKept)?;
        self.publish(book);
        self.tell();
        Ok(changed)
    }

    fn put(&self, book: &Book) -> Result<(), String> {
        let Some(file) = &self.file else { return Ok(()) };
        let text = serde_json::to_string_pretty(book).map_err(|error| error.to_string())?;
        atomic_file::put(file, &text).map_err(|error| error.to_string())
    }

    fn publish(&self, book: Book) {
        self.book.send_replace(Arc::new(Indexed::of(book)));
    }

    fn tell(&self) {
        let live = lock(&self.live);
        let list = self.book.borrow().book.list(|pass| live.is_here(pass));
        self.told.send_replace(Arc::new(list));
    }
}

#[cfg(test)]
mod tests;
