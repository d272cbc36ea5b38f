//! What a stream carries: its newest value says it, and before there is one, what makes it is looked at. Pure.

use behaviour::connectors::{Carries, Passes};
use behaviour::{Behaviour, Graph, Helper, Id, Procedure, Value, ValueType};
use robot::Shape;

/// How many connectors upwards are looked at.
const UPWARDS_MAX: usize = 32;

/// What a stream carries now. A value that is there says more than a guess, save whether it was felt.
pub(crate) fn carries(behaviour: &Behaviour, helpers: &[Helper], id: &Id, value: Option<&Value>) -> Carries {
    let guess = guess(behaviour, helpers, id);
    match value.and_then(of_value) {
        Some(Carries::Truth) if guess == Carries::Touch => guess,
        known => known.unwrap_or(guess),
    }
}

fn guess(behaviour: &Behaviour, helpers: &[Helper], id: &Id) -> Carries {
    let graph = Graph::of(behaviour);
    let mut at = id;
    for _ in 0..UPWARDS_MAX {
        let Some(stream) = behaviour.stream(at) else { break };
        if let Some(device) = &stream.device {
            return robot::device(stream.kind, device).map_or(Carries::Anything, |device| of_shape(&device.shape));
        }
        let Some((_, connector)) = graph.into_stream(at).first() else { break };
        match connector.operation.spec().passes {
            Passes::Result => {
                let text = connector.operation.procedure().and_then(|procedure| text_of(procedure, helpers));
                return text.map_or(Carries::Anything, of_text);
            }
            Passes::Other => return Carries::Anything,
            Passes::Same => {}
        }
        let Some(input) = connector.inputs.first() else { break };
        at = input;
    }
    Carries::Anything
}

/// The helper that made what a stream carries, as far as that only passed on since.
pub(crate) fn made_by<'a>(behaviour: &Behaviour, helpers: &'a [Helper], id: &Id) -> Option<&'a Helper> {
    let graph = Graph::of(behaviour);
    let mut at = id;
    for _ in 0..UPWARDS_MAX {
        let (_, connector) = graph.into_stream(at).first()?;
        match (connector.operation.spec().passes, connector.operation.procedure()) {
            (Passes::Result, Some(Procedure::Helper(name))) => {
                return helpers.iter().find(|helper| helper.name == *name);
            }
            (Passes::Same, _) => at = connector.inputs.first()?,
            (Passes::Result | Passes::Other, _) => return None,
        }
    }
    None
}

fn of_shape(shape: &Shape) -> Carries {
    let has = |name: &str| shape.fields().iter().any(|field| field.name == name);
    match shape.usual() {
        Shape::Number(_) => Carries::Number,
        Shape::Truth => Carries::Touch,
        Shape::Text => Carries::Text,
        Shape::Object(_) if has("label") => Carries::Face,
        Shape::Object(_) if has("size") => Carries::Ball,
        Shape::Object(_) | Shape::ObjectOrFirst(_) | Shape::List(_) | Shape::By { .. } | Shape::Anything => {
            Carries::Anything
        }
    }
}

/// What a stream of such values carries, if that says enough.
pub(crate) fn carried_by(kind: &ValueType) -> Option<Carries> {
    Some(match kind {
        ValueType::Number { .. } => Carries::Number,
        ValueType::Truth => Carries::Truth,
        ValueType::Text => Carries::Text,
        ValueType::Record(fields) if fields.contains_key("label") => Carries::Face,
        ValueType::Record(fields) if fields.contains_key("size") => Carries::Ball,
        ValueType::Record(_) | ValueType::List(_) | ValueType::Any | ValueType::Nothing => return None,
    })
}

fn of_value(value: &Value) -> Option<Carries> {
    Some(match value {
        Value::Int(_) | Value::Float(_) => Carries::Number,
        Value::Bool(_) => Carries::Truth,
        Value::Text(_) => Carries::Text,
        Value::Map(fields) if fields.contains_key("label") => Carries::Face,
        Value::Map(fields) if fields.contains_key("size") => Carries::Ball,
        Value::Map(_) | Value::List(_) | Value::Null => return None,
    })
}

fn text_of<'a>(procedure: &'a Procedure, helpers: &'a [Helper]) -> Option<&'a str> {
    match procedure {
        Procedure::Body { body, .. } => Some(body),
        Procedure::Helper(name) => {
            helpers.iter().find(|helper| helper.name == *name).map(|helper| helper.body.as_str())
        }
    }
}

/// A guess from how a procedure looks.
fn of_text(body: &str) -> Carries {
    let has = |signs: &[&str]| signs.iter().any(|sign| body.contains(sign));
    if has(&["#{", "["]) || body.contains("if ") {
        Carries::Anything
    } else if has(&["\"", "`"]) {
        Carries::Text
    } else if has(&["==", "<", ">", "&&", "||", "!", "true", "false"]) {
        Carries::Truth
    } else if has(&["+", "-", "*", "/", ".", "("]) || body.trim().parse::<f64>().is_ok() {
        Carries::Number
    } else {
        Carries::Anything
    }
}

#[cfg(test)]
mod tests {
    use super::of_text;
    use behaviour::connectors::Carries;

    #[test]
    fn a_procedure_that_reckons_makes_numbers() {
        for body in ["0.03 / sin(ball.size)", "ball.x * 2", "redBall.size", "7"] {
            assert_eq!(of_text(body), Carries::Number, "{body}");
        }
    }

    #[test]
    fn what_else_procedures_make_is_seen_from_their_signs() {
        for body in ["distance < 20", "!touched", "a == b && true"] {
            assert_eq!(of_text(body), Carries::Truth, "{body}");
        }
        for body in ["\"red\"", "`${ball.size} m`"] {
            assert_eq!(of_text(body), Carries::Text, "{body}");
        }
        for body in ["#{x: ball.x}", "[ball.x, 1]", "ball", "if a { `b` }", "if near < 2 { 1 } else { 0 }"] {
            assert_eq!(of_text(body), Carries::Anything, "{body}");
        }
    }
}
