//! The values of the chosen lane around the cursor, as a table: shown where somebody wants it, and always there for screen readers.

use super::compare_counts::change_words;
use super::rows::dot_words;
use super::{PastShared, clock, filling};
use crate::past::words;
use leptos::prelude::*;

/// The table.
#[component]
pub(super) fn Table(past: PastShared) -> impl IntoView {
    let name = move || {
        let opened = past.opened.get();
        let viewer = past.viewer.read();
        let label = |key: &str| opened.as_ref().map(|opened| filling::label(opened, &filling::name(key)));
        viewer.chosen().and_then(|lane| label(&lane.key)).unwrap_or_default()
    };
    let rows = Memo::new(move |_| {
        let opened = past.opened.get();
        let viewer = past.viewer.read();
        let (dots, newest) = viewer.around_compared();
        let row = |(at, (dot, change)): (usize, &(lanes::Dot, Option<lanes::DotChange>))| {
            let time = opened.as_ref().map(|opened| clock::time(opened, dot.t, true)).unwrap_or_default();
            let change = change.map(|change| change_words(dot.t, change)).unwrap_or_default();
            (dot.t, time, dot_words(dot), change, newest == Some(at))
        };
        dots.iter().enumerate().map(row).collect::<Vec<_>>()
    });
    let none = move || {
        let told_together = past.viewer.read().chosen().is_some_and(|lane| !lane.is_empty());
        if told_together { words::values_come() } else { words::no_values_then() }
    };
    let is_compared = Memo::new(move |_| past.viewer.read().is_compared());
    view! {
        <div class="past-table" class:sr=move || !past.shows_table.get()>
            <table>
                <caption>{name}</caption>
                <thead><tr><th scope="col">{words::time_of_value()}</th><th scope="col">{words::value_name()}</th>
                    {move || is_compared.get().then(|| view! { <th scope="col">{words::change_name()}</th> })}</tr></thead>
                <tbody>
                    {move || {
                        let row = |(t, time, text, change, is_now): (f64, String, String, String, bool)| {
                            let current = is_now.then_some("true");
                            view! {
                                <tr aria-current=current>
                                    <td><button class="link" type="button" on:click=move |_| past.seek(t)>{time}</button></td>
                                    <td>{text}</td>
                                    {is_compared.get().then(|| view! { <td>{change}</td> })}
                                </tr>
                            }
                        };
                        rows.get().into_iter().map(row).collect_view()
                    }}
                </tbody>
            </table>
            <Show when=move || rows.read().is_empty()><p class="faint">{none}</p></Show>
        </div>
    }
}
