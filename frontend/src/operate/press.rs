//! Pressing a tile, and what becomes of it. What cannot be sent now is never sent later: a robot must not begin to move when a
//! lost link comes back.

use super::OperateShared;
use super::pad::{PadTile, TileWork};
use super::seen::SeenPress;
use crate::browser;
use crate::desk::LinkState;
use crate::desk::shown_pad::speaks;
use crate::link::NoAnswer;
use crate::operate::words;
use crate::parts::may_operate;
use behaviour::{Id, Value};
use leptos::prelude::*;
use protocol::{Press, request};
use robot::Health;

/// A tile rests so long after its press, in milliseconds.
const RESTS_MS: f64 = 400.0;
/// The time for which it is said who else pressed, and that something was pretended, in milliseconds.
const OTHER_MS: f64 = 3_000.0;
const PRETENDED_MS: f64 = 900.0;
/// The time for which it is said why something was not done, in milliseconds.
const WHY_MS: f64 = 8_000.0;
/// About how long a gesture takes, and a letter that is spoken; what a robot tells of itself counts more, in milliseconds.
const GESTURE_MS: f64 = 3_000.0;
const LETTER_MS: f64 = 75.0;
const SPEECH_MIN_MS: f64 = 900.0;
/// The time in which a second press says yes to a tile that asks, in milliseconds; silence is no.
const ASKS_MS: f64 = 2_000.0;

/// The newest press of a tile.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PressedTile {
    does: TileWork,
    at: f64,
    /// The person, if it was somebody else.
    by: Option<Id>,
    name: String,
    became: Became,
}

/// The outcome of a press.
#[derive(Clone, Debug, PartialEq)]
enum Became {
    /// It asks until then, by this computer's clock: another press says yes, while it is the same robot and nobody pressed Stop.
    Asks { until: f64, about: AskedAbout },
    /// The answer is not here yet.
    Asked,
    /// It was done: it goes on until then, by this computer's clock.
    Done { from: f64, until: f64 },
    /// With the reason.
    Not(String),
}

/// The newest Stop that was heard of, and the robot that is looked at, when a tile asked.
type AskedAbout = (Option<u64>, Option<Id>);

/// The states that a tile shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TileState {
    /// It can be pressed.
    Ready,
    /// It goes on: what is said of it, and how far it is, from 0 to 100.
    Going(&'static str, u8),
    /// It waits until another one is over.
    Next,
    /// It asks, and how much of the time for an answer is over, from 0 to 100.
    Asks(u8),
    /// It was not done; with the reason.
    Refused(String),
    /// It cannot be done now; with the reason.
    Cannot(String),
    /// Somebody else pressed it just now.
    By(Id, String),
    /// The span of the tile goes on, since so many milliseconds.
    On(f64),
}

impl OperateShared {
    /// Why none of the tiles that act can be pressed, as the link is. Reactive.
    pub(super) fn rests(self) -> bool {
        let desk = self.desk.desk();
        desk.online.get() != LinkState::Online || desk.unheard.read().is_some()
    }

    /// Why a tile cannot be pressed. Reactive.
    pub(super) fn cannot(self, does: &TileWork) -> Option<String> {
        let desk = self.desk.desk();
        if let Some(why) = desk.may_not(protocol::Role::Operator) {
            return Some(why.to_owned());
        }
        if let TileWork::Word { .. } = does {
            return self.run().is_none().then(|| words::marks_begin_with_run().to_owned());
        }
        if self.rests() {
            return Some(words::until_link_is_back().to_owned());
        }
        if matches!(desk.robots.health(), Health::Lost(_) | Health::Connecting | Health::Stranger(_)) {
            return Some(words::robot_not_there().to_owned());
        }
        match does {
            TileWork::Hand { device, .. } => {
                let chosen = desk.robots.chosen.read();
                let lacks = chosen.as_ref()?.lacking.iter().find(|lacking| lacking.device == *device)?;
                Some(words::shown(&lacks.why))
            }
            TileWork::Pretend { stream, .. } if desk.document.stream(stream).is_none() => {
                Some(words::its_sense_is_gone().to_owned())
            }
            _ => self.run().is_none().then(|| words::only_while_it_runs().to_owned()),
        }
    }

    /// Presses the tile with this number, from 1, at this moment by this computer's clock; whether there is one that can be
    /// pressed. Not reactive.
    pub(super) fn press(self, number: usize, now: f64) -> bool {
        let tile = self.pad.with_untracked(|pad| pad.iter().find(|tile| tile.key == number).cloned());
        let Some(tile) = tile else { return false };
        if let Some(why) = untrack(|| self.cannot(&tile.does)) {
            self.whisper(&words::titled(&tile.label, &why));
            return true;
        }
        let mine = |pressed: &&PressedTile| pressed.does == tile.does && pressed.by.is_none();
        let before = self.presses.with_untracked(|all| all.iter().find(mine).cloned());
        let about = (crate::link::stops(), self.desk.desk().robots.chosen_id());
        let became = match press_counts(before.as_ref(), tile.asks, &about, now) {
            PressCounts::Not => return true,
            PressCounts::Asks => Became::Asks { until: now + ASKS_MS, about },
            PressCounts::Yes => match tile.does {
                // A mark is there at once, whatever the link does.
                TileWork::Word { .. } => Became::Done { from: now, until: now + PRETENDED_MS },
                TileWork::Hand { .. } | TileWork::Pretend { .. } => Became::Asked,
            },
        };
        let asks = matches!(became, Became::Asks { .. });
        self.put(PressedTile { does: tile.does.clone(), at: now, by: None, name: String::new(), became });
        match tile.does {
            _ if asks => self.whisper(&words::asks_for_yes(&tile.label, number)),
            TileWork::Word { ref word, span } => self.mark_word(word, span, now),
            _ => self.ask(tile, now),
        }
        true
    }

    /// Says no to what this tile asks, or to all that is asked; whether something was. Not reactive.
    pub(super) fn say_no(self, of: Option<&TileWork>) -> bool {
        let is_it = |pressed: &PressedTile| {
            matches!(pressed.became, Became::Asks { until, .. } if browser::today_ms() < until)
                && of.is_none_or(|does| *does == pressed.does)
        };
        let some = self.presses.with_untracked(|all| all.iter().any(is_it));
        if some {
            self.presses.update(|all| all.retain(|pressed| !is_it(pressed)));
            self.whisper(words::not_done());
        }
        some
    }

    fn ask(self, tile: PadTile, at: f64) {
        let desk = self.desk.desk();
        let (robot, open) = (desk.robots.chosen_id(), desk.document.open.get_untracked());
        let does = tile.does.clone();
        let then: Box<dyn FnOnce(Result<(), NoAnswer>)> = Box::new(move |answer| {
            let became = match answer {
                Ok(()) => self.done(&tile.does),
                Err(NoAnswer::Refused(no)) => Became::Not(words::told_by(&no)),
                Err(NoAnswer::Unreachable) => Became::Not(words::not_known_if_done().to_owned()),
            };
            if let Became::Not(why) = &became {
                self.whisper(&words::titled(&tile.label, why));
            }
            self.put(PressedTile { does: tile.does, at, by: None, name: String::new(), became });
        });
        match (does, open) {
            (TileWork::Hand { device, params, value }, _) => {
                desk.look_up(request::Hand { robot, device, params, value }, then);
            }
            (TileWork::Pretend { stream, value }, Some(behaviour)) => {
                desk.look_up(request::Stimulate { behaviour, robot, stream, value }, then);
            }
            _ => {}
        }
    }

    /// It was done: it begins now, or after what uses the same part of the robot.
    fn done(self, does: &TileWork) -> Became {
        let now = browser::today_ms();
        let lasts = lasts_ms(does);
        let busy = |pressed: &PressedTile| match pressed.became {
            Became::Done { until, .. } if same_part(&pressed.does, does) => Some(until),
            _ => None,
        };
        let from = self.presses.with_untracked(|all| all.iter().filter_map(busy).fold(now, f64::max));
        Became::Done { from, until: from + lasts }
    }

    /// Keeps the newest press of its tile.
    fn put(self, pressed: PressedTile) {
        self.presses.try_update(|all| {
            all.retain(|known| known.does != pressed.does);
            all.push(pressed);
        });
    }

    /// Somebody pressed something, maybe oneself.
    pub(super) fn hear_press(self, press: &Press) {
        let desk = self.desk.desk();
        let here = desk.robots.chosen_id();
        if press.robot.is_some() && press.robot != here {
            return;
        }
        let now = browser::today_ms();
        self.saw(SeenPress { at: now, client: press.client.clone(), by: press.by.clone(), done: press.why.is_none() });
        let mine = desk.me.with_untracked(|me| me.as_ref().is_some_and(|me| me.client == press.client));
        let tile = self.pad.with_untracked(|pad| pad.iter().find(|tile| tile.does.is_of(press)).cloned());
        let Some(tile) = tile.filter(|_| !mine && press.why.is_none()) else { return };
        let became = self.done(&tile.does);
        self.whisper(&words::titled(&tile.label, &words::just_now(&press.by)));
        self.put(PressedTile {
            does: tile.does,
            at: now,
            by: Some(press.client.clone()),
            name: press.by.clone(),
            became,
        });
    }

    /// Returns what a tile shows now. Reactive.
    pub(super) fn shows(self, tile: &PadTile) -> TileState {
        if let (TileWork::Word { word, span: true }, None) =
            (&tile.does, self.desk.desk().may_not(protocol::Role::Operator))
            && let Some(since) = self.span_since(word)
        {
            return TileState::On(self.now.get() - since);
        }
        if let Some(why) = self.cannot(&tile.does) {
            return TileState::Cannot(why);
        }
        // A press shows at once; that it is over, with the next tick.
        let now = self.now.get().max(browser::today_ms());
        let pressed = self.presses.with(|all| all.iter().find(|known| known.does == tile.does).cloned());
        let Some(pressed) = pressed else { return TileState::Ready };
        match pressed.became {
            _ if pressed.by.is_some() && now - pressed.at < OTHER_MS => {
                TileState::By(pressed.by.unwrap_or_else(crate::desk::new_id), pressed.name)
            }
            Became::Asks { until, .. } if now < until => TileState::Asks(share(until - ASKS_MS, until, now)),
            Became::Asked => TileState::Going(words::sent_just_now(), 0),
            Became::Not(why) if now - pressed.at < WHY_MS => TileState::Refused(why),
            Became::Done { from, .. } if now < from => TileState::Next,
            Became::Done { from, until } if now < until => {
                TileState::Going(going_words(&tile.does), share(from, until, now))
            }
            Became::Asks { .. } | Became::Done { .. } | Became::Not(_) => TileState::Ready,
        }
    }

    /// Says something to who does not see the page.
    pub(super) fn whisper(self, text: &str) {
        self.desk.desk().whisper.set(text.to_owned());
    }

    /// True if this person may press. Reactive.
    pub(super) fn may(self) -> bool {
        may_operate(self.desk)
    }
}

/// The meaning of a press.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PressCounts {
    /// The tile rests: the second tap of two is none.
    Not,
    /// It asks first.
    Asks,
    /// It does it.
    Yes,
}

/// The meaning of a press now, after one's own last press of the same tile. A question from before a Stop, or about another robot, is
/// none any more. Pure.
fn press_counts(before: Option<&PressedTile>, asks: bool, about: &AskedAbout, now: f64) -> PressCounts {
    let rests = before.is_some_and(|before| (0.0..RESTS_MS).contains(&(now - before.at)));
    let is_open =
        |became: &Became| matches!(became, Became::Asks { until, about: asked } if now < *until && asked == about);
    let is_answer = before.is_some_and(|before| is_open(&before.became));
    match () {
        () if rests => PressCounts::Not,
        () if asks && !is_answer => PressCounts::Asks,
        () => PressCounts::Yes,
    }
}

/// Returns the part of a time that is over, from 0 to 100. Pure.
fn share(from: f64, until: f64, now: f64) -> u8 {
    (100.0 * (now - from) / (until - from)).clamp(0.0, 100.0) as u8
}

/// About how long it goes on, in milliseconds.
fn lasts_ms(does: &TileWork) -> f64 {
    match does {
        TileWork::Hand { device, params, .. } if speaks(device) => {
            let letters = params.get("text").and_then(Value::as_text).map_or(5, |text| text.chars().count());
            SPEECH_MIN_MS.max(letters as f64 * LETTER_MS)
        }
        TileWork::Hand { .. } => GESTURE_MS,
        TileWork::Pretend { .. } | TileWork::Word { .. } => PRETENDED_MS,
    }
}

fn going_words(does: &TileWork) -> &'static str {
    match does {
        TileWork::Hand { device, .. } if speaks(device) => words::speaking_now(),
        TileWork::Hand { .. } => words::moving_now(),
        TileWork::Pretend { .. } | TileWork::Word { .. } => words::done_just_now(),
    }
}

/// True if one waits for the other: two things that are said, or two gestures.
fn same_part(one: &TileWork, other: &TileWork) -> bool {
    match (one, other) {
        (TileWork::Hand { device, .. }, TileWork::Hand { device: other, .. }) => device == other,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{ASKS_MS, Became, PressCounts, PressedTile, RESTS_MS, TileWork, press_counts};
    use behaviour::{Id, Params, Value};

    fn pressed(at: f64, became: Became) -> PressedTile {
        let does = TileWork::Hand { device: "Walk".into(), params: Params::default(), value: Value::Null };
        PressedTile { does, at, by: None, name: String::new(), became }
    }

    #[test]
    fn a_tile_that_asks_takes_a_second_press_for_yes_and_silence_or_a_double_tap_for_no() {
        let here = (Some(7), None);
        let asked = pressed(1_000.0, Became::Asks { until: 1_000.0 + ASKS_MS, about: here.clone() });
        let press_counts = |before, asks, now| press_counts(before, asks, &here, now);
        assert_eq!(press_counts(None, true, 1_000.0), PressCounts::Asks);
        assert_eq!(press_counts(Some(&asked), true, 1_000.0 + RESTS_MS - 1.0), PressCounts::Not, "a double tap");
        assert_eq!(press_counts(Some(&asked), true, 1_000.0 + RESTS_MS), PressCounts::Yes);
        assert_eq!(press_counts(Some(&asked), true, 999.0 + ASKS_MS), PressCounts::Yes);
        assert_eq!(press_counts(Some(&asked), true, 1_000.0 + ASKS_MS), PressCounts::Asks, "silence was no");
        let done = pressed(4_000.0, Became::Done { from: 4_000.0, until: 7_000.0 });
        assert_eq!(press_counts(Some(&done), true, 5_000.0), PressCounts::Asks, "each time anew");
    }

    #[test]
    fn a_stop_or_another_robot_ends_what_a_tile_asks() {
        let robot = |name: &str| Some(Id::new(name).unwrap());
        let asked = pressed(0.0, Became::Asks { until: ASKS_MS, about: (Some(7), robot("nao")) });
        let again = |stops, name| press_counts(Some(&asked), true, &(Some(stops), robot(name)), RESTS_MS);
        assert_eq!(again(7, "nao"), PressCounts::Yes);
        assert_eq!(again(8, "nao"), PressCounts::Asks, "Stop came in between");
        assert_eq!(again(7, "other"), PressCounts::Asks, "another robot was chosen in between");
    }

    #[test]
    fn other_tiles_do_it_at_once_and_rest_after_that() {
        let done = pressed(0.0, Became::Asked);
        let press_counts = |before, asks, now| press_counts(before, asks, &(None, None), now);
        assert_eq!(press_counts(None, false, 0.0), PressCounts::Yes);
        assert_eq!(press_counts(Some(&done), false, RESTS_MS - 1.0), PressCounts::Not);
        assert_eq!(press_counts(Some(&done), false, RESTS_MS), PressCounts::Yes);
    }
}
