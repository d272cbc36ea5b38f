//! The tables of a report: by the program, by hand, marks, troubles and notes.

use super::{Sheet, own};
use crate::clock::length;
use crate::gather::StreamRow;
use crate::sessions::words as words_of;
use crate::troubles::Trouble;
use behaviour::StreamKind;
use maud::{Markup, html};
use std::collections::BTreeMap;

/// The most people who are named beside one thing.
pub(super) const WHO_MAX: usize = 12;

pub(super) fn all(sheet: &Sheet) -> Markup {
    html! {
        div class="columns" {
            (by_program(sheet))
            (by_hand(sheet))
            (marks(sheet))
            (troubles(sheet))
        }
        (notes(sheet))
    }
}

fn by_program(sheet: &Sheet) -> Markup {
    let words = sheet.words;
    let of = |kind| sheet.of.rows.iter().filter(move |row| row.kind == kind && row.bars.count > 0);
    let (actions, sensed, values) = (of(Some(StreamKind::Actuator)), of(Some(StreamKind::Sensor)), of(None));
    let count: u64 = actions.clone().map(|row| row.bars.count).sum();
    html! {
        section {
            h2 { (words.by_program()) ", " (count) }
            (counts(sheet, words.what(), actions))
            (counts(sheet, words.sensed(), sensed))
            (counts(sheet, words.values(), values))
            @if sheet.of.more_rows > 0 { p class="faint" { (words.more(sheet.of.more_rows)) } }
        }
    }
}

fn counts<'a>(sheet: &Sheet, what: &str, rows: impl Iterator<Item = &'a StreamRow> + Clone) -> Markup {
    let words = sheet.words;
    html! {
        @if rows.clone().next().is_some() {
            table {
                thead { tr { th scope="col" { (what) } th scope="col" { (words.count()) } th scope="col" { (words.time()) } } }
                tbody {
                    @for row in rows {
                        tr {
                            th scope="row" { (sheet.text(&row.name)) }
                            td { (row.bars.count) }
                            td { @if row.bars.total_ms >= 1_000 { (length(row.bars.total_ms)) } }
                        }
                    }
                }
            }
        }
    }
}

fn by_hand(sheet: &Sheet) -> Markup {
    let words = sheet.words;
    let pretended = || sheet.of.rows.iter().filter(|row| !row.pretended.is_empty());
    let count = sheet.of.hands.iter().map(|pressed| pressed.count()).sum::<u64>()
        + pretended().flat_map(|row| row.pretended.values()).map(|bars| bars.count).sum::<u64>();
    html! {
        section {
            h2 { (words.by_hand()) ", " (count) }
            @if count == 0 { p class="faint" { (words.nothing_by_hand()) } } @else {
                table {
                    thead { tr class="who" { th scope="col" { (words.what()) } th scope="col" { (words.count()) } th scope="col" { (words.by()) } } }
                    tbody {
                        @for pressed in &sheet.of.hands {
                            tr class="who" { th scope="row" { (action(sheet, &pressed.what)) } td { (pressed.count()) } td { (who(sheet, &pressed.by)) } }
                        }
                        @for row in pretended() {
                            @let by = row.pretended.iter().map(|(name, bars)| (name.clone(), bars.count)).collect();
                            tr class="who" {
                                th scope="row" { (words.as_if()) (sheet.text(&row.name)) }
                                td { (row.pretended.values().map(|bars| bars.count).sum::<u64>()) }
                                td { (who(sheet, &by)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// An action of the catalogue with the text that it was told.
fn action(sheet: &Sheet, (device, text): &(String, String)) -> Markup {
    let label = sentences::device_label(device, sheet.words.of_sentences())
        .map_or_else(|| own(device), |label| html! { (label) });
    html! { (label) @if !text.is_empty() { (sheet.words.colon()) "“" (sheet.text(text)) "”" } }
}

/// The people who pressed, with how often if there are several.
fn who(sheet: &Sheet, by: &BTreeMap<String, u64>) -> Markup {
    html! {
        @for (at, (name, count)) in by.iter().take(WHO_MAX).enumerate() {
            @if at > 0 { (sheet.words.comma()) }
            (sheet.person(name)) @if by.len() > 1 { " " (count) }
        }
        @if by.len() > WHO_MAX { (sheet.words.comma()) (sheet.words.more((by.len() - WHO_MAX) as u64)) }
    }
}

fn marks(sheet: &Sheet) -> Markup {
    let (words, marks) = (sheet.words, &sheet.of.marks);
    let mut by_word: Vec<_> = words_of(marks).into_iter().collect();
    by_word.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    let without = marks.iter().filter(|mark| mark.word.is_empty()).count();
    html! {
        section {
            h2 { (words.marks()) ", " (marks.len()) }
            @if marks.is_empty() { p class="faint" { (words.no_marks()) } } @else {
                table {
                    thead { tr { th scope="col" { (words.word()) } th scope="col" { (words.count()) } th scope="col" { (words.time()) } } }
                    tbody {
                        @for (word, (count, ms)) in &by_word {
                            tr { th scope="row" { (sheet.text(word)) } td { (count) } td { @if *ms > 0 { (length(*ms)) } } }
                        }
                        @if without > 0 { tr { th scope="row" { (words.note_only()) } td { (without) } td {} } }
                    }
                }
            }
        }
    }
}

fn troubles(sheet: &Sheet) -> Markup {
    let (words, troubles) = (sheet.words, &sheet.of.troubles);
    html! {
        section {
            h2 { (words.troubles()) ", " (troubles.count()) }
            @if troubles.told.is_empty() { p class="faint" { (words.no_troubles()) } }
            table class="moments" {
                tbody {
                    @for (at_ms, trouble) in &troubles.told {
                        tr { th scope="row" { (sheet.clock.at(*at_ms)) } td { (sentence(sheet, *at_ms, trouble)) } }
                    }
                }
            }
            @if troubles.more > 0 { p class="faint" { (words.more(troubles.more)) } }
        }
    }
}

fn sentence(sheet: &Sheet, at_ms: u64, trouble: &Trouble) -> Markup {
    let words = sheet.words;
    let lasted = |until_ms: &Option<u64>| until_ms.map(|until_ms| words.lasting(until_ms.saturating_sub(at_ms)));
    let because = |why: &str| html! { @if !why.is_empty() { " (" (sheet.text(why)) ")" } };
    html! {
        @match trouble {
            Trouble::NoConnection { until_ms, why } => { (words.no_connection(lasted(until_ms))) (because(why)) }
            Trouble::Weak { until_ms, why } => { (words.weak(lasted(until_ms))) (because(why)) }
            Trouble::Halted(why) => { (words.halted()) (because(why)) }
            Trouble::Fell => (words.fell()),
            Trouble::NotDone { subject, why, with, count } => {
                "“" (sheet.text(subject)) "” " (words.not_done(*count)) (because(why))
                @if !with.is_empty() { " " (words.kept_by()) " " (sheet.person(with)) }
            }
            Trouble::NotByHand { what, why, by } => {
                (action(sheet, what)) " " (words.not_by_hand()) (because(why)) " " (sheet.person(by))
            }
            Trouble::Failed { subject, error, count } => {
                "“" (sheet.text(subject)) "” " (words.failed(*count)) (because(error))
            }
            Trouble::Late(count) => (words.late(*count)),
            Trouble::Missing(lost) => (words.missing(*lost)),
            Trouble::Full => (words.is_full()),
            Trouble::CutOff => (words.is_cut_off()),
        }
    }
}

fn notes(sheet: &Sheet) -> Markup {
    let words = sheet.words;
    let notes = || sheet.of.marks.iter().filter(|mark| !mark.note.is_empty() || !mark.sort.is_note());
    html! {
        @if notes().next().is_some() {
            section {
                h2 { (words.notes()) ", " (notes().count()) " " span { (words.by_operators()) } }
                table class="moments" {
                    tbody {
                        @for mark in notes() {
                            tr {
                                th scope="row" { (sheet.clock.at(mark.t)) }
                                td {
                                    @if !mark.note.is_empty() { "“" (sheet.text(&mark.note)) "” " }
                                    "(" (sheet.person(&mark.by)) ")"
                                    @if !mark.word.is_empty() { " · " (sheet.text(&mark.word)) }
                                    @if !mark.sort.is_note() { " · " b { (words.verdict(mark.sort)) } }
                                }
                            }
                        }
                    }
                }
                p class="faint" { (words.own_words()) }
            }
        }
    }
}
