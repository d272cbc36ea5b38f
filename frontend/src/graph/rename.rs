//! Another name for a stream or group, typed where it stands.

use super::Stage;
use super::bounds::bounds;
use crate::desk::{Desk, use_desk};
use crate::escape;
use crate::focus;
use crate::graph::words;
use crate::keys::PressedKey;
use crate::layout::{BOX, stream_width, text_width};
use behaviour::{Id, Kind, NAME_MAX_CHARS, Place, RecordId, Stream};
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;
use web_sys::KeyboardEvent;

/// Room for a longer name beside what is there, in canvas units.
const ROOM: f64 = 60.0;

impl Stage {
    /// Begins to rename a stream or group.
    pub(super) fn rename(&self, id: &Id) {
        let document = &self.desk.document;
        let (kind, what) = match (document.stream(id), document.group(id)) {
            (Some(stream), _) => (Kind::Stream, stream.record.with_untracked(|stream| stream.name.clone())),
            (None, Some(group)) => (Kind::Group, group.record.with_untracked(|group| group.title.clone())),
            (None, None) => return,
        };
        if untrack(|| self.desk.may(Role::Editor)) && !document.says_busy(&RecordId::new(kind, id), &what) {
            self.renaming.set(Some(id.clone()));
        }
    }
}

/// The thing that is renamed: its name, where its field is and how wide, and how its new name is saved.
struct Renamed {
    name: String,
    width: f64,
    /// The middle of the field's top edge. Reactive.
    at: ArcMemo<Place>,
    save: Box<dyn Fn(&str) + Send + Sync>,
}

fn renamed(desk: &Desk, id: &Id) -> Option<Renamed> {
    let (saver, of) = (desk.clone(), id.clone());
    if let Some(signals) = desk.document.stream(id) {
        let seen = signals.record.get_untracked();
        let (name, width, place) = (seen.name.clone(), stream_width(&seen) + ROOM, signals.place);
        let at = ArcMemo::new(move |_| place.get());
        return Some(Renamed { name, width, at, save: Box::new(move |name| save(&saver, &of, &seen, name)) });
    }
    let seen = desk.document.group(id)?.record.get_untracked();
    let name = seen.title.clone();
    let around = bounds(desk, id)?;
    let width = (text_width(&name, 15) + 2.0 * ROOM).min(BOX.0);
    let at = Place { x: around.left + width / 2.0, y: around.top - 6.0 };
    let save = Box::new(move |name: &str| saver.document.retitle(&of, seen.clone(), name));
    Some(Renamed { name, width, at: ArcMemo::new(move |_| at), save })
}

/// The field for the new name, over what has it.
pub(crate) fn name_field(id: Id) -> AnyView {
    view! { <NameField id /> }.into_any()
}

#[component]
fn NameField(id: Id) -> impl IntoView {
    let desk = use_desk();
    let stage = expect_context::<Stage>();
    let Some(Renamed { name, width, at, save }) = renamed(&desk, &id) else { return ().into_any() };
    let kind = if desk.document.stream(&id).is_some() { Kind::Stream } else { Kind::Group };
    let session = desk.document.session(RecordId::new(kind, &id));
    session.begin();
    let (ended, types) = (session.clone(), session.clone());
    on_cleanup(move || session.end());
    let field = NodeRef::<leptos::html::Input>::new();
    let first = name.clone();
    Effect::new(move |_| {
        if let Some(field) = field.get() {
            // The text is put into the field after this; what somebody typed or chose in it meanwhile stays.
            let first = first.clone();
            let _ = request_animation_frame(move || {
                let is_there = focus::is_at(&field);
                let _ = field.focus();
                if !is_there && field.value() == first {
                    field.select();
                }
            });
        }
    });
    let over = stage.renaming.clone();
    let end = std::sync::Arc::new(move |name: Option<String>| {
        // Leaving follows Enter and Escape: only the first of them counts.
        if over.with_untracked(Option::is_none) {
            return;
        }
        over.set(None);
        if let Some(name) = name {
            save(&name);
        }
        ended.end();
        stage.focus(&id);
    });
    let (keys, leave) = (end.clone(), end);
    // What is typed is asked of the event: when the field goes, it is left once more, and nothing of it is here any more.
    let key = move |event: KeyboardEvent| {
        event.stop_propagation();
        if event.pressed() == "Enter" {
            keys(typed(&event));
        }
        escape::ends(&event, || keys(None));
    };
    view! {
        <input class="rename" type="text" node_ref=field maxlength=NAME_MAX_CHARS.to_string() aria-label=words::new_name(&name)
            prop:value=name style:width=format!("{width:.0}px")
            style:transform=move || { let at = at.get(); format!("translate({:.1}px,{:.1}px) translateX(-50%)", at.x, at.y) }
            on:keydown=key on:input=move |_| types.typing() on:blur=move |event| leave(typed(&event)) />
    }
    .into_any()
}

/// Returns the text in the field that an event is about.
fn typed(event: &web_sys::Event) -> Option<String> {
    Some(event.target()?.dyn_into::<web_sys::HtmlInputElement>().ok()?.value())
}

fn save(desk: &Desk, id: &Id, seen: &Stream, name: &str) {
    let name = name.trim();
    if name.is_empty() || name == seen.name {
        return;
    }
    let after = desk.clone();
    let renamed = Stream { name: name.to_owned(), ..seen.clone() };
    desk.document.edit_stream((id, seen.clone()), renamed, move |answer| after.say_refusal(answer));
}
