//! What can be changed of a connector, a row each: a comparison, a duration, a helper.

use super::foot::passes;
use super::now::{ComparedNow, measured};
use super::slider::{Slider, Stepper};
use super::turned::Turned;
use crate::forms::words;
use crate::icons::Icon;
use behaviour::{Connector, Procedure};
use editor::numbers::{NumberTest, number_tests, with_period, with_text};
use leptos::prelude::*;

/// A comparison: what, how, with which number, and a slider with a tick where the value is now.
#[component]
pub(super) fn TestRow(record: Memo<Connector>, turned: Turned, at: usize) -> impl IntoView {
    let desk = turned.desk;
    let test = Memo::new(move |_| number_tests(&turned.body(record)).and_then(|tests| tests.all.get(at).cloned()));
    // The slider does not grow under the hand.
    let first = test.with_untracked(|test| test.as_ref().map_or(0.0, |test| test.number));
    let of = Memo::new(move |before: Option<&ComparedNow>| {
        let of = |test: &NumberTest| measured(desk, &record.read(), test, first).staying(before, test.number);
        test.read().as_ref().map(of).unwrap_or_default()
    });
    let verdict = Memo::new(move |_| passes(turned, record));
    let put = move |range: std::ops::Range<usize>, text: &str, at_once: bool| {
        if let Some(operation) = with_text(&untrack(|| turned.now(record)), &range, text) {
            turned.turn(operation, at_once);
        }
    };
    let set = move |number: f64, at_once: bool| {
        if let Some(test) = test.get_untracked() {
            put(test.number_at.clone(), &test.written(number), at_once);
        }
    };
    let choose = move |sign: String| {
        if let Some(test) = test.get_untracked() {
            put(test.sign_at, &sign, true);
        }
    };
    let subject = move || test.get().map(|test| test.subject).unwrap_or_default();
    let sign = move || test.get().map_or("<", |test| test.sign);
    let unit = Signal::derive(move || of.read().unit);
    view! {
        <div class="control-row">
            <code class="cut" title=subject>{subject}</code>
            <span class="select small">
                <select class="input" aria-label=words::compared_how() disabled=move || turned.reads.get() prop:value=sign
                    on:change:target=move |event| choose(event.target().value())>
                    {["<", "<=", ">", ">=", "==", "!="].into_iter().map(|one| {
                        view! { <option value=one prop:selected=move || sign() == one>{words::sign(one)}</option> }
                    }).collect_view()}
                </select>
                <Icon name="chevron" />
            </span>
            <Stepper number=Signal::derive(move || test.get().map_or(0.0, |test| test.number))
                written=Signal::derive(move || test.get().map_or_else(String::new, |test| test.written(test.number)))
                step=Signal::derive(move || test.get().map_or(1.0, |test| test.step()))
                set=Callback::new(move |(number, at_once)| set(number, at_once)) unit turned />
        </div>
        <Slider test of verdict reads=turned.reads set=Callback::new(move |(number, at_once)| set(number, at_once)) />
    }
}

/// A duration in seconds.
#[component]
pub(super) fn PeriodRow(record: Memo<Connector>, turned: Turned) -> impl IntoView {
    let period = move || turned.now(record).period_ms().unwrap_or_default();
    let set = move |(seconds, at_once): (f64, bool)| {
        turned.turn(with_period(&untrack(|| turned.now(record)), seconds * 1_000.0), at_once);
    };
    let seconds = Signal::derive(move || period() as f64 / 1_000.0);
    view! {
        <div class="control-row">
            <span class="cut">{move || record.read().operation.spec().period_called().as_ref().map(words::label_of)}</span>
            <Stepper number=seconds written=Signal::derive(move || seconds.get().to_string())
                step=Signal::derive(move || if period() < 2_000 { 0.1 } else { 1.0 })
                set=Callback::new(set) unit=Signal::stored(words::seconds_unit()) turned />
        </div>
    }
}

/// Another helper of as many values.
#[component]
pub(super) fn HelperRow(record: Memo<Connector>, turned: Turned) -> impl IntoView {
    let desk = turned.desk;
    let name = move || match turned.now(record).procedure() {
        Some(Procedure::Helper(name)) => name.clone(),
        Some(Procedure::Body { .. }) | None => String::new(),
    };
    let names = move || {
        let connector = record.get();
        let takes = connector.operation.spec().argument_count(connector.inputs.len());
        let fitting = desk.desk().library.helpers.get().into_iter().map(|(_, helper)| helper);
        let mut names: Vec<(String, String)> = fitting
            .filter(|helper| helper.params.len() == takes)
            .map(|helper| (helper.name.clone(), words::helper_name_of(&helper)))
            .collect();
        let now = name();
        if !names.iter().any(|(known, _)| *known == now) {
            names.push((now.clone(), now));
        }
        names
    };
    let choose = move |chosen: String| {
        let mut operation = untrack(|| turned.now(record));
        if let Some(procedure) = operation.procedure_mut() {
            *procedure = Procedure::Helper(chosen);
        }
        turned.turn(operation, true);
    };
    view! {
        <label class="control-row">
            <span>{words::helper()}</span>
            <span class="select small grows">
                <select class="input" disabled=move || turned.reads.get() prop:value=name on:change:target=move |event| choose(event.target().value())>
                    {move || names().into_iter().map(|(value, plain)| {
                        let mine = value.clone();
                        view! { <option value=value prop:selected=move || name() == mine>{plain}</option> }
                    }).collect_view()}
                </select>
                <Icon name="chevron" />
            </span>
        </label>
    }
}
