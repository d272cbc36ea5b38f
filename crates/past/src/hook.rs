//! The way in which whoever asks ends what takes too long.

use std::rc::Rc;

/// Asked now and then while something is played, also in the middle of one reading; true ends it.
pub type Hook = Rc<dyn Fn() -> bool>;
