//! Subtitles (WebVTT) beside a video of the session: marks, what people did by hand and what the robot did.

use recording::{Timeline, tracks};

/// The subtitles, by time.
pub(super) fn written(timeline: &Timeline) -> String {
    let mut cues = Vec::new();
    for track in tracks(timeline) {
        for span in track.spans {
            let text = if span.says.is_empty() { track.name.clone() } else { format!("{}: {}", track.name, span.says) };
            cues.push((span.from_ms, span.until_ms, escaped(&text)));
        }
    }
    cues.sort();
    let mut text = "WEBVTT\n".to_owned();
    for (number, (from, until, says)) in (1..).zip(cues) {
        text.push_str(&format!("\n{number}\n{} --> {}\n{says}\n", clock(from), clock(until)));
    }
    text
}

/// A time with two digits of hours at least.
fn clock(ms: u64) -> String {
    format!("{:02}:{:02}:{:02}.{:03}", ms / 3_600_000, ms / 60_000 % 60, ms / 1_000 % 60, ms % 1_000)
}

/// A text in one line, without what would be a tag or a time.
fn escaped(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
