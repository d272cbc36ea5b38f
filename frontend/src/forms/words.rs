//! Sentences that only the forms say.

use crate::words::language::said_by;
pub(crate) use crate::words::*;

sentences! {
    no_source_yet: "There is no stream yet that could feed it. Add a sense first.";
    inspector_name: "What is selected";
    inspector_tabs: "What is selected, and problems";
    is_selected: "Selected";
    last_value: "Last value";
    rate: "Rate";
    carried: "Values so far";
    no_value_yet: "No value yet.";
    starts_to_see: "Press Start to see values.";
    last_run: "Last run:";
    runs_before: "Not used yet: the robot still runs it as it was before.";
    no_problems: "Nothing is missing. Press Start when you like.";
    no_problems_now: "Nothing is missing.";
    select_to_edit: "Select a stream or a connector to see more of it.";
    says_ordinary: "Carries what its connector makes.";
    last_inputs: "last inputs";
    result: "result";
    passes: "passes";
    stopped: "left out";
    operation: "Operation";
    connector: "Connector";
    how_it_works: "How it works";
    how_it_works_less: "Hide how it works";
    how_to_read: "Time runs from left to right. Above is what comes, below is what the connector makes of it.";
    from: "From";
    body: "Procedure";
    write_here: "Write it here";
    use_helper: "Use a helper";
    helper: "Helper";
    procedure: "Procedure";
    parameters: "You can use:";
    output_stream_name: "Output stream name";
    seconds: "seconds";
    actuator: "Actuator";
    input_streams: "Input streams, in this order";
    no_fitting_helper: "No helper takes this many values. Write it here, or add a helper.";
    now: "now";
    last: "last";
    for_example: "for example";
    draft_found: "This is your unsaved draft.";
    start_over: "Start over";
    copy_mine: "Copy what I wrote";
    gone_close: "What you wrote is still here: copy it, or close.";
    you_removed: "You removed this.";
    somebody_removed: "Somebody removed this.";
    earlier: "Earlier in the order";
    compared_how: "How it is compared";
    edit_ordinary: "Stream settings";
    type_label: "Type";
    helper_name: "Name";
    helper_params: "Parameters, with commas between them";
    helper_says: "What it is for, in a sentence";
    helper_gives: "What it gives";
    found_out: "found out by itself";
    a_ball: "a ball";
    a_face: "a face";
    used_nowhere: "Nothing uses it.";
    used_in: "Used in";
    this_program: "This program";
    stream_name_label: "Stream name";
    more_of_it: "More…";
    robot_runs_this: "The robot runs this version.";
    apply_all: "Use all changes";
    cannot_bring_back: "It cannot be brought back from here: it was removed too long ago. Copy what you wrote.";
    look_at_both: "Look at both";
    several_values: "Several values with commas between them are tried one after the other.";
}

/// Says where a number was before it was turned.
pub(crate) fn it_was(value: &str) -> String {
    say!(it_was: "was {value}", value)
}

/// A name in a procedure that means nothing.
pub(crate) fn no_such_name(name: &str) -> String {
    say!(no_such_name: "No “{name}” here.", name)
}

/// Writing another name in its place.
pub(crate) fn use_name(meant: &str) -> String {
    say!(use_name: "Use “{meant}”", meant)
}

/// Somebody else removed what a dialog is about.
pub(crate) fn removed_by(name: &str) -> String {
    say!(removed_by: "{name} removed this.", name)
}

/// Counts what a connector has done: `147 worked, no errors`.
pub(crate) fn worked(fired: u64, faults: u64) -> String {
    let fired = count(fired);
    match faults {
        0 => say!(worked_worked_no_errors: "{fired} worked, no errors", fired),
        faults => say!(worked_worked_failed: "{fired} worked, {faults} failed", fired, faults = count(faults)),
    }
}

/// The title of what sets a sense, an action or a stream up: `Tracker settings`.
pub(crate) fn settings_of(what: &str) -> String {
    say!(settings_of: "{what} settings", what)
}

pub(crate) fn spelling(written: &str, right: &str) -> String {
    say!(spelling: "Change {written} to {right}", written, right)
}

pub(crate) fn field_of(argument: &str, device: &robot::Device, field: &robot::Field) -> String {
    format!("{argument}.{}: {}", field.name, label_of(&device.field_called(field)))
}

pub(crate) fn trial(given: &str, result: &str) -> String {
    format!("{given} → {result}")
}

pub(crate) fn through(helper: &str) -> String {
    say!(through: "through {helper}", helper)
}

pub(crate) fn and_more(count: u64) -> String {
    say!(and_more: "and {count} more", count)
}

pub(crate) fn hangs_below(count: usize) -> String {
    say!(hangs_below: "What hangs below: {streams}", streams = streams(u32::try_from(count).unwrap_or(u32::MAX)))
}

pub(crate) fn also_use(action: &str) -> String {
    say!(also_use: "Other programs with {action}", action)
}

pub(crate) fn from_senses(senses: &str) -> String {
    say!(from_senses: "from {senses}", senses)
}

pub(crate) fn has_all(robot: &str) -> String {
    say!(has_all: "{robot} has all the senses and actions it needs.", robot)
}

pub(crate) fn helper_called(name: &str) -> String {
    say!(helper_called: "helper {name}", name)
}

/// The field in which one says what kind of value a helper's argument is.
pub(crate) fn helper_takes(argument: &str) -> String {
    say!(helper_takes: "What “{argument}” is", argument)
}

/// Names a type that a helper takes or gives, as one chooses it.
pub(crate) fn declared(declared: behaviour::Declared) -> String {
    use behaviour::Declared;
    match (declared, declared.value_type()) {
        (Declared::Ball, _) => a_ball().to_owned(),
        (Declared::Face, _) => a_face().to_owned(),
        (_, Some(kind)) => told_by(&kind),
        (_, None) => found_out().to_owned(),
    }
}

pub(crate) fn lead_to_existing(name: &str) -> String {
    say!(lead_to_existing: "“{name}”, which is there already", name)
}

/// A value of a marble example: "5 at 0.3 s".
pub(crate) fn value_at(value: &str, at_ms: u64) -> String {
    say!(value_at: "{value} at {seconds_short}", value, seconds_short = seconds_short(at_ms))
}

/// A lane of a marble example: "Distance: 5 at 0 s, 30 at 0.3 s".
pub(crate) fn lane_tells(name: &str, values: &str) -> String {
    if values.is_empty() { say!(lane_tells: "{name}: nothing", name) } else { titled(name, values) }
}

/// Says what a marble example gives.
pub(crate) fn comes_out(lane: &str) -> String {
    say!(comes_out: "Out comes {lane}", lane)
}

/// A short time: "0.3 s".
pub(crate) fn seconds_short(ms: u64) -> String {
    say!(seconds_short: "{seconds} s", seconds = ms as f64 / 1_000.0)
}

/// The time written beside a value.
pub(crate) fn at_ms(time: &str) -> String {
    format!("t = {time}")
}

/// A sign of comparison, for people.
pub(crate) fn sign(sign: &str) -> &'static str {
    match sign {
        "<" => "<",
        "<=" => "≤",
        ">" => ">",
        ">=" => "≥",
        "==" => "=",
        _ => "≠",
    }
}

/// Says where a value is now.
pub(crate) fn now_is(value: &str) -> String {
    say!(now_is: "now {value}", value)
}

/// A value that a test lets through.
pub(crate) fn value_passes(value: &str) -> String {
    say!(value_passes: "{value} passes", value)
}

/// A value that a test stops.
pub(crate) fn value_left_out(value: &str) -> String {
    say!(value_left_out: "{value} is left out", value)
}

/// A stream whose values shall go to another place too.
pub(crate) fn connect_named(name: &str) -> String {
    say!(connect_named: "Connect {name}", name)
}

/// A stream that shall get values.
pub(crate) fn connect_to(name: &str) -> String {
    say!(connect_to: "Connect to {name}", name)
}

/// A stream that can be led nowhere else.
pub(crate) fn leads_everywhere(name: &str) -> String {
    say!(leads_everywhere: "{name} is led everywhere already.", name)
}

pub(crate) fn apply_of(name: &str) -> String {
    say!(apply_of: "Use {name}’s changes", name)
}

/// "Ben changed Close ball: 40 → 60 cm".
pub(crate) fn changed_from(name: &str, of: &str, was: &str, is: &str) -> String {
    say!(changed_from: "{name} changed {of}: {was} → {is}", name, of, was, is)
}

pub(crate) fn changed_it(name: &str, of: &str) -> String {
    say!(changed_it: "{name} changed {of}", name, of)
}

pub(crate) fn added_it(name: &str, of: &str) -> String {
    say!(added_it: "{name} added {of}", name, of)
}

pub(crate) fn removed_of(name: &str, of: &str) -> String {
    say!(removed_of: "{name} removed {of}", name, of)
}

pub(crate) fn still_edits(name: &str, of: &str) -> String {
    say!(still_edits: "{name} is still editing {of}", name, of)
}

/// Tells the state of a slider: the test, where the value is now, and what becomes of it if that can be told.
pub(crate) fn slider_said(sign: &str, number: &str, now: Option<(String, Option<bool>)>) -> String {
    let test = match sign {
        "<" => say!(slider_said_less_than: "less than {number}", number),
        "≤" => say!(slider_said_at_most: "at most {number}", number),
        ">" => say!(slider_said_more_than: "more than {number}", number),
        "≥" => say!(slider_said_at_least: "at least {number}", number),
        "=" => say!(slider_said_exactly: "exactly {number}", number),
        _ => say!(slider_said_not: "not {number}", number),
    };
    match now {
        Some((now, Some(true))) => say!(slider_said_now_passes: "{test}; now {now}, passes", test, now),
        Some((now, Some(false))) => say!(slider_said_now_left_out: "{test}; now {now}, left out", test, now),
        Some((now, None)) => say!(slider_said_now: "{test}; now {now}", test, now),
        None => test,
    }
}

/// Says what the robot has in the place of what was changed.
pub(crate) fn robot_still_uses(what: &str) -> String {
    say!(robot_still_uses: "The robot still uses {what}.", what)
}

/// Says what holds while somebody else is editing a connector: its number, if it has one.
pub(crate) fn it_is_until(number: Option<&str>, name: &str) -> String {
    match number {
        Some(number) => say!(it_is_until_it_is_until_saves: "It is {number} until {name} saves.", number, name),
        None => say!(it_is_until_it_stays_as_it: "It stays as it is until {name} saves.", name),
    }
}

/// Beside a draft that is older than what is saved.
pub(crate) fn saved_since_draft(name: &str) -> String {
    say!(saved_since_draft: "{name} saved something else since you wrote this. If you save it, it takes the place of theirs.", name)
}

pub(crate) fn saved_since_draft_at(name: &str, when: &str) -> String {
    say!(
        saved_since_draft_at: "{name} saved something else at {when}, after you wrote this. If you save it, it takes the place of theirs.",
        name,
        when
    )
}

/// In the dialog of a helper that somebody else saved meanwhile, above how it is by now.
pub(crate) fn helper_changed_too(name: &str) -> String {
    say!(helper_changed_too: "{name} changed this helper too. What you wrote is still here; this is saved now:", name)
}

/// Says what a connector does, at length.
pub(crate) fn connector_does(spec: &behaviour::connectors::Spec) -> &'static str {
    said_by(&format!("connector.{}.does", spec.word), spec.help.does)
}

/// Says when a connector is used.
pub(crate) fn connector_when(spec: &behaviour::connectors::Spec) -> &'static str {
    said_by(&format!("connector.{}.when", spec.word), spec.help.when)
}

/// The title of an example of a connector.
pub(crate) fn connector_example(spec: &behaviour::connectors::Spec, title: &'static str) -> &'static str {
    let nth = spec.help.examples.iter().position(|example| example.title == title).unwrap_or_default();
    said_by(&format!("connector.{}.example{nth}", spec.word), title)
}

/// Sentences one after the other.
pub(crate) fn one_after_another(sentences: &[String]) -> String {
    let sentences = sentences.iter().cloned();
    sentences.reduce(|before, last| say!(one_after_another: "{before}. {last}", before, last)).unwrap_or_default()
}

/// The field in which a helper's argument gets a value: "Value of ball".
pub(crate) fn value_for(argument: &str) -> String {
    say!(value_for: "Value of {argument}", argument)
}
