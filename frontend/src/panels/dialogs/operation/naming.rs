//! What the output stream is called until a person types a name: it follows the connector.

use super::form::Form;
use crate::words;
use leptos::prelude::*;

/// The longest offered name, in characters, with room for the number that makes it unique.
const CHARS_MAX: usize = 36;

/// The name before it is made unique. Reactive.
pub(super) fn name_base(form: Form) -> String {
    let desk = form.desk.desk();
    let inputs = form.inputs.get();
    let names: Vec<String> =
        inputs.iter().filter_map(|id| Some(desk.stream(id)?.record.read().name.trim().to_owned())).collect();
    let period_ms = form.period.get().trim().parse::<u64>().ok();
    let by_helper = form.way.get() == "helper";
    let kind = form.kind.get();
    let fill = |hole: &str| match hole {
        "input" => Some(names.first().cloned().unwrap_or_default()),
        "others" => names.get(1..).filter(|others| !others.is_empty()).map(words::one_of),
        "helper" => Some(title(&form.helper.get())).filter(|name| by_helper && !name.is_empty()),
        "body" if !by_helper => {
            let arguments = form.arguments();
            let skipped = arguments.len().saturating_sub(names.len());
            by_body(&form.body.get(), &arguments[skipped..], &names)
        }
        "period" => period_ms.map(words::duration),
        "every" => period_ms.map(words::every),
        _ => None,
    };
    clipped(&kind.called.iter().find_map(|template| filled(template, fill)).unwrap_or_default())
}

/// A template with its `{holes}` filled, if all can be.
fn filled(template: &str, fill: impl Fn(&str) -> Option<String>) -> Option<String> {
    let mut parts = template.split('{');
    let mut name = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (hole, rest) = part.split_once('}')?;
        name += &fill(hole)?;
        name += rest;
    }
    Some(name)
}

/// A short expression names its stream, with the streams' own names in it: `distanceToBall < 20` becomes
/// "Distance to ball < 20". One that is not finished, or is a whole procedure, does not.
fn by_body(body: &str, arguments: &[String], names: &[String]) -> Option<String> {
    let body = body.trim();
    let is_finished = body.ends_with(|c: char| c.is_alphanumeric() || ")]\"'`_".contains(c));
    if !is_finished
        || body.contains(['\n', ';', '{'])
        || body.contains("//")
        || arguments.iter().any(|name| name == body)
    {
        return None;
    }
    let apart = |at: usize| format!("rrp_name_{at}");
    let marked = arguments.iter().enumerate();
    let marked = marked.fold(body.to_owned(), |body, (at, name)| behaviour::rename_identifier(&body, name, &apart(at)));
    let named = names.iter().enumerate().rev();
    let named = named.fold(marked, |body, (at, name)| behaviour::rename_identifier(&body, &apart(at), name));
    Some(first_upper(&named.split_whitespace().collect::<Vec<_>>().join(" ")))
}

/// The name of a helper as the name of a stream: `ball_to_distance` becomes "Ball to distance".
fn title(helper: &str) -> String {
    first_upper(helper.replace('_', " ").trim())
}

fn first_upper(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

fn clipped(name: &str) -> String {
    if name.chars().count() <= CHARS_MAX {
        return name.to_owned();
    }
    let start: String = name.chars().take(CHARS_MAX - 1).collect();
    format!("{}…", start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::{by_body, clipped, filled, title};

    fn named(body: &str, streams: &[&str]) -> Option<String> {
        let names: Vec<String> = streams.iter().map(|name| (*name).to_owned()).collect();
        by_body(body, &behaviour::argument_names(streams.iter().copied()), &names)
    }

    #[test]
    fn a_helper_names_its_stream() {
        assert_eq!(title("ball_to_distance"), "Ball to distance");
        assert_eq!(title("_x"), "X");
    }

    #[test]
    fn an_expression_names_its_stream() {
        let some = |name: &str| Some(name.to_owned());
        assert_eq!(named("distance < 20", &["Distance"]), some("Distance < 20"));
        assert_eq!(named("distanceToBall  <\t20", &["Distance to ball"]), some("Distance to ball < 20"));
        assert_eq!(named("redBall.size", &["RedBall"]), some("RedBall.size"));
        assert_eq!(named("b - a", &["A", "B"]), some("B - A"));
        assert_eq!(named("距離", &["x"]), some("距離"));
    }

    #[test]
    fn what_is_not_finished_names_nothing() {
        for body in
            ["", "distance < ", "distance", "if distance < 1 { 2 }", "let x = 1; x", "distance < 1 // near", "2 *"]
        {
            assert_eq!(named(body, &["Distance"]), None, "{body}");
        }
    }

    #[test]
    fn a_name_is_filled_only_as_a_whole() {
        let fill = |hole: &str| (hole == "input").then(|| "{body}".to_owned());
        assert_eq!(filled("Some {input}!", fill).as_deref(), Some("Some {body}!"));
        assert_eq!(filled("{input} or {others}", fill), None);
    }

    #[test]
    fn long_names_are_cut() {
        assert_eq!(clipped("short"), "short");
        let cut = clipped(&"long name ".repeat(9));
        assert!(cut.chars().count() <= 36 && cut.ends_with('…'), "{cut}");
    }
}
