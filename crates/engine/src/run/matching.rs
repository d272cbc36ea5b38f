//! The match of two versions of a behaviour: the streams and connectors that mean the same in both.

use crate::values::{ConnectorIx, Ix, Pairs, StreamIx};
use behaviour::{
    BehaviourFile, FileConnector, FileHelper, FileStream, Operation, Procedure, called_names, rename_identifiers,
};
use behaviour::{Lookup, LookupSet};

/// Streams and connectors that keep what they remember when one version of a behaviour follows another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Matching {
    /// The stream of the new version, by stream of the old one.
    pub streams: Pairs<StreamIx>,
    /// The connector of the new version, by connector of the old one.
    pub connectors: Pairs<ConnectorIx>,
}

impl Matching {
    /// Finds the parts that stay the same from `old` to `new`. A stream is the same with its id, kind, device and
    /// parameters; a connector with its id, operation, inputs, what was chosen for it, and the text of its procedure
    /// and of all helpers that it calls. Other names of arguments and streams, other outputs and another order do not
    /// matter.
    #[must_use]
    pub fn between(old: &BehaviourFile, new: &BehaviourFile) -> Self {
        let device = |stream: &FileStream| {
            let params = stream.params.clone().unwrap_or_default();
            (stream.kind, stream.device.clone(), params)
        };
        let mut streams = pairs(&old.streams, &new.streams, |stream| &stream.id);
        let same_stream =
            |&(from, to): &(StreamIx, StreamIx)| device(&old.streams[from.index()]) == device(&new.streams[to.index()]);
        let mut connectors = pairs(&old.connectors, &new.connectors, |connector| &connector.id);
        let (before, after) = (MeaningReader::of(old), MeaningReader::of(new));
        let helpers = before.same_helpers(&after);
        let same = |&(from, to): &(ConnectorIx, ConnectorIx)| {
            let one = before.meaning(&old.connectors[from.index()]);
            let other = after.meaning(&new.connectors[to.index()]);
            one == other && one.is_some_and(|one| one.helpers.iter().all(|name| helpers.contains(name.as_str())))
        };
        streams.retain(same_stream);
        connectors.retain(same);
        Self { streams: Pairs::of(streams), connectors: Pairs::of(connectors) }
    }
}

/// The numbers of what has the same id in both, in the order of the old ones.
fn pairs<I: Ix, T>(old: &[T], new: &[T], id: impl Fn(&T) -> &String) -> Vec<(I, I)> {
    let places = places(new.iter().map(|thing| id(thing).as_str()));
    let found = |(at, thing): (usize, &T)| Some((I::of(at), I::of(*places.get(id(thing).as_str())?)));
    old.iter().enumerate().filter_map(found).collect()
}

/// The places of what has these names.
fn places<'f>(names: impl Iterator<Item = &'f str>) -> Lookup<&'f str, usize> {
    names.enumerate().map(|(at, name)| (name, at)).collect()
}

/// The meaning of a connector, whatever it and its arguments are called.
#[derive(Debug, PartialEq)]
struct RunMeaning<'f> {
    /// With the body of its procedure, also if that is a helper, in which arguments are numbered.
    operation: Operation,
    inputs: &'f [String],
    /// The helpers that it calls itself, each once, in order.
    helpers: Vec<String>,
}

/// Reads meanings out of a file.
struct MeaningReader<'f> {
    file: &'f BehaviourFile,
    streams: Lookup<&'f str, usize>,
    helpers: Lookup<&'f str, usize>,
}

impl<'f> MeaningReader<'f> {
    fn of(file: &'f BehaviourFile) -> Self {
        let streams = places(file.streams.iter().map(|stream| stream.id.as_str()));
        let helpers = places(file.helpers.iter().map(|helper| helper.name.as_str()));
        Self { file, streams, helpers }
    }

    fn helper(&self, name: &str) -> Option<&'f FileHelper> {
        self.helpers.get(name).map(|at| &self.file.helpers[*at])
    }

    /// The helpers that a text calls, each once, in order.
    fn called<'t>(&self, body: &'t str) -> Vec<&'t str> {
        called_names(body).into_iter().filter(|name| self.helpers.contains_key(name)).collect()
    }

    /// The helpers that mean the same in both, with all that they call, also through others.
    fn same_helpers(&self, other: &Self) -> LookupSet<&'f str> {
        let mut callers: Lookup<&str, Vec<&'f str>> = Lookup::new();
        let mut same: LookupSet<&'f str> = self.file.helpers.iter().map(|helper| helper.name.as_str()).collect();
        let mut different = Vec::new();
        for helper in &self.file.helpers {
            let name = helper.name.as_str();
            let called = self.called(&helper.body);
            called.iter().for_each(|called| callers.entry(*called).or_default().push(name));
            let is_same = |twin: &FileHelper| {
                (&twin.params, &twin.body) == (&helper.params, &helper.body) && called == other.called(&twin.body)
            };
            if !other.helper(name).is_some_and(is_same) {
                different.push(name);
            }
        }
        while let Some(name) = different.pop() {
            if same.remove(name) {
                different.extend(callers.get(name).into_iter().flatten());
            }
        }
        same
    }

    /// Returns the meaning of a connector; none if it cannot run.
    fn meaning(&self, of: &'f FileConnector) -> Option<RunMeaning<'f>> {
        let mut operation = of.operation().ok()?;
        let arguments = operation.arguments(of.inputs.iter().map(|id| self.name(id)));
        let mut helpers = Vec::new();
        if let Some(procedure) = operation.procedure_mut() {
            let (names, body) = match procedure {
                Procedure::Helper(name) => self.helper(name).map(|helper| (&helper.params, &helper.body))?,
                Procedure::Body { body, .. } => (&arguments, &*body),
            };
            helpers = self.called(body).into_iter().map(str::to_owned).collect();
            *procedure = Procedure::Body { body: without_names(names, body), args: None };
        }
        Some(RunMeaning { operation, inputs: &of.inputs, helpers })
    }

    fn name(&self, stream: &str) -> &'f str {
        self.streams.get(stream).map_or("", |at| &self.file.streams[*at].name)
    }
}

/// The body with its arguments numbered, in a way that nobody can write.
fn without_names(names: &[String], body: &str) -> String {
    let numbers: Vec<String> = (0..names.len()).map(|at| format!("§{at}§")).collect();
    rename_identifiers(body.trim(), names, &numbers)
}
