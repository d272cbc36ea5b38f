//! A recording for people: as a page to print, and in the forms of other programs.
//!
//! Files, clocks and sockets are left to whoever uses this: lines come in, texts go out. By default everybody who pressed stands
//! as a code.
#![warn(missing_docs)]

mod bars;
mod clock;
mod exports;
mod gather;
mod list;
mod page;
mod replayed;
mod sessions;
mod troubles;
mod words;

pub use clock::Zone;
pub use exports::{Form, clock};
pub use gather::Gathered;
pub use list::{Choice, ChosenRecording, LIST_STYLE, List, ListedRecording, list, no};
pub use page::{ReportWishes, SCRIPT, STYLE, language_of, page};
pub use replayed::Replayed;
pub use sessions::SessionNumbers;
