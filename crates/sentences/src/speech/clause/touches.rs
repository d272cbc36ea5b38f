//! Touches: which part is touched, pressed, held or let go.

use super::{Bag, agent};
use crate::speech::atoms::{Atom, AtomValue, form};
use crate::speech::lexicon::FormEnd;
use crate::speech::meaning::{SensedEvent, TouchPhase, TouchedPart};

/// What is touched; none if this tells of no touch, nothing inside if it tells of one that cannot be felt.
pub(super) fn touch(bag: &mut Bag, over: bool, lasts: &mut bool) -> Option<Option<SensedEvent>> {
    given(bag);
    if let Some(let_go) = let_go(bag) {
        return Some(Some(let_go));
    }
    if let Some(button) = pressed(bag) {
        return Some(Some(button));
    }
    if let Some(clap) = clapped(bag) {
        return Some(Some(clap));
    }
    for verb in ["release", "touch", "press", "hold", "bump"] {
        let Some(at) = bag.find("v", verb) else { continue };
        let names = bag.has("part", "") || bag.has("it", "") || bag.atoms[at].is("hand", "") && bag.has("side", "");
        if names || verb == "touch" || verb == "bump" {
            return Some(by_verb(bag, verb, at, over, lasts));
        }
    }
    None
}

/// *Give your head a pat*: the touch is the noun.
fn given(bag: &mut Bag) {
    let Some(give) = bag.find("v", "give") else { return };
    let is_touch = |at: &usize| {
        let touch = ["touch", "hold", "press", "bump"].iter().find_map(|verb| bag.atoms[*at].sense("v", verb));
        let mut before = bag.atoms[give + 1..*at].iter().rev().skip_while(|atom| atom.is("manner", "soft"));
        touch.is_some_and(|sense| sense.form.end == FormEnd::Plain)
            && (before.next().is_some_and(|before| before.is("void", "det")) || bag.atoms[*at].is("noun", "touch"))
    };
    if (give + 1..bag.atoms.len()).any(|at| is_touch(&at)) {
        bag.use_up(give);
        // A pat is gentle by itself.
        bag.take_all("manner", "soft");
    }
}

/// *I let go*, of what was touched.
fn let_go(bag: &mut Bag) -> Option<SensedEvent> {
    let at = bag.find("v", "release").filter(|_| !bag.has("part", "") && !bag.has("robot", ""))?;
    let denies = bag.atoms[at].sense("v", "release").is_some_and(|sense| sense.form.not);
    let left = bag.left();
    let other = |atom: &Atom| {
        let known = [("who", ""), ("it", ""), ("v", "release")];
        left.contains(&atom.span) && !known.iter().any(|(kind, arg)| atom.is(kind, arg))
    };
    if denies || bag.atoms.iter().any(other) {
        return None;
    }
    bag.use_up(at);
    agent(bag);
    bag.take("it", "");
    // 離れたら: who came near may go away as well.
    Some(if bag.atoms[at].is("adj", "far") { SensedEvent::ItGoes } else { SensedEvent::ItLetGo })
}

fn pressed(bag: &mut Bag) -> Option<SensedEvent> {
    let at = bag.find("v", "press").filter(|_| bag.has("noun", "button"))?;
    bag.use_up(at);
    bag.take("noun", "button");
    agent(bag);
    bag.take("robot", "");
    let label =
        bag.take("noun", "called").is_some() || bag.atoms.iter().any(|atom| matches!(atom.value, AtomValue::Quote(_)));
    Some(SensedEvent::Button(if label { bag.quote() } else { None }))
}

/// 手をたたいたら: it is heard.
fn clapped(bag: &mut Bag) -> Option<SensedEvent> {
    let at = (0..bag.atoms.len()).find(|at| bag.atoms[*at].is("v", "clap") && bag.atoms[*at].is("v", "touch"))?;
    let parts = bag.atoms.iter().filter(|atom| atom.is("part", "")).count();
    if form(&bag.atoms[at], "v").passive || !bag.has("part", "hand") || bag.has("side", "") || parts != 1 {
        return None;
    }
    bag.use_up(at);
    bag.take("part", "hand");
    agent(bag);
    Some(SensedEvent::Noise)
}

fn by_verb(bag: &mut Bag, verb: &str, at: usize, over: bool, lasts: &mut bool) -> Option<SensedEvent> {
    let form = form(&bag.atoms[at], "v");
    bag.use_up(at);
    bag.take_all("v", verb);
    if verb == "release" {
        // The robot does not feel that it lets go itself.
        if bag.has("robot", "") && !form.passive {
            return None;
        }
        // 頭から手が離れた: the hand is whose it is that touches.
        if let (Some(first), Some(second)) = (bag.find("part", ""), bag.find("part", "hand"))
            && first != second
        {
            bag.use_up(second);
        }
        bag.take("v", "touch");
    }
    *lasts |= form.lasts;
    if bag.has("part", "") {
        // Somebody's own head is no robot's.
        let english = matches!(form.end, FormEnd::Plain | FormEnd::Third | FormEnd::Past | FormEnd::Ing);
        let whose =
            bag.atoms[at + 1..].iter().any(|atom| atom.is("who", "") && !atom.is("part", "") && !atom.is("robot", ""));
        if bag.has("poss", "own") || (english && !form.passive && whose) {
            return None;
        }
    }
    agent(bag);
    bag.take_all("robot", "");
    bag.take("none", "");
    if matches!(verb, "bump" | "touch" | "press") {
        bag.take_all("noun", "thing");
        bag.take_all("noun", "wall");
    }
    if bag.has("part", "") {
        return touched(bag, verb == "release" || over);
    }
    // 右手をはなす is 右 and 手をはなす.
    if verb == "release"
        && bag.atoms[at].is("hand", "")
        && let Some((side, _)) = bag.arg("side")
    {
        return Some(SensedEvent::Touch(TouchedPart::Hand, vec![("hand", side)], TouchPhase::Ends));
    }
    if bag.take("it", "").is_none() && (bag.has("noun", "one") || bag.has("side", "") || bag.has("place", "")) {
        return same(bag);
    }
    // What was said last; if it was something else, that stays in doubt.
    Some(if verb == "release" || over { SensedEvent::ItLetGo } else { SensedEvent::ItTouched })
}

/// A touch of the parts that the bag has.
fn touched(bag: &mut Bag, released: bool) -> Option<SensedEvent> {
    let phase = if released { TouchPhase::Ends } else { TouchPhase::Begins };
    let mut all = Vec::new();
    let place = bag.arg("place").map(|(place, _)| place);
    let mut side = bag.arg("side").map(|(side, _)| side);
    let other_side = if side.is_some() { bag.arg("side").map(|(side, _)| side) } else { None };
    bag.take("noun", "one");
    while let Some((part, _)) = bag.arg("part") {
        let own_side = part.split_once('.').map(|(_, side)| side);
        let part = part.split_once('.').map_or(part, |(part, _)| part);
        let side_of = own_side.or(side);
        let chosen = |name: &'static str, value: Option<&'static str>| value.map(|value| (name, value));
        let event = match part {
            "head" => {
                if side_of.is_some() {
                    return None;
                }
                SensedEvent::Touch(TouchedPart::Head, chosen("part", place).into_iter().collect(), phase)
            }
            "hand" => {
                let back = place.filter(|place| *place == "rear").map(|_| "back");
                if place.is_some() && back.is_none() {
                    return None;
                }
                let mut params: Vec<_> = chosen("hand", side_of).into_iter().collect();
                params.extend(chosen("part", back));
                SensedEvent::Touch(TouchedPart::Hand, params, phase)
            }
            "foot" if place.is_none() => {
                SensedEvent::Touch(TouchedPart::Foot, chosen("foot", side_of).into_iter().collect(), phase)
            }
            _ => return None,
        };
        if !all.contains(&event) {
            all.push(event);
        }
    }
    if let (Some(other), [SensedEvent::Touch(device, params, phase)]) = (other_side, &all[..]) {
        let mut params = params.clone();
        for param in &mut params {
            if Some(param.1) == side {
                param.1 = other;
            }
        }
        let both = SensedEvent::Touch(*device, params, *phase);
        all.push(both);
        side = None;
    }
    let _ = side;
    if all.len() > 1 {
        // Both at once cannot be told.
        bag.take("or", "")?;
        bag.take_signs(',');
        return Some(SensedEvent::Any(all));
    }
    all.pop()
}

/// The one of the other side.
pub(super) fn same(bag: &mut Bag) -> Option<SensedEvent> {
    bag.take("noun", "one");
    let side = bag.arg("side").map(|(side, _)| side);
    let place = bag.arg("place").map(|(place, _)| place);
    let mut params = Vec::new();
    params.extend(side.map(|side| ("side", side)));
    params.extend(place.map(|place| ("part", place)));
    (!params.is_empty()).then_some(SensedEvent::Same(params, None))
}
