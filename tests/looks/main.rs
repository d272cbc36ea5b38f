//! How every screen looks at every size: accessibility, nothing cut or scrolled sideways, Stop on top, the first load.

mod all_screens;
mod asides;
mod axe;
mod conflicts;
mod corners;
mod few_and_many;
mod fits;
mod floats;
mod graphs;
mod history;
mod invite;
mod japanese;
mod large;
mod load;
mod locks;
mod look;
mod operate;
mod past;
mod presence;
mod recordings;
mod rules;
mod screens;
mod targets;
mod tour;
mod words;
