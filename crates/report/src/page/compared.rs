//! The sessions of one participant beside each other: a table, and a plot for what was marked most.

use super::{Sheet, clean};
use crate::clock::{Clock, Zone, length};
use crate::sessions::SessionNumbers;
use maud::{Markup, html};
use std::collections::BTreeMap;

/// The most words that have a column.
const WORDS_MAX: usize = 4;
/// The most words that have a plot.
const PLOTS_MAX: usize = 2;
/// The size of a plot, and the height of its tallest bar.
const WIDTH: f64 = 327.0;
const HEIGHT: f64 = 88.0;
const TALL: f64 = 48.0;

pub(super) fn section(sheet: &Sheet, sessions: &[SessionNumbers], zone: Zone) -> Markup {
    let Some(code) = sheet.of.header.participant.as_deref().filter(|_| sessions.len() > 1) else { return html! {} };
    let words = sheet.words;
    let most = most_marked(sessions);
    let days: Vec<Clock> = sessions.iter().map(|session| Clock::of(&session.began, zone)).collect();
    html! {
        section {
            h2 { (words.over_sessions(&clean(code), sessions.len())) }
            div class="columns" {
                @for (word, lasts) in most.iter().take(PLOTS_MAX) {
                    @let values = sessions.iter().map(|session| value(session, word, *lasts)).collect::<Vec<_>>();
                    figure {
                        figcaption { (sheet.text(word)) (words.comma()) (words.unit(*lasts)) }
                        (plot(sheet, &days, &values, *lasts))
                    }
                }
            }
            table class="sessions" {
                thead { tr {
                    th scope="col" { (words.day()) } th scope="col" { (words.length()) }
                    @for (word, _) in &most { th scope="col" { (sheet.text(word)) } }
                    th scope="col" { (words.by_hand()) }
                } }
                tbody {
                    @for (session, day) in sessions.iter().zip(&days) {
                        tr class=[session.is_this.then_some("this")] {
                            th scope="row" { (words.day_of(*day)) " " (day.at(0)) @if session.is_this { (words.this_one()) } }
                            td { (session.length_ms.map(length).unwrap_or_default()) }
                            @for (word, _) in &most {
                                @let (count, ms) = session.words.get(word).copied().unwrap_or_default();
                                td { (count) @if ms > 0 { " (" (length(ms)) ")" } }
                            }
                            td { (session.by_hand) }
                        }
                    }
                }
            }
        }
    }
}

/// The words that were marked most in all sessions, and if the time of each is what counts.
fn most_marked(sessions: &[SessionNumbers]) -> Vec<(String, bool)> {
    let mut all: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
    for (word, (count, ms)) in sessions.iter().flat_map(|session| &session.words) {
        let of = all.entry(word).or_default();
        (of.0, of.1) = (of.0 + count, of.1 + ms);
    }
    let mut all: Vec<_> = all.into_iter().collect();
    all.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    all.into_iter().take(WORDS_MAX).map(|(word, (_, ms))| (word.to_owned(), ms > 0)).collect()
}

fn value(session: &SessionNumbers, word: &str, lasts: bool) -> u64 {
    let (count, ms) = session.words.get(word).copied().unwrap_or_default();
    if lasts { ms / 1_000 } else { count }
}

#[expect(clippy::cast_precision_loss, reason = "it is drawn")]
fn plot(sheet: &Sheet, days: &[Clock], values: &[u64], lasts: bool) -> Markup {
    let most = values.iter().copied().max().unwrap_or(0).max(1) as f64;
    let step = WIDTH / values.len().max(1) as f64;
    let wide = (step * 0.55).min(28.0);
    let floor = HEIGHT - 20.0;
    let says = |value: u64| if lasts { length(value * 1_000) } else { value.to_string() };
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) aria-hidden="true" {
            @for (at, (value, day)) in values.iter().zip(days).enumerate() {
                @let middle = (at as f64 + 0.5) * step;
                @let high = *value as f64 / most * TALL;
                rect class="bar" x=(px(middle - wide / 2.0)) y=(px(floor - high)) width=(px(wide)) height=(px(high)) {}
                text x=(px(middle)) y=(px(floor - high - 4.0)) text-anchor="middle" { (says(*value)) }
                text x=(px(middle)) y=(px(HEIGHT - 5.0)) text-anchor="middle" class="faint" { (sheet.words.short_day_of(*day)) }
            }
            path class="axis" d=(format!("M0 {}h{WIDTH}", px(floor))) {}
        }
    }
}

/// A number of a drawing, with one digit.
pub(super) fn px(at: f64) -> String {
    format!("{at:.1}")
}
