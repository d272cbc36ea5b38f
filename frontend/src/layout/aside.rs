//! The size of notes, which stand beside the graph.

use super::text_width;

/// The widest and the narrowest a note becomes.
const NOTE_WIDTH: [f64; 2] = [132.0, 248.0];
/// A line of a note, what surrounds all of them, and the line with name and day.
const NOTE_LINE: f64 = 20.0;
const NOTE_AROUND: (f64, f64) = (32.0, 18.0);
const NOTE_FOOT: f64 = 20.0;

/// About how wide and high a note is.
pub(crate) fn note_size(text: &str) -> (f64, f64) {
    let inner = NOTE_WIDTH[1] - NOTE_AROUND.0;
    let widths: Vec<f64> = text.split('\n').map(|line| text_width(line, 14)).collect();
    let lines: f64 = widths.iter().map(|width| (width / inner).ceil().max(1.0)).sum();
    let widest = widths.into_iter().fold(0.0, f64::max);
    let width = (widest + NOTE_AROUND.0).clamp(NOTE_WIDTH[0], NOTE_WIDTH[1]);
    (width.ceil(), lines * NOTE_LINE + NOTE_FOOT + NOTE_AROUND.1)
}

#[cfg(test)]
mod tests {
    use super::note_size;

    #[test]
    fn a_note_grows_down_and_never_wider_than_its_most() {
        let (narrow, low) = note_size("Ask Yuki");
        let (wide, high) = note_size(&"Ask Yuki whether the children liked it. ".repeat(5));
        assert!(narrow < wide && wide == 248.0 && high > low + 60.0, "{narrow} {low} {wide} {high}");
        assert_eq!(note_size("a\n\nb").1, note_size("a").1 + 40.0);
    }
}
