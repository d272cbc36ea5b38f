//! The server: HTTP and sockets, one task per open behaviour, and every robot on a thread of its own.
//!
//! An edit goes socket -> room -> store -> everyone, and nobody sees it before it is saved. Stop goes from the socket
//! or the route straight to the robot: it passes no room, no queue and no store.
#![warn(missing_docs)]

mod connection;
mod http;
mod invitations;
mod library;
mod recordings;
mod robots;
mod rooms;
mod serve;
mod state;
mod support;
mod words;

pub use http::address::address_in;
pub use http::network::{GuestNetwork, NoCertificate, Secured};
pub use http::page::{PageFile, PageFiles};
pub use library::create::first_library;
pub use library::list::{free_name, names};
pub use robots::{BackupMisfit, check_robots, put_robots, robots_in};
pub use rooms::knowledge::Knowing;
pub use serve::{Config, InvitedFrom, ReadyServer, ServeError, serve, serve_with};
