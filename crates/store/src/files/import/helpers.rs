//! The helpers of a file in a library that may have others of the same name.

use super::ImportError;
use behaviour::{
    Behaviour, BehaviourFile, Change, FileHelper, Helper, Id, Kind, Record, RecordId, called_names, numbered,
    rename_helpers,
};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap, HashMap, HashSet};

/// The places to which the helpers of a file went.
pub(super) struct Shelved {
    /// Name in the file to name in the library.
    pub(super) names: BTreeMap<String, String>,
    /// The change of the library; without edits if nothing joins it.
    pub(super) change: Change,
}

/// Puts the helpers of a file into the library. One that is there with the same meaning stays; one that means
/// something else there comes under a free name, and so does whatever calls it.
pub(super) fn shelve(
    file: &BehaviourFile,
    library: &Behaviour,
    by: &str,
    new_id: &mut impl FnMut() -> Id,
) -> Result<Shelved, ImportError> {
    let as_looks = |name: &str| behaviour::as_looks(name).into_owned();
    let mut there: HashMap<String, Helper> = library.helpers().map(|(_, h)| (as_looks(&h.name), h.clone())).collect();
    let mut change = Change::of(new_id(), by, behaviour::labels::helpers_imported());
    let mut names = BTreeMap::new();
    let in_file: HashSet<&str> = file.helpers.iter().map(|helper| helper.name.as_str()).collect();
    for helper in callees_first(&file.helpers)? {
        let mut wanted = Helper {
            name: as_looks(&helper.name),
            params: helper.params.clone(),
            body: rename_helpers(&helper.body, &names),
            says: helper.says.clone(),
            takes: helper.takes.clone(),
            gives: helper.gives,
        };
        let name = name_for(&wanted, &there, &in_file);
        wanted.name.clone_from(&name);
        if !there.contains_key(&name) {
            let id = RecordId::new(Kind::Helper, &new_id());
            change = change.put(library, id, Record::Helper(wanted.clone()));
            there.insert(name.clone(), wanted);
        }
        let kept = there.get(&name).map_or(name, |helper| helper.name.clone());
        names.insert(helper.name.clone(), kept);
    }
    Ok(Shelved { names, change })
}

/// Returns its own name, or with the first number under which it is there already or nothing is, here or in the file.
fn name_for(wanted: &Helper, there: &HashMap<String, Helper>, in_file: &HashSet<&str>) -> String {
    let same = |other: &Helper| other.params == wanted.params && other.body == wanted.body;
    let fits = |name: &String| match there.get(name) {
        Some(other) => same(other),
        None => *name == wanted.name || !in_file.contains(name.as_str()),
    };
    numbered(&wanted.name, "").find(fits).unwrap_or_default()
}

/// Every helper after those that it calls; each body is read once.
fn callees_first(helpers: &[FileHelper]) -> Result<Vec<&FileHelper>, ImportError> {
    let places: HashMap<&str, usize> = helpers.iter().enumerate().map(|(at, helper)| (&*helper.name, at)).collect();
    let mut callers: Vec<Vec<usize>> = vec![Vec::new(); helpers.len()];
    let mut waits = vec![0_usize; helpers.len()];
    for (at, helper) in helpers.iter().enumerate() {
        for callee in called_names(&helper.body).into_iter().filter_map(|name| places.get(name)) {
            callers[*callee].push(at);
            waits[at] += 1;
        }
    }
    let mut ready: BinaryHeap<Reverse<usize>> = (0..helpers.len()).filter(|at| waits[*at] == 0).map(Reverse).collect();
    let mut sorted = Vec::with_capacity(helpers.len());
    while let Some(Reverse(at)) = ready.pop() {
        sorted.push(&helpers[at]);
        for caller in &callers[at] {
            waits[*caller] -= 1;
            if waits[*caller] == 0 {
                ready.push(Reverse(*caller));
            }
        }
    }
    match helpers.iter().zip(waits).find(|(_, waits)| *waits > 0) {
        Some((helper, _)) => Err(ImportError::Circle(helper.name.clone())),
        None => Ok(sorted),
    }
}

/// The file with its helpers under their names in the library.
pub(super) fn renamed(file: &BehaviourFile, names: &BTreeMap<String, String>) -> BehaviourFile {
    let mut file = file.clone();
    if names.iter().all(|(old, new)| old == new) {
        return file;
    }
    for connector in &mut file.connectors {
        if let Some(name) = connector.helper.as_ref().and_then(|old| names.get(old)) {
            connector.helper = Some(name.clone());
        }
        if let Some(body) = &mut connector.body {
            *body = rename_helpers(body, names);
        }
    }
    file
}
