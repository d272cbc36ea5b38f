//! The parameters of a device as a form, straight from the catalogue.

use super::{Choice, NumberField, TextField, read_one_way};
use crate::desk::use_desk;
use crate::reasons::Unfilled;
use crate::words;
use behaviour::{FillFrom, Params, Value};
use leptos::prelude::*;
use robot::{Device, Param, ParamKind};

/// The texts that a person has in the form of one device.
#[derive(Clone)]
pub(crate) struct ParamForm {
    device: &'static Device,
    rows: Vec<ParamRow>,
}

#[derive(Clone)]
struct ParamRow {
    param: &'static Param,
    /// What is saved, and how that is shown.
    saved: ArcRwSignal<(Value, String)>,
    text: ArcRwSignal<String>,
}

impl ParamForm {
    /// The form of `device` with what was chosen before.
    pub(crate) fn new(device: &'static Device, given: &Params) -> Self {
        let row = |param: &'static Param| {
            let saved = saved_of(param, given);
            ParamRow { param, text: ArcRwSignal::new(saved.1.clone()), saved: ArcRwSignal::new(saved) }
        };
        Self { device, rows: device.params.iter().map(row).collect() }
    }

    /// Something else was saved meanwhile: shown wherever nobody has written anything else.
    pub(crate) fn follow(&self, given: &Params) {
        self.rows.iter().for_each(|row| row.follow(saved_of(row.param, given)));
    }

    /// Shows what is saved, whatever somebody has written.
    pub(crate) fn take_back(&self) {
        self.rows.iter().for_each(|row| row.text.set(row.saved.with_untracked(|saved| saved.1.clone())));
    }

    /// Tells when somebody writes or chooses something else.
    pub(crate) fn track(&self) {
        self.rows.iter().for_each(|row| row.text.track());
    }

    /// Whether a parameter has the value that it has when nobody chose.
    pub(crate) fn is_default(&self, name: &str, value: &Value) -> bool {
        self.rows.iter().any(|row| row.param.name == name && row.param.default() == *value)
    }

    /// What was chosen.
    ///
    /// # Errors
    /// If something does not fit.
    pub(crate) fn read(&self) -> Result<Params, Unfilled> {
        self.rows.iter().try_for_each(ParamRow::in_two_ways)?;
        let params: Params = self.rows.iter().map(|row| (row.param.name.to_owned(), row.value())).filled();
        self.device.check(&params).map(|()| params).map_err(|reason| Unfilled::Param(phrase::Phrased::phrase(&reason)))
    }
}

/// What is saved of a parameter, and how that is shown.
fn saved_of(param: &Param, given: &Params) -> (Value, String) {
    let value = given.get(param.name).cloned().unwrap_or_else(|| param.default());
    let shown = text_of(&value);
    (value, shown)
}

impl ParamRow {
    fn follow(&self, saved: (Value, String)) {
        let untouched = self.saved.with_untracked(|before| self.text.with_untracked(|text| *text == before.1));
        if untouched && self.text.with_untracked(|text| *text != saved.1) {
            self.text.set(saved.1.clone());
        }
        self.saved.set(saved);
    }

    /// Nobody guesses a number that may be either of two.
    fn in_two_ways(&self) -> Result<(), Unfilled> {
        match self.param.kind {
            ParamKind::Number { .. } => self.text.with_untracked(|text| read_one_way(text)),
            ParamKind::Choice(_) | ParamKind::Text { .. } => Ok(()),
        }
    }

    fn value(&self) -> Value {
        let text = self.text.get_untracked();
        let (given, shown) = self.saved.get_untracked();
        if text == shown {
            return given;
        }
        match self.param.kind {
            ParamKind::Number { .. } => {
                behaviour::typed_number(&text).and_then(behaviour::TypedNumber::one).map_or(Value::Null, Value::Float)
            }
            ParamKind::Choice(_) | ParamKind::Text { .. } => Value::text(text),
        }
    }
}

/// One field for every parameter.
#[component]
pub(crate) fn ParamFields(
    form: ParamForm,
    /// Whether few choices stand side by side however long their words are.
    #[prop(optional)]
    side_by_side: bool,
) -> impl IntoView {
    form.rows
        .into_iter()
        .map(|row| view! { <ParamField device=form.device param=row.param value=RwSignal::from(row.text) side_by_side /> })
        .collect_view()
}

#[component]
fn ParamField(
    device: &'static Device,
    param: &'static Param,
    value: RwSignal<String>,
    side_by_side: bool,
) -> impl IntoView {
    let label = words::label_of(&device.param_called(param));
    match param.kind {
        ParamKind::Choice(options) => {
            let words =
                |option: &(&str, &'static str)| words::label_of(&device.choice_called(param, *option)).to_owned();
            let options = options.iter().map(|option| (option.0.to_owned(), words(option))).collect();
            view! { <Choice label options value side_by_side /> }.into_any()
        }
        ParamKind::Number { min, max, step, unit, .. } => {
            view! { <NumberField label value unit=words::label_of(&device.unit_called(param, unit)) min max step /> }
                .into_any()
        }
        ParamKind::Text { max_chars, offers: None, .. } => {
            view! { <TextField label value max_chars first=true /> }.into_any()
        }
        ParamKind::Text { max_chars, offers: Some(of), .. } => {
            let chosen = use_desk().robots.chosen.clone();
            // What the robot in use says it has; anything may be typed for another one.
            let offers = Signal::derive(move || {
                chosen.read().as_ref().map(|robot| robot.installed.list(of).to_vec()).unwrap_or_default()
            });
            view! { <TextField label value max_chars first=true offers /> }.into_any()
        }
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
    use super::{ParamForm, Unfilled, text_of};
    use crate::words;
    use behaviour::{Params, StreamKind, Value};
    use leptos::prelude::Set;

    #[test]
    fn what_is_saved_meanwhile_is_shown_where_nobody_wrote() {
        let tracker = robot::device(StreamKind::Actuator, "Tracker").unwrap();
        let with = |mode: &str| Params::from([("mode".to_owned(), Value::text(mode))]);
        let form = ParamForm::new(tracker, &with("Head"));
        let row = |name: &str| form.rows.iter().find(|row| row.param.name == name).unwrap();
        row("effector").text.set("LArm".to_owned());
        form.follow(&with("WholeBody"));
        let params = form.read().unwrap();
        let said = |name: &str| params[name].as_text().map(str::to_owned);
        assert_eq!([said("mode"), said("effector")], [Some("WholeBody".to_owned()), Some("LArm".to_owned())]);
        form.take_back();
        assert_eq!(form.read().unwrap()["effector"].as_text(), Some("None"));
    }

    #[test]
    fn numbers_and_texts_are_shown_plainly() {
        assert_eq!(text_of(&Value::Float(1000.0)), "1000");
        assert_eq!(text_of(&Value::Float(0.3)), "0.3");
        assert_eq!(text_of(&Value::text("Head")), "Head");
    }

    #[test]
    fn a_reason_becomes_a_sentence() {
        let why = Unfilled::Param("speed must be a number".into());
        assert_eq!(words::unfilled(&why), "Speed must be a number.");
    }
}
