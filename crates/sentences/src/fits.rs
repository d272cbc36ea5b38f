//! Whether a clause says what a device with its parameters and its connectors does.

use crate::clauses::{Clause, ClausePart};
use crate::does::{Calc, SpokenConnector};
use crate::pattern::{Grammar, holes};
use crate::test::{Asks, ValueTest};
use behaviour::{Params, Value};
use robot::{Device, with_defaults};

/// Whether a clause leaves out nothing of what was chosen for the device.
pub(crate) fn params_fit(
    grammar: &Grammar,
    id: &str,
    fixed: &[(&str, &str)],
    device: &Device,
    params: &Params,
) -> bool {
    let chosen = with_defaults(device.params, params);
    let told = holes(grammar.told(id));
    device.params.iter().all(|param| {
        let value = chosen.get(param.name);
        let wanted = fixed.iter().find(|(name, _)| *name == param.name);
        match wanted {
            Some((_, wanted)) => value.is_some_and(|value| is_text(value, wanted)),
            None => told.contains(&param.name) || value.is_some_and(|value| same(value, &param.default())),
        }
    })
}

/// Whether two values of a parameter mean the same.
pub(crate) fn same(one: &Value, other: &Value) -> bool {
    match (one.as_number(), other.as_number()) {
        (Some(one), Some(other)) => one == other,
        _ => one == other,
    }
}

fn is_text(value: &Value, wanted: &str) -> bool {
    value.as_text() == Some(wanted) || (value.as_number().is_some() && value.as_number() == wanted.parse().ok())
}

/// Whether a connector is this part of a clause.
pub(crate) fn is_part(does: &SpokenConnector, part: ClausePart) -> bool {
    let is_field = |field: &Option<String>, wanted: &str| field.as_deref().unwrap_or("") == wanted;
    match (part, does) {
        (ClausePart::Truth(wanted, truth), SpokenConnector::Keep(ValueTest { field, asks: Asks::Truth(is) })) => {
            is_field(field, wanted) && *is == truth
        }
        (ClausePart::Text(wanted), SpokenConnector::Keep(ValueTest { field, asks: Asks::Text(true, _) })) => {
            is_field(field, wanted)
        }
        (ClausePart::Quiet, SpokenConnector::Quiet(_))
        | (ClausePart::Number, SpokenConnector::Make(Calc::Number(_))) => true,
        (ClausePart::Changed(wanted), SpokenConnector::Changed(Some(Calc::Field(field)))) => field == wanted,
        (ClausePart::Helper(wanted), SpokenConnector::Make(Calc::Helper(name))) => name == wanted,
        _ => false,
    }
}

/// The unit of the number of an action's clause: a hand is so far open, all other joints turn.
pub(crate) fn number_unit(clause: &Clause, params: &Params) -> &'static str {
    let is_hand = params.get("joint").and_then(Value::as_text).is_some_and(|joint| joint.ends_with("Hand"));
    match clause.id {
        "move.number" if is_hand => "",
        "move.number" => "rad",
        "walk.number" => "m/s",
        _ => "",
    }
}
