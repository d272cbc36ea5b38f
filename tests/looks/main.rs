//! How every screen looks at every size: accessibility, nothing cut or scrolled sideways, Stop on top, the first load.

mod axe;
mod conflicts;
mod graphs;
mod history;
mod invite;
mod load;
mod locks;
mod presence;
mod rules;
mod screens;
mod sizes;
mod targets;
