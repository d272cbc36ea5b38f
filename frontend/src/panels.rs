//! Everything around the canvas: the bar, the left list, the right column, dialogs, notices and the outline.

mod dialogs;
mod editors;
mod empty;
mod files;
mod focus;
mod history;
mod hold;
mod insight;
mod inspector;
mod menu;
mod notices;
mod outline;
mod palette;
mod people;
mod problems;
mod recordings;
mod right;
mod robot_box;
mod robots;
mod room;
mod running;
mod toolbar;
mod tools;
mod trials;

pub(crate) use dialogs::Dialogs;
pub(crate) use editors::Editors;
pub(crate) use empty::EmptyStage;
pub(crate) use files::Files;
pub(crate) use notices::Notices;
pub(crate) use outline::Outline;
pub(crate) use palette::Palette;
pub(crate) use right::RightColumn;
pub(crate) use toolbar::Toolbar;
