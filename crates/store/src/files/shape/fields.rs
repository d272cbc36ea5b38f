//! The fields of one thing: known, there, and of their kind.

use super::ShapeReader;
use crate::files::tree::{FileNode, NodeKind};
use behaviour::{Params, Value, without_control};
use phrase::{Phrased, Word, phrase};

/// The fields that people write lines into. In all others a line end would break a name or a procedure.
const LINES: [&str; 2] = ["text", "says"];

/// The fields of an object.
pub(super) struct ShapeFields<'n> {
    at: usize,
    /// False if it is no object, which is said already.
    whole: bool,
    all: &'n [(String, FileNode)],
}

impl<'n> ShapeFields<'n> {
    /// The fields of `node`, which must be an object with no other than the `known` ones.
    pub(super) fn of(to: &mut ShapeReader, node: &'n FileNode, what: Word, known: &str) -> Self {
        let what = what.phrase();
        let NodeKind::Object(all) = &node.what else {
            to.fault(
                node.at,
                phrase!(
                    "file.here_should_be_an_object",
                    "Here should be {what}: an object with {fields}.",
                    fields = known.replace(' ', ", ")
                ),
            );
            return Self { at: node.at, whole: false, all: &[] };
        };
        for (name, field) in all.iter().filter(|(name, _)| !known.split(' ').any(|one| one == name)) {
            let (name, known) = (super::short(name), known.replace(' ', ", "));
            to.fault(
                field.at,
                phrase!("file.is_not_known_here_has", "“{name}” is not known here; {what} has {known}. Leave it out."),
            );
        }
        Self { at: node.at, whole: true, all }
    }

    pub(super) fn get(&self, name: &str) -> Option<&'n FileNode> {
        self.all.iter().rev().find(|(known, _)| known == name).map(|(_, node)| node)
    }

    /// Returns the byte at which the field begins, or the whole if it is not there.
    pub(super) fn at(&self, name: &str) -> usize {
        self.get(name).map_or(self.at, |node| node.at)
    }

    /// A text that must be there.
    pub(super) fn text(&self, to: &mut ShapeReader, name: &str) -> String {
        if self.get(name).is_none() && self.whole {
            return to.missing(self.at, name);
        }
        self.maybe_text(to, name).unwrap_or_default()
    }

    /// A text, if it is there.
    pub(super) fn maybe_text(&self, to: &mut ShapeReader, name: &str) -> Option<String> {
        text(to, self.get(name)?, name)
    }

    /// A list that must be there.
    pub(super) fn list(&self, to: &mut ShapeReader, name: &str) -> &'n [FileNode] {
        let Some(node) = self.get(name) else {
            if self.whole {
                to.missing::<()>(self.at, name);
            }
            return &[];
        };
        let NodeKind::Array(items) = &node.what else {
            to.fault(node.at, phrase!("file.must_be_a_list", "“{name}” must be a list."));
            return &[];
        };
        items
    }

    /// A list of texts, if it is there.
    pub(super) fn texts(&self, to: &mut ShapeReader, name: &str) -> Option<Vec<String>> {
        self.get(name)?;
        Some(self.list(to, name).iter().filter_map(|item| text(to, item, name)).collect())
    }

    /// A list of names for bodies, if it is there.
    pub(super) fn names(&self, to: &mut ShapeReader, name: &str) -> Option<Vec<String>> {
        let names = self.texts(to, name)?;
        for one in &names {
            to.check_identifier(self.at(name), one);
        }
        Some(names)
    }

    /// A whole number, if it is there.
    pub(super) fn maybe_whole(&self, to: &mut ShapeReader, name: &str) -> Option<i64> {
        whole(to, self.get(name)?, name)
    }

    /// A whole number that is not negative, if it is there.
    pub(super) fn count(&self, to: &mut ShapeReader, name: &str) -> Option<u64> {
        let whole = self.maybe_whole(to, name)?;
        if whole < 0 {
            to.fault(self.at(name), phrase!("file.must_not_be_negative", "“{name}” must not be negative."));
        }
        u64::try_from(whole).ok()
    }

    /// True or false, if it is there.
    pub(super) fn truth(&self, to: &mut ShapeReader, name: &str) -> Option<bool> {
        let node = self.get(name)?;
        if let NodeKind::Plain(Value::Bool(truth)) = node.what {
            return Some(truth);
        }
        to.fault(node.at, phrase!("file.must_be_true_or_false", "“{name}” must be true or false."));
        None
    }

    /// Any value, if it is there; null and none at all mean the same.
    pub(super) fn value(&self, to: &mut ShapeReader, name: &str) -> Option<Value> {
        Some(value(to, self.get(name)?)).filter(|value| *value != Value::Null)
    }

    /// The parameters of a device; none if they are not there.
    pub(super) fn params(&self, to: &mut ShapeReader) -> Params {
        let Some(node) = self.get("params") else { return Params::new() };
        let NodeKind::Object(all) = &node.what else {
            to.fault(
                node.at,
                phrase!("file.params_must_be_an_object", "“params” must be an object of names and values."),
            );
            return Params::new();
        };
        all.iter().map(|(name, node)| (without_control(name, ' ').into_owned(), value(to, node))).collect()
    }
}

/// Any value, with texts that are not too long.
fn value(to: &mut ShapeReader, node: &FileNode) -> Value {
    let value = cleaned(node.value());
    let length = value.to_string().len();
    if length > crate::files::TEXT_MAX_BYTES {
        to.fault(node.at, phrase!("file.a_parameter_has_bytes_shorten", "A parameter has {length} bytes. Shorten it."));
    }
    value
}

/// The value with its texts as they are kept.
fn cleaned(value: Value) -> Value {
    match value {
        Value::Text(text) => Value::text(without_control(&text, '\n')),
        Value::List(items) => Value::list(items.iter().cloned().map(cleaned)),
        Value::Map(fields) => {
            let fields: Vec<_> =
                fields.iter().map(|(name, value)| (without_control(name, ' '), cleaned(value.clone()))).collect();
            Value::object(fields.iter().map(|(name, value)| (&**name, value.clone())))
        }
        other @ (Value::Null | Value::Bool(_) | Value::Int(_) | Value::Float(_)) => other,
    }
}

fn text(to: &mut ShapeReader, node: &FileNode, name: &str) -> Option<String> {
    if let NodeKind::Plain(Value::Text(text)) = &node.what {
        to.check_length(node.at, text);
        let line_end = if LINES.contains(&name) { '\n' } else { ' ' };
        return Some(without_control(text, line_end).into_owned());
    }
    to.fault(node.at, phrase!("file.must_be_a_text_in", "“{name}” must be a text in quotes."));
    None
}

pub(super) fn whole(to: &mut ShapeReader, node: &FileNode, name: &str) -> Option<i64> {
    if let NodeKind::Plain(Value::Int(whole)) = node.what {
        return Some(whole);
    }
    to.fault(node.at, phrase!("file.must_be_a_whole_number", "“{name}” must be a whole number."));
    None
}
