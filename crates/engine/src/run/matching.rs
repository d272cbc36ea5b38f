//! What two versions of a behaviour have in common: the streams and connectors that mean the same in both.

use behaviour::{
    BehaviourFile, FileConnector, FileHelper, FileStream, argument_names, called_names, rename_identifier,
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
        let helpers = before.same_helpers(&after);
        let same = |&(from, to): &(usize, usize)| {
            let (one, other) = (before.meaning(&old.connectors[from]), after.meaning(&new.connectors[to]));
            one == other && one.helpers.is_subset(&helpers)
        };
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
    /// The helpers that it calls itself.
    helpers: BTreeSet<&'f str>,
}

/// Reads meanings out of a file.
struct Reader<'f> {
    names: BTreeMap<&'f str, &'f str>,
    helpers: BTreeMap<&'f str, &'f FileHelper>,
}

impl<'f> Reader<'f> {
    fn of(file: &'f BehaviourFile) -> Self {
        let names = file.streams.iter().map(|stream| (stream.id.as_str(), stream.name.as_str())).collect();
        let helpers = file.helpers.iter().map(|helper| (helper.name.as_str(), helper)).collect();
        Self { names, helpers }
    }

    /// The helpers that a text calls.
    fn called<'t>(&self, body: &'t str) -> BTreeSet<&'t str> {
        called_names(body).into_iter().filter(|name| self.helpers.contains_key(name)).collect()
    }

    /// The helpers that mean the same in both, with all that they call, also through others.
    fn same_helpers(&self, other: &Self) -> BTreeSet<&'f str> {
        let mut callers: BTreeMap<&str, Vec<&'f str>> = BTreeMap::new();
        let mut same: BTreeSet<&'f str> = self.helpers.keys().copied().collect();
        let mut different = Vec::new();
        for (name, helper) in &self.helpers {
            let called = self.called(&helper.body);
            called.iter().for_each(|called| callers.entry(*called).or_default().push(name));
            let is_same = |twin: &&FileHelper| {
                (&twin.params, &twin.body) == (&helper.params, &helper.body) && called == other.called(&twin.body)
            };
            if !other.helpers.get(name).is_some_and(is_same) {
                different.push(*name);
            }
        }
        while let Some(name) = different.pop() {
            if same.remove(name) {
                different.extend(callers.get(name).into_iter().flatten());
            }
        }
        same
    }

    fn meaning(&self, of: &'f FileConnector) -> Meaning<'f> {
        let text = self.text(of);
        Meaning {
            operation: &of.operation,
            inputs: &of.inputs,
            period_ms: of.period_ms,
            helpers: text.as_ref().map(|(_, body)| self.called(body)).unwrap_or_default(),
            procedure: text.map(|(names, body)| without_names(&names, body)),
        }
    }

    /// The arguments and the body of a connector.
    fn text(&self, of: &'f FileConnector) -> Option<(Vec<String>, &'f str)> {
        if let Some(name) = &of.helper {
            let helper = self.helpers.get(name.as_str())?;
            return Some((helper.params.clone(), &helper.body));
        }
        let name = |id: &String| self.names.get(id.as_str()).copied().unwrap_or_default();
        let args = || argument_names(of.inputs.iter().map(name));
        Some((of.args.clone().unwrap_or_else(args), of.body.as_ref()?))
    }
}

/// The body with its arguments numbered, in a way that nobody can write.
fn without_names(names: &[String], body: &str) -> String {
    let numbered = names.iter().enumerate();
    numbered.fold(body.trim().to_owned(), |body, (at, name)| rename_identifier(&body, name, &format!("§{at}§")))
}
