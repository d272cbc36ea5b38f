//! The porch: HTTP and sockets, one task per open room, and the robot's own thread behind a door.
//!
//! An edit goes socket -> room -> store -> everyone, and nobody sees it before it is saved. Stop goes from the socket
//! or the route straight to the robot: it passes no room, no queue and no store.
#![warn(missing_docs)]

mod accept;
mod address;
mod bin;
mod carry;
mod checking;
mod clients;
mod connection;
mod create;
mod cut;
mod data_folder;
mod downloads;
mod health;
mod hub;
mod import;
mod insight;
mod knowledge;
mod origin;
mod outbox;
mod page;
mod patience;
mod pictures;
mod places;
mod priority;
mod programs;
mod recordings;
mod robots;
mod room;
mod rooms;
mod routes;
mod serve;
mod session;
mod start;
mod templates;
mod topics;
mod whole;
mod workers;

pub use address::address_in;
pub use create::first_library;
pub use knowledge::Knowing;
pub use programs::{free_name, names};
pub use robots::{check_robots, put_robots, robots_in};
pub use serve::{Config, ServeError, serve, serve_with};

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Milliseconds since 1970.
fn now_ms() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
}

/// Locks for a few lines without waiting inside; a panic elsewhere does not matter to what these locks hold.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
