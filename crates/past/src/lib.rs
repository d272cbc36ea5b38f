//! Looking back at a run: values over time, moments, why something came or did not, and what an edited program would have done.
//!
//! An [`Opening`] takes the entries of a recording and plays them once through the programs that ran. It gives a [`Past`], which
//! holds the readings in few bytes, what the run remembered every half a minute, and numbers over time. Every question plays
//! from the nearest of these moments. All of it is bounded, and nothing here knows a clock: whoever asks hands in a hook that
//! ends what takes too long.
#![warn(missing_docs)]

mod answer;
mod bars;
mod change;
mod changed;
mod cut;
mod fix;
mod hook;
mod interruptions;
mod lanes;
mod limits;
mod matched;
mod miss;
mod moment;
mod opening;
mod past;
mod play;
mod program;
mod segment;
mod series;
mod sparse;
mod stretches;
mod tape;
mod why;

pub use change::EditedRun;
pub use hook::Hook;
pub use opening::Opening;
pub use past::Past;
