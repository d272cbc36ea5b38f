//! From the tree to the behaviour: every field known, of its kind and within its bounds, else a fault with its place.

mod fields;

use super::place::LineStarts;
use super::tree::{FileNode, NodeKind};
use super::{FileFault, ReadFile, TEXT_MAX_BYTES};
use behaviour::{
    BehaviourFile, CONNECTORS_MAX, Declared, Engine, FORMAT, FileConnector, FileGroup, FileHelper, FileNote,
    FileStream, FileTile, GROUPS_MAX, HELPERS_MAX, Id, NAME_MAX_CHARS, NOTES_MAX, Place, RATE_MS, STREAMS_MAX,
    StreamKind, TAG_MAX_CHARS, TAGS_MAX, TILE_KEYS, connectors, is_identifier, without_control,
};
use fields::ShapeFields;
use phrase::{Phrase, phrase, word};
use std::collections::{BTreeMap, HashMap, HashSet};

/// The lengths a frame may have, in milliseconds.
const FRAME_MS: std::ops::RangeInclusive<u64> = 1..=1000;
/// Faults that are told of one file.
const FAULTS_MAX: usize = 100;

/// The behaviour in a tree, with everything that is wrong with it.
pub(super) fn behaviour(root: &FileNode, lines: &LineStarts) -> ReadFile {
    let mut reader = ShapeReader { lines, faults: Vec::new(), places: BTreeMap::new(), helpers: BTreeMap::new() };
    reader.check_twice(root);
    let file = reader.file(root);
    // Helpers are found by name, unless something else has it as its id.
    for (helper, place) in std::mem::take(&mut reader.helpers) {
        reader.places.entry(helper).or_insert(place);
    }
    reader.faults.sort_by_cached_key(|fault| (fault.line, fault.column, fault.reason.to_string()));
    reader.faults.dedup();
    let file = Some(file).filter(|_| reader.faults.is_empty());
    ReadFile { file, faults: reader.faults, places: reader.places }
}

struct ShapeReader<'l, 't> {
    lines: &'l LineStarts<'t>,
    faults: Vec<FileFault>,
    places: BTreeMap<String, (u32, u32)>,
    helpers: BTreeMap<String, (u32, u32)>,
}

impl ShapeReader<'_, '_> {
    fn fault(&mut self, at: usize, reason: impl Into<Phrase>) {
        if self.faults.len() < FAULTS_MAX {
            self.faults.push(self.lines.fault(at, reason));
        }
    }

    /// Nothing may be said twice, however deep.
    fn check_twice(&mut self, node: &FileNode) {
        match &node.what {
            NodeKind::Plain(_) => {}
            NodeKind::Array(items) => items.iter().for_each(|item| self.check_twice(item)),
            NodeKind::Object(fields) => {
                let mut seen: HashSet<&str> = HashSet::new();
                for (name, field) in fields {
                    if !seen.insert(name.as_str()) {
                        self.fault(
                            field.at,
                            phrase!("file.is_there_twice_leave_one", "“{name}” is there twice. Leave one out."),
                        );
                    }
                    self.check_twice(field);
                }
            }
        }
    }

    fn file(&mut self, root: &FileNode) -> BehaviourFile {
        const KNOWN: &str =
            "format id name robot engine exercise tags helpers streams connectors notes groups pad order layout";
        let fields = ShapeFields::of(self, root, word!("file.a_program", "a program"), KNOWN);
        let format = fields.text(self, "format");
        if let Some(node) = fields.get("format").filter(|_| format != FORMAT) {
            self.fault(
                node.at,
                phrase!(
                    "file.this_is_not_the_format",
                    "This is not the format {FORMAT}. Export it again with this rrp."
                ),
            );
        }
        let id = fields.maybe_text(self, "id");
        if let (Some(id), Some(node)) = (&id, fields.get("id")) {
            self.check_id(node.at, id);
        }
        let name = fields.text(self, "name");
        self.check_name(root.at, &name);
        let file = BehaviourFile {
            format,
            id,
            name,
            robot: fields.maybe_text(self, "robot"),
            engine: fields.get("engine").map(|node| self.engine(node)),
            exercise: self.exercise(&fields),
            tags: self.tags(&fields),
            helpers: self.each(&fields, "helpers", HELPERS_MAX, Self::helper),
            streams: self.each(&fields, "streams", STREAMS_MAX, Self::stream),
            connectors: self.each(&fields, "connectors", CONNECTORS_MAX, Self::connector),
            notes: self.maybe_each(&fields, "notes", NOTES_MAX, Self::note),
            groups: self.maybe_each(&fields, "groups", GROUPS_MAX, Self::group),
            pad: fields.get("pad").map(|_| self.each(&fields, "pad", usize::from(*TILE_KEYS.end()), Self::tile)),
            order: self.entries(&fields, "order", Self::whole),
            layout: self.entries(&fields, "layout", Self::place),
        };
        self.check_order(&fields, &file);
        self.check_groups(&fields, &file);
        self.check_keys(&fields, &file);
        file
    }

    fn each<T>(
        &mut self,
        fields: &ShapeFields,
        name: &str,
        most: usize,
        read: fn(&mut Self, &FileNode) -> T,
    ) -> Vec<T> {
        let items = fields.list(self, name);
        if let (Some(node), true) = (fields.get(name), items.len() > most) {
            self.fault(
                node.at,
                phrase!(
                    "file.are_too_many_a_file",
                    "{} {name} are too many: a file may have {most}. Split it.",
                    items.len()
                ),
            );
            return Vec::new();
        }
        items.iter().map(|item| read(self, item)).collect()
    }

    fn maybe_each<T>(
        &mut self,
        fields: &ShapeFields,
        name: &str,
        most: usize,
        read: fn(&mut Self, &FileNode) -> T,
    ) -> Vec<T> {
        if fields.get(name).is_some() { self.each(fields, name, most, read) } else { Vec::new() }
    }

    fn entries<T>(
        &mut self,
        fields: &ShapeFields,
        name: &str,
        read: fn(&mut Self, &FileNode) -> T,
    ) -> BTreeMap<String, T> {
        match fields.get(name).map(|node| (&node.what, node.at)) {
            Some((NodeKind::Object(entries), _)) => {
                entries.iter().map(|(id, node)| (without_control(id, ' ').into_owned(), read(self, node))).collect()
            }
            Some((NodeKind::Array(_) | NodeKind::Plain(_), at)) => {
                self.fault(
                    at,
                    phrase!(
                        "file.must_be_an_object_with",
                        "“{name}” must be an object with an id before each of its values."
                    ),
                );
                BTreeMap::new()
            }
            None => BTreeMap::new(),
        }
    }

    fn engine(&mut self, node: &FileNode) -> Engine {
        if node.value().as_text() == Some("event") {
            return Engine::Event;
        }
        let fields = ShapeFields::of(self, node, word!("file.a_engine", "an engine"), "frame");
        let Some(frame) = fields.get("frame") else {
            self.fault(
                node.at,
                phrase!(
                    "file.the_engine_must_be_event",
                    "The engine must be \"event\", or an object with \"frame\" and its \"frameMs\"."
                ),
            );
            return Engine::Event;
        };
        let fields = ShapeFields::of(self, frame, word!("file.a_frame", "a frame"), "frameMs");
        let frame_ms = fields.count(self, "frameMs").unwrap_or_default();
        if !FRAME_MS.contains(&frame_ms) {
            self.fault(frame.at, phrase!("file.a_frame_must_have_1", "A frame must have 1 to 1000 milliseconds."));
        }
        Engine::Frame { frame_ms }
    }

    fn exercise(&mut self, fields: &ShapeFields) -> Option<String> {
        let exercise = fields.maybe_text(self, "exercise")?;
        self.check_name(fields.at("exercise"), &exercise);
        Some(exercise)
    }

    fn tags(&mut self, fields: &ShapeFields) -> Vec<String> {
        let tags = fields.texts(self, "tags").unwrap_or_default();
        if tags.len() > TAGS_MAX {
            let reason = phrase!(
                "file.tags_are_too_many_a",
                "{} tags are too many: a file may have {TAGS_MAX}. Leave some out.",
                tags.len()
            );
            self.fault(fields.at("tags"), reason);
        }
        for many in tags.iter().map(|tag| tag.chars().count()).filter(|many| *many > TAG_MAX_CHARS) {
            let reason = phrase!(
                "file.a_tag_has_characters_and",
                "A tag has {many} characters, and {TAG_MAX_CHARS} fit. Shorten it."
            );
            self.fault(fields.at("tags"), reason);
        }
        tags
    }

    fn helper(&mut self, node: &FileNode) -> FileHelper {
        let fields =
            ShapeFields::of(self, node, word!("file.a_helper", "a helper"), "name params body says takes gives");
        let name = fields.text(self, "name");
        self.check_identifier(node.at, &name);
        self.check_name(node.at, &name);
        if self.helpers.insert(name.clone(), self.lines.place(node.at)).is_some() {
            self.fault(
                node.at,
                phrase!("file.there_are_two_helpers_leave", "There are two helpers “{}”. Leave one out.", short(&name)),
            );
        }
        let params = fields.names(self, "params").unwrap_or_default();
        let says = fields.maybe_text(self, "says").unwrap_or_default();
        let takes = fields.texts(self, "takes").unwrap_or_default();
        let takes: Vec<_> = takes.iter().map(|word| self.declared(fields.at("takes"), word)).collect();
        if takes.len() > params.len() {
            let reason = phrase!(
                "file.it_takes_values_and_has",
                "It takes {} values and has {} parameters. Leave some out.",
                takes.len(),
                params.len()
            );
            self.fault(fields.at("takes"), reason);
        }
        let gives = fields.maybe_text(self, "gives");
        let gives = gives.map_or(Declared::Auto, |word| self.declared(fields.at("gives"), &word));
        FileHelper { name, params, body: fields.text(self, "body"), says, takes, gives }
    }

    fn declared(&mut self, at: usize, word: &str) -> Declared {
        Declared::of_word(word).unwrap_or_else(|| {
            let known: Vec<_> = Declared::all().into_iter().map(Declared::word).collect();
            self.fault(
                at,
                phrase!(
                    "file.a_helper_takes_or_gives",
                    "A helper takes or gives no “{}”. Write one of {}.",
                    short(word),
                    known.join(", ")
                ),
            );
            Declared::Auto
        })
    }

    fn stream(&mut self, node: &FileNode) -> FileStream {
        let fields = ShapeFields::of(
            self,
            node,
            word!("file.a_stream", "a stream"),
            "id kind name device params resources priority holdMs",
        );
        let (id, name) = (self.own_id(node, &fields), fields.text(self, "name"));
        self.check_name(node.at, &name);
        FileStream {
            id,
            kind: self.kind(&fields),
            name,
            device: fields.maybe_text(self, "device"),
            // None and none at all mean the same.
            params: Some(fields.params(self)).filter(|params| !params.is_empty()),
            resources: fields.texts(self, "resources"),
            priority: fields.maybe_whole(self, "priority"),
            hold_ms: fields.count(self, "holdMs"),
        }
    }

    fn kind(&mut self, fields: &ShapeFields) -> StreamKind {
        match fields.text(self, "kind").as_str() {
            "sensor" => StreamKind::Sensor,
            "ordinary" => StreamKind::Ordinary,
            "actuator" => StreamKind::Actuator,
            other => {
                let at = fields.at("kind");
                self.fault(
                    at,
                    phrase!(
                        "file.a_stream_is_a_sensor",
                        "A stream is a sensor, ordinary or an actuator, not “{}”.",
                        short(other)
                    ),
                );
                StreamKind::Ordinary
            }
        }
    }

    fn connector(&mut self, node: &FileNode) -> FileConnector {
        let fields = ShapeFields::of(
            self,
            node,
            word!("file.a_connector", "a connector"),
            "id type inputs output body args helper periodMs start",
        );
        let connector = FileConnector {
            id: self.own_id(node, &fields),
            operation: fields.text(self, "type"),
            inputs: fields.texts(self, "inputs").unwrap_or_else(|| self.missing(node.at, "inputs")),
            output: fields.text(self, "output"),
            body: fields.maybe_text(self, "body"),
            args: fields.names(self, "args"),
            helper: fields.maybe_text(self, "helper"),
            period_ms: fields.count(self, "periodMs"),
            start: fields.value(self, "start"),
        };
        self.check_connector(&fields, &connector);
        connector
    }

    fn check_connector(&mut self, fields: &ShapeFields, connector: &FileConnector) {
        let word = short(&connector.operation);
        let Some(spec) = connectors::spec(&word) else {
            let known = connectors::in_words(connectors::words(|_| true));
            return self.fault(
                fields.at("type"),
                phrase!("file.there_is_no_connector_use", "There is no connector “{word}”. Use {known}."),
            );
        };
        for name in ["body", "args", "helper", "periodMs", "start"] {
            if fields.get(name).is_some() && spec.fields().all(|known| known != name) {
                self.fault(
                    fields.at(name),
                    phrase!("file.takes_no_leave_it_out", "“{word}” takes no {name}. Leave it out."),
                );
            }
        }
        if connector.helper.is_some() && (connector.body.is_some() || connector.args.is_some()) {
            self.fault(
                fields.at("helper"),
                phrase!("file.it_has_both_a_helper", "It has both a helper and a body. Leave one out."),
            );
        }
        if connector.args.is_some() && connector.body.is_none() {
            self.fault(
                fields.at("args"),
                phrase!("file.it_has_args_but_no", "It has args, but no body to use them. Add one, or leave args out."),
            );
        }
        let has_period = connector.period_ms.is_some_and(|period| RATE_MS.contains(&period));
        if spec.takes.period.is_some() && !has_period {
            let reason =
                phrase!("file.a_needs_a_period_from", "A {word} needs a period from 1 to 3,600,000 milliseconds.");
            self.fault(fields.at("periodMs"), reason);
        }
    }

    fn note(&mut self, node: &FileNode) -> FileNote {
        let fields = ShapeFields::of(self, node, word!("file.a_note", "a note"), "id text by at");
        let by = fields.maybe_text(self, "by");
        self.check_name(fields.at("by"), by.as_deref().unwrap_or_default());
        FileNote { id: self.own_id(node, &fields), text: fields.text(self, "text"), by, at: fields.count(self, "at") }
    }

    fn group(&mut self, node: &FileNode) -> FileGroup {
        let fields = ShapeFields::of(self, node, word!("file.a_group", "a group"), "id title streams folded");
        let (id, title) = (self.own_id(node, &fields), fields.text(self, "title"));
        self.check_name(node.at, &title);
        let streams = fields.texts(self, "streams").unwrap_or_else(|| self.missing(node.at, "streams"));
        if streams.len() > STREAMS_MAX {
            let many = streams.len();
            self.fault(
                node.at,
                phrase!(
                    "file.streams_are_too_many_a",
                    "{many} streams are too many: a group may have {STREAMS_MAX}. Leave some out."
                ),
            );
        }
        streams.iter().for_each(|stream| self.check_id(fields.at("streams"), stream));
        FileGroup { id, title, streams, folded: fields.truth(self, "folded") }
    }

    fn tile(&mut self, node: &FileNode) -> FileTile {
        let fields = ShapeFields::of(
            self,
            node,
            word!("file.a_tile", "a tile"),
            "key label device params stream value word span asks",
        );
        let (key, stream) = (fields.count(self, "key"), fields.maybe_text(self, "stream"));
        stream.iter().for_each(|stream| self.check_id(fields.at("stream"), stream));
        let tile = FileTile {
            key: key.and_then(|key| u8::try_from(key).ok()).unwrap_or_default(),
            label: fields.text(self, "label"),
            device: fields.maybe_text(self, "device"),
            params: Some(fields.params(self)).filter(|params| !params.is_empty()),
            stream,
            value: fields.value(self, "value"),
            word: fields.maybe_text(self, "word"),
            span: fields.truth(self, "span").filter(|span| *span),
            asks: fields.truth(self, "asks").filter(|asks| *asks),
        };
        for name in [&tile.label].into_iter().chain(&tile.device).chain(&tile.word) {
            self.check_name(node.at, name);
        }
        if !TILE_KEYS.contains(&tile.key) {
            self.fault(fields.at("key"), phrase!("file.a_tile_has_a_key", "A tile has a key from 1 to 9. Choose one."));
        }
        if tile.word.is_some() && tile.asks.is_some() {
            self.fault(
                fields.at("asks"),
                phrase!("file.a_word_is_marked_at", "A word is marked at once and cannot ask first. Leave that out."),
            );
        } else if tile.action().is_none() {
            let reason =
                phrase!("file.a_tile_is_an_action", "A tile is an action, a sense or a word. Keep one of them.");
            self.fault(node.at, reason);
        }
        tile
    }

    fn whole(&mut self, node: &FileNode) -> i64 {
        fields::whole(self, node, "order").unwrap_or_default()
    }

    fn place(&mut self, node: &FileNode) -> Place {
        let fields = ShapeFields::of(self, node, word!("file.a_place", "a place"), "x y");
        let mut number = |name: &str| {
            let found = fields.get(name).and_then(|node| node.value().as_number());
            found.unwrap_or_else(|| {
                self.fault(
                    fields.at(name),
                    phrase!("file.must_be_a_number_such", "“{name}” must be a number, such as 12 or 0.5."),
                );
                0.0
            })
        };
        Place { x: number("x"), y: number("y") }
    }

    /// An id, of which there is one.
    fn own_id(&mut self, node: &FileNode, fields: &ShapeFields) -> String {
        let id = fields.text(self, "id");
        self.check_id(fields.at("id"), &id);
        self.remember(node.at, &id);
        id
    }

    fn remember(&mut self, at: usize, name: &str) {
        let before = self.places.insert(name.to_owned(), self.lines.place(at));
        if before.is_some() && Id::new(name).is_ok() {
            self.fault(
                at,
                phrase!("file.is_used_twice_give_one", "“{name}” is used twice. Give one of the two another id."),
            );
        }
    }

    fn check_id(&mut self, at: usize, id: &str) {
        if Id::new(id).is_err() {
            let reason =
                phrase!("file.is_no_id_use_1", "“{}” is no id: use 1 to 64 letters, digits, - or _.", short(id));
            self.fault(at, reason);
        }
    }

    fn check_identifier(&mut self, at: usize, name: &str) {
        if !is_identifier(name) {
            let reason = phrase!(
                "file.cannot_be_used_in_a",
                "“{}” cannot be used in a body. Use letters, digits and _ only.",
                short(name)
            );
            self.fault(at, reason);
        }
    }

    fn check_name(&mut self, at: usize, name: &str) {
        let many = name.chars().count();
        if many > NAME_MAX_CHARS {
            self.fault(
                at,
                phrase!(
                    "file.a_name_has_characters_and",
                    "A name has {many} characters, and {NAME_MAX_CHARS} fit. Shorten it."
                ),
            );
        }
    }

    fn check_length(&mut self, at: usize, text: &str) {
        if text.len() > TEXT_MAX_BYTES {
            self.fault(
                at,
                phrase!(
                    "file.a_text_has_bytes_and",
                    "A text has {} bytes, and {TEXT_MAX_BYTES} fit. Shorten it.",
                    text.len()
                ),
            );
        }
    }

    /// Order names things that are there, and tells the same as their position.
    fn check_order(&mut self, fields: &ShapeFields, file: &BehaviourFile) {
        let Some(NodeKind::Object(entries)) = fields.get("order").map(|node| &node.what) else { return };
        let streams = file.streams.iter().map(|stream| stream.id.as_str());
        let connectors = file.connectors.iter().map(|connector| connector.id.as_str());
        let all: HashSet<&str> = streams.chain(connectors).collect();
        for (id, node) in entries.iter().filter(|(id, _)| !all.contains(id.as_str())) {
            self.fault(
                node.at,
                phrase!(
                    "file.there_is_no_stream_or",
                    "There is no stream or connector “{}”. Leave its order out.",
                    short(id)
                ),
            );
        }
    }

    /// A stream is in one group at most.
    fn check_groups(&mut self, fields: &ShapeFields, file: &BehaviourFile) {
        let mut seen: HashMap<&str, &str> = HashMap::new();
        for (group, stream) in file.groups.iter().flat_map(|group| group.streams.iter().map(move |id| (group, id))) {
            if seen.insert(stream, &group.id).is_some_and(|other| other != group.id) {
                let reason = phrase!(
                    "file.is_in_two_groups_leave",
                    "“{}” is in two groups. Leave it out of one.",
                    short(stream)
                );
                self.fault(fields.at("groups"), reason);
            }
        }
    }

    /// Every tile has a key of its own.
    fn check_keys(&mut self, fields: &ShapeFields, file: &BehaviourFile) {
        let mut seen = HashSet::new();
        for tile in file.pad.iter().flatten() {
            if !seen.insert(tile.key) {
                self.fault(
                    fields.at("pad"),
                    phrase!(
                        "file.two_tiles_have_the_key",
                        "Two tiles have the key {}. Give one another key.",
                        tile.key
                    ),
                );
            }
        }
    }

    fn missing<T: Default>(&mut self, at: usize, name: &str) -> T {
        self.fault(at, phrase!("file.is_missing_add_it", "“{name}” is missing. Add it."));
        T::default()
    }
}

/// A name as it fits into a sentence.
fn short(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(40).collect()
}
