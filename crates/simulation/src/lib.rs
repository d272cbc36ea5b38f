//! A NAO and its room, computed: the same behaviours run on it as on a real robot, headless, in the page and in tests.
//!
//! The robot is servo-lag forward kinematics driving kinematic bodies in a rapier world (measured in our notes on
//! simulation: the cheapest choice, and no torture test broke it). Senses work by geometry: field of view and lines of
//! sight. No clock, no threads and no standard trigonometry live here, so native and WebAssembly compute equal bits.
#![warn(missing_docs)]

mod base;
mod body;
mod edit;
mod hash;
mod looking;
mod math;
mod model;
mod movers;
mod nao;
mod noise;
mod parts;
mod picture;
mod robot_impl;
mod room;
mod servo;
mod sight;
mod table;
mod world;

pub use edit::RoomFault;
pub use nao::{PlayedSound, SimulatedNao, Spoken};
pub use noise::Noise;
