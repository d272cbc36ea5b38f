//! Beside the list, the recording that is looked at: what is known of it, its marks, and what can be done with it.

use super::{ChosenRecording, List, size, state};
use crate::clock::{Clock, length};
use crate::page::{clean, own};
use crate::sessions::words as words_of;
use maud::{Markup, html};
use protocol::{MARK_MAX_CHARS, MARK_WORD_MAX_CHARS, RECORDING_TITLE_MAX_CHARS, REPORTS_PATH, RecordingMark, Records};

/// The most marks that are shown one by one.
const MARKS_MAX: usize = 200;

pub(super) fn aside(list: &List, chosen: &ChosenRecording) -> Markup {
    let (words, recording) = (list.words(), &chosen.listed.recording);
    let clock = Clock::of(&recording.began, list.zone);
    let (file, code) = ((list.encoded)(&recording.file), recording.session.participant.as_deref());
    let code = code.map_or_else(|| words.no_code().to_owned(), clean);
    let offset = list.zone.minutes().map(|minutes| format!("&offset={minutes}")).unwrap_or_default();
    html! {
        aside aria-label=(words.chosen()) {
            h2 { bdi { (code) } " · " (words.day_of(clock)) ", " (clock.at(0)) }
            p class="faint" {
                (own(&recording.name)) (words.comma()) (words.version(recording.revision))
                @if !recording.robot.is_empty() { " · " (own(&recording.robot)) }
            }
            dl {
                div { dt { (words.length()) } dd { (recording.length_ms.map(length).unwrap_or_default()) " · " (size(recording.bytes)) } }
                div { dt { (words.by()) } dd { (own(&recording.by)) } }
                div { dt { (words.replay()) } dd { (state(words, &chosen.listed, clock)) } }
            }
            @if list.choice.bin { (of_bin(list, &file)) } @else {
                p {
                    a class="button first" href=(format!("{REPORTS_PATH}/{file}/report?language={}{offset}", words.tag())) { (words.report()) }
                }
                @if !recording.old_form && recording.session.records == Records::All {
                    p { a class="button" href=(format!("/?past={file}")) { (words.look_back()) } }
                }
                p class="downloads" { (words.download()) ": "
                    a href=(format!("{}/{file}", list.downloads)) download { ".jsonl" } " "
                    @for (form, name) in [("csv", "CSV"), ("eaf", "ELAN"), ("boris", "BORIS"), ("vtt", "WebVTT")] {
                        a href=(format!("{}/{file}?as={form}", list.downloads)) download { (name) } " "
                    }
                }
                @if list.may_change { (change(list, chosen, &file)) }
                (marks(list, chosen, &file, clock))
            }
        }
    }
}

/// A form that changes a recording.
fn form(list: &List, file: &str, what: &str, inside: &Markup) -> Markup {
    html! {
        form method="post" action=(format!("{REPORTS_PATH}/{file}/change")) {
            (list.hidden())
            input type="hidden" name="do" value=(what);
            (inside)
        }
    }
}

fn change(list: &List, chosen: &ChosenRecording, file: &str) -> Markup {
    let (words, recording) = (list.words(), &chosen.listed.recording);
    let title = recording.title.as_deref().map(clean).unwrap_or_default();
    let name = html! {
        input type="text" name="title" value=(title) maxlength=(RECORDING_TITLE_MAX_CHARS) autocomplete="off"
            placeholder=(words.name_hint()) aria-label=(words.name_hint());
        button class="button" type="submit" { (words.rename()) }
    };
    html! {
        (form(list, file, "title", &name))
        @if !recording.goes_on {
            (form(list, file, "bin", &html! { button class="button" type="submit" { (words.to_the_bin()) } }))
        }
    }
}

fn of_bin(list: &List, file: &str) -> Markup {
    let words = list.words();
    html! {
        @if list.may_change {
            (form(list, file, "restore", &html! { button class="button first" type="submit" { (words.bring_back()) } }))
            details {
                summary { (words.remove_for_good()) }
                p { (words.cannot_come_back()) }
                (form(list, file, "remove", &html! { button class="button" type="submit" { (words.remove_for_good()) } }))
            }
        }
    }
}

fn marks(list: &List, chosen: &ChosenRecording, file: &str, clock: Clock) -> Markup {
    let words = list.words();
    let mut by_word: Vec<_> = words_of(&chosen.marks).into_iter().collect();
    by_word.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    html! {
        h3 { (words.marks()) ", " (chosen.marks.len()) }
        @if chosen.marks.is_empty() { p class="faint" { (words.no_marks()) } }
        p { @for (at, (word, (count, _))) in by_word.iter().enumerate() { @if at > 0 { " · " } (own(word)) " " (count) } }
        ul {
            @for mark in chosen.marks.iter().take(MARKS_MAX) {
                li {
                    @let says = html! { (clock.at(mark.t)) " " (own(&mark.word)) @if !mark.note.is_empty() { " “" (own(&mark.note)) "”" } @if !mark.sort.is_note() { " · " (words.verdict(mark.sort)) } };
                    @if list.may_change && !chosen.listed.recording.goes_on {
                        details { summary { (says) } (edit(list, mark, file, clock)) }
                    } @else { (says) }
                }
            }
        }
        @if chosen.marks.len() > MARKS_MAX { p class="faint" { (words.more((chosen.marks.len() - MARKS_MAX) as u64)) } }
    }
}

fn edit(list: &List, mark: &RecordingMark, file: &str, clock: Clock) -> Markup {
    let words = list.words();
    let of = format!("{} {}", words.marks(), clock.at(mark.t));
    let inside = html! {
        input type="hidden" name="mark" value=(mark.id);
        input type="text" name="word" value=(clean(&mark.word)) maxlength=(MARK_WORD_MAX_CHARS) autocomplete="off"
            placeholder=(words.word()) aria-label=(format!("{of}{}{}", words.colon(), words.word()));
        input type="text" name="note" value=(clean(&mark.note)) maxlength=(MARK_MAX_CHARS) autocomplete="off"
            placeholder=(words.note()) aria-label=(format!("{of}{}{}", words.colon(), words.note()));
        button class="button" type="submit" { (words.save()) }
        button class="button" type="submit" name="gone" value="1" { (words.remove_mark()) }
    };
    form(list, file, "mark", &inside)
}
