//! Save as file: the open program as JSON or XML, or its drawing, to keep or to carry to another computer.

mod png;

use crate::desk::file_address;
use crate::dialogs::{Frame, close};
use crate::icons::Icon;
use crate::library::words;
use crate::parts::hold;
use crate::reasons::NoPicture;
use behaviour::Id;
use leptos::prelude::*;
use png::save_png;

/// The kinds of file: those of the server as links, the picture as a button.
#[component]
pub(crate) fn SaveFile() -> impl IntoView {
    let desk = hold();
    let open = desk.desk().document.open.get_untracked();
    let kinds = [
        ("json", words::file_json(), words::file_json_says()),
        ("xml", words::file_xml(), words::file_xml_says()),
        ("svg", words::file_svg(), words::file_svg_says()),
    ];
    let png = open.clone().map(|id| view! { <li><Png id /></li> });
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
            <ul class="dialog-body big-list">{kinds.map(link).collect_view()} {png}</ul>
        </Frame>
    }
}

/// How making the picture goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum PictureMaking {
    Rests,
    Goes,
    Done,
    Failed(NoPicture),
}

/// The drawing as a picture, which this browser makes.
#[component]
fn Png(id: Id) -> impl IntoView {
    let making = RwSignal::new(PictureMaking::Rests);
    let make = move |_| {
        if making.get_untracked() == PictureMaking::Goes {
            return;
        }
        making.set(PictureMaking::Goes);
        let id = id.clone();
        leptos::task::spawn_local(async move {
            let made = save_png(&id).await;
            // The dialog may be closed meanwhile.
            making.try_set(made.map_or_else(PictureMaking::Failed, |()| PictureMaking::Done));
        });
    };
    let said = move || match making.get() {
        PictureMaking::Rests | PictureMaking::Failed(_) => words::file_png_says(),
        PictureMaking::Goes => words::png_goes(),
        PictureMaking::Done => words::png_done(),
    };
    let failed = move || match making.get() {
        PictureMaking::Failed(why) => Some(words::no_png(why)),
        PictureMaking::Rests | PictureMaking::Goes | PictureMaking::Done => None,
    };
    view! {
        <button class="menu-item" type="button" aria-disabled=move || (making.get() == PictureMaking::Goes).to_string() on:click=make>
            <span class="kind plain"><Icon name="save" /></span>
            <span class="two"><b>{words::file_png()}</b><span class="second" role="status">{said}</span></span>
        </button>
        {move || failed().map(|why| view! { <p class="refusal" role="alert">{why}</p> })}
    }
}
