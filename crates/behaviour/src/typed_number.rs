//! Numbers as people type them: with a point or a comma before the decimals, with groups of three digits, in the digits of
//! a wide keyboard. Nobody guesses: what may be read in two ways is told as both.

use std::iter::Peekable;
use std::str::CharIndices;

/// The most digits of a number, with its separators.
const CHARS_MAX: usize = 40;

/// A number that somebody typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TypedNumber {
    /// It can be read in one way only.
    Is(f64),
    /// A separator before three digits: in some countries it groups them, the first, in others it begins the decimals, the
    /// second.
    Either(f64, f64),
}

impl TypedNumber {
    /// The number, where only one can be meant.
    #[must_use]
    pub fn one(self) -> Option<f64> {
        match self {
            Self::Is(number) => Some(number),
            Self::Either(..) => None,
        }
    }
}

/// The number that is the whole text, with blanks around it; none if it is no finite number.
#[must_use]
pub fn typed_number(text: &str) -> Option<TypedNumber> {
    let text = text.trim();
    if let Some((number, length)) = number_at(text)
        && length == text.len()
    {
        return Some(number);
    }
    // 1e-3 and .5, as machines and a few people write them.
    let plain: String = text.chars().map(plain).collect();
    let is_plain = plain.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
    let number = plain.replacen(',', ".", 1).parse().ok().filter(|number: &f64| number.is_finite());
    number.filter(|_| is_plain || plain.trim_start_matches(['+', '-']).starts_with(',')).map(TypedNumber::Is)
}

/// The number with which a text begins, and how many bytes of it that is.
#[must_use]
pub fn number_at(text: &str) -> Option<(TypedNumber, usize)> {
    let mut chars = text.char_indices().peekable();
    let sign = chars.peek().map(|(_, c)| plain(*c)).filter(|c| "+-".contains(*c));
    if sign.is_some() {
        chars.next();
    }
    let (mut parts, mut between) = (vec![digits(&mut chars)?], Vec::new());
    let mut end = chars.peek().map_or(text.len(), |(at, _)| *at);
    while let Some(&(_, separator)) = chars.peek().filter(|(_, c)| is_separator(*c)) {
        let mut ahead = chars.clone();
        ahead.next();
        let Some(next) = digits(&mut ahead) else { break };
        if is_blank(separator) && next.len() != 3 {
            break;
        }
        (parts, between) = (with(parts, next), with(between, if is_blank(separator) { ' ' } else { plain(separator) }));
        chars = ahead;
        end = chars.peek().map_or(text.len(), |(at, _)| *at);
        if end > CHARS_MAX {
            return None;
        }
    }
    let number = meant(&parts, &between).filter(|_| end <= CHARS_MAX)?;
    let signed = |number: f64| if sign == Some('-') { -number } else { number };
    let number = match number {
        TypedNumber::Is(number) => TypedNumber::Is(signed(number)),
        TypedNumber::Either(one, other) => TypedNumber::Either(signed(one), signed(other)),
    };
    Some((number, end))
}

fn with<T>(mut all: Vec<T>, one: T) -> Vec<T> {
    all.push(one);
    all
}

fn digits(chars: &mut Peekable<CharIndices>) -> Option<String> {
    let mut digits = String::new();
    while let Some(digit) = chars.next_if(|(_, c)| plain(*c).is_ascii_digit()) {
        digits.push(plain(digit.1));
    }
    Some(digits).filter(|digits| !digits.is_empty())
}

/// Reads digits with separators between them; returns both meanings if there are two.
fn meant(parts: &[String], between: &[char]) -> Option<TypedNumber> {
    let whole = || parts.concat().parse().ok().map(TypedNumber::Is);
    let decimal = || {
        let (last, before) = parts.split_last()?;
        format!("{}.{last}", before.concat()).parse::<f64>().ok()
    };
    let groups = |parts: &[String]| {
        matches!(parts[0].len(), 1..=3) && !parts[0].starts_with('0') && parts[1..].iter().all(|part| part.len() == 3)
    };
    match between {
        [] => whole(),
        [' '] => groups(parts).then(whole)?,
        [one] => {
            // The page writes points, and no zeros at the end: 1.125 is its own, 1.500 somebody typed.
            let may_group = groups(parts) && (*one == ',' || parts[1].ends_with('0'));
            let decimal = decimal()?;
            Some(match whole() {
                Some(TypedNumber::Is(whole)) if may_group => TypedNumber::Either(whole, decimal),
                _ => TypedNumber::Is(decimal),
            })
        }
        [first, .., last] if first != last => {
            let all_but_last_same = between[..between.len() - 1].iter().all(|one| one == first);
            let fits = all_but_last_same && groups(&parts[..parts.len() - 1]) && *last != ' ';
            fits.then(decimal)?.map(TypedNumber::Is)
        }
        [first, rest @ ..] => {
            let fits = rest.iter().all(|one| one == first) && groups(parts);
            fits.then(whole)?
        }
    }
}

fn is_separator(c: char) -> bool {
    matches!(plain(c), '.' | ',') || is_blank(c)
}

/// A blank that may group digits: one at which no line ends.
fn is_blank(c: char) -> bool {
    matches!(c, '\u{a0}' | '\u{202f}' | '\u{2007}')
}

/// Digits and signs of wide keyboards as plain ones, and the true minus.
fn plain(c: char) -> char {
    match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        '−' | '\u{2010}' | '\u{2011}' | '–' => '-',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::{TypedNumber, number_at, typed_number};

    #[test]
    fn both_decimal_signs_are_read() {
        let cases = [
            ("1.5", 1.5),
            ("1,5", 1.5),
            (" 0,5 ", 0.5),
            ("０．５", 0.5),
            ("１，２５", 1.25),
            ("−3", -3.0),
            ("-0,25", -0.25),
            ("+2", 2.0),
            ("1,234.5", 1234.5),
            ("1.234,5", 1234.5),
            ("1,234,567", 1_234_567.0),
            ("1\u{202f}000", 1000.0),
            ("0,125", 0.125),
            ("1.125", 1.125),
            ("1000", 1000.0),
            ("1234,567", 1234.567),
            ("1e-3", 0.001),
            (".5", 0.5),
            (",5", 0.5),
        ];
        cases.into_iter().for_each(|(text, is)| assert_eq!(typed_number(text), Some(TypedNumber::Is(is)), "{text}"));
    }

    #[test]
    fn what_may_be_read_in_two_ways_is_not_guessed() {
        for (text, grouped, decimal) in
            [("1,000", 1000.0, 1.0), ("-2,500", -2500.0, -2.5), ("12,345", 12345.0, 12.345), ("1.500", 1500.0, 1.5)]
        {
            assert_eq!(typed_number(text), Some(TypedNumber::Either(grouped, decimal)), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_none() {
        let long = "1".repeat(400);
        for text in ["", "a", "1a", "1 2", "1,,5", "1.2.3", "1,2,3", "--1", "inf", "NaN", "1,5,", "0x1", &long, "1e999"]
        {
            assert_eq!(typed_number(text), None, "{text}");
        }
    }

    #[test]
    fn a_number_ends_where_it_is_over() {
        let one = |number, length| Some((TypedNumber::Is(number), length));
        assert_eq!(number_at("1,5 m"), one(1.5, 3));
        assert_eq!(number_at("40, the head"), one(40.0, 2));
        assert_eq!(number_at("5. Then"), one(5.0, 1));
        assert_eq!(number_at("４０cm"), one(40.0, 6));
        assert_eq!(number_at("m"), None);
    }
}
