//! The whole server over real sockets: people who edit together, bad changes, restarts, and strangers at the door.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod answerable;
mod browser;
mod console;
mod edits;
mod history;
mod history_limits;
mod host;
mod house;
mod http;
mod invited;
mod late_presses;
mod limits;
mod links;
mod lists;
mod locks;
mod looking_back;
mod looking_together;
mod marking;
mod mutated;
mod operating;
mod proxied;
mod renaming;
mod reports;
mod roles;
mod runs;
mod shares;
mod slow;
mod two_servers;
