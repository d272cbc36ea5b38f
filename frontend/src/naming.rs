//! What a stream is called until a person types a name: it follows the connector that makes it. Pure.

use crate::words::{NameLanguage, filled_whole, first_upper};
use behaviour::connectors::Spec;
use behaviour::{Behaviour, Connector, Procedure};

/// The longest name, in characters, with room for the number that makes it unique.
const CHARS_MAX: usize = 36;

/// What a name is made of.
#[derive(Default)]
pub(crate) struct NameParts<'a> {
    /// The names of the inputs, in order.
    pub(crate) inputs: &'a [String],
    pub(crate) helper: Option<&'a str>,
    /// A body, and what it calls the inputs.
    pub(crate) body: Option<(&'a str, &'a [String])>,
    pub(crate) period_ms: Option<u64>,
}

/// The name before it is made unique, in the language of the page. Empty if it has to be asked for: a test, or what makes
/// a new value, is named after its helper or after a short body.
pub(crate) fn called(spec: &Spec, parts: &NameParts) -> String {
    called_in(NameLanguage::Page, spec, parts)
}

fn called_in(naming: NameLanguage, spec: &Spec, parts: &NameParts) -> String {
    let names = parts.inputs;
    let value = |hole: &str| match hole {
        "input" => names.first().cloned().filter(|name| !name.is_empty()),
        "others" => names.get(1..).filter(|others| !others.is_empty()).map(|others| naming.either(others)),
        "helper" => parts.helper.map(|helper| naming.helper(helper)).filter(|name| !name.is_empty()),
        "body" => parts.body.and_then(|(body, arguments)| by_body(body, arguments, names)),
        "period" => parts.period_ms.map(|ms| naming.period(ms)),
        "every" => parts.period_ms.map(|ms| naming.every(ms)),
        _ => None,
    };
    let name = spec.output_names().find_map(|template| filled_whole(naming.said(&template), value));
    clipped(&name.unwrap_or_default())
}

/// What the output of a connector of this behaviour would be called in this language.
fn called_after(naming: NameLanguage, behaviour: &Behaviour, connector: &Connector) -> String {
    let name = |id| behaviour.stream(id).map(|stream| stream.name.trim().to_owned());
    let inputs: Vec<String> = connector.inputs.iter().filter_map(name).collect();
    let operation = &connector.operation;
    let arguments = behaviour.arguments(connector);
    let skipped = arguments.len().saturating_sub(inputs.len());
    let (helper, body) = match operation.procedure() {
        Some(Procedure::Helper(name)) => (Some(name.as_str()), None),
        Some(Procedure::Body { body, .. }) => (None, Some((body.as_str(), &arguments[skipped..]))),
        None => (None, None),
    };
    called_in(naming, operation.spec(), &NameParts { inputs: &inputs, helper, body, period_ms: operation.period_ms() })
}

/// The name of a stream after its connector has become another, in the language of the name that it has; none if a person
/// typed that, or it stays.
pub(crate) fn followed(behaviour: &Behaviour, name: &str, seen: &Connector, edited: &Connector) -> Option<String> {
    if behaviour::is_otherwise(name) && seen.operation != edited.operation {
        // A person made it one of its own.
        let own = called_after(NameLanguage::Page, behaviour, edited);
        return Some(own).filter(|own| !own.is_empty() && !behaviour::follows_test(behaviour, edited));
    }
    let by_connector = |naming: &NameLanguage| {
        let before = called_after(*naming, behaviour, seen);
        !before.is_empty() && is_given(name, &before)
    };
    let naming = [NameLanguage::Page, NameLanguage::English].into_iter().find(by_connector)?;
    let after = called_after(naming, behaviour, edited);
    (!after.is_empty() && after != called_after(naming, behaviour, seen)).then_some(after)
}

/// Whether nobody typed a stream's name: it is what its connector would call it, or that with a number.
fn is_given(name: &str, by_connector: &str) -> bool {
    let rest = name.strip_prefix(by_connector).map(str::trim);
    rest.is_some_and(|rest| rest.is_empty() || rest.bytes().all(|byte| byte.is_ascii_digit()))
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
    let named = behaviour::rename_identifiers(body, arguments, names);
    Some(first_upper(&named.split_whitespace().collect::<Vec<_>>().join(" ")))
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
    use super::{NameParts, by_body, called_in, clipped, is_given};
    use crate::words::{NameLanguage, language::speak};
    use behaviour::connectors;

    fn named(body: &str, streams: &[&str]) -> Option<String> {
        let names: Vec<String> = streams.iter().map(|name| (*name).to_owned()).collect();
        by_body(body, &behaviour::argument_names(streams.iter().copied()), &names)
    }

    #[test]
    fn a_helper_names_its_stream() {
        let title = |helper: &str| NameLanguage::English.helper(helper);
        assert_eq!(title("ball_to_distance"), "Distance in m");
        assert_eq!(title("near_enough"), "Near enough");
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
    fn names_are_in_the_language_of_the_page_and_those_of_others_are_known() {
        let table = "connector.sample.called0\n{every}の{input}\n\nname_every_second\n毎秒\n\nname_every\n{period}ごと\n\nname_seconds\n{seconds} 秒\n\nhelper.distance.stream\n距離\n";
        speak(table.to_owned());
        let inputs = ["距離".to_owned()];
        let every = |naming, ms| {
            let parts = NameParts { inputs: &inputs, period_ms: Some(ms), ..NameParts::default() };
            called_in(naming, connectors::spec("sample").unwrap(), &parts)
        };
        assert_eq!(
            (every(NameLanguage::Page, 1_000), every(NameLanguage::Page, 2_000)),
            ("毎秒の距離".into(), "2 秒ごとの距離".into())
        );
        assert_eq!(every(NameLanguage::English, 1_000), "距離 every second");
        assert_eq!(
            (NameLanguage::Page.helper("distance"), NameLanguage::English.helper("distance")),
            ("距離".into(), "Distance".into())
        );
    }

    #[test]
    fn what_neither_a_helper_nor_a_short_body_names_is_asked_for() {
        let inputs = ["Distance".to_owned(), "RedBall".to_owned()];
        let arguments = behaviour::argument_names(["Distance", "RedBall"]);
        let called = |word: &str, body: &str| {
            let body = Some((body, &arguments[..]));
            called_in(
                NameLanguage::English,
                connectors::spec(word).unwrap(),
                &NameParts { inputs: &inputs, body, ..NameParts::default() },
            )
        };
        for word in ["filter", "map", "combineLatest"] {
            assert_eq!(called(word, "distance < "), "", "{word}");
        }
        assert_eq!(called("filter", "distance < 40"), "Distance < 40");
        assert_eq!(called("merge", ""), "Distance or RedBall");
    }

    #[test]
    fn an_otherwise_that_becomes_one_of_its_own_is_named_anew() {
        let file = r#"{"format":"rrp-behaviour/1","name":"Test","helpers":[],"streams":[
            {"id":"d","kind":"ordinary","name":"Distance"},{"id":"n","kind":"ordinary","name":"Near"},
            {"id":"o","kind":"ordinary","name":"Otherwise"}],"connectors":[
            {"id":"t","type":"filter","inputs":["d"],"output":"n","body":"distance < 40"},
            {"id":"f","type":"filter","inputs":["d"],"output":"o","body":"distance >= 40"}]}"#;
        let file: behaviour::BehaviourFile = serde_json::from_str(file).unwrap();
        let made = file.records(|_| None).unwrap();
        let seen = made.connector(&behaviour::Id::new("f").unwrap()).unwrap().clone();
        let called = |body: &str| {
            let operation = connectors::spec("filter").unwrap().with(behaviour::Procedure::body(body));
            super::followed(&made, "Otherwise", &seen, &behaviour::Connector { operation, ..seen.clone() })
        };
        assert_eq!(called("distance >= 60").as_deref(), Some("Distance >= 60"));
        assert_eq!((called("distance >= 40"), called("!(distance < 40)")), (None, None));
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
    fn long_names_are_cut() {
        assert_eq!(clipped("short"), "short");
        let cut = clipped(&"long name ".repeat(9));
        assert!(cut.chars().count() <= 36 && cut.ends_with('…'), "{cut}");
    }

    #[test]
    fn a_name_that_was_given_may_have_a_number() {
        assert!(is_given("Distance < 40", "Distance < 40") && is_given("Distance < 40 2", "Distance < 40"));
        assert!(!is_given("Close", "Distance < 40") && !is_given("Distance < 40 m", "Distance < 40"));
    }
}
