//! The common base of the tests of the whole house: a real browser with people in it, a real server, and the sources.
//!
//! ```no_run
//! # async fn journey() -> house::Outcome<()> {
//! let folder = house::folder()?;
//! let server = house::Server::start(folder.path()).await?;
//! let browser = house::Browser::launch().await?;
//! let aiko = browser.person("aiko").await?;
//! aiko.goto(&server.url()).await?;
//! aiko.press("button", "Add a program").await?;
//! aiko.until("document.title.includes('behaviour')", "the title names the behaviour").await?;
//! aiko.no_errors()
//! # }
//! ```

mod axe;
mod browser;
mod find;
mod frames;
mod full_disk;
mod game;
pub mod guide;
mod hands;
mod host;
mod keys;
mod page;
mod paths;
pub mod rehearsal;
mod requests;
mod server;
mod session;
pub mod skip;
pub mod sources;
mod standin;
mod switch;
#[cfg(unix)]
mod terminal;
mod times;
mod trouble;
mod wall_clock;
mod watch;
mod wire;
mod within;

pub use axe::{Rules, Violation};
pub use browser::Browser;
pub use find::{Node, Rect};
pub use full_disk::{DISK_IS_FULL, on_a_disk};
pub use game::{GAME, TILES};
pub use host::host_line;
pub use page::{Cpu, Page};
pub use paths::{folder, optimised, root, server, target};
pub use server::{Server, signal};
pub use session::{SESSION, SESSION_MS, keep_session, keep_session_of, keep_session_program};
pub use standin::StandIn;
pub use switch::Switch;
#[cfg(unix)]
pub use terminal::{Closed, InTerminal, Terminal};
pub use trouble::{Outcome, Trouble};
pub use wall_clock::WallClock;
pub use watch::Traffic;
pub use within::Within;
