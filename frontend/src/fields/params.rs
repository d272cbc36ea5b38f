//! The parameters of a device as a form, straight from the catalogue.

use super::{Choice, NumberField, TextField, Unfilled};
use behaviour::{Filled, Params, Value};
use leptos::prelude::*;
use robot::{Device, Param, ParamKind};

/// The texts that a person has in the form of one device.
#[derive(Clone)]
pub(crate) struct ParamForm {
    device: &'static Device,
    rows: Vec<Row>,
}

#[derive(Clone)]
struct Row {
    param: &'static Param,
    given: Value,
    shown: String,
    text: ArcRwSignal<String>,
}

impl ParamForm {
    /// The form of `device` with what was chosen before.
    pub(crate) fn new(device: &'static Device, given: &Params) -> Self {
        let row = |param: &'static Param| {
            let given = given.get(param.name).cloned().unwrap_or_else(|| param.default());
            let shown = text_of(&given);
            Row { param, text: ArcRwSignal::new(shown.clone()), given, shown }
        };
        Self { device, rows: device.params.iter().map(row).collect() }
    }

    /// What was chosen.
    ///
    /// # Errors
    /// If something does not fit.
    pub(crate) fn read(&self) -> Result<Params, Unfilled> {
        let params: Params = self.rows.iter().map(|row| (row.param.name.to_owned(), row.value())).filled();
        self.device.check(&params).map(|()| params).map_err(|reason| Unfilled::Param(reason.to_string()))
    }
}

impl Row {
    fn value(&self) -> Value {
        let text = self.text.get_untracked();
        if text == self.shown {
            return self.given.clone();
        }
        match self.param.kind {
            ParamKind::Number { .. } => text.trim().parse().map_or(Value::Null, Value::Float),
            ParamKind::Choice(_) | ParamKind::Text { .. } => Value::text(text),
        }
    }
}

/// One field for every parameter.
#[component]
pub(crate) fn ParamFields(form: ParamForm) -> impl IntoView {
    form.rows
        .into_iter()
        .map(|row| view! { <ParamField param=row.param value=RwSignal::from(row.text) /> })
        .collect_view()
}

#[component]
fn ParamField(param: &'static Param, value: RwSignal<String>) -> impl IntoView {
    let label = param.label;
    match param.kind {
        ParamKind::Choice(options) => {
            let options = options.iter().map(|(key, words)| ((*key).to_owned(), (*words).to_owned())).collect();
            view! { <Choice label options value /> }.into_any()
        }
        ParamKind::Number { min, max, step, unit, .. } => {
            view! { <NumberField label value unit min max step /> }.into_any()
        }
        ParamKind::Text { max_chars, .. } => view! { <TextField label value max_chars first=true /> }.into_any(),
    }
}

fn text_of(value: &Value) -> String {
    match value {
        Value::Text(text) => text.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Null | Value::Bool(_) | Value::Int(_) | Value::List(_) | Value::Map(_) => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Unfilled, text_of};
    use crate::words;
    use behaviour::Value;

    #[test]
    fn numbers_and_texts_are_shown_plainly() {
        assert_eq!(text_of(&Value::Float(1000.0)), "1000");
        assert_eq!(text_of(&Value::Float(0.3)), "0.3");
        assert_eq!(text_of(&Value::text("Head")), "Head");
    }

    #[test]
    fn a_reason_becomes_a_sentence() {
        let why = Unfilled::Param("speed must be a number".to_owned());
        assert_eq!(words::unfilled(&why), "Speed must be a number.");
    }
}
