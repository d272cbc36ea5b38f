//! The words of reports: English here, other languages by the same keys in their catalogues.

use crate::clock::{Clock, length};
use crate::replayed::Replayed;
use phrase::{Catalogue, Phrase, key_of, phrase};
use protocol::MarkSort;
use sentences::Language;

/// The words of one language.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words(pub(crate) &'static Catalogue);

/// Texts without holes: the first part of their keys, then a name and the English of each.
macro_rules! said {
    ($of:literal; $($name:ident: $english:literal;)*) => {
        impl Words {
            $(pub(crate) fn $name(self) -> &'static str {
                self.keyed(concat!($of, ".", stringify!($name)), $english)
            })*
        }
    };
}

pub(crate) use said;

said! {
    "report";
    after: "After";
    as_if: "As if: ";
    before: "Before";
    beside: "Beside the report";
    by: "By";
    by_hand: "By hand";
    by_operators: "written by the operators";
    by_program: "By the program";
    colon: ": ";
    count: "Count";
    day: "Day";
    does_nothing: "The program has no action.";
    download: "Download";
    ended: "It ended";
    fell: "The robot fell.";
    good: "good";
    halted: "The robot interrupted the program.";
    how_often: "times";
    is_cut_off: "The recording ends here without its last line: the server or the disk ended first.";
    is_full: "The recording is as large as one may be, and ends here.";
    kept_by: "It was kept by";
    length: "Length";
    marks: "Marks";
    marks_only: "Only marks and actions were recorded: what the robot sensed is not here, and nothing can be replayed.";
    minutes_and_seconds: "minutes:seconds";
    no_marks: "Nothing was marked.";
    no_name: "The participant stands here as a code. No name was asked for.";
    no_program: "The recording is cut off before it says what ran.";
    no_troubles: "None.";
    nobody: "nobody is named in it";
    not_by_hand: "was pressed and not done";
    not_good: "not good";
    note_only: "a note only";
    notes: "Notes and verdicts";
    nothing_by_hand: "Nothing was done by hand.";
    old_form: "This recording is of an older form. It lacks the program, and what was pretended, refused or done by hand; streams \
               stand here by their ids.";
    own_words: "Notes are the operators’ own words. Read them before you hand this report on.";
    people: "People";
    print: "Print it";
    replay: "Replay";
    robot: "Robot";
    same_sentences: "Its sentences are the same.";
    sensed: "What it sensed";
    session: "session";
    should_have: "it should have";
    show_codes: "Show codes instead of names";
    show_names: "Show the names of staff";
    this_one: " · this one";
    time: "Time";
    timeline: "Timeline";
    timeline_label: "Timeline of the session. The tables below say the same in numbers.";
    troubles: "Troubles";
    unknown: "not known";
    unreadable_program: "This rrp cannot read the program in it. Update rrp, then open the report again.";
    values: "Values by id";
    version_row: "Version";
    what: "What";
    what_it_did: "What it did";
    with_codes: "Staff stand here and in the downloads as P1, P2 and so on; only the .jsonl has everything as it was recorded.";
    with_names: "Staff are named here and in the downloads. Faces and recognised words are left out of the tables for other programs; \
        the .jsonl has everything.";
    word: "Word";
}

impl Words {
    /// The text of a key; its English where the language lacks it.
    pub(crate) fn keyed(self, key: &'static str, english: &'static str) -> &'static str {
        self.0.told(key_of(key)).unwrap_or(english)
    }

    /// The tag of the language, as HTML has it: `en`.
    pub(crate) fn tag(self) -> &'static str {
        self.0.language().code
    }

    /// The language in which sentences about programs are told: English where they are not told in this one.
    pub(crate) fn of_sentences(self) -> Language {
        self.tag().parse().unwrap_or_default()
    }

    /// The sign between the parts of a list.
    pub(crate) fn comma(self) -> &'static str {
        self.0.language().comma
    }

    /// The title, of the session of a participant with this code.
    pub(crate) fn title(self, code: Option<&str>) -> String {
        self.0.say(&match code {
            Some(code) => phrase!("report.title_of", "Session report: {code}"),
            None => phrase!("report.title", "Session report"),
        })
    }

    pub(crate) fn version(self, revision: u64) -> String {
        self.0.say(&phrase!("report.version", "version {revision}"))
    }

    pub(crate) fn time_span(self, from: &str, to: &str, length: &str) -> String {
        self.0.say(&phrase!("report.time_span", "{from} to {to} ({length})"))
    }

    pub(crate) fn battery(self, first: u8, last: u8) -> String {
        self.0.say(&if first == last {
            phrase!("report.battery", "battery {first} %")
        } else {
            phrase!("report.battery_from", "battery {first} to {last} %")
        })
    }

    pub(crate) fn changed(self, at: &str, revision: u64) -> String {
        self.0.say(&phrase!("report.changed", "At {at} changed while it ran: version {revision}."))
    }

    pub(crate) fn more(self, count: u64) -> String {
        self.0.say(&phrase!("report.more", "and {count} more"))
    }

    pub(crate) fn cut_off(self, until: &str) -> String {
        self.0.say(&phrase!(
            "report.cut_off",
            "It ends early, at {until}: the server or the disk ended before its last line was written."
        ))
    }

    pub(crate) fn full(self, until: &str) -> String {
        self.0.say(&phrase!("report.full", "It ends early, at {until}: it is as large as a recording may be."))
    }

    pub(crate) fn goes_on(self, until: &str) -> String {
        self.0.say(&phrase!(
            "report.goes_on",
            "The session goes on. This is what was recorded until {until}; reload the page to see more."
        ))
    }

    pub(crate) fn unread(self, until: &str) -> String {
        self.0.say(&phrase!(
            "report.unread",
            "The recording is too long to be read at once. This report says what came until {until}; what came after it is in \
             the download."
        ))
    }

    pub(crate) fn not_done(self, count: u64) -> String {
        self.0.say(&phrase!("report.not_done", "was refused{times}", times = times(count)))
    }

    pub(crate) fn failed(self, count: u64) -> String {
        self.0.say(&phrase!("report.failed", "failed{times}", times = times(count)))
    }

    /// A length in a sentence: `8 s`, `1:20`.
    pub(crate) fn lasting(self, ms: u64) -> String {
        match ms {
            0..60_000 => self.0.say(&phrase!("report.lasting", "{seconds} s", seconds = ms.div_ceil(1_000))),
            _ => length(ms),
        }
    }

    pub(crate) fn no_connection(self, lasted: Option<String>) -> String {
        self.0.say(&match lasted {
            Some(lasted) => phrase!("report.no_connection_for", "No connection to the robot for {lasted}."),
            None => phrase!("report.no_connection", "No connection to the robot until the end."),
        })
    }

    pub(crate) fn weak(self, lasted: Option<String>) -> String {
        self.0.say(&match lasted {
            Some(lasted) => phrase!("report.weak_for", "The robot was not wholly ready for {lasted}."),
            None => phrase!("report.weak", "The robot was not wholly ready until the end."),
        })
    }

    pub(crate) fn late(self, count: u64) -> String {
        self.0.say(&phrase!("report.late", "Values that were dropped in all, as a procedure took too long: {count}."))
    }

    pub(crate) fn missing(self, lost: u64) -> String {
        self.0.say(&phrase!("report.missing", "Lines that could not be written in time and are missing here: {lost}."))
    }

    pub(crate) fn over_sessions(self, code: &str, count: usize) -> String {
        self.0.say(&phrase!("report.over_sessions", "{code} over {count} sessions"))
    }

    /// The unit of a plot.
    pub(crate) fn unit(self, lasts: bool) -> &'static str {
        if lasts { self.minutes_and_seconds() } else { self.how_often() }
    }

    pub(crate) fn switch_names(self, names: bool) -> &'static str {
        if names { self.show_codes() } else { self.show_names() }
    }

    pub(crate) fn about_names(self, names: bool) -> &'static str {
        if names { self.with_names() } else { self.with_codes() }
    }

    /// The verdict of a mark on its moment.
    pub(crate) fn verdict(self, sort: MarkSort) -> &'static str {
        match sort {
            MarkSort::Note => "",
            MarkSort::Good => self.good(),
            MarkSort::Bad => self.not_good(),
            MarkSort::Now => self.should_have(),
        }
    }

    /// The finding of a replay; `at` tells moments.
    pub(crate) fn replayed(self, found: Replayed, at: impl Fn(u64) -> String) -> String {
        self.0.say(&match found {
            Replayed::Same => phrase!("replayed.same", "same as recorded"),
            Replayed::OldForm => phrase!("replayed.old_form", "not possible: old file without the program"),
            Replayed::MarksOnly => phrase!("replayed.marks_only", "not possible: marks and actions only"),
            Replayed::Unknown => {
                phrase!("replayed.unknown", "not possible: it lacks what ran or what that remembered")
            }
            Replayed::CannotRun => {
                phrase!("replayed.cannot_run", "not possible: the program in it cannot run here")
            }
            Replayed::TooLong => {
                phrase!("replayed.too_long", "not tried, as it is long; use rrp replay --check with the download")
            }
            Replayed::Differs(ms) => phrase!("replayed.differs", "differs from {at}", at = at(ms)),
            Replayed::SameUntil(ms) => {
                phrase!("replayed.same_until", "same as recorded until {at}; lines are missing after it", at = at(ms))
            }
        })
    }

    /// The day on which a recording began, in words: `24 November 2026`. Empty if it is not known.
    pub(crate) fn day_of(self, clock: Clock) -> String {
        let Some((year, month, day)) = clock.date() else { return String::new() };
        let [month, _] = month_names(month);
        self.0.say(&phrase!("day.long", "{day} {month} {year}", year = year.to_string()))
    }

    /// The day in few letters: `24 Nov`.
    pub(crate) fn short_day_of(self, clock: Clock) -> String {
        let Some((_, month, day)) = clock.date() else { return String::new() };
        let [_, month] = month_names(month);
        self.0.say(&phrase!("day.short", "{day} {month}"))
    }
}

/// `, 3 times`, for what happened more than once.
fn times(count: u64) -> Phrase {
    if count == 1 { Phrase::default() } else { phrase!("report.times", ", {count} times") }
}

/// The name of a month, and its short name.
fn month_names(month: u8) -> [Phrase; 2] {
    match month {
        1 => [phrase!("month.1", "January"), phrase!("month.short.1", "Jan")],
        2 => [phrase!("month.2", "February"), phrase!("month.short.2", "Feb")],
        3 => [phrase!("month.3", "March"), phrase!("month.short.3", "Mar")],
        4 => [phrase!("month.4", "April"), phrase!("month.short.4", "Apr")],
        5 => [phrase!("month.5", "May"), phrase!("month.short.5", "May")],
        6 => [phrase!("month.6", "June"), phrase!("month.short.6", "Jun")],
        7 => [phrase!("month.7", "July"), phrase!("month.short.7", "Jul")],
        8 => [phrase!("month.8", "August"), phrase!("month.short.8", "Aug")],
        9 => [phrase!("month.9", "September"), phrase!("month.short.9", "Sep")],
        10 => [phrase!("month.10", "October"), phrase!("month.short.10", "Oct")],
        11 => [phrase!("month.11", "November"), phrase!("month.short.11", "Nov")],
        _ => [phrase!("month.12", "December"), phrase!("month.short.12", "Dec")],
    }
}

#[cfg(test)]
mod tests {
    use super::Words;
    use crate::clock::{Clock, Zone};
    use phrase::{Catalogue, PageLanguage};
    use std::sync::LazyLock;

    /// A third language: this line, and its file.
    static GERMAN: PageLanguage =
        phrase::language!("de", "de", "Deutsch", "Diese Seite auf Deutsch", One, ", ", "Sonst");
    static TEXTS: LazyLock<Catalogue> =
        LazyLock::new(|| Catalogue::of(&GERMAN, include_str!("../../../tests/languages/de.txt")));

    #[test]
    fn a_third_language_is_a_catalogue_and_a_line() {
        let words = Words(&TEXTS);
        assert_eq!((words.tag(), words.title(Some("C-07")).as_str()), ("de", "Sitzungsbericht: C-07"));
        assert_eq!(words.day_of(Clock::of("2026-11-24T18:34:06Z", Zone::default())), "24. November 2026");
        assert_eq!((words.title(None).as_str(), words.count()), ("Session report", "Count"), "English stands in");
    }

    #[test]
    fn days_are_told_in_the_zone_of_the_reader() {
        let [english, japanese] = ["en", "ja"].map(|code| Words(catalogues::of(code).unwrap()));
        let tokyo = Clock::of("2026-11-23T18:34:06Z", Zone::east_by(Some(540)));
        assert_eq!([english.day_of(tokyo), japanese.day_of(tokyo)], ["24 November 2026", "2026年11月24日"]);
        assert_eq!([english.short_day_of(tokyo), japanese.short_day_of(tokyo)], ["24 Nov", "11/24"]);
        assert_eq!(english.day_of(Clock::of("yesterday", Zone::default())), "");
    }
}
