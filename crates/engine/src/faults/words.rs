//! Every fault in plain words, and what to do about it.

use super::plain::plain;
use super::{BodyFault, CallFault, GraphFault, Misuse, Reason, RunFault, TextPlace, TrialFault, ValueFault, ValueKind};
use behaviour::connectors::{self, Inputs};
use behaviour::{AsMeant, BODY_MAX_CHARS, Value, has_unseen};
use phrase::{Phrase, Phrased, phrase};

phrase::shown!(GraphFault, Reason, RunFault, TrialFault, BodyFault, Misuse, CallFault, ValueFault, ValueKind);

/// The longest value that a sentence shows, in characters.
const SHOWN_MAX_CHARS: usize = 40;

impl Phrased for GraphFault {
    fn phrase(&self) -> Phrase {
        phrase!("fault_at", "{id}: {reason}", id = self.id, reason = self.reason)
    }
}

impl Phrased for Reason {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Flaw(flaw) => flaw.phrase(),
            Self::FrameLength => phrase!("Reason.FrameLength", "a frame has 1 to 1000 milliseconds"),
            Self::Inputs { word, takes, gets } => phrase!(
                "Reason.Inputs",
                "{word} takes {inputs}, not {gets}",
                word = connectors::named(word),
                inputs = inputs(*takes)
            ),
            Self::InputTwice(id) => phrase!("Reason.InputTwice", "the input {id} is there twice"),
            Self::OutOfActuator(id) => {
                phrase!("Reason.OutOfActuator", "nothing can come out of the actuator stream {id}")
            }
            Self::IntoSensor(id) => phrase!("Reason.IntoSensor", "nothing can lead into the sensor stream {id}"),
            Self::OnlySubscribe(id) => {
                phrase!("Reason.OnlySubscribe", "only subscribe leads into the actuator stream {id}")
            }
            Self::NoActuator(word, id) => phrase!(
                "Reason.NoActuator",
                "{word} must lead to an actuator stream, and {id} is none",
                word = connectors::named(word)
            ),
            Self::SecondInput(id) => phrase!("Reason.SecondInput", "the stream {id} already has an incoming connector"),
            Self::Circle => phrase!("Reason.Circle", "values would flow in a circle through it"),
            Self::NoHelper(name) => phrase!("Reason.NoHelper", "there is no helper “{name}”"),
            Self::HelperInputs { helper, takes, gets } => {
                phrase!("Reason.HelperInputs", "the helper “{helper}” takes {takes} values, but gets {gets}")
            }
            Self::Arguments { names, inputs } => {
                phrase!("Reason.Arguments", "it names {names} arguments for {inputs} inputs")
            }
            Self::NameTwice => phrase!("Reason.NameTwice", "this name is used twice"),
            Self::CallsItself(name) => {
                phrase!("Reason.CallsItself", "the helper “{name}” calls itself, perhaps through others")
            }
            Self::Body(fault) => fault.phrase(),
        }
    }
}

fn inputs(takes: Inputs) -> Phrase {
    match takes {
        Inputs::One => phrase!("Inputs.One", "exactly one input"),
        Inputs::OneOrMore => phrase!("Inputs.OneOrMore", "one input or more"),
        Inputs::TwoOrMore => phrase!("Inputs.TwoOrMore", "two inputs or more"),
    }
}

impl Phrased for RunFault {
    fn phrase(&self) -> Phrase {
        let Self::Multiplied(name) = self;
        phrase!(
            "RunFault.Multiplied",
            "values multiply at “{name}”: one reading became more than 100,000 values; lead fewer ways of the same \
             stream together there, or put a sample before it"
        )
    }
}

impl Phrased for TrialFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Inputs { takes, gets } => phrase!("TrialFault.Inputs", "it takes {takes} values, but gets {gets}"),
            Self::Helpers(faults) => faults.first().map(Phrased::phrase).unwrap_or_default(),
            Self::Body(fault) => fault.phrase(),
            Self::Call(fault) => fault.phrase(),
        }
    }
}

impl Phrased for BodyFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Empty => phrase!("BodyFault.Empty", "it has no procedure yet"),
            Self::TooLong => phrase!("BodyFault.TooLong", "it is longer than {BODY_MAX_CHARS} characters"),
            Self::Blocks(most) => {
                phrase!("BodyFault.Blocks", "it has more than {most} blocks {{ }} in a row; move a part into a helper")
            }
            Self::Name(name) => phrase!("BodyFault.Name", "“{name}” cannot be a name in a procedure"),
            Self::NameTwice(name) => phrase!("BodyFault.NameTwice", "two arguments have the name “{name}”"),
            Self::Functions => {
                phrase!("BodyFault.Functions", "a procedure cannot define functions; add a helper for it")
            }
            Self::Syntax(syntax) => syntax.phrase(),
            Self::LooksRight(meant) => looks_right(meant),
            Self::Misuse(at, misuse) => at.of(misuse.phrase()),
        }
    }
}

fn looks_right(meant: &[AsMeant]) -> Phrase {
    let Some(AsMeant { from, to: means, .. }) = meant.first() else { return Phrase::default() };
    if let Some(AsMeant { to: other, .. }) = meant.get(1) {
        phrase!("BodyFault.EitherMeant", "“{from}” may be {means} or {other}; write the one that is meant")
    } else if has_unseen(from) || from.trim().is_empty() {
        phrase!("BodyFault.Blank", "a blank in it is not a plain one; write it as a blank")
    } else {
        phrase!("BodyFault.Meant", "“{from}” means {means} here; write it so")
    }
}

impl Phrased for Misuse {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Refused(name) => phrase!("Misuse.Refused", "“{name}” cannot be used in a procedure"),
            Self::KeptClosure => {
                phrase!(
                    "Misuse.KeptClosure",
                    "a closure that uses a value around it can only be called or handed to a list"
                )
            }
            Self::Captures(most) => phrase!("Misuse.Captures", "a closure can use at most {most} values around it"),
            Self::ClosureValues(most) => {
                phrase!("Misuse.ClosureValues", "a closure can be called with at most {most} values")
            }
            Self::HelperValues(name, many) => {
                phrase!("Misuse.HelperValues", "there is no helper “{name}” that takes {many} values")
            }
        }
    }
}

impl TextPlace {
    /// Says where it is, and what is wrong there.
    pub(super) fn of(self, fault: Phrase) -> Phrase {
        match (self.line, self.column) {
            (Some(1), Some(column)) => phrase!("TextPlace.Column", "at character {column}: {fault}"),
            (Some(line), Some(column)) => phrase!("TextPlace.Both", "line {line}, character {column}: {fault}"),
            (Some(line), None) => phrase!("TextPlace.Line", "line {line}: {fault}"),
            (None, _) => fault,
        }
    }
}

impl Phrased for CallFault {
    fn phrase(&self) -> Phrase {
        let fault = happened(self);
        match advice(self) {
            Some(advice) => phrase!("CallFault", "{fault}; {advice}"),
            None => fault,
        }
    }
}

fn happened(fault: &CallFault) -> Phrase {
    use CallFault as F;
    match fault {
        F::InHelper(name, inner) => phrase!("CallFault.InHelper", "in the helper “{name}”: {inner}"),
        F::Said(text) | F::Arithmetic(text) | F::Field(text) | F::Rhai(text) => Phrase::Text(plain(text)),
        F::Thrown(value) => Phrase::Text(plain(&value.to_string())),
        F::ByZero => phrase!("CallFault.ByZero", "division by zero has no result"),
        F::Overflow => phrase!("CallFault.Overflow", "a whole number became too large"),
        F::NoField(name) => phrase!("CallFault.NoField", "there is no field “{name}” in this object"),
        F::NoFieldOf(kind, name) => phrase!("CallFault.NoFieldOf", "{kind} has no field “{name}”"),
        F::NoFunction(signature) => no_function(signature),
        F::Mismatch(wanted, got) => phrase!("CallFault.Mismatch", "{wanted} is needed here, not {got}"),
        F::NoParts(kind) => phrase!("CallFault.NoParts", "{kind} has no parts to take with [ ]"),
        F::NoItem(many, at) => phrase!("CallFault.NoItem", "there is no item {at} in a list of {many}"),
        F::NoLetter(many, at) => phrase!("CallFault.NoLetter", "there is no letter {at} in a text of {many}"),
        F::NoValue(name) => phrase!("CallFault.NoValue", "no “{name}” here"),
        F::NotIterable => phrase!("CallFault.NotIterable", "for goes through a list, a text or a range only"),
        F::Interrupted => phrase!("CallFault.Interrupted", "it took too long and was ended"),
        F::Steps => phrase!("CallFault.Steps", "it takes too many steps"),
        F::Nested => phrase!("CallFault.Nested", "calls are nested too deep"),
        F::TooLarge => phrase!("CallFault.TooLarge", "a text, list or object became too large"),
        F::Variables => phrase!("CallFault.Variables", "it has too many variables"),
        F::Value(fault) => fault.phrase(),
        F::Broken => phrase!("CallFault.Broken", "it broke the procedure language"),
        F::Unread(fault) => fault.phrase(),
        F::NoTruth(value) => {
            phrase!("CallFault.NoTruth", "a filter must answer true or false, not {value}", value = shortened(value))
        }
        F::Waiting => phrase!("CallFault.Waiting", "more than 10,000 values wait"),
    }
}

/// Says how to mend it, where that can be said.
fn advice(fault: &CallFault) -> Option<Phrase> {
    use CallFault as F;
    Some(match fault {
        F::ByZero => phrase!("advice.ByZero", "check first that the number is not 0"),
        F::Overflow => phrase!("advice.Overflow", "use a measured number, such as 1.0"),
        F::NoField(_) | F::NoValue(_) => phrase!("advice.Name", "check how its name is written"),
        F::NoFieldOf(..) | F::Field(_) => phrase!("advice.Field", "take fields of objects only"),
        F::NoFunction(signature) if is_operator(signature) => {
            phrase!("advice.Operator", "take a field or an item of the right kind")
        }
        F::NoFunction(_) => phrase!("advice.NoFunction", "check its name and what it is given"),
        F::Mismatch(..) => phrase!("advice.Mismatch", "change what stands here"),
        F::NoParts(_) => phrase!("advice.NoParts", "take parts of lists, objects and texts only"),
        F::NoItem(..) | F::NoLetter(..) => phrase!("advice.Length", "ask for its length first, and count from 0"),
        F::NotIterable => phrase!("advice.NotIterable", "give it one of these"),
        F::Interrupted => phrase!("advice.Interrupted", "let it do less for one value"),
        F::Steps => phrase!("advice.Steps", "look for a loop without an end, or use smaller lists and texts"),
        F::Nested => phrase!("advice.Nested", "let fewer helpers and closures call each other"),
        F::TooLarge => phrase!("advice.TooLarge", "keep only what is needed of it"),
        F::Variables => phrase!("advice.Variables", "move a part into a helper"),
        F::Broken => phrase!("advice.Broken", "write it another way"),
        F::Waiting => phrase!("advice.Waiting", "put a sample before it, or let it wait for less time"),
        _ => return None,
    })
}

/// From a signature such as `- (map, i64)` or `distanc (f64)`.
fn no_function(signature: &str) -> Phrase {
    let (name, kinds) = signature.split_once(" (").unwrap_or((signature, ""));
    let kinds = kinds.trim_end_matches(')').split(", ").filter(|kind| !kind.is_empty());
    let kinds: Vec<ValueKind> = kinds.map(ValueKind::of).collect();
    let operator = is_operator(signature);
    match kinds.as_slice() {
        [left, right] if operator => {
            phrase!("CallFault.NotCombined", "{left} and {right} cannot be combined with {name}")
        }
        [one] if operator => phrase!("CallFault.NotOn", "{name} does not work on {one}"),
        [] => phrase!("CallFault.NoFunction", "there is no function “{name}”"),
        [one] => phrase!("CallFault.NoFunctionOf", "there is no function “{name}” of {kinds}", kinds = one),
        [one, others @ ..] => {
            let and = |made: Phrase, kind: &ValueKind| phrase!("CallFault.And", "{made} and {kind}");
            let kinds = others.iter().fold(one.phrase(), and);
            phrase!("CallFault.NoFunctionOf", "there is no function “{name}” of {kinds}")
        }
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

impl Phrased for ValueFault {
    fn phrase(&self) -> Phrase {
        match self {
            Self::LongNames => {
                phrase!("ValueFault.LongNames", "the names in the result are too long; use shorter ones")
            }
            Self::NotANumber => {
                phrase!(
                    "ValueFault.NotANumber",
                    "the result is not a number (NaN); check what it divides or takes the root of"
                )
            }
            Self::Infinite => {
                phrase!("ValueFault.Infinite", "the result is an infinite number; check what it divides by")
            }
            Self::TooDeep => phrase!(
                "ValueFault.TooDeep",
                "the result is nested too deep; put fewer lists and objects into each other"
            ),
            Self::Kind(kind) => {
                phrase!(
                    "ValueFault.Kind",
                    "{kind} cannot flow in a stream; end with a number, a text, a list or an object"
                )
            }
        }
    }
}

impl Phrased for ValueKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Nothing => phrase!("ValueKind.Nothing", "nothing"),
            Self::Whole => phrase!("ValueKind.Whole", "a whole number"),
            Self::Measured => phrase!("ValueKind.Measured", "a measured number"),
            Self::Truth => phrase!("ValueKind.Truth", "true or false"),
            Self::Letter => phrase!("ValueKind.Letter", "a letter"),
            Self::Object => phrase!("ValueKind.Object", "an object"),
            Self::List => phrase!("ValueKind.List", "a list"),
            Self::Function => phrase!("ValueKind.Function", "a function"),
            Self::Text => phrase!("ValueKind.Text", "a text"),
            Self::Range => phrase!("ValueKind.Range", "a range"),
            Self::Other(name) => name.phrase(),
        }
    }
}
