//! A refused change beside what somebody else saved: both of equal weight, what differs, what each would do, and the choice.

mod rows;
mod values;

use crate::browser;
use crate::conflicts::words;
use crate::desk::{Conflict, initials, wording};
use crate::dialogs::{Frame, Refused, close};
use crate::icons::Icon;
use crate::parts::{DeskHold, hold};
use behaviour::{Behaviour, Change, Id, Kind, Record, RecordId};
use leptos::prelude::*;
use rows::{ConflictRow, DifferingPieces, procedure_text, rows};
use values::{Values, questions};

/// So much of a text stands for it, in characters.
const SUBJECT_CHARS: usize = 40;

/// What is compared. A copy is the same comparison.
#[derive(Clone, Copy)]
struct Both {
    desk: DeskHold,
    op: StoredValue<Id>,
    conflict: Memo<Option<Conflict>>,
    now: Memo<Behaviour>,
    /// Who was first, if that is known.
    by: Memo<Option<String>>,
    /// Whether somebody removed it.
    removed: Memo<bool>,
}

/// The dialog. It is made anew when somebody else was first meanwhile, so that its heading is read again.
#[component]
pub(crate) fn Compare(op: Id) -> impl IntoView {
    let desk = hold();
    let conflict = {
        let op = op.clone();
        Memo::new(move |_| desk.desk().document.conflict(&op))
    };
    let now = Memo::new(move |_| desk.desk().document.as_saved());
    let last = move |conflict: Conflict| Some(desk.desk().document.called(conflict.last_of_theirs()?));
    let by = Memo::new(move |_| conflict.get().and_then(last));
    let removed = Memo::new(move |_| conflict.get().is_some_and(|conflict| conflict.is_removed(&now.read())));
    let both = Both { desk, op: StoredValue::new(op.clone()), conflict, now, by, removed };
    desk.desk().document.conflict_shown(&op);
    Effect::new(move |_| {
        if conflict.read().is_none() && desk.desk().dialog.with_untracked(Option::is_some) {
            close(desk);
        }
    });
    let heading = Memo::new(move |_| (by.get(), removed.get()));
    move || {
        let (by, removed) = heading.get();
        untrack(|| conflict.get()).map(|conflict| view! { <Window both title=title(&conflict, by, removed) /> })
    }
}

fn title(conflict: &Conflict, by: Option<String>, removed: bool) -> String {
    let name = by.unwrap_or_else(|| words::somebody().to_owned());
    let what = what(conflict);
    match (removed, conflict.is_new()) {
        (true, true) => words::removed_its_stream(&name),
        (true, false) => words::removed_it(&name, what),
        (false, _) => words::changed_too(&name, what),
    }
}

/// What kind of thing it is about.
fn what(conflict: &Conflict) -> &'static str {
    match conflict.mine_of(&conflict.about) {
        Some((_, Some(Record::Connector(connector))) | (Some(Record::Connector(connector)), None)) => {
            words::connector_word(connector.operation.spec())
        }
        _ => match conflict.about.kind {
            Kind::Note => words::note_word(),
            Kind::Group => words::group_word(),
            Kind::Settings => words::program_word(),
            Kind::Pad => words::tile_of(),
            _ => words::stream_word(),
        },
    }
}

#[component]
fn Window(both: Both, title: String) -> impl IntoView {
    let theirs_shown = RwSignal::new(false);
    let refusal = RwSignal::new(None::<String>);
    let more = Memo::new(move |_| {
        both.desk.desk().document.conflicts_here().iter().filter(|other| other.waits_unseen()).count()
    });
    let again = move || both.conflict.read().as_ref().is_some_and(|conflict| conflict.again);
    view! {
        <Frame title beside=true save=Callback::new(|()| {})>
            <p class="dialog-under">{move || both.conflict.get().map(|conflict| meanwhile(both, &conflict))}</p>
            <div role="alert">
                <Show when=again><p class="dialog-under changed-again">{words::changed_again()}</p></Show>
            </div>
            <Switch theirs_shown both />
            <div class="dialog-body compare-place" tabindex="0">
                <Table both theirs_shown />
                <Refused why=refusal />
            </div>
            <Show when=move || { more.get() > 0 }>
                <p class="dialog-under second">{move || words::more_after(more.get())}</p>
            </Show>
            <Choice both refusal />
        </Frame>
    }
}

/// "While you were offline, Yuki saved another test for Close ball. Yours waits here."
fn meanwhile(both: Both, conflict: &Conflict) -> impl IntoView + use<> {
    let name = both.by.get().unwrap_or_else(|| words::somebody().to_owned());
    let did = match conflict.mine_of(&conflict.about) {
        _ if both.removed.get() => words::did_remove,
        Some((_, Some(Record::Connector(connector)))) if connector.operation.spec().is_test() => words::saved_test,
        Some((_, Some(Record::Connector(connector)))) if connector.operation.procedure().is_some() => {
            words::saved_procedure
        }
        Some((_, Some(Record::Note(_)))) => words::saved_text,
        Some((_, Some(Record::Group(_) | Record::Settings(_)))) => words::saved_name,
        _ => words::saved_settings,
    };
    let subject = subject(conflict, &both.now.read());
    let (before, after) = words::while_you(conflict.offline, &name, did);
    view! { {before}<b>{subject}</b>{after} }
}

/// The name by which people know it: the stream that it is or leads to.
fn subject(conflict: &Conflict, now: &Behaviour) -> String {
    let Some((seen, mine)) = conflict.mine_of(&conflict.about) else { return String::new() };
    let stream = match mine.or(seen) {
        Some(Record::Note(_) | Record::Group(_) | Record::Settings(_)) => {
            return seen.and_then(wording).map(begun).unwrap_or_default();
        }
        Some(Record::Pad(_)) => return words::the_tiles().to_owned(),
        Some(Record::Connector(connector)) => connector.output.clone(),
        _ => conflict.about.id.clone(),
    };
    let known =
        now.records.get(&RecordId::new(Kind::Stream, &stream)).or(conflict.wanted(&stream)).or(conflict.gone(&stream));
    match known {
        Some(Record::Stream(stream)) => stream.name.clone(),
        _ => what(conflict).to_owned(),
    }
}

/// A text by its beginning.
fn begun(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    match line.char_indices().nth(SUBJECT_CHARS) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}

/// On a phone one of both is shown at a time.
#[component]
fn Switch(both: Both, theirs_shown: RwSignal<bool>) -> impl IntoView {
    let side = move |theirs: bool, label: Signal<String>| {
        view! {
            <label class="segment">
                <input type="radio" name="whose" prop:checked=move || theirs_shown.get() == theirs
                    on:change=move |_| theirs_shown.set(theirs) />
                <span>{label}</span>
            </label>
        }
    };
    view! {
        <fieldset class="compare-switch">
            <legend class="sr">{words::whose_is_shown()}</legend>
            {side(false, Signal::stored(words::yours().to_owned()))}
            {side(true, Signal::derive(move || theirs_of(both)))}
        </fieldset>
    }
}

/// "Yuki’s", or "Theirs" of somebody unknown. Reactive.
fn theirs_of(both: Both) -> String {
    both.by.get().map_or_else(|| words::theirs().to_owned(), |name| words::possessive(&name))
}

#[component]
fn Table(both: Both, theirs_shown: RwSignal<bool>) -> impl IntoView {
    let all =
        Memo::new(move |_| both.conflict.get().map_or_else(Vec::new, |conflict| rows(&conflict, &both.now.read())));
    let questions = Memo::new(move |_| questions(both.desk, &both.conflict.get()?, &both.now.read()));
    view! {
        <table class="compare" aria-label=words::compare_name() class:theirs=move || theirs_shown.get()>
            <thead><tr>
                <th scope="col"><span class="sr">{words::part()}</span></th>
                <th scope="col" data-side="mine">{move || both.conflict.get().map(|conflict| my_head(both, &conflict))}</th>
                <th scope="col" data-side="theirs">{move || both.conflict.get().map(|conflict| their_head(both, &conflict))}</th>
            </tr></thead>
            <tbody>
                {move || all.get().into_iter().map(row).collect_view()}
                <Values questions />
            </tbody>
        </table>
    }
}

fn my_head(both: Both, conflict: &Conflict) -> impl IntoView + use<> {
    let me = both.desk.desk().me.get();
    let (name, color) = me.map_or_else(Default::default, |me| (me.name, me.color));
    let when = browser::clock_words(conflict.made_ms);
    view! { <Sign name color /> <b>{words::yours()}</b>" "<span class="second">{words::not_saved_short()}" · "{when}</span> }
}

fn their_head(both: Both, conflict: &Conflict) -> impl IntoView + use<> {
    let last = conflict.last_of_theirs().cloned();
    let color = last.as_ref().map_or(7, |last| color_of(both, last));
    let when = last.as_ref().map(|last| format!(" · {}", browser::clock_words(last.at_ms as f64)));
    let name = last.map(|last| last.author).unwrap_or_default();
    let word = if both.removed.get() { words::removed_short() } else { words::saved_short() };
    view! { <Sign name color /> <b>{theirs_of(both)}</b>" "<span class="second">{word}{when}</span> }
}

/// The colour of whoever made a change, if they are here. Reactive.
fn color_of(both: Both, change: &Change) -> u8 {
    let people = both.desk.desk().document.people.get();
    people.iter().find(|person| Some(&person.client) == change.by.as_ref()).map_or(7, |person| person.color)
}

#[component]
fn Sign(name: String, color: u8) -> impl IntoView {
    let color = format!("var(--people-{})", color % 8);
    view! { <span class="avatar" aria-hidden="true" style=("--person", color)>{initials(&name)}</span> }
}

fn row(row: ConflictRow) -> impl IntoView {
    let (mine, theirs) = (cell(row.mine, row.code), cell(row.theirs, row.code));
    view! {
        <tr>
            <th scope="row">{row.label}</th>
            <td data-side="mine">{mine}</td>
            <td data-side="theirs">{theirs}</td>
        </tr>
    }
}

fn cell([head, middle, tail]: DifferingPieces, code: bool) -> impl IntoView {
    let middle = (!middle.is_empty()).then(|| view! { <mark>{middle}</mark> });
    view! { <span class:code-text=code>{head}{middle}{tail}</span> }
}

#[component]
fn Choice(both: Both, refusal: RwSignal<Option<String>>) -> impl IntoView {
    let document = move || both.desk.desk().document;
    let copied = RwSignal::new(false);
    let copy =
        move |_| copied.set(both.conflict.get_untracked().is_some_and(|conflict| browser::copy(&text_of(&conflict))));
    let busy = move || both.conflict.read().as_ref().is_some_and(Conflict::is_under_way);
    let take = move |_| document().drop_conflict(&both.op.get_value());
    let keep = move |_| {
        refusal.set(None);
        let can_save = document().can_save();
        document().keep_mine(&both.op.get_value(), move |no| {
            let _ = refusal.try_set(Some(words::told_by(&no)));
        });
        if !can_save {
            close(both.desk);
        }
    };
    let take_word = move || match (both.removed.get(), both.by.get()) {
        (true, _) => words::leave_removed().to_owned(),
        (false, Some(name)) => words::take_of(&name),
        (false, None) => words::take_theirs().to_owned(),
    };
    let keep_word = move || if both.removed.get() { words::bring_back() } else { words::keep_mine() };
    let stays = move || (!both.removed.get()).then(words::stays_in_history);
    view! {
        <div class="dialog-feet compare-feet">
            <button class="button" type="button" on:click=copy><Icon name="copy" />{move || words::copy_button(copied.get())}</button>
            <span class="second apart" role="status">{stays}</span>
            <button class="button" type="button" disabled=busy on:click=take>{take_word}</button>
            <button class="button" type="button" disabled=busy on:click=keep>{keep_word}</button>
        </div>
    }
}

/// One's own, to be put elsewhere: the procedure, or the name.
fn text_of(conflict: &Conflict) -> String {
    match conflict.mine_of(&conflict.about) {
        Some((_, Some(Record::Connector(connector)))) => {
            connector.operation.procedure().map(procedure_text).unwrap_or_default()
        }
        Some((_, Some(Record::Stream(stream)))) => stream.name.clone(),
        Some((_, Some(record))) => wording(record).unwrap_or_default().to_owned(),
        _ => String::new(),
    }
}
