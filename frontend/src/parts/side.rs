//! The place of panels in the right column: the buttons of the bar that open them, and how one is left.

use crate::commands::{ListedPanel, open_panel, panels};
use crate::escape;
use crate::focus;
use crate::icons::Icon;
use crate::later::Later;
use crate::parts::{DeskHold, hold};
use crate::words;
use leptos::html;
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// The panel that is open, beside what else stands in the right column.
#[component]
pub(crate) fn OpenPanel() -> impl IntoView {
    let desk = hold();
    let open = Memo::new(move |_| open_name(desk));
    move || open.get().map(|name| view! { <Later show=move |rest| (rest.panel)(name) /> })
}

/// The frame of a panel: its name, and a button that closes it, as Escape does. It has the keyboard as soon as it is open.
#[component]
pub(crate) fn SidePanel(
    /// Stands in the head, before the button that closes.
    #[prop(optional)]
    tools: Option<AnyView>,
    /// Hears keys first. Returns true for one that it uses.
    #[prop(optional)]
    on_key: Option<Callback<KeyboardEvent, bool>>,
    /// Ends what was begun in it, before it is closed.
    #[prop(optional)]
    before: Option<Callback<()>>,
    children: Children,
) -> impl IntoView {
    let desk = hold();
    let open = untrack(|| open_panel(&desk.desk()));
    let (name, label) = open.map_or(("", ""), |open| (open.name, (open.panel.label)()));
    let root = NodeRef::<html::Section>::new();
    Effect::new(move |_| {
        if root.get().is_some() {
            let _ = request_animation_frame(move || take_keyboard(root));
        }
    });
    let close = move || {
        before.iter().for_each(|before| before.run(()));
        close_panel(desk);
    };
    let key = move |event: KeyboardEvent| {
        let is_used = on_key.is_some_and(|on_key| on_key.run(event.clone()));
        if is_used || escape::ends(&event, close) {
            event.stop_propagation();
        }
    };
    view! {
        <section class=format!("side {name}") data-panel=name aria-label=label node_ref=root on:keydown=key>
            <div class="side-head">
                <h2 tabindex="-1">{label}</h2>
                {tools}
                <button class="tool icon" type="button" data-close="" aria-label=words::close() title=words::close()
                    on:click=move |_| close()>
                    <Icon name="close" />
                </button>
            </div>
            {children()}
        </section>
    }
}

/// Gives the keyboard to where Tab comes to, else to the name of the panel.
fn take_keyboard(root: NodeRef<html::Section>) {
    let Some(root) = root.get_untracked() else { return };
    let stops = focus::all(&root, "[data-stop][tabindex='0']");
    if let Some(first) = stops.into_iter().next().or_else(|| focus::all(&root, "h2").into_iter().next()) {
        focus::focus(&first);
    }
}

/// The name of the panel that is shown. Reactive.
pub(crate) fn open_name(desk: DeskHold) -> Option<&'static str> {
    open_panel(&desk.desk()).map(|panel| panel.name)
}

/// The buttons of the bar for panels that have one.
#[component]
pub(crate) fn PanelButtons() -> impl IntoView {
    let in_bar = panels().iter().filter(|panel| panel.panel.in_bar);
    in_bar.map(|panel| view! { <PanelButton panel /> }).collect_view()
}

#[component]
fn PanelButton(panel: &'static ListedPanel) -> impl IntoView {
    let desk = hold();
    let (name, label) = (panel.name, (panel.panel.label)());
    let turn = move |_| desk.desk().panel.update(|open| *open = Some(name).filter(|name| *open != Some(name)));
    view! {
        <button class="tool icon not-phone" type="button" id=button_id(name) data-stop="" tabindex="-1" title=label
            aria-label=label aria-expanded=move || (open_name(desk) == Some(name)).to_string()
            disabled=move || !panel.can_be_shown(&desk.desk()) on:click=turn>
            <Icon name=panel.panel.icon />
        </button>
    }
}

fn button_id(name: &str) -> String {
    format!("{name}-button")
}

/// Closes the panel that is open; its button in the bar has the keyboard, if that is shown.
pub(crate) fn close_panel(desk: DeskHold) {
    let open = desk.desk().panel.try_update(Option::take).flatten();
    let button = open.and_then(|name| focus::by_id(&button_id(name)));
    if let Some(button) = button.filter(|button| button.offset_width() > 0) {
        focus::focus(&button);
    }
}

#[cfg(test)]
mod tests {
    use crate::commands::{PageCommand, all, know_panels};
    use crate::page::PANELS;
    use std::collections::BTreeSet;

    #[test]
    fn every_panel_has_its_command_and_no_key_means_two() {
        know_panels(PANELS);
        let all = all();
        let panels: BTreeSet<&str> = all.iter().filter_map(PageCommand::panel).collect();
        let keys: Vec<&str> = all.iter().map(|command| command.keys).filter(|keys| !keys.is_empty()).collect();
        assert_eq!(panels, PANELS.iter().map(|panel| panel.name).collect());
        assert_eq!(panels.len(), PANELS.len(), "each has a name of its own");
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{keys:?}");
        assert!(all.is_sorted_by_key(|command| command.group), "group by group");
        let is_heard = |keys: &str| keys.is_empty() || keys.strip_prefix("Ctrl ").is_some_and(|key| key.len() == 1);
        assert!(PANELS.iter().all(|panel| is_heard(panel.panel.keys)), "keys that the page hears");
    }
}
