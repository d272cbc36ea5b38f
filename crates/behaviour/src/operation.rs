//! The operation of one connector of a behaviour: which connector it is, and what was chosen for it.

use crate::connectors::{self, Spec};
use crate::{Procedure, Value};
use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// The choices for a connector: the parts of its parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters {
    /// A procedure.
    pub procedure: Option<Procedure>,
    /// A duration, in milliseconds.
    pub period_ms: Option<u64>,
    /// A value to start from.
    pub start: Option<Value>,
}

impl Parameters {
    /// A duration alone.
    #[must_use]
    pub fn period(period_ms: u64) -> Self {
        Self { period_ms: Some(period_ms), ..Self::default() }
    }
}

impl From<()> for Parameters {
    fn from((): ()) -> Self {
        Self::default()
    }
}

impl From<Procedure> for Parameters {
    fn from(procedure: Procedure) -> Self {
        Self { procedure: Some(procedure), ..Self::default() }
    }
}

/// The operation of a connector: its [`Spec`], with exactly those parts of a parameter that it takes.
#[derive(Clone, PartialEq)]
pub struct Operation {
    spec: &'static Spec,
    parameters: Parameters,
}

impl Operation {
    pub(crate) fn of(spec: &'static Spec, parameters: Parameters) -> Self {
        Self { spec, parameters }
    }

    /// Returns the kind of connector.
    #[must_use]
    pub fn spec(&self) -> &'static Spec {
        self.spec
    }

    /// The connector's word, as the thesis and the files write it.
    #[must_use]
    pub fn word(&self) -> &'static str {
        self.spec.word
    }

    /// The procedure, if it has one.
    #[must_use]
    pub fn procedure(&self) -> Option<&Procedure> {
        self.parameters.procedure.as_ref()
    }

    /// The procedure, if it has one, to change it.
    pub fn procedure_mut(&mut self) -> Option<&mut Procedure> {
        self.parameters.procedure.as_mut()
    }

    /// The argument names of its procedure: as given, else from the names of its inputs.
    pub fn arguments<'n>(&self, inputs: impl IntoIterator<Item = &'n str>) -> Vec<String> {
        match self.procedure() {
            Some(Procedure::Body { args: Some(args), .. }) => args.clone(),
            Some(Procedure::Body { body, args: None }) => self.spec.arguments_of(body, inputs),
            Some(Procedure::Helper(_)) | None => self.spec.argument_names(inputs),
        }
    }

    /// The duration in milliseconds, if it takes one: 1 to 3,600,000 where the rules are kept.
    #[must_use]
    pub fn period_ms(&self) -> Option<u64> {
        self.parameters.period_ms
    }

    /// Returns the choices as texts: the value to start from, the body or the helper's name, the duration in words.
    #[must_use]
    pub fn chosen(&self) -> Vec<String> {
        let Parameters { procedure, period_ms, start } = &self.parameters;
        let procedure = procedure.as_ref().map(|procedure| match procedure {
            Procedure::Body { body, .. } => body.clone(),
            Procedure::Helper(name) => name.clone(),
        });
        let period = period_ms.map(|ms| self.spec.lasts(ms));
        start.as_ref().map(Value::to_string).into_iter().chain(procedure).chain(period).collect()
    }

    /// The value to start from, if it takes one.
    #[must_use]
    pub fn start(&self) -> Option<&Value> {
        self.parameters.start.as_ref()
    }
}

impl fmt::Debug for Operation {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let Parameters { procedure, period_ms, start } = &self.parameters;
        let mut told = to.debug_tuple(self.word());
        if let Some(start) = start {
            told.field(start);
        }
        if let Some(procedure) = procedure {
            told.field(procedure);
        }
        if let Some(period_ms) = period_ms {
            told.field(period_ms);
        }
        told.finish()
    }
}

/// A body as it is written.
#[derive(Serialize)]
struct BodyText<'o> {
    body: &'o str,
    #[serde(skip_serializing_if = "Option::is_none")]
    args: Option<&'o [String]>,
}

impl Serialize for Parameters {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        if let Some(start) = &self.start {
            map.serialize_entry("start", start)?;
        }
        match &self.procedure {
            Some(Procedure::Body { body, args }) => {
                map.serialize_entry("body", &BodyText { body, args: args.as_deref() })?;
            }
            Some(Procedure::Helper(name)) => map.serialize_entry("helper", name)?,
            None => {}
        }
        if let Some(period_ms) = &self.period_ms {
            map.serialize_entry("periodMs", period_ms)?;
        }
        map.end()
    }
}

/// `"merge"`, `{"filter":{"body":{"body":"x"}}}`, `{"sample":{"periodMs":500}}`.
impl Serialize for Operation {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.parameters == Parameters::default() {
            return to.serialize_str(self.word());
        }
        let mut map = to.serialize_map(Some(1))?;
        map.serialize_entry(self.word(), &self.parameters)?;
        map.end()
    }
}

/// The parts of a parameter as they are read.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct ReadParameter {
    #[serde(default)]
    start: Option<Value>,
    #[serde(default)]
    body: Option<ReadBody>,
    #[serde(default)]
    helper: Option<String>,
    #[serde(default)]
    period_ms: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadBody {
    body: String,
    #[serde(default)]
    args: Option<Vec<String>>,
}

impl ReadParameter {
    fn operation<E: Error>(self, word: &str) -> Result<Operation, E> {
        let spec = connectors::spec(word).ok_or_else(|| E::custom(format_args!("there is no connector {word:?}")))?;
        let procedure = match (self.body, self.helper) {
            (Some(_), Some(_)) => return Err(E::custom("a connector with both a body and a helper")),
            (Some(ReadBody { body, args }), None) => Some(Procedure::Body { body, args }),
            (None, helper) => helper.map(Procedure::Helper),
        };
        let parameters = Parameters { procedure, period_ms: self.period_ms, start: self.start };
        if let Some(part) = spec.lacks(&parameters) {
            return Err(E::custom(format_args!("{word} needs {part}")));
        }
        if spec.refuses(&parameters) {
            return Err(E::custom(format_args!("{word} takes no such parameter")));
        }
        Ok(spec.with(parameters))
    }
}

impl<'de> Deserialize<'de> for Operation {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AnyOperation)
    }
}

struct AnyOperation;

impl<'de> Visitor<'de> for AnyOperation {
    type Value = Operation;

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("a connector by its word, with its parameter if it takes one")
    }
    fn visit_str<E: Error>(self, word: &str) -> Result<Operation, E> {
        ReadParameter::default().operation(word)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Operation, A::Error> {
        let Some((word, read)) = entries.next_entry::<String, Option<ReadParameter>>()? else {
            return Err(A::Error::custom("a connector without a word"));
        };
        if entries.next_key::<String>()?.is_some() {
            return Err(A::Error::custom("a connector with two words"));
        }
        read.unwrap_or_default().operation(&word)
    }
}

#[cfg(test)]
mod tests {
    use super::{Operation, Parameters};
    use crate::{Procedure, connectors};

    #[test]
    fn an_operation_is_written_as_it_always_was() {
        let args = Some(vec!["a".to_owned()]);
        let cases = [
            (connectors::map::SPEC.with(Procedure::body("x")), r#"{"map":{"body":{"body":"x"}}}"#),
            (
                connectors::filter::SPEC.with(Procedure::Body { body: String::new(), args }),
                r#"{"filter":{"body":{"body":"","args":["a"]}}}"#,
            ),
            (
                connectors::combine_latest::SPEC.with(Procedure::Helper("near".into())),
                r#"{"combineLatest":{"helper":"near"}}"#,
            ),
            (connectors::sample::SPEC.with(Parameters::period(500)), r#"{"sample":{"periodMs":500}}"#),
            (connectors::timestamp::SPEC.with(()), r#""timestamp""#),
            (connectors::merge::SPEC.with(()), r#""merge""#),
            (connectors::subscribe::SPEC.with(()), r#""subscribe""#),
            (connectors::distinct::SPEC.with(()), r#""distinct""#),
            (connectors::distinct::SPEC.with(Procedure::body("x")), r#"{"distinct":{"body":{"body":"x"}}}"#),
            (
                connectors::scan::SPEC.with(Parameters { start: Some(0.into()), ..Procedure::body("x").into() }),
                r#"{"scan":{"start":0,"body":{"body":"x"}}}"#,
            ),
            (
                connectors::scan::SPEC.with(Procedure::Helper("near".into())),
                r#"{"scan":{"start":null,"helper":"near"}}"#,
            ),
            (connectors::debounce::SPEC.with(Parameters::period(5_000)), r#"{"debounce":{"periodMs":5000}}"#),
            (connectors::delay::SPEC.with(Parameters::period(1)), r#"{"delay":{"periodMs":1}}"#),
            (connectors::with_latest::SPEC.with(Procedure::body("x")), r#"{"withLatest":{"body":{"body":"x"}}}"#),
        ];
        for (operation, text) in cases {
            assert_eq!(serde_json::to_string(&operation).unwrap(), text);
            assert_eq!(serde_json::from_str::<Operation>(text).unwrap(), operation, "{text}");
        }
    }

    #[test]
    fn what_is_no_operation_is_refused() {
        let wrong = [
            r#""sieve""#,
            r#""map""#,
            r#"{"map":null}"#,
            r#"{"map":{"periodMs":5}}"#,
            r#"{"map":{"body":{"body":"x"},"helper":"near"}}"#,
            r#"{"map":{"body":{"body":"x","more":1}}}"#,
            r#"{"sample":{}}"#,
            r#"{"debounce":{}}"#,
            r#"{"distinct":{"start":1,"body":{"body":"x"}}}"#,
            r#"{"scan":{"start":0}}"#,
            r#""withLatest""#,
            r#"{"sample":{"periodMs":-1}}"#,
            r#"{"merge":{"body":{"body":"x"}}}"#,
            r#"{"merge":null,"map":{"helper":"near"}}"#,
            "{}",
            "7",
        ];
        for text in wrong {
            assert!(serde_json::from_str::<Operation>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_operation_has_the_parts_that_its_connector_takes() {
        for spec in connectors::ALL {
            let empty = spec.with(());
            let needs = spec.takes.procedure.is_some_and(|takes| !takes.is_optional);
            assert_eq!(empty.procedure().is_some(), needs, "{spec:?}");
            assert_eq!(empty.period_ms().is_some(), spec.takes.period.is_some(), "{spec:?}");
            assert_eq!(empty.start().is_some(), spec.takes.start.is_some(), "{spec:?}");
            let all = Parameters { procedure: Some(Procedure::body("x")), period_ms: Some(1), start: Some(2.into()) };
            let text = serde_json::to_string(&spec.with(all)).unwrap();
            assert_eq!(serde_json::to_string(&serde_json::from_str::<Operation>(&text).unwrap()).unwrap(), text);
        }
    }
}
