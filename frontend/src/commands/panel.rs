//! The panels of the right column that open by a command of their own, as everything but themselves knows them. What one shows
//! comes with the second piece of the page.

use super::{CommandWork, PageCommand, face};
use crate::desk::Desk;
use editor::commands::{Command, CommandGroup, CommandSpec, Needs, On};
use leptos::prelude::*;
use protocol::Role;
use std::cell::Cell;

/// All that is known of a panel before it is open.
#[derive(Clone, Copy)]
pub(crate) struct Panel {
    /// The name of the panel, and of the command that opens it.
    pub(crate) label: fn() -> &'static str,
    pub(crate) icon: &'static str,
    /// The subject under which its command stands.
    pub(crate) group: CommandGroup,
    /// The keys that open it, as `Ctrl J`; empty if it has none.
    pub(crate) keys: &'static str,
    /// The least role of who sees it.
    pub(crate) role: Role,
    /// The menus in which its command stands.
    pub(crate) on: &'static [On],
    /// The thing that must be there to show it.
    pub(crate) needs: Needs,
    /// True if the bar has a button for it where there is room.
    pub(crate) in_bar: bool,
}

/// A panel with its name in the list.
#[derive(Clone, Copy)]
pub(crate) struct ListedPanel {
    pub(crate) name: &'static str,
    pub(crate) panel: Panel,
}

thread_local! {
    /// The list of panels, which the top of the page hands in.
    static LIST: Cell<&'static [ListedPanel]> = const { Cell::new(&[]) };
}

/// Hands in the list of panels, once.
pub(crate) fn know_panels(list: &'static [ListedPanel]) {
    LIST.set(list);
}

/// Returns all panels, in the order of their list.
pub(crate) fn panels() -> &'static [ListedPanel] {
    LIST.get()
}

impl ListedPanel {
    /// Returns the command that opens the panel.
    pub(crate) fn command(&self) -> PageCommand {
        let Panel { label, icon, group, keys, role, on, needs, .. } = self.panel;
        let command = Command::Panel(self.name);
        let spec = CommandSpec { command, group, keys, role, on, needs, on_graph: false };
        PageCommand { spec, face: face(label, icon, CommandWork::Panel(self.name)) }
    }

    /// Returns true if there is what the panel needs, and who is here may see it. Reactive.
    pub(crate) fn can_be_shown(&self, desk: &Desk) -> bool {
        self.command().can_be_done(desk)
    }
}

/// Returns the panel that is shown: the open one, while it can be shown. Reactive.
pub(crate) fn open_panel(desk: &Desk) -> Option<&'static ListedPanel> {
    let open = desk.panel.get()?;
    panels().iter().find(|panel| panel.name == open).filter(|panel| panel.can_be_shown(desk))
}
