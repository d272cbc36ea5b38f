//! The sentences of the canvas, until they move to the words of the page.

use behaviour::StreamKind;

pub(super) fn graph() -> &'static str {
    "The graph"
}

/// `Head tracker, red ball · head, actuator stream`
pub(super) fn stream_name(name: &str, what_it_is: &str, kind: StreamKind) -> String {
    let kind = match kind {
        StreamKind::Sensor => "sensor stream",
        StreamKind::Ordinary => "stream",
        StreamKind::Actuator => "actuator stream",
    };
    if what_it_is.is_empty() { format!("{name}, {kind}") } else { format!("{name}, {what_it_is}, {kind}") }
}

/// `map (distance), connector from RedBall to Distance`
pub(super) fn connector_name(words: &str, from: &[String], to: &str) -> String {
    format!("{words}, connector from {} to {to}", from.join(" and "))
}

pub(super) fn to_graph() -> &'static str {
    "To the graph"
}

pub(super) fn next_steps(name: &str) -> String {
    format!("Next steps for {name}")
}

pub(super) fn add_connector() -> &'static str {
    "Add connector"
}

pub(super) fn otherwise() -> &'static str {
    "otherwise"
}

pub(super) fn say_something() -> &'static str {
    "Say…"
}

pub(super) fn zoom_group() -> &'static str {
    "Zoom"
}

pub(super) fn zoom_in() -> &'static str {
    "Zoom in"
}

pub(super) fn zoom_out() -> &'static str {
    "Zoom out"
}

pub(super) fn real_size() -> &'static str {
    "Real size"
}

pub(super) fn fit() -> &'static str {
    "Show everything"
}

pub(super) fn tidy() -> &'static str {
    "Tidy"
}

pub(super) fn percent(zoom: f64) -> String {
    format!("{:.0} %", zoom * 100.0)
}
