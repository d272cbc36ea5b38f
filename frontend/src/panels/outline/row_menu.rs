//! What can be done with a row of the list: what stands in its menu on the graph.

use crate::browser;
use crate::commands::{ALL, Command, On};
use crate::panels::hold::hold;
use crate::panels::menu::MenuItem;
use leptos::prelude::*;

/// A moment for the menu to go, in milliseconds.
const GONE_MS: i32 = 40;

/// The commands of a menu, as a view.
pub(crate) fn row_menu(on: On) -> AnyView {
    let desk = hold();
    let item = move |command: &'static Command| {
        let no = untrack(|| desk.desk().may_not(command.role)).is_some();
        let run = Callback::new(move |()| {
            let desk = desk.desk();
            browser::after(GONE_MS, move || command.run(&desk));
        });
        view! { <MenuItem label=(command.label)() icon=command.icon() disabled=no choose=run /> }
    };
    ALL.iter().filter(|command| command.on.contains(&on) && command.is_here()).map(item).collect_view().into_any()
}
