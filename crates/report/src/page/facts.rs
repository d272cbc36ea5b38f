//! The head of a report: whose session, when, by whom, with which robot; what the recording lacks; what the program did.

use super::tables::WHO_MAX;
use super::{Sheet, clean, own};
use crate::clock::length;
use crate::gather::{Ended, RanProgram};
use maud::{Markup, html};
use recording::Lack;

pub(super) fn head(sheet: &Sheet, title: &str) -> Markup {
    let (of, clock, words) = (sheet.of, sheet.clock, sheet.words);
    let header = &of.header;
    let people: Vec<String> = of.private.people().collect();
    html! {
        header {
            h1 { (title) }
            p class="faint" {
                (sheet.text(&header.name)) (words.comma()) (words.version(header.revision))
                @if let Some(session) = &header.session { " · " (words.session()) " " (sheet.text(session)) }
            }
            dl {
                div { dt { (words.day()) } dd { (words.day_of(clock)) } }
                div { dt { (words.time()) } dd {
                    (words.time_span(&clock.at(0), &clock.at(of.last_ms), &length(of.last_ms))) (clock.zone())
                } }
                div { dt { (words.people()) } dd {
                    @if people.is_empty() { (words.nobody()) }
                    @for (at, name) in people.iter().take(WHO_MAX).enumerate() { @if at > 0 { (words.comma()) } (own(name)) }
                    @if people.len() > WHO_MAX { (words.comma()) (words.more((people.len() - WHO_MAX) as u64)) }
                } }
                div { dt { (words.robot()) } dd {
                    @if header.robot.is_empty() { (words.unknown()) } @else { (sheet.text(&header.robot)) }
                    @if let Some((first, last)) = of.battery { (words.comma()) (words.battery(first, last)) }
                } }
            }
        }
    }
}

/// The parts that are missing in a recording, in sentences.
pub(super) fn lacks(sheet: &Sheet) -> Markup {
    let (of, words) = (sheet.of, sheet.words);
    let until = sheet.clock.at(of.last_ms);
    let lacks = match of.header.lacks() {
        Some(Lack::Program) => Some(words.old_form()),
        Some(Lack::Readings) => Some(words.marks_only()),
        Some(Lack::Everything | Lack::Memory) | None => of.programs.is_empty().then(|| words.no_program()),
    };
    let ends = match &of.ended {
        Ended::CutOff => Some(words.cut_off(&until)),
        Ended::Full => Some(words.full(&until)),
        Ended::GoesOn => Some(words.goes_on(&until)),
        Ended::Unread => Some(words.unread(&until)),
        Ended::Whole(_) => None,
    };
    html! {
        @if lacks.is_some() || ends.is_some() {
            div class="lacks" role="note" {
                @for sentence in lacks.map(str::to_owned).into_iter().chain(ends) { p { (sentence) } }
            }
        }
    }
}

/// The program in sentences, with what was applied while it ran.
pub(super) fn program(sheet: &Sheet) -> Markup {
    let words = sheet.words;
    let Some((first, later)) = sheet.of.programs.split_first() else { return html! {} };
    let pairs = std::iter::once(first).chain(later).zip(later);
    html! {
        section {
            h2 { (words.what_it_did()) }
            (told(sheet, first))
            @for (before, after) in pairs {
                p class="faint" { (words.changed(&sheet.clock.at(after.at_ms), after.revision)) }
                (changes(sheet, before, after))
            }
            @if let Ended::Whole(why) = &sheet.of.ended { p class="faint" { (words.ended()) ": " (sheet.text(why)) } }
        }
    }
}

fn told(sheet: &Sheet, program: &RanProgram) -> Markup {
    let words = sheet.words;
    html! {
        @match &program.sentences {
            None => p { (words.unreadable_program()) }
            Some(sentences) if sentences.is_empty() => p { (words.does_nothing()) }
            Some(sentences) => {
                @for sentence in sentences { p { (sheet.text(sentence)) } }
                @if program.more > 0 { p class="faint" { (words.more(program.more as u64)) } }
            }
        }
    }
}

/// The sentences that went and came, with a sign and a word each.
fn changes(sheet: &Sheet, before: &RanProgram, after: &RanProgram) -> Markup {
    let words = sheet.words;
    let (Some(was), Some(is)) = (&before.sentences, &after.sentences) else { return told(sheet, after) };
    let gone = was.iter().filter(|sentence| !is.contains(sentence));
    let new = is.iter().filter(|sentence| !was.contains(sentence));
    html! {
        @if was == is { p { (words.same_sentences()) } }
        @for sentence in gone { p class="change" { (words.before()) ": " (own(&clean(&sheet.of.private.text(sentence)))) } }
        @for sentence in new { p class="change" { (words.after()) ": " (own(&clean(&sheet.of.private.text(sentence)))) } }
    }
}
