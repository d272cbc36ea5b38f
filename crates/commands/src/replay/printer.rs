//! What a replay prints: a JSON line for every command, and for whatever else is asked for.

use super::ReplayArgs;
use behaviour::{BehaviourFile, Id, StreamKind, Value};
use engine::{Claim, Emission, Precedence, StreamIx};
use robot::{Millis, Use};
use std::io::Write;

/// Chooses what is printed and turns it into lines.
pub(super) struct Printer<'a> {
    args: &'a ReplayArgs,
    files: &'a [BehaviourFile],
    /// By behaviour and stream.
    claims: Vec<Vec<Claim>>,
    parts: Precedence,
    lines: String,
}

impl<'a> Printer<'a> {
    /// For these behaviours, the upper one first.
    pub(super) fn new(args: &'a ReplayArgs, files: &'a [BehaviourFile]) -> Self {
        let claims = files.iter().map(|file| file.streams.iter().map(Claim::of).collect()).collect();
        Self { args, files, claims, parts: Precedence::default(), lines: String::new() }
    }

    /// Takes what a behaviour emits.
    pub(super) fn print(&mut self, number: usize, emission: &Emission) {
        match *emission {
            Emission::Value { at, stream, value, .. } => self.print_value(number, at, stream, value),
            Emission::Fault { at, connector, error, .. } if self.args.errors => {
                let id = quoted(&self.files[number].connectors[connector.index()].id);
                self.line(number, at, &format!("\"connector\":{id},\"error\":{}", quoted(&error.to_string())));
            }
            Emission::Fault { .. } => {}
        }
    }

    /// A behaviour ended by itself at a stream.
    pub(super) fn print_end(&mut self, number: usize, at: Millis, stream: StreamIx, reason: &str) {
        if self.args.errors {
            let id = quoted(&self.files[number].streams[stream.index()].id);
            self.line(number, at, &format!("\"stream\":{id},\"error\":{}", quoted(reason)));
        }
    }

    fn print_value(&mut self, number: usize, at: Millis, stream: StreamIx, value: &Value) {
        let info = &self.files[number].streams[stream.index()];
        let command = info.kind == StreamKind::Actuator;
        if !command && !self.args.probe {
            return;
        }
        let mut rest = format!("\"stream\":{},\"value\":{}", quoted(&info.id), json(value));
        if command && self.args.arbitrate {
            rest.push_str(&self.held(number, at, stream));
        }
        self.line(number, at, &rest);
    }

    /// Who keeps a command from its parts, as the rest of its line; nothing if nobody does.
    fn held(&mut self, number: usize, at: Millis, stream: StreamIx) -> String {
        let Some(by) = user(number, stream) else { return String::new() };
        let claim = &self.claims[number][stream.index()];
        let Err(held) = self.parts.command(at, &by, claim, |one, other| one < other) else { return String::new() };
        let holder = usize::try_from(held.by.run).ok().and_then(|number| self.files.get(number));
        let at = held.by.stream.as_str().parse::<usize>().ok();
        let id = holder.zip(at).map_or("", |(file, at)| file.streams[at].id.as_str());
        let whose = if self.files.len() > 1 { format!(",\"heldBy\":{}", held.by.run + 1) } else { String::new() };
        format!(",\"suppressedBy\":{}{whose}", quoted(id))
    }

    fn line(&mut self, number: usize, at: Millis, rest: &str) {
        let whose = if self.files.len() > 1 { format!("\"behaviour\":{},", number + 1) } else { String::new() };
        self.lines.push_str(&format!("{{\"t\":{},{whose}{rest}}}\n", at.0));
    }

    /// Hands on what was gathered.
    pub(super) fn write(&mut self, to: &mut dyn Write) -> std::io::Result<()> {
        let written = to.write_all(self.lines.as_bytes());
        self.lines.clear();
        written
    }
}

/// A stream as a use of the robot: by numbers, since ids of files may be any text.
fn user(number: usize, stream: StreamIx) -> Option<Use> {
    Some(Use { run: number as u64, stream: Id::new(&stream.index().to_string()).ok()? })
}

/// A value as JSON: floats bit for bit, whole numbers without a point.
fn json(value: &Value) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// A text as JSON.
fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}
