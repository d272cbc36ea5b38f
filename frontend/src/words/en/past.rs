//! Looking back over time.

sentences! {
    over_time: "Over time";
    only_look_back: "This is the past, only to look at. Back to now leads to the program of today.";
    only_to_look_at: "only to look at";
}

/// `red · 5 s earlier`
pub(crate) fn value_earlier(value: &str, seconds: u32) -> String {
    say!(value_earlier: "{value} · {seconds} s earlier", value, seconds)
}

pub(crate) fn seconds_earlier(seconds: u64) -> String {
    say!(seconds_earlier: "{seconds} s earlier", seconds)
}

/// The moment at which somebody else looks.
pub(crate) fn looks_at_time(time: &str) -> String {
    say!(looks_at_time: "at {time}", time)
}
