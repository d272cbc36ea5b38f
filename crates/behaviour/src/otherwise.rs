//! “Otherwise”: a test that passes just what another test of the same stream keeps out, and follows it.
//!
//! Nothing else links the two: a test is an otherwise as long as its stream is called so. So the link is in every file and
//! store, comes back with an undo, and ends when a person gives the stream another name.

use crate::names::tokens::{TokenKind, tokens};
use crate::{
    Behaviour, Change, Connector, Edit, Id, Kind as RecordKind, Procedure, Record, RecordId, rename_identifiers,
};
use phrase::LANGUAGES;

/// Signs that compare, each with the one that is true when it is false.
const OPPOSITES: [(&str, &str); 6] =
    [(" < ", " >= "), (" > ", " <= "), (" <= ", " > "), (" >= ", " < "), (" == ", " != "), (" != ", " == ")];

/// True if a stream is called “Otherwise” in one of our languages, perhaps with a number.
#[must_use]
pub fn is_otherwise(name: &str) -> bool {
    let rest = LANGUAGES.iter().find_map(|language| name.trim().strip_prefix(language.otherwise));
    rest.is_some_and(|rest| rest.trim().bytes().all(|byte| byte.is_ascii_digit()))
}

/// The test that is true when this one is false.
#[must_use]
pub fn opposite(body: &str) -> String {
    let plain = !["&&", "||", "!("].iter().any(|sign| body.contains(sign));
    let found: Vec<_> = OPPOSITES.iter().filter(|(sign, _)| body.matches(sign).count() == 1).collect();
    if let Some(inside) = body.trim().strip_prefix("!(").and_then(|rest| rest.strip_suffix(')'))
        && is_one_whole(inside)
    {
        return inside.to_owned();
    }
    match found.as_slice() {
        [(sign, other)] if plain => body.replacen(sign, other, 1),
        _ => format!("!({body})"),
    }
}

/// True if no bracket is closed in it that is not opened in it.
fn is_one_whole(body: &str) -> bool {
    let mut open = 0_i64;
    tokens(body).iter().all(|token| {
        open += match token.kind {
            TokenKind::Open(_) => 1,
            TokenKind::Close(_) => -1,
            _ => 0,
        };
        open >= 0
    })
}

/// The test that an otherwise is the other side of, with its id: the only other one of the same stream, or the only one of
/// them whose other side it is.
pub(crate) fn test_of<'b>(behaviour: &'b Behaviour, otherwise: &Connector) -> Option<(&'b Id, &'b Connector)> {
    let is_so_called = |one: &Connector| behaviour.stream(&one.output).is_some_and(|stream| is_otherwise(&stream.name));
    let spec = otherwise.operation.spec();
    if !spec.is_test() || !is_so_called(otherwise) {
        return None;
    }
    let is_beside = |(_, one): &(&Id, &Connector)| {
        one.operation.spec() == spec
            && one.inputs == otherwise.inputs
            && one.output != otherwise.output
            && !is_so_called(one)
    };
    let tests: Vec<_> = behaviour.connectors().filter(is_beside).collect();
    let mut follows = tests.iter().filter(|(_, test)| is_other_side(behaviour, test, otherwise));
    match &tests[..] {
        [only] => Some(*only),
        _ => follows.next().filter(|_| follows.next().is_none()).copied(),
    }
}

/// Returns the procedure of an otherwise, as the other side of a test; none while the test is not written.
pub(crate) fn other_side(behaviour: &Behaviour, test: &Connector, otherwise: &Connector) -> Option<String> {
    Some(opposite(&asks(behaviour, test, otherwise)?))
}

/// Returns the condition of a test, in the names of an otherwise.
fn asks(behaviour: &Behaviour, test: &Connector, otherwise: &Connector) -> Option<String> {
    let names = behaviour.arguments(otherwise);
    match test.operation.procedure()? {
        Procedure::Helper(name) => Some(format!("{name}({})", names.join(", "))),
        Procedure::Body { body, .. } if body.trim().is_empty() => None,
        Procedure::Body { body, .. } => Some(rename_identifiers(body.trim(), &behaviour.arguments(test), &names)),
    }
}

/// True if an otherwise passes just what a test keeps out, as far as can be read.
pub(crate) fn is_other_side(behaviour: &Behaviour, test: &Connector, otherwise: &Connector) -> bool {
    let Some(asked) = asks(behaviour, test, otherwise) else { return true };
    match otherwise.operation.procedure() {
        Some(Procedure::Body { body, .. }) => {
            plain(&opposite(&asked)) == plain(body) || plain(&asked) == plain(&opposite(body.trim()))
        }
        Some(Procedure::Helper(_)) | None => false,
    }
}

/// A procedure without what makes no difference: blanks, and brackets around a single name.
fn plain(body: &str) -> String {
    let pieces: Vec<&str> = tokens(body).into_iter().map(|token| &body[token.place]).collect();
    match &pieces[..] {
        ["!", "(", inside @ .., ")"] if !inside.iter().any(|piece| "()<>=!&|".contains(&piece[..1])) => {
            format!("! {}", inside.join(" "))
        }
        pieces => pieces.join(" "),
    }
}

/// True if this connector, as it is now or is to be, follows a test.
#[must_use]
pub fn follows_test(behaviour: &Behaviour, otherwise: &Connector) -> bool {
    test_of(behaviour, otherwise).is_some_and(|(_, test)| is_other_side(behaviour, test, otherwise))
}

/// The change in which each otherwise of a test that it edits follows that test, so that one undo takes both back. One that
/// the change edits itself, or that was none any more, stays.
#[must_use]
pub fn with_otherwise(behaviour: &Behaviour, change: Change) -> Change {
    let edited = |edit: &Edit| edit.id.kind == RecordKind::Connector && edit.before.is_some() && edit.after.is_some();
    if !change.edits.iter().any(edited) {
        return change;
    }
    let mut after = behaviour.clone();
    after.apply(&change);
    let is_edited = |id: &RecordId| change.edits.iter().any(|edit| edit.id == *id);
    let mut following = Vec::new();
    for (id, otherwise) in behaviour.connectors() {
        let id = RecordId::new(RecordKind::Connector, id);
        if is_edited(&id) || !follows_test(behaviour, otherwise) {
            continue;
        }
        // Another test that came beside it meanwhile makes no difference.
        let Some((test, _)) = test_of(behaviour, otherwise) else { continue };
        let is_beside =
            |test: &&Connector| test.operation.spec() == otherwise.operation.spec() && test.inputs == otherwise.inputs;
        let test = after.connector(test).filter(is_beside);
        let Some(test) = test.filter(|test| !is_other_side(&after, test, otherwise)) else { continue };
        let mut follows = otherwise.clone();
        if let (Some(body), Some(procedure)) = (other_side(&after, test, otherwise), follows.operation.procedure_mut())
        {
            match procedure {
                Procedure::Body { body: now, .. } => *now = body,
                Procedure::Helper(_) => *procedure = Procedure::body(&body),
            }
            following.push((id, Record::Connector(follows)));
        }
    }
    following.into_iter().fold(change, |change, (id, record)| change.put(behaviour, id, record))
}

/// The change without otherwises that only followed a test which it edits, where somebody else changed them meanwhile: its
/// author never touched them, so what became of them is nothing to ask about.
#[must_use]
pub fn without_late_followers(now: &Behaviour, change: Change) -> Change {
    let (mut seen, mut after) = (now.clone(), now.clone());
    seen.apply(&change.swapped(change.op.clone(), &change.label));
    after.apply(&change);
    let is_late = |edit: &Edit| now.records.get(&edit.id) != edit.before.as_ref();
    // A follower is added after its test.
    let follows = |(at, edit): (usize, &Edit)| {
        let tests = &change.edits[..at];
        tests
            .iter()
            .any(|test| are_twins(&seen, (&test.before, &edit.before)) && are_twins(&after, (&test.after, &edit.after)))
    };
    let stays = |(at, edit): &(usize, &Edit)| !(is_late(edit) && follows((*at, edit)));
    let edits = change.edits.iter().enumerate().filter(stays).map(|(_, edit)| edit.clone()).collect();
    Change { edits, ..change }
}

/// True if two records are a test and its other side.
fn are_twins(behaviour: &Behaviour, (test, otherwise): (&Option<Record>, &Option<Record>)) -> bool {
    let (Some(Record::Connector(test)), Some(Record::Connector(otherwise))) = (test, otherwise) else { return false };
    test.operation.spec() == otherwise.operation.spec()
        && test.inputs == otherwise.inputs
        && is_other_side(behaviour, test, otherwise)
}

#[cfg(test)]
mod tests {
    use super::{follows_test, is_otherwise, opposite, with_otherwise, without_late_followers};
    use crate::{
        Behaviour, Change, Connector, Id, Kind, Params, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn key(kind: Kind, text: &str) -> RecordId {
        RecordId::new(kind, &id(text))
    }

    fn stream(name: &str) -> Record {
        let (kind, name, params) = (StreamKind::Ordinary, name.to_owned(), Params::new());
        let (device, resources, priority, hold_ms) = (None, None, None, None);
        Record::Stream(Stream { kind, name, device, params, order: 0, resources, priority, hold_ms })
    }

    fn filter(output: &str, body: &str) -> Record {
        let operation = connectors::filter::SPEC.with(Procedure::body(body));
        Record::Connector(Connector { operation, inputs: vec![id("distance")], output: id(output), order: 0 })
    }

    fn twins(name: &str) -> Behaviour {
        let mut behaviour = Behaviour::default();
        for (at, record) in [("distance", "Distance"), ("near", "Near"), ("far", name)] {
            behaviour.records.insert(key(Kind::Stream, at), stream(record));
        }
        for (at, output, body) in [("test", "near", "distance < 40"), ("other", "far", "distance >= 40")] {
            behaviour.records.insert(key(Kind::Connector, at), filter(output, body));
        }
        behaviour
    }

    fn body(behaviour: &Behaviour, at: &str) -> String {
        match behaviour.connector(&id(at)).unwrap().operation.procedure() {
            Some(Procedure::Body { body, .. }) => body.clone(),
            other => panic!("{other:?}"),
        }
    }

    fn edited(behaviour: &Behaviour, at: &str, output: &str, body: &str) -> Change {
        let change = Change::of(id("op"), "Aiko", "Edit filter");
        with_otherwise(behaviour, change.put(behaviour, key(Kind::Connector, at), filter(output, body)))
    }

    #[test]
    fn an_otherwise_follows_its_test_and_one_undo_takes_both_back() {
        for name in ["Otherwise", "Otherwise 2", "それ以外"] {
            let before = twins(name);
            let mut after = before.clone();
            let change = edited(&before, "test", "near", "distance < 45");
            after.apply(&change);
            assert_eq!(body(&after, "other"), "distance >= 45", "{name}");
            after.apply(&change.swapped(id("undo"), "Undo"));
            assert_eq!(after, before);
        }
        let mut after = twins("Otherwise");
        for (test, other) in [
            ("distance > 10 && distance < 40", "!(distance > 10 && distance < 40)"),
            ("distance == 3", "distance != 3"),
            ("close(distance)", "!(close(distance))"),
        ] {
            after.apply(&edited(&after, "test", "near", test));
            assert_eq!(body(&after, "other"), other);
        }
    }

    #[test]
    fn one_of_its_own_stays() {
        let renamed = twins("Far");
        assert_eq!(edited(&renamed, "test", "near", "distance < 45").edits.len(), 1, "another name");
        let before = twins("Otherwise");
        assert_eq!(edited(&before, "other", "far", "distance >= 60").edits.len(), 1, "itself edited");
        let mut own = before.clone();
        own.apply(&edited(&before, "other", "far", "distance >= 60"));
        assert!(!follows_test(&own, own.connector(&id("other")).unwrap()));
        assert_eq!(edited(&own, "test", "near", "distance < 45").edits.len(), 1, "none any more");
        let twice = third(&before, "distance < 40");
        assert_eq!(edited(&twice, "test", "near", "distance < 45").edits.len(), 1, "of which of two nobody knows");
    }

    fn third(behaviour: &Behaviour, body: &str) -> Behaviour {
        let mut three = behaviour.clone();
        three.records.insert(key(Kind::Stream, "mid"), stream("Mid"));
        three.records.insert(key(Kind::Connector, "third"), filter("mid", body));
        three
    }

    #[test]
    fn of_several_tests_it_follows_the_one_whose_other_side_it_is() {
        let mut three = third(&twins("Otherwise"), "distance < 20");
        assert_eq!(edited(&three, "third", "mid", "distance < 15").edits.len(), 1, "not its test");
        three.apply(&edited(&three, "test", "near", "distance < 45"));
        assert_eq!(body(&three, "other"), "distance >= 45");
        three.apply(&edited(&three, "test", "near", "distance < 60"));
        assert_eq!(body(&three, "other"), "distance >= 60");
    }

    #[test]
    fn what_only_followed_is_no_conflict_of_its_author() {
        let before = twins("Otherwise");
        let mine = edited(&before, "test", "near", "distance < 45");
        assert_eq!(without_late_followers(&before, mine.clone()), mine, "nobody was first");
        let test_only = |change: &Change| change.edits.iter().map(|edit| edit.id.to_string()).collect::<Vec<_>>();
        let mut theirs = before.clone();
        theirs.apply(&edited(&before, "other", "far", "distance >= 60"));
        let left = without_late_followers(&theirs, mine.clone());
        assert_eq!(test_only(&left), ["connector/test"], "they have one of their own");
        theirs = before.clone();
        theirs.apply(&edited(&before, "test", "near", "distance < 70"));
        let left = without_late_followers(&theirs, mine);
        assert_eq!(test_only(&left), ["connector/test"], "they edited the test, and theirs follows");
        // A person who edits both is asked about both.
        let both = edited(&before, "test", "near", "distance < 45");
        let both = both.put(&before, key(Kind::Connector, "other"), filter("far", "distance >= 50"));
        let known = both.edits.len();
        assert_eq!(without_late_followers(&theirs, both).edits.len(), known);
    }

    #[test]
    fn opposites_take_turns() {
        for (one, other) in
            [("a < 1", "a >= 1"), ("a == \"x\"", "a != \"x\""), ("a < 1 && b", "!(a < 1 && b)"), ("a.new", "!(a.new)")]
        {
            assert_eq!((opposite(one).as_str(), opposite(other).as_str()), (other, one));
        }
        assert_eq!(opposite("!(a) && !(b)"), "!(!(a) && !(b))");
        assert!(is_otherwise("Otherwise") && !is_otherwise("Otherwise far") && !is_otherwise("Other"));
    }
}
