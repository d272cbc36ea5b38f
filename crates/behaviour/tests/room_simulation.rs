//! Many people edit one behaviour over a slow and lossy link, for many seeds: nothing is lost, doubled or unruly.

use behaviour::{
    Behaviour, Change, Committed, Connector, Decision, Graph, Id, Kind, Knowledge, Params, Place, Procedure, Record,
    RecordId, Room, Settings, Stream, StreamKind, connectors,
};
use std::collections::{BTreeMap, VecDeque};

struct Anything;
impl Knowledge for Anything {
    fn device(&self, _: StreamKind, _: &str, _: &Params) -> Result<(), String> {
        Ok(())
    }
    fn body(&self, _: &[String], _: &str) -> Result<(), String> {
        Ok(())
    }
}

/// A small seeded generator (SplitMix64).
struct Dice(u64);
impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % sides
    }
}

#[derive(Default)]
struct Person {
    seen: Behaviour,
    revision: u64,
    inbox: VecDeque<Committed>,
    waiting: Option<Change>,
}

struct Town {
    room: Room,
    disk: Vec<Committed>,
    people: Vec<Person>,
    answered: BTreeMap<Id, u64>,
    ops: u64,
    restarted: bool,
}

fn id(text: String) -> Id {
    Id::new(&text).expect("a short id")
}

fn stream(kind: StreamKind, name: String) -> Record {
    let device = (kind != StreamKind::Ordinary).then(|| "RedBall".to_owned());
    Record::Stream(Stream {
        kind,
        name,
        device,
        params: Params::new(),
        order: 0,
        resources: None,
        priority: None,
        hold_ms: None,
    })
}

impl Town {
    fn new() -> Self {
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(RecordId::settings(), Record::Settings(Settings::named("Town")));
        let person = || Person { seen: behaviour.clone(), ..Person::default() };
        let people = (0..3).map(|_| person()).collect();
        Self {
            room: Room::open(behaviour, 0),
            disk: Vec::new(),
            people,
            answered: BTreeMap::new(),
            ops: 0,
            restarted: false,
        }
    }

    fn gesture(&mut self, who: usize, dice: &mut Dice) -> Change {
        self.ops += 1;
        let seen = &self.people[who].seen;
        let change = Change::of(id(format!("op{}", self.ops)), "somebody", "gesture");
        let name = |dice: &mut Dice| format!("s{}", dice.roll(8));
        let key = |kind, name: &str| RecordId::new(kind, &id(name.to_owned()));
        let some = name(dice);
        match dice.roll(5) {
            0 => {
                let kind = [StreamKind::Sensor, StreamKind::Ordinary, StreamKind::Actuator][dice.roll(3) as usize];
                change.put(seen, key(Kind::Stream, &some), stream(kind, format!("N{}", dice.roll(9))))
            }
            1 => change.take(seen, key(Kind::Stream, &some)),
            2 => change.put(seen, key(Kind::Place, &some), Record::Place(Place { x: dice.roll(9) as f64, y: 0.0 })),
            3 => {
                let operation = if dice.roll(3) == 0 {
                    connectors::subscribe::SPEC.with(())
                } else {
                    connectors::map::SPEC.with(Procedure::body("1"))
                };
                let inputs = vec![id(name(dice))];
                let connector = Connector { operation, inputs, output: id(name(dice)), order: 0 };
                change.put(seen, key(Kind::Connector, &format!("c{}", dice.roll(6))), Record::Connector(connector))
            }
            _ => change.take(seen, key(Kind::Connector, &format!("c{}", dice.roll(6)))),
        }
    }

    fn send(&mut self, who: usize, change: Change) {
        match self.room.propose(0, change.clone(), &Anything) {
            // The room forgets with a restart; the store, asked before anything is saved or refused, does not.
            Decision::Save(_) | Decision::Refuse(_) if self.restarted && self.answered.contains_key(&change.op) => {}
            Decision::Save(committed) => {
                self.disk.push(committed.clone());
                self.room.commit(&committed);
                self.answered.insert(committed.change.op.clone(), committed.revision);
                self.people.iter_mut().for_each(|person| person.inbox.push_back(committed.clone()));
            }
            Decision::Duplicate(revision) => assert_eq!(self.answered[&change.op], revision),
            Decision::Refuse(_) => {
                assert!(!self.answered.contains_key(&change.op), "an accepted change is never refused")
            }
        }
        self.people[who].waiting = Some(change);
    }

    fn restart(&mut self) {
        self.room = Room::open(replay(&self.disk), self.room.revision());
        self.restarted = true;
    }

    fn step(&mut self, dice: &mut Dice) {
        let who = dice.roll(self.people.len() as u64) as usize;
        match dice.roll(4) {
            0 => {
                let change = self.gesture(who, dice);
                self.send(who, change);
            }
            1 => {
                if let Some(again) = self.people[who].waiting.clone() {
                    self.send(who, again);
                }
            }
            2 if dice.roll(20) == 0 => self.restart(),
            _ => self.people[who].hear(),
        }
    }
}

impl Person {
    fn hear(&mut self) {
        if let Some(next) = self.inbox.pop_front() {
            assert_eq!(next.revision, self.revision + 1, "no gap, never back");
            self.seen.apply(&next.change);
            self.revision = next.revision;
        }
    }
}

fn replay(disk: &[Committed]) -> Behaviour {
    let mut behaviour = Town::new().room.behaviour().clone();
    disk.iter().for_each(|committed| behaviour.apply(&committed.change));
    behaviour
}

fn assert_rules_hold(behaviour: &Behaviour) {
    let graph = Graph::of(behaviour);
    assert!(graph.cycle().is_none());
    for (id, stream) in behaviour.streams() {
        let into = graph.into_stream(id).len();
        let fits = match stream.kind {
            StreamKind::Sensor => into == 0,
            StreamKind::Ordinary => into <= 1,
            StreamKind::Actuator => graph.out_of_stream(id).is_empty(),
        };
        assert!(fits, "{} {into}", stream.name);
    }
    for (_, connector) in behaviour.connectors() {
        assert!(behaviour.stream(&connector.output).is_some());
        assert!(connector.inputs.iter().all(|input| behaviour.stream(input).is_some()));
    }
}

#[test]
fn everyone_ends_up_with_the_same_and_the_rules_hold() {
    let mut accepted = 0;
    for seed in 0..300 {
        let (mut town, mut dice) = (Town::new(), Dice(seed));
        for _ in 0..200 {
            town.step(&mut dice);
            assert_rules_hold(town.room.behaviour());
        }
        for person in &mut town.people {
            while !person.inbox.is_empty() {
                person.hear();
            }
            assert_eq!(&person.seen, town.room.behaviour(), "seed {seed}");
        }
        assert_eq!(&replay(&town.disk), town.room.behaviour(), "seed {seed}");
        accepted += town.disk.len();
    }
    assert!(accepted > 3_000, "the gestures reach deep enough: {accepted}");
}
