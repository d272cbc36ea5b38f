//! The frame of the page: the bar, the right column, the open dialog and notices. It puts the views of all features in their
//! places.

mod dialogs;
mod editors;
mod ended;
mod help;
mod notices;
mod right;
mod toolbar;
mod tools;
pub(crate) mod words;

use crate::commands::ListedPanel;
use crate::history;
pub(crate) use dialogs::{Dialogs, dialog};
pub(crate) use editors::Editors;
pub(crate) use ended::Ended;
use leptos::prelude::*;
pub(crate) use notices::Notices;
pub(crate) use right::RightColumn;
pub(crate) use toolbar::Toolbar;
pub(crate) use tools::tool_items;

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
