//! The doings of the robot now: in large words, and as the sentences of the program, of which those that happen say *now*. What went
//! wrong stands in the place of the title.

use super::OperateShared;
use super::trouble::Trouble;
use crate::browser;
use crate::operate::words;
use crate::parts::Soon;
use crate::parts::language;
use leptos::prelude::*;
use protocol::{ProgramSentence, answer, request};

/// An action that was fed within this time is said to happen now, in milliseconds.
const NOW_MS: f64 = 1_000.0;
/// So soon after a change the sentences are asked for again, in milliseconds.
const SOON_MS: i32 = 250;
/// Sentences that are shown; more do not fit at arm's length.
const SENTENCES_MAX: usize = 6;

/// A sentence, and when its action was fed last (`performance.now()`), if it was.
type FedSentence = (ProgramSentence, Option<f64>);

#[component]
pub(super) fn Now(op: OperateShared) -> impl IntoView {
    let told = told(op);
    let times = Memo::new(move |_| {
        told.read().iter().map(|sentence| (sentence.clone(), fed(op, sentence))).collect::<Vec<FedSentence>>()
    });
    let quiet = Memo::new(move |_| op.is_quiet());
    let runs = Memo::new(move |_| op.run().is_some());
    let rows = Memo::new(move |_| {
        let all = times.get();
        let newest = newest(&all).map(|(sentence, _)| sentence.clone());
        let row = |(sentence, at): &FedSentence| {
            let text = words::without_code(&format!("{}{}", sentence.lead, sentence.does));
            let is_last = quiet.get() && newest.as_ref() == Some(sentence);
            (text, !quiet.get() && runs.get() && is_now(*at), is_last)
        };
        // Of a robot that is not heard only the last is known.
        all.iter().map(row).filter(|(_, _, last)| *last || !quiet.get()).take(SENTENCES_MAX).collect::<Vec<_>>()
    });
    let ago = move || op.desk.desk().unheard.get().map(words::seconds_ago);
    let row = move |(text, now, last): (String, bool, bool)| {
        view! {
            <li class:now=now class:last=last>
                <span class="op-when">
                    {now.then(|| view! { <i aria-hidden="true"></i>{words::happens_now()} })}
                    {last.then_some(ago)}
                </span>
                <span>{text}</span>
            </li>
        }
    };
    let some = Memo::new(move |_| !rows.read().is_empty());
    let heading = move || if quiet.get() { words::what_it_did_last() } else { words::what_it_does() };
    view! {
        <Trouble op />
        <Show when=move || op.trouble().is_none()>
            <div class="op-title">
                <h1>{move || title(op, &times.read())}</h1>
                <p>{move || under(op, &times.read())}</p>
            </div>
        </Show>
        <super::head::Programs op />
        <Show when=move || some.get()>
            <section class="op-told" aria-labelledby="op-told">
                <h2 id="op-told">{heading}</h2>
                <ul lang=language().code()>{move || rows.get().into_iter().map(row).collect_view()}</ul>
            </section>
        </Show>
    }
}

/// The sentences, asked for again soon after each change of the program or of a helper. The server makes them: what makes
/// sentences is a large part of the code of the page with the graph.
fn told(op: OperateShared) -> RwSignal<Vec<ProgramSentence>> {
    let told = RwSignal::new(Vec::new());
    let of = StoredValue::new(None);
    let ask = move || {
        let Some(open) = op.desk.desk().document.open.get_untracked() else { return told.set(Vec::new()) };
        let (behaviour, language) = (open.clone(), language().code().to_owned());
        op.desk.desk().look_up(request::Told { behaviour, language }, move |answer| {
            let is_open = op.desk.desk().document.open.with_untracked(|now| now.as_ref() == Some(&open));
            if let (Ok(answer::Told { sentences }), true) = (answer, is_open) {
                of.set_value(Some(open));
                if told.try_with_untracked(|old| *old != sentences) == Some(true) {
                    told.set(sentences);
                }
            }
        });
    };
    let soon = StoredValue::new_local(Soon::new(ask));
    Effect::new(move |_| {
        let desk = op.desk.desk();
        desk.document.edited.track();
        desk.library.helpers.track();
        desk.online.track();
        let open = desk.document.open.get();
        if of.get_value() == open {
            soon.with_value(|soon| soon.within(SOON_MS));
        } else {
            // Those of another program are wrong from the first moment.
            of.set_value(open);
            told.set(Vec::new());
            ask();
        }
    });
    told
}

/// When what leads to the action of a sentence passed something on. Reactive, and renewed twice a second.
fn fed(op: OperateShared, sentence: &ProgramSentence) -> Option<f64> {
    let desk = op.desk.desk();
    desk.robots.clock.track();
    let live = desk.document.connector(sentence.connector.as_ref()?)?.live;
    live.with(|live| (live.fired > 0).then_some(live.fired_at))
}

fn is_now(fed: Option<f64>) -> bool {
    fed.is_some_and(|at| browser::now_ms() - at < NOW_MS)
}

/// The one that happened last.
fn newest(all: &[FedSentence]) -> Option<&FedSentence> {
    all.iter()
        .filter(|(_, at)| at.is_some())
        .max_by(|(_, one), (_, other)| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal))
}

/// Says in few large words what the robot does. Reactive.
fn title(op: OperateShared, all: &[FedSentence]) -> String {
    let desk = op.desk.desk();
    if desk.document.open.read().is_none() {
        return words::choose_program().to_owned();
    }
    if let Some(other) = op.other_runs() {
        return words::other_runs(&other);
    }
    if op.run().is_none() {
        return if op.is_paused() { words::goes_on_when_pressed() } else { words::ready_to_start() }.to_owned();
    }
    match newest(all).filter(|(_, at)| is_now(*at)) {
        Some((sentence, _)) => action_words(sentence),
        None => words::waits_for_something().to_owned(),
    }
}

/// Returns what a sentence says that is done: its last words.
fn action_words(sentence: &ProgramSentence) -> String {
    let text = words::without_code(&sentence.does);
    words::capitalised(text.trim().trim_end_matches(['.', '。', ',', '、']))
}

/// When it does that, or how it stands. Reactive.
fn under(op: OperateShared, all: &[FedSentence]) -> String {
    let desk = op.desk.desk();
    if desk.document.open.read().is_none() {
        return words::choose_program_says().to_owned();
    }
    if op.run().is_none() {
        let start = if op.other_runs().is_some() { words::ready_to_start() } else { words::press_start() };
        return op.why_not_start().unwrap_or_else(|| start.to_owned());
    }
    match newest(all).filter(|(_, at)| is_now(*at)) {
        Some((sentence, _)) => lead_words(sentence),
        None => words::senses_nothing_now().to_owned(),
    }
}

/// Returns what a sentence says before that: when it is done.
fn lead_words(sentence: &ProgramSentence) -> String {
    words::without_code(&sentence.lead).trim().trim_end_matches([',', '、']).to_owned()
}
