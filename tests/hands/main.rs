//! Hands on the canvas: fingers, pens, mice and keys, how much work a drag is, and that nothing gets in the way of
//! anything else.

mod backing_out;
mod carry;
mod control;
mod drags;
mod editor;
mod groups;
mod hints;
mod inputs;
mod keyboard;
mod keyboards;
mod lanes;
mod library;
mod many;
mod map;
mod notes;
mod offers;
mod paper;
mod rewire;
mod room;
mod several;
mod sight;
mod steps;
mod together;
mod told;
mod wire;
