//! Which of many sentences are shown. Pure.

use crate::desk::Selected;
use crate::graph::SENTENCES_MAX;
use sentences::Sentence;

/// Never more than this are in the page.
const ROWS_MAX: usize = 60;

/// The sentences that are shown, by their number, and how many there are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Which {
    pub(super) rows: Vec<usize>,
    pub(super) all: usize,
}

/// All of them if they are few or all are wanted; else those of what is selected.
pub(super) fn which(told: &[Sentence], selected: Option<&Selected>, whole: bool) -> Which {
    let all = told.len();
    let is_of = |sentence: &Sentence| {
        sentence.phrases.iter().any(|phrase| match selected {
            Some(Selected::Stream(id)) => phrase.streams.contains(id),
            Some(Selected::Connector(id)) => phrase.connectors.contains(id),
            Some(Selected::Note(_) | Selected::Group(_)) | None => false,
        })
    };
    let rows = (0..all).filter(|at| whole || all <= SENTENCES_MAX || is_of(&told[*at]));
    Which { rows: rows.take(ROWS_MAX).collect(), all }
}

#[cfg(test)]
mod tests {
    use super::which;
    use crate::desk::Selected;
    use behaviour::Id;
    use sentences::{Sentence, SentencePart};

    fn sentence(stream: &str) -> Sentence {
        let id = Id::new(stream).unwrap();
        Sentence { action: id.clone(), phrases: vec![SentencePart { streams: vec![id], ..SentencePart::default() }] }
    }

    #[test]
    fn few_are_shown_and_of_many_those_of_what_is_selected() {
        let told: Vec<Sentence> = ["a", "b", "c", "d"].map(sentence).into();
        assert_eq!(which(&told[..3], None, false).rows, [0, 1, 2]);
        assert!(which(&told, None, false).rows.is_empty());
        let selected = Selected::Stream(Id::new("c").unwrap());
        assert_eq!(which(&told, Some(&selected), false).rows, [2]);
        assert_eq!((which(&told, None, true).rows.len(), which(&told, None, true).all), (4, 4));
        let many: Vec<Sentence> = (0..500).map(|at| sentence(&format!("s{at}"))).collect();
        assert_eq!(which(&many, None, true).rows.len(), 60);
    }
}
