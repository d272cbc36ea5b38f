//! The common beginning of the tests of gestures.

use super::{ConnectPlan, NewSpot, Output, connected, sensor};
use crate::layout::Ground;
use crate::layout::tests::SIZES;
use behaviour::{Behaviour, Change, Id, Params, Place, Procedure, connectors};
use std::collections::BTreeMap;

pub(super) fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

pub(super) fn start() -> Change {
    Change::of(id("op"), "Aiko", "Test")
}

pub(super) fn places(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    behaviour.streams().filter_map(|(id, _)| Some((id.clone(), behaviour.place(id)?))).collect()
}

pub(super) fn ground<'a>(behaviour: &'a Behaviour, places: &'a BTreeMap<Id, Place>) -> Ground<'a> {
    Ground { behaviour, places, sizes: SIZES }
}

/// RedBall -> Distance -> Close.
pub(super) fn graph() -> Behaviour {
    let mut made = Behaviour::default();
    made.apply(&sensor(
        ground(&made, &BTreeMap::new()),
        start(),
        (&id("ball"), "RedBall", "RedBall", Params::new()),
        None,
    ));
    let ways = [
        ("ball", "distance", "Distance", connectors::map::SPEC.with(Procedure::Helper("distance".into()))),
        ("distance", "close", "Close", connectors::filter::SPEC.with(Procedure::body("distance < 20"))),
    ];
    for (from, to, name, operation) in ways {
        let output = Output::New { name: name.into(), device: None, params: Params::new() };
        let plan = ConnectPlan { operation, inputs: vec![id(from)], output, spot: NewSpot::Below };
        let change = connected(ground(&made, &places(&made)), start(), (&id(to), &id(&format!("to-{to}"))), plan);
        made.apply(&change);
    }
    made
}
