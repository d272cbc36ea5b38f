//! A table for spreadsheets: UTF-8 with the mark by which they see that, and times in whole milliseconds, which every locale reads
//! alike.

use super::clock;
use recording::Timeline;

/// The columns.
const COLUMNS: [&str; 8] = ["t_ms", "clock", "what", "subject", "value", "by", "until_ms", "verdict"];

/// The table, marks among everything else by time.
pub(super) fn written(timeline: &Timeline, separator: char) -> String {
    let events = timeline.events.iter().map(|event| {
        let of = [event.what.word(), &event.subject, &event.says, &event.by].map(str::to_owned);
        (event.at_ms, of, String::new(), "")
    });
    let marks = timeline.marks.iter().map(|mark| {
        let until = mark.until.map(|until| until.to_string()).unwrap_or_default();
        (mark.t, ["mark", &mark.word, &mark.note, &mark.by].map(str::to_owned), until, mark.sort.word())
    });
    let mut rows: Vec<_> = events.chain(marks).collect();
    rows.sort_by_key(|(at_ms, ..)| *at_ms);
    let mut table = "\u{feff}".to_owned();
    row(&mut table, separator, COLUMNS.map(str::to_owned));
    for (at_ms, [what, subject, value, by], until, verdict) in rows {
        row(
            &mut table,
            separator,
            [at_ms.to_string(), clock(at_ms), what, text(subject), text(value), text(by), until, verdict.to_owned()],
        );
    }
    table
}

/// Every field in quotes, so that neither separator means anything in it.
fn row(table: &mut String, separator: char, fields: [String; 8]) {
    let quoted = fields.map(|field| format!("\"{}\"", field.replace('"', "\"\"")));
    table.push_str(&quoted.join(&separator.to_string()));
    table.push_str("\r\n");
}

/// A text that no spreadsheet takes for something to compute.
fn text(field: String) -> String {
    let computes =
        field.starts_with(['=', '+', '@', '\t', '\r']) || field.starts_with('-') && field.parse::<f64>().is_err();
    if computes { format!("'{field}") } else { field }
}
