//! The commands of a menu outside of the canvas: of a row of the list, what stands in its menu on the graph; of the bar, what
//! there is no room for as buttons.

use crate::browser;
use crate::commands::{self, On, PageCommand};
use crate::parts::{MenuItem, hold};
use leptos::prelude::*;
use protocol::Role;

/// The commands of a menu, as a view, with a line between those about different things. What only the host may do is not
/// there for others.
pub(crate) fn row_menu(on: On) -> AnyView {
    let desk = hold();
    let is_shown = |command: &PageCommand| {
        command.on.contains(&on)
            && command.is_here()
            && (command.role != Role::Host || untrack(|| desk.desk().may(command.role)))
    };
    let mut before = None;
    let item = move |command: PageCommand| {
        let no = untrack(|| !command.can_be_done(&desk.desk()));
        let run = Callback::new(move |()| {
            let desk = desk.desk();
            // The menu is gone then.
            browser::rendered(move || command.run(&desk));
        });
        let is_next = before.replace(command.group).is_some_and(|before| before != command.group);
        view! {
            {is_next.then(|| view! { <div class="menu-rule" role="separator"></div> })}
            <MenuItem label=command.label() icon=command.icon() disabled=no choose=run />
        }
    };
    commands::all().into_iter().filter(is_shown).map(item).collect_view().into_any()
}
