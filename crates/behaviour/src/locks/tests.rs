//! Tests of the locks, one sentence a test.

use super::{AskResult, Denied, Grant, Holder, LOCKED_PER_SESSION_MAX, LOCKS_PER_SESSION_MAX, LockEvent, Locks};
use super::{LockEndReason, LockToken, Presented};
use crate::{Behaviour, Change, Id, Kind, Note, Place, Record, RecordId};
use std::collections::BTreeSet;

const AIKO: u64 = 1;
const BEN: u64 = 2;
const YUKI: u64 = 3;

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

fn who(session: u64) -> Holder {
    let name = ["", "Aiko", "Ben", "Yuki"].get(session as usize).map_or_else(|| format!("P{session}"), |n| (*n).into());
    Holder { session, client: id(&format!("client{session}")), name }
}

fn note(name: &str) -> RecordId {
    RecordId::new(Kind::Note, &id(name))
}

fn set(names: &[&str]) -> BTreeSet<RecordId> {
    names.iter().map(|name| note(name)).collect()
}

fn change(names: &[&str]) -> Change {
    let text = || Record::Note(Note::new("new".into()));
    names
        .iter()
        .fold(Change::of(id("op"), "Aiko", ""), |made, name| made.put(&Behaviour::default(), note(name), text()))
}

fn with(session: u64, grant: &Grant) -> Presented {
    Presented { client: Some(who(session).client), tokens: vec![grant.token] }
}

fn held_by(name: &str, by: &str) -> Denied {
    Denied::Held { record: note(name), by: by.into() }
}

/// Aiko has a and b since the beginning.
fn aikos() -> (Locks, Grant) {
    let mut locks = Locks::new(7);
    let grant = locks.take(0, who(AIKO), set(&["a", "b"])).unwrap();
    (locks, grant)
}

fn granted(news: &[LockEvent]) -> Vec<(u64, &Grant)> {
    let grants = news.iter().filter_map(|event| match event {
        LockEvent::Granted { to, grant } => Some((to.session, grant)),
        _ => None,
    });
    grants.collect()
}

fn whys(news: &[LockEvent]) -> Vec<&LockEndReason> {
    news.iter().filter_map(|event| if let LockEvent::Freed { why, .. } = event { Some(why) } else { None }).collect()
}

#[test]
fn a_set_is_locked_as_a_whole_or_not_at_all() {
    let (mut locks, grant) = aikos();
    assert_eq!(grant.token, LockToken { epoch: 7, counter: 1 });
    assert_eq!(locks.take(1, who(BEN), set(&["c", "b"])), Err(held_by("b", "Aiko")));
    assert_eq!(locks.holder(&note("c")), None);
    assert!(locks.release(2, AIKO, grant.token));
    assert_eq!(whys(&locks.news()), [&LockEndReason::Released]);
    assert_eq!(locks.take(3, who(BEN), set(&["c", "b"])).unwrap().token.counter, 2);
}

#[test]
fn asking_twice_for_a_lock_gives_one() {
    let (mut locks, grant) = aikos();
    assert_eq!(locks.take(1, who(AIKO), set(&["a", "b"])), Ok(grant));
    assert_eq!(locks.take(1, who(AIKO), set(&["a"])), Err(held_by("a", "Aiko")), "another set is another lock");
    assert_eq!(locks.held().count(), 1);
}

#[test]
fn a_position_and_nothing_have_no_lock() {
    let mut locks = Locks::new(1);
    let place = RecordId::new(Kind::Place, &id("a"));
    assert_eq!(locks.take(0, who(AIKO), BTreeSet::from([place.clone()])), Err(Denied::NoLock));
    assert_eq!(locks.take(0, who(AIKO), BTreeSet::new()), Err(Denied::NoLock));
    let (locks, _) = aikos();
    let moved = Change::of(id("op"), "Ben", "");
    let moved = moved.put(&Behaviour::default(), place, Record::Place(Place { x: 1.0, y: 1.0 }));
    assert_eq!(locks.check(&moved, &Presented::default()), Ok(()));
}

#[test]
fn what_is_locked_takes_exactly_its_token_from_exactly_its_client() {
    let (locks, grant) = aikos();
    let edit = change(&["b"]);
    assert_eq!(locks.check(&edit, &with(AIKO, &grant)), Ok(()));
    assert_eq!(locks.check(&change(&["c"]), &Presented::default()), Ok(()), "what nobody locked is free");
    let no = Err((&edit.edits[0].id, &who(AIKO)));
    let older = Grant { token: LockToken { epoch: 6, counter: 1 }, ..grant.clone() };
    let client = Some(who(AIKO).client);
    for wrong in [with(BEN, &grant), with(AIKO, &older), Presented { client, tokens: vec![] }, Presented::default()] {
        assert_eq!(locks.check(&edit, &wrong), no, "{wrong:?}");
    }
}

#[test]
fn nobody_gives_back_or_answers_for_another() {
    let (mut locks, grant) = aikos();
    assert_eq!(locks.ask(1, who(BEN), note("a")), AskResult::Waiting { by_ms: 10_001 });
    assert!(!locks.release(2, BEN, grant.token) && !locks.touch(2, BEN, grant.token));
    assert!(!locks.say_yes(2, BEN, grant.token) && !locks.say_not_yet(2, BEN, grant.token));
    assert_eq!(locks.holder(&note("a")), Some(&who(AIKO)));
}

#[test]
fn who_does_nothing_is_warned_and_then_gives_way() {
    let (mut locks, grant) = aikos();
    assert_eq!(locks.due(), Some(90_000));
    assert!(locks.tick(89_999).is_empty());
    let warned = LockEvent::Warned { holder: who(AIKO), token: grant.token, free_ms: 120_000 };
    assert_eq!(locks.tick(90_000), [warned]);
    assert_eq!(locks.due(), Some(120_000));
    assert!(locks.touch(119_999, AIKO, grant.token));
    assert_eq!(locks.due(), Some(209_999));
    assert_eq!(whys(&locks.tick(239_999)), [&LockEndReason::Idle], "the warning came late, the end does not");
    assert_eq!(locks.due(), None);
}

#[test]
fn a_lock_waits_a_moment_for_a_client_whose_link_ended() {
    let (mut locks, grant) = aikos();
    locks.leave(5_000, AIKO);
    assert_eq!(locks.news(), [LockEvent::KeptFor { holder: who(AIKO), token: grant.token, until_ms: 15_000 }]);
    assert!(locks.return_to(6_000, &who(BEN).client, 9).is_empty());
    assert_eq!(locks.return_to(14_999, &who(AIKO).client, 11), std::slice::from_ref(&grant));
    assert_eq!(locks.check(&change(&["a"]), &with(AIKO, &grant)), Ok(()), "by whichever of its links");
    assert!(!locks.release(15_000, AIKO, grant.token), "the old link is void");
    locks.leave(20_000, 11);
    assert_eq!(locks.due(), Some(30_000));
    assert!(locks.return_to(30_000, &who(AIKO).client, 12).is_empty());
    assert_eq!(whys(&locks.news()), [&LockEndReason::Left]);
}

#[test]
fn silence_means_yes_and_the_old_token_is_void() {
    let (mut locks, grant) = aikos();
    assert_eq!(locks.ask(1_000, who(BEN), note("a")), AskResult::Waiting { by_ms: 11_000 });
    assert_eq!(locks.ask(2_000, who(BEN), note("a")), AskResult::Waiting { by_ms: 11_000 });
    assert_eq!(locks.news().len(), 1);
    let news = locks.tick(11_000);
    assert_eq!(whys(&news), [&LockEndReason::HandedOver { to: "Ben".into() }]);
    let [(BEN, theirs)] = granted(&news)[..] else { panic!("{news:?}") };
    assert_eq!((theirs.token.counter, &theirs.records), (2, &set(&["a"])));
    assert!(locks.check(&change(&["a"]), &with(AIKO, &grant)).is_err());
    assert_eq!(locks.holder(&note("b")), None, "a lock ends as a whole");
}

#[test]
fn a_new_name_is_told_of_what_somebody_holds_and_asks_for() {
    let (mut locks, _) = aikos();
    locks.ask(1_000, who(BEN), note("a"));
    locks.rename(&who(AIKO).client, "Airi");
    locks.rename(&who(BEN).client, "Benedikt");
    assert_eq!(locks.take(2_000, who(YUKI), set(&["b"])), Err(held_by("b", "Airi")));
    assert_eq!(whys(&locks.tick(11_000)), [&LockEndReason::HandedOver { to: "Benedikt".into() }]);
}

#[test]
fn typing_means_not_yet_for_a_minute() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(BEN), note("a"));
    for at in (1_000..60_000).step_by(1_000) {
        assert!(locks.touch(at, AIKO, grant.token), "{at}");
    }
    assert_eq!(locks.holder(&note("a")), Some(&who(AIKO)));
    let postponed = locks.news().into_iter().filter(|event| matches!(event, LockEvent::Postponed { .. })).count();
    assert_eq!(postponed, 50, "until the end of the minute");
    assert_eq!(granted(&locks.tick(60_000)).len(), 1);
}

#[test]
fn who_hears_not_yet_asks_again_later_and_the_next_is_heard() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(BEN), note("a"));
    assert_eq!(locks.ask(1_000, who(YUKI), note("b")), AskResult::Queued { before: 1 });
    locks.news();
    assert!(locks.say_not_yet(2_000, AIKO, grant.token));
    let news = locks.news();
    assert!(matches!(&news[0], LockEvent::NotYet { to, again_ms: 32_000, .. } if *to == who(BEN)), "{news:?}");
    assert!(matches!(&news[1], LockEvent::Asked { asker, by_ms: 12_000, .. } if *asker == who(YUKI)), "{news:?}");
    assert_eq!(locks.ask(3_000, who(BEN), note("a")), AskResult::TooSoon { again_ms: 32_000 });
    assert!(locks.say_yes(4_000, AIKO, grant.token));
    assert_eq!(granted(&locks.news())[0].0, YUKI);
    assert_eq!(locks.ask(5_000, who(BEN), note("a")), AskResult::Free, "what is free need not be asked for");
}

#[test]
fn not_yet_counts_for_a_minute_in_all() {
    let (mut locks, grant) = aikos();
    let asked = |news: Vec<LockEvent>| {
        let lasts = news.into_iter().filter_map(|event| match event {
            LockEvent::Asked { by_ms, last, .. } => Some((by_ms, last)),
            _ => None,
        });
        lasts.collect::<Vec<_>>()
    };
    for (at, last) in [(0, false), (31_000, false), (62_000, true)] {
        assert_eq!(locks.ask(at, who(BEN), note("a")), AskResult::Waiting { by_ms: at + 10_000 });
        assert_eq!(asked(locks.news()), [(at + 10_000, last)]);
        assert_eq!(locks.say_not_yet(at + 1_000, AIKO, grant.token), !last, "{at}");
    }
    assert!(locks.touch(65_000, AIKO, grant.token), "typing counts no more either");
    assert_eq!((locks.news(), locks.holder(&note("a"))), (vec![], Some(&who(AIKO))));
    assert_eq!(granted(&locks.tick(72_000)).len(), 1);
    assert_eq!(locks.ask(73_000, who(AIKO), note("a")), AskResult::Waiting { by_ms: 83_000 });
    assert_eq!(asked(locks.news()), [(83_000, false)], "of Ben it is asked for the first time");
}

#[test]
fn another_asker_and_one_who_asks_much_later_begin_anew() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(BEN), note("a"));
    locks.say_not_yet(1, AIKO, grant.token);
    for (at, asker) in [(60_000, YUKI), (91_001, BEN)] {
        locks.touch(at, AIKO, grant.token);
        locks.news();
        locks.ask(at, who(asker), note("a"));
        assert!(matches!(locks.news()[..], [LockEvent::Asked { last: false, .. }]), "{asker}");
        assert!(locks.say_not_yet(at + 1, AIKO, grant.token));
    }
}

#[test]
fn who_asked_may_withdraw_and_the_holder_hears_of_it() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(BEN), note("a"));
    locks.ask(1, who(YUKI), note("b"));
    locks.news();
    assert!(!locks.withdraw(2, BEN, &note("b")) && !locks.withdraw(2, 4, &note("a")), "only what one asked for");
    assert!(locks.withdraw(2, BEN, &note("a")) && !locks.withdraw(2, BEN, &note("a")));
    let withdrawn = LockEvent::Withdrawn { holder: who(AIKO), token: grant.token, asker: who(BEN) };
    let (holder, asker) = (who(AIKO), who(YUKI));
    let next = LockEvent::Asked { holder, token: grant.token, asker, record: note("b"), by_ms: 10_002, last: false };
    assert_eq!(locks.news(), [withdrawn, next]);
    locks.leave(3, YUKI);
    let gone = LockEvent::Withdrawn { holder: who(AIKO), token: grant.token, asker: who(YUKI) };
    assert_eq!(locks.news(), [gone], "who goes asks no more");
    assert_eq!(whys(&locks.tick(20_000)), Vec::<&LockEndReason>::new());
}

#[test]
fn the_version_says_whether_who_holds_what_changed() {
    let (mut locks, grant) = aikos();
    let mut steps: Vec<(&str, bool)> = Vec::new();
    let mut version = locks.version();
    let mut step = |locks: &Locks, what: &'static str| {
        steps.push((what, locks.version() != version));
        version = locks.version();
    };
    locks.begin_saving(1, &change(&["b"]), &with(AIKO, &grant));
    locks.saved(2, &id("op"));
    locks.touch(3, AIKO, grant.token);
    locks.ask(4, who(BEN), note("a"));
    locks.say_not_yet(5, AIKO, grant.token);
    step(&locks, "nothing");
    let _taken = locks.take(6, who(BEN), set(&["c"]));
    step(&locks, "taken");
    locks.leave(7, AIKO);
    step(&locks, "kept");
    locks.return_to(8, &who(AIKO).client, 9);
    step(&locks, "returned");
    locks.release(9, BEN, LockToken { epoch: 7, counter: 2 });
    step(&locks, "released");
    assert_eq!(steps.iter().map(|(_, changed)| *changed).collect::<Vec<_>>(), [false, true, true, true, true]);
}

#[test]
fn who_waits_gets_what_is_given_back_in_turn() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(BEN), note("a"));
    locks.ask(0, who(YUKI), note("a"));
    locks.ask(0, who(4), note("b"));
    locks.ask(0, who(5), note("b"));
    assert_eq!(locks.ask(0, who(6), note("a")), AskResult::Full);
    locks.leave(1, 5);
    locks.release(2, AIKO, grant.token);
    let sessions: Vec<u64> = granted(&locks.news()).iter().map(|(session, _)| *session).collect();
    assert_eq!(sessions, [BEN, 4]);
    assert_eq!(locks.ask(3, who(YUKI), note("a")), AskResult::Waiting { by_ms: 10_002 }, "of Ben now");
}

#[test]
fn an_admin_may_take_it() {
    let (mut locks, grant) = aikos();
    locks.ask(0, who(YUKI), note("a"));
    let taken = locks.take_over(5, who(BEN), note("a")).unwrap();
    assert_eq!(whys(&locks.news()), [&LockEndReason::TakenOver { by: "Ben".into() }]);
    assert!(locks.check(&change(&["a"]), &with(AIKO, &grant)).is_err());
    assert_eq!(locks.check(&change(&["a"]), &with(BEN, &taken)), Ok(()));
    assert_eq!(locks.ask(6, who(YUKI), note("a")), AskResult::Waiting { by_ms: 10_005 });
}

#[test]
fn nobody_gets_what_is_being_saved() {
    let (mut locks, grant) = aikos();
    locks.begin_saving(1_000, &change(&["b", "c"]), &with(AIKO, &grant));
    assert_eq!(locks.take(1_001, who(BEN), set(&["c"])), Err(held_by("c", "Aiko")), "not even locked, but saved");
    assert_eq!(locks.take_over(1_001, who(BEN), note("b")), Err(held_by("b", "Aiko")));
    locks.ask(1_001, who(BEN), note("b"));
    assert!(locks.say_yes(1_002, AIKO, grant.token) && locks.release(1_003, AIKO, grant.token));
    assert_eq!((locks.due(), granted(&locks.tick(500_000)).len()), (None, 0));
    locks.saved(500_001, &id("op"));
    assert_eq!(granted(&locks.news())[0].0, BEN);
    assert!(locks.take(500_002, who(YUKI), set(&["c"])).is_ok());
}

#[test]
fn who_opens_again_what_is_still_being_saved_has_it() {
    let (mut locks, grant) = aikos();
    locks.begin_saving(1_000, &change(&["b"]), &with(AIKO, &grant));
    locks.release(1_001, AIKO, grant.token);
    assert_eq!(locks.take(1_002, who(AIKO), set(&["a", "b"])).as_ref(), Ok(&grant));
    locks.saved(1_003, &id("op"));
    assert!(locks.news().is_empty() && locks.holder(&note("a")) == Some(&who(AIKO)));
}

#[test]
fn everything_has_a_limit() {
    let mut locks = Locks::new(1);
    let many: Vec<String> = (0..=LOCKED_PER_SESSION_MAX).map(|number| format!("n{number}")).collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    assert_eq!(locks.take(0, who(AIKO), set(&many)), Err(Denied::TooMany));
    assert!(locks.take(0, who(AIKO), set(&many[1..])).is_ok());
    for name in ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p"] {
        assert!(locks.take(0, who(BEN), set(&[name])).is_ok());
    }
    assert_eq!((locks.take(0, who(BEN), set(&["q"])), LOCKS_PER_SESSION_MAX), (Err(Denied::TooMany), 16));
    let full = (10..40).find(|session| {
        let names: Vec<String> = (0..LOCKED_PER_SESSION_MAX).map(|number| format!("s{session}-{number}")).collect();
        locks.take(0, who(*session), names.iter().map(|name| note(name)).collect()) == Err(Denied::TooMany)
    });
    assert_eq!(full, Some(24), "1,024 records in all");
}

#[test]
fn a_clock_that_goes_back_changes_nothing() {
    let (mut locks, grant) = aikos();
    locks.tick(50_000);
    locks.touch(1_000, AIKO, grant.token);
    assert_eq!(locks.due(), Some(140_000));
}
