//! The recordings that are kept, as a page: found again, looked at, named, put into the bin and brought back. It works without a
//! program in the browser.

mod chosen;
mod words;

use crate::clock::{Clock, Zone, length};
use crate::page::{SCRIPT_ID, clean, own};
use crate::replayed::Replayed;
use crate::words::Words;
use maud::{DOCTYPE, Markup, html};
use phrase::Catalogue;
use protocol::{OPERATE_PATH, Recording, RecordingMark, Records, Refused};
use std::collections::BTreeSet;

/// The stylesheet of the list; that of reports comes before it.
pub const LIST_STYLE: &str = include_str!("list/list.css");
/// The rows that are shown at first, and how many more with each press.
const ROWS: usize = 25;

/// A recording with what is known of it.
#[derive(Clone, Debug)]
pub struct ListedRecording {
    /// The description by its first and its last line.
    pub recording: Recording,
    /// The number of its marks by now, if that is known.
    pub marks: Option<u64>,
    /// The finding of its replay, if it was replayed as it is.
    pub replayed: Option<Replayed>,
}

/// The recording that is looked at.
#[derive(Clone, Debug)]
pub struct ChosenRecording {
    /// The description, with the finding of its replay.
    pub listed: ListedRecording,
    /// The marks, by time.
    pub marks: Vec<RecordingMark>,
}

/// The recordings that somebody looks for.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// Words that have to be in it.
    pub find: String,
    /// The program, if only its recordings are wanted.
    pub program: String,
    /// The code of a participant, if only their recordings are wanted.
    pub code: String,
    /// The number of rows that are wanted; the first ones if none.
    pub rows: usize,
    /// True if the bin is looked at.
    pub bin: bool,
}

/// Everything that the page draws from.
#[derive(Clone, Debug)]
pub struct List {
    /// All recordings, or all in the bin; newest first.
    pub all: Vec<ListedRecording>,
    /// The one that is looked at.
    pub chosen: Option<ChosenRecording>,
    /// The recordings that are looked for.
    pub choice: Choice,
    /// The number of recordings in the bin.
    pub binned: usize,
    /// The most bytes that all may take.
    pub most_bytes: u64,
    /// True if the reader may change something.
    pub may_change: bool,
    /// The catalogue of the language of the page.
    pub language: &'static Catalogue,
    /// The zone in which moments are told.
    pub zone: Zone,
    /// The addresses of both stylesheets and of the script.
    pub parts: [&'static str; 3],
    /// The address below which each recording is downloaded.
    pub downloads: &'static str,
    /// Makes of the name of a file what may stand in an address.
    pub encoded: fn(&str) -> String,
}

impl Choice {
    fn fits(&self, recording: &Recording, zone: Zone) -> bool {
        let code = recording.session.participant.as_deref().unwrap_or_default();
        let is_of = |wanted: &str, is: &str| wanted.is_empty() || wanted == is;
        if !is_of(&self.program, &recording.name) || !is_of(&self.code, code) {
            return false;
        }
        let clock = Clock::of(&recording.began, zone);
        let days = catalogues::all().iter().map(|language| Words(language).day_of(clock)).collect::<Vec<_>>().join(" ");
        let (title, session) = (recording.title.as_deref(), recording.session.session.as_deref());
        let all = [
            code,
            &recording.name,
            &recording.by,
            &recording.robot,
            &recording.file,
            &days,
            title.unwrap_or_default(),
            session.unwrap_or_default(),
        ];
        let all = all.join(" ").to_lowercase();
        self.find.to_lowercase().split_whitespace().all(|word| all.contains(word))
    }
}

impl List {
    fn words(&self) -> Words {
        Words(self.language)
    }

    /// Returns the address of this page with another recording looked at, or with more rows.
    fn address(&self, chosen: Option<&str>, rows: usize) -> String {
        let Choice { find, program, code, bin, .. } = &self.choice;
        let encoded = self.encoded;
        let mut parts = vec![format!("language={}", self.words().tag())];
        parts.extend(self.zone.minutes().map(|minutes| format!("offset={minutes}")));
        for (name, value) in [("find", find), ("program", program), ("code", code)] {
            parts.extend((!value.is_empty()).then(|| format!("{name}={}", encoded(value))));
        }
        parts.extend(bin.then(|| "bin=1".to_owned()));
        parts.extend((rows > ROWS).then(|| format!("rows={rows}")));
        parts.extend(chosen.map(|file| format!("chosen={}", encoded(file))));
        format!("?{}", parts.join("&"))
    }

    /// The fields of a form besides those that people fill in.
    fn hidden(&self) -> Markup {
        html! {
            input type="hidden" name="language" value=(self.words().tag());
            @if let Some(minutes) = self.zone.minutes() { input type="hidden" name="offset" value=(minutes); }
            @if self.choice.bin { input type="hidden" name="bin" value="1"; }
        }
    }
}

/// The page.
#[must_use]
pub fn list(list: &List) -> String {
    let words = list.words();
    let found: Vec<&ListedRecording> =
        list.all.iter().filter(|one| list.choice.fits(&one.recording, list.zone)).collect();
    let rows = list.choice.rows.max(ROWS);
    let newest = list.all.first().map(|one| clean(&one.recording.began)).unwrap_or_default();
    let title = if list.choice.bin { words.bin() } else { words.recordings() };
    let body = html! {
        (links(list))
        main data-began=(newest) class="list" {
            div {
                h1 { (title) }
                (search(list))
                (table(list, &found[..found.len().min(rows)]))
                p class="foot" {
                    @if found.len() > rows { a class="button" href=(list.address(None, rows + ROWS)) { (words.show_more(found.len() - rows)) } }
                    span { (words.so_many(found.len(), &size(bytes(list)), &size(list.most_bytes))) }
                    @if list.choice.bin { a href=(other(list, false)) { (words.back_to_list()) } }
                    @else { a href=(other(list, true)) { (words.bin()) " · " (list.binned) } }
                }
            }
            @if let Some(chosen) = &list.chosen { (chosen::aside(list, chosen)) }
        }
    };
    document(title, words, list.parts, &body)
}

/// A page that says why something was not done, with the way back.
#[must_use]
pub fn no(why: &Refused, language: &'static Catalogue, parts: [&'static str; 3], back: &str) -> String {
    let words = Words(language);
    let body = html! {
        main class="list" { div { h1 { (words.not_done_title()) } p role="alert" { (language.say(why)) } p { a class="button" href=(back) { (words.back_to_list()) } } } }
    };
    document(words.not_done_title(), words, parts, &body)
}

fn document(title: &str, words: Words, [style, own, script]: [&str; 3], body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(words.tag()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="robots" content="noindex";
                title { (title) " · rrp" }
                link rel="stylesheet" href=(style);
                link rel="stylesheet" href=(own);
                script src=(script) defer {}
            }
            body { (body) }
        }
    };
    page.into_string()
}

fn links(list: &List) -> Markup {
    let words = list.words();
    let other = words.0.language().next();
    let language = catalogues::of(other.code).unwrap_or_else(catalogues::english);
    let address = List { language, ..list.clone() }.address(None, 0);
    html! {
        nav aria-label=(words.around()) {
            a href="/?graph" { (words.programs()) }
            a href=(OPERATE_PATH) { (words.operate()) }
            a href=(list.address(None, 0)) aria-current="page" { (words.recordings()) }
            a href=(address) lang=(other.code) { (other.name) }
            button id=(SCRIPT_ID) type="button" hidden { (words.print()) }
            form method="post" action="/stop" { button class="stop" type="submit" { (words.stop_all()) } }
        }
    }
}

/// The list, or the bin.
fn other(list: &List, bin: bool) -> String {
    List { choice: Choice { bin, ..Choice::default() }, all: Vec::new(), chosen: None, ..list.clone() }.address(None, 0)
}

fn bytes(list: &List) -> u64 {
    list.all.iter().map(|one| one.recording.bytes).sum()
}

fn search(list: &List) -> Markup {
    let (words, choice) = (list.words(), &list.choice);
    let programs: BTreeSet<&str> = list.all.iter().map(|one| one.recording.name.as_str()).collect();
    let codes: BTreeSet<&str> =
        list.all.iter().filter_map(|one| one.recording.session.participant.as_deref()).collect();
    html! {
        form class="search" method="get" role="search" {
            (list.hidden())
            input type="search" name="find" value=(clean(&choice.find)) maxlength="100" placeholder=(words.find_hint()) aria-label=(words.find_hint());
            (select("program", words.all_programs(), &programs, &choice.program))
            (select("code", words.all_codes(), &codes, &choice.code))
            button class="button" type="submit" { (words.find()) }
        }
    }
}

fn select(name: &str, all: &str, options: &BTreeSet<&str>, chosen: &str) -> Markup {
    html! {
        select name=(name) aria-label=(all) {
            option value="" { (all) }
            @for option in options { option value=(option) selected[*option == chosen] { (clean(option)) } }
        }
    }
}

fn table(list: &List, rows: &[&ListedRecording]) -> Markup {
    let words = list.words();
    html! {
        @if rows.is_empty() { p class="faint" { (if list.choice.bin { words.bin_is_empty() } else { words.none_found() }) } } @else {
            table {
                thead { tr {
                    th scope="col" { (words.code()) } th scope="col" { (words.day()) } th scope="col" { (words.program()) }
                    th scope="col" { (words.length()) } th scope="col" { (words.marks()) } th scope="col" { (words.size()) }
                    th scope="col" { (words.replay()) }
                } }
                tbody { @for one in rows { (row(list, one)) } }
            }
        }
    }
}

fn row(list: &List, one: &ListedRecording) -> Markup {
    let (words, recording) = (list.words(), &one.recording);
    let clock = Clock::of(&recording.began, list.zone);
    let is_chosen = list.chosen.as_ref().is_some_and(|chosen| chosen.listed.recording.file == recording.file);
    let code = recording.session.participant.as_deref();
    html! {
        tr class=[is_chosen.then_some("this")] {
            th scope="row" {
                a href=(list.address(Some(&recording.file), list.choice.rows)) aria-current=[is_chosen.then_some("true")] {
                    @match code { Some(code) => (own(code)), None => (words.no_code()) }
                    span class="hidden" { " " (words.day_of(clock)) " " (clock.at(0)) }
                }
            }
            td { (words.day_of(clock)) br; span class="faint" { (clock.at(0)) (clock.zone()) } }
            td {
                @if let Some(title) = &recording.title { b { (own(title)) } br; }
                (own(&recording.name)) br; span class="faint" { (own(&recording.by)) }
            }
            td data-label=(words.length()) { (recording.length_ms.map(length).unwrap_or_default()) }
            td data-label=(words.marks()) { (one.marks.map(|marks| marks.to_string()).unwrap_or_default()) }
            td data-label=(words.size()) { (size(recording.bytes)) }
            td { (state(words, one, clock)) }
        }
    }
}

/// The state of a recording in few words: that comes first by which something is missing.
fn state(words: Words, one: &ListedRecording, clock: Clock) -> String {
    let Recording { goes_on, old_form, cut_off, session, .. } = &one.recording;
    match one.replayed {
        _ if *goes_on => words.recording_now().to_owned(),
        _ if *old_form => words.old_file().to_owned(),
        _ if session.records == Records::Marks => words.marks_and_actions_only().to_owned(),
        Some(found @ Replayed::Differs(_)) => words.replayed(found, |ms| clock.at(ms)),
        _ if *cut_off => words.ends_early().to_owned(),
        Some(found) => words.replayed(found, |ms| clock.at(ms)),
        None => words.not_looked_at().to_owned(),
    }
}

/// A size for people.
fn size(bytes: u64) -> String {
    match bytes {
        0..1_048_576 => format!("{} KB", bytes.div_ceil(1_024)),
        1_048_576..1_073_741_824 => format!("{} MB", bytes >> 20),
        _ => format!("{}.{} GB", bytes >> 30, (bytes >> 20) % 1_024 * 10 / 1_024),
    }
}
