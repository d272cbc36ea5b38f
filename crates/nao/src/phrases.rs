//! A text in pieces, each spoken within two seconds: what the robot speaks when nobody is there any more ends so soon.

/// The longest that a piece may take, in milliseconds.
const PIECE_MS: u32 = 1_850;
/// Where a text is divided at best, and else: ends of sentences, then of clauses, then of words.
const SENTENCE: &str = ".!?。！？\n…";
const CLAUSE: &str = ",;:、，；：—)）」』";

/// Returns the time that a character takes, in milliseconds, at the usual speed of the voice.
fn takes_ms(character: char) -> u32 {
    match character {
        '0'..='9' => 300,
        '\u{3000}'..='\u{303f}' => 65,
        '\u{3040}'..='\u{30ff}' => 140,
        '\u{2e80}'..='\u{9fff}' | '\u{ac00}'..='\u{d7af}' | '\u{f900}'..='\u{faff}' => 280,
        _ => 65,
    }
}

fn length_ms(text: &str) -> u32 {
    text.chars().fold(0, |sum: u32, character| sum.saturating_add(takes_ms(character)))
}

/// The pieces, in order; one for a text that is short. `speed` is that of the voice in percent of the usual one: pieces of a slow
/// voice are shorter.
pub(crate) fn pieces(text: &str, speed: f32) -> Vec<String> {
    let most_ms = (PIECE_MS as f32 * (speed / 100.0).clamp(0.1, 1.0)) as u32;
    let mut parts = vec![text.trim().to_owned()];
    let is_end = |ends: &'static str| move |character: char| ends.contains(character);
    parts = divided(parts, most_ms, &is_end(SENTENCE));
    parts = divided(parts, most_ms, &is_end(CLAUSE));
    parts = divided(parts, most_ms, &char::is_whitespace);
    // What has neither signs nor spaces is divided anywhere.
    parts = divided(parts, most_ms, &|_| true);
    parts
}

/// Divides what is too long, behind characters like these; neighbours that are short enough together stay together.
fn divided(parts: Vec<String>, most_ms: u32, is_end: &dyn Fn(char) -> bool) -> Vec<String> {
    let mut all = Vec::new();
    for part in parts {
        if length_ms(&part) <= most_ms {
            all.push(part);
            continue;
        }
        let (mut piece, mut from) = (String::new(), all.len());
        let whole = length_ms(&part);
        // About as long each, so that no word is left over.
        let fair = whole / whole.div_ceil(most_ms);
        for bit in part.split_inclusive(is_end) {
            let before = length_ms(&piece);
            if !piece.trim().is_empty() && (before >= fair || before + length_ms(bit) > most_ms) {
                all.push(std::mem::take(&mut piece));
            }
            piece.push_str(bit);
        }
        all.push(piece);
        for piece in &mut all[from..] {
            *piece = piece.trim().to_owned();
        }
        while from < all.len() {
            if all[from].is_empty() {
                all.remove(from);
            } else {
                from += 1;
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::{PIECE_MS, length_ms, pieces};

    #[test]
    fn a_short_text_is_one_piece_and_a_long_one_ends_at_sentences_clauses_or_words() {
        assert_eq!(pieces(" Hello again! ", 100.0), ["Hello again!"]);
        assert_eq!(
            pieces("Hello Aiko. Shall we play with the red ball, or do you want to dance?", 200.0),
            ["Hello Aiko.", "Shall we play with", "the red ball,", "or do you want to dance?"]
        );
        assert_eq!(
            pieces("こんにちは。いっしょにあそびましょう。", 100.0),
            ["こんにちは。", "いっしょにあそびましょう。"]
        );
    }

    #[test]
    fn no_piece_is_long_and_nothing_is_lost_of_any_text() {
        for text in
            ["word ".repeat(150), "a".repeat(1_000), "0123456789".repeat(20), "日本語".repeat(50), "。, .".repeat(99)]
        {
            for (speed, most_ms) in [(100.0, PIECE_MS), (50.0, PIECE_MS / 2)] {
                let all = pieces(&text, speed);
                assert!(all.iter().all(|piece| length_ms(piece) <= most_ms && !piece.is_empty()), "{all:?}");
                let bare = |text: &str| text.split_whitespace().collect::<String>();
                assert_eq!(bare(&all.concat()), bare(&text));
            }
        }
    }
}
