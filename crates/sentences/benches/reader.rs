//! Measures how long a sentence takes to be read: random strings and sentences with slips, and what is understood.
//! `cargo xtask bench sentences`; it fails if a bar is missed.

#![expect(clippy::print_stdout, reason = "a benchmark says what it measured")]

#[path = "../tests/sentences/dice.rs"]
mod dice;
#[path = "../tests/sentences/said.rs"]
mod said;

use behaviour::Helper;
use dice::Dice;
use sentences::{Language, Lexicon, read_speech};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// The number of texts of each kind, if no other number is given.
const COUNT: usize = 100_000;
/// The bars: half of the texts, and each of them.
const MEDIAN: Duration = Duration::from_millis(5);
const WORST: Duration = Duration::from_millis(50);
/// The times that a text is read again that takes long; the shortest one counts.
const AGAIN: usize = 4;

/// Returns the time that each text takes, sorted, and the text that takes longest.
fn times(count: usize, mut text: impl FnMut(&mut Dice, usize) -> (String, Language)) -> (Vec<Duration>, String) {
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    let mut dice = Dice::seeded(36);
    let mut all = Vec::with_capacity(count);
    let (mut longest, mut of) = (Duration::ZERO, String::new());
    for at in 0..count {
        let (text, language) = text(&mut dice, at);
        let once = || {
            let started = Instant::now();
            let reading = read_speech(&text, language, Lexicon::of(language), &helpers, None);
            let took = started.elapsed();
            drop(reading);
            took
        };
        let mut took = once();
        // A text that takes long is read again, so that another program's turn is not counted.
        if took > WORST / 4 {
            took = (0..AGAIN).map(|_| once()).fold(took, Duration::min);
        }
        all.push(took);
        if took > longest {
            (longest, of) = (took, text);
        }
    }
    all.sort();
    (all, of)
}

fn main() -> ExitCode {
    // The words of both languages are read once.
    for language in Language::ALL {
        drop(read_speech("wave", language, Lexicon::of(language), &[], None));
    }
    let count = std::env::args().find_map(|word| word.parse().ok()).unwrap_or(COUNT).max(1);
    let strange = times(count, |dice, at| {
        let language = Language::ALL[at % 2];
        (said::strange(dice, language, at % 5 == 0), language)
    });
    let plain = times(count, |dice, at| {
        let language = Language::ALL[at % 2];
        (said::random(dice, language), language)
    });
    let mut is_met = true;
    for (name, (all, longest)) in [("strange and mutated", strange), ("sentences", plain)] {
        let (median, tail, worst) = (all[all.len() / 2], all[all.len() * 99 / 100], all[all.len() - 1]);
        println!("{name}: {} texts, median {median:.2?}, 99 % {tail:.2?}, worst {worst:.2?}: {longest}", all.len());
        is_met &= median <= MEDIAN && worst <= WORST;
    }
    if !is_met {
        println!("MISSED: the median may take {MEDIAN:?}, the worst {WORST:?}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
