//! A history as people tell it: sittings, each with its time and its people, older ones folded into a line.

use crate::history::words::{self, HistoryWords};
use behaviour::{Checkpoint, Id};
use protocol::HistoryLine;
use std::collections::{BTreeMap, BTreeSet};

/// A pause of so many milliseconds ends a sitting.
const PAUSE_MS: u64 = 30 * 60_000;
/// So many of the things that were done are named in a folded sitting.
const DEEDS_MAX: usize = 3;

/// One line of the panel.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum SittingEntry {
    /// When a sitting was, and who was there.
    Head { when: String, who: String },
    /// One gesture.
    Gesture(HistoryGesture),
    /// A version with a name.
    Named { revision: u64, name: String, about: String },
    /// A sitting of which only the sum is shown, and its newest revision.
    Folded { revision: u64, author: String, by: Option<Id>, says: String, open: bool },
}

/// What somebody did.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct HistoryGesture {
    pub(super) revision: u64,
    pub(super) author: String,
    pub(super) by: Option<Id>,
    pub(super) mine: bool,
    pub(super) deed: HistoryWords,
    pub(super) at: String,
    pub(super) removes: bool,
}

/// The clock and the calendar of who looks.
pub(super) struct ReaderClock<'a> {
    pub(super) now_ms: f64,
    pub(super) me: Option<&'a Id>,
    pub(super) my_name: &'a str,
    /// How much the clock here is ahead of UTC at a time.
    pub(super) ahead_ms: fn(f64) -> f64,
    /// A day that is neither today nor yesterday, in words.
    pub(super) date: fn(f64) -> String,
}

/// What a history speaks of.
pub(super) struct HistoryScope<'a> {
    /// The people who are here, as they are called now.
    pub(super) names: BTreeMap<Id, String>,
    /// What somebody did with a line.
    pub(super) done: &'a dyn Fn(&HistoryLine) -> HistoryWords,
}

impl HistoryScope<'_> {
    /// Who made a change, as they were called last: whoever renamed themselves is one person.
    fn author(&self, line: &HistoryLine) -> String {
        line.by.as_ref().and_then(|by| self.names.get(by)).unwrap_or(&line.author).clone()
    }
}

impl ReaderClock<'_> {
    /// The day, counted from 1970, and the minute of it.
    fn local(&self, ms: f64) -> (i64, i64) {
        let minutes = ((ms + (self.ahead_ms)(ms)) / 60_000.0).floor() as i64;
        (minutes.div_euclid(24 * 60), minutes.rem_euclid(24 * 60))
    }

    /// `14:05`
    pub(super) fn clock(&self, at_ms: u64) -> String {
        let (_, minute) = self.local(at_ms as f64);
        format!("{}:{:02}", minute / 60, minute % 60)
    }

    fn day(&self, at_ms: u64) -> String {
        let days = self.local(self.now_ms).0 - self.local(at_ms as f64).0;
        match days {
            ..=0 => words::today().to_owned(),
            1 => words::yesterday().to_owned(),
            _ => (self.date)(at_ms as f64),
        }
    }

    /// `Today, 14:05`
    pub(super) fn moment(&self, at_ms: u64) -> String {
        words::from_to(&self.day(at_ms), &self.clock(at_ms), None)
    }

    fn is_mine(&self, line: &HistoryLine) -> bool {
        line.by.is_some() && line.by.as_ref() == self.me
    }
}

/// The panel's lines, newest first. Only the newest sitting, and those that are `unfolded`, are shown whole.
pub(super) fn entries(
    lines: &[HistoryLine],
    versions: &[Checkpoint],
    unfolded: &BTreeSet<u64>,
    here: &ReaderClock,
    mut known: HistoryScope,
) -> Vec<SittingEntry> {
    for line in lines {
        if let Some(by) = &line.by {
            known.names.entry(by.clone()).or_insert_with(|| line.author.clone());
        }
    }
    let known = &known;
    let mut made = Vec::new();
    let sittings = lines.chunk_by(|newer, older| newer.at_ms.saturating_sub(older.at_ms) <= PAUSE_MS);
    for (at, sitting) in sittings.enumerate() {
        made.push(head(sitting, at == 0, here, known));
        let open = at == 0 || unfolded.contains(&sitting[0].revision);
        if at > 0 && sitting.len() > 1 {
            made.push(fold(sitting, open, known));
        }
        for line in sitting {
            made.extend(
                versions.iter().filter(|named| named.revision == line.revision).map(|it| named(it, Some(line), here)),
            );
            if open || sitting.len() == 1 {
                made.push(SittingEntry::Gesture(gesture(line, here, known)));
            }
        }
    }
    let is_known = |revision: u64| lines.iter().any(|line| line.revision == revision);
    made.extend(versions.iter().rev().filter(|version| !is_known(version.revision)).map(|it| named(it, None, here)));
    made
}

fn head(sitting: &[HistoryLine], newest: bool, here: &ReaderClock, known: &HistoryScope) -> SittingEntry {
    let (last, first) = (sitting[0].at_ms, sitting[sitting.len() - 1].at_ms);
    let lasts = newest && here.now_ms - (last as f64) <= PAUSE_MS as f64;
    let to = if lasts { words::now_version().to_owned() } else { here.clock(last) };
    let mut others: Vec<String> = Vec::new();
    for line in sitting.iter().rev().filter(|line| !here.is_mine(line)) {
        let author = known.author(line);
        if !others.contains(&author) {
            others.push(author);
        }
    }
    let you = sitting.iter().any(|line| here.is_mine(line));
    SittingEntry::Head {
        when: words::from_to(&here.day(first), &here.clock(first), Some(&to)),
        who: words::people_and_you(&others, you),
    }
}

fn fold(sitting: &[HistoryLine], open: bool, known: &HistoryScope) -> SittingEntry {
    let mut deeds: Vec<String> = Vec::new();
    for line in sitting.iter().rev() {
        let deed = (known.done)(line).whole();
        if !deeds.contains(&deed) {
            deeds.push(deed);
        }
    }
    let more = if deeds.len() > DEEDS_MAX { " …" } else { "" };
    deeds.truncate(DEEDS_MAX);
    let says = words::folded(sitting.len(), &format!("{}{more}", words::listed(deeds)));
    let newest = &sitting[0];
    SittingEntry::Folded { revision: newest.revision, author: known.author(newest), by: newest.by.clone(), says, open }
}

fn named(version: &Checkpoint, line: Option<&HistoryLine>, here: &ReaderClock) -> SittingEntry {
    let when = here.moment(line.map_or(version.at_ms, |line| line.at_ms));
    let about = words::named_by(&when, &version.by, version.by == here.my_name);
    SittingEntry::Named { revision: version.revision, name: version.name.clone(), about }
}

fn gesture(line: &HistoryLine, here: &ReaderClock, known: &HistoryScope) -> HistoryGesture {
    HistoryGesture {
        revision: line.revision,
        author: known.author(line),
        by: line.by.clone(),
        mine: here.is_mine(line),
        deed: (known.done)(line),
        at: here.clock(line.at_ms),
        removes: line.removes,
    }
}

#[cfg(test)]
mod tests {
    use super::{HistoryScope, ReaderClock, SittingEntry, entries};
    use crate::history::words;
    use behaviour::labels;
    use behaviour::{Checkpoint, Id};
    use protocol::HistoryLine;
    use std::collections::{BTreeMap, BTreeSet};

    const MINUTE: u64 = 60_000;
    const DAY: u64 = 24 * 60 * MINUTE;
    /// Noon of some day.
    const NOON: u64 = 100 * DAY + 12 * 60 * MINUTE;

    fn line(revision: u64, by: &str, label: &str, at_ms: u64) -> HistoryLine {
        let (op, id) = (Id::new(&format!("op{revision}")).unwrap(), Id::new(by).ok());
        let author = by.to_owned();
        let label = match label.split_once(' ') {
            Some((_, name)) => labels::add(name),
            None if label == "Move" => labels::moved(),
            None => labels::tidied(),
        };
        HistoryLine { revision, op, author, by: id, label, at_ms, undoes: None, removes: false, edits: Vec::new() }
    }

    fn said(lines: &[HistoryLine], versions: &[Checkpoint], unfolded: &[u64]) -> Vec<String> {
        let me = Id::new("Aiko").unwrap();
        let here = ReaderClock {
            now_ms: NOON as f64,
            me: Some(&me),
            my_name: "Aiko",
            ahead_ms: |_| 0.0,
            date: |_| "18 November".to_owned(),
        };
        let unfolded: BTreeSet<u64> = unfolded.iter().copied().collect();
        let say = |entry| match entry {
            SittingEntry::Head { when, who } => format!("{when} | {who}"),
            SittingEntry::Gesture(gesture) => format!("{} {}", gesture.at, gesture.deed.whole()),
            SittingEntry::Named { name, about, .. } => format!("{name}: {about}"),
            SittingEntry::Folded { says, open, .. } => format!("{} {says}", if open { "-" } else { "+" }),
        };
        let known = HistoryScope { names: BTreeMap::new(), done: &|line| words::deed(&line.label) };
        entries(lines, versions, &unfolded, &here, known).into_iter().map(say).collect()
    }

    #[test]
    fn a_pause_ends_a_sitting_and_older_ones_are_folded() {
        let lines = [
            line(5, "Aiko", "Move", NOON - MINUTE),
            line(4, "Yuki", "Add Eyes", NOON - 31 * MINUTE),
            line(3, "Aiko", "Tidy", NOON - DAY),
            line(2, "Aiko", "Add Far ball", NOON - DAY - 30 * MINUTE),
            line(1, "Aiko", "Add Ours", NOON - 4 * DAY),
        ];
        let first = ["Today, 11:29 to now | Yuki and you", "11:59 moved something", "11:29 added Eyes"];
        let second = "Yesterday, 11:30 to 12:00 | you";
        let third = ["18 November, 12:00 | you", "12:00 added Ours"];
        let folded = [second, "+ 2 changes: added Far ball, tidied up"];
        assert_eq!(said(&lines, &[], &[]), [&first[..], &folded, &third].concat());
        let open = [second, "- 2 changes: added Far ball, tidied up", "12:00 tidied up", "11:30 added Far ball"];
        assert_eq!(said(&lines, &[], &[3]), [&first[..], &open, &third].concat());
    }

    #[test]
    fn who_renamed_themselves_is_one_person() {
        let by =
            |revision, name: &str| HistoryLine { author: name.into(), ..line(revision, "yuki", "Tidy", NOON - MINUTE) };
        let shown = said(&[by(3, "Dr Yuki"), line(2, "Aiko", "Move", NOON - MINUTE), by(1, "Yuki")], &[], &[]);
        assert_eq!(shown[0], "Today, 11:59 to now | Dr Yuki and you");
    }

    #[test]
    fn a_version_with_a_name_stands_above_the_change_that_made_it() {
        let version =
            |revision, name: &str, by: &str| Checkpoint { revision, name: name.into(), by: by.into(), at_ms: NOON };
        let lines = [line(9, "Aiko", "Move", NOON), line(8, "Aiko", "Tidy", NOON - MINUTE)];
        let shown = said(&lines, &[version(2, "Old", "Yuki"), version(8, "Before group B", "Aiko")], &[]);
        let right = [
            "Today, 11:59 to now | you",
            "12:00 moved something",
            "Before group B: Today, 11:59 · named by you",
            "11:59 tidied up",
            "Old: Today, 12:00 · named by Yuki",
        ];
        assert_eq!(shown, right);
    }
}
