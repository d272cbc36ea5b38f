//! The time of day in words that sort: `2026-11-21T18:34:06Z`.

use crate::support::now_ms;
use time::OffsetDateTime;
use time::format_description::well_known::Rfc3339;

/// Now.
pub(super) fn now() -> String {
    words(now_ms())
}

/// So many milliseconds ago.
pub(crate) fn ago(ms: u64) -> String {
    words(now_ms().saturating_sub(ms))
}

/// Milliseconds since 1970 in words; whole seconds are enough for a name.
fn words(ms: u64) -> String {
    let seconds = i64::try_from(ms / 1_000).unwrap_or(i64::MAX);
    let moment = OffsetDateTime::from_unix_timestamp(seconds).unwrap_or(OffsetDateTime::UNIX_EPOCH);
    moment.format(&Rfc3339).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn times_are_dates() {
        let cases = [
            (0, "1970-01-01T00:00:00Z"),
            (951_827_696_000, "2000-02-29T12:34:56Z"),
            (1_709_251_199_999, "2024-02-29T23:59:59Z"),
            (4_107_542_400_000, "2100-03-01T00:00:00Z"),
        ];
        for (ms, wanted) in cases {
            assert_eq!(words(ms), wanted);
        }
    }
}
