//! The English of a sentence: its words and its holes.

use crate::faults::SentenceFault;

/// An argument that is handed in for a hole.
pub(crate) struct Argument {
    /// The name of the hole, if it is said.
    pub(crate) name: Option<String>,
    /// The code of its value.
    pub(crate) code: String,
}

/// One hole.
struct Hole {
    name: String,
    /// True if it takes the next argument.
    in_order: bool,
    /// The form of what stands in it, with its colon.
    form: String,
}

/// A sentence with its holes.
pub(crate) struct English {
    /// The sentence as it travels: `{name}` for each hole.
    text: String,
    holes: Vec<Hole>,
}

impl English {
    /// Reads a sentence as it is written.
    pub(crate) fn read(written: &str) -> Result<Self, SentenceFault> {
        let (mut text, mut holes, mut rest) = (String::new(), Vec::new(), written);
        while let Some(at) = rest.find(['{', '}']) {
            text.push_str(&rest[..at]);
            let (brace, after) = rest[at..].split_at(1);
            if let Some(after) = after.strip_prefix(brace) {
                text.push_str(brace);
                rest = after;
                continue;
            }
            let (hole, after) = after.split_once('}').filter(|_| brace == "{").ok_or(SentenceFault::OpenHole)?;
            let nth = holes.iter().filter(|hole: &&Hole| hole.in_order).count();
            let (made, shown) = hole_of(hole, nth);
            text.push_str(&shown);
            holes.push(made);
            rest = after;
        }
        text.push_str(rest);
        Ok(Self { text, holes })
    }

    /// The code that makes the phrase; `field` tells how a name of the sentence is written in code.
    pub(crate) fn code(
        &self,
        key: &str,
        arguments: &[Argument],
        field: &dyn Fn(&str) -> Option<String>,
    ) -> Result<String, SentenceFault> {
        let unnamed: Vec<&Argument> = arguments.iter().filter(|argument| argument.name.is_none()).collect();
        let (mut with, mut told) = (String::new(), Vec::new());
        for hole in &self.holes {
            if told.contains(&hole.name) {
                continue;
            }
            told.push(hole.name.clone());
            let named = arguments.iter().find(|argument| argument.name.as_deref() == Some(hole.name.as_str()));
            let value = match (named, hole.in_order) {
                (Some(argument), _) => argument.code.clone(),
                (None, true) => {
                    let nth = hole.name.parse::<usize>().ok();
                    let argument = nth.and_then(|nth| unnamed.get(nth));
                    argument.ok_or(SentenceFault::NoArgument)?.code.clone()
                }
                (None, false) => field(&hole.name).ok_or(SentenceFault::NoArgument)?,
            };
            let phrase = if hole.form.is_empty() {
                format!("::phrase::Phrased::phrase(&({value}))")
            } else {
                format!("::phrase::Phrase::text(::std::format!(\"{{{}}}\", {value}))", hole.form)
            };
            with.push_str(&format!("({:?}, {phrase}),", hole.name));
        }
        Ok(format!("::phrase::Phrase::of({key}, {:?}, ::std::vec![{with}])", self.text))
    }
}

/// Of `name`, `name:?`, `^name` (with a capital letter), `.name` (without its full stop), `name|one|many` (by how many) or nothing; and as it travels.
fn hole_of(hole: &str, nth: usize) -> (Hole, String) {
    let bare = hole.trim_start_matches(['^', '.']);
    let (marks, _) = hole.split_at(hole.len() - bare.len());
    let (bare, forms) = bare.split_once('|').map_or((bare, String::new()), |(bare, forms)| (bare, format!("|{forms}")));
    let (name, form) = bare.split_once(':').map_or((bare, String::new()), |(name, form)| (name, format!(":{form}")));
    let in_order = name.is_empty();
    let name = if in_order { nth.to_string() } else { name.to_owned() };
    let shown = format!("{{{marks}{name}{forms}}}");
    (Hole { name, in_order, form }, shown)
}

/// A text without its quotation marks and backslashes.
pub(crate) fn unquoted(code: &str) -> Option<String> {
    let inner = code.strip_prefix('"')?.strip_suffix('"')?;
    let (mut text, mut rest) = (String::new(), inner.chars());
    while let Some(letter) = rest.next() {
        if letter != '\\' {
            text.push(letter);
            continue;
        }
        match rest.next()? {
            'n' => text.push('\n'),
            't' => text.push('\t'),
            '\n' => rest = rest.as_str().trim_start().chars(),
            'u' => {
                let (number, after) = rest.as_str().strip_prefix('{')?.split_once('}')?;
                text.push(char::from_u32(u32::from_str_radix(number, 16).ok()?)?);
                rest = after.chars();
            }
            other => text.push(other),
        }
    }
    Some(text)
}
