//! Names and words: what Rhai keeps for itself, and what a therapist reads when a procedure is refused or faults.
#![expect(clippy::unwrap_used, reason = "a test may give up")]

use behaviour::{FileHelper, Value, argument_names, is_identifier};
use engine::{Limits, check_body, try_body};

/// The list that `behaviour` keeps, from its source: it is private there.
fn kept_words() -> Vec<&'static str> {
    let source = include_str!("../../behaviour/src/names.rs");
    let list = source.split("RHAI_KEYWORDS: &[&str] = &[").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    list.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty()).collect()
}

/// Words that other languages, or earlier versions of Rhai, keep for themselves, and words of procedures.
const OTHER_WORDS: &str = "exit self Self type enum struct trait mod pub mut ref where impl dyn crate elseif undef then or \
    and not foreach unless begin end abs min max sin len push keys values timestamp sleep parse_json range tag \
    global int float string array map bool char this_ _this Print EVAL ball distance";

fn works_as_argument(name: &str) -> bool {
    let names = [name.to_owned()];
    try_body(&[], &names, &format!("{name} + 1"), &[Value::Int(3)], &Limits::default()) == Ok(Value::Int(4))
}

#[test]
fn every_kept_word_is_refused_by_rhai_and_every_other_works() {
    let kept = kept_words();
    assert!(kept.len() > 60);
    for word in kept.iter().copied().chain(OTHER_WORDS.split_whitespace()) {
        assert_eq!(works_as_argument(word), is_identifier(word), "{word}");
        let argument = argument_names([word]).remove(0);
        assert!(works_as_argument(&argument), "{word} as {argument}");
        let helper =
            FileHelper { name: argument.clone(), params: vec!["v".into()], body: "v".into(), ..FileHelper::default() };
        if ["timestamp", "sleep", "parse_json"].contains(&word) {
            continue;
        }
        let call = format!("{argument}(1)");
        assert_eq!(try_body(&[helper], &[], &call, &[], &Limits::default()), Ok(Value::Int(1)), "{word}");
    }
}

#[test]
fn a_refusal_says_where_and_what() {
    let cases = [
        ("abs(ball", "at character 9: a closing ) is missing"),
        ("ball.size <", "at character 12: it ends too early"),
        ("redbal + 1", "no “redbal” here; there is ball"),
        ("ball +\n \"x", "line 2, character 2: the closing quote of a text is missing"),
        ("#{a: 1", "at character 7: a closing } is missing"),
        ("ball = = 1", "at character 8: “=” is not expected here"),
        ("if ball { 1 } else", "at character 19: { is missing"),
        ("", "it has no procedure yet"),
        ("ball == 1 &&& 2", "at character 13: “&” is not expected here"),
        ("eval(\"1\")", "at character 1: “eval” cannot be used here"),
        ("1 + sleep(1)", "at character 5: “sleep” cannot be used in a procedure"),
        ("(ball && \"text\")", "at character 10: true or false is needed here, not a text"),
    ];
    let ball = ["ball".to_owned()];
    for (body, words) in cases {
        let refused = check_body(&ball, body).map_err(|fault| fault.to_string());
        assert_eq!(refused, Err(words.to_owned()), "{body}");
    }
}

#[test]
fn a_fault_says_what_in_plain_words() {
    let cases = [
        ("1 / (n - n)", "division by zero has no result; check first that the number is not 0"),
        ("1 % (n - n)", "division by zero has no result; check first that the number is not 0"),
        ("ball.siz", "there is no field “siz” in this object; check how its name is written"),
        ("n.size", "a whole number has no field “size”; take fields of objects only"),
        ("distanc(ball)", "there is no function “distanc” of an object; check its name and what it is given"),
        (
            "ball - 1",
            "an object and a whole number cannot be combined with -; take a field or an item of the right kind",
        ),
        ("-ball", "- does not work on an object; take a field or an item of the right kind"),
        ("if n { 1 }", "true or false is needed here, not a whole number; change what stands here"),
        ("[1, 2][n]", "there is no item 5 in a list of 2; ask for its length first, and count from 0"),
        ("n[0][0]", "true or false has no parts to take with [ ]; take parts of lists, objects and texts only"),
        ("far(ball)", "in the helper “far”: there is no field “siz” in this object; check how its name is written"),
        ("[1].map(|i| i / 0)", "division by zero has no result; check first that the number is not 0"),
        ("n * 9223372036854775807", "a whole number became too large; use a measured number, such as 1.0"),
        ("throw \"No ball.\"", "no ball"),
        ("for i in n { }", "for goes through a list, a text or a range only; give it one of these"),
        (
            "let f = |g| g.call(g); f.call(f)",
            "calls are nested too deep; let fewer helpers and closures call each other",
        ),
        (
            "let t = \"a\"; t.pad(5000, \"b\")",
            "a text, list or object became too large; keep only what is needed of it",
        ),
        ("0.0 / 0.0", "the result is not a number (NaN); check what it divides or takes the root of"),
        ("|a| a", "a function cannot flow in a stream; end with a number, a text, a list or an object"),
        ("loop {}", "it takes too many steps; look for a loop without an end, or use smaller lists and texts"),
    ];
    let names = ["ball".to_owned(), "n".to_owned()];
    let inputs = [Value::object([("size", Value::Float(0.1))]), Value::Int(5)];
    let far =
        FileHelper { name: "far".into(), params: vec!["b".into()], body: "b.siz".into(), ..FileHelper::default() };
    for (body, words) in cases {
        let made = try_body(std::slice::from_ref(&far), &names, body, &inputs, &Limits::default());
        assert_eq!(made.unwrap_err().to_string(), words, "{body}");
    }
}

#[test]
fn what_the_deadline_ends_is_told_what_to_do() {
    let limits = Limits::default().interrupted_by(|| true);
    let made = try_body(&[], &[], "loop {}", &[], &limits);
    assert_eq!(made.unwrap_err().to_string(), "it took too long and was ended; let it do less for one value");
}
