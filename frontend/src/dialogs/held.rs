//! Who may write in an editor: while somebody else is editing, one reads what is saved and can ask for it; who is asked
//! hands it over or keeps it.

use super::frame::focus_again;
use crate::browser;
use crate::desk::{Asking, EditReading, OwnLock, WriteRight};
use crate::dialogs::words;
use crate::focus;
use crate::icons::Icon;
use crate::parts::{DeskHold, MayNot, may_edit};
use behaviour::RecordId;
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;

/// The lock of what a dialog edits, taken for as long as the dialog is open. A copy is the same one.
#[derive(Clone, Copy)]
pub(crate) struct DialogLock {
    desk: DeskHold,
    /// Whether this person may edit at all.
    may: bool,
    writing: Memo<Option<WriteRight>>,
    /// Somebody else may write, so this one only reads.
    pub(crate) reads: Memo<bool>,
    /// What is saved is shown as it changes; what was one's own until now stays instead.
    pub(crate) follows: Memo<bool>,
}

impl DialogLock {
    /// Takes the lock; what is new has none.
    pub(crate) fn of(desk: DeskHold, record: Option<RecordId>) -> Self {
        let document = desk.desk().document;
        let may = untrack(|| may_edit(desk));
        let number = record.filter(|_| may).map(|record| document.open_editor(record));
        if let Some(number) = number {
            let document = document.clone();
            on_cleanup(move || document.close_editor(number));
        }
        let editing = document.editing.clone();
        let writing = Memo::new(move |_| {
            let editing = editing.get()?;
            (Some(editing.number) == number).then_some(editing.writing)
        });
        let reads = Memo::new(move |_| !may || matches!(writing.get(), Some(WriteRight::No(_))));
        let follows =
            Memo::new(move |_| !may || matches!(writing.get(), Some(WriteRight::No(reading)) if !reading.was_own));
        Effect::new(move |before: Option<bool>| {
            let now = reads.get();
            if before.is_some_and(|before| before != now) {
                focus_again();
            }
            now
        });
        Self { desk, may, writing, reads, follows }
    }

    fn reading(self) -> Option<EditReading> {
        match self.writing.get() {
            Some(WriteRight::No(reading)) => Some(reading),
            _ => None,
        }
    }

    /// Whether one asked and was not answered yet.
    fn waits(self) -> bool {
        self.reading().is_some_and(|reading| matches!(reading.asking, Asking::Waits { .. } | Asking::Queued))
    }

    fn own(self) -> Option<OwnLock> {
        match self.writing.get() {
            Some(WriteRight::Own(own)) => Some(own),
            _ => None,
        }
    }

    /// The seconds that are left until then. Reactive.
    fn left(self, until_ms: f64) -> u32 {
        let clock = self.desk.desk().document.lock_clock.get();
        ((until_ms - clock.max(browser::now_ms() - 500.0)) / 1_000.0).ceil().max(0.0) as u32
    }
}

/// Everything that is said about who may write, above the fields.
#[component]
pub(crate) fn Holding(held: DialogLock, #[prop(into)] written: Signal<String>) -> impl IntoView {
    let asker = Memo::new(move |_| held.own().and_then(|own| own.asker));
    let free = Memo::new(move |_| held.own().and_then(|own| own.free_ms));
    let said = said(held);
    // Who only read may write now: it is said where they asked, and nothing moves under their hand.
    let has_read = Memo::new(move |before: Option<&bool>| {
        before.copied().unwrap_or_default() || (held.may && matches!(held.writing.get(), Some(WriteRight::No(_))))
    });
    view! {
        <Show when=move || has_read.get()><ReadOnly held written /></Show>
        {(!held.may).then(|| view! { <div class="held"><MayNot /></div> })}
        <Show when=move || asker.read().is_some()><Wanted held asker /></Show>
        <Show when=move || free.get().is_some() && asker.read().is_none()><Idle held free /></Show>
        <p class="sr" role="status">{move || said.get().1}</p>
    }
}

/// Who is editing, what one sees meanwhile, and the way to ask for it.
#[component]
fn ReadOnly(held: DialogLock, written: Signal<String>) -> impl IntoView {
    let copied = RwSignal::new(false);
    let copy = move |_| copied.set(browser::copy(&written.get_untracked()));
    let name = Memo::new(move |_| held.reading().and_then(|reading| reading.by));
    let is_yours = move || !held.reads.get();
    let sentence = move || held.reading().map_or_else(|| words::yours_now().to_owned(), |reading| meanwhile(&reading));
    view! {
        <div class="held">
            <p>
                {move || name.get().map(|name| view! { <EditedBy held name /> })}
                <span>{sentence}</span>
            </p>
            <div class="row" class:reserved=is_yours>
                <AskButton held />
                <AskNoMore held />
                <button class="button" type="button" on:click=copy>
                    {move || if copied.get() { words::copied() } else { words::copy() }}
                </button>
            </div>
            <p class="faint held-says">{move || held.reading().and_then(|reading| beside(held, &reading))}</p>
            <TakeOver held name />
        </div>
    }
}

/// For the person at the server's computer: takes it from who is editing, asking once.
#[component]
fn TakeOver(held: DialogLock, name: Memo<Option<String>>) -> impl IntoView {
    let asked = RwSignal::new(false);
    let may = move || held.desk.desk().role.get() == Some(Role::Host) && name.read().is_some();
    let take = move |_| {
        asked.set(false);
        held.desk.desk().document.take_over();
    };
    let question = move || name.get().map(|name| words::take_over_question(&name));
    view! {
        <Show when=move || may() && !asked.get()>
            <div><button class="link take-over" type="button" on:click=move |_| asked.set(true)>{words::take_over()}</button></div>
        </Show>
        <Show when=move || may() && asked.get()>
            <div class="take-over">
                <p role="status">{question}</p>
                <div class="row">
                    <button class="button danger" type="button" on:click=take>{words::take_it()}</button>
                    <button class="button" type="button" on:click=move |_| asked.set(false)>{words::leave_it()}</button>
                </div>
            </div>
        </Show>
    }
}

/// The name of who is editing, in their colour.
#[component]
fn EditedBy(held: DialogLock, name: String) -> impl IntoView {
    let color = {
        let name = name.clone();
        move || {
            let editors = held.desk.desk().document.edited_by_others();
            let color =
                editors.into_iter().find(|(_, editor)| editor.name == name).map_or(0, |(_, editor)| editor.color);
            format!("var(--people-{color})")
        }
    };
    view! {
        <span class="who-tag" style=("--person", color)><Icon name="lock" />{words::is_editing(&name)}</span>
    }
}

/// Asks, counts down, or begins to edit what is free again. It stays one button, so that it keeps the keyboard.
#[component]
fn AskButton(held: DialogLock) -> impl IntoView {
    let is_free = move || held.reading().is_some_and(|reading| reading.by.is_none());
    let rests = move || held.reading().is_some_and(|reading| reading.by.is_some() && reading.asking != Asking::No);
    let press = move |_| {
        let document = held.desk.desk().document;
        if untrack(is_free) {
            document.take_lock();
        } else if !untrack(rests) {
            document.ask_for();
        }
    };
    view! {
        <button class="button primary ask" type="button" aria-disabled=move || rests().then_some("true") on:click=press>
            {move || held.reading().map(|reading| label(held, &reading))}
        </button>
    }
}

/// Takes the question back. Its place is kept, so that nothing moves when it comes.
#[component]
fn AskNoMore(held: DialogLock) -> impl IntoView {
    let press = move |event: web_sys::MouseEvent| {
        // It goes, and what it takes back can be asked again beside it.
        let ask =
            event.current_target().and_then(|own| own.dyn_into::<web_sys::Element>().ok()?.previous_element_sibling());
        if let Some(ask) = ask.and_then(|ask| ask.dyn_into::<web_sys::HtmlElement>().ok()) {
            focus::focus(&ask);
        }
        held.desk.desk().document.ask_no_more();
    };
    view! {
        <button class="button" type="button" class:reserved=move || !held.waits() on:click=press>{words::ask_no_more()}</button>
    }
}

/// Somebody asks for what is edited here.
#[component]
fn Wanted(held: DialogLock, asker: Memo<Option<String>>) -> impl IntoView {
    let answer = move |yes: bool| held.desk.desk().document.hand_over(yes);
    let is_last = Memo::new(move |_| held.own().is_some_and(|own| own.is_last));
    let meaning = move || if is_last.get() { words::last_moment() } else { words::silence_means_yes() };
    let keep = move || view! { <button class="button" type="button" on:click=move |_| answer(false)>{words::keep_it()}</button> };
    view! {
        <div class="held wanted">
            <p><b>{move || asker.get().map(|name| words::would_like_to_edit(&name))}</b></p>
            <div class="row">
                <button class="button" type="button" on:click=move |_| answer(true)>{words::hand_over()}</button>
                <Show when=move || !is_last.get()>{keep()}</Show>
                <span class="faint">{meaning}</span>
            </div>
        </div>
    }
}

/// Nothing was typed for long.
#[component]
fn Idle(held: DialogLock, free: Memo<Option<f64>>) -> impl IntoView {
    let stay = move |_| held.desk.desk().document.typing();
    view! {
        <div class="held">
            <div class="row">
                <span>{move || free.get().map(|until| words::free_for_others_in(held.left(until)))}</span>
                <button class="button" type="button" on:click=stay>{words::still_editing()}</button>
            </div>
        </div>
    }
}

fn meanwhile(reading: &EditReading) -> String {
    match (&reading.by, reading.was_own) {
        (Some(name), false) => words::until_saved(name),
        (Some(_), true) => words::text_stays().to_owned(),
        (None, false) => words::nobody_edits().to_owned(),
        (None, true) => words::free_text_stays().to_owned(),
    }
}

/// What the button says. Reactive.
fn label(held: DialogLock, reading: &EditReading) -> String {
    match (&reading.by, reading.asking) {
        (Some(_), Asking::Waits { until_ms }) => words::asked_yours_in(held.left(until_ms)),
        (Some(_), Asking::Queued) => words::asked_before().to_owned(),
        (Some(name), Asking::No | Asking::Kept { .. } | Asking::Full) => words::ask_person(name),
        (None, _) if reading.was_own => words::go_on_editing().to_owned(),
        (None, _) => words::edit_it().to_owned(),
    }
}

/// What stands beside the button. Reactive.
fn beside(held: DialogLock, reading: &EditReading) -> Option<String> {
    let name = reading.by.as_ref()?;
    match reading.asking {
        Asking::No | Asking::Waits { .. } => Some(words::silence_means_yes().to_owned()),
        Asking::Queued => None,
        Asking::Kept { again_ms } => {
            Some(format!("{} {}", words::keeps_for_now(name), words::ask_again_in(held.left(again_ms))))
        }
        Asking::Full => Some(words::enough_wait().to_owned()),
    }
}

/// Whether one only read, and what is said aloud, once each: no numbers that count down.
fn said(held: DialogLock) -> Memo<(bool, String)> {
    Memo::new(move |before: Option<&(bool, String)>| match held.writing.get() {
        Some(WriteRight::No(reading)) => (true, said_to_reader(&reading)),
        Some(WriteRight::Own(own)) => (false, said_to_owner(&own, before.is_some_and(|before| before.0))),
        Some(WriteRight::Opening | WriteRight::Free) | None => (false, String::new()),
    })
}

fn said_to_owner(own: &OwnLock, only_read: bool) -> String {
    match &own.asker {
        Some(name) => words::would_like_to_edit(name),
        None if own.free_ms.is_some() => words::idle_free().to_owned(),
        None if only_read => words::yours_now().to_owned(),
        None => String::new(),
    }
}

fn said_to_reader(reading: &EditReading) -> String {
    match (&reading.by, reading.asking) {
        (Some(_), Asking::Waits { .. } | Asking::Queued) => words::silence_means_yes().to_owned(),
        (Some(name), Asking::Kept { .. }) => words::keeps_for_now(name),
        (Some(name), Asking::No | Asking::Full) => words::is_editing_and(name, &meanwhile(reading)),
        (None, _) => meanwhile(reading),
    }
}
