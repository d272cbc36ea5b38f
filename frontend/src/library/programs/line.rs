//! One line of the list: a small picture, the name, and who changed it when.

use super::shelf::{ShelfPlace, ShownShelf};
use super::window::LINE_PX;
use crate::browser;
use crate::dialogs::close;
use crate::icons::Icon;
use crate::library::empty::ProgramPicture;
use crate::library::open_program;
use crate::library::words;
use crate::parts::{hold, may_edit};
use leptos::prelude::*;
use protocol::Summary;

/// How long a removed program can be taken back, in days.
const BIN_DAYS: u64 = 30;

/// The line at a place of the list; it shows whatever program comes to stand there.
#[component]
pub(super) fn Line(shown: ShownShelf, place: usize) -> impl IntoView {
    let line = Memo::new(move |_| shown.lines.with(|lines| lines.get(place).cloned()));
    let is_bin = shown.place.get_untracked() == ShelfPlace::Bin;
    let content = move || {
        let summary = line.get()?;
        let inside = if is_bin {
            view! { <Removed shown summary place /> }.into_any()
        } else {
            view! { <Program shown summary place /> }.into_any()
        };
        Some(inside)
    };
    view! {
        <li class="program-line" style:transform=format!("translateY({}px)", place as f64 * LINE_PX)
            aria-posinset=(place + 1).to_string() aria-setsize=move || shown.size().to_string()>
            {content}
        </li>
    }
}

/// A program to open.
#[component]
fn Program(shown: ShownShelf, summary: Summary, place: usize) -> impl IntoView {
    let desk = hold();
    let note = words::program_line(&summary.owner, summary.streams, &when(summary.changed_ms), &summary.by);
    let title = format!("{}\n{note}", summary.name);
    let label = words::more_about(&summary.name);
    let id = summary.id.clone();
    let open = move |_| {
        close(desk);
        open_program(&desk.desk(), &id);
    };
    let more = {
        let summary = summary.clone();
        move |_| shown.details.set(Some(summary.clone()))
    };
    let stop = move || if shown.active.get() == place { "0" } else { "-1" };
    view! {
        <button id=line_id(place) class="program-open" type="button" title=title tabindex=stop
            on:focus=move |_| shown.active.set(place) on:click=open>
            <ProgramPicture id=summary.id revision=summary.revision />
            <span class="two"><b class="cut">{summary.name}</b><span class="second cut">{note}</span></span>
            {(!summary.tags.is_empty()).then(|| view! { <TagChips tags=summary.tags /> })}
        </button>
        <button class="tool icon" type="button" title=label.clone() aria-label=label tabindex=stop on:click=more>
            <Icon name="more" />
        </button>
    }
}

/// The tags of a program, to read.
#[component]
fn TagChips(tags: Vec<String>) -> impl IntoView {
    let chip = |tag: String| view! { <span class="tag">{tag}</span> };
    view! { <span class="tags">{tags.into_iter().map(chip).collect_view()}</span> }
}

/// A program in the bin.
#[component]
fn Removed(shown: ShownShelf, summary: Summary, place: usize) -> impl IntoView {
    let desk = hold();
    let gone_days = (browser::today_ms() as u64).saturating_sub(summary.changed_ms) / 86_400_000;
    let note = words::removed_line(&when(summary.changed_ms), &summary.by, BIN_DAYS.saturating_sub(gone_days));
    let title = format!("{}\n{note}", summary.name);
    let label = words::restore_named(&summary.name);
    let (id, revision, name) = (summary.id.clone(), summary.revision, summary.name.clone());
    let restore = move |_| desk.desk().library.restore_program(&summary);
    let stop = move || if shown.active.get() == place { "0" } else { "-1" };
    view! {
        <div class="program-open" title=title>
            <ProgramPicture id revision />
            <span class="two"><b class="cut">{name}</b><span class="second cut">{note}</span></span>
        </div>
        <button id=line_id(place) class="button small" type="button" title=label.clone() aria-label=label tabindex=stop
            disabled=move || !may_edit(desk) on:focus=move |_| shown.active.set(place) on:click=restore>
            <Icon name="undo" />
            {words::restore()}
        </button>
    }
}

/// When something was, in words.
pub(super) fn when(changed_ms: u64) -> String {
    let seconds = (browser::today_ms() as u64).saturating_sub(changed_ms) / 1_000;
    words::ago(seconds).unwrap_or_else(|| words::on_day(&browser::day_words(changed_ms as f64)))
}

/// The id of the button of a line.
pub(super) fn line_id(line: usize) -> String {
    format!("program-line-{line}")
}
