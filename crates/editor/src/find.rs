//! Finding things by their names: what is typed may be a part of a name, or a sentence that names them.

/// A word of a sentence finds something from so many letters on, where letters are no words.
const WORD_MIN: usize = 3;

/// Tells if something of these names is found by what is typed: a part of a name, or a sentence.
#[must_use]
pub fn is_found(typed: &str, is_sentence: bool, names: &[&str]) -> bool {
    if is_sentence { is_named_in(typed, names) } else { matches(typed, names) }
}

/// Returns how near a name is to what is typed, 0 being nearest: the name itself first, then those that begin so.
#[must_use]
pub fn nearness(typed: &str, name: &str) -> u8 {
    let (typed, name) = (typed.trim().to_lowercase(), name.to_lowercase());
    match () {
        () if name == typed => 0,
        () if name.starts_with(&typed) => 1,
        () => 2,
    }
}

/// Returns the one of these that Enter goes to: the one that is called so, else the first of the nearest that are found, unless
/// a sentence is typed.
#[must_use]
pub fn nearest<T>(typed: &str, is_sentence: bool, named: impl Iterator<Item = (String, T)>) -> Option<T> {
    if typed.trim().is_empty() {
        return None;
    }
    let found = named.filter(|(name, _)| is_found(typed, is_sentence, &[name]));
    let (near, one) = found.map(|(name, one)| (nearness(typed, &name), one)).min_by_key(|(near, _)| *near)?;
    (near == 0 || !is_sentence).then_some(one)
}

/// Tells if a name, or what it is called, holds what is looked for.
fn matches(search: &str, names: &[&str]) -> bool {
    let wanted = search.trim().to_lowercase();
    wanted.is_empty() || names.iter().any(|name| name.to_lowercase().contains(&wanted))
}

/// Tells if a sentence holds a name, or a word that begins like a part of one: “the eyes” finds *Eye color*.
fn is_named_in(sentence: &str, names: &[&str]) -> bool {
    let sentence = sentence.to_lowercase();
    let is_long = |text: &str| text.chars().count() >= WORD_MIN || (!text.is_ascii() && !text.is_empty());
    let apart = |c: char| !c.is_alphanumeric();
    let words: Vec<&str> = sentence.split(apart).filter(|word| is_long(word)).collect();
    let begins = |part: &str| is_long(part) && words.iter().any(|word| word.starts_with(part));
    let is_named = |name: &str| is_long(name) && sentence.contains(name) || name.split(apart).any(begins);
    names.iter().any(|name| is_named(&name.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::{is_found, nearest, nearness};

    #[test]
    fn the_exact_name_is_nearest() {
        let mut names = ["Far ball", "Ball color", "ball", "Red ball"];
        names.sort_by_key(|name| nearness(" Ball", name));
        assert_eq!(names[..2], ["ball", "Ball color"]);
    }

    #[test]
    fn enter_goes_to_the_name_else_to_the_first_that_begins_so_and_with_a_sentence_only_to_the_name() {
        let names = ["Far ball", "Ball color", "Ball", "Red ball"];
        let goes = |typed: &str, is_sentence: bool| {
            nearest(typed, is_sentence, names.into_iter().map(|name| (name.to_owned(), name)))
        };
        assert_eq!([goes("ball", false), goes("ba", false)], [Some("Ball"), Some("Ball color")]);
        assert_eq!([goes("all", false), goes("face", false), goes(" ", false)], [Some("Far ball"), None, None]);
        assert_eq!([goes("the ball is far", true), goes("Ball", true)], [None, Some("Ball")]);
    }

    #[test]
    fn a_sentence_finds_what_it_names() {
        let sentence = "When the red ball is nearer than 40 cm, the eyes shine";
        for names in [["RedBall", "Red ball"], ["EyeLedColor", "Eye color"], ["ColorBall", "Color ball"]] {
            assert!(is_found(sentence, true, &names), "{names:?}");
        }
        for names in [["Tracker", "Tracker"], ["Sonar", "Distance ahead"], ["x", "it"]] {
            assert!(!is_found(sentence, true, &names), "{names:?}");
        }
        assert!(is_found("赤いボールが近いとき", true, &["RedBall", "赤いボール"]));
        assert!(!is_found("赤いボールが近いとき", true, &["FaceDetection", "顔"]));
    }

    #[test]
    fn what_is_looked_for_may_stand_anywhere() {
        let found = |search: &str, names: &[&str]| is_found(search, false, names);
        assert!(found("ball", &["RedBall", "Red ball"]) && found(" ", &["x"]) && found("RED B", &["", "Red ball"]));
        assert!(!found("face", &["RedBall"]));
    }
}
