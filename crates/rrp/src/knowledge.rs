//! What the rules ask: the catalogue of devices, and whether a procedure can run.

use behaviour::{Behaviour, Change, Decision, Knowledge, Params, Refusal, Room, StreamKind};

/// Devices and procedures as this rrp knows them.
pub(crate) struct Known;

impl Knowledge for Known {
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), String> {
        robot::device(kind, device)?.check(params)
    }

    fn body(&self, arguments: &[String], body: &str) -> Result<(), String> {
        engine::check_body(arguments, body)
    }
}

/// Whether changes that make a behaviour from nothing keep the rules.
pub(crate) fn judge(changes: &[Change]) -> Result<(), Refusal> {
    let mut room = Room::open(Behaviour::default(), 0);
    for change in changes {
        match room.propose(0, change.clone(), &Known) {
            Decision::Save(committed) => room.commit(&committed),
            Decision::Duplicate(_) => {}
            Decision::Refuse(refusal) => return Err(refusal),
        }
    }
    Ok(())
}
