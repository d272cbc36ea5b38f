//! Every exercise is missed as it begins and reached by its solution.

use super::{ExerciseStart, exercise, exercises, rehearse};
use crate::rooms::knowledge::Knowing;
use behaviour::{BehaviourFile, Helper};
use phrase::Phrase;
use protocol::RehearsalResult;
use std::path::Path;
use tokio_util::sync::CancellationToken;

fn tried(file: &BehaviourFile, exercise: &ExerciseStart) -> RehearsalResult {
    let right: Vec<u8> = exercise.goal().asks.iter().map(|question| question.right).collect();
    answered(file, exercise, &right)
}

fn answered(file: &BehaviourFile, exercise: &ExerciseStart, answers: &[u8]) -> RehearsalResult {
    rehearse(file, &exercise.goal(), answers, &CancellationToken::new())
}

/// A file beside the exercises.
fn beside(name: &str) -> BehaviourFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/exercises").join(name);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn missed(says: impl Into<Phrase>) -> RehearsalResult {
    RehearsalResult::Missed { says: says.into(), fault: None }
}

fn ends(says: &Phrase, with: char) -> bool {
    says.to_string().ends_with(with)
}

#[test]
fn no_start_reaches_its_goal_and_every_solution_does() {
    let starts = [
        ("only_close", missed("The head also follows the far ball.")),
        ("brighter_when_nearer", missed("The eyes stay dark while the ball is close.")),
        ("far_and_close", RehearsalResult::Empty),
    ];
    let changed = exercises().iter().filter(|exercise| exercise.goal().asks.is_empty());
    assert_eq!(starts.len(), changed.clone().count());
    for ((name, says), exercise) in starts.into_iter().zip(changed) {
        assert_eq!(beside(&format!("{name}.json")), exercise.template.file());
        assert_eq!(tried(&exercise.template.file(), exercise), says, "{name}");
        let solved = tried(&beside(&format!("{name}.solution.json")), exercise);
        assert_eq!(solved, RehearsalResult::Reached(exercise.goal().reached), "{name}");
    }
}

/// What is to be explained does already what its right answers say; every other answer is told what to look at.
#[test]
fn what_is_explained_is_reached_by_the_right_answers_only() {
    let mut asked = 0;
    for exercise in exercises().iter().filter(|exercise| !exercise.goal().asks.is_empty()) {
        let (file, goal) = (exercise.template.file(), exercise.goal());
        let right: Vec<u8> = goal.asks.iter().map(|question| question.right).collect();
        assert_eq!(answered(&file, exercise, &right), RehearsalResult::Reached(goal.reached.clone()), "{}", file.name);
        assert_eq!(answered(&file, exercise, &[]), missed(&goal.asks[0].otherwise));
        for (at, question) in goal.asks.iter().enumerate() {
            asked += 1;
            assert!(ends(&question.ask, '?') && ends(&question.otherwise, '.'));
            for other in (0..=question.answers.len()).filter(|other| *other != usize::from(question.right)) {
                let mut answers = right.clone();
                answers[at] = u8::try_from(other).unwrap();
                assert_eq!(answered(&file, exercise, &answers), missed(&question.otherwise), "{}", question.ask);
            }
            assert!(question.answers.get(usize::from(question.right)).is_some());
        }
        let mut changed = file.clone();
        changed.connectors.clear();
        assert!(matches!(answered(&changed, exercise, &right), RehearsalResult::Missed { .. }), "{}", file.name);
    }
    assert_eq!(asked, 4);
}

#[test]
fn every_expectation_is_about_a_part_and_says_something() {
    for exercise in exercises() {
        let goal = exercise.goal();
        assert!(ends(&goal.says, '.') && ends(&goal.reached, '.'));
        assert!(goal.trace.iter().all(|part| part.every_ms >= 20 && part.for_ms > 1_000 && !part.values.is_empty()));
        assert!(goal.ends().0 <= 60_000);
        for one in &goal.expects {
            assert!(goal.trace.iter().any(|part| part.name == one.during), "{}", one.otherwise);
            assert!(robot::device(behaviour::StreamKind::Actuator, &one.action).is_ok(), "{}", one.action);
            assert!(ends(&one.otherwise, '.'));
        }
        assert!(exercise.template.says.ends_with(['.', '?']));
        assert_eq!(exercise.template.file().name, exercise.template.name);
        assert_eq!(exercise.told().goal, goal.says);
    }
    assert!(exercise("Brighter when nearer").is_some() && exercise("another").is_none());
}

#[test]
fn every_start_can_be_opened_and_uses_shipped_helpers() {
    for exercise in exercises() {
        let file = exercise.template.file();
        let (records, library) = (file.records(|_| None).unwrap(), file.library());
        let helpers: Vec<&Helper> = library.iter().collect();
        let found = behaviour::problems(&records, &helpers, &Knowing::default());
        assert!(found.iter().all(|problem| !problem.blocks), "{}: {found:?}", exercise.template.name);
        assert!(library.iter().all(|helper| robot::shipped_helpers().contains(helper)));
    }
}

/// On the way to the solution, what is said names what is still missing.
#[test]
fn half_a_solution_is_told_what_it_lacks() {
    let exercise = exercise("Follow far and close balls").unwrap();
    let whole = beside("far_and_close.solution.json");
    let without = |connector: &str| {
        let mut file = whole.clone();
        file.connectors.retain(|one| one.id != connector);
        tried(&file, exercise)
    };
    assert_eq!(without("c3"), missed("Nothing follows the far ball."));
    assert_eq!(without("c5"), missed("Nothing follows the close ball."));
    let mut turned = whole.clone();
    turned.connectors[1].body = Some("distance < 0.5".into());
    turned.connectors[3].body = Some("distance >= 0.5".into());
    assert_eq!(tried(&turned, exercise), missed("The body also follows the far ball."));
    let mut other = whole;
    other.connectors[1].body = Some("distance.nothing > 1".into());
    let RehearsalResult::Missed { says, fault: Some(_) } = tried(&other, exercise) else { panic!() };
    assert_eq!(says, "Nothing follows the far ball.");
}

#[test]
fn what_cannot_run_or_takes_too_long_says_so() {
    let exercise = exercise("Follow only a close ball").unwrap();
    let mut file = exercise.template.file();
    file.connectors[0].helper = Some("gone".into());
    assert!(matches!(tried(&file, exercise), RehearsalResult::CannotRun(_)));
    let gone = CancellationToken::new();
    gone.cancel();
    assert_eq!(rehearse(&exercise.template.file(), &exercise.goal(), &[], &gone), RehearsalResult::TooLong);
}
