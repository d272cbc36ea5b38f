//! Looking back over time.

sentences! {
    over_time: "Over time";
    past_comes: "It is being opened …";
    past_is_empty: "Nothing came while this was recorded.";
    past_is_cut: "The rest is left out, as it is larger than can be looked at.";
    no_past_yet: "Nothing runs here. Press Start, or choose Look back beside a recording.";
    too_many_lanes: "There are as many lanes as can be shown. Remove one first.";
    lanes_name: "Lanes";
    moment_name: "Moment";
    form: "Form";
    value_came: "came";
    value_name: "Value";
    playing_name: "Playing";
    play: "Play";
    rest_playing: "Pause";
    mark_before: "To the mark before";
    mark_after: "To the next mark";
    speed_of_playing: "Speed";
    to_now: "Now";
    stretch_name: "How much time is shown";
    show_less_time: "Show less time";
    show_more_time: "Show more time";
    add_lane: "Add lane";
    values_shown: "Values";
    back_to_now: "Back to now";
    time_of_value: "Time";
    values_come: "The values are on their way.";
    no_values_then: "Nothing came on this lane.";
}

pub(crate) fn moment_recorded(time: &str) -> String {
    say!("{time}, recorded", time)
}

pub(crate) fn moment_earlier(time: &str) -> String {
    say!("{time}, earlier", time)
}

pub(crate) fn moment_told(time: &str, lane: &str, value: &str) -> String {
    say!("{time}; {lane}: {value}", time, lane, value)
}

pub(crate) fn seconds_earlier(seconds: u64) -> String {
    say!("{seconds} s earlier", seconds)
}

pub(crate) fn all_of_it(length: &str) -> String {
    say!("All {length}", length)
}

pub(crate) fn differs_from(time: &str) -> String {
    say!("From {time} on this may not be what the robot did: run again, the program does something else.", time)
}

pub(crate) fn speed_now(speed: f64) -> String {
    say!("Speed: {speed} times", speed)
}

pub(crate) fn stretch(seconds: f64) -> String {
    say!("{seconds} s", seconds)
}

pub(crate) fn pretended_value(value: &str) -> String {
    say!("{value} (pretended)", value)
}

pub(crate) fn other_form(lane: &str) -> String {
    say!("Another form: {lane}", lane)
}

pub(crate) fn fold_lane(lane: &str) -> String {
    say!("Fold: {lane}", lane)
}

pub(crate) fn unfold_lane(lane: &str) -> String {
    say!("Unfold: {lane}", lane)
}

pub(crate) fn remove_lane(lane: &str) -> String {
    say!("Remove the lane: {lane}", lane)
}
