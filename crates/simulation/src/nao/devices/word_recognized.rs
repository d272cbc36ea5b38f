//! Words that somebody says: spotted in what was said, whole words, however they are written large or small.

use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::nao::SimulatedNao;
use behaviour::Value;

pub(super) const DRIVER: SimulatedDriver = SimulatedDriver { name: "WordRecognized", open };

/// The confidence of the robot in words that are all that was said, and in words among others, from 0 to 1; our
/// planning values.
const SURE: [f64; 2] = [0.8, 0.6];
/// Languages that put no spaces between words.
const WITHOUT_SPACES: [&str; 2] = ["Japanese", "Chinese"];

#[derive(Debug)]
struct RecognizedWords {
    /// The words as they were chosen, and as they are looked for.
    words: Vec<(String, Vec<String>)>,
    spaces: bool,
    confidence: f64,
}

fn open(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let spaces = !WITHOUT_SPACES.contains(&chosen.text("language")?);
    let words = chosen.text("words")?.split(',').map(str::trim).map(|word| (word.to_owned(), pieces(word, spaces)));
    let words: Vec<_> = words.filter(|(_, pieces)| !pieces.is_empty()).collect();
    let confidence = chosen.number("confidence")?;
    if words.is_empty() { None } else { SimulatedDevice::sense(RecognizedWords { words, spaces, confidence }) }
}

/// The words of a text in small letters, or its characters where there are no spaces.
fn pieces(text: &str, spaces: bool) -> Vec<String> {
    let small = text.to_lowercase();
    let words = small.split(|sign: char| !sign.is_alphanumeric()).filter(|word| !word.is_empty());
    if spaces { words.map(str::to_owned).collect() } else { words.flat_map(str::chars).map(String::from).collect() }
}

impl RecognizedWords {
    /// The first of the chosen words in what was said, the longest if several begin there, and how sure that is.
    fn spot(&self, said: &str) -> Option<(&str, f64)> {
        let said = pieces(said, self.spaces);
        let (word, pieces) = (0..said.len()).find_map(|from| {
            let here = self.words.iter().filter(|(_, pieces)| said[from..].starts_with(pieces));
            here.max_by_key(|(_, pieces)| pieces.len())
        })?;
        Some((word, SURE[usize::from(pieces.len() < said.len())]))
    }
}

impl Sense for RecognizedWords {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let (word, sure) = self.spot(nao.hearing.now.as_ref()?.words.as_ref()?)?;
        let fields =
            [("word", Value::text(word)), ("confidence", sure.into()), ("time", Value::Int(nao.now.cast_signed()))];
        (sure >= self.confidence).then(|| Value::object(fields))
    }
}

#[cfg(test)]
mod tests {
    use super::{RecognizedWords, pieces};

    fn spot(chosen: &[&str], spaces: bool, said: &str) -> Option<(String, f64)> {
        let words = chosen.iter().map(|word| ((*word).to_owned(), pieces(word, spaces))).collect();
        let words = RecognizedWords { words, spaces, confidence: 0.0 };
        words.spot(said).map(|(word, sure)| (word.to_owned(), sure))
    }

    #[test]
    fn whole_words_are_spotted_the_first_and_then_the_longest() {
        let chosen = ["yes", "Yes please", "no"];
        assert_eq!(spot(&chosen, true, "YES!"), Some(("yes".to_owned(), 0.8)));
        assert_eq!(spot(&chosen, true, "well, yes please"), Some(("Yes please".to_owned(), 0.6)));
        assert_eq!(spot(&chosen, true, "I know nothing"), None);
        assert_eq!(spot(&chosen, true, ""), None);
    }

    #[test]
    fn where_there_are_no_spaces_signs_are_compared() {
        assert_eq!(spot(&["はい"], false, "はい、そうです"), Some(("はい".to_owned(), 0.6)));
        assert_eq!(spot(&["いいえ"], false, "はい"), None);
    }
}
