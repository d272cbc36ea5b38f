//! Sentences of the other rooms reach the page as data, and have their Japanese.

use super::complete_tests::{folder, read};
use super::language::{shown, speak};
use behaviour::{Refusal, ValueType};
use phrase::phrase;
use protocol::Refused;

#[test]
fn a_refusal_within_a_refusal_is_said_in_japanese() {
    speak(read(&folder().join("../static/ja.txt")));
    let locked = Refusal::Locked { what: phrase!("this.note", "this note"), by: "start".to_owned() };
    let said = shown(&Refused::Change(locked));
    assert!(said.starts_with("start さんがこのメモを編集中です"), "{said}");
    let said = shown(&Refused::CannotStart(phrase!("StartError.Silent", "the robot does not answer")));
    assert!(said.starts_with("開始できません：") && !said.contains("robot"), "{said}");
    let kinds = ValueType::record([("x", ValueType::Truth)]);
    assert!(!shown(&kinds).contains("an object"), "{}", shown(&kinds));
}

#[test]
fn words_of_a_robot_stay_as_it_said_them() {
    speak(read(&folder().join("../static/ja.txt")));
    let said = shown(&Refused::RobotCannot("Start".into()));
    assert!(said.contains("：Start。"), "{said}");
}
