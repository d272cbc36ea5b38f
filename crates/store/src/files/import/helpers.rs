//! The helpers of a file in a library that may have others of the same name.

use behaviour::{
    Behaviour, BehaviourFile, Change, FileHelper, Helper, Id, Kind, Record, RecordId, calls_helper, rename_helpers,
};
use std::collections::BTreeMap;

/// Where the helpers of a file went.
pub(super) struct Shelved {
    /// Name in the file to name in the library.
    pub(super) names: BTreeMap<String, String>,
    /// What the library gets; without edits if nothing.
    pub(super) change: Change,
}

/// Puts the helpers of a file into the library. One that is there with the same meaning stays; one that means
/// something else there comes under a free name, and so does whatever calls it.
pub(super) fn shelve(
    file: &BehaviourFile,
    library: &Behaviour,
    by: &str,
    new_id: &mut impl FnMut() -> Id,
) -> Result<Shelved, String> {
    let mut there: BTreeMap<String, Helper> = library.helpers().map(|(_, h)| (h.name.clone(), h.clone())).collect();
    let mut change = Change::of(new_id(), by, "Import helpers");
    let mut names = BTreeMap::new();
    for helper in callees_first(&file.helpers)? {
        let mut wanted = Helper {
            name: helper.name.clone(),
            params: helper.params.clone(),
            body: rename_helpers(&helper.body, &names),
            says: helper.says.clone(),
        };
        let name = name_for(&wanted, &there, &file.helpers);
        wanted.name.clone_from(&name);
        if !there.contains_key(&name) {
            let id = RecordId::new(Kind::Helper, &new_id());
            change = change.put(library, id, Record::Helper(wanted.clone()));
            there.insert(name.clone(), wanted);
        }
        names.insert(helper.name.clone(), name);
    }
    Ok(Shelved { names, change })
}

/// Its own name, or with the first number under which it is there already or nothing is, here or in the file.
fn name_for(wanted: &Helper, there: &BTreeMap<String, Helper>, file: &[FileHelper]) -> String {
    let same = |other: &Helper| other.params == wanted.params && other.body == wanted.body;
    let fits = |name: &String| match there.get(name) {
        Some(other) => same(other),
        None => *name == wanted.name || file.iter().all(|helper| helper.name != *name),
    };
    let numbered = (2_u32..).map(|number| format!("{}{number}", wanted.name));
    std::iter::once(wanted.name.clone()).chain(numbered).find(fits).unwrap_or_default()
}

/// Every helper after those that it calls.
fn callees_first(helpers: &[FileHelper]) -> Result<Vec<&FileHelper>, String> {
    let mut sorted: Vec<&FileHelper> = Vec::new();
    let mut open: Vec<&FileHelper> = helpers.iter().collect();
    while !open.is_empty() {
        let waits = |helper: &FileHelper| open.iter().any(|other| calls_helper(&helper.body, &other.name));
        let (later, now): (Vec<&FileHelper>, Vec<&FileHelper>) = open.iter().partition(|helper| waits(helper));
        if now.is_empty() {
            return Err(format!("{}: it calls itself, also through others. Change its body.", later[0].name));
        }
        sorted.extend(now);
        open = later;
    }
    Ok(sorted)
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
