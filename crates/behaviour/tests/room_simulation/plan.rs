//! The plan of one simulation, step by step: made from a seed, kept as JSON, edited by hand and played again.

use crate::server::Mutant;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A small seeded generator (SplitMix64).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % sides
    }
}

/// One step. Numbers that choose something are taken modulo what there is, so that any plan can be played.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Step {
    /// Time passes; with `flowing`, messages of whole links arrive meanwhile.
    Wait { ms: u64, flowing: bool },
    /// Somebody edits what they see, as `gesture` says.
    Edit { who: u64, gesture: u64 },
    /// Somebody edits with the tokens of everybody, or with their own of another server before this one.
    Forge { who: u64, gesture: u64, others: bool },
    /// Somebody takes back their last change, or does it again.
    Undo { who: u64, again: bool },
    /// Somebody opens editors of records.
    Take { who: u64, records: Vec<u64> },
    /// Somebody closes an editor.
    Release { who: u64, nth: u64 },
    /// Somebody types in an editor.
    Type { who: u64, nth: u64 },
    /// Somebody asks for a record.
    Ask { who: u64, record: u64 },
    /// Somebody who was asked answers.
    Answer { who: u64, nth: u64, yes: bool },
    /// Somebody takes over a record.
    Steal { who: u64, record: u64 },
    /// The `nth` message that waits at one of the links goes through, up to the server or down to the client.
    Pass { link: u64, up: bool, nth: u64 },
    /// Such a message is lost.
    Lose { link: u64, up: bool, nth: u64 },
    /// All messages of a client go through in order.
    Flush { who: u64 },
    /// The link of a client ends, and the server learns it with its last message.
    Cut { who: u64 },
    /// The link of a client carries nothing any more, and nobody is told.
    HalfOpen { who: u64 },
    /// A client makes its link anew.
    Connect { who: u64 },
    /// The clock of a client jumps.
    Jump { who: u64, ms: i64 },
    /// The store answers what it was asked.
    Store { fails: bool },
    /// The server dies and starts again; with `kept`, the store has what it was just asked to keep.
    Kill { kept: bool },
}

/// One simulation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Plan {
    pub(crate) seed: u64,
    /// The fault that is put in on purpose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) mutant: Option<Mutant>,
    pub(crate) people: usize,
    pub(crate) steps: Vec<Step>,
}

/// The number of steps of a plan.
const STEPS: u64 = 140;
const WAITS_MS: [u64; 8] = [20, 200, 1_000, 3_000, 6_000, 11_000, 35_000, 125_000];

impl Plan {
    /// The plan of a seed.
    pub(crate) fn of(seed: u64, mutant: Option<Mutant>) -> Self {
        let mut dice = Dice(seed.wrapping_mul(0x51_7C_C1_B7));
        let people = 2 + dice.roll(5) as usize;
        let connect = (0..people as u64).flat_map(|who| [Step::Connect { who }, Step::Flush { who }]);
        let mut steps: Vec<Step> = connect.collect();
        steps.extend((0..STEPS).map(|_| step(&mut dice)));
        if dice.roll(4) == 0 {
            steps.extend(last_edit(people as u64, &mut dice));
        }
        Self { seed, mutant, people, steps }
    }

    /// The plan in a file.
    pub(crate) fn read(path: &str) -> Self {
        let text = std::fs::read_to_string(path).expect("RRP_PLAN names a file");
        serde_json::from_str(&text).expect("the file is a plan")
    }

    /// Keeps the plan up to a step, and says where.
    pub(crate) fn save(&self, until: usize) -> PathBuf {
        let name = self.mutant.map_or_else(|| "room".to_owned(), |mutant| format!("{mutant:?}"));
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("plan-{name}-{}.json", self.seed));
        let steps = self.steps.iter().take(until.saturating_add(1)).cloned().collect();
        let text = serde_json::to_string_pretty(&Self { steps, ..self.clone() }).expect("a plan is plain data");
        std::fs::write(&path, text).expect("the folder for temporary files can be written");
        path
    }
}

fn step(dice: &mut Dice) -> Step {
    let who = dice.roll(720_720);
    match dice.roll(100) {
        0 => Step::Forge { who, gesture: dice.roll(1 << 40), others: dice.roll(2) == 0 },
        1..=17 => Step::Edit { who, gesture: dice.roll(1 << 40) },
        18..=20 => Step::Undo { who, again: dice.roll(3) == 0 },
        21..=36 => lock_step(dice, who),
        37..=55 => Step::Flush { who },
        56..=62 => Step::Pass { link: dice.roll(720_720), up: dice.roll(2) == 0, nth: dice.roll(3) },
        63..=66 => Step::Lose { link: dice.roll(720_720), up: dice.roll(2) == 0, nth: dice.roll(3) },
        67..=80 => Step::Store { fails: dice.roll(16) == 0 },
        81..=90 => Step::Wait { ms: WAITS_MS[dice.roll(8) as usize], flowing: dice.roll(5) > 0 },
        91 => Step::Cut { who },
        92 => Step::HalfOpen { who },
        93..=97 => Step::Connect { who },
        98 => Step::Jump { who, ms: dice.roll(1 << 36) as i64 - (1 << 35) },
        _ if dice.roll(3) == 0 => Step::Kill { kept: dice.roll(2) == 0 },
        _ => Step::Store { fails: false },
    }
}

/// The last edit of all, of which somebody may not hear: nothing comes after it from which they could learn that.
fn last_edit(people: u64, dice: &mut Dice) -> Vec<Step> {
    let (who, gesture) = (dice.roll(people), dice.roll(1 << 40));
    let connect = (0..people).flat_map(|who| [Step::Connect { who }, Step::Flush { who }]);
    let saved = [Step::Wait { ms: 1_000, flowing: true }, Step::Edit { who, gesture }, Step::Flush { who }];
    let lost = Step::Lose { link: dice.roll(people), up: false, nth: 0 };
    let told = [Step::Store { fails: false }, lost];
    connect.chain((0..people).map(|who| Step::Flush { who })).chain(saved).chain(told).collect()
}

fn lock_step(dice: &mut Dice, who: u64) -> Step {
    let record = dice.roll(720_720);
    match dice.roll(12) {
        0..=4 => {
            let more = (0..dice.roll(3)).map(|_| dice.roll(720_720)).collect::<Vec<_>>();
            Step::Take { who, records: [vec![record], more].concat() }
        }
        5..=6 => Step::Release { who, nth: dice.roll(4) },
        7 => Step::Type { who, nth: dice.roll(4) },
        8..=9 => Step::Ask { who, record },
        10 => Step::Answer { who, nth: dice.roll(4), yes: dice.roll(2) == 0 },
        _ => Step::Steal { who, record },
    }
}
