//! The test if a record uses a helper, by name or in its body.

use crate::{HelperUse, LIBRARY, Store, StoreError};
use behaviour::{Id, Procedure, Record, RecordId, calls_helper};
use std::collections::{BTreeSet, HashSet, VecDeque};

/// Returns the users of a helper, also through other helpers; every user once, by its shortest way.
pub(crate) async fn through_others<S: Store + ?Sized>(store: &S, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
    let (mut found, mut seen): (Vec<HelperUse>, HashSet<(Id, RecordId)>) = Default::default();
    let mut open = VecDeque::from([helper.to_owned()]);
    while let Some(next) = open.pop_front() {
        let through = (next != helper).then(|| next.clone());
        for user in store.users(&next).await? {
            let is_helper = user.behaviour.as_str() == LIBRARY;
            if (is_helper && user.name == helper) || !seen.insert((user.behaviour.clone(), user.record.clone())) {
                continue;
            }
            if is_helper {
                open.push_back(user.name.clone());
            }
            found.push(HelperUse { through: through.clone(), ..user });
        }
    }
    Ok(found)
}

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
    let words = body.split(|c| !behaviour::is_name_letter(c));
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
pub(crate) fn usage(behaviour: &Id, name: &str, id: &RecordId, record: &Record) -> HelperUse {
    let name = if let Record::Helper(helper) = record { &helper.name } else { name };
    HelperUse { behaviour: behaviour.clone(), name: name.to_owned(), record: id.clone(), through: None }
}

/// Puts uses in their order.
pub(crate) fn in_order(mut uses: Vec<HelperUse>) -> Vec<HelperUse> {
    uses.sort_by(|a, b| (&a.behaviour, &a.record).cmp(&(&b.behaviour, &b.record)));
    uses
}
