//! Sentences without code: whoever reads them need not read procedures.

sentences! {
    own_procedure: "what its own procedure gives";
    own_test: "its own test passes";
}

/// What follows a procedure where it is asked whether that is true, in each language.
const IS_TRUE: [&str; 2] = [" is true", " なら"];

/// A sentence with words in the place of procedures, which stand in backticks; numbers and truths stand as they are.
pub(crate) fn without_code(sentence: &str) -> String {
    let mut all = String::new();
    let mut rest = sentence;
    while let Some((before, behind)) = rest.split_once('`') {
        let end = end_of_code(behind);
        let (code, after) = (&behind[..end], behind.get(end + 1..).unwrap_or_default());
        all += before;
        rest = after;
        let asks = IS_TRUE.iter().find_map(|asks| after.strip_prefix(asks));
        match asks {
            Some(after) if !is_plain(code) => {
                all += own_test();
                rest = after;
            }
            _ if is_plain(code) => all += code,
            _ => all += own_procedure(),
        }
    }
    all + rest
}

/// Where the code ends: at a backtick that is not doubled.
fn end_of_code(text: &str) -> usize {
    let mut from = 0;
    while let Some(at) = text[from..].find('`').map(|at| at + from) {
        if !text[at + 1..].starts_with('`') {
            return at;
        }
        from = at + 2;
    }
    text.len()
}

/// Whether everybody reads it: a number, a truth, or that there is nothing yet.
fn is_plain(code: &str) -> bool {
    code == "…" || code == "true" || code == "false" || code.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::without_code;

    #[test]
    fn sentences_show_no_code() {
        let cases = [
            ("When the ball is near, the eyes turn red.", "When the ball is near, the eyes turn red."),
            ("and `a.x > 2 && b` is true, the head", "and its own test passes, the head"),
            ("taking `a + b`, the robot says it", "taking what its own procedure gives, the robot says it"),
            (
                "whenever `ball.x` changes and `true` is true",
                "whenever what its own procedure gives changes and true is true",
            ),
            (
                "remembering `last + 1` and starting from `0`",
                "remembering what its own procedure gives and starting from 0",
            ),
            ("taking `say ``hi`` `, it", "taking what its own procedure gives, it"),
            ("taking `…`, it", "taking …, it"),
            ("an end without `an end", "an end without what its own procedure gives"),
        ];
        for (sentence, shown) in cases {
            assert_eq!(without_code(sentence), shown);
        }
        assert_eq!(
            without_code("`a > 2` なら頭で"),
            "its own test passes頭で",
            "the words of a language are in its table"
        );
    }
}
