//! The tiles of the operator's page: nine places with their keys, as the operator sees them, and the form of one.

mod draft;
mod form;
mod places;

use crate::desk::shown_pad as pad;
use crate::dialogs::{Frame, focus_again};
use crate::icons::Icon;
use crate::operate::words;
use crate::parts::{DeskHold, hold};
use behaviour::{Pad, Tile};
use form::TileForm;
use leptos::html::Div;
use leptos::prelude::*;
use places::Places;

/// The state that the list and the form share.
#[derive(Clone, Copy)]
struct TilesShared {
    desk: DeskHold,
    pad: Memo<Pad>,
    /// The place whose form is open.
    opened: RwSignal<Option<u8>>,
    /// The place whose form was open last: the keyboard goes back there.
    last: StoredValue<Option<u8>>,
    /// Told to who does not see what became of a tile.
    said: RwSignal<String>,
    /// Saves what is in the form, while one is open.
    save: StoredValue<Option<Callback<()>>>,
}

impl TilesShared {
    /// Opens the form of a place.
    fn open(self, key: u8) {
        self.said.set(String::new());
        self.opened.set(Some(key));
    }

    /// Goes back to all tiles, to this one.
    fn back(self, key: u8, said: String) {
        self.last.set_value(Some(key));
        self.save.set_value(None);
        self.said.set(said);
        self.opened.set(None);
    }
}

/// Gives what came into the dialog the keyboard, once it is there.
fn focused() -> NodeRef<Div> {
    let body = NodeRef::<Div>::new();
    Effect::new(move |_| {
        if body.get().is_some() {
            focus_again();
        }
    });
    body
}

/// The dialog.
#[component]
pub(crate) fn EditTiles() -> impl IntoView {
    let desk = hold();
    let shared = TilesShared {
        desk,
        pad: Memo::new(move |_| desk.desk().document.pad()),
        opened: RwSignal::new(None),
        last: StoredValue::new(None),
        said: RwSignal::default(),
        save: StoredValue::new(None),
    };
    let save = Callback::new(move |()| {
        if let Some(save) = shared.save.get_value() {
            save.run(());
        }
    });
    view! {
        <Frame title=words::edit_tiles() save>
            {move || match shared.opened.get() {
                Some(key) => view! { <TileForm shared key /> }.into_any(),
                None => view! { <Places shared /> }.into_any(),
            }}
            <p class="sr" role="status">{move || shared.said.get()}</p>
        </Frame>
    }
}

/// A tile as the operator sees it.
fn picture(desk: DeskHold, tile: &Tile, key: u8) -> impl IntoView + use<> {
    let (icon, _) = pad::pictured(&desk.desk().document.behaviour(), &tile.does);
    let asks = tile.asks.then(words::asks_first);
    view! {
        <span class="tile-kind" data-look=pad::look(&tile.does)><Icon name=icon /></span>
        <span class="tile-words"><b>{tile.label.clone()}</b><small>{asks}</small></span>
        <kbd aria-hidden="true">{key}</kbd>
    }
}
