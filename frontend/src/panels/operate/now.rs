//! The doings of the robot now: in large words, and as the sentences of the program, of which those that happen say *now*. What went
//! wrong stands in the place of the title.

use super::OperateShared;
use super::trouble::Trouble;
use crate::browser;
use crate::panels::hold::Soon;
use crate::panels::language::language;
use crate::words;
use behaviour::Helper;
use leptos::prelude::*;
use sentences::Sentence;

/// An action that was fed within this time is said to happen now, in milliseconds.
const NOW_MS: f64 = 1_000.0;
/// So soon after a change the sentences are made again, in milliseconds.
const SOON_MS: i32 = 60;
/// Sentences that are shown; more do not fit at arm's length.
const SENTENCES_MAX: usize = 6;

/// A sentence, and when its action was fed last (`performance.now()`), if it was.
type FedSentence = (Sentence, Option<f64>);

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
            let text = words::without_code(&sentence.to_string());
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

/// The sentences, made again soon after each change of the program or of a helper.
fn told(op: OperateShared) -> RwSignal<Vec<Sentence>> {
    let told = RwSignal::new(Vec::new());
    let make = move || {
        let desk = op.desk.desk();
        let behaviour = desk.document.behaviour();
        let made = desk.library.helpers.with_untracked(|helpers| {
            let helpers: Vec<&Helper> = helpers.iter().map(|(_, helper)| helper).collect();
            let unit = |id: &_| Some(untrack(|| desk.document.unit(id))).filter(|unit| !unit.is_empty());
            sentences::explain(&behaviour, &helpers, &|id| unit(id).map(str::to_owned), language())
        });
        if told.try_with_untracked(|old| *old != made) == Some(true) {
            told.set(made);
        }
    };
    make();
    let soon = StoredValue::new_local(Soon::new(make));
    Effect::new(move |_| {
        let desk = op.desk.desk();
        desk.document.edited.track();
        desk.document.open.track();
        desk.library.helpers.track();
        desk.document.types.track();
        soon.with_value(|soon| soon.within(SOON_MS));
    });
    told
}

/// When what leads to the action of a sentence passed something on. Reactive, and renewed twice a second.
fn fed(op: OperateShared, sentence: &Sentence) -> Option<f64> {
    let desk = op.desk.desk();
    desk.robots.clock.track();
    let connector = sentence.phrases.last()?.connectors.first()?.clone();
    let live = desk.document.connector(&connector)?.live;
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
fn action_words(sentence: &Sentence) -> String {
    let last = sentence.phrases.iter().rfind(|phrase| phrase.streams.contains(&sentence.action));
    let last = last.or(sentence.phrases.last());
    let text: String = last.into_iter().flat_map(|phrase| &phrase.pieces).map(|piece| piece.text()).collect();
    let text = words::without_code(&text);
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
fn lead_words(sentence: &Sentence) -> String {
    let action = sentence.phrases.iter().rposition(|phrase| phrase.streams.contains(&sentence.action));
    let before = action.unwrap_or(sentence.phrases.len().saturating_sub(1));
    let text: String =
        sentence.phrases[..before].iter().flat_map(|phrase| &phrase.pieces).map(|piece| piece.text()).collect();
    words::without_code(&text).trim().trim_end_matches([',', '、']).to_owned()
}
