//! What two versions of a behaviour have in common: the streams and connectors that mean the same in both.

use behaviour::{
    BehaviourFile, FileConnector, FileHelper, FileStream, argument_names, calls_helper, rename_identifier,
};
use std::collections::{BTreeMap, BTreeSet};

/// Streams and connectors that keep what they remember when one version of a behaviour follows another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    /// By index in the old version, the index in the new one.
    pub streams: BTreeMap<usize, usize>,
    /// By index in the old version, the index in the new one.
    pub connectors: BTreeMap<usize, usize>,
}

impl Kept {
    /// What stays the same from `old` to `new`. A stream is the same with its id, kind, device and parameters; a
    /// connector with its id, operation, beat, inputs, and the text of its procedure and of all helpers that it calls.
    /// Other names of arguments and streams, other outputs and another order do not matter.
    #[must_use]
    pub fn between(old: &BehaviourFile, new: &BehaviourFile) -> Self {
        let device = |stream: &FileStream| {
            let params = stream.params.clone().unwrap_or_default();
            (stream.kind, stream.device.clone(), params)
        };
        let streams = pairs(&old.streams, &new.streams, |stream| &stream.id);
        let same_stream = |&(from, to): &(usize, usize)| device(&old.streams[from]) == device(&new.streams[to]);
        let connectors = pairs(&old.connectors, &new.connectors, |connector| &connector.id);
        let (before, after) = (Reader::of(old), Reader::of(new));
        let same =
            |&(from, to): &(usize, usize)| before.meaning(&old.connectors[from]) == after.meaning(&new.connectors[to]);
        Self {
            streams: streams.into_iter().filter(same_stream).collect(),
            connectors: connectors.into_iter().filter(same).collect(),
        }
    }
}

/// The indices of what has the same id in both.
fn pairs<T>(old: &[T], new: &[T], id: impl Fn(&T) -> &String) -> Vec<(usize, usize)> {
    let places: BTreeMap<&String, usize> = new.iter().enumerate().map(|(at, thing)| (id(thing), at)).collect();
    let found = |(at, thing): (usize, &T)| Some((at, *places.get(id(thing))?));
    old.iter().enumerate().filter_map(found).collect()
}

/// What a connector does, whatever it and its arguments are called.
#[derive(Debug, PartialEq)]
struct Meaning<'f> {
    operation: &'f str,
    inputs: &'f [String],
    period_ms: Option<u64>,
    procedure: Option<String>,
    /// The helpers it calls, also through others.
    helpers: BTreeMap<&'f str, (&'f [String], &'f str)>,
}

/// Reads meanings out of a file.
struct Reader<'f> {
    file: &'f BehaviourFile,
    names: BTreeMap<&'f str, &'f str>,
    /// For every helper by name itself and what it calls, also through others.
    reach: BTreeMap<&'f str, BTreeSet<&'f str>>,
}

impl<'f> Reader<'f> {
    fn of(file: &'f BehaviourFile) -> Self {
        let names = file.streams.iter().map(|stream| (stream.id.as_str(), stream.name.as_str())).collect();
        let calls: BTreeMap<&str, Vec<&str>> =
            file.helpers.iter().map(|helper| (helper.name.as_str(), called(&file.helpers, &helper.body))).collect();
        let reach = calls.keys().map(|&name| (name, reached(name, &calls))).collect();
        Self { file, names, reach }
    }

    fn meaning(&self, of: &'f FileConnector) -> Meaning<'f> {
        let text = self.text(of);
        let direct = text.as_ref().map(|(_, body)| called(&self.file.helpers, body)).unwrap_or_default();
        let reached: BTreeSet<&str> =
            direct.iter().filter_map(|name| self.reach.get(name)).flatten().copied().collect();
        let helpers = self.file.helpers.iter().filter(|helper| reached.contains(helper.name.as_str()));
        Meaning {
            operation: &of.operation,
            inputs: &of.inputs,
            period_ms: of.period_ms,
            procedure: text.map(|(names, body)| without_names(&names, body)),
            helpers: helpers.map(|helper| (helper.name.as_str(), (&helper.params[..], helper.body.as_str()))).collect(),
        }
    }

    /// The arguments and the body of a connector.
    fn text(&self, of: &'f FileConnector) -> Option<(Vec<String>, &'f str)> {
        if let Some(name) = &of.helper {
            let helper = self.file.helpers.iter().find(|helper| helper.name == *name)?;
            return Some((helper.params.clone(), &helper.body));
        }
        let name = |id: &String| self.names.get(id.as_str()).copied().unwrap_or_default();
        let args = || argument_names(of.inputs.iter().map(name));
        Some((of.args.clone().unwrap_or_else(args), of.body.as_ref()?))
    }
}

fn called<'f>(helpers: &'f [FileHelper], body: &str) -> Vec<&'f str> {
    helpers.iter().map(|helper| helper.name.as_str()).filter(|name| calls_helper(body, name)).collect()
}

fn reached<'f>(from: &'f str, calls: &BTreeMap<&'f str, Vec<&'f str>>) -> BTreeSet<&'f str> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(name) = open.pop() {
        if seen.insert(name) {
            open.extend(calls.get(name).into_iter().flatten());
        }
    }
    seen
}

/// The body with its arguments numbered, in a way that nobody can write.
fn without_names(names: &[String], body: &str) -> String {
    let numbered = names.iter().enumerate();
    numbered.fold(body.trim().to_owned(), |body, (at, name)| rename_identifier(&body, name, &format!("§{at}§")))
}
