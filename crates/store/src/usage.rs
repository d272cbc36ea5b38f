//! Whether a record uses a helper, by name or in its body.

use behaviour::{Id, Procedure, Record, RecordId, calls_helper};
use std::collections::BTreeSet;

use crate::Usage;

/// Every word in a record that may be a helper; an index of candidates for [`uses`].
pub(crate) fn words(record: &Record) -> BTreeSet<String> {
    match (record, procedure(record)) {
        (_, Some(Procedure::Helper(name))) => BTreeSet::from([name.clone()]),
        (_, Some(Procedure::Body { body, .. })) => words_of(body),
        (Record::Helper(helper), None) => words_of(&helper.body),
        (_, None) => BTreeSet::new(),
    }
}

fn words_of(body: &str) -> BTreeSet<String> {
    let words = body.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

/// True if the record uses the helper; a helper that mentions itself does not count.
pub(crate) fn uses(record: &Record, helper: &str) -> bool {
    match (record, procedure(record)) {
        (_, Some(Procedure::Helper(name))) => name == helper,
        (_, Some(Procedure::Body { body, .. })) => calls_helper(body, helper),
        (Record::Helper(other), None) => other.name != helper && calls_helper(&other.body, helper),
        (_, None) => false,
    }
}

fn procedure(record: &Record) -> Option<&Procedure> {
    if let Record::Connector(connector) = record { connector.operation.procedure() } else { None }
}

/// The use of a helper by this record, in a behaviour of that name.
pub(crate) fn usage(behaviour: &Id, name: &str, id: &RecordId, record: &Record) -> Usage {
    let name = if let Record::Helper(helper) = record { &helper.name } else { name };
    Usage { behaviour: behaviour.clone(), name: name.to_owned(), record: id.clone() }
}

/// Puts uses in their order.
pub(crate) fn in_order(mut uses: Vec<Usage>) -> Vec<Usage> {
    uses.sort_by(|a, b| (&a.behaviour, &a.record).cmp(&(&b.behaviour, &b.record)));
    uses
}
