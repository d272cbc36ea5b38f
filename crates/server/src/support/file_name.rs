//! Names of files that people read: in their own script, without what some system refuses in a name.

use behaviour::without_unseen;

/// The longest name, in characters: in no script more bytes than a file system takes with a time and an ending.
const NAME_MAX_CHARS: usize = 50;

/// A name as one for a file, in its own script; empty if nothing of it can stand there.
pub(crate) fn readable(name: &str) -> String {
    let plain = |c: char| if c.is_whitespace() { ' ' } else { c };
    let fits = |c: &char| !matches!(c, '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|');
    let spaced: String = name.chars().map(plain).collect();
    let kept: String = without_unseen(&spaced).chars().filter(fits).take(NAME_MAX_CHARS).collect();
    kept.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ").trim_matches('.').trim().to_owned()
}

/// The words of a name, in small letters with a dash between them; signs of ASCII end a word.
pub(crate) fn dashed(name: &str) -> String {
    let plain = |c: char| if c.is_ascii() && !c.is_ascii_alphanumeric() { ' ' } else { c };
    let words: String = readable(&name.chars().map(plain).collect::<String>()).to_lowercase();
    words.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

/// What a browser is told to call a file (RFC 6266): in plain letters for those that read no others, and as it is.
pub(crate) fn disposition(name: &str, ending: &str) -> String {
    let name = Some(readable(name)).filter(|name| !name.is_empty()).unwrap_or_else(|| "program".to_owned());
    let letters: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let letters = letters.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    let letters = if letters.is_empty() { "program" } else { &letters };
    format!("attachment; filename=\"{letters}.{ending}\"; filename*=UTF-8''{}", encoded(&format!("{name}.{ending}")))
}

/// Every byte that may not stand in such a name as `%` and its number (RFC 8187).
pub(crate) fn encoded(name: &str) -> String {
    let may_stand = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~".contains(&byte);
    let one = |byte: u8| if may_stand(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    name.bytes().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{dashed, disposition, readable};

    #[test]
    fn a_download_keeps_its_script() {
        let table = [
            ("近いボール", "program.json", "%E8%BF%91%E3%81%84%E3%83%9C%E3%83%BC%E3%83%AB.json"),
            ("Größe", "Gr-e.json", "Gr%C3%B6%C3%9Fe.json"),
            ("Track far and close", "Track-far-and-close.json", "Track%20far%20and%20close.json"),
            ("..\u{202e}/a\u{7}\r\n\"b", "a-b.json", "a%20b.json"),
            ("///", "program.json", "program.json"),
        ];
        for (name, plain, own) in table {
            let wanted = format!("attachment; filename=\"{plain}\"; filename*=UTF-8''{own}");
            assert_eq!(disposition(name, "json"), wanted, "{name}");
        }
    }

    #[test]
    fn a_name_for_a_file_is_readable_and_fits() {
        assert_eq!(readable(" کتاب: שלום\u{3000}हिन्दी. "), "کتاب שלום हिन्दी");
        assert_eq!(dashed("Track far (close)!"), "track-far-close");
        assert_eq!([dashed("近い ボール"), dashed("Größe 2"), dashed("?!")], ["近い-ボール", "größe-2", ""]);
        let long = "🤖".repeat(200);
        assert!(
            dashed(&long).len() <= 200 && !dashed(&long).is_empty(),
            "in bytes, with a time and an ending below 255"
        );
    }
}
