//! The box for a procedure: a plain text area over a coloured picture of the same text.

use crate::words;
use leptos::prelude::*;

/// The box for a procedure.
#[component]
pub(crate) fn CodeField(
    #[prop(into)] label: String,
    value: RwSignal<String>,
    /// Names that stand for values.
    #[prop(into)]
    arguments: Signal<Vec<String>>,
    /// A name in it that means nothing; it is underlined.
    #[prop(optional, into)]
    unknown: Signal<Option<String>>,
    /// What tells more about the box, by its id.
    #[prop(optional, into)]
    described_by: String,
    /// Most texts are one line: Enter saves what looks whole, Shift and Enter begin a new line.
    #[prop(optional)]
    one_line: bool,
) -> impl IntoView {
    let coloured = move || {
        let pieces = pieces(&value.read(), &arguments.read(), unknown.read().as_deref());
        pieces.into_iter().map(|(class, text)| view! { <span class=class>{text}</span> }).collect_view()
    };
    view! {
        <div class="code">
            <pre aria-hidden="true">{coloured}"\u{200b}"</pre>
            <textarea
                aria-label=label
                aria-describedby=described_by
                data-first=""
                data-one-line=one_line.then_some("")
                spellcheck="false"
                autocapitalize="off"
                autocomplete="off"
                rows="1"
                maxlength=behaviour::BODY_MAX_CHARS.to_string()
                prop:value=move || value.get()
                on:input:target=move |event| value.set(event.target().value())
            ></textarea>
        </div>
        <p class="faint saves">{if one_line { words::line_saves() } else { words::text_saves() }}</p>
    }
}

/// The class of a name that means nothing.
const UNKNOWN: &str = "unknown-token";
const WORDS: &str = "if else switch do while loop until for in continue break return throw try catch let const fn true \
    false is_def_var this";

/// The text cut into pieces with the class that colours each.
pub(crate) fn pieces(body: &str, arguments: &[String], unknown: Option<&str>) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    let mut rest = body;
    while let Some(first) = rest.chars().next() {
        let (class, length) = piece(rest, first, arguments);
        let (text, after) = rest.split_at(length);
        let class = if unknown == Some(text) && is_word(class) { UNKNOWN } else { class };
        found.push((class, text.to_owned()));
        rest = after;
    }
    found
}

fn piece(rest: &str, first: char, arguments: &[String]) -> (&'static str, usize) {
    if rest.starts_with("//") {
        return ("note-token", rest.find('\n').unwrap_or(rest.len()));
    }
    if let Some(inside) = rest.strip_prefix("/*") {
        return ("note-token", inside.find("*/").map_or(rest.len(), |at| at + 4));
    }
    match first {
        '"' | '`' | '\'' => ("text-token", quoted(rest, first)),
        '0'..='9' => ("number-token", run(rest, |c| c.is_ascii_alphanumeric() || c == '.' || c == '_')),
        '<' | '>' | '=' | '!' | '&' | '|' | '+' | '-' | '*' | '/' | '%' | '^' | '?' => {
            ("sign-token", run(rest, |c| "<>=!&|+-*%^?".contains(c)).max(1))
        }
        _ if behaviour::is_name_letter(first) => {
            let length = run(rest, behaviour::is_name_letter);
            (word_class(&rest[..length], arguments), length)
        }
        _ => ("", first.len_utf8()),
    }
}

/// Whether what has this class may be a name.
fn is_word(class: &str) -> bool {
    matches!(class, "" | "argument-token")
}

fn word_class(word: &str, arguments: &[String]) -> &'static str {
    if arguments.iter().any(|argument| argument == word) {
        "argument-token"
    } else if WORDS.split_whitespace().any(|known| known == word) {
        "word-token"
    } else {
        ""
    }
}

fn run(rest: &str, belongs: impl Fn(char) -> bool) -> usize {
    rest.find(|c| !belongs(c)).unwrap_or(rest.len())
}

fn quoted(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + c.len_utf8();
        }
        escaped = c == '\\' && !escaped;
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::pieces;

    #[test]
    fn the_picture_has_exactly_the_same_text() {
        let arguments = ["ball".to_owned()];
        for body in ["ball.x < 20.5 // far", "if ball > 1 { \"l\\\"é\" } else { `x` }", "/* open", "'", "赤 + 1", ""]
        {
            let joined: String = pieces(body, &arguments, Some("x")).into_iter().map(|piece| piece.1).collect();
            assert_eq!(joined, body);
        }
    }

    #[test]
    fn arguments_numbers_and_words_have_their_colours() {
        let found = pieces("if ball<20", &["ball".to_owned()], None);
        let classes: Vec<_> = found.iter().filter(|piece| piece.1 != " ").map(|piece| piece.0).collect();
        assert_eq!(classes, ["word-token", "argument-token", "sign-token", "number-token"]);
    }

    #[test]
    fn a_name_that_means_nothing_is_underlined_and_no_text_of_that_name() {
        let found = pieces("blo.x + \"blo\" + blob", &["blob".to_owned()], Some("blo"));
        let underlined: Vec<_> = found.iter().map(|(class, _)| *class == "unknown-token").collect();
        assert_eq!(underlined.iter().filter(|is| **is).count(), 1);
        assert!(underlined[0], "{found:?}");
    }
}
