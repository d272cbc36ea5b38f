//! The simulated NAO as the people around it know it: what it sees, how it moves, what it says.

mod arms;
mod bench;
mod control;
mod devices;
mod ends;
mod head;
mod lissajous;
mod room;
mod senses;
