//! Hands on the canvas: fingers, pens, mice and keys, how much work a drag is, and that nothing gets in the way of
//! anything else.

mod drags;
mod keyboard;
mod library;
mod many;
mod room;
mod sight;
mod steps;
mod together;
mod wire;
