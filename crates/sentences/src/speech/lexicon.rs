//! The words of a language by what they mean, read from a file: a word is one line.
//!
//! `child, children = who` gives two writings one meaning. `tap ~ = v touch` has the regular forms of English verbs, and
//! `hold|holds|held|holding = v hold` other ones. `触,さわ/る = v touch` has those of the table of inflection that is named
//! after the `/`. `! cry = …` is what is said of a meaning that no sense or action has, and `? pink = magenta` what may be
//! said in its place.

use crate::Language;
use std::collections::BTreeMap;

/// The form of a word that has several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct WordForm {
    /// How it ends a clause or leads on.
    pub(super) end: FormEnd,
    /// Whether somebody else does it.
    pub(super) passive: bool,
    /// Whether it is not so.
    pub(super) not: bool,
    /// Whether it lasts.
    pub(super) lasts: bool,
    /// True if it is said to go on: 触り続けたら.
    pub(super) keeps: bool,
}

/// How a form ends a clause or leads on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FormEnd {
    /// No form: as it is.
    #[default]
    Plain,
    /// English: as with *he*.
    Third,
    /// English: as with *was*.
    Past,
    /// English: `-ing`.
    Ing,
    /// Japanese: 触る, 触ります.
    Dict,
    /// Japanese: 触った.
    Did,
    /// Japanese: 触って.
    Te,
    /// Japanese: 触ったら.
    Tara,
    /// Japanese: 触れば.
    Ba,
    /// Japanese: 触り.
    Stem,
}

/// What a writing means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WritingSense {
    pub(super) kind: &'static str,
    pub(super) arg: &'static str,
    pub(super) form: WordForm,
}

/// A writing: its parts after the first one, and what it means.
#[derive(Debug)]
struct LexiconEntry {
    rest: Vec<&'static str>,
    /// English: forms of the first word are entries of their own. Japanese: the name of the table of its endings.
    class: Option<&'static str>,
    sense: WritingSense,
}

/// The words of a language.
#[derive(Debug, Default)]
pub struct Lexicon {
    entries: BTreeMap<String, Vec<LexiconEntry>>,
    /// By the table's name: endings with their forms.
    endings: BTreeMap<&'static str, Vec<(String, WordForm)>>,
    /// By what is meant: why it cannot be done.
    gaps: BTreeMap<&'static str, &'static str>,
    /// By what is meant: what may be said in its place.
    offers: BTreeMap<&'static str, &'static str>,
    /// Whether words have spaces between them.
    is_spaced: bool,
}

/// A word that was found: where it ends, and what it means.
pub(super) type FoundWord = (usize, WritingSense);

impl Lexicon {
    /// Reads the words of a language.
    #[must_use]
    pub fn read(text: &'static str, language: Language) -> Self {
        let mut lexicon = Self { is_spaced: language == Language::English, ..Self::default() };
        let mut tables: BTreeMap<&'static str, Vec<&'static str>> = BTreeMap::new();
        let mut chains: Vec<(&'static str, &'static str, &'static str)> = Vec::new();
        for line in text.lines() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let Some((left, right)) = line.split_once('=') else { continue };
            let (left, right) = (left.trim(), right.trim());
            if let Some(gap) = left.strip_prefix('!') {
                lexicon.gaps.insert(gap.trim(), right);
            } else if let Some(gap) = left.strip_prefix('?') {
                lexicon.offers.insert(gap.trim(), right);
            } else if let Some(class) = left.strip_prefix('%') {
                tables.insert(class.trim(), right.split_whitespace().collect());
            } else if let Some(chain) = left.strip_prefix('+') {
                let (stem, ending) = chain.trim().split_once(' ').unwrap_or((chain.trim(), ""));
                chains.push((stem, ending.trim(), right));
            } else {
                lexicon.word(left, right);
            }
        }
        for (class, stems) in tables {
            let mut endings = Vec::new();
            inflect(&stems, &chains, "", WordForm::default(), 0, &mut endings);
            lexicon.endings.insert(class, endings);
        }
        lexicon
    }

    /// The words of a language, of which the program has both files.
    #[cfg(feature = "lexicons")]
    #[must_use]
    pub fn of(language: Language) -> &'static Self {
        use std::sync::LazyLock;
        static ENGLISH: LazyLock<Lexicon> =
            LazyLock::new(|| Lexicon::read(include_str!("../../../../static/speech-en.txt"), Language::English));
        static JAPANESE: LazyLock<Lexicon> =
            LazyLock::new(|| Lexicon::read(include_str!("../../../../static/speech-ja.txt"), Language::Japanese));
        match language {
            Language::English => &ENGLISH,
            Language::Japanese => &JAPANESE,
        }
    }

    fn word(&mut self, left: &'static str, right: &'static str) {
        let (kind, arg) = right.split_once(' ').unwrap_or((right, ""));
        let plain = WritingSense { kind, arg: arg.trim(), form: WordForm::default() };
        for writing in left.split(',').map(str::trim).filter(|writing| !writing.is_empty()) {
            if let Some((word, rest)) = writing.split_once('~') {
                for (form, end) in regular(word.trim()) {
                    self.put(
                        &form,
                        rest.trim(),
                        None,
                        WritingSense { form: WordForm { end, ..WordForm::default() }, ..plain },
                    );
                }
            } else if writing.contains('|') {
                let (forms, rest) = writing.split_once(' ').unwrap_or((writing, ""));
                let ends = [FormEnd::Plain, FormEnd::Third, FormEnd::Past, FormEnd::Ing, FormEnd::Past];
                for (form, end) in forms.split('|').zip(ends) {
                    self.put(form, rest, None, WritingSense { form: WordForm { end, ..WordForm::default() }, ..plain });
                }
            } else {
                let (writing, class) = match writing.split_once('/') {
                    Some((stem, class)) if !self.is_spaced => (stem, Some(class)),
                    _ => (writing, None),
                };
                let (first, rest) = self.cut(writing);
                self.put(first, rest, class, plain);
            }
        }
    }

    /// The first token of a writing and the rest.
    fn cut<'w>(&self, writing: &'w str) -> (&'w str, &'w str) {
        if self.is_spaced {
            return writing.split_once(' ').unwrap_or((writing, ""));
        }
        let letters = writing.chars().take_while(char::is_ascii_alphabetic).count();
        let first = if letters > 0 { letters } else { writing.chars().next().map_or(0, char::len_utf8) };
        writing.split_at(first)
    }

    fn put(&mut self, first: &str, rest: &'static str, class: Option<&'static str>, sense: WritingSense) {
        let rest = if self.is_spaced {
            rest.split_whitespace().collect()
        } else {
            rest.char_indices().map(|(at, c)| &rest[at..at + c.len_utf8()]).collect()
        };
        self.entries.entry(first.to_owned()).or_default().push(LexiconEntry { rest, class, sense });
    }

    /// All words that begin with this token.
    pub(super) fn at(&self, tokens: &[&str], at: usize) -> Vec<FoundWord> {
        let mut found = Vec::new();
        let Some(entries) = tokens.get(at).and_then(|first| self.entries.get(*first)) else { return found };
        for entry in entries {
            let end = at + 1 + entry.rest.len();
            if end > tokens.len() || tokens[at + 1..end] != entry.rest[..] {
                continue;
            }
            match entry.class.and_then(|class| self.endings.get(class)) {
                None => found.push((end, entry.sense)),
                Some(endings) => {
                    for (ending, form) in endings {
                        let mut to = end;
                        let fits = ending.chars().all(|c| {
                            let is = tokens.get(to).is_some_and(|token| token.chars().eq([c]));
                            to += 1;
                            is
                        });
                        if fits {
                            found.push((to, WritingSense { form: *form, ..entry.sense }));
                        }
                    }
                }
            }
        }
        found
    }

    /// Why a meaning cannot be sensed or done.
    pub(crate) fn gap(&self, arg: &str) -> Option<&'static str> {
        self.gaps.get(arg).copied()
    }

    /// The words that may be said in the place of those for what cannot be done, by the reason.
    pub(super) fn offer(&self, why: &str) -> Option<&'static str> {
        let (gap, _) = self.gaps.iter().find(|(_, said)| **said == why)?;
        self.offers.get(gap).copied()
    }

    /// Why conditions that can never be so at once are asked about.
    pub(crate) fn never(&self) -> &'static str {
        self.gap("never").unwrap_or_default()
    }

    /// Words that look like this one: one letter other, too many, missing, or two in each other's place; the likest first.
    pub(super) fn like(&self, word: &str) -> Vec<String> {
        let letters: Vec<char> = word.chars().collect();
        let most = if letters.len() >= 7 { 2 } else { 1 };
        if letters.len() < 3 {
            return Vec::new();
        }
        let known = self.entries.iter().filter(|(_, entries)| entries.iter().any(|entry| entry.rest.is_empty()));
        let mut like: Vec<(usize, &String)> = known
            .filter_map(|(known, _)| Some((apart(&letters, &known.chars().collect::<Vec<_>>(), most)?, known)))
            .collect();
        // Slips are seldom in the first letter.
        like.sort_by_key(|(apart, known)| (*apart, known.chars().next() != letters.first().copied(), *known));
        like.truncate(3);
        like.into_iter().map(|(_, known)| known.clone()).collect()
    }

    /// Writings of verbs that look like what stands here: the forms of a word whose beginning stands there.
    pub(super) fn inflected_like(&self, text: &str) -> Vec<String> {
        let letters: Vec<char> = text.chars().collect();
        let Some(first) = letters.first() else { return Vec::new() };
        let mut like: Vec<(usize, usize, String)> = Vec::new();
        for entry in self.entries.get(&first.to_string()).into_iter().flatten() {
            let stem: String = std::iter::once(*first).chain(entry.rest.iter().flat_map(|part| part.chars())).collect();
            let Some(endings) = entry.class.and_then(|class| self.endings.get(class)) else {
                let whole: Vec<char> = stem.chars().collect();
                if whole.len() >= 3
                    && letters.len() >= 2
                    && apart(&letters, &whole, 1).is_some()
                    && !like.iter().any(|(.., known)| *known == stem)
                {
                    like.push((1, 2, stem));
                }
                continue;
            };
            // A mark of the voice that is missing is a slip within the beginning: おじき.
            let starts = stem.chars().count() <= letters.len()
                && text.chars().zip(stem.chars()).all(|(typed, known)| bare(typed) == bare(known));
            if !starts {
                continue;
            }
            for (ending, form) in endings {
                let whole: Vec<char> = stem.chars().chain(ending.chars()).collect();
                let bare_alike =
                    letters.len() == whole.len() && letters.iter().zip(&whole).all(|(a, b)| bare(*a) == bare(*b));
                if let Some(distance) = if bare_alike { Some(0) } else { apart(&letters, &whole, 1) }
                    && !form.not
                    && !like.iter().any(|(.., known)| known.chars().eq(whole.iter().copied()))
                {
                    like.push((distance, usize::from(whole.len() < letters.len()), whole.into_iter().collect()));
                }
            }
        }
        like.sort();
        like.truncate(3);
        like.into_iter().map(|(.., whole)| whole).collect()
    }
}

/// A letter of kana large and without the mark of its voice: つ of っ, き of ぎ.
fn bare(kana: char) -> char {
    const VOICED: &str = "がかぎきぐくげけごこざさじしずすぜせぞそだたぢちづつでてどとばはびひぶふべへぼほぱはぴひぷふぺへぽほっつゃやゅゆょよぁあぃいぅうぇえぉお";
    let mut pairs = VOICED.chars();
    while let (Some(marked), Some(plain)) = (pairs.next(), pairs.next()) {
        if marked == kana {
            return plain;
        }
    }
    kana
}

/// How many slips two words are apart, if not more than so many.
fn apart(one: &[char], other: &[char], most: usize) -> Option<usize> {
    if one.len().abs_diff(other.len()) > most {
        return None;
    }
    let width = other.len() + 1;
    let mut rows = vec![0; (one.len() + 1) * width];
    for (at, cell) in rows.iter_mut().take(width).enumerate() {
        *cell = at;
    }
    for i in 1..=one.len() {
        rows[i * width] = i;
        for j in 1..=other.len() {
            let same = usize::from(one[i - 1] != other[j - 1]);
            let mut best = (rows[(i - 1) * width + j] + 1).min(rows[i * width + j - 1] + 1);
            best = best.min(rows[(i - 1) * width + j - 1] + same);
            if i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1] {
                best = best.min(rows[(i - 2) * width + j - 2] + 1);
            }
            rows[i * width + j] = best;
        }
    }
    rows.last().copied().filter(|distance| *distance <= most)
}

/// The regular forms of an English verb; one that ends with `*` doubles its last letter.
fn regular(word: &str) -> [(String, FormEnd); 4] {
    let doubled = word.strip_suffix('*');
    let word = doubled.unwrap_or(word);
    let last = word.chars().last().unwrap_or(' ');
    let before_y = word.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u']));
    let third = match before_y {
        Some(stem) => format!("{stem}ies"),
        None if word.ends_with(['s', 'x', 'o']) || word.ends_with("sh") || word.ends_with("ch") => format!("{word}es"),
        None => format!("{word}s"),
    };
    let stem = match (doubled, word.strip_suffix('e')) {
        (Some(_), _) => format!("{word}{last}"),
        (None, Some(stem)) if !word.ends_with("ee") => stem.to_owned(),
        _ => word.to_owned(),
    };
    let past = before_y.map_or_else(|| format!("{stem}ed"), |stem| format!("{stem}ied"));
    [
        (word.to_owned(), FormEnd::Plain),
        (third, FormEnd::Third),
        (past, FormEnd::Past),
        (format!("{stem}ing"), FormEnd::Ing),
    ]
}

/// て, た and ちゃ as they are after 死ん, 飛ん or 読ん.
fn voiced_ending(ending: &str) -> String {
    let mut chars = ending.chars();
    let first = match chars.next() {
        Some('た') => 'だ',
        Some('て') => 'で',
        Some('ち') => 'じ',
        other => return other.into_iter().chain(chars).collect(),
    };
    std::iter::once(first).chain(chars).collect()
}

/// All endings of a table: `stems` are those of the rows *a i u e ta*, which the chains of auxiliaries go on from.
fn inflect(
    stems: &[&str],
    chains: &[(&'static str, &'static str, &'static str)],
    before: &str,
    form: WordForm,
    depth: usize,
    to: &mut Vec<(String, WordForm)>,
) {
    const ROWS: [&str; 6] = ["a", "i", "u", "e", "t", "p"];
    // 一段 verbs have one stem and た, て as they are.
    const ONE: [&str; 6] = ["", "", "る", "れ", "", "られ"];
    for (row, ending, means) in chains {
        let Some(at) = ROWS.iter().position(|known| known == row) else { continue };
        let Some(stem) = stems.get(at) else { continue };
        let stem = if *stem == "-" { "" } else { stem };
        // た becomes だ after some stems.
        let voiced = at == 4 && (stem.ends_with('ん') || stem.ends_with('*'));
        let stem = stem.trim_end_matches('*');
        let ending = if voiced { voiced_ending(ending) } else { (*ending).to_owned() };
        let whole = format!("{before}{stem}{ending}");
        let mut now = form;
        let (mut goes_on, mut is_again) = (false, false);
        for word in means.split_whitespace() {
            match word {
                "dict" => now.end = FormEnd::Dict,
                "did" => now.end = FormEnd::Did,
                "te" => now.end = FormEnd::Te,
                "tara" => now.end = FormEnd::Tara,
                "ba" => now.end = FormEnd::Ba,
                "stem" => now.end = FormEnd::Stem,
                "not" => now.not = true,
                "keeps" => now.keeps = true,
                "passive" => {
                    is_again |= form.passive;
                    (now.passive, goes_on) = (true, true);
                }
                "lasts" => {
                    is_again |= form.lasts;
                    (now.lasts, goes_on) = (true, true);
                }
                _ => {}
            }
        }
        if !goes_on {
            to.push((whole, now));
        } else if depth < 2 && !is_again {
            inflect(&ONE, chains, &whole, now, depth + 1, to);
        }
    }
}
