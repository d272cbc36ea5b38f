//! Places in a text: from the byte to line and column.

use super::FileFault;
use phrase::Phrase;
use std::cell::Cell;

/// A text with the beginnings of its lines.
pub(super) struct LineStarts<'t> {
    text: &'t str,
    starts: Vec<usize>,
    /// The byte that was asked for last and the characters before it in its line: a file may be one long line.
    last: Cell<(usize, usize)>,
}

impl<'t> LineStarts<'t> {
    pub(super) fn of(text: &'t str) -> Self {
        let after_breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        Self { text, starts: std::iter::once(0).chain(after_breaks).collect(), last: Cell::new((0, 0)) }
    }

    /// Line and column, both from 1; the column counts characters.
    pub(super) fn place(&self, at: usize) -> (u32, u32) {
        let line = self.starts.partition_point(|start| *start <= at);
        let start = self.starts[line.saturating_sub(1)];
        let end = at.min(self.text.len());
        let (from, known) =
            Some(self.last.get()).filter(|(last, _)| (start..=end).contains(last)).unwrap_or((start, 0));
        let before = self.text.as_bytes().get(from..end).unwrap_or_default();
        let characters = known + before.iter().filter(|byte| (**byte & 0xC0) != 0x80).count();
        self.last.set((end, characters));
        (number(line), number(characters + 1))
    }

    pub(super) fn fault(&self, at: usize, reason: impl Into<Phrase>) -> FileFault {
        let (line, column) = self.place(at);
        FileFault { line, column, reason: reason.into() }
    }

    /// Returns the byte at which a part of the text begins; 0 if it is no part of it.
    pub(super) fn offset(&self, part: &[u8]) -> usize {
        let offset = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        if offset <= self.text.len() { offset } else { 0 }
    }

    /// The byte of line and column as serde_json counts them: columns in bytes.
    pub(super) fn byte(&self, line: usize, column: usize) -> usize {
        let start = self.starts.get(line.saturating_sub(1)).copied().unwrap_or_default();
        (start + column.saturating_sub(1)).min(self.text.len())
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::LineStarts;

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let lines = LineStarts::of("a\nüb\n\nc");
        let places: Vec<_> = [0, 1, 2, 4, 5, 6, 7, 8, 99].map(|at| lines.place(at)).into();
        assert_eq!(places, [(1, 1), (1, 2), (2, 1), (2, 2), (2, 3), (3, 1), (4, 1), (4, 2), (4, 2)]);
        let backwards: Vec<_> = [99, 8, 7, 6, 5, 4, 2, 1, 0].map(|at| lines.place(at)).into();
        assert!(backwards.iter().eq(places.iter().rev()), "{backwards:?}");
        assert_eq!([4, 1, 4, 5].map(|at| lines.place(at)), [(2, 2), (1, 2), (2, 2), (2, 3)]);
    }
}
