//! Keys by their names, as `KeyboardEvent.key` has them, with modifiers: `Enter`, `a`, `Control+Shift+z`.

use serde_json::{Value, json};

/// Named keys with their Windows codes and the text that they make.
const NAMED: [(&str, u32, &str); 16] = [
    ("Enter", 13, "\r"),
    ("Tab", 9, ""),
    ("Escape", 27, ""),
    ("Backspace", 8, ""),
    ("Delete", 46, ""),
    ("Insert", 45, ""),
    ("Space", 32, " "),
    ("ArrowLeft", 37, ""),
    ("ArrowUp", 38, ""),
    ("ArrowRight", 39, ""),
    ("ArrowDown", 40, ""),
    ("Home", 36, ""),
    ("End", 35, ""),
    ("PageUp", 33, ""),
    ("PageDown", 34, ""),
    ("ContextMenu", 93, ""),
];
const MODIFIERS: [(&str, u32); 4] = [("Alt", 1), ("Control", 2), ("Meta", 4), ("Shift", 8)];

/// The two events of pressing and releasing a key, or `None` for a name that is not known.
pub(crate) fn events(chord: &str) -> Option<[Value; 2]> {
    let (modifiers, key) = split(chord)?;
    let (name, code, windows, text) = describe(key)?;
    let types = modifiers & !8 == 0 && !text.is_empty();
    let mut down = json!({
        "type": if types { "keyDown" } else { "rawKeyDown" },
        "key": name, "code": code, "windowsVirtualKeyCode": windows, "modifiers": modifiers,
    });
    let mut up = down.clone();
    up["type"] = "keyUp".into();
    if types {
        down["text"] = text.into();
    }
    Some([down, up])
}

/// Modifier bits and the key itself; `+` alone, or at the end, is the plus key.
fn split(chord: &str) -> Option<(u32, &str)> {
    let mut bits = 0;
    let mut rest = chord;
    while let Some((word, more)) = rest.split_once('+').filter(|(word, more)| !word.is_empty() && !more.is_empty()) {
        bits |= MODIFIERS.iter().find(|(name, _)| *name == word)?.1;
        rest = more;
    }
    Some((bits, rest))
}

/// A key's `key`, `code`, Windows code and text.
fn describe(key: &str) -> Option<(String, String, u32, String)> {
    if let Some((name, windows, text)) = NAMED.iter().find(|(name, _, _)| *name == key) {
        let shown = if *name == "Space" { " " } else { name };
        return Some((shown.to_owned(), (*name).to_owned(), *windows, (*text).to_owned()));
    }
    if let Some(number) = key.strip_prefix('F').and_then(|digits| digits.parse::<u32>().ok()) {
        return (1..=12).contains(&number).then(|| (key.to_owned(), key.to_owned(), 111 + number, String::new()));
    }
    let letter = key.chars().next().filter(|letter| key.len() == letter.len_utf8())?;
    let big = letter.to_ascii_uppercase();
    let (code, windows) = match big {
        ' ' => ("Space".to_owned(), 32),
        'A'..='Z' => (format!("Key{big}"), u32::from(big)),
        '0'..='9' => (format!("Digit{big}"), u32::from(big)),
        _ => (String::new(), 0),
    };
    Some((key.to_owned(), code, windows, key.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_are_read_as_written() {
        assert_eq!(split("Control+Shift+z"), Some((10, "z")));
        assert_eq!(split("+"), Some((0, "+")));
        assert_eq!(split("Control++"), Some((2, "+")));
        assert_eq!(split("Ctrl+z"), None);
    }

    #[test]
    fn a_shortcut_types_nothing() {
        let typed = |chord: &str| events(chord).map(|[down, _]| down["text"].clone());
        assert_eq!(typed("a"), Some("a".into()));
        assert_eq!(typed("Control+a"), Some(Value::Null));
        assert_eq!(typed("Nonsense"), None);
    }
}
