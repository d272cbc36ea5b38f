//! Save as file: the open program as JSON or XML, or its drawing, to keep or to carry to another computer.

use super::frame::{Frame, close};
use crate::desk::file_address;
use crate::icons::Icon;
use crate::panels::hold::hold;
use crate::words;
use leptos::prelude::*;

/// The three kinds of file, as links.
#[component]
pub(super) fn SaveFile() -> impl IntoView {
    let desk = hold();
    let open = desk.desk().document.open.get_untracked();
    let kinds = [
        ("json", words::file_json(), words::file_json_says()),
        ("xml", words::file_xml(), words::file_xml_says()),
        ("svg", words::file_svg(), words::file_svg_says()),
    ];
    let link = move |(ending, name, says): (&'static str, &'static str, &'static str)| {
        let address = open.as_ref().map(|id| file_address(id, ending));
        view! {
            <li>
                <a class="menu-item" href=address download="">
                    <span class="kind plain"><Icon name="save" /></span>
                    <span class="two"><b>{name}</b><span class="second">{says}</span></span>
                </a>
            </li>
        }
    };
    view! {
        <Frame title=words::save_file() narrow=true save=Callback::new(move |()| close(desk))>
            <ul class="dialog-body big-list">{kinds.map(link).collect_view()}</ul>
        </Frame>
    }
}
