//! Events to paste into an observation of BORIS: time in seconds, subject, code, modifier, comment, with tabs between. What lasts
//! is a state: its code stands twice, where it begins and where it ends.

use recording::{Timeline, tracks};

/// The table, by time.
pub(super) fn written(timeline: &Timeline) -> String {
    let subject = timeline.header.participant.as_deref().unwrap_or_default();
    let mut rows = Vec::new();
    for track in tracks(timeline) {
        let (who, code) = match track.what {
            None => (subject, track.name.trim_start_matches("mark: ").to_owned()),
            Some(_) => ("robot", track.name.clone()),
        };
        for span in &track.spans {
            let row = |at_ms: u64| {
                let fields = [who, &code, &span.says, &span.by].map(field).join("\t");
                (at_ms, format!("{}.{:03}\t{fields}\n", at_ms / 1_000, at_ms % 1_000))
            };
            rows.push(row(span.from_ms));
            if !span.is_moment {
                rows.push(row(span.until_ms));
            }
        }
    }
    // The end of one state stays before the beginning of the next at the same time, as it was put first.
    rows.sort_by_key(|(at_ms, _)| *at_ms);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// A field without what would end it.
fn field(text: &str) -> String {
    text.replace(['\t', '\n', '\r'], " ").replace(['|', ','], ";")
}
