//! Every fault in plain words, and what to do about it.

use super::plain::plain;
use super::{BodyFault, CallFault, GraphFault, Misuse, Reason, RunFault, TextPlace, TrialFault, ValueFault, ValueKind};
use behaviour::connectors::Inputs;
use behaviour::{AsMeant, BODY_MAX_CHARS, Value, has_unseen};
use std::fmt::{Display, Formatter, Result};

/// The longest value that a sentence shows, in characters.
const SHOWN_MAX_CHARS: usize = 40;

impl Display for GraphFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        write!(to, "{}: {}", self.id, self.reason)
    }
}

impl Display for Reason {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match self {
            Self::Flaw(flaw) => write!(to, "{flaw}"),
            Self::FrameLength => to.write_str("a frame has 1 to 1000 milliseconds"),
            Self::Inputs { word, takes, gets } => write!(to, "{word} takes {}, not {gets}", inputs(*takes)),
            Self::InputTwice(id) => write!(to, "the input {id} is there twice"),
            Self::OutOfActuator(id) => write!(to, "nothing can come out of the actuator stream {id}"),
            Self::IntoSensor(id) => write!(to, "nothing can lead into the sensor stream {id}"),
            Self::OnlySubscribe(id) => write!(to, "only subscribe leads into the actuator stream {id}"),
            Self::NoActuator(word, id) => write!(to, "{word} must lead to an actuator stream, and {id} is none"),
            Self::SecondInput(id) => write!(to, "the stream {id} already has an incoming connector"),
            Self::Circle => to.write_str("values would flow in a circle through it"),
            Self::NoHelper(name) => write!(to, "there is no helper “{name}”"),
            Self::HelperInputs { helper, takes, gets } => {
                write!(to, "the helper “{helper}” takes {takes} values, but gets {gets}")
            }
            Self::Arguments { names, inputs } => write!(to, "it names {names} arguments for {inputs} inputs"),
            Self::NameTwice => to.write_str("this name is used twice"),
            Self::CallsItself(name) => write!(to, "the helper “{name}” calls itself, perhaps through others"),
            Self::Body(fault) => write!(to, "{fault}"),
        }
    }
}

fn inputs(takes: Inputs) -> &'static str {
    match takes {
        Inputs::One => "exactly one input",
        Inputs::OneOrMore => "one input or more",
        Inputs::TwoOrMore => "two inputs or more",
    }
}

impl Display for RunFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        let Self::Multiplied(name) = self;
        write!(
            to,
            "values multiply at “{name}”: one reading became more than 100,000 values; lead fewer ways of the same \
             stream together there, or put a sample before it"
        )
    }
}

impl Display for TrialFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match self {
            Self::Inputs { takes, gets } => write!(to, "it takes {takes} values, but gets {gets}"),
            Self::Helpers(faults) => faults.first().map_or(Ok(()), |first| write!(to, "{first}")),
            Self::Body(fault) => write!(to, "{fault}"),
            Self::Call(fault) => write!(to, "{fault}"),
        }
    }
}

impl Display for BodyFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match self {
            Self::Empty => to.write_str("it has no procedure yet"),
            Self::TooLong => write!(to, "it is longer than {BODY_MAX_CHARS} characters"),
            Self::Blocks(most) => {
                write!(to, "it has more than {most} blocks {{ }} in a row; move a part into a helper")
            }
            Self::Name(name) => write!(to, "“{name}” cannot be a name in a procedure"),
            Self::NameTwice(name) => write!(to, "two arguments have the name “{name}”"),
            Self::Functions => to.write_str("a procedure cannot define functions; add a helper for it"),
            Self::Syntax(syntax) => write!(to, "{syntax}"),
            Self::LooksRight(meant) => looks_right(meant, to),
            Self::Misuse(at, misuse) => write!(to, "{at}{misuse}"),
        }
    }
}

fn looks_right(meant: &[AsMeant], to: &mut Formatter) -> Result {
    let Some(AsMeant { from, to: means, .. }) = meant.first() else { return Ok(()) };
    if let Some(AsMeant { to: other, .. }) = meant.get(1) {
        write!(to, "“{from}” may be {means} or {other}; write the one that is meant")
    } else if has_unseen(from) || from.trim().is_empty() {
        to.write_str("a blank in it is not a plain one; write it as a blank")
    } else {
        write!(to, "“{from}” means {means} here; write it so")
    }
}

impl Display for Misuse {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match self {
            Self::Refused(name) => write!(to, "“{name}” cannot be used in a procedure"),
            Self::KeptClosure => {
                to.write_str("a closure that uses a value around it can only be called or handed to a list")
            }
            Self::Captures(most) => write!(to, "a closure can use at most {most} values around it"),
            Self::ClosureValues(most) => write!(to, "a closure can be called with at most {most} values"),
            Self::HelperValues(name, many) => write!(to, "there is no helper “{name}” that takes {many} values"),
        }
    }
}

impl Display for TextPlace {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match (self.line, self.column) {
            (Some(1), Some(column)) => write!(to, "at character {column}: "),
            (Some(line), Some(column)) => write!(to, "line {line}, character {column}: "),
            (Some(line), None) => write!(to, "line {line}: "),
            (None, _) => Ok(()),
        }
    }
}

impl Display for CallFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        happened(self, to)?;
        advice(self).map_or(Ok(()), |advice| write!(to, "; {advice}"))
    }
}

fn happened(fault: &CallFault, to: &mut Formatter) -> Result {
    use CallFault as F;
    match fault {
        F::InHelper(name, inner) => write!(to, "in the helper “{name}”: {inner}"),
        F::Said(text) | F::Arithmetic(text) | F::Field(text) | F::Rhai(text) => to.write_str(&plain(text)),
        F::Thrown(value) => to.write_str(&plain(&value.to_string())),
        F::ByZero => to.write_str("division by zero has no result"),
        F::Overflow => to.write_str("a whole number became too large"),
        F::NoField(name) => write!(to, "there is no field “{name}” in this object"),
        F::NoFieldOf(kind, name) => write!(to, "{kind} has no field “{name}”"),
        F::NoFunction(signature) => to.write_str(&no_function(signature)),
        F::Mismatch(wanted, got) => write!(to, "{wanted} is needed here, not {got}"),
        F::NoParts(kind) => write!(to, "{kind} has no parts to take with [ ]"),
        F::NoItem(many, at) => write!(to, "there is no item {at} in a list of {many}"),
        F::NoLetter(many, at) => write!(to, "there is no letter {at} in a text of {many}"),
        F::NoValue(name) => write!(to, "no “{name}” here"),
        F::NotIterable => to.write_str("for goes through a list, a text or a range only"),
        F::Interrupted => to.write_str("it took too long and was ended"),
        F::Steps => to.write_str("it takes too many steps"),
        F::Nested => to.write_str("calls are nested too deep"),
        F::TooLarge => to.write_str("a text, list or object became too large"),
        F::Variables => to.write_str("it has too many variables"),
        F::Value(fault) => write!(to, "{fault}"),
        F::Broken => to.write_str("it broke the procedure language"),
        F::Unread(fault) => write!(to, "{fault}"),
        F::NoTruth(value) => write!(to, "a filter must answer true or false, not {}", shortened(value)),
        F::Waiting => to.write_str("more than 10,000 values wait"),
    }
}

/// Says how to mend it, where that can be said.
fn advice(fault: &CallFault) -> Option<&'static str> {
    use CallFault as F;
    Some(match fault {
        F::ByZero => "check first that the number is not 0",
        F::Overflow => "use a measured number, such as 1.0",
        F::NoField(_) | F::NoValue(_) => "check how its name is written",
        F::NoFieldOf(..) | F::Field(_) => "take fields of objects only",
        F::NoFunction(signature) if is_operator(signature) => "take a field or an item of the right kind",
        F::NoFunction(_) => "check its name and what it is given",
        F::Mismatch(..) => "change what stands here",
        F::NoParts(_) => "take parts of lists, objects and texts only",
        F::NoItem(..) | F::NoLetter(..) => "ask for its length first, and count from 0",
        F::NotIterable => "give it one of these",
        F::Interrupted => "let it do less for one value",
        F::Steps => "look for a loop without an end, or use smaller lists and texts",
        F::Nested => "let fewer helpers and closures call each other",
        F::TooLarge => "keep only what is needed of it",
        F::Variables => "move a part into a helper",
        F::Broken => "write it another way",
        F::Waiting => "put a sample before it, or let it wait for less time",
        _ => return None,
    })
}

/// From a signature such as `- (map, i64)` or `distanc (f64)`.
fn no_function(signature: &str) -> String {
    let (name, kinds) = signature.split_once(" (").unwrap_or((signature, ""));
    let kinds = kinds.trim_end_matches(')').split(", ").filter(|kind| !kind.is_empty());
    let kinds: Vec<String> = kinds.map(|kind| ValueKind::of(kind).to_string()).collect();
    let operator = is_operator(signature);
    match kinds.as_slice() {
        [left, right] if operator => format!("{left} and {right} cannot be combined with {name}"),
        [one] if operator => format!("{name} does not work on {one}"),
        [] => format!("there is no function “{name}”"),
        kinds => format!("there is no function “{name}” of {}", kinds.join(" and ")),
    }
}

fn is_operator(signature: &str) -> bool {
    !signature.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

fn shortened(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= SHOWN_MAX_CHARS {
        return text;
    }
    text.chars().take(SHOWN_MAX_CHARS - 1).chain(['…']).collect()
}

impl Display for ValueFault {
    fn fmt(&self, to: &mut Formatter) -> Result {
        match self {
            Self::LongNames => to.write_str("the names in the result are too long; use shorter ones"),
            Self::NotANumber => {
                to.write_str("the result is not a number (NaN); check what it divides or takes the root of")
            }
            Self::Infinite => to.write_str("the result is an infinite number; check what it divides by"),
            Self::TooDeep => to.write_str("the result is nested too deep; put fewer lists and objects into each other"),
            Self::Kind(kind) => {
                write!(to, "{kind} cannot flow in a stream; end with a number, a text, a list or an object")
            }
        }
    }
}

impl Display for ValueKind {
    fn fmt(&self, to: &mut Formatter) -> Result {
        to.write_str(match self {
            Self::Nothing => "nothing",
            Self::Whole => "a whole number",
            Self::Measured => "a measured number",
            Self::Truth => "true or false",
            Self::Letter => "a letter",
            Self::Object => "an object",
            Self::List => "a list",
            Self::Function => "a function",
            Self::Text => "a text",
            Self::Range => "a range",
            Self::Other(name) => name,
        })
    }
}
