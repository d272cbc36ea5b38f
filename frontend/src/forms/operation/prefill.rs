//! The beginning of a test that a person most likely wants: `distance < ` for a stream of numbers.

use crate::carries::carries;
use crate::parts::DeskHold;
use behaviour::connectors::{Carries, Spec};
use behaviour::{Helper, Id};
use leptos::prelude::*;

/// What the body of a new connector begins with.
pub(super) fn beginning(desk: DeskHold, input: &Id, kind: &Spec) -> String {
    if !kind.is_test() || !is_number(desk, input) {
        return String::new();
    }
    let desk = desk.desk();
    let name = desk.document.stream(input).map(|signals| signals.record.get_untracked().name).unwrap_or_default();
    let argument = behaviour::argument_names([name.as_str()]).pop().unwrap_or_default();
    format!("{argument} < ")
}

/// The test alone, when somebody writes all of it after the beginning: `distance < distance > 5` becomes `distance > 5`.
pub(super) fn typed_whole(begun: &str, body: &str) -> Option<String> {
    let argument = begun.split(' ').next().filter(|argument| !argument.is_empty())?;
    let rest = body.strip_prefix(begun)?;
    let before = &rest[..rest.find(['<', '>', '=', '!'])?];
    let mut words = before.split(|c| !behaviour::is_name_letter(c));
    words.any(|word| word == argument).then(|| rest.to_owned())
}

/// What it carries now decides; before the first Start it is guessed from what makes it.
fn is_number(desk: DeskHold, id: &Id) -> bool {
    let desk = desk.desk();
    let newest = desk.document.stream(id).and_then(|signals| signals.live.read_untracked().value.clone());
    let helpers: Vec<Helper> = desk.library.helpers.get_untracked().into_iter().map(|(_, helper)| helper).collect();
    carries(&desk.document.behaviour(), &helpers, id, newest.as_ref()) == Carries::Number
}

#[cfg(test)]
mod tests {
    use super::typed_whole;

    #[test]
    fn a_test_that_is_written_whole_replaces_its_beginning() {
        let typed = |body: &str| typed_whole("distance < ", body);
        assert_eq!(typed("distance < distance <").as_deref(), Some("distance <"));
        assert_eq!(typed("distance < abs(distance) > 5").as_deref(), Some("abs(distance) > 5"));
        for body in ["distance < 20", "distance < distance", "distance < distanceMax <", "distance", "other < 3"] {
            assert_eq!(typed(body), None, "{body}");
        }
        assert_eq!(typed_whole("", "a < 1"), None);
    }
}
