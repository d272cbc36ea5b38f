//! Sentences that only the graph says.

pub(crate) use crate::words::*;
use behaviour::StreamKind;

sentences! {
    minimap: "The whole graph in small; arrow keys move what is seen";
    copied_with_stream: "A connector is copied with the stream that it leads to. Choose that too.";
    nothing_copied: "Nothing was copied here yet. Ctrl V pastes what was copied elsewhere.";
    preview: "Preview";
    connect_hint: "Connect to another stream (C)";
    to_graph: "To the graph";
    zoom_group: "Zoom";
    // From the list to the graph
    carried_here: "Let go to add it here.";
    carried_to_ground: "Drop it on the graph.";
    carried_to_stream: "Drop it on a stream.";
    carried_no_stream: "There is no stream yet that it could follow.";
    note_of_somebody: "this note";
    group_hint: "Drag the title to move all of it";
    remove_with_streams: "Remove it with its streams";
    is_new: "new";
    how_following_ends: "Press Escape or touch the graph to end.";
}

/// The menu of something by its name, or of the ground.
pub(crate) fn menu_of(name: Option<&str>) -> String {
    name.map_or_else(
        || say!(menu_of_what_can_be_done: "What can be done here"),
        |name| say!(menu_of_what_can_be_done_2: "What can be done with {name}", name),
    )
}

/// Names what comes after a stream.
pub(crate) fn after_stream(name: &str) -> String {
    say!(after_stream: "After {name}", name)
}

/// A wire is held by the keyboard: where it may end, and where it would end now.
pub(crate) fn wire_at(at: usize, count: usize, how: &str) -> String {
    say!(wire_at: "{how}, {at} of {count}", how = capitalised(how), at = at + 1, count)
}

/// The first place that a wire comes to.
pub(crate) fn wire_first_at(from: &str, at: usize, count: usize, how: &str) -> String {
    let first = wire_at(at, count, how);
    match count {
        1 => say!(wire_first_at_connect_1_place: "Connect {from}: 1 place. {first}", from, first),
        _ => say!(wire_first_at_connect_places: "Connect {from}: {count} places. {first}", from, count, first),
    }
}

/// A wire that may end in so many places.
pub(crate) fn wire_begins(from: &str, count: usize) -> String {
    match count {
        1 => say!(wire_begins_connect_1_place_press: "Connect {from}: 1 place. Press an arrow key.", from),
        _ => {
            say!(wire_begins_connect_places_press_an: "Connect {from}: {count} places. Press an arrow key.", from, count)
        }
    }
}

/// A wire that can end nowhere.
pub(crate) fn wire_nowhere(from: &str) -> String {
    say!(wire_nowhere: "{from} is led everywhere already. Drop it on free ground to add something new.", from)
}

/// `Head tracker, red ball · head, actuator stream`
pub(crate) fn stream_name(name: &str, what_it_is: &str, kind: StreamKind) -> String {
    let kind = match kind {
        StreamKind::Sensor => said!(stream_name_sensor_stream: "sensor stream"),
        StreamKind::Ordinary => said!(stream_name_stream: "stream"),
        StreamKind::Actuator => said!(stream_name_actuator_stream: "actuator stream"),
    };
    listed([name, what_it_is, kind].into_iter().filter(|part| !part.is_empty()))
}

/// `map (distance), connector from RedBall to Distance`
pub(crate) fn connector_name(words: &str, from: &[String], to: &str) -> String {
    say!(connector_name: "{words}, connector from {join} to {to}", words, join = joined(from), to)
}

pub(crate) fn percent(zoom: f64) -> String {
    format!("{:.0} %", zoom * 100.0)
}

/// Says that what is carried would follow that stream.
pub(crate) fn carried_after(name: &str) -> String {
    say!(carried_after: "after {name}", name)
}

/// A helper that one stream is not enough for.
pub(crate) fn carried_takes_more(count: usize) -> String {
    match count {
        0 => say!(carried_takes_more_it_takes_no_value: "It takes no value, so it cannot follow a stream."),
        _ => {
            say!(carried_takes_more_it_takes_values_choose: "It takes {count} values. Choose it where streams are combined.", count)
        }
    }
}

/// The name of an open group, with what is in it.
pub(crate) fn group_name(title: &str, counts: &str) -> String {
    listed([title, said!(group_name: "group"), counts])
}

/// The name of a folded group, with what is in it.
pub(crate) fn folded_name(title: &str, counts: &str) -> String {
    listed([title, said!(folded_name: "folded group"), counts])
}

pub(crate) fn fold_of(title: &str) -> String {
    say!(fold_of: "Fold {title}", title)
}

pub(crate) fn unfold_of(title: &str) -> String {
    say!(unfold_of: "Unfold {title}", title)
}

/// So many streams of a kind.
pub(crate) fn count_of_kind(kind: StreamKind, count: usize) -> String {
    match (kind, count) {
        (StreamKind::Sensor, 1) => say!(count_of_kind_n1_sense: "1 sense"),
        (StreamKind::Sensor, _) => say!(count_of_kind_senses: "{count} senses", count),
        (StreamKind::Ordinary, 1) => say!(count_of_kind_n1_stream: "1 stream"),
        (StreamKind::Ordinary, _) => say!(count_of_kind_streams: "{count} streams", count),
        (StreamKind::Actuator, 1) => say!(count_of_kind_n1_action: "1 action"),
        (StreamKind::Actuator, _) => say!(count_of_kind_actions: "{count} actions", count),
    }
}

pub(crate) fn was_words(words: &str) -> String {
    say!(was_words: "was {words}", words)
}

pub(crate) fn removed_tag(by: Option<&str>) -> String {
    by.map_or_else(|| say!(removed_tag_removed: "removed"), |by| say!(removed_tag_removed_by: "removed by {by}", by))
}

/// The name of something on the graph, with what became of it.
pub(crate) fn with_mark(name: String, mark: Option<&str>) -> String {
    mark.map_or(name.clone(), |mark| listed([&name, mark]))
}

pub(crate) fn following(name: &str) -> String {
    say!(following: "Following {name}", name)
}

pub(crate) fn following_said(name: &str) -> String {
    say!(following_said: "Following {name}. Press Escape to end.", name)
}
