//! Everything around the canvas: the bar, the left list, the right column, dialogs, notices and the outline.

mod apply;
mod buttons;
mod chosen;
mod condition;
mod control;
mod dialogs;
mod editors;
mod empty;
mod ended;
mod files;
mod history;
mod insight;
mod inspector;
mod language;
mod name_card;
mod notices;
mod operate;
mod outline;
mod palette;
mod past;
mod people;
mod problems;
mod recordings;
mod right;
mod robot_box;
mod robots;
mod room;
mod running;
mod sentences_panel;
mod side;
mod stranger;
mod teaching;
mod to_stop;
mod toolbar;
mod tools;
mod trials;
mod typed;
mod uses;

pub(crate) use apply::apply;
pub(crate) use chosen::chosen;
pub(crate) use control::control;
pub(crate) use dialogs::{Dialogs, dialog};
pub(crate) use editors::Editors;
pub(crate) use empty::EmptyStage;
pub(crate) use ended::Ended;
pub(crate) use files::Files;
pub(crate) use inspector::selected;
pub(crate) use name_card::asks_name;
pub(crate) use notices::Notices;
pub(crate) use operate::operate;
pub(crate) use outline::{outline, row_menu};
pub(crate) use palette::Palette;
pub(crate) use past::past;
pub(crate) use problems::problems;
pub(crate) use recordings::recorded;
pub(crate) use right::RightColumn;
pub(crate) use robots::robot_list;
pub(crate) use room::{camera, printed, room_tools};
pub(crate) use running::running;
pub(crate) use sentences_panel::sentences_panel;
pub(crate) use stranger::stranger;
pub(crate) use teaching::{TourPlace, exercise, tour};
pub(crate) use toolbar::Toolbar;
pub(crate) use tools::tool_items;
pub(crate) use typed::typed;

use crate::commands::ListedPanel;
use leptos::prelude::*;

/// The panels of the right column, each by its module, which has its `PANEL` and its `view`.
macro_rules! panels {
    ($($name:ident),* $(,)?) => {
        /// All panels that open by a command, in the order of their commands.
        pub(crate) static PANELS: &[ListedPanel] =
            &[$(ListedPanel { name: stringify!($name), panel: $name::PANEL }),*];

        /// The panel of this name, as a view. It is of the second piece of the page.
        pub(crate) fn panel(name: &str) -> AnyView {
            match name {
                $(stringify!($name) => $name::view(),)*
                _ => ().into_any(),
            }
        }
    };
}

panels! {
    history,
}
