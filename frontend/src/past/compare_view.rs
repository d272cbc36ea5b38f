//! The line of the comparison below the head: what is compared, the sum of what changes, and whether that is saved.

use super::PastShared;
use super::compare::CompareForm;
use super::compare_counts::ChangeCounts;
use crate::browser;
use crate::icons::Icon;
use crate::past::words;
use leptos::prelude::*;

/// So many changes of the history can be chosen, besides all versions with names.
const CHOICES_MAX: usize = 60;
/// So many actions are named with their counts.
const NAMED_MAX: usize = 3;

/// The button that begins and ends comparing.
#[component]
pub(super) fn CompareButton(past: PastShared) -> impl IntoView {
    view! {
        <button class="past-tool past-compares" type="button" title=format!("{} (B)", words::compare()) aria-keyshortcuts="B"
            aria-pressed=move || past.compare.is_on.get().to_string() on:click=move |_| past.toggle_compare()>
            <Icon name="copy" />{words::compare()}
        </button>
    }
}

/// The line, while something is compared.
#[component]
pub(super) fn CompareLine(past: PastShared) -> impl IntoView {
    let compare = past.compare;
    let is_revisions = Memo::new(move |_| matches!(compare.form.get(), CompareForm::Revisions { .. }));
    let choose = move |event: web_sys::Event| {
        let is_edits = event_target_value(&event) == "edits";
        past.compare_form(if is_edits { CompareForm::Edits } else { past.first_revisions() });
    };
    let unsaved = move || past.desk.desk().document.is_unsaved();
    view! {
        <Show when=move || compare.is_on.get()>
            <div class="past-compare" role="group" aria-label=words::what_would_change()>
                <select class="past-select past-form" aria-label=words::what_is_compared() on:change=choose
                    prop:value=move || if is_revisions.get() { "revisions" } else { "edits" }>
                    <option value="edits">{words::my_edits()}</option>
                    <option value="revisions">{words::two_revisions()}</option>
                </select>
                <Show when=move || is_revisions.get()>
                    <RevisionChoice past is_now=false /><span aria-hidden="true">"→"</span><RevisionChoice past is_now=true />
                </Show>
                <Sum past />
                <span class="past-unsaved" hidden=move || !unsaved()>{words::not_saved_yet()}</span>
            </div>
        </Show>
        <p class="sr past-said" role="status">{move || compare.said.get()}</p>
    }
}

/// The sum of what changes.
#[component]
fn Sum(past: PastShared) -> impl IntoView {
    let compare = past.compare;
    let sum = Memo::new(move |_| past.sum_of_changes());
    move || {
        let trouble = compare.trouble.get();
        if let Some(why) = trouble.clone().filter(|_| !compare.is_old.get()) {
            return view! { <p class="past-trouble">{why}</p> }.into_any();
        }
        let Some((counts, actions)) = sum.get() else {
            return view! { <p class="faint">{words::comparison_comes()}</p> }.into_any();
        };
        let changed = actions.iter().filter(|one| ChangeCounts::of(one).changes());
        let named: Vec<String> =
            changed.take(NAMED_MAX).map(|one| words::before_and_now(&one.name, one.before, one.now)).collect();
        let title = if counts.changes() { named.join(" · ") } else { words::nothing_would_change().to_owned() };
        let kinds = [
            ("removed", "−", words::count_only_before(counts.only_before), counts.only_before),
            ("new", "+", words::count_only_now(counts.only_now), counts.only_now),
            ("changed", "→", words::count_moved(counts.moved), counts.moved),
        ];
        let kinds = kinds.into_iter().filter(|(.., many)| *many > 0);
        let numbers = (counts.other_numbers > 0).then(|| words::count_other_numbers(counts.other_numbers));
        let settings = (counts.other_settings > 0).then(|| words::has_other_settings().to_owned());
        let others =
            numbers.into_iter().chain(settings).map(|text| view! { <span class="differs changed">{text}</span>" " });
        let tag = |(kind, sign, text, _): (&'static str, &'static str, String, u64)| {
            view! { <span class=format!("differs {kind}")><i aria-hidden="true">{sign}</i>{text}</span>" " }
        };
        view! {
            {trouble.map(|why| view! { <p class="past-trouble">{why}</p> })}
            <b class="past-sum">{title}</b>
            <p class="differs-row past-counts">
                {kinds.map(tag).collect_view()}
                {others.collect_view()}
                <span class="faint">{words::count_same(counts.same)}</span>
            </p>
        }
        .into_any()
    }
}

/// One of the two versions.
#[component]
fn RevisionChoice(past: PastShared, is_now: bool) -> impl IntoView {
    let form = past.compare.form;
    let chosen = Memo::new(move |_| match form.get() {
        CompareForm::Revisions { now, .. } if is_now => now,
        CompareForm::Revisions { before, .. } => Some(before),
        CompareForm::Edits => None,
    });
    let options = Memo::new(move |_| revisions(past, chosen.get()));
    let choose = move |event: web_sys::Event| {
        let CompareForm::Revisions { before, now } = form.get_untracked() else { return };
        let new = event_target_value(&event).parse::<u64>().ok();
        past.compare_form(if is_now {
            CompareForm::Revisions { before, now: new }
        } else {
            CompareForm::Revisions { before: new.unwrap_or(before), now }
        });
    };
    let label = if is_now { words::version_after() } else { words::version_before() };
    view! {
        <select class="past-select" aria-label=label on:change=choose>
            {is_now.then(|| view! { <option value="" selected=move || chosen.get().is_none()>{words::now_version()}</option> })}
            {move || options.get().into_iter().map(|(revision, name)| view! {
                <option value=revision.to_string() selected=move || chosen.get() == Some(revision)>{name}</option>
            }).collect_view()}
        </select>
    }
}

/// The revisions that can be chosen, with their names or what they changed. Reactive.
fn revisions(past: PastShared, chosen: Option<u64>) -> Vec<(u64, String)> {
    let document = past.desk.desk().document;
    let mut all: Vec<(u64, String)> = document
        .versions
        .with(|all| all.iter().rev().map(|version| (version.revision, version.name.clone())).collect());
    document.history.with(|history| {
        for line in history.newest_first().take(CHOICES_MAX) {
            if all.iter().all(|(revision, _)| *revision != line.revision) {
                let at = line.at_ms as f64;
                let when = [browser::date_words(at), browser::clock_words(at)].join(" ");
                all.push((line.revision, [when, words::label_said(&line.label)].join(" · ")));
            }
        }
    });
    if let Some(chosen) = chosen.filter(|chosen| all.iter().all(|(revision, _)| revision != chosen)) {
        all.push((chosen, words::revision_number(chosen)));
    }
    all
}
