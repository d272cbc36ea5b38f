//! The questions of the library page: which behaviours, in which order, from where on.

use crate::ListedBehaviour;
use behaviour::library::{Cursor, SearchPlace, Sort};
use behaviour::{Behaviour, Procedure, Record, as_looks};

/// The most lines of one page.
pub const PAGE_MAX_LINES: u32 = 1_000;
/// The most bytes of a behaviour that are searched; what comes later is not found. An index of Neo4j takes no more.
const SEARCH_MAX_BYTES: usize = 24_000;

/// A question for behaviours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Query {
    /// The place to look in.
    pub place: SearchPlace,
    /// Words that must all occur, in any case, anywhere in [`search_text`]; empty for everything.
    pub words: String,
    /// The person whose behaviours alone are asked for.
    pub owner: Option<String>,
    /// The tag that the behaviours must have.
    pub tag: Option<String>,
    /// The order.
    pub sort: Sort,
    /// After which line the page begins.
    pub after: Option<Cursor>,
    /// The most lines that are wanted, at most [`PAGE_MAX_LINES`].
    pub most: u32,
}

impl Default for Query {
    fn default() -> Self {
        Self {
            place: SearchPlace::Here,
            words: String::new(),
            owner: None,
            tag: None,
            sort: Sort::Changed,
            after: None,
            most: PAGE_MAX_LINES,
        }
    }
}

impl Query {
    /// The words to look for, in lower case.
    #[must_use]
    pub fn needles(&self) -> Vec<String> {
        as_looks(&self.words).split_whitespace().map(str::to_lowercase).collect()
    }

    /// True if a line is on this page or a later one.
    #[must_use]
    pub fn comes_after(&self, line: &ListedBehaviour) -> bool {
        let Some(after) = &self.after else { return true };
        match self.sort {
            Sort::Changed => (line.changed_ms, &line.id) < (after.changed_ms, &after.id),
            Sort::Name => (name_key(&line.name), &line.id) > (after.name_key.clone(), &after.id),
        }
    }
}

/// The place of a line.
fn place_of(line: &ListedBehaviour) -> Cursor {
    Cursor { changed_ms: line.changed_ms, name_key: name_key(&line.name), id: line.id.clone() }
}

/// A page.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The lines of the page.
    pub lines: Vec<ListedBehaviour>,
    /// The line after which the next page begins, if there is one.
    pub next: Option<Cursor>,
    /// The number of behaviours in that place altogether, whatever the query asks.
    pub total: u64,
}

impl Listing {
    /// A page from lines in order, of which there may be one more than asked for.
    #[must_use]
    pub fn of(mut lines: Vec<ListedBehaviour>, query: &Query, total: u64) -> Self {
        let most = query.most.min(PAGE_MAX_LINES) as usize;
        let more = lines.len() > most;
        lines.truncate(most);
        let next = lines.last().filter(|_| more).map(place_of);
        Self { lines, next, total }
    }
}

/// A name as names are ordered.
pub(crate) fn name_key(name: &str) -> String {
    as_looks(name).to_lowercase()
}

/// The text in which words are searched, in lower case: the name and the tags, then streams with their devices, notes, and
/// procedures.
#[must_use]
pub fn search_text(behaviour: &Behaviour) -> String {
    let mut text = behaviour.name().to_owned();
    for tag in behaviour.settings().into_iter().flat_map(|settings| &settings.tags) {
        text.push('\n');
        text.push_str(tag);
    }
    for part in behaviour.records.values().flat_map(parts) {
        text.push('\n');
        text.push_str(part);
        if text.len() > SEARCH_MAX_BYTES {
            break;
        }
    }
    let mut text = as_looks(&text).to_lowercase();
    text.truncate(text.floor_char_boundary(SEARCH_MAX_BYTES));
    text
}

fn parts(record: &Record) -> Vec<&str> {
    match record {
        Record::Stream(stream) => {
            [Some(stream.name.as_str()), stream.device.as_deref()].into_iter().flatten().collect()
        }
        Record::Note(note) => vec![&note.text],
        Record::Group(group) => vec![&group.title],
        Record::Pad(pad) => pad.tiles.values().map(|tile| tile.label.as_str()).collect(),
        Record::Connector(connector) => match connector.operation.procedure() {
            Some(Procedure::Body { body, .. }) => vec![body],
            Some(Procedure::Helper(name)) => vec![name],
            None => Vec::new(),
        },
        Record::Settings(_) | Record::Place(_) | Record::Helper(_) => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::{SEARCH_MAX_BYTES, search_text};
    use behaviour::{Behaviour, Id, Kind, Note, Record, RecordId, Settings};

    #[test]
    fn the_searched_text_has_a_bound_and_begins_with_the_name() {
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(RecordId::settings(), Record::Settings(Settings::named("Ball İ")));
        let note = Record::Note(Note::new("é".repeat(SEARCH_MAX_BYTES)));
        behaviour.records.insert(RecordId::new(Kind::Note, &Id::new("n").unwrap()), note);
        let text = search_text(&behaviour);
        assert!(text.starts_with("ball ") && text.len() <= SEARCH_MAX_BYTES && text.len() > SEARCH_MAX_BYTES - 4);
    }
}
