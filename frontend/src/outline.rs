//! The program as an indented list: the phone's view and the one for screen readers. Same gestures as the canvas.

mod aside;
mod keys;
mod row_menu;
mod rows;
mod strip;
mod words;

use crate::browser::pasted;
use crate::desk::Dialog;
use crate::focus;
use crate::graph::PaperTitle;
use crate::icons::Icon;
use crate::later::{Later, second_piece};
use crate::library::EmptyStage;
use crate::parts::{DeskHold, hold, may_edit, problem_count};
use aside::{AddNote, GroupRow, NoteRow};
use behaviour::Id;
use editor::outline::{OutlineNode, OutlineRowKind, outline as outline_rows};
use leptos::prelude::*;
pub(crate) use row_menu::row_menu;
use rows::{ConnectorRow, StreamRow};
use std::time::Duration;
use web_sys::FocusOptions;

/// What is opened is shown from its beginning, and has the keyboard if nothing else has it.
fn begin_at_top(desk: DeskHold) {
    Effect::new(move |before: Option<Option<Id>>| {
        let open = desk.desk().document.open.get();
        if open.is_some() && before.is_some_and(|before| before != open) {
            let _ = request_animation_frame(move || {
                window().scroll_to_with_x_and_y(0.0, 0.0);
                if let Some(stage) = focus::by_id("stage").filter(|_| focus::is_nowhere()) {
                    let how = FocusOptions::new();
                    how.set_prevent_scroll(true);
                    let _ = stage.focus_with_options(&how);
                }
            });
        }
        open
    });
}

/// The program as a list, as a view.
pub(crate) fn outline() -> AnyView {
    view! { <Outline /> }.into_any()
}

/// The program as a list.
#[component]
fn Outline() -> impl IntoView {
    let desk = hold();
    let (piece, pastes) = (second_piece(), second_piece());
    let nodes = Memo::new(move |_| {
        let desk = desk.desk();
        desk.document.revision.track();
        desk.document.stream_ids.track();
        desk.document.connector_ids.track();
        desk.document.hidden.track();
        desk.document.note_ids.track();
        desk.document.group_ids.track();
        outline_rows(&desk.document.behaviour(), |id| untrack(|| desk.document.is_folded(id)))
    });
    // What is looked for is shown, whatever is folded around it.
    Effect::new(move |_| {
        let document = desk.desk().document;
        let selected = document.selected.get();
        if let Some(group) = selected.and_then(|selected| untrack(|| document.folded_away(&selected))) {
            document.unfold_here(&group);
        }
    });
    let is_open = Memo::new(move |_| desk.desk().document.open.read().is_some());
    begin_at_top(desk);
    // What is asked for anywhere is chosen in a dialog here.
    Effect::new(move |_| {
        if let Some(choice) = desk.desk().asked.get() {
            desk.desk().asked.set(None);
            desk.desk().dialog.set(Some(Dialog::Choose(choice)));
        }
    });
    let tick = RwSignal::new(0_u32);
    if let Ok(handle) = set_interval(move || tick.update(|tick| *tick += 1), Duration::from_secs(1)) {
        on_cleanup(move || handle.clear());
    }
    let row = move |node: OutlineNode| {
        let indent = format!("{}px", node.depth.min(8) * 22);
        let inside = match node.what {
            OutlineRowKind::Stream(id) => view! { <StreamRow id again=node.again tick /> }.into_any(),
            OutlineRowKind::Connector(id) => view! { <ConnectorRow id /> }.into_any(),
            OutlineRowKind::Group(id) => view! { <GroupRow id /> }.into_any(),
            OutlineRowKind::Note(id) => view! { <NoteRow id /> }.into_any(),
        };
        view! { <li style:padding-left=indent><span class="sr">{words::level(node.depth + 1)}</span>{inside}</li> }
    };
    view! {
        <main class="stage" id="stage" tabindex="-1" aria-label=words::outline_name()
            on:keydown=move |event| keys::key(&event, &desk.desk(), &piece)
            on:paste=move |event| {
                if let Some(text) = pasted(event.as_ref()) {
                    pastes.when_here(move |rest| {
                        if let Some(rest) = rest {
                            (rest.paste)(&desk.desk(), None, &text);
                        }
                    });
                }
            }>
            <PaperTitle />
            <EmptyStage />
            {move || is_open.get().then(|| view! { <Later show=|rest| (rest.sentences_panel)() /> })}
            <ProblemCount />
            <ul class="outline"><For each=move || nodes.get() key=|node| node.clone() children=row /></ul>
            <Show when=move || is_open.get() && may_edit(desk)><div class="add-note"><AddNote /></div></Show>
        </main>
    }
}

/// How many problems there are, with the way to them; nothing while there are none.
#[component]
fn ProblemCount() -> impl IntoView {
    let desk = hold();
    let count = Memo::new(move |_| problem_count(desk));
    let list = move |_| desk.desk().dialog.set(Some(Dialog::Problems));
    view! {
        <Show when=move || { count.get() > 0 }>
            <button type="button" class="button problem-count" on:click=list>
                <Icon name="warn" />
                {words::problems()} " " <span class="number">{move || count.get()}</span>
            </button>
        </Show>
    }
}
