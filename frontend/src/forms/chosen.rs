//! Several things that are chosen, a note or a group, in the right column.

use crate::desk::{GroupSignals, NoteSignals, Selected};
use crate::forms::words;
use crate::icons::Icon;
use crate::layout::chip_words;
use crate::parts::{DeskHold, MayNot, author_color, device_icon, hold, kind_class, may_edit, written_by};
use behaviour::Id;
use leptos::prelude::*;
use std::collections::BTreeSet;

/// So many things are listed.
const SHOWN_MAX: usize = 60;

/// What is chosen together, as a view.
pub(crate) fn chosen() -> AnyView {
    view! { <Chosen /> }.into_any()
}

#[component]
fn Chosen() -> impl IntoView {
    let desk = hold();
    let several = Memo::new(move |_| desk.desk().document.several.get());
    let count = move || several.read().len();
    let rows = move || several.get().into_iter().take(SHOWN_MAX).map(|one| row(desk, one)).collect_view();
    let more = move || count().checked_sub(SHOWN_MAX).filter(|more| *more > 0);
    let only_streams = move || several.read().iter().any(|one| !matches!(one, Selected::Connector(_)));
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2>{move || words::selected_count(count())}</h2>
            <ul class="chosen-list">{rows}</ul>
            {move || more().map(|more| view! { <p class="faint">{words::and_more(more as u64)}</p> })}
            <Show when=only_streams>
                <button class="button small" type="button" disabled=move || !may_edit(desk)
                    on:click=move |_| desk.desk().document.make_group(&several.get_untracked())>
                    <Icon name="group" />
                    {words::make_group()}
                </button>
            </Show>
            <MayNot />
        </section>
    }
}

/// A thing by its name; pressed, it alone is chosen.
fn row(desk: DeskHold, what: Selected) -> impl IntoView {
    let (icon, class, name) = shown(desk, &what);
    let go = move |_| desk.desk().document.choose([what.clone()].into());
    let title = name.clone();
    view! {
        <li><button class="item" type="button" title=title on:click=go>
            <span class=class>{icon.map(|icon| view! { <Icon name=icon /> })}</span>
            <span class="cut">{name}</span>
        </button></li>
    }
}

/// The icon of something, the class of that, and its name. Reactive.
fn shown(desk: DeskHold, what: &Selected) -> (Option<&'static str>, String, String) {
    let document = desk.desk().document;
    let plain = |icon, name| (Some(icon), "kind plain".to_owned(), name);
    let found = match what {
        Selected::Stream(id) => document.stream(id).map(|signals| {
            let stream = signals.record.get();
            (device_icon(&stream), format!("kind {}", kind_class(stream.kind)), stream.name)
        }),
        Selected::Connector(id) => document.connector(id).map(|signals| {
            let record = signals.record.get();
            plain(record.operation.spec().icon.name, chip_words(&record).whole())
        }),
        Selected::Note(id) => {
            document.note_signals(id).map(|at| plain("note", at.record.with(|note| note.text.clone())))
        }
        Selected::Group(id) => document.group(id).map(|at| plain("group", at.record.with(|group| group.title.clone()))),
    };
    found.unwrap_or_default()
}

/// A note that is selected.
#[component]
pub(super) fn NotePanel(id: Id, signals: NoteSignals) -> impl IntoView {
    let desk = hold();
    let (text, foot, by) = (signals.record.clone(), signals.record.clone(), signals.record);
    let color = move || by.with(|note| author_color(&desk.desk(), &note.by));
    let gone = Selected::Note(id);
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2><Icon name="note" /> {words::a_note()}</h2>
            <p class="note-panel" style=("--person", color)>{move || text.with(|note| note.text.clone())}</p>
            <p class="faint">{move || foot.with(written_by)}</p>
            <div class="row">
                <button class="button small" type="button" disabled=move || !may_edit(desk)
                    on:click=move |_| desk.desk().document.remove(&gone)>
                    <Icon name="trash" />
                    {words::remove()}
                </button>
            </div>
            <MayNot />
        </section>
    }
}

/// A group that is selected, with what is in it.
#[component]
pub(super) fn GroupPanel(id: Id, signals: GroupSignals) -> impl IntoView {
    let desk = hold();
    let (of, folded) = (id.clone(), id.clone());
    let title = signals.record;
    let members = Memo::new(move |_| desk.desk().document.members(&of));
    let is_folded = Memo::new(move |_| desk.desk().document.is_folded(&folded));
    let rows =
        move || members.get().into_iter().take(SHOWN_MAX).map(|id| row(desk, Selected::Stream(id))).collect_view();
    let word = move || if is_folded.get() { words::unfold() } else { words::fold() };
    let these: BTreeSet<Selected> = [Selected::Group(id.clone())].into();
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2><Icon name="group" /> <span class="cut">{move || title.with(|group| group.title.clone())}</span></h2>
            <p class="second">{move || words::streams(members.read().len() as u32)}</p>
            <ul class="chosen-list">{rows}</ul>
            <div class="row">
                <button class="button small" type="button"
                    on:click=move |_| desk.desk().document.fold(&id, !is_folded.get_untracked())>
                    {move || view! { <Icon name=if is_folded.get() { "unfold" } else { "fold" } /> }}
                    {word}
                </button>
                <button class="button small" type="button" disabled=move || !may_edit(desk)
                    on:click=move |_| desk.desk().document.ungroup(&these)>
                    <Icon name="ungroup" />
                    {words::ungroup()}
                </button>
            </div>
            <MayNot />
        </section>
    }
}
